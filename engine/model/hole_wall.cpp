#include "model/hole_wall.hpp"

#include <algorithm>
#include <limits>

namespace drillstrand {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A section without its shoulders.
HoleWall wall_of(const WellSectionCase& section, std::size_t number, double from,
                 double normal_stiffness) {
    const double firmness = section.normal_stiffness.value_or(normal_stiffness) / normal_stiffness;
    return {number,
            from,
            section.to,
            section.diameter,
            section.end_diameter.value_or(section.diameter),
            firmness,
            firmness};
}

std::vector<HoleWall> walls_without_shoulders(const std::vector<WellSectionCase>& sections,
                                              double start, double normal_stiffness) {
    std::vector<HoleWall> walls;
    for (std::size_t k = 0; k < sections.size(); ++k) {
        const double first = start < sections[0].to ? start : -infinity;
        const double from = k > 0 ? sections[k - 1].to : first;
        walls.push_back(wall_of(sections[k], k, from, normal_stiffness));
    }
    return walls;
}

/// The part of a wall between two depths.
HoleWall part_of(const HoleWall& wall, double from, double to) {
    HoleWall part = wall;
    part.from = from;
    part.to = to;
    part.diameter_from = wall.diameter_at(from);
    if (to < wall.to) part.diameter_to = wall.diameter_at(to);
    return part;
}

/// Two walls that meet, of which the one or the other is bored out: within one diameter of the
/// wider, and half of its own length at most.
struct Joint {
    const HoleWall& above;
    const HoleWall& below;

    [[nodiscard]] bool is_smooth() const {
        return above.diameter_to == below.diameter_from && above.firmness_to == below.firmness_from;
    }
    /// Where it is not smooth: whether the lower wall is bored out.
    [[nodiscard]] bool is_below() const { return above.diameter_to >= below.diameter_from; }
    [[nodiscard]] double length_in(const HoleWall& bored) const {
        return std::min(0.5 * (bored.to - bored.from),
                        std::max(above.diameter_to, below.diameter_from));
    }
};

/// What a section is, with the shoulders that lie in it.
void add_wall(const std::vector<HoleWall>& plain, std::size_t k, std::vector<HoleWall>& walls) {
    const HoleWall& wall = plain[k];
    double top = wall.from;
    double bottom = wall.to;
    if (k > 0) {
        const Joint joint{plain[k - 1], wall};
        if (!joint.is_smooth() && joint.is_below()) top += joint.length_in(wall);
    }
    if (k + 1 < plain.size()) {
        const Joint joint{wall, plain[k + 1]};
        if (!joint.is_smooth() && !joint.is_below()) bottom -= joint.length_in(wall);
    }
    const HoleWall middle = part_of(wall, top, bottom);
    if (top > wall.from)
        walls.push_back({k, wall.from, top, plain[k - 1].diameter_to, middle.diameter_from,
                         plain[k - 1].firmness_to, middle.firmness_from});
    if (bottom > top) walls.push_back(middle);
    if (bottom < wall.to)
        walls.push_back({k, bottom, wall.to, middle.diameter_to, plain[k + 1].diameter_from,
                         middle.firmness_to, plain[k + 1].firmness_from});
}

/// Above the start of the well the first section goes on as it starts.
void hold_first(std::vector<HoleWall>& walls) {
    if (!walls.front().varies()) return;
    HoleWall rest = walls.front();
    rest.from = -infinity;
    rest.to = walls.front().from;
    rest.diameter_to = rest.diameter_from;
    rest.firmness_to = rest.firmness_from;
    walls.insert(walls.begin(), rest);
}

/// Below its end the last section goes on as it ends.
void hold_last(std::vector<HoleWall>& walls) {
    HoleWall rest = walls.back();
    rest.from = rest.to;
    rest.to = infinity;
    rest.diameter_from = rest.diameter_to;
    rest.firmness_from = rest.firmness_to;
    if (walls.back().varies())
        walls.push_back(rest);
    else
        walls.back().to = infinity;
}

}  // namespace

std::vector<HoleWall> hole_walls(const std::vector<WellSectionCase>& sections, double start,
                                 double normal_stiffness) {
    const std::vector<HoleWall> plain = walls_without_shoulders(sections, start, normal_stiffness);
    std::vector<HoleWall> walls;
    for (std::size_t k = 0; k < plain.size(); ++k)
        add_wall(plain, k, walls);
    hold_first(walls);
    hold_last(walls);
    return walls;
}

}  // namespace drillstrand

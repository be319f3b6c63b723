#include "model/mesh_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drillstrand {

namespace {

constexpr double most_segments = 10e6;

/// By how much the length of segments may change per length of string: neighbours differ by a
/// factor of 1.4 or so.
constexpr double growth = 0.35;

/// A stretch of string and the largest length of a segment in it (m).
struct Wish {
    double from, to;
    double element_length;
};

/// What a mesh is asked for, where that is not mesh.element_length.
std::vector<Wish> wishes_of(const StringCase& string, const StringLayout& layout,
                            const MeshCase& mesh) {
    std::vector<Wish> wishes;
    for (std::size_t i = 0; i < string.components.size(); ++i) {
        const Component& component = string.components[i];
        const double from = layout.component_boundary[i];
        const double to = layout.component_boundary[i + 1];
        if (component.element_length) wishes.push_back({from, to, *component.element_length});
        if (component.joints)
            wishes.push_back(
                {from, to, component.length / pieces_of(component) / mesh.segments_per_joint});
    }
    const double length = layout.length();
    for (const MeshRefinement& refine : mesh.refine) {
        const double from = refine.from_the_bit ? length - refine.to : refine.from;
        const double to = refine.from_the_bit ? length - refine.from : refine.to;
        if (to > 0 && from < length)
            wishes.push_back({std::max(from, 0.0), std::min(to, length), refine.element_length});
    }
    return wishes;
}

/// From a place to the nearest of some, which ascend (m).
double distance_to(const std::vector<double>& places, double s) {
    const auto below = std::lower_bound(places.begin(), places.end(), s);
    double least = std::numeric_limits<double>::infinity();
    if (below != places.end()) least = *below - s;
    if (below != places.begin()) least = std::min(least, s - *(below - 1));
    return least;
}

/// Places where a node must stand: ends of components and of refined stretches, tool joints,
/// contact points, kinks, eccentric masses. Those that differ by rounding are one.
std::vector<double> fixed_places(const StringLayout& layout, const std::vector<Wish>& wishes) {
    std::vector<double> places = layout.component_boundary;
    for (const TouchingPlace& place : layout.places)
        places.push_back(place.s);
    for (const Kink& kink : layout.kinks)
        places.push_back(kink.s);
    for (const EccentricPlace& mass : layout.eccentric)
        places.push_back(mass.s);
    std::sort(places.begin(), places.end());
    // an end of a stretch is where its maker happened to put it: no reason for a short segment
    std::vector<double> ends;
    for (const Wish& wish : wishes)
        for (const double s : {wish.from, wish.to})
            if (distance_to(places, s) > 0.5 * wish.element_length) ends.push_back(s);
    places.insert(places.end(), ends.begin(), ends.end());
    std::sort(places.begin(), places.end());
    const double rounding = place_rounding * layout.length();
    std::vector<double> kept{0.0};
    for (const double s : places)
        if (s > kept.back() + rounding) kept.push_back(s);
    kept.back() = layout.length();
    return kept;
}

/// The largest length of a segment between fixed places (m).
std::vector<double> largest_lengths(const std::vector<double>& places,
                                    const std::vector<Wish>& wishes, double element_length) {
    std::vector<double> largest(places.size() - 1, element_length);
    for (const Wish& wish : wishes) {
        const auto middle_is_below = [](double s, double place) { return s < place; };
        auto first = std::upper_bound(places.begin(), places.end(), wish.from, middle_is_below) -
                     places.begin();
        first = std::max<std::ptrdiff_t>(first - 1, 0);
        for (auto i = static_cast<std::size_t>(first); i < largest.size(); ++i) {
            const double middle = 0.5 * (places[i] + places[i + 1]);
            if (middle > wish.to) break;
            if (middle > wish.from) largest[i] = std::min(largest[i], wish.element_length);
        }
    }
    for (std::size_t i = 0; i < largest.size(); ++i)
        largest[i] = std::min(largest[i], places[i + 1] - places[i]);
    return largest;
}

/// Lengths of segments at the fixed places, such that they grow from the shortest at a bounded
/// rate.
std::vector<double> lengths_at(const std::vector<double>& places,
                               const std::vector<double>& largest) {
    std::vector<double> at(places.size());
    at.front() = largest.front();
    at.back() = largest.back();
    for (std::size_t i = 1; i + 1 < at.size(); ++i)
        at[i] = std::min(largest[i - 1], largest[i]);
    for (std::size_t i = 1; i < at.size(); ++i)
        at[i] = std::min(at[i], at[i - 1] + growth * (places[i] - places[i - 1]));
    for (std::size_t i = at.size() - 1; i-- > 0;)
        at[i] = std::min(at[i], at[i + 1] + growth * (places[i + 1] - places[i]));
    return at;
}

/// The wished length of segments between two fixed places: it grows from both ends up to the
/// largest one. Segments are counted by the integral of its inverse.
class Interval {
  public:
    Interval(double length, double first, double last, double largest)
        : length_(length), first_(first), last_(last), largest_(largest) {
        up_ = (largest - first) / growth;
        down_ = length - (largest - last) / growth;
        if (up_ > down_) up_ = down_ = 0.5 * (length + (last - first) / growth);
        up_ = std::clamp(up_, 0.0, length);
        down_ = std::clamp(down_, up_, length);
        // how gently lengths grow may give way a little, but nothing may be longer than the largest
        const double wished = segments_to(length);
        count_ = std::max({1.0, std::ceil(length / largest - rounding), std::ceil(wished - give)});
        const double longest = (first + growth * up_) * wished / count_;
        if (count_ > 1 && longest > largest * (1 + rounding)) ++count_;
    }

    [[nodiscard]] double count() const { return count_; }

    /// Where the k-th node after the first place lies.
    [[nodiscard]] double node(double k) const {
        const double target = k / count_ * segments_to(length_);
        const double rising = segments_to(up_);
        if (target <= rising) return std::expm1(growth * target) * first_ / growth;
        const double level = segments_to(down_);
        if (target <= level) return up_ + (target - rising) * largest_;
        return length_ + std::expm1(growth * (segments_to(length_) - target)) * -last_ / growth;
    }

  private:
    static constexpr double rounding = 1e-9;
    static constexpr double give = 0.25;

    /// Segments from the first place to x.
    [[nodiscard]] double segments_to(double x) const {
        double sum = std::log1p(growth * std::min(x, up_) / first_) / growth;
        if (x > up_) sum += (std::min(x, down_) - up_) / largest_;
        if (x > down_)
            sum += (std::log1p(growth * (length_ - down_) / last_) -
                    std::log1p(growth * (length_ - x) / last_)) /
                   growth;
        return sum;
    }

    double length_, first_, last_, largest_;
    double up_, down_;  ///< where growing ends, and shrinking begins
    double count_;
};

std::vector<double> even_places(double length, int segments) {
    std::vector<double> places;
    places.reserve(static_cast<std::size_t>(segments) + 1);
    for (int k = 0; k <= segments; ++k)
        places.push_back(length * (static_cast<double>(k) / segments));
    return places;
}

}  // namespace

std::vector<double> node_places(const StringCase& string, const StringLayout& layout,
                                const MeshCase& mesh) {
    if (mesh.segments > 0) return even_places(layout.length(), mesh.segments);
    const std::vector<Wish> wishes = wishes_of(string, layout, mesh);
    const std::vector<double> fixed = fixed_places(layout, wishes);
    const std::vector<double> largest = largest_lengths(fixed, wishes, mesh.element_length);
    const std::vector<double> at = lengths_at(fixed, largest);

    std::vector<Interval> intervals;
    double segments = 0;
    for (std::size_t i = 0; i < largest.size(); ++i) {
        intervals.emplace_back(fixed[i + 1] - fixed[i], at[i], at[i + 1], largest[i]);
        segments += intervals.back().count();
    }
    if (segments > most_segments)
        throw std::invalid_argument(fmt::format(
            "the mesh has {:.0f} segments; expected at most {:.0f}: a longer element_length",
            segments, most_segments));
    std::vector<double> places{0.0};
    places.reserve(static_cast<std::size_t>(segments) + 1);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        for (double k = 1; k < intervals[i].count(); ++k)
            places.push_back(fixed[i] + intervals[i].node(k));
        places.push_back(fixed[i + 1]);
    }
    return places;
}

}  // namespace drillstrand

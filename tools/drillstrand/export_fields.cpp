#include "export_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace drillstrand::program {

namespace {

using Eigen::Vector3d;

constexpr double largest_turn = std::numbers::pi / 180;

/// Three components of each row, from `first` on.
template <class Rows>
ExportField three_of(const char* name, const char* units, std::vector<std::string> components,
                     const Rows& rows, Eigen::Index first = 0) {
    ExportField field{name, units, std::move(components), {}};
    for (const auto& row : rows)
        for (Eigen::Index k = first; k < first + 3; ++k)
            field.values.push_back(row[k]);
    return field;
}

/// Values that the file holds once for all profiles; nothing where it does not hold them.
void add_constant(std::vector<ExportField>& fields, const char* name, const char* units,
                  const std::vector<double>& values) {
    if (!values.empty()) fields.push_back({name, units, {}, values});
}

ExportField spin(const Profile& profile, const std::vector<double>& polar_inertia) {
    ExportField field{"spin", "rad/s", {}, {}};
    for (std::size_t k = 0; k < polar_inertia.size(); ++k)
        field.values.push_back(profile.momentum[k][0] / polar_inertia[k]);
    return field;
}

/// Depths from `top` to `bottom`, both included, no two of them more than `turn` of the arc apart.
std::vector<double> depths_of(const WellArc& arc, double top, double bottom) {
    const double pieces = std::ceil(arc.curvature * (bottom - top) / largest_turn);
    const std::size_t count = pieces > 1 ? static_cast<std::size_t>(pieces) : 1;
    std::vector<double> depths;
    for (std::size_t k = 0; k <= count; ++k)
        depths.push_back(
            std::lerp(top, bottom, static_cast<double>(k) / static_cast<double>(count)));
    return depths;
}

/// From where to where the well is drawn (m). Depths that are none count not.
std::pair<double, double> extent_of(const Result& result, const Well& well) {
    double top = well.measured_depth_start();
    double bottom = well.measured_depth_end();
    for (const Profile& profile : result.profiles) {
        const auto [least, most] =
            std::minmax_element(profile.well_depth.begin(), profile.well_depth.end());
        if (least == profile.well_depth.end()) continue;
        if (std::isfinite(*least)) top = std::min(top, *least);
        if (std::isfinite(*most)) bottom = std::max(bottom, *most);
    }
    return {top, bottom};
}

void add_depths(WellStretch& stretch, const Well& well, const std::vector<double>& depths) {
    for (const double depth : depths) {
        if (!stretch.measured_depth.empty() && depth <= stretch.measured_depth.back()) continue;
        stretch.measured_depth.push_back(depth);
        stretch.axis.push_back(well.at(depth).axis);
    }
}

}  // namespace

const std::vector<std::string>& space_components() {
    static const std::vector<std::string> names{"north", "east", "down"};
    return names;
}

const std::vector<std::string>& stress_components() {
    static const std::vector<std::string> names{"twist_moment", "bending_1", "bending_2",
                                                "axial_force",  "shear_1",   "shear_2"};
    return names;
}

std::string with_units(const std::string& name, const std::string& units) {
    return units == "1" ? name : name + "[" + units + "]";
}

ProfileFields::ProfileFields(const Result& result) : result_(result) {
    if (!result.header.well) return;
    well_.emplace(*result.header.well);
    arcs_.resize(result.header.node_s.size(), 0);
}

std::vector<ExportField> ProfileFields::of_nodes(const Profile& profile) {
    const ResultHeader& header = result_.header;
    const std::vector<std::string> body{"d3", "d1", "d2"};
    std::vector<ExportField> fields;
    add_constant(fields, "arc_length", "m", header.node_s);
    fields.push_back(three_of("director", "1", space_components(), profile.director));
    fields.push_back(three_of("angular_momentum", "kg m/s", body, profile.momentum));
    fields.push_back(three_of("linear_momentum", "kg/s", body, profile.momentum, 3));
    fields.push_back({"eccentricity", "m", {}, profile.eccentricity});
    fields.push_back({"well_depth", "m", {}, profile.well_depth});
    fields.push_back(three_of("contact_force", "N/m", space_components(), profile.contact_force));
    fields.push_back({"normal_force", "N/m", {}, profile.normal_force});
    fields.push_back({"side_force", "N/m", {}, profile.side_force});
    fields.push_back({"whirl_rate", "rad/s", {}, profile.whirl_rate});
    if (!header.polar_inertia.empty()) fields.push_back(spin(profile, header.polar_inertia));
    add_constant(fields, "outer_radius", "m", header.outer_radius);
    if (well_) fields.push_back(offset(profile));
    return fields;
}

std::vector<ExportField> ProfileFields::of_segments(const Profile& profile) const {
    std::vector<ExportField> fields;
    add_constant(fields, "arc_length", "m", result_.header.segment_s);
    for (std::size_t k = 0; k < stress_components().size(); ++k) {
        ExportField field{stress_components()[k], k < 3 ? "N m" : "N", {}, {}};
        for (const Vector6& stress : profile.stress)
            field.values.push_back(stress[static_cast<Eigen::Index>(k)]);
        fields.push_back(std::move(field));
    }
    ExportField bending{"bending_moment", "N m", {}, {}};
    for (const Vector6& stress : profile.stress)
        bending.values.push_back(std::hypot(stress[1], stress[2]));
    fields.push_back(std::move(bending));
    return fields;
}

ExportField ProfileFields::offset(const Profile& profile) {
    ExportField field{"offset_from_axis", "m", space_components(), {}};
    for (std::size_t k = 0; k < profile.position.size(); ++k) {
        const Vector3d& position = profile.position[k];
        arcs_[k] = well_->find_arc(position, arcs_[k]);
        const Vector3d offset = position - well_->project(position, arcs_[k]).axis;
        field.values.insert(field.values.end(), offset.begin(), offset.end());
    }
    return field;
}

std::vector<WellStretch> well_stretches(const Result& result) {
    std::vector<WellStretch> stretches;
    if (!result.header.well) return stretches;
    const Well well(*result.header.well);
    const auto [top, bottom] = extent_of(result, well);
    double start = top;
    for (std::size_t index = well.arc_at(top); index <= well.arc_at(bottom); ++index) {
        const WellArc& arc = well.arcs()[index];
        const double end =
            index == well.arc_at(bottom) ? bottom : arc.measured_depth_start + arc.length;
        if (end > start) {
            const double radius = arc.radius_at(0.5 * arc.length);
            if (stretches.empty() || stretches.back().radius != radius)
                stretches.push_back({radius, {}, {}});
            add_depths(stretches.back(), well, depths_of(arc, start, end));
        }
        start = std::max(start, end);
    }
    return stretches;
}

}  // namespace drillstrand::program

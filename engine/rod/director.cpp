#include "rod/director.hpp"

#include <Eigen/Geometry>

#include "model/segment_strain.hpp"

namespace drillstrand {

DirectorConstants::DirectorConstants(const Scene& scene)
    : table_(rows, static_cast<std::size_t>(scene.segments) + 1) {
    // Padding has no stiffness and no weight: it stays where it is and divides nothing by zero.
    for (const Row unit : {length, twisting, inverse_cell, mass, inverse_mass, polar, inverse_polar,
                           transverse, inverse_transverse}) {
        table_.fill(unit, 1.0);
    }
    const StringMesh& mesh = scene.mesh;
    for (std::size_t k = 0; k < mesh.length.size(); ++k) {
        const SectionProperties& s = mesh.segment[k];
        const auto set = [&](Row row, double value) { table_.row(row)[k] = value; };
        set(length, mesh.length[k]);
        set(inverse_length, 1 / mesh.length[k]);
        const SegmentStiffness stiffness(s, mesh.length[k]);
        set(twisting, stiffness.twisting);
        set(bent_twisting, stiffness.bent_twisting);
        set(bending, stiffness.bending);
        set(axial, stiffness.axial);
        set(deviation, stiffness.deviation);
        set(bending_share, stiffness.bending_share);
        set(slenderness, stiffness.slenderness);
        set(twist0, s.curvature[0]);
        set(bend10, s.curvature[1]);
        set(bend20, s.curvature[2]);
    }
    for (std::size_t k = 0; k < mesh.cell.size(); ++k) {
        const SectionProperties& s = mesh.node[k];
        const auto set = [&](Row row, double value) { table_.row(row)[k] = value; };
        set(inverse_cell, 1 / mesh.cell[k]);
        set(mobile_cell, mesh.cell[k]);
        set(tilting_cell, mesh.cell[k]);
        set(mass, s.mass);
        set(inverse_mass, 1 / s.mass);
        set(polar, s.polar_inertia);
        set(inverse_polar, 1 / s.polar_inertia);
        set(transverse, scene.inertia[k]);
        set(inverse_transverse, 1 / scene.inertia[k]);
        set(weight, scene.weight[k]);
        if (!mesh.unbalance.empty()) set(unbalance, mesh.unbalance[k] / mesh.cell[k]);
    }
    if (scene.head.motion != HeadMotion::free) table_.row(mobile_cell)[0] = 0.0;
    if (scene.head.motion == HeadMotion::driven) table_.row(tilting_cell)[0] = 0.0;
    // padding keeps no energy account
    for (std::size_t k = mesh.cell.size(); k < table_.blocks() * block_size; ++k)
        table_.row(mobile_cell)[k] = table_.row(tilting_cell)[k] = 0.0;
}

DirectorModel::DirectorModel(const Scene& scene, Level its_level)
    : constants(scene),
      surroundings(scene, its_level),
      level(its_level),
      features(scene.features),
      internal_damping(scene.damping.internal),
      external_damping(scene.damping.external),
      kelvin_voigt(scene.damping.kelvin_voigt),
      down(scene.down),
      segments(static_cast<std::size_t>(scene.segments)) {}

void write_end_load(Table<SegmentRow>& segments, std::ptrdiff_t ghost, const EndLoad& load,
                    const Eigen::Vector3d& director) {
    for (const RowInfo<SegmentRow>& info : row_list<SegmentRow>) {
        if (info.row == SegmentRow::twist) continue;
        for (std::size_t i = 0; i < info.width; ++i)
            segments.row(info.row, i)[ghost] = 0.0;
    }
    segments.set(SegmentRow::pull, ghost, load.force);
    segments.set(SegmentRow::last_pull, ghost, load.force);
    // t x lean is what of the couple is normal to t
    const Eigen::Vector3d lean = load.couple.cross(director);
    segments.set(SegmentRow::first_lean, ghost, lean);
    segments.set(SegmentRow::last_lean, ghost, -lean);
    for (const SegmentRow row : {SegmentRow::torque, SegmentRow::last_torque})
        segments.row(row)[ghost] = load.couple.dot(director);
}

}  // namespace drillstrand

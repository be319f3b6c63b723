#include "integrators/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "model/segment_strain.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand {

namespace {

using Constants = DirectorConstants;

// h as a fraction of the pitch, squared: two segments a turn cannot show it, eight a fair shape
constexpr double most_coarseness = 1.0 / (2 * 2);
constexpr double fair_coarseness = 1.0 / (8 * 8);

/// Reads the segments of a block into three rows of block_size numbers each. `slid`:
/// Jar::slid_in().
DRILLSTRAND_KERNEL void read_guards(const DirectorConstants& c, const BlockTable& limits,
                                    const Table<DirectorRow>& rod,
                                    const Table<SegmentRow>& segments, const double* slid,
                                    std::size_t block, double* cosine_out, double* yield2_out,
                                    double* coarseness_out) {
    const auto first = static_cast<std::ptrdiff_t>(block * block_size);
    const ConstTriples x_a = rod.triples(DirectorRow::position, first);
    const ConstTriples x_b = rod.triples(DirectorRow::position, first + 1);
    const ConstTriples t_a = rod.triples(DirectorRow::director, first);
    const ConstTriples t_b = rod.triples(DirectorRow::director, first + 1);
    const ConstTriples d1_a = rod.triples(DirectorRow::material, first);
    const ConstTriples d1_b = rod.triples(DirectorRow::material, first + 1);
    const double* torque = segments.row(SegmentRow::torque) + first;
    const StiffnessRows stiffnesses(c, first);
    const double* inverse_length = c.row(Constants::inverse_length) + first;
    const double* length = c.row(Constants::length) + first;
    const double* bend10 = c.row(Constants::bend10) + first;
    const double* bend20 = c.row(Constants::bend20) + first;
    const double* axial_yield = limits.row(Guards::axial_yield) + first;
    const double* bending_yield = limits.row(Guards::bending_yield) + first;
    const double* torsion_yield = limits.row(Guards::torsion_yield) + first;
    const double* inverse_pitch = limits.row(Guards::inverse_pitch) + first;

    const auto segment = [&](std::size_t k) DRILLSTRAND_LAMBDA {
        const double ih = inverse_length[k];
        const Triple ta = t_a[k];
        const Triple tb = t_b[k];
        const SegmentBend arc(ta, tb);
        const SegmentChord chord(x_a[k], x_b[k], ih, ta, tb, arc.inverse_both());
        const double factor = arc.factor();
        const SegmentStiffness stiffness = stiffnesses[k];
        const BeamColumn beam(stiffness, chord, factor * factor * dot(arc.turn, arc.turn), slid[k]);
        const double tension = beam.tension;
        // at the ends of the segment: by the angle between them, less the own curvature of the mean
        // frame, and by the deviation of the chord
        const double h = length[k];
        const Triple own_a = own_curvature(bend10[k], bend20[k], ta, d1_a[k]);
        const Triple own_b = own_curvature(bend10[k], bend20[k], tb, d1_b[k]);
        const Triple of_bend =
            combine(h * factor * (stiffness.bending + beam.moment), arc.turn,
                    -0.5 * h * h * stiffness.bending, combine(1.0, own_a, 1.0, own_b));
        const double of_deviation2 = 0.25 * h * h * beam.shearing * beam.shearing * beam.angle2;
        const double moment = std::sqrt(dot(of_bend, of_bend)) + std::sqrt(of_deviation2);
        const double normal = std::abs(tension) * axial_yield[k] + moment * bending_yield[k];
        const double shear = torque[k] * torsion_yield[k];
        cosine_out[k] = arc.cosine;
        yield2_out[k] = normal * normal + shear * shear;
        coarseness_out[k] = -tension * inverse_pitch[k];
    };
#pragma omp simd
    for (std::size_t k = 0; k < block_size; ++k)
        segment(k);
}

}  // namespace

/// The readings of each segment of a block; the padding after the last one does not count.
struct Guards::BlockReadings {
    std::size_t first;
    std::size_t count;
    double cosine[block_size];
    double yield2[block_size];
    double coarseness[block_size];

    [[nodiscard]] GuardReading of(std::size_t k) const {
        return {cosine[k], yield2[k], coarseness[k]};
    }
};

Guards::BlockReadings Guards::readings(const Table<DirectorRow>& rod,
                                       const Table<SegmentRow>& segments, const JarState& jar,
                                       std::size_t block) const {
    BlockReadings all;
    all.first = block * block_size;
    all.count = std::min(block_size, model_.segments - std::min(model_.segments, all.first));
    const std::array<double, block_size> slid = jar_.slid_in(jar, block);
    at_level<read_guards>(model_.level)(model_.constants, limits_, rod, segments, slid.data(),
                                        block, all.cosine, all.yield2, all.coarseness);
    return all;
}

Guards::Guards(const Scene& scene, const DirectorModel& model, double stress_limit)
    : scene_(scene),
      model_(model),
      jar_(scene.mesh),
      limits_(rows, model.segments + 1),
      most_yield2_(stress_limit > 0 ? stress_limit * stress_limit
                                    : std::numeric_limits<double>::infinity()) {
    constexpr double pi = std::numbers::pi;
    for (std::size_t k = 0; k < model.segments; ++k) {
        const SectionProperties& s = scene.mesh.segment[k];
        const double h = scene.mesh.length[k];
        limits_.row(axial_yield)[k] = 1 / s.yield.axial;
        limits_.row(bending_yield)[k] = 1 / s.yield.bending;
        limits_.row(torsion_yield)[k] = 1 / s.yield.torsion;
        limits_.row(inverse_pitch)[k] = h * h / (8 * pi * pi * s.bending_stiffness);
    }
}

GuardReading Guards::read(const Table<DirectorRow>& rod, const Table<SegmentRow>& segments,
                          const JarState& jar, std::size_t block) const {
    const BlockReadings all = readings(rod, segments, jar, block);
    GuardReading worst;
    for (std::size_t k = 0; k < all.count; ++k) {
        worst.cosine = std::min(worst.cosine, all.cosine[k]);
        worst.yield2 = std::max(worst.yield2, all.yield2[k]);
        worst.coarseness = std::max(worst.coarseness, all.coarseness[k]);
    }
    return worst;
}

bool Guards::stops(const GuardReading& reading) const {
    return reading.cosine < 0 || reading.yield2 > most_yield2_ ||
           reading.coarseness > most_coarseness;
}

std::string Guards::place(std::size_t segment) const {
    return fmt::format("segment {} ({:.1f} m along the string)", segment,
                       scene_.mesh.segment_s[segment]);
}

/// What a segment of a given coarseness bears, and the mesh that it asks for.
std::string Guards::buckle(double coarseness, std::size_t segment) const {
    const double h = scene_.mesh.length[segment];
    const double compression = coarseness / limits_.row(inverse_pitch)[segment];
    const double pitch = h / std::sqrt(coarseness);
    return fmt::format(
        "a compression of {:.4g} kN, under which a helix has a pitch of {:.3g} m, and is {:.3g} m "
        "long; use segments of at most {:.2g} m",
        compression / 1000, pitch, h, pitch / 8);
}

std::optional<std::string> Guards::describe(const Table<DirectorRow>& rod,
                                            const Table<SegmentRow>& segments, const JarState& jar,
                                            double time) const {
    for (std::size_t block = 0; block < blocks_for(model_.segments); ++block) {
        const BlockReadings all = readings(rod, segments, jar, block);
        for (std::size_t k = 0; k < all.count; ++k) {
            const GuardReading one = all.of(k);
            if (!stops(one)) continue;
            const std::string where = place(all.first + k);
            if (one.cosine < 0) {
                return fmt::format(
                    "{} turned past 90 degrees at t = {:.6g} s: the mesh is too coarse for this "
                    "motion; use more segments",
                    where, time);
            }
            if (one.yield2 > most_yield2_) {
                return fmt::format(
                    "the stress in {} reached {:.3g} times the yield strength at t = {:.6g} s: the "
                    "pipe would have failed; lower the loads, or raise run.stress_limit",
                    where, std::sqrt(one.yield2), time);
            }
            return fmt::format("the mesh is too coarse for the buckle at t = {:.6g} s: {} bears {}",
                               time, where, buckle(one.coarseness, all.first + k));
        }
    }
    return std::nullopt;
}

void Guards::follow(CoarsestSegment& coarsest, const GuardReading& reading,
                    const Table<DirectorRow>& rod, const Table<SegmentRow>& segments,
                    const JarState& jar, std::size_t block, double time) const {
    if (reading.coarseness <= std::max(coarsest.coarseness, fair_coarseness)) return;
    const BlockReadings all = readings(rod, segments, jar, block);
    const double* worst = std::max_element(all.coarseness, all.coarseness + all.count);
    coarsest = {*worst, static_cast<std::int64_t>(all.first) + (worst - all.coarseness), time};
}

CoarsestSegment coarser_of(const CoarsestSegment& one, const CoarsestSegment& other) {
    if (one.coarseness != other.coarseness) return one.coarseness > other.coarseness ? one : other;
    return std::pair(one.time, one.segment) <= std::pair(other.time, other.segment) ? one : other;
}

std::optional<std::string> Guards::warn(const CoarsestSegment& coarsest) const {
    if (coarsest.coarseness <= fair_coarseness) return std::nullopt;
    const auto segment = static_cast<std::size_t>(coarsest.segment);
    return fmt::format("the mesh resolves the buckle poorly: at t = {:.6g} s {} bore {}",
                       coarsest.time, place(segment), buckle(coarsest.coarseness, segment));
}

}  // namespace drillstrand

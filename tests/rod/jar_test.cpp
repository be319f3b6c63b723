// What a jar's segment bears while its halves slide: the gradient of the energy of a segment that
// is shorter by the slide, and no viscous force against sliding.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>
#include <string>

#include "drillstrand/scene.hpp"
#include "model/segment_strain.hpp"
#include "rod/director_state.hpp"
#include "support/dice.hpp"
#include "support/run_case.hpp"

namespace drillstrand {
namespace {

using Eigen::Vector3d;

constexpr std::size_t jar = 2;
constexpr double travel = 0.2;

Scene jarred(const std::string& damping) {
    return build_scene(test::case_from(R"(
        [[string.component]]
        length = 20
        outer_diameter = 0.127
        inner_diameter = 0.1
        density = 7850
        youngs_modulus = 2e11
        [string.component.jar]
        up_force = 1e5
        up_travel = 0.2
        down_force = 1e5
        down_travel = 0.1
        [mesh]
        segments = 5
        [damping]
        )" + damping));
}

/// A rod bent and strained at random, whose jar is released.
DirectorState bent_state(const DirectorString& string, double slide) {
    test::Dice dice(3);
    const auto any = [&](double size) {
        return Vector3d(dice.between(-size, size), dice.between(-size, size),
                        dice.between(-size, size));
    };
    DirectorState state = initial_state(string);
    for (std::size_t k = 0; k <= string.model.segments; ++k) {
        const Vector3d t = state.rod.vector(DirectorRow::director, k) + any(0.05);
        state.rod.set(DirectorRow::director, k, t.normalized());
        state.rod.set(DirectorRow::last_director, k, t.normalized());
        state.rod.set(DirectorRow::velocity, k, any(1));
        state.rod.set(DirectorRow::angular_velocity, k, any(0.1));
        Vector3d x = state.rod.vector(DirectorRow::position, k) + any(0.01);
        if (k > jar) x += slide * Vector3d::UnitZ();
        state.rod.set(DirectorRow::position, k, x);
    }
    state.jar.released = 1;
    state.jar.slide = slide;
    return state;
}

/// The jar's segment when its halves are apart by a slide, but for its torsion (J).
double energy(const DirectorString& string, const Table<DirectorRow>& rod, double slide) {
    const double h = string.scene.mesh.length[jar];
    const SegmentStiffness stiffness(string.scene.mesh.segment[jar], h);
    const auto at = [&](DirectorRow row, std::size_t node) {
        return triple(rod.vector(row, node));
    };
    const Triple ta = at(DirectorRow::director, jar);
    const Triple tb = at(DirectorRow::director, jar + 1);
    const SegmentBend arc(ta, tb);
    const SegmentChord chord(at(DirectorRow::position, jar), at(DirectorRow::position, jar + 1),
                             1 / h, ta, tb, arc.inverse_both());
    const double bend = arc.factor();
    return h * BeamColumn(stiffness, chord, bend * bend * dot(arc.turn, arc.turn), slide / h)
                   .whole_energy(stiffness);
}

/// What the slide changes of what a row of the jar's segment holds.
Vector3d change_by_slide(const DirectorString& string, const DirectorState& state, SegmentRow row) {
    Table<SegmentRow> latched(string.model.segments + 1);
    Table<SegmentRow> apart = latched;
    for (const BlockSpan span : string.spans) {
        string_segments(string, {}, state.rod, latched, span, 0);
        string_segments(string, state.jar, state.rod, apart, span, 0);
    }
    return apart.vector(row, jar) - latched.vector(row, jar);
}

class JarAt : public testing::TestWithParam<double> {};

TEST_P(JarAt, BearsTheGradientOfTheEnergyThatItsSlideLeaves) {
    const Scene scene = jarred("kelvin_voigt = 0");
    const DirectorString string(scene);
    const DirectorState state = bent_state(string, GetParam());
    ASSERT_EQ(string.jar.segment(), jar);
    const auto gradient = [&](DirectorRow row, std::size_t node) {
        Vector3d result;
        for (int i = 0; i < 3; ++i) {
            const auto energy_with = [&](double change) {
                Table<DirectorRow> rod = state.rod;
                rod.set(row, node, rod.vector(row, node) + change * Vector3d::Unit(i));
                return energy(string, rod, state.jar.slide) - energy(string, rod, 0);
            };
            constexpr double step = 1e-5;
            result[i] = (energy_with(step) - energy_with(-step)) / (2 * step);
        }
        return result;
    };
    const auto across = [&](std::size_t node, const Vector3d& v) {
        const Vector3d t = state.rod.vector(DirectorRow::director, node);
        return Vector3d(v - v.dot(t) * t);
    };
    const Vector3d pull = change_by_slide(string, state, SegmentRow::pull);
    EXPECT_LT((pull - gradient(DirectorRow::position, jar + 1)).norm(), 1e-6 * pull.norm());
    EXPECT_LT((pull + gradient(DirectorRow::position, jar)).norm(), 1e-6 * pull.norm());
    EXPECT_EQ(change_by_slide(string, state, SegmentRow::last_pull), pull);
    const Vector3d first = change_by_slide(string, state, SegmentRow::first_lean);
    const Vector3d last = change_by_slide(string, state, SegmentRow::last_lean);
    EXPECT_LT(across(jar, first + gradient(DirectorRow::director, jar)).norm(),
              1e-6 * first.norm());
    EXPECT_LT(across(jar + 1, last + gradient(DirectorRow::director, jar + 1)).norm(),
              1e-6 * last.norm());
}

INSTANTIATE_TEST_SUITE_P(Slides, JarAt, testing::Values(0.13, travel, -0.07));

TEST(SlidingJar, IsNotHeldAlongItsAxisByAnyDamping) {
    for (const std::string damping : {"kelvin_voigt = 1e-3", "internal = 3"}) {
        const Scene scene = jarred(damping);
        const DirectorString string(scene);
        for (const bool is_free : {true, false}) {
            const DirectorState state = bent_state(string, is_free ? 0.5 * travel : travel);
            const Vector3d chord = state.rod.vector(DirectorRow::position, jar + 1) -
                                   state.rod.vector(DirectorRow::position, jar);
            const auto rows_at = [&](double speed) {
                DirectorState faster = state;
                faster.rod.set(
                    DirectorRow::velocity, jar + 1,
                    state.rod.vector(DirectorRow::velocity, jar + 1) + speed * chord.normalized());
                Table<SegmentRow> segments(string.model.segments + 1);
                for (const BlockSpan span : string.spans)
                    string_segments(string, state.jar, faster.rod, segments, span, 0);
                Eigen::VectorXd values(12);
                values << segments.vector(SegmentRow::viscous_pull, jar),
                    segments.vector(SegmentRow::viscous_couple, jar),
                    segments.vector(SegmentRow::viscous_lean, jar),
                    segments.vector(SegmentRow::drag_force, jar);
                return values;
            };
            const Eigen::VectorXd slow = rows_at(0);
            const double change = (rows_at(5) - slow).norm();
            if (is_free) {
                EXPECT_LT(change, 1e-9 * slow.norm()) << damping;
            } else {
                EXPECT_GT(change, 0.1 * slow.norm()) << damping;
            }
        }
    }
}

}  // namespace
}  // namespace drillstrand

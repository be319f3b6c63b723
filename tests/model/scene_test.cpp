/// What a scene makes of a case for each integrator.
#include "drillstrand/scene.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/run_case.hpp"

namespace drillstrand {
namespace {

Case pipe_of_8_segments(const std::string& integrator) {
    return test::case_from(R"(
[[string.component]]
length = 24
outer_diameter = 0.1397
inner_diameter = 0.1155
density = 7850
youngs_modulus = "200 GPa"
[mesh]
segments = 8
[run]
duration = 1
integrator = ")" + integrator +
                           "\"\n");
}

TEST(Scene, LumpsTheStringAsItsIntegratorBendsIt) {
    Case input = pipe_of_8_segments("leapfrog");
    EXPECT_DOUBLE_EQ(build_scene(input).mesh.cell.front(), 1.5);
    EXPECT_DOUBLE_EQ(build_scene(input).mesh.cell.back(), 1.25);
    input.head.motion = HeadMotion::free;
    EXPECT_DOUBLE_EQ(build_scene(input).mesh.cell.front(), 1.25);
    input.run.integrator = IntegratorKind::dormand_prince;
    EXPECT_DOUBLE_EQ(build_scene(input).mesh.cell.front(), 1.5);
    EXPECT_DOUBLE_EQ(build_static_scene(input).mesh.cell.front(), 1.25);
}

TEST(RotaryInertia, OfThePapersMethodIsThatOfTheSectionsOrOfRigidPieces) {
    Case input = pipe_of_8_segments("dormand-prince");
    Scene scene = build_scene(input);
    const SectionProperties& pipe = scene.mesh.node[4];
    EXPECT_EQ(scene.inertia[4], pipe.inertia);
    input.mesh.segment_inertia = true;
    EXPECT_DOUBLE_EQ(build_scene(input).inertia[4], pipe.inertia + pipe.mass * 9 / 12);
}

TEST(RotaryInertia, OfTheLeapfrogTurnsNodesLessFastThanAxialWaves) {
    Case input = pipe_of_8_segments("leapfrog");
    const Scene scene = build_scene(input);
    const SectionProperties& pipe = scene.mesh.segment[4];
    const double h2 = 9;
    const double k = 1 / (1 + 12 * pipe.bending_stiffness / (pipe.shear_stiffness * h2));
    const double axial = 4 * pipe.axial_stiffness / (pipe.mass * h2);
    const double turning = 12 * k * pipe.bending_stiffness / (scene.inertia[4] * h2);
    EXPECT_NEAR(turning / axial, 3. / 4, 1e-12);
    EXPECT_NEAR(scene.inertia[4] / (4 * k * pipe.inertia), 1, 1e-12);
    input.mesh.segment_inertia = true;
    EXPECT_EQ(build_scene(input).inertia[4], scene.inertia[4]) << "has no effect";
}

TEST(RotaryInertia, OfTheLeapfrogIsThatOfTheSectionsOnFineMeshes) {
    Case input = pipe_of_8_segments("leapfrog");
    input.mesh.segments = 200;  // 0.12 m, less than four radii of gyration
    const Scene scene = build_scene(input);
    EXPECT_EQ(scene.inertia[4], scene.mesh.node[4].inertia);
}

TEST(RotaryInertia, OfTheLeapfrogIsThatOfARigidPieceAboutItsEndAtABitWithATorque) {
    Case input = pipe_of_8_segments("leapfrog");
    const Scene free = build_scene(input);
    input.bit.torque = ScalarSchedule({0, 1}, {0, 100});
    const Scene twisted = build_scene(input);
    EXPECT_DOUBLE_EQ(twisted.inertia.back(), twisted.mesh.node.back().mass * 9 / 3);
    EXPECT_EQ(twisted.inertia[7], free.inertia[7]);
}

TEST(RotaryInertia, OfTheLeapfrogIsThatOfRigidPiecesUnderStrongInternalDampingOfRotation) {
    Case input = pipe_of_8_segments("leapfrog");
    const Scene undamped = build_scene(input);
    input.damping.internal.rotation = 0.1;  // 7e-5 of the speed of axial waves
    EXPECT_EQ(build_scene(input).inertia, undamped.inertia);
    input.damping.internal.rotation = 10;
    const Scene scene = build_scene(input);
    const SectionProperties& pipe = scene.mesh.node[4];
    EXPECT_DOUBLE_EQ(scene.inertia[4], pipe.inertia + pipe.mass * 9 / 12);
}

}  // namespace
}  // namespace drillstrand

// Pressures of mud in motion and the forces that it exerts along a string.
#include "drillstrand/hydraulics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pipe = 0.07;    // m
constexpr double bore = 0.06;    // m
constexpr double length = 1000;  // m

/// A pipe of 0.14 m by 0.12 m in a vertical hole; g = 9.81 m/s2.
Case hanging_pipe(const FluidCase& fluid, double hole) {
    Case input;
    input.gravity = 9.81;
    input.well = WellCase{{{0, 0, 0}, {2000, 0, 0}}, {{2000, 2 * hole}}};
    input.fluid = fluid;
    Component component;
    component.length = length;
    component.outer_diameter = 2 * pipe;
    component.inner_diameter = 2 * bore;
    component.linear_density = 31.8557;
    component.youngs_modulus = 200e9;
    input.string.components = {component};
    input.mesh.segments = 50;
    return input;
}

FluidCase thick_mud() {
    FluidCase fluid;
    fluid.density = 1200;
    fluid.viscosity = 0.2;
    return fluid;
}

TEST(Hydraulics, AtRestArePressuresOfTheColumnAlone) {
    const Scene scene = build_scene(hanging_pipe(thick_mud(), 0.11));
    const Hydraulics flow = hydraulics_of(scene, {});
    EXPECT_NEAR(flow.bit_pressure, 1200 * 9.81 * length, 1e-6);
    EXPECT_NEAR(flow.inside_pressure.back(), flow.bit_pressure, 1e-6);
    EXPECT_NEAR(flow.standpipe_pressure, 0, 1e-6);
    EXPECT_NEAR(flow.equivalent_density, 1200, 1e-9);
    EXPECT_EQ(flow.axial_force, 0);
    EXPECT_TRUE(mud_loads(scene, {}).empty());
}

TEST(Hydraulics, OfLaminarFlowHaveThePressuresOfPoiseuille) {
    FluidCase fluid = thick_mud();
    fluid.flow_rate = 2e-3;
    const Scene scene = build_scene(hanging_pipe(fluid, 0.11));
    const Hydraulics flow = hydraulics_of(scene, mud_motion(scene));
    const double inside = 8 * 0.2 * 2e-3 / (pi * std::pow(bore, 4)) * length;
    EXPECT_NEAR(flow.inside_loss / inside, 1, 1e-9);
    // a slot is within 1 % of an annulus of this width
    const double log_ratio = std::log(0.11 / pipe);
    const double r2 = pipe * pipe;
    const double h2 = 0.11 * 0.11;
    const double annulus =
        8 * 0.2 * 2e-3 / (pi * (h2 - r2) * (h2 + r2 - (h2 - r2) / log_ratio)) * length;
    EXPECT_NEAR(flow.annulus_loss / annulus, 1, 0.01);
    EXPECT_NEAR(flow.standpipe_pressure, flow.inside_loss + flow.annulus_loss, 1e-4);
    EXPECT_NEAR(flow.equivalent_density, 1200 + flow.annulus_loss / (9.81 * length), 1e-9);
    EXPECT_EQ(flow.turbulent_inside, 0);
}

// Pressure on the pipe's end and shear on its wall: together pi G (Rw^2 - R^2)/(2 ln(Rw/R)), G the
// exact gradient of a Newtonian fluid.
TEST(Hydraulics, LiftThePipeByPressureAndByShear) {
    FluidCase fluid = thick_mud();
    fluid.flow_rate = 2e-3;
    for (const double hole : {0.075, 0.09, 0.11}) {
        const Scene scene = build_scene(hanging_pipe(fluid, hole));
        const Hydraulics flow = hydraulics_of(scene, mud_motion(scene));
        const double r2 = pipe * pipe;
        const double h2 = hole * hole;
        const double log_ratio = std::log(hole / pipe);
        const double gradient =
            8 * 0.2 * 2e-3 / (pi * (h2 - r2) * (h2 + r2 - (h2 - r2) / log_ratio));
        const double lift = pi * gradient * (h2 - r2) / (2 * log_ratio) * length;
        EXPECT_NEAR(-flow.axial_force / lift, 1, 0.035);
    }
}

// The exact flow of a Newtonian fluid around a closed pipe that moves in concentric cylinders.
TEST(Hydraulics, OfATripAreThoseOfTheMudThatThePipeDisplacesAndDrags) {
    for (const double hole : {0.075, 0.09, 0.11}) {
        const Scene scene = build_scene(hanging_pipe(thick_mud(), hole));
        const double speed = 0.1;
        const Hydraulics flow = hydraulics_of(scene, mud_motion(scene, speed));
        const double r2 = pipe * pipe;
        const double h2 = hole * hole;
        const double log_ratio = std::log(hole / pipe);
        // displaced upward, and dragged down by the mean of ln(Rw/r)/ln(Rw/R) over the annulus
        const double displaced = pi * r2 * speed;
        const double dragged = speed * pi * ((h2 - r2) / (2 * log_ratio) - r2);
        const double gradient =
            8 * 0.2 * (displaced + dragged) / (pi * (h2 - r2) * (h2 + r2 - (h2 - r2) / log_ratio));
        EXPECT_NEAR(flow.annulus_loss / (gradient * length), 1, 0.01);
        const double lift = pi * gradient * (h2 - r2) / (2 * log_ratio) * length +
                            2 * pi * 0.2 * speed / log_ratio * length;
        EXPECT_NEAR(-flow.axial_force / lift, 1, 0.035);
        // swab is the opposite of surge
        const Hydraulics out = hydraulics_of(scene, mud_motion(scene, -speed));
        EXPECT_DOUBLE_EQ(out.annulus_loss, -flow.annulus_loss);
        EXPECT_DOUBLE_EQ(out.axial_force, -flow.axial_force);
        EXPECT_EQ(flow.inside_loss, 0);
        // the mud in a closed pipe rests on its end
        EXPECT_EQ(flow.standpipe_pressure, 0);
        EXPECT_NEAR(flow.inside_pressure.back(), 1200 * 9.81 * length, 1e-6);
    }
}

// Water through three nozzles of 12/32 in, 400 gal/min: Bernoulli's loss over C_d^2 = 0.95^2, and
// the thrust of the jets, rho Q v.
TEST(Hydraulics, OfTheBitAreThoseOfItsNozzles) {
    FluidCase fluid;
    fluid.density = 1000;
    fluid.viscosity = 1e-3;
    fluid.flow_rate = 400 * 0.003785411784 / 60;
    fluid.nozzle_area = 3 * pi / 4 * std::pow(12.0 / 32 * 0.0254, 2);
    const Scene scene = build_scene(hanging_pipe(fluid, 0.11));
    const Hydraulics flow = hydraulics_of(scene, mud_motion(scene));
    const double speed = fluid.flow_rate / fluid.nozzle_area;
    EXPECT_NEAR(flow.bit_loss, 500 * speed * speed / (0.95 * 0.95), 1e-3);
    EXPECT_NEAR(flow.jet_force, 1000 * fluid.flow_rate * speed, 1e-6);
    // field units (Bourgoyne et al. 1986): 8.311e-5 rho q^2/(C_d^2 A^2) psi with ppg, gal/min, in2
    const double area = fluid.nozzle_area / (0.0254 * 0.0254);
    const double psi = 8.311e-5 * (1000 / 119.826427) * 400 * 400 / (0.95 * 0.95 * area * area);
    EXPECT_NEAR(flow.bit_loss / 6894.757 / psi, 1, 1e-3);
    FluidCase open = fluid;
    open.nozzle_area = 0;
    const Scene without = build_scene(hanging_pipe(open, 0.11));
    const Hydraulics free = hydraulics_of(without, mud_motion(without));
    EXPECT_NEAR(flow.axial_force, free.axial_force - flow.jet_force, 1e-6);
    EXPECT_NEAR(flow.standpipe_pressure, free.standpipe_pressure + flow.bit_loss, 1e-3);
    EXPECT_GT(flow.turbulent_inside, 0.99);
}

TEST(Hydraulics, NeedAWellAndAFluid) {
    Case input = hanging_pipe(thick_mud(), 0.11);
    input.fluid.reset();
    EXPECT_THROW(static_cast<void>(hydraulics_of(build_scene(input), {})), std::invalid_argument);
}

}  // namespace
}  // namespace drillstrand

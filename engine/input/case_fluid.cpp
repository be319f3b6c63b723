#include <initializer_list>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

/// A viscosity, or the constants of a fluid that thins or yields.
void read_rheology(const Table& table, bool drags, FluidCase& fluid) {
    table.refuse_both("viscosity", "consistency");
    if (const std::optional<Value> consistency = table.find("consistency")) {
        fluid.viscosity = consistency->number(plausible::consistency);
        fluid.flow_index = table.number("flow_index", fluid.flow_index, plausible::flow_index);
        fluid.yield_stress = table.quantity("yield_stress", dimension::pressure, fluid.yield_stress,
                                            plausible::yield_stress);
        return;
    }
    for (const std::string_view key : {"flow_index", "yield_stress"})
        refuse_key(table, key, "fluid.consistency");
    if (drags || table.find("viscosity")) {
        fluid.viscosity =
            table.require("viscosity", "a viscosity such as \"1 cP\", or drag = false")
                .quantity(dimension::viscosity, plausible::viscosity);
    }
}

/// What a pump and trips need.
void read_flow(const Table& table, FluidCase& fluid) {
    if (const std::optional<Value> rate = table.find("flow_rate", "0")) {
        fluid.flow_rate = rate->quantity(dimension::flow_rate, plausible::flow_rate);
        if (fluid.flow_rate > 0 && fluid.inside == InsideOfPipe::empty)
            rate->fail("goes through a pipe that is empty; expected fluid.inside = \"fluid\"");
        if (fluid.flow_rate > 0 && fluid.viscosity == 0)
            rate->fail("needs friction to lose pressure; expected fluid.viscosity above 0");
    }
    if (fluid.flow_rate > 0)
        fluid.nozzle_area =
            table.quantity("nozzle_area", dimension::area, 0, plausible::area_or_none);
    else
        refuse_key(table, "nozzle_area", "fluid.flow_rate");
    if (const std::optional<Value> speed = table.find("trip_speed", "0")) {
        fluid.trip_speed = speed->quantity(dimension::speed, plausible::speed_or_none);
        if (fluid.trip_speed > 0 && fluid.viscosity == 0)
            speed->fail("needs friction to press on mud; expected fluid.viscosity above 0");
    }
}

}  // namespace

std::optional<FluidCase> read_fluid(const Table& root) {
    const std::optional<Value> value = root.find("fluid");
    if (!value) return std::nullopt;
    const Table table(
        *value, {"density", "viscosity", "consistency", "flow_index", "yield_stress", "flow_rate",
                 "nozzle_area", "trip_speed", "inside", "drag", "regime", "drag_coefficient",
                 "contact_drag", "axial_drag", "film", "added_mass"});
    FluidCase fluid;
    fluid.density = table.require("density", "a density such as \"10 ppg\"")
                        .quantity(dimension::density, plausible::density);
    fluid.drag = table.boolean("drag", fluid.drag);
    fluid.inside = table.choice<InsideOfPipe>(
        "inside", fluid.inside, {{"fluid", InsideOfPipe::fluid}, {"empty", InsideOfPipe::empty}});
    // without a well the fluid is still: it buoys the string and does not drag it
    const bool drags = fluid.drag && root.find("well");
    if (!drags)
        for (const std::string_view key : {"consistency", "flow_rate", "trip_speed"})
            refuse_key(table, key, "a well and fluid.drag = true");
    read_rheology(table, drags, fluid);
    read_flow(table, fluid);
    fluid.regime = table.choice<FlowRegime>(
        "regime", fluid.regime,
        {{"inertial", FlowRegime::inertial}, {"laminar", FlowRegime::laminar}});
    fluid.drag_coefficient =
        table.number("drag_coefficient", fluid.drag_coefficient, plausible::drag_coefficient);
    if (fluid.regime == FlowRegime::laminar)
        refuse_key(table, "drag_coefficient", "regime = \"inertial\"");
    fluid.contact_drag = table.boolean("contact_drag", fluid.contact_drag);
    fluid.axial_drag = table.choice<AxialDrag>(
        "axial_drag", fluid.axial_drag,
        {{"eccentric", AxialDrag::eccentric}, {"concentric", AxialDrag::concentric}});
    fluid.film = table.number("film", fluid.film, {.low = 1e-6, .high = 1, .high_open = true});
    fluid.added_mass = table.boolean("added_mass", fluid.added_mass);
    return fluid;
}

}  // namespace drillstrand

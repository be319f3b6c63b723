#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

// Dimension of a damping coefficient of velocity, N s/m, and of rotation, N m s.
constexpr Dimension damping_coefficient{1, 0, -1};
constexpr Dimension rotation_damping{1, 2, -1};
constexpr Dimension volume{0, 3, 0};

}  // namespace

void refuse_key(const Table& table, std::string_view key, std::string_view choice) {
    if (const std::optional<Value> value = table.find(key))
        value->fail(fmt::format("has no effect; expected it with {}", choice));
}

FrictionCoefficients read_friction(const Value& value) {
    if (!value.is_list()) {
        const double both = value.number(plausible::friction);
        return {both, both};
    }
    const std::vector<Value> parts = value.elements("a number or [axial, azimuthal]");
    if (parts.size() != 2) {
        value.fail(
            fmt::format("has {} entries; expected a number or [axial, azimuthal]", parts.size()));
    }
    return {parts[0].number(plausible::friction), parts[1].number(plausible::friction)};
}

FrictionCoefficients read_dynamic_friction(const std::optional<Value>& value,
                                           const FrictionCoefficients& standing,
                                           const FrictionCoefficients& usual) {
    if (!value) {
        return {std::min(usual.axial, standing.axial),
                std::min(usual.azimuthal, standing.azimuthal)};
    }
    const FrictionCoefficients dynamic = read_friction(*value);
    const auto check = [&](double sliding, double sticking) {
        if (sliding <= sticking) return;
        value->fail(fmt::format("is {}; expected at most static_friction, {}", sliding, sticking));
    };
    check(dynamic.axial, standing.axial);
    check(dynamic.azimuthal, standing.azimuthal);
    return dynamic;
}

namespace {

/// Fails where a key stands that only another law of the bit uses.
void refuse_keys_of_other_laws(const Table& table, BitLaw law) {
    const auto refuse = [&](BitLaw its, std::string_view name,
                            std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys)
            if (law != its) refuse_key(table, key, fmt::format("bit.law = \"{}\"", name));
    };
    refuse(BitLaw::prescribed, "prescribed", {"torque", "smoothing_speed"});
    refuse(BitLaw::stribeck, "stribeck", {"static_torque", "dynamic_torque", "decay_speed"});
    refuse(BitLaw::cutting, "cutting",
           {"blades", "intrinsic_specific_energy", "inclination_number", "wear_length",
            "contact_strength", "geometry"});
    refuse(BitLaw::roller_cone, "roller_cone",
           {"lobes", "lobe_height", "rock_stiffness", "specific_energy"});
    if (law == BitLaw::cutting || law == BitLaw::roller_cone) {
        refuse_key(table, "weight", "another bit.law; by this one it is what the rock asks for");
    } else {
        for (const std::string_view key : {"feed", "off_bottom"})
            refuse_key(table, key, "bit.law = \"cutting\" or \"roller_cone\"");
    }
    if (law == BitLaw::stribeck) refuse_key(table, "friction", "another bit.law");
}

/// Friction in place of a torque that is prescribed.
void read_bit_friction(const Table& table, BitCase& bit) {
    const Value largest = table.require("static_torque", "a torque such as \"8 kN m\"");
    bit.static_torque = largest.quantity(dimension::moment, plausible::load_or_none);
    bit.dynamic_torque = bit.static_torque;
    if (const std::optional<Value> moving = table.find("dynamic_torque")) {
        bit.dynamic_torque = moving->quantity(dimension::moment, plausible::load_or_none);
        if (bit.dynamic_torque > bit.static_torque)
            moving->fail(fmt::format("is above bit.static_torque, {:g} N m; expected at most that",
                                     bit.static_torque));
    }
    bit.decay_speed =
        table.quantity("decay_speed", dimension::frequency, bit.decay_speed, plausible::decay);
}

/// The rock, and the blades that cut it.
void read_cutting(const Table& table, BitCase& bit) {
    CuttingCase& cutting = bit.cutting;
    constexpr int most_blades = 100;
    cutting.blades = table.whole_number("blades", cutting.blades, 1, most_blades);
    cutting.specific_energy =
        table.require("intrinsic_specific_energy", "that of the rock, such as \"60 MPa\"")
            .quantity(dimension::pressure, plausible::rock_strength);
    cutting.inclination =
        table.number("inclination_number", cutting.inclination, plausible::cutter_inclination);
    cutting.wear_flat = table.quantity("wear_length", dimension::length, cutting.wear_flat,
                                       plausible::length_or_none);
    cutting.contact_strength = cutting.specific_energy;
    if (const std::optional<Value> strength = table.find("contact_strength"))
        cutting.contact_strength =
            strength->quantity(dimension::pressure, plausible::rock_strength);
    const double geometry = table.number("geometry", 1, plausible::bit_geometry);
    if (const std::optional<Value> friction = table.find("friction"))
        cutting.flat_friction = friction->number(plausible::friction) * geometry;
}

/// The rock, and the lobes that the cones leave in it.
void read_roller_cone(const Table& table, BitCase& bit) {
    RollerConeCase& cone = bit.roller_cone;
    constexpr int most_lobes = 100;
    cone.lobes = table.whole_number("lobes", cone.lobes, 1, most_lobes);
    cone.lobe_height = table.quantity("lobe_height", dimension::length, cone.lobe_height,
                                      plausible::length_or_none);
    cone.stiffness = table.require("rock_stiffness", "that of rock and teeth, such as \"30e6 N/m\"")
                         .quantity(dimension::stiffness, plausible::line_stiffness);
    cone.specific_energy = table.require("specific_energy", "that of the rock, such as \"200 MPa\"")
                               .quantity(dimension::pressure, plausible::rock_strength);
    bit.friction = table.require("friction", "that of the bit on the bottom, such as 0.3")
                       .number(plausible::friction);
}

/// How the rock comes up to a bit that drills it.
void read_drilling(const Table& table, BitCase& bit) {
    bit.feed = table.scalar_schedule("feed", dimension::speed, plausible::speed);
    bit.off_bottom =
        table.quantity("off_bottom", dimension::length, bit.off_bottom, plausible::length_or_none);
}

/// The law of the rock, with the keys that it takes.
void read_bit_law(const Table& table, BitCase& bit, const StringCase& string) {
    bit.law = table.choice<BitLaw>("law", bit.law,
                                   {{"prescribed", BitLaw::prescribed},
                                    {"stribeck", BitLaw::stribeck},
                                    {"cutting", BitLaw::cutting},
                                    {"roller_cone", BitLaw::roller_cone}});
    refuse_keys_of_other_laws(table, bit.law);
    if (const std::optional<Value> radius = table.find("radius"))
        bit.radius = radius->quantity(dimension::length, plausible::diameter);
    if (bit.law == BitLaw::prescribed) {
        if (const std::optional<Value> friction = table.find("friction"))
            bit.friction = friction->number(plausible::friction);
    }
    if (bit.law == BitLaw::stribeck) read_bit_friction(table, bit);
    if (bit.law == BitLaw::cutting) read_cutting(table, bit);
    if (bit.law == BitLaw::roller_cone) read_roller_cone(table, bit);
    if (bit.drills()) read_drilling(table, bit);
    if ((bit.drills() || bit.friction) && bit.radius == 0 &&
        string.components.back().outer_diameter == 0)
        table.require(bit.drills() ? "law" : "friction", "")
            .fail(
                "needs the bit's radius; expected bit.radius, or an outer_diameter in the last "
                "component");
}

/// A mud motor that turns the bit. What it displaces follows from what is pumped through it, if
/// the case does not say it.
MotorCase read_motor(const Table& table, double flow_rate) {
    const Table motor =
        table.subtable("motor", {"stall_torque", "no_load_speed", "exponent", "displacement"});
    MotorCase result;
    result.stall_torque = motor.require("stall_torque", "a torque such as \"12 kN m\"")
                              .quantity(dimension::moment, plausible::motor_torque);
    result.no_load_speed = motor.require("no_load_speed", "a rate such as \"108 rpm\"")
                               .quantity(dimension::frequency, plausible::motor_speed);
    result.exponent = motor.number("exponent", result.exponent, plausible::motor_exponent);
    if (flow_rate > 0 && !motor.find("displacement"))
        result.displacement = 2 * std::numbers::pi * flow_rate / result.no_load_speed;
    else
        result.displacement =
            motor
                .require("displacement",
                         "what a turn of the rotor displaces, such as \"20 L\", or fluid.flow_rate")
                .quantity(volume, plausible::motor_displacement);
    return result;
}

}  // namespace

BitCase read_bit(const Table& root, const StringCase& string,
                 const std::optional<FluidCase>& fluid) {
    const Table table = root.subtable("bit", {"law",
                                              "weight",
                                              "torque",
                                              "friction",
                                              "smoothing_speed",
                                              "direction",
                                              "static_torque",
                                              "dynamic_torque",
                                              "decay_speed",
                                              "inertia",
                                              "mass",
                                              "motor",
                                              "radius",
                                              "blades",
                                              "intrinsic_specific_energy",
                                              "inclination_number",
                                              "wear_length",
                                              "contact_strength",
                                              "geometry",
                                              "lobes",
                                              "lobe_height",
                                              "rock_stiffness",
                                              "specific_energy",
                                              "feed",
                                              "off_bottom",
                                              "contact_length",
                                              "force",
                                              "dead_moment",
                                              "moment"});
    table.refuse_both("torque", "friction");

    const bool in_well = root.find("well").has_value();
    BitCase bit;
    bit.torque = table.scalar_schedule("torque", dimension::moment, plausible::load_or_none);
    read_bit_law(table, bit, string);
    bit.inertia = table.quantity("inertia", dimension::moment_of_inertia, bit.inertia,
                                 plausible::bit_inertia);
    bit.mass = table.quantity("mass", dimension::mass, bit.mass, plausible::bit_mass);
    if (const std::optional<Value> motor = table.find("motor")) {
        bit.motor = read_motor(table, fluid ? fluid->flow_rate : 0);
        if (bit.inertia == 0)
            motor->fail("turns a bit without inertia; expected bit.inertia, of bit and rotor");
        refuse_key(table, "smoothing_speed", "a bit without a motor");
    }
    // the rock pushes, it does not pull
    bit.weight = table.scalar_schedule("weight", dimension::force, plausible::load_or_none);
    bit.smoothing_speed =
        table.quantity("smoothing_speed", dimension::frequency,
                       unit_factor("rpm", dimension::frequency), plausible::slow_rotation);
    bit.direction = table.choice<BitDirection>(
        "direction", in_well ? BitDirection::well : BitDirection::follower,
        {{"well", BitDirection::well}, {"follower", BitDirection::follower}});
    if (bit.direction == BitDirection::well && !in_well) {
        table.require("direction", "").fail("is \"well\" without a well; expected \"follower\"");
    }
    bit.contact_length = table.quantity("contact_length", dimension::length, bit.contact_length,
                                        plausible::length_or_none);
    if (bit.contact_length > 0 && !in_well) {
        table.require("contact_length", "").fail("has no effect; expected it with a well");
    }
    bit.force = table.vector_schedule("force", dimension::force, plausible::load);
    bit.dead_moment = table.vector_schedule("dead_moment", dimension::moment, plausible::load);
    bit.moment = table.vector_schedule("moment", dimension::moment, plausible::load);
    return bit;
}

namespace {

// Of Hertz's wall that are left out (Pa/m^0.5).
constexpr double hertz_stiffness = 1e9;
constexpr double hertz_point_stiffness = 2e10;

/// Under the pipe and under contact points, to which the wall is as firm at least.
void read_stiffnesses(const Table& table, const std::optional<Value>& normal,
                      ContactCase& contact) {
    if (normal)
        contact.normal_stiffness = normal->quantity(dimension::pressure, plausible::wall_stiffness);
    if (const std::optional<Value> point = table.find("point_stiffness"))
        contact.point_stiffness = point->quantity(dimension::pressure, plausible::wall_stiffness);
    else
        contact.point_stiffness = std::max(contact.point_stiffness, contact.normal_stiffness);
}

/// Spring and dashpot.
void read_linear_wall(const Table& table, ContactCase& contact) {
    refuse_key(table, "hunt_crossley", "contact.normal_law = \"hertz\"");
    table.refuse_both("normal_damping", "restitution");
    const std::string usual = fmt::format("{}", contact.normal_stiffness);
    read_stiffnesses(table, table.find("normal_stiffness", usual), contact);
    contact.normal_damping = table.quantity("normal_damping", dimension::viscosity,
                                            contact.normal_damping, plausible::wall_damping);
    if (const std::optional<Value> restitution = table.find("restitution"))
        contact.restitution = restitution->number({.low = 0, .high = 1});
}

/// Hertz's spring with Hunt and Crossley's damping.
void read_hertz_wall(const Table& table, ContactCase& contact) {
    constexpr Dimension time_over_length{0, -1, 1};
    for (const std::string_view key : {"normal_damping", "restitution"})
        refuse_key(table, key, "contact.normal_law = \"linear\"");
    contact.normal_stiffness = hertz_stiffness;
    contact.point_stiffness = hertz_point_stiffness;
    read_stiffnesses(table, table.find("normal_stiffness"), contact);
    contact.hunt_crossley = table.quantity("hunt_crossley", time_over_length, contact.hunt_crossley,
                                           plausible::hunt_crossley);
}

}  // namespace

ContactCase read_contact(const Table& root) {
    const Table table = root.subtable(
        "contact",
        {"normal_law", "normal_stiffness", "point_stiffness", "normal_damping", "restitution",
         "hunt_crossley", "tangential_stiffness", "rolling_creep", "static_friction",
         "dynamic_friction", "stribeck_speed", "law", "tension", "interference"});
    ContactCase contact;
    contact.normal_law =
        table.choice<NormalLaw>("normal_law", contact.normal_law,
                                {{"linear", NormalLaw::linear}, {"hertz", NormalLaw::hertz}});
    if (contact.normal_law == NormalLaw::hertz)
        read_hertz_wall(table, contact);
    else
        read_linear_wall(table, contact);
    contact.tangential_stiffness =
        table.quantity("tangential_stiffness", dimension::pressure, contact.tangential_stiffness,
                       plausible::wall_stiffness);
    contact.rolling_creep = table.number("rolling_creep", contact.rolling_creep, plausible::creep);
    const std::string usual = fmt::format("{}", contact.static_friction.axial);
    if (const std::optional<Value> value = table.find("static_friction", usual)) {
        contact.static_friction = read_friction(*value);
    }
    const FrictionCoefficients sliding = contact.dynamic_friction;
    contact.dynamic_friction =
        read_dynamic_friction(table.find("dynamic_friction", fmt::format("{}", sliding.axial)),
                              contact.static_friction, sliding);
    contact.law = table.choice<FrictionLaw>(
        "law", contact.law, {{"coulomb", FrictionLaw::coulomb}, {"paper", FrictionLaw::paper}});
    contact.stribeck_speed = table.quantity("stribeck_speed", dimension::speed,
                                            contact.stribeck_speed, plausible::speed_or_none);
    if (contact.stribeck_speed > 0 && contact.law == FrictionLaw::paper)
        refuse_key(table, "stribeck_speed", "contact.law = \"coulomb\"");
    if (contact.normal_law == NormalLaw::hertz && contact.law == FrictionLaw::paper)
        table.require("normal_law", "")
            .fail(
                "is \"hertz\", which the paper's friction does not know; expected contact.law = "
                "\"coulomb\"");
    contact.tension = table.boolean("tension", contact.tension);
    contact.interference = table.quantity("interference", dimension::length, contact.interference,
                                          plausible::length_or_none);
    return contact;
}

namespace {

/// Damping of both motions by the paper's one number, or by a key each in its own unit.
DampingPair read_damping_pair(const Table& table, const std::string& both, const Dimension& linear,
                              const Dimension& angular) {
    const std::string translation = both + "_translation";
    const std::string rotation = both + "_rotation";
    table.refuse_both(both, translation);
    table.refuse_both(both, rotation);
    const double shared = table.quantity(both, damping_coefficient, 0.0, plausible::damping);
    return {table.quantity(translation, linear, shared, plausible::damping),
            table.quantity(rotation, angular, shared, plausible::damping), shared > 0};
}

}  // namespace

DampingCase read_damping(const Table& root) {
    const Table table = root.subtable(
        "damping", {"internal", "internal_translation", "internal_rotation", "external",
                    "external_translation", "external_rotation", "kelvin_voigt"});
    constexpr Dimension newton_second{1, 1, -1};
    DampingCase damping;
    damping.internal = read_damping_pair(table, "internal", damping_coefficient, rotation_damping);
    damping.external = read_damping_pair(table, "external", dimension::viscosity, newton_second);
    damping.kelvin_voigt =
        table.quantity("kelvin_voigt", dimension::time, damping.kelvin_voigt, plausible::delay);
    return damping;
}

}  // namespace drillstrand

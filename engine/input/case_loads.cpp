#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

// Dimension of a damping coefficient of velocity, N s/m, and of rotation, N m s.
constexpr Dimension damping_coefficient{1, 0, -1};
constexpr Dimension rotation_damping{1, 2, -1};

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
    refuse(BitLaw::prescribed, "prescribed", {"torque", "friction", "smoothing_speed"});
    refuse(BitLaw::stribeck, "stribeck", {"static_torque", "dynamic_torque", "decay_speed"});
    refuse(BitLaw::cutting, "cutting", {"cutting", "feed", "off_bottom"});
    if (law == BitLaw::cutting)
        refuse_key(table, "weight", "another bit.law; by this one it is what the rock asks for");
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
void read_cutting(const Table& table, BitCase& bit, const StringCase& string) {
    const Table rock(table.require("cutting", "a table with the rock's specific_energy"),
                     {"blades", "specific_energy", "inclination", "wear_flat", "contact_strength",
                      "flat_friction"});
    CuttingCase& cutting = bit.cutting;
    constexpr int most_blades = 100;
    cutting.blades = rock.whole_number("blades", cutting.blades, 1, most_blades);
    cutting.specific_energy = rock.require("specific_energy", "a pressure such as \"60 MPa\"")
                                  .quantity(dimension::pressure, plausible::rock_strength);
    cutting.inclination =
        rock.number("inclination", cutting.inclination, plausible::cutter_inclination);
    cutting.wear_flat =
        rock.quantity("wear_flat", dimension::length, cutting.wear_flat, plausible::length_or_none);
    cutting.contact_strength = cutting.specific_energy;
    if (const std::optional<Value> strength = rock.find("contact_strength"))
        cutting.contact_strength =
            strength->quantity(dimension::pressure, plausible::rock_strength);
    cutting.flat_friction =
        rock.number("flat_friction", cutting.flat_friction, plausible::friction);
    bit.feed = table.scalar_schedule("feed", dimension::speed, plausible::speed);
    bit.off_bottom =
        table.quantity("off_bottom", dimension::length, bit.off_bottom, plausible::length_or_none);
    if (string.components.back().outer_diameter == 0)
        table.require("law", "").fail(
            "needs the bit's radius; expected an outer_diameter in the last component");
}

}  // namespace

BitCase read_bit(const Table& root, const StringCase& string) {
    const Table table = root.subtable(
        "bit", {"law", "weight", "torque", "friction", "smoothing_speed", "direction",
                "static_torque", "dynamic_torque", "decay_speed", "inertia", "cutting", "feed",
                "off_bottom", "contact_length", "force", "dead_moment", "moment"});
    table.refuse_both("torque", "friction");

    const bool in_well = root.find("well").has_value();
    BitCase bit;
    bit.torque = table.scalar_schedule("torque", dimension::moment, plausible::load_or_none);
    if (const std::optional<Value> friction = table.find("friction")) {
        bit.friction = friction->number(plausible::friction);
        if (string.components.back().outer_diameter == 0) {
            friction->fail(
                "needs the bit's radius; expected an outer_diameter in the last component");
        }
    }
    bit.law = table.choice<BitLaw>("law", bit.law,
                                   {{"prescribed", BitLaw::prescribed},
                                    {"stribeck", BitLaw::stribeck},
                                    {"cutting", BitLaw::cutting}});
    refuse_keys_of_other_laws(table, bit.law);
    if (bit.law == BitLaw::stribeck) read_bit_friction(table, bit);
    if (bit.law == BitLaw::cutting) read_cutting(table, bit, string);
    bit.inertia = table.quantity("inertia", dimension::moment_of_inertia, bit.inertia,
                                 plausible::bit_inertia);
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

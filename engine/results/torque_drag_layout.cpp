#include <type_traits>

#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand {

namespace {

template <class Value>
std::vector<double> to_numbers(const std::vector<Value>& values) {
    std::vector<double> numbers;
    numbers.reserve(values.size());
    for (const Value& value : values)
        numbers.push_back(static_cast<double>(value));
    return numbers;
}

template <class Value>
void from_numbers(const std::vector<double>& numbers, std::vector<Value>& values) {
    values.clear();
    for (const double number : numbers)
        values.push_back(static_cast<Value>(
            static_cast<std::conditional_t<std::is_enum_v<Value>, int, double>>(number)));
}

template <class Owner, auto member>
constexpr bool is_integer = std::is_enum_v<
    typename std::remove_cvref_t<decltype(std::declval<Owner&>().*member)>::value_type>;

template <auto member>
TorqueDragDataset at_depths(const char* name, const char* units, const char* description) {
    return {name,
            is_integer<TorqueDragCurve, member>,
            units,
            description,
            [](const TorqueDragCurve& curve) { return to_numbers(curve.*member); },
            [](TorqueDragCurve& curve, const std::vector<double>& numbers) {
                from_numbers(numbers, curve.*member);
            }};
}

template <auto member>
TorqueDragDataset along(const char* name, const char* units, const char* description) {
    return {name,
            is_integer<TorqueDragProfile, member>,
            units,
            description,
            [](const TorqueDragCurve& curve) { return to_numbers(curve.profile.*member); },
            [](TorqueDragCurve& curve, const std::vector<double>& numbers) {
                from_numbers(numbers, curve.profile.*member);
            }};
}

}  // namespace

const std::vector<TorqueDragDataset>& torque_drag_depth_datasets() {
    using C = TorqueDragCurve;
    static const std::vector<TorqueDragDataset> table = {
        at_depths<&C::hook_load>("hook_load", "N",
                                 "force that holds the head, along the well; NaN where no "
                                 "equilibrium was found"),
        at_depths<&C::surface_torque>("surface_torque", "N m",
                                      "couple that drives the head, about the well"),
        at_depths<&C::neutral_point>("neutral_point", "m",
                                     "measured depth above which the whole string is in tension"),
        at_depths<&C::buckling>("buckling", "1",
                                "compression against its limits, the worst along the string: -1 "
                                "unknown, 0 below them, 1 past the sinusoidal limit, 2 past the "
                                "helical limit"),
        at_depths<&C::soft_hook_load>("soft_hook_load", "N",
                                      "hook load of a soft string on the axis of the well"),
        at_depths<&C::soft_surface_torque>("soft_surface_torque", "N m",
                                           "surface torque of a soft string"),
        at_depths<&C::standpipe_pressure>("standpipe_pressure", "Pa",
                                          "pressure of the mud in the string at its head, above "
                                          "that of the atmosphere"),
        at_depths<&C::bit_pressure>("bit_pressure", "Pa",
                                    "pressure of the mud in the annulus at the bit, above that of "
                                    "the atmosphere"),
        at_depths<&C::equivalent_density>("equivalent_density", "kg/m3",
                                          "density of a fluid at rest with that pressure; 0 "
                                          "without a fluid"),
        at_depths<&C::mud_force>("mud_force", "N",
                                 "force of mud in motion along the string, positive down the "
                                 "well"),
    };
    return table;
}

const std::vector<TorqueDragDataset>& torque_drag_profile_datasets() {
    using P = TorqueDragProfile;
    static const std::vector<TorqueDragDataset> table = {
        along<&P::tension>("tension", "N", "axial force, buoyed; compression negative"),
        along<&P::torque>("torque", "N m",
                          "couple about the string that the part above exerts on the part below"),
        along<&P::side_force>("side_force", "N/m",
                              "normal force of the wall per length, mean over the window "
                              "output.side_force_window around the middle of the segment"),
        along<&P::bending_stress>("bending_stress", "Pa", "bending stress at the outer fibre"),
        along<&P::von_mises_stress>("von_mises_stress", "Pa",
                                    "von Mises stress of axial force, bending and torsion at the "
                                    "outer fibre"),
        along<&P::sinusoidal_limit>("sinusoidal_limit", "N",
                                    "compression at which the string snakes"),
        along<&P::helical_limit>("helical_limit", "N",
                                 "compression at which the string winds up to a helix"),
        along<&P::buckling>("buckling", "1",
                            "compression against its limits: -1 unknown, 0 below them, 1 past the "
                            "sinusoidal limit, 2 past the helical limit"),
        along<&P::soft_tension>("soft_tension", "N", "axial force of a soft string"),
        along<&P::soft_torque>("soft_torque", "N m", "torque of a soft string"),
        along<&P::soft_side_force>("soft_side_force", "N/m",
                                   "normal force of the wall on a soft string per length"),
        along<&P::inside_pressure>("inside_pressure", "Pa",
                                   "pressure of the mud in the string, above that of the "
                                   "atmosphere"),
        along<&P::outside_pressure>("outside_pressure", "Pa",
                                    "pressure of the mud in the annulus, above that of the "
                                    "atmosphere"),
        along<&P::true_tension>("true_tension", "N",
                                "axial force in the metal, which pressures make of the buoyed "
                                "one"),
    };
    return table;
}

}  // namespace drillstrand

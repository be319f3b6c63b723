#include "input/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "input/dimension_names.hpp"
#include "input/wording.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

using Units = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> fluid_units{"ppg", "sg", "lb/ft3", "kg/m3"};
constexpr std::array<std::string_view, 4> metal_units{"g/cm3", "ppg", "lb/ft3", "kg/m3"};
constexpr std::array<std::string_view, 2> mass_units{"lb/ft", "kg/m"};
constexpr std::array<std::string_view, 1> viscosity_units{"cP"};
constexpr std::array<std::string_view, 1> yield_units{"lbf/100ft2"};
constexpr std::array<std::string_view, 2> pump_units{"gpm", "L/min"};
constexpr std::array<std::string_view, 1> rotation_units{"rpm"};
constexpr std::array<std::string_view, 3> weight_units{"kN", "klbf", "tf"};
constexpr std::array<std::string_view, 5> modulus_units{"psi", "GPa", "MPa", "ksi", "Mpsi"};

// Air and foam aside, drilling fluids are heavier than half of water and lighter than three times.
constexpr Range fluid_density{.low = 500, .high = 3000};
constexpr Range viscosity{.high = 1};
constexpr Range yield_stress{.high = 50};
constexpr Range flow_rate{.high = 0.2};            // 3170 gpm
constexpr Range rotation{.low = -50, .high = 50};  // 477 rpm
constexpr Range friction{.high = 1};
constexpr Range modulus{.low = 20e9, .high = 700e9};  // of fibre composites to that of carbides
constexpr Range likely_modulus{.low = 50e9, .high = 250e9};  // of metals
constexpr Range weight_on_bit{.low = 1e3, .high = 500e3};
// A string that does not rotate may be pushed to see it buckle.
constexpr double largest_push = 1e6;  // N

/// Densities that a component of some elasticity may have by its mass and the section of its body:
/// tool joints and upsets add up to a third, hollow and finned tools lack some.
struct Metal {
    std::string_view name;
    Range modulus;   // Pa
    double density;  // kg/m3
    Range by_section;
};
constexpr std::array metals{
    Metal{"steel", {.low = 160e9, .high = 240e9}, 7850, {.low = 6500, .high = 11500}},
    Metal{"titanium", {.low = 90e9, .high = 140e9}, 4430, {.low = 3500, .high = 9000}},
    Metal{"aluminium", {.low = 60e9, .high = 90e9}, 2780, {.low = 2000, .high = 6000}},
};
constexpr Metal any_metal{"metal", {}, 0, {.low = 1000, .high = 25000}};
// Bits, subs and other short ones are far from pipes, and their mass hardly counts.
constexpr double shortest_pipe = 3;  // m
constexpr Range density_of_short{.low = 2000, .high = 20000};

constexpr double most_wells_in_strings = 10;
// Bottom-hole assemblies weigh two to five times what their drill pipe does, per length.
constexpr double least_weight_of_assembly = 1.8;

class Checker {
  public:
    Checker(const toml::table& root, const Case& input, const StringInput& string)
        : root_(root), input_(input), string_(string) {}

    std::vector<std::string> warnings() {
        check_numbers("fluid.density", dimension::density, fluid_density, fluid_units,
                      "no drilling fluid");
        check_numbers("fluid.viscosity", dimension::viscosity, viscosity, viscosity_units,
                      "thicker than any drilling fluid");
        check_numbers("fluid.yield_stress", dimension::pressure, yield_stress, yield_units,
                      "stiffer than any drilling fluid");
        check_numbers("fluid.flow_rate", dimension::flow_rate, flow_rate, pump_units,
                      "more than any pump gives");
        check_numbers("head.rotation", dimension::frequency, rotation, rotation_units,
                      "faster than any top drive");
        check_numbers("equilibrium.rotation", dimension::frequency, rotation, rotation_units,
                      "faster than any top drive");
        for (const char* path :
             {"contact.static_friction", "contact.dynamic_friction", "torque_drag.friction"})
            check_friction(path);
        for (std::size_t k = 0; input_.well && k < input_.well->sections.size(); ++k)
            for (const char* kind : {"static_friction", "dynamic_friction"})
                check_friction(fmt::format("well.section[{}].{}", k, kind));
        if (input_.well) {
            check_weight_on_bit();
            check_length();
        }
        for (std::size_t k = 0; k < input_.string.components.size(); ++k)
            check_component(k);
        check_order();
        return std::move(warnings_);
    }

  private:
    void warn(const SourceLocation& where, const std::string& text) {
        warnings_.emplace_back(InputError(where, text).what());
    }

    void warn(const WrittenValue& value, const std::string& why,
              const std::optional<std::string>& meant) {
        const std::string question = meant ? fmt::format("; did you mean {}?", *meant) : "";
        warn(value.where, fmt::format("{} is {}, {}{}", value.path, value.text, why, question));
    }

    /// The same number in the first of the units in which it makes sense.
    [[nodiscard]] static std::optional<std::string> in_other_unit(
        const std::string& text, const Dimension& dimension, Units units,
        const std::function<bool(double)>& makes_sense) {
        const auto [number, unit] = number_and_unit(text);
        if (unit.empty()) return std::nullopt;
        for (const std::string_view other : units)
            if (other != unit && makes_sense(number * unit_factor(other, dimension)))
                return fmt::format("\"{}{}\"", text.substr(0, text.size() - unit.size()), other);
        return std::nullopt;
    }

    /// Each number of a key: itself, the values of a schedule, the entries of a list.
    void for_each(const std::string& path, const std::function<bool(const Value&)>& visit) const {
        const toml::node* node = root_.at_path(path).node();
        if (node == nullptr) return;
        const toml::array* list = node->as_array();
        if (list == nullptr) {
            visit(Value(*node, path));
            return;
        }
        for (const toml::node& entry : *list) {
            const toml::array* pair = entry.as_array();
            if (!visit(Value(pair == nullptr ? entry : *pair->get(1), path))) return;
        }
    }

    [[nodiscard]] static double number_of(const Value& value, const Dimension& dimension) {
        const toml::node& node = value.node();
        if (const auto* text = node.as_string()) return parse_quantity(text->get(), dimension);
        return node.value<double>().value_or(0);
    }

    [[nodiscard]] static WrittenValue written(const Value& value, const Dimension& dimension) {
        return {value.path(), value.written(dimension), value.where()};
    }

    /// One warning a key, at the first number that is out of range.
    void check_numbers(const char* path, const Dimension& dimension, const Range& usual,
                       Units units, const char* why) {
        for_each(path, [&](const Value& value) {
            if (usual.contains(number_of(value, dimension))) return true;
            const WrittenValue found = written(value, dimension);
            warn(found, why, in_other_unit(found.text, dimension, units, [&](double meant) {
                     return usual.contains(meant);
                 }));
            return false;
        });
    }

    void check_friction(const std::string& path) {
        for_each(path, [&](const Value& value) {
            const double number = number_of(value, dimension::none);
            if (friction.contains(number)) return true;
            const double parts = number / 100;
            warn(written(value, dimension::none), "more than the weight that it brakes",
                 friction.contains(parts)
                     ? std::optional(fmt::format("{:.9g}, {:.9g} %", parts, number))
                     : std::nullopt);
            return false;
        });
    }

    void check_weight_on_bit() {
        const std::vector<double>& turns = input_.head.rotation.values();
        const bool rotates =
            std::any_of(turns.begin(), turns.end(), [](double rate) { return rate != 0; });
        Range usual = weight_on_bit;
        if (!rotates) usual.high = largest_push;
        std::optional<Value> largest;
        double most = 0;
        for_each("bit.weight", [&](const Value& value) {
            const double number = number_of(value, dimension::force);
            if (number > most) {
                most = number;
                largest.emplace(value);
            }
            return true;
        });
        if (!largest || usual.contains(most)) return;
        const WrittenValue found = written(*largest, dimension::force);
        warn(found, most < usual.low ? "too little to drill with" : "more than any bit bears",
             in_other_unit(found.text, dimension::force, weight_units,
                           [&](double meant) { return usual.contains(meant); }));
    }

    void check_length() {
        // a string for torque and drag is as long as each depth asks
        if (input_.head.position || root_.contains("torque_drag")) return;
        const std::vector<SurveyStation>& survey = input_.well->survey;
        const double well = survey.back().measured_depth - survey.front().measured_depth;
        const double length = total_length(input_.string);
        if (well <= most_wells_in_strings * length) return;
        warn(string_.where,
             fmt::format("the string is {} long in a well of {}; is its pipe missing, or a unit of "
                         "lengths or of the survey?",
                         length_text(length), length_text(well)));
    }

    /// A pipe of metal: its elasticity, and the density that its mass and section make.
    void check_component(std::size_t index) {
        const Component& component = input_.string.components[index];
        const WrittenValue& elastic = string_.moduli[index];
        if (!elastic.path.empty() && !modulus.contains(component.youngs_modulus)) {
            const auto meant = [](double value) { return likely_modulus.contains(value); };
            warn(elastic, "no metal's elasticity",
                 in_other_unit(elastic.text, dimension::pressure, modulus_units, meant));
        }
        if (component.outer_diameter > 0 && !component.inertia) check_density(index);
    }

    void check_density(std::size_t index) {
        const Component& component = input_.string.components[index];
        const double outer = component.outer_diameter;
        const double inner = component.inner_diameter;
        const double area = std::numbers::pi / 4 * (outer - inner) * (outer + inner);
        const double density = component.linear_density / area;
        const Metal& metal = metal_of(component);
        const Range& usual = component.length < shortest_pipe ? density_of_short : metal.by_section;
        if (usual.contains(density)) return;
        const WrittenValue& mass = string_.masses[index];
        const bool per_length = !is_density(mass);
        const auto is_usual = [&](double meant) {
            return usual.contains(per_length ? meant / area : meant);
        };
        const std::optional<std::string> meant =
            per_length ? in_other_unit(mass.text, dimension::linear_density, mass_units, is_usual)
                       : in_other_unit(mass.text, dimension::density, metal_units, is_usual);
        warn(mass, density_text(density, metal, per_length), meant);
    }

    [[nodiscard]] static bool is_density(const WrittenValue& mass) {
        return mass.path == "density" || mass.path.ends_with(".density");
    }

    [[nodiscard]] static std::string density_text(double density, const Metal& metal,
                                                  bool per_length) {
        std::string expected = metal.density > 0
                                   ? fmt::format("{} has {:.0f} kg/m3", metal.name, metal.density)
                                   : "no metal has so much or so little";
        if (!per_length) return expected;
        return fmt::format("{:.4g} kg/m3 over its section, where {}", density, expected);
    }

    [[nodiscard]] static const Metal& metal_of(const Component& component) {
        const auto* const found = std::find_if(
            metals.begin(), metals.end(),
            [&](const Metal& metal) { return metal.modulus.contains(component.youngs_modulus); });
        return found == metals.end() ? any_metal : *found;
    }

    /// Pipe is the longest component and the lightest; what it carries hangs below it.
    void check_order() {
        const std::vector<Component>& components = input_.string.components;
        const Component& last = components.back();
        double length = 0;
        double mass = 0;
        for (std::size_t k = 0; k + 1 < components.size(); ++k) {
            length += components[k].length;
            mass += components[k].length * components[k].linear_density;
        }
        if (length == 0 || last.length <= length) return;
        if (mass / length < least_weight_of_assembly * last.linear_density) return;
        warn(string_.component_places.front(),
             fmt::format("the string starts with {:.4g} times the weight per length of its last "
                         "component, its longest; components are listed from head to bit: is this "
                         "list from bit to head?",
                         mass / length / last.linear_density));
    }

    const toml::table& root_;
    const Case& input_;
    const StringInput& string_;
    std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> implausible_numbers(const toml::table& root, const Case& input,
                                             const StringInput& string) {
    return Checker(root, input, string).warnings();
}

}  // namespace drillstrand

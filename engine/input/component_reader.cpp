#include "input/component_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "input/delimited_table.hpp"
#include "input/dimension_names.hpp"
#include "input/key_notes.hpp"
#include "input/plausible.hpp"
#include "input/table.hpp"
#include "input/text_file.hpp"
#include "input/witsml.hpp"
#include "input/witsml_tubular.hpp"
#include "input/wording.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

// Shear modulus E / (2 (1 + nu)) positive and finite, and no negative compressibility.
constexpr Range poisson_range{.low = -0.99, .high = 0.5};

constexpr std::size_t most_components = 20'000;
constexpr double most_pieces = 20'000;  // of pipe between tool joints, in a component

std::string too_many(std::size_t components) {
    return fmt::format("has {} components; expected at most {}", components, most_components);
}

/// One component as it is written somewhere: its values by key.
class ComponentSource {
  public:
    virtual ~ComponentSource() = default;
    [[nodiscard]] virtual std::optional<std::string> text(std::string_view key) const = 0;
    [[nodiscard]] virtual std::optional<double> quantity(std::string_view key,
                                                         const Dimension& dimension,
                                                         const Range& range) const = 0;
    [[nodiscard]] virtual std::optional<double> number(std::string_view key,
                                                       const Range& range) const = 0;
    [[nodiscard]] virtual Eigen::Vector3d curvature() const = 0;
    /// A table of its own; none where columns are all there is.
    [[nodiscard]] virtual std::optional<Value> table(std::string_view key) const = 0;
    [[nodiscard]] virtual SourceLocation where(std::string_view key) const = 0;
    [[nodiscard]] virtual std::string path_of(std::string_view key) const = 0;
    /// With its unit; empty where it is left out.
    [[nodiscard]] virtual std::string written(std::string_view key,
                                              const Dimension& dimension) const = 0;

    [[nodiscard]] WrittenValue written_value(std::string_view key,
                                             const Dimension& dimension) const {
        std::string text = written(key, dimension);
        if (text.empty()) return {};
        return {path_of(key), std::move(text), where(key)};
    }
    [[noreturn]] void fail(std::string_view key, const std::string& problem) const {
        throw InputError(where(key), fmt::format("{} {}", path_of(key), problem));
    }
    [[noreturn]] void fail_missing(std::string_view key, std::string_view meaning) const {
        throw InputError(where(""), fmt::format("missing key {}; expected {}",
                                                in_quotes(path_of(key)), meaning));
    }
};

// Keys of a component, which are columns too, but for those in their middle: the curvature, and
// what is a table.
constexpr std::array<std::string_view, 9> keys_of_pipe{
    "name",    "length",         "outer_diameter", "inner_diameter", "linear_density",
    "density", "youngs_modulus", "poisson_ratio",  "yield_strength"};
constexpr std::array<std::string_view, 21> keys_of_places{"bending_stiffness",
                                                          "torsional_stiffness",
                                                          "axial_stiffness",
                                                          "shear_stiffness",
                                                          "inertia",
                                                          "polar_inertia",
                                                          "material_density",
                                                          "joint_length",
                                                          "tool_joint_outer_diameter",
                                                          "tool_joint_inner_diameter",
                                                          "tool_joint_length",
                                                          "contact_diameter",
                                                          "contact_length",
                                                          "contact_position",
                                                          "contact_stiffness",
                                                          "bend",
                                                          "bend_position",
                                                          "toolface",
                                                          "eccentric_mass",
                                                          "eccentric_mass_position",
                                                          "element_length"};

template <std::size_t size>
constexpr auto keys_with(const std::array<std::string_view, size>& others) {
    std::array<std::string_view, keys_of_pipe.size() + size + keys_of_places.size()> all{};
    auto end = std::copy(keys_of_pipe.begin(), keys_of_pipe.end(), all.begin());
    end = std::copy(others.begin(), others.end(), end);
    std::copy(keys_of_places.begin(), keys_of_places.end(), end);
    return all;
}

constexpr auto keys = keys_with(std::array<std::string_view, 2>{"curvature", "jar"});
constexpr auto columns = keys_with(
    std::array<std::string_view, 3>{"curvature_twist", "curvature_bend1", "curvature_bend2"});

class TableSource : public ComponentSource {
  public:
    explicit TableSource(const Value& value) : table_(value, keys) {}

    [[nodiscard]] std::optional<std::string> text(std::string_view key) const override {
        const std::optional<Value> value = table_.find(key);
        if (!value) return std::nullopt;
        return value->text();
    }
    [[nodiscard]] std::optional<double> quantity(std::string_view key, const Dimension& dimension,
                                                 const Range& range) const override {
        const std::optional<Value> value = table_.find(key);
        if (!value) return std::nullopt;
        return value->quantity(dimension, range);
    }
    [[nodiscard]] std::optional<double> number(std::string_view key,
                                               const Range& range) const override {
        const std::optional<Value> value = table_.find(key);
        if (!value) return std::nullopt;
        return value->number(range);
    }
    [[nodiscard]] Eigen::Vector3d curvature() const override {
        return table_.vector("curvature", dimension::curvature, plausible::curvature);
    }
    [[nodiscard]] std::optional<Value> table(std::string_view key) const override {
        return table_.find(key);
    }
    [[nodiscard]] SourceLocation where(std::string_view key) const override {
        const std::optional<Value> value = table_.find(key);
        return value ? value->where() : table_.where();
    }
    [[nodiscard]] std::string path_of(std::string_view key) const override {
        return table_.path_of(key);
    }
    [[nodiscard]] std::string written(std::string_view key,
                                      const Dimension& dimension) const override {
        const std::optional<Value> value = table_.find(key);
        return value ? value->written(dimension) : "";
    }

  private:
    Table table_;
};

/// A row of a CSV file; an empty field is a key left out.
class RowSource : public ComponentSource {
  public:
    RowSource(const DelimitedTable& table, std::size_t row) : table_(table), row_(row) {}

    [[nodiscard]] std::optional<std::string> text(std::string_view key) const override {
        const std::optional<std::size_t> column = filled_column(key);
        if (!column) return std::nullopt;
        return table_.text(row_, *column);
    }
    [[nodiscard]] std::optional<double> quantity(std::string_view key, const Dimension& dimension,
                                                 const Range& range) const override {
        const std::optional<std::size_t> column = filled_column(key);
        if (!column) return std::nullopt;
        const double value =
            table_.number(row_, *column) * table_.column_factor(*column, dimension, 1);
        WrittenLengths::note(value, dimension, written(key, dimension));
        return checked(key, value, range,
                       fmt::format("{} {}", range.describe(), si_unit(dimension)));
    }
    [[nodiscard]] std::optional<double> number(std::string_view key,
                                               const Range& range) const override {
        const std::optional<std::size_t> column = filled_column(key);
        if (!column) return std::nullopt;
        const std::string& unit = table_.columns()[*column].unit;
        if (!unit.empty()) {
            throw InputError(table_.columns()[*column].where,
                             fmt::format("column {} has the unit {}; expected none", key, unit));
        }
        return checked(key, table_.number(row_, *column), range, range.describe());
    }
    [[nodiscard]] Eigen::Vector3d curvature() const override {
        const auto part = [this](std::string_view key) {
            return quantity(key, dimension::curvature, plausible::curvature).value_or(0);
        };
        return {part("curvature_twist"), part("curvature_bend1"), part("curvature_bend2")};
    }
    [[nodiscard]] std::optional<Value> table(std::string_view) const override {
        return std::nullopt;
    }
    [[nodiscard]] SourceLocation where(std::string_view key) const override {
        const std::optional<std::size_t> column = filled_column(key);
        return column ? table_.where(row_, *column) : table_.where(row_);
    }
    [[nodiscard]] std::string path_of(std::string_view key) const override {
        return std::string(key);
    }
    [[nodiscard]] std::string written(std::string_view key,
                                      const Dimension& dimension) const override {
        const std::optional<std::size_t> column = filled_column(key);
        if (!column) return "";
        const std::string& unit = table_.columns()[*column].unit;
        return fmt::format("{} {}", table_.text(row_, *column),
                           unit.empty() ? si_unit(dimension) : unit);
    }

  private:
    [[nodiscard]] std::optional<std::size_t> filled_column(std::string_view key) const {
        const std::optional<std::size_t> column = table_.find_column(key);
        if (!column || table_.text(row_, *column).empty()) return std::nullopt;
        return column;
    }
    [[nodiscard]] double checked(std::string_view key, double value, const Range& range,
                                 const std::string& expected) const {
        if (!std::isfinite(value)) fail(key, "is too large; expected a finite number");
        if (!range.contains(value)) {
            fail(key, fmt::format("is {}; expected {}", text(key).value_or(""), expected));
        }
        return value;
    }

    const DelimitedTable& table_;
    std::size_t row_;
};

void refuse_unknown_columns(const DelimitedTable& table) {
    for (const DelimitedTable::Column& column : table.columns()) {
        if (column.name.empty() ||
            std::find(columns.begin(), columns.end(), column.name) != columns.end()) {
            continue;
        }
        const std::string_view near = nearest_name(column.name, columns);
        const std::string cure = near.empty() ? fmt::format("known here: {}", listed(columns))
                                              : fmt::format("did you mean {}?", in_quotes(near));
        throw InputError(column.where,
                         fmt::format("unknown column {}; {}", in_quotes(column.name), cure));
    }
}

/// Also of what stands in a table of its own.
std::string key_path(std::string_view key) {
    return fmt::format("string.component.{}", key);
}

double require(std::optional<double> value, const ComponentSource& source, std::string_view key,
               std::string_view meaning) {
    KeyNotes::required(key_path(key));
    if (!value) source.fail_missing(key, meaning);
    return *value;
}

double value_or(double standard, std::optional<double> value, std::string_view key) {
    KeyNotes::standard(key_path(key), fmt::format("{}", standard));
    return value.value_or(standard);
}

void read_section_keys(const ComponentSource& source, Component& component) {
    component.bending_stiffness =
        source.quantity("bending_stiffness", dimension::bending_stiffness, plausible::stiffness);
    component.torsional_stiffness =
        source.quantity("torsional_stiffness", dimension::bending_stiffness, plausible::stiffness);
    component.axial_stiffness =
        source.quantity("axial_stiffness", dimension::force, plausible::stiffness);
    component.shear_stiffness =
        source.quantity("shear_stiffness", dimension::force, plausible::stiffness);
    component.inertia =
        source.quantity("inertia", dimension::inertia_per_length, plausible::inertia);
    component.polar_inertia =
        source.quantity("polar_inertia", dimension::inertia_per_length, plausible::inertia);
}

bool all_stiffnesses_given(const Component& component) {
    return component.bending_stiffness && component.torsional_stiffness &&
           component.axial_stiffness && component.shear_stiffness;
}

void read_diameters(const ComponentSource& source, Component& component) {
    const std::optional<double> outer =
        source.quantity("outer_diameter", dimension::length, plausible::diameter);
    // the polar inertia follows from the other one
    const bool needed = !all_stiffnesses_given(component) || !component.inertia;
    KeyNotes::required(key_path("outer_diameter"));
    if (needed && !outer) {
        source.fail_missing("outer_diameter",
                            "a length such as \"5 in\", or all stiffnesses and inertias outright");
    }
    component.outer_diameter = outer.value_or(0);
    component.inner_diameter = value_or(
        0, source.quantity("inner_diameter", dimension::length, plausible::diameter_or_none),
        "inner_diameter");
    if (component.inner_diameter > 0 && component.inner_diameter >= component.outer_diameter) {
        source.fail("inner_diameter",
                    fmt::format("is {}; expected less than the outer diameter of {}",
                                length_text(component.inner_diameter),
                                length_text(component.outer_diameter)));
    }
}

/// Refuses a key that says nothing without another one.
void refuse_alone(const ComponentSource& source, std::string_view key, const Dimension& dimension,
                  std::string_view needed) {
    if (source.quantity(key, dimension, {}))
        source.fail(key, fmt::format("has no effect; expected it with {}", source.path_of(needed)));
}

std::optional<ToolJoints> read_joints(const ComponentSource& source, const Component& component) {
    const std::optional<double> spacing =
        source.quantity("joint_length", dimension::length, plausible::length);
    if (!spacing) {
        for (const std::string_view key :
             {"tool_joint_outer_diameter", "tool_joint_inner_diameter", "tool_joint_length"})
            refuse_alone(source, key, dimension::length, "joint_length");
        return std::nullopt;
    }
    ToolJoints joints;
    joints.spacing = *spacing;
    if (component.length > most_pieces * joints.spacing)
        source.fail("joint_length",
                    fmt::format("makes {:.0f} pieces of {}; expected at most {:.0f}",
                                component.length / joints.spacing, length_text(component.length),
                                most_pieces));
    joints.outer_diameter = require(
        source.quantity("tool_joint_outer_diameter", dimension::length, plausible::diameter),
        source, "tool_joint_outer_diameter", "a length such as \"6.625 in\"");
    joints.inner_diameter =
        source.quantity("tool_joint_inner_diameter", dimension::length, plausible::diameter_or_none)
            .value_or(component.inner_diameter);
    joints.length = value_or(
        0, source.quantity("tool_joint_length", dimension::length, plausible::length_or_none),
        "tool_joint_length");
    if (joints.inner_diameter >= joints.outer_diameter)
        source.fail(
            "tool_joint_outer_diameter",
            fmt::format("is {}; expected more than the inner diameter of {}",
                        length_text(joints.outer_diameter), length_text(joints.inner_diameter)));
    if (joints.length >= 0.5 * std::min(joints.spacing, component.length))
        source.fail("tool_joint_length",
                    fmt::format("is {}; expected less than half of a joint of {}",
                                length_text(joints.length),
                                length_text(std::min(joints.spacing, component.length))));
    return joints;
}

/// A place along a component, from its upper end.
double read_place(const ComponentSource& source, const Component& component, std::string_view key,
                  double standard) {
    const double place =
        source.quantity(key, dimension::length, plausible::length_or_none).value_or(standard);
    if (place > component.length)
        source.fail(key, fmt::format("is {}; expected at most {}, the length of the component",
                                     length_text(place), length_text(component.length)));
    return place;
}

std::optional<ContactPoint> read_contact_point(const ComponentSource& source,
                                               const Component& component) {
    const std::optional<double> diameter =
        source.quantity("contact_diameter", dimension::length, plausible::diameter);
    if (!diameter) {
        for (const std::string_view key : {"contact_length", "contact_position"})
            refuse_alone(source, key, dimension::length, "contact_diameter");
        refuse_alone(source, "contact_stiffness", dimension::pressure, "contact_diameter");
        return std::nullopt;
    }
    ContactPoint point;
    point.diameter = *diameter;
    if (point.diameter < component.outer_diameter)
        source.fail(
            "contact_diameter",
            fmt::format("is {}; expected at least the outer diameter of {}",
                        length_text(point.diameter), length_text(component.outer_diameter)));
    point.position = read_place(source, component, "contact_position", component.length / 2);
    point.length = source.quantity("contact_length", dimension::length, plausible::length)
                       .value_or(point.diameter);
    point.stiffness =
        source.quantity("contact_stiffness", dimension::pressure, plausible::wall_stiffness);
    return point;
}

std::optional<BentPlace> read_bend(const ComponentSource& source, const Component& component) {
    const std::optional<double> angle = source.quantity("bend", dimension::angle, plausible::bend);
    if (!angle) {
        refuse_alone(source, "bend_position", dimension::length, "bend");
        refuse_alone(source, "toolface", dimension::angle, "bend");
        return std::nullopt;
    }
    BentPlace bend;
    bend.angle = *angle;
    bend.position = read_place(source, component, "bend_position", component.length / 2);
    bend.toolface =
        value_or(0, source.quantity("toolface", dimension::angle, plausible::toolface), "toolface");
    return bend;
}

std::optional<Eccentricity> read_eccentricity(const ComponentSource& source,
                                              const Component& component) {
    const std::optional<double> moment =
        source.quantity("eccentric_mass", dimension::inertia_per_length, plausible::unbalance);
    if (!moment) {
        refuse_alone(source, "eccentric_mass_position", dimension::length, "eccentric_mass");
        return std::nullopt;
    }
    return Eccentricity{
        read_place(source, component, "eccentric_mass_position", component.length / 2), *moment};
}

/// One way of a jar: the force (N) above which it trips, and the travel (m) to the blow.
void read_stroke(const Table& table, const std::string& way, double& force, double& travel) {
    const std::optional<Value> limit = table.find(way + "_force");
    if (!limit) {
        if (const std::optional<Value> alone = table.find(way + "_travel"))
            alone->fail(
                fmt::format("has no effect; expected it with {}", table.path_of(way + "_force")));
        return;
    }
    force = limit->quantity(dimension::force, plausible::largest_load);
    travel = table.require(way + "_travel", "the way to the blow, such as \"0.2 m\"")
                 .quantity(dimension::length, plausible::length);
}

std::optional<JarCase> read_jar(const ComponentSource& source, const Component& component) {
    const std::optional<Value> value = source.table("jar");
    if (!value) return std::nullopt;
    const Table table(*value,
                      {"position", "up_force", "up_travel", "down_force", "down_travel", "delay"});
    JarCase jar;
    jar.position = component.length / 2;
    if (const std::optional<Value> position = table.find("position")) {
        jar.position = position->quantity(dimension::length, plausible::length_or_none);
        if (jar.position > component.length)
            position->fail(fmt::format("is {}; expected at most {}, the length of the component",
                                       length_text(jar.position), length_text(component.length)));
    }
    read_stroke(table, "up", jar.up_force, jar.up_travel);
    read_stroke(table, "down", jar.down_force, jar.down_travel);
    if (jar.up_force == 0 && jar.down_force == 0)
        value->fail(
            "never trips; expected up_force with up_travel, or down_force with down_travel");
    jar.delay = table.quantity("delay", dimension::time, jar.delay, plausible::delay);
    return jar;
}

/// Mass per length of tool joints and the pipe between, of one material.
double jointed_density(double density, const Component& component) {
    const auto ring = [](double outer, double inner) {
        return std::numbers::pi / 4 * (outer - inner) * (outer + inner);
    };
    const double pipe = ring(component.outer_diameter, component.inner_diameter);
    if (!component.joints) return density * pipe;
    const ToolJoints& joints = *component.joints;
    const double pieces = std::max(1.0, std::round(component.length / joints.spacing));
    const double share = joints.length * pieces / component.length;
    return density * (pipe + share * (ring(joints.outer_diameter, joints.inner_diameter) - pipe));
}

double read_linear_density(const ComponentSource& source, const Component& component) {
    const std::optional<double> per_length =
        source.quantity("linear_density", dimension::linear_density, plausible::linear_density);
    const std::optional<double> per_volume =
        source.quantity("density", dimension::density, plausible::density);
    if (per_length && per_volume) {
        source.fail("density", fmt::format("excludes {}; expected one of the two",
                                           source.path_of("linear_density")));
    }
    if (per_length) return *per_length;
    const double density = require(per_volume, source, "linear_density",
                                   "a mass per length such as \"19.5 lb/ft\", or density");
    if (component.outer_diameter == 0) {
        source.fail("density", "needs outer_diameter; expected linear_density without it");
    }
    return jointed_density(density, component);
}

double read_youngs_modulus(const ComponentSource& source, const Component& component) {
    const std::optional<double> modulus =
        source.quantity("youngs_modulus", dimension::pressure, plausible::elasticity);
    if (all_stiffnesses_given(component)) return modulus.value_or(0);
    return require(modulus, source, "youngs_modulus",
                   "a pressure such as \"206 GPa\", or all four stiffnesses outright");
}

PlacedComponent read_component(const ComponentSource& source) {
    Component component;
    component.name = source.text("name").value_or("");
    component.length = require(source.quantity("length", dimension::length, plausible::length),
                               source, "length", "a length such as 9.1 or \"30 ft\"");
    read_section_keys(source, component);
    read_diameters(source, component);
    component.joints = read_joints(source, component);
    component.linear_density = read_linear_density(source, component);
    component.material_density =
        source.quantity("material_density", dimension::density, plausible::density);
    if (component.joints && !component.material_density)
        component.material_density =
            source.quantity("density", dimension::density, plausible::density);
    component.youngs_modulus = read_youngs_modulus(source, component);
    component.poisson_ratio = value_or(
        component.poisson_ratio, source.number("poisson_ratio", poisson_range), "poisson_ratio");
    component.yield_strength =
        value_or(component.yield_strength,
                 source.quantity("yield_strength", dimension::pressure, plausible::elasticity),
                 "yield_strength");
    component.curvature = source.curvature();
    component.contact = read_contact_point(source, component);
    component.bend = read_bend(source, component);
    component.eccentric = read_eccentricity(source, component);
    component.jar = read_jar(source, component);
    component.element_length =
        source.quantity("element_length", dimension::length, plausible::length);
    return {component, source.where("outer_diameter")};
}

/// The component, and how what warnings speak of is written.
PlacedComponent read_as_written(const ComponentSource& source) {
    PlacedComponent placed = read_component(source);
    placed.mass = source.written_value("linear_density", dimension::linear_density);
    if (placed.mass.path.empty()) placed.mass = source.written_value("density", dimension::density);
    placed.modulus = source.written_value("youngs_modulus", dimension::pressure);
    return placed;
}

}  // namespace

std::vector<PlacedComponent> read_component_list(const Value& list) {
    std::vector<PlacedComponent> result;
    const std::vector<Value> values = list.elements("a list of tables [[string.component]]");
    if (values.size() > most_components) list.fail(too_many(values.size()));
    bool has_jar = false;
    for (const Value& value : values) {
        const TableSource source(value);
        result.push_back(read_as_written(source));
        if (!result.back().component.jar) continue;
        if (has_jar) source.fail("jar", "is the second in the string; expected at most one jar");
        has_jar = true;
    }
    if (result.empty()) list.fail("is empty; expected at least one component");
    return result;
}

std::vector<PlacedComponent> read_component_file(const std::filesystem::path& path,
                                                 const SourceLocation& asked_at) {
    if (is_witsml(path)) return read_tubular(path, asked_at);
    const DelimitedTable table(read_text_file(path, asked_at), path.string());
    refuse_unknown_columns(table);
    if (table.rows() > most_components)
        throw InputError({path.string(), 1, 1}, "the table " + too_many(table.rows()));
    std::vector<PlacedComponent> result;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        result.push_back(read_as_written(RowSource(table, row)));
    }
    if (result.empty()) {
        throw InputError({path.string(), 1, 1},
                         "the table has no rows; expected at least one component");
    }
    return result;
}

}  // namespace drillstrand

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

constexpr int most_segments = 10'000'000;

}  // namespace

double total_length(const StringCase& string) {
    double length = 0;
    for (const Component& component : string.components)
        length += component.length;
    return length;
}

StringInput read_string(const Table& root, const std::filesystem::path& folder) {
    const Value value = root.require("string", "a table of at least one [[string.component]]");
    const Table table(value, {"shear_coefficient", "component", "components"});
    table.refuse_both("component", "components");

    StringInput input;
    input.where = table.where();
    input.string.shear_coefficient =
        table.number("shear_coefficient", input.string.shear_coefficient, plausible::factor);
    std::vector<PlacedComponent> placed;
    if (const std::optional<Value> file = table.find("components")) {
        placed = read_component_file(folder / file->text(), file->where());
    } else {
        placed = read_component_list(
            table.require("component", "a table [[string.component]], or components = FILE.csv"));
    }
    for (PlacedComponent& component : placed) {
        input.string.components.push_back(std::move(component.component));
        input.component_places.push_back(std::move(component.where));
        input.masses.push_back(std::move(component.mass));
        input.moduli.push_back(std::move(component.modulus));
    }
    return input;
}

MeshCase read_mesh(const Table& root, double string_length) {
    const Value value = root.require("mesh", "a table with segments or element_length");
    const Table table(value, {"segments", "element_length", "segment_inertia"});
    table.refuse_both("segments", "element_length");

    MeshCase mesh;
    if (const std::optional<Value> element = table.find("element_length")) {
        const double segments =
            std::round(string_length / element->quantity(dimension::length, plausible::length));
        if (segments > most_segments) {
            element->fail(
                fmt::format("makes {:.0f} segments; expected at most {}", segments, most_segments));
        }
        mesh.segments = std::max(1, static_cast<int>(segments));
    } else {
        mesh.segments = table.require("segments", "a number of segments, or element_length")
                            .whole_number(1, most_segments);
    }
    mesh.segment_inertia = table.boolean("segment_inertia", mesh.segment_inertia);
    return mesh;
}

}  // namespace drillstrand

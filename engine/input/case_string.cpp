#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"
#include "input/written.hpp"

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

namespace {

/// A length of segments, that a stretch is not cut into too many.
double read_element_length(const Value& value, double stretch) {
    const double element = value.quantity(dimension::length, plausible::length);
    const double segments = std::ceil(stretch / element);
    if (segments > most_segments)
        value.fail(
            fmt::format("makes {:.0f} segments; expected at most {}", segments, most_segments));
    return element;
}

MeshRefinement read_refinement(const Value& value, double string_length) {
    const Table table(value, {"from", "to", "measured_from", "element_length"});
    MeshRefinement refine;
    refine.from = table.require("from", "a place along the string such as 0 or \"100 m\"")
                      .quantity(dimension::length, plausible::length_or_none);
    const Value to = table.require("to", "the other end of the stretch");
    refine.to = to.quantity(dimension::length, plausible::length);
    if (refine.to <= refine.from)
        to.fail(fmt::format("is {}; expected more than {}, where the stretch starts",
                            length_text(refine.to), length_text(refine.from)));
    refine.from_the_bit =
        table.choice<bool>("measured_from", false, {{"head", false}, {"bit", true}});
    if (refine.from >= string_length)
        table.require("from", "")
            .fail(fmt::format("is {}; expected less than {}, the length of the string",
                              length_text(refine.from), length_text(string_length)));
    refine.element_length =
        read_element_length(table.require("element_length", "the largest length of a segment"),
                            std::min(refine.to, string_length) - refine.from);
    return refine;
}

std::vector<MeshRefinement> read_refinements(const Value& list, double string_length) {
    constexpr std::size_t most = 1000;
    const std::vector<Value> stretches = list.elements("a list of tables [[mesh.refine]]");
    if (stretches.size() > most)
        list.fail(fmt::format("has {} stretches; expected at most {}", stretches.size(), most));
    std::vector<MeshRefinement> result;
    for (const Value& stretch : stretches)
        result.push_back(read_refinement(stretch, string_length));
    return result;
}

}  // namespace

MeshCase read_mesh(const Table& root, const StringCase& string) {
    const Value value = root.require("mesh", "a table with segments or element_length");
    const Table table(
        value, {"segments", "element_length", "segments_per_joint", "refine", "segment_inertia"});
    for (const char* of_following : {"element_length", "segments_per_joint", "refine"})
        table.refuse_both("segments", of_following);

    MeshCase mesh;
    const double length = total_length(string);
    const std::optional<Value> element = table.find("element_length");
    if (!element) {
        mesh.segments = table.require("segments", "a number of segments, or element_length")
                            .whole_number(1, most_segments);
    } else {
        mesh.element_length = read_element_length(*element, length);
        if (const std::optional<Value> per_joint =
                table.find("segments_per_joint", fmt::format("{}", mesh.segments_per_joint)))
            mesh.segments_per_joint = per_joint->whole_number(1, 1000);
        if (const std::optional<Value> refine = table.find("refine"))
            mesh.refine = read_refinements(*refine, length);
    }
    mesh.segment_inertia = table.boolean("segment_inertia", mesh.segment_inertia);
    return mesh;
}

}  // namespace drillstrand

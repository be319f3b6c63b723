#include "input/witsml_tubular.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <utility>

#include "input/dimension_names.hpp"
#include "input/plausible.hpp"
#include "input/witsml.hpp"
#include "input/wording.hpp"

namespace drillstrand {

namespace {

/// Elasticity of what WITSML calls typeMaterial: usual values (API RP 7G for steel and aluminium
/// pipe, ASM handbooks for the others).
struct Material {
    std::string_view name;
    double youngs_modulus;  // Pa
    double poisson_ratio;
};
constexpr std::array materials{
    Material{"steel", 206.8e9, 0.3},          Material{"steel alloy", 206.8e9, 0.3},
    Material{"chrome alloy", 206.8e9, 0.3},   Material{"non-magnetic steel", 193e9, 0.3},
    Material{"aluminum", 73e9, 0.33},         Material{"titanium", 114e9, 0.33},
    Material{"beryllium copper", 128e9, 0.3},
};

struct NumberedComponent {
    int sequence = 0;
    pugi::xml_node sequence_element;
    PlacedComponent placed;
};

class TubularReader {
  public:
    TubularReader(const std::filesystem::path& path, const SourceLocation& asked_at)
        : file_(path, asked_at, "tubular") {}

    [[nodiscard]] std::vector<PlacedComponent> components() const {
        std::vector<NumberedComponent> numbered;
        for (const pugi::xml_node node : file_.children(file_.object(), "tubularComponent"))
            numbered.push_back({read_sequence(node), file_.require(node, "sequence"), place(node)});
        if (numbered.empty())
            fail(file_.object(), "the tubular has no tubularComponent; expected at least one");
        std::stable_sort(numbered.begin(), numbered.end(), [](const auto& left, const auto& right) {
            return left.sequence > right.sequence;
        });
        refuse_doubles(numbered);
        std::vector<PlacedComponent> placed;
        for (NumberedComponent& component : numbered)
            placed.push_back(std::move(component.placed));
        return placed;
    }

  private:
    [[noreturn]] void fail(pugi::xml_node node, const std::string& problem) const {
        throw InputError(file_.where(node), problem);
    }

    [[nodiscard]] int read_sequence(pugi::xml_node node) const {
        const pugi::xml_node element = file_.require(node, "sequence");
        const std::string digits = content_of(element);
        int sequence = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), sequence);
        if (error != std::errc() || end != digits.data() + digits.size() || sequence < 0)
            fail(element, fmt::format("sequence is {}; expected a whole number, 1 for the bit",
                                      in_quotes(digits)));
        return sequence;
    }

    void refuse_doubles(const std::vector<NumberedComponent>& numbered) const {
        const auto twice = std::adjacent_find(
            numbered.begin(), numbered.end(),
            [](const auto& left, const auto& right) { return left.sequence == right.sequence; });
        if (twice != numbered.end())
            fail(std::next(twice)->sequence_element,
                 fmt::format("sequence {} is there twice; expected a number for each component",
                             twice->sequence));
    }

    [[nodiscard]] double quantity(pugi::xml_node node, const char* name, const Dimension& dimension,
                                  const Range& range) const {
        const pugi::xml_node element = file_.require(node, name);
        const double value = file_.quantity(element, dimension);
        if (!range.contains(value))
            fail(element,
                 fmt::format("{} is {}; expected {} {}", name, WitsmlFile::written(element),
                             range.describe(), si_unit(dimension)));
        WrittenLengths::note(value, dimension, WitsmlFile::written(element));
        return value;
    }

    [[nodiscard]] PlacedComponent place(pugi::xml_node node) const {
        const pugi::xml_node mass = file_.require(node, "wtPerLen");
        return {read_component(node),
                file_.where(file_.require(node, "od")),
                {"wtPerLen", WitsmlFile::written(mass), file_.where(mass)}};
    }

    [[nodiscard]] Component read_component(pugi::xml_node node) const {
        Component component;
        const std::string type = file_.text(node, "typeTubularComp").value_or("");
        component.name = file_.text(node, "description").value_or("");
        if (component.name.empty()) component.name = type;
        component.length = quantity(node, "len", dimension::length, plausible::length);
        component.outer_diameter = quantity(node, "od", dimension::length, plausible::diameter);
        if (!file_.children(node, "id").empty())
            component.inner_diameter =
                quantity(node, "id", dimension::length, plausible::diameter_or_none);
        if (component.inner_diameter >= component.outer_diameter)
            fail(file_.require(node, "id"),
                 fmt::format("id is {}; expected less than od, {}",
                             WitsmlFile::written(file_.require(node, "id")),
                             WitsmlFile::written(file_.require(node, "od"))));
        component.linear_density =
            quantity(node, "wtPerLen", dimension::linear_density, plausible::linear_density);
        const Material& material = material_of(node);
        component.youngs_modulus = material.youngs_modulus;
        component.poisson_ratio = material.poisson_ratio;
        component.contact = read_contact(node, component);
        component.bend = read_bend(node, component);
        return component;
    }

    /// The only child of that name, or none.
    [[nodiscard]] pugi::xml_node at_most_one(pugi::xml_node node, const char* name) const {
        const std::vector<pugi::xml_node> found = file_.children(node, name);
        if (found.size() > 1)
            fail(found[1], fmt::format("the component has {} elements {}; expected one: cut the "
                                       "component between them",
                                       found.size(), in_quotes(name)));
        return found.empty() ? pugi::xml_node() : found.front();
    }

    /// A diameter that touches the wall, at least the component's own.
    [[nodiscard]] double touching_diameter(pugi::xml_node node, const char* name,
                                           const Component& component) const {
        const double diameter = quantity(node, name, dimension::length, plausible::diameter);
        if (diameter < component.outer_diameter)
            fail(file_.require(node, name),
                 fmt::format("{} is {}; expected at least the od of the component", name,
                             WitsmlFile::written(file_.require(node, name))));
        return diameter;
    }

    /// The place on the component that is so far above its lower end.
    [[nodiscard]] double above_lower_end(pugi::xml_node node, const char* name, double more,
                                         const Component& component) const {
        const double above =
            more + quantity(node, name, dimension::length, plausible::length_or_none);
        if (above > component.length)
            fail(file_.require(node, name),
                 fmt::format("{} is {}, beyond the upper end of the component", name,
                             WitsmlFile::written(file_.require(node, name))));
        return component.length - above;
    }

    /// The blades of a stabilizer, or the gauge of a bit.
    [[nodiscard]] std::optional<ContactPoint> read_contact(pugi::xml_node node,
                                                           const Component& component) const {
        const pugi::xml_node blades = at_most_one(node, "stabilizer");
        if (blades) {
            ContactPoint point;
            point.diameter = touching_diameter(blades, "odBladeMx", component);
            const double blade = quantity(blades, "lenBlade", dimension::length, plausible::length);
            point.length =
                file_.children(blades, "lenBladeGauge").empty()
                    ? blade
                    : quantity(blades, "lenBladeGauge", dimension::length, plausible::length);
            point.position = file_.children(blades, "distBladeBot").empty()
                                 ? component.length / 2
                                 : above_lower_end(blades, "distBladeBot", blade / 2, component);
            return point;
        }
        const pugi::xml_node bit = at_most_one(node, "bitRecord");
        if (!bit || file_.children(bit, "diaBit").empty()) return std::nullopt;
        const double diameter = touching_diameter(bit, "diaBit", component);
        return ContactPoint{component.length / 2, diameter, diameter, std::nullopt};
    }

    /// Its side is not told: that of d1.
    [[nodiscard]] std::optional<BentPlace> read_bend(pugi::xml_node node,
                                                     const Component& component) const {
        const pugi::xml_node bend = at_most_one(node, "bend");
        if (!bend) return std::nullopt;
        BentPlace place;
        place.angle = quantity(bend, "angle", dimension::angle, plausible::bend);
        place.position = file_.children(bend, "distBendBot").empty()
                             ? component.length / 2
                             : above_lower_end(bend, "distBendBot", 0, component);
        return place;
    }

    [[nodiscard]] const Material& material_of(pugi::xml_node node) const {
        const std::string name = file_.text(node, "typeMaterial").value_or("steel");
        const auto* const found =
            std::find_if(materials.begin(), materials.end(),
                         [&](const Material& material) { return material.name == name; });
        if (found != materials.end()) return *found;
        std::vector<std::string_view> names;
        for (const Material& material : materials)
            names.push_back(material.name);
        fail(file_.require(node, "typeMaterial"),
             fmt::format("typeMaterial is {}, whose elasticity is not known; expected one of {}, "
                         "or a table with youngs_modulus",
                         in_quotes(name), listed(names)));
    }

    WitsmlFile file_;
};

}  // namespace

std::vector<PlacedComponent> read_tubular(const std::filesystem::path& path,
                                          const SourceLocation& asked_at) {
    return TubularReader(path, asked_at).components();
}

}  // namespace drillstrand

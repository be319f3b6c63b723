#include "drillstrand/case.hpp"

#include <fmt/format.h>

#include "input/case_document.hpp"
#include "input/case_sections.hpp"
#include "input/descent.hpp"
#include "input/plausibility.hpp"
#include "input/plausible.hpp"
#include "input/written.hpp"

namespace drillstrand {

namespace {

/// Whether the string has an equilibrium that a run can start from.
bool can_rest(const Case& input) {
    return input.head.motion != HeadMotion::free &&
           input.run.integrator == IntegratorKind::leapfrog;
}

/// Throws InputError where the paper's rod is asked for what it does not have.
void check_eccentric_masses(const Case& input, const StringInput& string) {
    if (input.run.integrator == IntegratorKind::leapfrog) return;
    for (std::size_t k = 0; k < input.string.components.size(); ++k)
        if (input.string.components[k].eccentric)
            throw InputError(string.component_places[k],
                             "eccentric_mass turns with the leapfrog's rod alone; expected "
                             "run.integrator = \"leapfrog\"");
}

/// Throws InputError where the paper's rod is asked for a jar.
void check_jar(const Case& input, const toml::table& root) {
    if (input.run.integrator == IntegratorKind::leapfrog) return;
    for (std::size_t k = 0; k < input.string.components.size(); ++k)
        if (input.string.components[k].jar)
            Value(*root.at_path(fmt::format("string.component[{}].jar", k)).node(),
                  fmt::format("string.component.{}.jar", k))
                .fail("slides in the leapfrog's rod alone; expected run.integrator = \"leapfrog\"");
}

/// Throws InputError where the paper's rod is asked for ends that the leapfrog alone has.
void check_ends(const Case& input, const toml::table& root) {
    if (input.run.integrator == IntegratorKind::leapfrog) return;
    const auto refuse = [&](const char* path) {
        Value(*root.at_path(path).node(), path)
            .fail("is for the leapfrog's rod; expected run.integrator = \"leapfrog\"");
    };
    if (input.head.drive) refuse("head.drive");
    if (input.head.hoist) refuse("head.hoist");
    if (input.bit.law != BitLaw::prescribed) refuse("bit.law");
    if (input.contact.stribeck_speed > 0) refuse("contact.stribeck_speed");
}

/// Throws InputError where the head lets the bit down beyond the surveyed well, or a component to
/// where it does not fit.
void check_travel(const WellCase& well, const StringInput& string, const Case& input,
                  const toml::table& root) {
    const bool head_at_start = !input.head.position || input.head.position->isZero(0);
    if (!head_at_start) return;
    const Descent descent = deepest_descent(input.head, input.run.duration);
    if (descent.depth <= 0) return;
    for (const char* path : {"head.operations", "head.velocity", "head.hoist.block_speed"}) {
        const toml::node* node = root.at_path(path).node();
        if (node == nullptr) continue;
        const double bit =
            well.survey.front().measured_depth + total_length(string.string) + descent.depth;
        const double end = well.survey.back().measured_depth;
        if (bit > end)
            Value(*node, path)
                .fail(fmt::format("takes the bit to {:.6g} m, at {:.4g} s; expected at most "
                                  "{:.6g} m, the end of the surveyed well",
                                  bit, descent.time, end));
        check_fit_at(well, string, input.contact.interference, bit, locate(node->source()));
    }
}

/// Throws InputError where a run cannot start from equilibrium.
void check_initial_equilibrium(const Case& input, const toml::table& root) {
    if (input.initial.state != InitialState::equilibrium || can_rest(input)) return;
    const Value value(*root.at_path("initial.state").node(), "initial.state");
    if (input.head.motion == HeadMotion::free)
        value.fail("needs a head that holds the string; expected head.motion = \"driven\"");
    if (input.run.integrator != IntegratorKind::leapfrog)
        value.fail(
            "is that of the leapfrog's rod; expected run.integrator = \"leapfrog\", or "
            "initial.state = \"coaxial\"");
}

std::string read_title(const Table& root, const std::filesystem::path& path) {
    const std::optional<Value> title = root.find("title");
    return title ? title->text() : path.stem().string();
}

/// The case file and the tables that it names.
std::vector<std::filesystem::path> files_of(const toml::table& root,
                                            const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    for (const char* key : {"well.survey", "string.components"})
        if (const auto name = root.at_path(key).value<std::string>())
            files.push_back(path.parent_path() / *name);
    return files;
}

}  // namespace

Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides) {
    CaseDocument document = load_case_document(path, overrides);
    const WrittenLengths lengths;
    const Table root(
        document.root, "",
        {"title", "gravity", "well", "fluid", "string", "mesh", "head", "bit", "contact", "damping",
         "initial", "equilibrium", "torque_drag", "run", "output"});
    const std::filesystem::path folder = path.parent_path();

    Case result;
    result.title = read_title(root, path);
    result.gravity =
        root.quantity("gravity", dimension::acceleration, result.gravity, plausible::acceleration);
    result.run = read_run(root);
    result.well = read_well(root, folder);
    result.fluid = read_fluid(root);
    const StringInput string = read_string(root, folder);
    result.string = string.string;
    result.output = read_output(root, result.run.duration, result.string);
    result.mesh = read_mesh(root, string.string);
    result.head = read_head(root);
    result.bit = read_bit(root, result.string);
    result.contact = read_contact(root);
    result.damping = read_damping(root);
    result.initial = read_initial(root, result.well && can_rest(result));
    result.equilibrium = read_equilibrium(root);
    if (result.well) check_fit(*result.well, string, result.head, result.contact.interference);
    if (result.well) check_travel(*result.well, string, result, document.root);
    result.torque_drag = read_torque_drag(root, result.well, string, result.contact.interference);
    check_initial_equilibrium(result, document.root);
    check_eccentric_masses(result, string);
    check_jar(result, document.root);
    check_ends(result, document.root);
    result.warnings = implausible_numbers(document.root, result, string);
    result.path = path;
    result.files = files_of(document.root, path);
    result.text = std::move(document.text);
    return result;
}

void require_duration(const Case& input) {
    if (input.run.duration > 0) return;
    throw InputError({input.path.string()},
                     "missing key \"run.duration\"; expected a time such as 200 or \"5 min\" in a "
                     "table [run]");
}

}  // namespace drillstrand

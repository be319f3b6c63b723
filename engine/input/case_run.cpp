#include <fmt/format.h>

#include "input/case_sections.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

constexpr int most_threads = 4096;

double read_tolerance(const Value& value, IntegratorKind integrator) {
    if (integrator == IntegratorKind::dormand_prince)
        value.fail(
            "is for the leapfrog; dormand-prince has run.absolute_tolerance and "
            "run.relative_tolerance");
    return value.number({.low = 1e-12, .high = 1});
}

}  // namespace

InitialCase read_initial(const Table& root, bool can_rest) {
    const Table table =
        root.subtable("initial", {"state", "curvature", "offset", "penetration_limit"});
    InitialCase initial;
    initial.by_default = !table.find("state");
    // who shifts or bends the string wants it there
    const bool placed = table.find("offset") || table.find("curvature");
    if (can_rest && !placed) initial.state = InitialState::equilibrium;
    initial.state = table.choice<InitialState>("state", initial.state,
                                               {{"coaxial", InitialState::coaxial},
                                                {"stress-free", InitialState::stress_free},
                                                {"equilibrium", InitialState::equilibrium}});
    initial.curvature = table.vector("curvature", dimension::curvature, plausible::curvature);
    initial.offset = table.vector("offset", dimension::length, plausible::coordinate);
    if (const std::optional<Value> limit = table.find("penetration_limit"))
        initial.penetration_limit = limit->quantity(dimension::length, plausible::length_or_none);
    return initial;
}

namespace {

/// Rates that do not go with the motion, or are missing beside it, are refused.
void check_rates(const Table& table, const EquilibriumCase& equilibrium) {
    const StringMotion motion = equilibrium.motion;
    const auto refuse = [&](std::string_view key, std::string_view motions) {
        if (const std::optional<Value> value = table.find(key))
            value->fail(fmt::format("has no effect; expected it with motion = {}", motions));
    };
    if (motion == StringMotion::rest)
        refuse("axial_speed",
               R"("rotating", "drilling", "sliding", "tripping_in" or "tripping_out")");
    if (motion == StringMotion::rest || motion == StringMotion::sliding)
        refuse("rotation", R"("rotating", "drilling", "tripping_in" or "tripping_out")");
    const bool turns = motion == StringMotion::rotating || motion == StringMotion::drilling;
    if (turns && equilibrium.rotation == 0.0)
        table.find("rotation")->fail("is 0; expected a rate, or another motion");
    const bool trips = motion == StringMotion::tripping_in || motion == StringMotion::tripping_out;
    if (trips && equilibrium.rotation && !equilibrium.axial_speed) {
        table.find("rotation")->fail("needs its speed too; expected equilibrium.axial_speed");
    }
    if (!equilibrium.axial_speed) return;
    const double speed = *equilibrium.axial_speed;
    const Value value = *table.find("axial_speed");
    const bool into_the_hole =
        trips ? motion == StringMotion::tripping_in : motion == StringMotion::sliding;
    if (into_the_hole && speed <= 0)
        value.fail("does not go into the hole; expected more than 0 m/s");
    if (motion == StringMotion::tripping_out && speed >= 0)
        value.fail("does not go out of the hole; expected less than 0 m/s");
}

}  // namespace

EquilibriumCase read_equilibrium(const Table& root) {
    const Table table = root.subtable("equilibrium", {"motion", "axial_speed", "rotation"});
    EquilibriumCase equilibrium;
    equilibrium.motion = table.choice<StringMotion>("motion", equilibrium.motion,
                                                    {{"rest", StringMotion::rest},
                                                     {"rotating", StringMotion::rotating},
                                                     {"drilling", StringMotion::drilling},
                                                     {"tripping_in", StringMotion::tripping_in},
                                                     {"tripping_out", StringMotion::tripping_out},
                                                     {"sliding", StringMotion::sliding}});
    if (const std::optional<Value> value = table.find("axial_speed"))
        equilibrium.axial_speed = value->quantity(dimension::speed, plausible::speed);
    if (const std::optional<Value> value = table.find("rotation"))
        equilibrium.rotation = value->quantity(dimension::frequency, plausible::rotation);
    check_rates(table, equilibrium);
    return equilibrium;
}

RunCase read_run(const Table& root) {
    const Table table = root.subtable(
        "run", {"duration", "integrator", "cfl", "local_steps", "tolerance", "absolute_tolerance",
                "relative_tolerance", "stress_limit", "threads", "reproducible"});
    RunCase run;
    if (const std::optional<Value> duration = table.find("duration"))
        run.duration = duration->quantity(dimension::time, plausible::duration);
    run.integrator =
        table.choice<IntegratorKind>("integrator", run.integrator,
                                     {{"dormand-prince", IntegratorKind::dormand_prince},
                                      {"leapfrog", IntegratorKind::leapfrog}});
    run.cfl = table.number("cfl", run.cfl, {.low = 1e-6, .high = 1});
    run.local_steps = table.boolean("local_steps", run.local_steps);
    if (const std::optional<Value> tolerance = table.find("tolerance"))
        run.tolerance = read_tolerance(*tolerance, run.integrator);
    run.stress_limit = table.number("stress_limit", run.stress_limit, plausible::factor_or_none);
    constexpr Range step_tolerance{.low = 1e-16, .high = 1e6};
    run.absolute_tolerance =
        table.number("absolute_tolerance", run.absolute_tolerance, step_tolerance);
    run.relative_tolerance =
        table.number("relative_tolerance", run.relative_tolerance, step_tolerance);
    run.threads = table.whole_number("threads", run.threads, 0, most_threads);
    run.reproducible = table.boolean("reproducible", run.reproducible);
    return run;
}

}  // namespace drillstrand

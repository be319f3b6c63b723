#include <fmt/format.h>

#include "input/case_sections.hpp"

namespace drillstrand {

namespace {

constexpr int most_threads = 4096;

double read_tolerance(const Value& value, IntegratorKind integrator) {
    if (integrator == IntegratorKind::dormand_prince)
        value.fail(
            "is for the leapfrog; dormand-prince has run.absolute_tolerance and "
            "run.relative_tolerance");
    return value.number({.low = 0, .high = 1, .low_open = true});
}

}  // namespace

InitialCase read_initial(const Table& root) {
    const Table table = root.subtable("initial", {"state", "curvature", "offset"});
    InitialCase initial;
    initial.state = table.choice<InitialState>("state", initial.state,
                                               {{"coaxial", InitialState::coaxial},
                                                {"stress-free", InitialState::stress_free},
                                                {"equilibrium", InitialState::equilibrium}});
    initial.curvature = table.vector("curvature", dimension::curvature);
    initial.offset = table.vector("offset", dimension::length);
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
        refuse("axial_speed", R"("rotating", "sliding", "tripping_in" or "tripping_out")");
    if (motion == StringMotion::rest || motion == StringMotion::sliding)
        refuse("rotation", R"("rotating", "tripping_in" or "tripping_out")");
    if (motion == StringMotion::rotating && equilibrium.rotation == 0.0)
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
    constexpr Dimension speed{0, 1, -1};
    const Table table = root.subtable("equilibrium", {"motion", "axial_speed", "rotation"});
    EquilibriumCase equilibrium;
    equilibrium.motion = table.choice<StringMotion>("motion", equilibrium.motion,
                                                    {{"rest", StringMotion::rest},
                                                     {"rotating", StringMotion::rotating},
                                                     {"tripping_in", StringMotion::tripping_in},
                                                     {"tripping_out", StringMotion::tripping_out},
                                                     {"sliding", StringMotion::sliding}});
    if (const std::optional<Value> value = table.find("axial_speed"))
        equilibrium.axial_speed = value->quantity(speed);
    if (const std::optional<Value> value = table.find("rotation"))
        equilibrium.rotation = value->quantity(dimension::frequency);
    check_rates(table, equilibrium);
    return equilibrium;
}

RunCase read_run(const Table& root) {
    const Value value = root.require("run", "a table with duration");
    const Table table(value, {"duration", "integrator", "cfl", "tolerance", "absolute_tolerance",
                              "relative_tolerance", "stress_limit", "threads"});
    RunCase run;
    run.duration = table.require("duration", "a time such as 200 or \"5 min\"")
                       .quantity(dimension::time, positive);
    run.integrator =
        table.choice<IntegratorKind>("integrator", run.integrator,
                                     {{"dormand-prince", IntegratorKind::dormand_prince},
                                      {"leapfrog", IntegratorKind::leapfrog}});
    run.cfl = table.number("cfl", run.cfl, {.low = 0, .high = 1, .low_open = true});
    if (const std::optional<Value> tolerance = table.find("tolerance"))
        run.tolerance = read_tolerance(*tolerance, run.integrator);
    run.stress_limit = table.number("stress_limit", run.stress_limit, not_negative);
    run.absolute_tolerance = table.number("absolute_tolerance", run.absolute_tolerance, positive);
    run.relative_tolerance = table.number("relative_tolerance", run.relative_tolerance, positive);
    if (const std::optional<Value> threads = table.find("threads")) {
        run.threads = threads->whole_number(0, most_threads);
    }
    return run;
}

OutputCase read_output(const Table& root) {
    const Table table =
        root.subtable("output", {"interval", "profile_interval", "checkpoint_interval"});
    OutputCase output;
    output.interval = table.quantity("interval", dimension::time, output.interval, positive);
    output.profile_interval =
        table.quantity("profile_interval", dimension::time, output.profile_interval, not_negative);
    output.checkpoint_interval = table.quantity("checkpoint_interval", dimension::time,
                                                output.checkpoint_interval, positive);
    return output;
}

}  // namespace drillstrand

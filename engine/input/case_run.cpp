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

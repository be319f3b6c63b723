#!/usr/bin/python3
"""What steps of their own size save where the mesh is fine: Well 2 as it ships and with its last
100 m on segments of 0.5 m, and the drilling assembly of cases/field_units.toml, with local steps
and with one small step for all.

All of them in turn, on one and on two threads; medians of wall times without start and end. Writes
local_steps.csv to bench/results/MACHINE/ and, with --publish, the table into bench/RESULTS.md.
"""

import argparse
import statistics

import measure

REFINED = {"mesh": "{element_length = 7, refine = [{from = 0, to = 100, measured_from = 'bit', "
                   "element_length = 0.5}]}"}
ONE_STEP = {"run.local_steps": False}
# What is run, with which settings, and for which part of the simulated time: one small step for
# all takes long.
RUNS = (
    ("Well 2", "well2.toml", {}, 1),
    ("its last 100 m at 0.5 m", "well2.toml", REFINED, 1),
    ("the same, one step for all", "well2.toml", REFINED | ONE_STEP, 0.1),
    ("field units", "field_units.toml", {}, 0.2),
    ("the same, one step for all", "field_units.toml", ONE_STEP, 0.2),
)


def main():
    """Runs everything, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--duration", type=float, default=200, help="simulated s of Well 2")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    facts = measure.provenance(options.build)
    seconds = {}
    last = {}
    for _ in range(options.repeats):
        for run, (_, case, settings, part) in enumerate(RUNS):
            for threads in (1, 2):
                duration = options.duration * part
                found, _, _ = measure.run_case(options.build, case,
                                               settings | {"run.duration": duration}, threads)
                seconds.setdefault((run, threads), []).append(found["wall_seconds"] / duration)
                last[run] = found
    rows = []
    for run, (name, _, _, part) in enumerate(RUNS):
        one, two = (statistics.median(seconds[run, threads]) for threads in (1, 2))
        rows.append({
            "run": name,
            "simulated (s)": f"{options.duration * part:g}",
            "step (ms)": f"{1e3 * last[run]['largest_step']:.3g}",
            "one thread (ms per simulated s)": f"{1e3 * one:.3g}",
            "over Well 2": f"{one / statistics.median(seconds[0, 1]):.3g}",
            "two threads (ms)": f"{1e3 * two:.3g}",
            "gain": f"{one / two:.3g}",
            "energy that appears (%)": f"{100 * last[run]['energy_residual']:.2g}",
        })
    measure.write_csv(measure.results_folder(options.machine) / "local_steps.csv", facts, rows)
    table = measure.markdown(rows)
    print(table)
    if options.publish:
        measure.publish("local-steps", facts,
                        "Wall time of runs with steps of their own size where the mesh is fine, and "
                        "with one small step for all.", table)


if __name__ == "__main__":
    main()

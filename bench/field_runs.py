#!/usr/bin/python3
"""The shipped field cases with the leapfrog, from start to end, on one thread and on two in turn.

What a user waits for, results included, at the default step; also with the paper's numbers. Both runs of a case must have the same series, bit for bit.
"""

import argparse
import statistics

import numpy as np

import measure

PAPER = ", the paper's numbers"
CASES = [("Well 1, drilling", "well1.toml"), (f"Well 1, drilling{PAPER}", "well1_paper.toml"),
         ("Well 2", "well2.toml"), (f"Well 2{PAPER}", "well2_paper.toml"),
         ("Well 2, drilling", "well2_drilling.toml"),
         (f"Well 2, drilling{PAPER}", "well2_drilling_paper.toml"),
         ("Well 3", "well3.toml"), (f"Well 3{PAPER}", "well3_paper.toml")]
THREADS = (1, 2)


def measure_case(options, name, case):
    """Medians of one case, as a dict."""
    walls = {threads: [] for threads in THREADS}
    processor = []
    kept = {}
    for _ in range(options.rounds):
        for threads in THREADS:
            attributes, series, seconds = measure.run_case(options.build, case, {}, threads)
            walls[threads].append(float(attributes["wall_seconds"]))
            if threads == 1:
                processor.append(seconds)
            kept[threads] = series
    identical = all(np.array_equal(kept[1][key], kept[2][key]) for key in kept[1])
    duration = float(kept[1]["time"][-1])
    one, two = (statistics.median(walls[threads]) for threads in THREADS)
    return {
        "case": name, "simulated (s)": duration, "steps": int(attributes["steps"]),
        "wall, 1 thread (s)": one, "wall, 2 threads (s)": two,
        "processor, 1 thread (s)": statistics.median(processor),
        "1 thread / 2 threads": one / two, "simulated s per s": duration / min(one, two),
        "energy residual": float(attributes["energy_residual"]),
        "time error": float(attributes["time_error"]),
        "equal on both": identical,
    }


def text_of(row):
    """A row for RESULTS.md."""
    return {
        "case": row["case"], "simulated": f"{row['simulated (s)']:.0f} s",
        "steps": f"{row['steps']}",
        "1 thread": f"{row['wall, 1 thread (s)']:.2f} s",
        "2 threads": f"{row['wall, 2 threads (s)']:.2f} s",
        "ratio": f"{row['1 thread / 2 threads']:.2f}",
        "simulated s per s": f"{row['simulated s per s']:.0f}",
        "energy residual": f"{100 * row['energy residual']:.1g} %",
        "time error of 16 steps": f"{100 * row['time error']:.1g} %",
        "equal on both": "yes" if row["equal on both"] else "NO",
    }


def text_for_users(row):
    """A row for README.md."""
    return {"case": row["case"], "simulated": f"{row['simulated (s)']:.0f} s",
            "it takes": f"{min(row['wall, 1 thread (s)'], row['wall, 2 threads (s)']):.1f} s",
            "steps": f"{row['steps']}", "energy residual": f"{100 * row['energy residual']:.1g} %"}


def publish(options, facts, rows):
    """The table of RESULTS.md, and what is left of it in README.md."""
    measure.publish(
        "field-runs", facts,
        "The cases as they are shipped, and with the paper's numbers. Wall time from start to end, "
        f"results included; medians of {options.rounds} rounds, one and two threads in turn. The "
        "largest sampled time error of the latter belongs to the first instants, when the string "
        "falls from the axis.",
        measure.markdown([text_of(row) for row in rows]))
    shipped = [row for row in rows if PAPER not in row["case"]]
    measure.publish(
        "field-runs", facts,
        "The shipped field cases with `leapfrog`, from start to end, results included:",
        measure.markdown([text_for_users(row) for row in shipped]),
        page=measure.ROOT / "README.md")


def main():
    """Measures, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--rounds", type=int, default=5, help="turns of one and two threads")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    facts.append(("method", f"medians of {options.rounds} rounds, one and two threads in turn"))
    rows = [measure_case(options, *case) for case in CASES]
    measure.write_csv(measure.results_folder(options.machine) / "field_runs.csv", facts, rows)
    table = measure.markdown([text_of(row) for row in rows])
    print(table)
    if options.publish:
        publish(options, facts, rows)


if __name__ == "__main__":
    main()

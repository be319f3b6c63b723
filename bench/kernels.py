#!/usr/bin/python3
"""Time per node of each kernel beside its scalar twin, as a table.

Runs bench_kernels with the repetitions of all benchmarks in random order, so that a change of the
machine's speed meets all of them, and takes the median of each.
"""

import argparse
import json
import subprocess

import measure

SIDES = ("vector", "plain", "vector, 2 threads")


def medians(options):
    """{(kernel, segments): {side: ns per node}} from bench_kernels."""
    command = [measure.executable(options.build, "bench/bench_kernels"), "--benchmark_format=json",
               f"--benchmark_filter={options.filter}",
               f"--benchmark_repetitions={options.repetitions}",
               f"--benchmark_min_time={options.seconds}",
               "--benchmark_enable_random_interleaving=true",
               "--benchmark_report_aggregates_only=true"]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    table = {}
    entries = json.loads(done.stdout)["benchmarks"]
    for entry in sorted(entries, key=lambda entry: entry["family_index"]):
        if entry["aggregate_name"] != "median":
            continue
        kernel, side, segments = entry["run_name"].split("/")[:3]
        table.setdefault((kernel, int(segments)), {})[side] = entry["ns_per_node"]
    return table


def publish(table, facts):
    """One line per kernel, one column per mesh: vector (plain, ratio)."""
    meshes = sorted({segments for _, segments in table})
    rows = []
    for kernel in dict.fromkeys(kernel for kernel, _ in table):
        row = {"kernel": kernel}
        for segments in meshes:
            ns = table[kernel, segments]
            row[f"N = {segments}"] = (f"{ns['vector']:.1f} ({ns['plain']:.1f}, "
                                      f"{ns['plain'] / ns['vector']:.1f}x)")
        if any(SIDES[2] in ns for ns in table.values()):
            ns = table[kernel, meshes[-1]].get(SIDES[2])
            row[f"2 threads, N = {meshes[-1]}"] = f"{ns:.1f}" if ns else ""
        rows.append(row)
    measure.publish(
        "kernels", facts,
        "Nanoseconds per node; in brackets those of a plain scalar twin (arrays of structures, "
        "functions of the C library) that computes the same, and how many times longer it takes. "
        "Medians of interleaved repetitions. A step is one attempted Dormand-Prince step, that is "
        "six evaluations of the right-hand side.",
        measure.markdown(rows))


def main():
    """Measures, writes the CSV file and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__)
    measure.add_options(parser)
    parser.add_argument("--filter", default=".", help="which benchmarks to run; on a machine that "
                        "does other things, \"-2 threads\" leaves out what would mislead")
    parser.add_argument("--repetitions", type=int, default=9)
    parser.add_argument("--seconds", type=float, default=0.05, help="of each repetition, at least")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    facts.append(("method", f"median of {options.repetitions} repetitions in random order, "
                            f"{options.seconds} s each; ns per node of processor time, with 2 "
                            "threads of wall time"))
    table = medians(options)
    rows = [{"kernel": kernel, "segments": segments,
             **{f"{side} (ns per node)": f"{ns[side]:.3f}" if side in ns else "" for side in SIDES}}
            for (kernel, segments), ns in table.items()]
    measure.write_csv(measure.results_folder(options.machine) / "kernels.csv", facts, rows)
    if options.publish:
        publish(table, facts)


if __name__ == "__main__":
    main()

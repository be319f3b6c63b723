#!/usr/bin/python3
"""Random scenes over engineers' ranges with the leapfrog: does any of them diverge or gain energy?

200 scenes of 20 simulated seconds, ten of ten minutes, 200 of a minute with what excites itself (bits that
stick or cut, top drives, friction that falls with speed, mud in motion) and 60 assemblies of five seconds (tool
joints, stabilisers, bits, casing and open hole), always the same ones, several at a time.
Each must come to its end or be stopped by a physical guard that names place and time.
"""

import argparse
import csv
import io
import os
import subprocess
import sys

import measure

MOST_GUARDS = 0.03  # share of scenes that guards may stop
MOST_GAIN = 0.05  # of the energy that moved
STIFF = 1e6  # Pa; below it the wall is soft and penetration is what was asked for
LARGEST_LONG = 400  # segments of a scene that runs for minutes
LARGEST_DRIVEN = 400  # segments of a scene with laws and drives
LARGEST_ASSEMBLY = 600  # segments of an assembly, whose steps are short


def run(options, scenes, duration, more=()):
    """Runs scenes; returns one dict of text for each, in their order."""
    command = [str(measure.executable(options.build, "bench/bench_stress")),
               "--seed", str(options.seed), "--scenes", str(scenes), "--duration", str(duration),
               "--jobs", str(options.jobs), *more]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}")
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    if len(rows) != scenes:
        sys.exit(f"{' '.join(command)} reported {len(rows)} of {scenes} scenes")
    return sorted(rows, key=lambda row: int(row["scene"]))


def column(rows, name):
    return [float(row[name]) for row in rows]


def worst(rows, name):
    """Value of largest size, and its scene."""
    row = max(rows, key=lambda row: abs(float(row[name])))
    return float(row[name]), row["scene"]


def guard_of(row):
    """A short name for what stopped a scene."""
    names = {"stress": "stress", "turned": "turn", "buckle": "buckle"}
    return next((name for word, name in names.items() if word in row["why"]), "other")


def guards_text(rows):
    """How many scenes guards stopped, by guard."""
    stopped = [guard_of(row) for row in rows if row["outcome"] == "guard"]
    kinds = ", ".join(f"{stopped.count(kind)} {kind}" for kind in sorted(set(stopped)))
    return f"{len(stopped)} ({100 * len(stopped) / len(rows):.1f} %)" + (f": {kinds}" if kinds else "")


def summary(rows):
    """The numbers of a set of scenes, as text by name."""
    residual, residual_scene = worst(rows, "residual")
    gain, gain_scene = worst(rows, "gain")
    deep, deep_scene = worst(rows, "penetration_m")
    stiff = [row for row in rows if float(row["normal_stiffness"]) >= STIFF]
    firm, firm_scene = worst(stiff or rows, "penetration_m")
    processor = column(rows, "processor_s")
    return {
        "scenes": f"{len(rows)} of {max(column(rows, 'time_s')):.0f} s",
        "came to their end": str(sum(row["outcome"] == "complete" for row in rows)),
        "stopped by a guard": guards_text(rows),
        "diverged, or a number not finite": str(sum(row["outcome"] == "diverged" for row in rows)),
        "largest energy residual at the end": f"{100 * residual:.2g} % (scene {residual_scene})",
        "most energy that appeared at any time": f"{100 * gain:.2g} % (scene {gain_scene})",
        "deepest penetration": f"{1000 * deep:.3g} mm (scene {deep_scene})",
        "deepest where k_el >= 1 MPa": f"{1000 * firm:.3g} mm (scene {firm_scene})",
        "impacts, slips": f"{sum(column(rows, 'impacts')):.3g}, {sum(column(rows, 'slips')):.3g}",
        "simulated s per processor s": f"{sum(column(rows, 'time_s')) / sum(processor):.0f}",
    }


def failures(rows):
    """What a set of scenes has not kept to."""
    problems = [f"scene {row['scene']}: {row['why']}" for row in rows
                if row["outcome"] == "diverged"]
    problems += [f"scene {row['scene']}: {100 * float(row['gain']):.2g} % of its energy appeared"
                 for row in rows if float(row["gain"]) > MOST_GAIN]
    stopped = sum(row["outcome"] == "guard" for row in rows)
    if stopped > MOST_GUARDS * len(rows):
        problems.append(f"guards stopped {stopped} of {len(rows)} scenes")
    return problems


def main():
    """Runs both sets, writes CSV and, if asked, RESULTS.md; ends with 1 where a scene fails."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--scenes", type=int, default=200, help="of 20 s (default: 200)")
    parser.add_argument("--long", type=int, default=10, help="of ten minutes (default: 10)")
    parser.add_argument("--assemblies", type=int, default=60, help="of five seconds (default: 60)")
    parser.add_argument("--driven", type=int, default=200, help="of a minute (default: 200)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="scenes at a time")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    facts.append(("scenes", f"seed {options.seed}, cfl 0.9, one thread each, {options.jobs} at a "
                            "time"))
    short = run(options, options.scenes, 20)
    sets = [short]
    if options.long > 0:
        sets.append(run(options, options.long, 600,
                        ["--first", "1000", "--most-segments", str(LARGEST_LONG)]))
    names = ["stress.csv", "stress_long.csv"][:len(sets)]
    if options.driven > 0:
        sets.append(run(options, options.driven, 60,
                        ["--driven", "--most-segments", str(LARGEST_DRIVEN)]))
        names.append("stress_driven.csv")
    if options.assemblies > 0:
        sets.append(run(options, options.assemblies, 5,
                        ["--assemblies", "--most-segments", str(LARGEST_ASSEMBLY)]))
        names.append("stress_assemblies.csv")
    folder = measure.results_folder(options.machine)
    for name, rows in zip(names, sets):
        measure.write_csv(folder / name, facts, rows)
    summaries = {}
    for rows in sets:
        numbers = summary(rows)
        summaries[numbers.pop("scenes")] = numbers
    names = next(iter(summaries.values()))
    table = measure.markdown([{"": name, **{scenes: numbers[name]
                                            for scenes, numbers in summaries.items()}}
                              for name in names])
    print(table)
    if options.publish:
        measure.publish(
            "stress", facts,
            "Random scenes over the ranges that engineers use (pipe of 2 3/8 to 20 in, 100 to "
            "8000 m, doglegs to 15 deg/30 m, 0 to 300 rpm, 0 to 500 kN, friction 0 to 0.8, fluid to "
            "0.1 Pa s, stiffness of the wall 1e4 to 1e9 Pa) with the leapfrog at cfl 0.9. Energies "
            "are parts of the energy that moved in the run.", table)
    problems = failures([row for rows in sets for row in rows])
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()

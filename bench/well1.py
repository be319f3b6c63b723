#!/usr/bin/python3
"""Well 1 with the paper's numbers to its end, on one thread and on two: speed, steps, loads, energy.

The paper's figure 21: 20 s of relaxation, rotation, and from 45 s on weight and torque at the bit.
A steady weight has to take its own size off the head's tension, and the steps should lie between
0.3e-5 and 3e-5 s as the paper's do.
"""

import argparse

import numpy as np

import measure

CASE = "well1_paper.toml"
BEFORE, AFTER = (35, 45), (60, 70)  # s: before the weight comes on, and under full load
WEIGHT = 65e3  # N
STEPS = (0.3e-5, 3e-5)  # s, the range of the paper's steps


def mean(series, name, column, window):
    """Mean of a series over a window of time; None where the run did not get that far."""
    time = series["time"]
    inside = (time >= window[0]) & (time <= window[1])
    if time[-1] < window[1]:
        return None
    return float(np.mean(series[name][inside, column]))


def change(series, name, column):
    """How much the mean of a series changes when the weight comes on."""
    before, after = (mean(series, name, column, window) for window in (BEFORE, AFTER))
    return None if before is None or after is None else after - before


def summary(attributes, series, processor_seconds):
    """The numbers of one run, by name."""
    duration = float(series["time"][-1])
    step = series["step_size"][1:]
    tension = change(series, "head_stress", 3)
    return {
        "threads": int(attributes["threads"]),
        "simulated (s)": duration,
        "wall (s)": float(attributes["wall_seconds"]),
        "simulated s per wall s": duration / float(attributes["wall_seconds"]),
        "processor time (s)": processor_seconds,
        "simulated s per processor s": duration / processor_seconds,
        "accepted steps": int(attributes["steps"]),
        "rejected steps": int(attributes["steps_rejected"]),
        "mean step (s)": duration / int(attributes["steps"]),
        "largest step (s)": float(attributes["largest_step"]),
        "median of sampled steps (s)": float(np.median(step)),
        "5th percentile (s)": float(np.percentile(step, 5)),
        "95th percentile (s)": float(np.percentile(step, 95)),
        "share of sampled steps in 0.3e-5..3e-5 s":
            float(np.mean((step >= STEPS[0]) & (step <= STEPS[1]))),
        "change of head tension (N)": tension,
        "departure from -65 kN": None if tension is None else tension / -WEIGHT - 1,
        "head torque before weight (N m)": mean(series, "head_stress", 0, BEFORE),
        "head torque under weight (N m)": mean(series, "head_stress", 0, AFTER),
        "bit torque under weight (N m)": mean(series, "bit_stress", 0, AFTER),
        "most nodes in contact": int(np.max(series["contact_nodes"])),
        "energy residual": float(attributes["energy_residual"]),
    }


def text_of(name, value):
    """A number of the summary for RESULTS.md."""
    if value is None:
        return "not reached"
    if isinstance(value, int):
        return f"{value}"
    if name.startswith(("share", "departure")):
        return f"{100 * value:.2f} %"
    if name == "energy residual":
        return f"{100 * value:.3g} %"
    if name.endswith(("(N)", "(N m)")):
        return f"{value:.0f}"
    return f"{value:.2f}" if value > 0.01 else f"{value:.2e}"


def publish(runs, identical, facts, picture):
    """One column per run."""
    names = [name for name in runs[0] if name != "threads"]
    rows = [{"": name, **{f"{run['threads']} thread{'s' * (run['threads'] > 1)}":
                          text_of(name, run[name]) for run in runs}} for name in names]
    measure.publish(
        "well1", facts,
        f"`cases/{CASE}` to its end. Steps are sampled at the records, every 0.1 s: the last "
        "one before a record may be cut to half. Tension and torques are means over "
        f"{BEFORE[0]} to {BEFORE[1]} s (before the weight) and {AFTER[0]} to {AFTER[1]} s (under "
        "it). All series of the two runs are "
        f"{'equal bit for bit' if identical else 'DIFFERENT'}.",
        measure.markdown(rows), picture=picture)


def draw(series, path):
    """The six stresses at the head, kinetic energy and step, like the paper's figure 21."""
    picture, panels = measure.figure(8, 11, nrows=6, sharex=True)
    time = series["time"]
    stress = series["head_stress"] / 1e3
    pairs = [
        (0, [(3, "axial", measure.BLUE, "-")], "axial force (kN)"),
        (1, [(0, "twist", measure.BLUE, "-")], "twist moment (kN m)"),
        (2, [(4, "shear 1", measure.BLUE, "-"), (5, "shear 2", measure.RED, "--")],
         "shear force (kN)"),
        (3, [(1, "bending 1", measure.BLUE, "-"), (2, "bending 2", measure.RED, "--")],
         "bending moment (kN m)"),
    ]
    for panel, lines, label in pairs:
        for column, name, colour, style in lines:
            panels[panel].plot(time, stress[:, column], style, color=colour, linewidth=0.9,
                               label=name)
        panels[panel].set_ylabel(label)
        if len(lines) > 1:
            panels[panel].legend(fontsize=8, loc="upper left", ncols=2)
    panels[4].plot(time, series["kinetic_energy"] / 1e3, color=measure.GREEN, linewidth=0.9)
    panels[4].set_ylabel("kinetic energy (kJ)")
    panels[5].semilogy(time[1:], series["step_size"][1:], ".", markersize=2, color=measure.PURPLE)
    panels[5].axhspan(*STEPS, color="grey", alpha=0.15)
    panels[5].set_ylim(1e-6, 1e-4)
    panels[5].set_ylabel("step (s)")
    panels[5].set_xlabel("time (s)")
    panels[0].set_title("Well 1: stresses at the head (grey: range of the paper's steps)")
    picture.align_ylabels()
    measure.save(picture, path)


def main():
    """Measures, writes CSV and picture and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--duration", type=float, default=70,
                        help="simulated (s); shorter ones try the script out")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    facts.append(("case", f"cases/{CASE}, {options.duration:g} s"))
    settings = {"run.integrator": '"dormand-prince"', "run.duration": options.duration}
    results = [measure.run_case(options.build, CASE, settings, threads) for threads in (1, 2)]
    one, two = (series for _, series, _ in results)
    identical = all(np.array_equal(one[name], two[name]) for name in one)
    facts.append(("threads", "series of both runs are "
                             + ("equal bit for bit" if identical else "DIFFERENT")))
    runs = [summary(*result) for result in results]

    folder = measure.results_folder(options.machine)
    measure.write_csv(folder / "well1.csv", facts, runs)
    draw(one, folder / "well1.png")
    if options.publish:
        publish(runs, identical, facts, folder / "well1.png")


if __name__ == "__main__":
    main()

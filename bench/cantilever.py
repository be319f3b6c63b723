#!/usr/bin/python3
"""The cantilever's error and step against the number of segments: the paper's figures 3 and 4.

static    tip at rest against the exact boundary-value solution (shooting to 1e-13)
swing     the paper's damped motion against its limit: Richardson extrapolation from the two finest
          meshes with the paper's inertia; the paper measures against its finest mesh itself
release   the motion without damping at t = 2 s against an independent solution (discontinuous
          Galerkin spectral elements, seven digits)

swing and release run with and without segment inertia; the paper has none.
"""

import argparse
import math
import sys

import numpy as np

import measure

EXACT_REST = (22.9482601424, -6.5661001281)  # m, along and up; g = 9.81, shear coefficient 1
RELEASE_TIME = 2.0  # s
RELEASE = (19.872558851, -12.390616597)  # m, along and up, at that time
LENGTH = 24.0  # m
CASE = "cantilever.toml"
NEAR_CRITICAL = 100.0  # Pa s: 2 m times the lowest natural frequency, 1.47 rad/s
INTERVAL = 0.05  # s
INSTANT = 3.0  # s
SWING_ERRORS = ("swing error (m s^0.5)", "swing error at 3 s (m)")


def tip(series):
    """Tip along and up (m), one row per record."""
    position = series["bit_position"]
    return np.column_stack([position[:, 0], -position[:, 2]])


def run(options, segments, settings):
    """Runs the cantilever; returns attributes, series and processor time."""
    print(f"N = {segments}: {settings}", file=sys.stderr)
    common = {"run.integrator": '"dormand-prince"', "mesh.segments": segments,
              "output.interval": INTERVAL, "output.profile_interval": 0}
    return measure.run_case(options.build, CASE, common | settings)


def swing(options, segments, inertia):
    """The paper's damped motion."""
    return run(options, segments,
               {"run.duration": options.duration, "mesh.segment_inertia": inertia})


def static_error(options, segments):
    """Distance of the tip at rest from the exact one (m). Inertia does not matter at rest: that of
    the segments takes fewer steps."""
    _, series, _ = run(options, segments,
                       {"run.duration": 16, "mesh.segment_inertia": True,
                        "damping.internal": 0, "damping.external": NEAR_CRITICAL})
    return math.dist(tip(series)[-1], EXACT_REST)


def release_error(options, segments, inertia):
    """Distance of the tip of the undamped cantilever from the independent solution (m)."""
    _, series, _ = run(options, segments,
                       {"run.duration": RELEASE_TIME, "mesh.segment_inertia": inertia,
                        "damping.internal": 0, "damping.external": 0})
    return math.dist(tip(series)[-1], RELEASE)


def distance(motion, reference):
    """L2 distance of two motions over time, [integral of |x - y|^2 dt]^(1/2), in m s^(1/2)."""
    return math.sqrt(np.trapz(np.sum((motion - reference) ** 2, axis=1), dx=INTERVAL))


def extrapolate(motions):
    """The limit of a second-order sequence of motions, from the two finest meshes."""
    coarse, fine = sorted(motions)[-2:]
    ratio = (fine / coarse) ** 2
    return (ratio * motions[fine] - motions[coarse]) / (ratio - 1)


def measure_table(options, meshes, inertia, at_rest, swings, reference):
    """The lines of one table: one per mesh."""
    rows = []
    for segments in meshes:
        attributes, series, seconds = swings[segments]
        motion = tip(series)
        instant = round(INSTANT / INTERVAL)
        rows.append({
            "segment_inertia": inertia,
            "segments": segments,
            "h (m)": LENGTH / segments,
            "static error (m)": at_rest[segments],
            "swing error (m s^0.5)": distance(motion, reference),
            "swing error at 3 s (m)": math.dist(motion[instant], reference[instant]),
            "release error at 2 s (m)": release_error(options, segments, inertia),
            "mean step (s)": options.duration / attributes["steps"],
            "smallest step (s)": attributes["smallest_step"],
            "largest step (s)": attributes["largest_step"],
            "accepted steps": int(attributes["steps"]),
            "rejected steps": int(attributes["steps_rejected"]),
            "processor time (s)": seconds,
        })
    return rows


def orders(rows, key):
    """Order between each mesh and the one before: log2 of the ratio of errors."""
    values = [row[key] for row in rows]
    return [None] + [math.log2(a / b) for a, b in zip(values, values[1:])]


def with_order(value, order):
    """An error and its order as text."""
    return f"{value:.2e}" + (f" ({order:.2f})" if order is not None else "")


def publish(tables, options, facts):
    """The table of RESULTS.md: errors with their orders, steps, cost."""
    introduction = (
        "Distance of the tip (order in brackets): at rest, from the exact solution; of the paper's "
        f"damped swing over {options.duration:g} s (root of the integral of its square over time) "
        "and at t = 3 s, from the limit extrapolated from the two finest meshes with the paper's "
        "inertia (so that the finest error there is an estimate and has no order); of the undamped "
        "swing at t = 2 s, from an independent spectral solution. Steps and processor time are "
        "those of the damped swing with the paper's tolerances; the smallest step of every run is "
        "its first.")
    parts = []
    for inertia, rows in tables.items():
        lines = []
        columns = {key: orders(rows, key) for key in
                   ("static error (m)", *SWING_ERRORS, "release error at 2 s (m)")}
        if not inertia:  # two meshes cannot show the order that their limit was built on
            for key in SWING_ERRORS:
                columns[key][-1] = None
        for i, row in enumerate(rows):
            lines.append({
                "N": str(row["segments"]),
                **{key: with_order(row[key], order[i]) for key, order in columns.items()},
                "step, mean (s)": f"{row['mean step (s)']:.2e}",
                "least to most (s)":
                    f"{row['smallest step (s)']:.1e} to {row['largest step (s)']:.1e}",
                "time (s)": f"{row['processor time (s)']:.1f}"})
        title = ("With segment inertia (`mesh.segment_inertia = true`)" if inertia
                 else "The paper's rotary inertia (the default)")
        parts.append(f"{title}:\n\n{measure.markdown(lines)}")
    measure.publish("cantilever", facts, introduction, *parts,
                    picture=measure.results_folder(options.machine) / "cantilever.png")


def draw(tables, motions, reference, time, path):
    """Motion of the tip, errors and steps against h."""
    picture, (left, middle, right) = measure.figure(11, 4.6, ncols=3)
    colours = [measure.ORANGE, measure.SKY, measure.GREEN]
    for (segments, motion), colour in zip(list(motions.items())[:3], colours):
        left.plot(time, motion[:, 1], color=colour, label=f"N = {segments}")
    left.plot(time, reference[:, 1], color="black", linewidth=1, linestyle="--", label="limit")
    left.axhline(EXACT_REST[1], color="grey", linewidth=0.8, linestyle=":")
    left.set(xlabel="time (s)", ylabel="height of the tip (m)",
             title="Damped swing, paper's inertia")
    measure.legend_below(left)

    styles = {False: ("paper's inertia", measure.BLUE, "o"),
              True: ("segment inertia", measure.RED, "s")}
    for inertia, rows in tables.items():
        name, colour, marker = styles[inertia]
        h = [row["h (m)"] for row in rows]
        middle.loglog(h, [row["swing error (m s^0.5)"] for row in rows], marker=marker,
                      color=colour, label=f"swing, {name} (m s$^{{1/2}}$)")
        mean = np.array([row["mean step (s)"] for row in rows])
        span = [mean - [row["smallest step (s)"] for row in rows],
                [row["largest step (s)"] for row in rows] - mean]
        shift = 1.03 if inertia else 0.97  # bars side by side
        right.errorbar(np.array(h) * shift, mean, yerr=span, marker=marker, color=colour,
                       capsize=3, label=name)
    rows = tables[False]
    h = np.array([row["h (m)"] for row in rows])
    rest = np.array([row["static error (m)"] for row in rows])
    middle.loglog(h, rest, marker="^", color=measure.GREEN, label="rest (m)")
    middle.loglog(h, rest[0] * 0.4 * (h / h[0]) ** 2, color="grey", linestyle=":",
                  label="slope 2")
    middle.set(xlabel="segment length h (m)", ylabel="error of the tip (m, m s$^{1/2}$)",
               title="Errors")
    measure.legend_below(middle)
    right.set(xscale="log", yscale="log", xlabel="segment length h (m)", ylabel="step (s)",
              title="Accepted steps: mean, least, most")
    measure.legend_below(right)
    measure.save(picture, path)


def main():
    """Measures, writes CSV and picture and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--duration", type=float, default=10, help="of the damped swing (s)")
    parser.add_argument("--finest", type=int, default=256, help="segments of the finest mesh")
    options = parser.parse_args()
    if options.duration < INSTANT:
        sys.exit(f"--duration {options.duration:g} is shorter than {INSTANT:g} s")

    facts = measure.provenance(options.build)
    facts.append(("case", f"cases/{CASE}; static: damping.internal = 0, damping.external = "
                          f"{NEAR_CRITICAL:g}, 16 s; swing: {options.duration:g} s"))
    facts.append(("references", "static: exact boundary-value solution; swing: Richardson "
                  "extrapolation from the two finest meshes with the paper's inertia; release: "
                  "independent spectral solution"))
    meshes = [n for n in (8, 16, 32, 64, 128, 256) if n <= options.finest]
    swings = {inertia: {n: swing(options, n, inertia) for n in meshes} for inertia in (False, True)}
    motions = {inertia: {n: tip(series) for n, (_, series, _) in runs.items()}
               for inertia, runs in swings.items()}
    reference = extrapolate(motions[False])
    doubt = distance(extrapolate(motions[True]), reference)
    facts.append(("doubt", "the same extrapolation with segment inertia lies "
                           f"{doubt:.1e} m s^0.5 from the swing's reference"))
    at_rest = {n: static_error(options, n) for n in meshes}
    tables = {inertia: measure_table(options, meshes, inertia, at_rest, swings[inertia], reference)
              for inertia in (False, True)}

    folder = measure.results_folder(options.machine)
    measure.write_csv(folder / "cantilever.csv", facts, tables[False] + tables[True])
    time = swings[False][meshes[0]][1]["time"]
    draw(tables, motions[False], reference, time, folder / "cantilever.png")
    if options.publish:
        publish(tables, options, facts)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Two start-ups of a real well against cases/startup_field.toml: torque and speed at the head, least and
most speed at the bit.

The curves are those of figures 15 and 16 of U. J. F. Aarsnes and R. J. Shor, "Torsional vibrations with
bit off bottom: Modeling, identification and field data validation", J. Petroleum Science and Engineering
163 (2018), taken from the vector graphics of the preprint. They are not part of the project: --data names
the folder that holds them.

What the head is set to follows from the recorded torque and speed by the source's drive, torque = K_p e +
K_i integral of e, and is steady where both swing. Friction is fitted, with --fit, to the torque of the
first 30 s of the first record and to nothing else; otherwise it is what the case has.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import measure

CASE = "startup_field.toml"
ASSEMBLY = 230.0  # m
PROPORTIONAL, INTEGRAL = 38.0, 100.0  # kN m s, kN m: of the source's drive
RPM = np.pi / 30  # rad/s
INTERVAL = 0.02  # s
FITTED = 30.0  # s of the first record
SETTLED = 10.0  # s after which the bit's speeds count: it stands still until then
WINDOW = 0.5  # s, in which the least and the most of the bit's speed were recorded

INTRODUCTION = (
    "Two start-ups of a real well with the bit off bottom (Aarsnes and Shor 2018, figures 15 and 16), "
    "with four numbers of friction fitted to the torque of the first 30 s of the first: static and "
    "dynamic, the speed over which the one falls to the other, and casing over open hole. The motion "
    "sticks and slips as the record does in the first well, and goes on doing so in the second, where "
    "the record swings half as far and seldom sticks; the bit is too fast in both.")

# What is fitted, and between which bounds.
FRICTION = {"static": (0.3, 1.0), "dynamic over static": (0.2, 0.8), "speed": (0.03, 1.2),
            "casing over open hole": (0.2, 1.0)}


@dataclass
class Record:
    """A start-up: `depth` of the bit (m), `end` of the comparison (s)."""
    name: str
    stem: str
    depth: float
    end: float

    def curve(self, data, quantity):
        """A curve of the source at even times; ends the program where it is missing."""
        path = data / f"{self.stem}_{quantity}.csv"
        if not path.exists():
            sys.exit(f"{path} is missing; expected the folder of the source's curves after --data")
        points = np.loadtxt(path, delimiter=",", comments="#")
        return np.interp(self.times(), points[:, 0], points[:, 1])

    def times(self):
        """Even times (s)."""
        return np.arange(0, self.end, INTERVAL)


RECORDS = [Record("figure 15", "aarsnes_shor_fig15_wellB_1733m", 1733.0, 50.0),
           Record("figure 16", "aarsnes_shor_fig16_wellB_2235m", 2235.0, 50.0)]


def smoothed(values, width):
    """A mean over so many neighbours, weighted by a bell."""
    bell = np.hanning(width + 2)[1:-1]
    padded = np.pad(values, width // 2, mode="edge")
    return np.convolve(padded, bell / bell.sum(), "valid")[:len(values)]


def corners(times, values, tolerance):
    """Points between which straight lines keep within a tolerance (Douglas and Peucker)."""
    kept, open_parts = {0, len(times) - 1}, [(0, len(times) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        part = slice(first, last + 1)
        off = np.abs(values[part] - np.interp(times[part], times[[first, last]], values[[first, last]]))
        if off.max() > tolerance:
            middle = first + int(off.argmax())
            kept.add(middle)
            open_parts += [(first, middle), (middle, last)]
    return sorted(kept)


def set_rotation(data, record):
    """The head's set rate as a schedule of a case, from the recorded torque and speed."""
    torque = record.curve(data, "torque_recorded_kNm")
    integral, lag = 0.0, []
    for value in torque:
        lag.append((value - INTEGRAL * integral) / PROPORTIONAL)
        integral += INTERVAL * lag[-1]
    rate = smoothed(record.curve(data, "top_recorded_rpm") + np.array(lag) / RPM, 25)
    rate[torque < 0.5] = 0.0  # at rest
    points = [f'[{record.times()[i]:.2f}, "{rate[i]:.1f} rpm"]'
              for i in corners(record.times(), rate, 0.7)]
    return "[" + ", ".join(points) + "]"


def friction_settings(values):
    """Case keys of friction, from values as FRICTION lists them."""
    static, ratio, speed, casing = values
    return {"contact.static_friction": static, "contact.dynamic_friction": ratio * static,
            "contact.stribeck_speed": speed, "well.section.0.static_friction": casing * static,
            "well.section.0.dynamic_friction": casing * ratio * static}


def simulate(options, record, rotation, end, settings):
    """Torque of the drive (kN m), rates of head and bit (rpm) at the record's times up to `end`."""
    settings = {"head.rotation": rotation, "run.duration": end, "output.interval": INTERVAL,
                "string.component.0.length": record.depth - ASSEMBLY} | settings
    _, series, _ = measure.run_case(options.build, CASE, settings)
    times = record.times()[record.times() < end]

    def at_times(name, unit):
        return np.interp(times, series["time"], series[name]) / unit

    return {"torque": at_times("drive_torque", 1e3), "head": at_times("head_rotation_rate", RPM),
            "bit": at_times("bit_rotation_rate", RPM)}


def rms(difference):
    """Root of the mean square."""
    return float(np.sqrt(np.mean(difference ** 2)))


def period(values):
    """Time after which a curve is most like itself (s), between 2.5 and 7 s."""
    swing = values - values.mean()
    lags = np.arange(int(2.5 / INTERVAL), int(7 / INTERVAL))
    likeness = [np.corrcoef(swing[:-lag], swing[lag:])[0, 1] for lag in lags]
    return float(lags[int(np.argmax(likeness))] * INTERVAL)


def row_of(record, what, torque, recorded, least, most):
    """A row of the table."""
    late = record.times() > 15.0
    return {"record": f"{record.name}, {record.depth:.0f} m", "curve": what,
            "rms of torque (kN m)": f"{rms(torque - recorded):.2f}",
            "correlation": f"{np.corrcoef(torque, recorded)[0, 1]:.2f}",
            "period (s)": f"{period(torque[late]):.2f}",
            "mean torque (kN m)": f"{torque[late].mean():.1f}",
            "troughs, peaks (kN m)": "{:.1f}, {:.1f}".format(*np.percentile(torque[late], [5, 95])),
            "bit, least and most (rpm)": f"{least:.0f}, {most:.0f}"}


def rows_of(options, record):
    """The record itself, the source's model, and ours."""
    after = record.times() > SETTLED
    recorded = record.curve(options.data, "torque_recorded_kNm")
    pair = [record.curve(options.data, f"bit_recorded_min_or_max_{i}_rpm")[after] for i in (1, 2)]
    theirs = record.curve(options.data, "bit_model_rpm")[after]
    ours = simulate(options, record, set_rotation(options.data, record), record.end, options.friction)
    bit = ours["bit"][after]
    return [row_of(record, "recorded", recorded, recorded, np.min(pair), np.max(pair)),
            row_of(record, "the source's model", record.curve(options.data, "torque_model_kNm"),
                   recorded, theirs.min(), theirs.max()),
            row_of(record, "drillstrand", ours["torque"], recorded, bit.min(), bit.max())], ours


def fit(options):
    """Friction that fits the torque of the first record's first part best."""
    from scipy.optimize import differential_evolution
    record = RECORDS[0]
    rotation = set_rotation(options.data, record)
    recorded = record.curve(options.data, "torque_recorded_kNm")

    def error(values):
        torque = simulate(options, record, rotation, FITTED, friction_settings(values))["torque"]
        result = rms(torque - recorded[:len(torque)])
        print(f"{result:.3f} kN m with {np.round(values, 3)}", file=sys.stderr)
        return result

    found = differential_evolution(error, list(FRICTION.values()), popsize=options.population,
                                   maxiter=options.generations, seed=1, polish=False, init="sobol")
    for name, value in zip(FRICTION, found.x):
        print(f"{name}: {value:.3f}")
    print(f"rms of torque in the first {FITTED:.0f} s: {found.fun:.2f} kN m")
    return friction_settings(found.x)


def draw(options, curves, path):
    """Torque and bit of both records."""
    picture, panels = measure.figure(8, 9, nrows=2 * len(RECORDS), sharex=True)
    for record, ours, (torque, bit) in zip(RECORDS, curves, np.reshape(panels, (-1, 2))):
        times = record.times()
        torque.plot(times, record.curve(options.data, "torque_recorded_kNm"), color="black", lw=1)
        torque.plot(times, ours["torque"], color=measure.BLUE, lw=1)
        torque.set_ylabel("torque of the drive (kN m)")
        torque.set_title(f"{record.name}, bit at {record.depth:.0f} m: recorded (black), simulated")
        for i in (1, 2):
            bit.plot(times, record.curve(options.data, f"bit_recorded_min_or_max_{i}_rpm"),
                     color="black", lw=1)
        bit.plot(times, ours["bit"], color=measure.BLUE, lw=1)
        bit.set_ylabel("bit (rpm)")
    panels[-1].set_xlabel("time (s)")
    measure.save(picture, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--data", type=Path, required=True, help="folder of the source's curves")
    parser.add_argument("--fit", action="store_true", help="fit friction anew, a few minutes")
    parser.add_argument("--population", type=int, default=12, help="of a generation of the fit, times 4")
    parser.add_argument("--generations", type=int, default=12, help="of the fit")
    options = parser.parse_args()
    facts = measure.provenance(options.build)
    options.friction = fit(options) if options.fit else {}
    rows, curves = [], []
    for record in RECORDS:
        of_record, ours = rows_of(options, record)
        rows += of_record
        curves.append(ours)
    folder = measure.results_folder(options.machine)
    measure.write_csv(folder / "field_data.csv", facts, rows)
    draw(options, curves, folder / "field_data.png")
    print(measure.markdown(rows))
    if options.publish:
        measure.publish("field-data", facts, INTRODUCTION, measure.markdown(rows),
                        picture=folder / "field_data.png")


if __name__ == "__main__":
    main()

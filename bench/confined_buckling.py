#!/usr/bin/python3
"""Buckling in a vertical and in a horizontal well: shapes, turns, pitch and wall forces of the
paper's six loads, with the paper's parameters and resolved, against the classical formulas.

Writes confined_buckling.csv and six pictures (the paper's figures 13 to 18) to
bench/results/MACHINE/ and, with --publish, the table into bench/RESULTS.md.
"""

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

import buckled_shape
import measure
from buckled_shape import HELICAL, SINUSOIDAL, STRAIGHT

# The pipe and the hole of the paper's table 3.
BENDING = 200e9 * np.pi / 64 * (0.14**4 - 0.12**4)  # EI (N m2)
METAL = np.pi / 4 * (0.14**2 - 0.12**2)  # m2
WEIGHT = (31.8557 - 1000 * METAL) * 9.80665  # buoyed (N/m)
CLEARANCE = (0.22 - 0.14) / 2  # m

RESOLVED, PAPER = "resolved", "paper"
LABELS = {RESOLVED: "resolved", PAPER: "the paper's parameters"}
WELLS = {"vertical": (20, 50, 100), "horizontal": (350, 500, 1000)}  # kN
PAPER_NAMES = {1000: "1MN"}
RAMP_END = {"vertical": 45, "horizontal": 65}  # of the resolved cases (s)

# Simulated time with the paper's parameters: its own is not known, and a load that follows the bit
# leaves the string at rest for a minute before it snakes (s).
PAPER_DURATION = 300

# Stretch of the string that the pictures of its shape and its bending show (m from the head), and
# ticks across the hole (mm).
SHOWN = {"vertical": (600, 1000), "horizontal": (500, 650)}
SIDES = (-40, 0, 40)

# The ends of a lying string are shaped by their supports over about a wavelength (m).
END_ZONE = 30
# How near its formula a wall force has to be, and from which height above the bit on (m).
NEAR, BIT_ZONE = 0.05, 25


@dataclass
class Result:
    """The state at the end of a run."""
    well: str
    load: float  # kN
    parameters: str
    s: np.ndarray  # arc length of the nodes from the head (m)
    lateral: np.ndarray  # of the nodes: toward the low side (vertical: north), east (m)
    compression: np.ndarray  # at the nodes (N)
    bending: np.ndarray  # of the segments: about d1, about d2 (N m)
    normal: np.ndarray  # force of the wall (N/m)
    upward: np.ndarray  # its vertical part (N/m)
    kinetic_energy: float  # J
    seconds: float  # of one processor

    @property
    def from_bit(self):
        return self.s[-1] - self.s

    @property
    def touches(self):
        return self.normal > 0


def run(options, folder, well, load, parameters):
    """Runs a case, unless its result file is there already; returns its end."""
    path = folder / f"{well}_{load}kN_{parameters}.h5"
    if parameters == PAPER:
        case = f"{well}_{PAPER_NAMES.get(load, f'{load}kN')}.toml"
        settings = {"run.duration": PAPER_DURATION}
    else:
        case = f"{well}_resolved.toml"
        settings = {"bit.weight": f'[[5, 0], [{RAMP_END[well]}, "{load} kN"]]'}
    seconds = 0.0
    if not path.exists():
        _, _, seconds = measure.run_case(options.build, case, settings, output=path)
    with h5py.File(path) as file:
        profile = {name: data[-1] for name, data in file["profiles"].items()}
        s = file["mesh/node_s"][:]
        middle = file["mesh/segment_s"][:]
        kinetic_energy = float(file["series/kinetic_energy"][-1])
    north, east, down = profile["position"].T
    return Result(well, load, parameters, s,
                  np.column_stack([down if well == "horizontal" else north, east]),
                  -np.interp(s, middle, profile["stress"][:, 3]), profile["stress"][:, 1:3],
                  profile["normal_force"], 0.0 - profile["contact_force"][:, 2], kinetic_energy,
                  seconds)


def longest_run(marks):
    """First and last index of the longest run of true values; None without any."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], marks.astype(int), [0]])))
    if len(edges) == 0:
        return None
    begins, ends = edges[::2], edges[1::2]
    longest = np.argmax(ends - begins)
    return begins[longest], ends[longest] - 1


def nodes_per_pitch(result):
    """Of the helix that the load at the bit can make."""
    return (buckled_shape.helix_pitch(1e3 * result.load, BENDING)
            / (result.s[-1] - result.s[-2]))


def common_numbers(result):
    eccentricity = np.hypot(*result.lateral.T)
    return {"well": result.well, "load (kN)": result.load, "parameters": result.parameters,
            "nodes per pitch": nodes_per_pitch(result),
            "kinetic energy (J)": result.kinetic_energy,
            "deepest in the wall (mm)": 1e3 * max(0.0, np.max(eccentricity) - CLEARANCE),
            "processor time (s)": result.seconds}


def vertical_numbers(result):
    """What a hanging string is held against: turns and wall force, where it touches."""
    force = 1e3 * result.load
    below_contact = result.s >= result.s[np.argmax(result.touches)]
    shape = buckled_shape.describe(result.s, result.lateral, below_contact)
    wound = abs(shape.azimuth[-1] - shape.azimuth[below_contact][0]) / (2 * np.pi)
    formula = buckled_shape.helix_contact(result.compression, BENDING, CLEARANCE)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = result.normal / formula
    inside = (result.from_bit > BIT_ZONE) & (result.compression > 0)
    near = longest_run(inside & (np.abs(ratio - 1) <= NEAR))
    return {**common_numbers(result),
            **{f"{kind} (%)": 100 * share for kind, share in shape.share.items()},
            "reversals": shape.reversals, "wound (turns)": wound,
            "wound by formula (turns)": buckled_shape.vertical_turns(force, BENDING, WEIGHT),
            "contact begins (m above the bit)": float(result.from_bit[below_contact][0]),
            "neutral point (m above the bit)": force / WEIGHT,
            "wall force near formula, from (m above the bit)":
                None if near is None else float(result.from_bit[near[1]]),
            "wall force near formula, to (m above the bit)":
                None if near is None else float(result.from_bit[near[0]]),
            "wall force over formula there":
                None if near is None else float(np.mean(ratio[near[0]:near[1] + 1]))}


def horizontal_numbers(result):
    """What a lying string is held against: its waves, its helices and how the wall carries it."""
    force = 1e3 * result.load
    inner = (result.s > END_ZONE) & (result.from_bit > END_ZONE)
    s = result.s[inner]
    shape = buckled_shape.describe(s, result.lateral[inner], np.ones(s.size, dtype=bool))
    return {**common_numbers(result),
            **{f"{kind} (%)": 100 * share for kind, share in shape.share.items()},
            "reversals": shape.reversals, "turns": shape.turns, "net turns": shape.net_turns,
            "pitch (m)": shape.pitch,
            "pitch by formula (m)": buckled_shape.helix_pitch(force, BENDING),
            "wavelength (m)": shape.wavelength,
            "amplitude (deg)": None if shape.amplitude is None else np.degrees(shape.amplitude),
            "mean wall force (N/m)": float(np.mean(result.normal[inner])),
            "helix wall force by formula (N/m)":
                float(buckled_shape.helix_contact(force, BENDING, CLEARANCE)),
            "least upward wall force (N/m)": float(np.min(result.upward[inner])),
            "most upward wall force (N/m)": float(np.max(result.upward[inner]))}


def percent_of_kinds(row):
    """The kinds of shape and their shares of the length, most common first."""
    kinds = sorted((STRAIGHT, SINUSOIDAL, HELICAL), key=lambda kind: -row[f"{kind} (%)"])
    return ", ".join(f"{kind} {row[f'{kind} (%)']:.0f} %" for kind in kinds
                     if row[f"{kind} (%)"] >= 0.5)


def first_cells(row):
    load = row["load (kN)"]
    return {"load": "1 MN" if load == 1000 else f"{load} kN", "parameters": row["parameters"],
            "nodes per pitch": f"{row['nodes per pitch']:.1f}", "shape": percent_of_kinds(row)}


def last_cells(row):
    return {"deepest in the wall (mm)": f"{row['deepest in the wall (mm)']:.2g}",
            "kinetic energy (J)": f"{row['kinetic energy (J)']:.1g}"}


def vertical_cells(row):
    start, end, ratio = (row[f"wall force {name}"] for name in (
        "near formula, from (m above the bit)", "near formula, to (m above the bit)",
        "over formula there"))
    return {**first_cells(row),
            "turns (formula)":
                f"{row['wound (turns)']:.2f} ({row['wound by formula (turns)']:.2f})",
            "contact begins, above the bit (neutral point)":
                f"{row['contact begins (m above the bit)']:.0f} m "
                f"({row['neutral point (m above the bit)']:.0f} m)",
            "wall force within 5 % of formula, above the bit":
                "nowhere" if start is None else f"{start:.0f} to {end:.0f} m, mean {ratio:.3f}",
            **last_cells(row)}


def optional(value, form):
    return "" if value is None else form.format(value)


def horizontal_cells(row):
    return {**first_cells(row),
            "turns (net), reversals":
                f"{row['turns']:.1f} ({abs(row['net turns']):.1f}), {row['reversals']}",
            "pitch (formula)": (optional(row["pitch (m)"], "{:.2f} m") or "none")
                               + f" ({row['pitch by formula (m)']:.2f} m)",
            "waves": optional(row["wavelength (m)"], "{:.1f} m")
                     + optional(row["amplitude (deg)"], ", ±{:.0f}°"),
            "upward wall force (N/m)": f"{row['least upward wall force (N/m)']:.0f} to "
                                       f"{row['most upward wall force (N/m)']:.0f}",
            "mean wall force (helix formula) (N/m)":
                f"{row['mean wall force (N/m)']:.0f} "
                f"({row['helix wall force by formula (N/m)']:.0f})",
            **last_cells(row)}


def panels_of(results, title, height=7, **options):
    """A figure of two rows (resolved, the paper's parameters) and one column per load; gives
    (panel, result) pairs."""
    loads = WELLS[results[0].well]
    picture, panels = measure.figure(12, height, nrows=2, ncols=len(loads), **options)
    picture.suptitle(title)
    pairs = []
    for row, parameters in enumerate((RESOLVED, PAPER)):
        for column, load in enumerate(loads):
            result = next(r for r in results if (r.load, r.parameters) == (load, parameters))
            panels[row, column].set_title(f"{load} kN, {LABELS[parameters]}")
            pairs.append((panels[row, column], result))
    return picture, pairs


def draw_shapes(results, path):
    """The midline in its hole, with the room it has (grey; darker where it is compressed)."""
    well = results[0].well
    begin, end = SHOWN[well]
    picture, pairs = panels_of(results, f"Midline of the string in the {well} well",
                               height=9 if well == "vertical" else 7,
                               subplot_kw={"projection": "3d"})
    for panel, result in pairs:
        part = (result.s >= begin) & (result.s <= end)
        toward, across = 1e3 * result.lateral[part].T
        line = {"color": measure.BLUE, "linewidth": 0.9}
        if well == "vertical":
            neutral = max(begin, result.s[-1] - 1e3 * result.load / WEIGHT)
            for low, high, shade in ((begin, neutral, 0.08), (neutral, end, 0.2)):
                along, one, other = hole_surface(low, high)
                panel.plot_surface(one, other, along, color="grey", alpha=shade, linewidth=0)
            panel.plot(across, toward, result.s[part], **line)
            panel.set(xlabel="east (mm)", ylabel="north (mm)", zlabel="from the head (m)",
                      xticks=SIDES, yticks=SIDES)
            panel.set_box_aspect((1, 1, 2.2), zoom=0.82)
        else:
            panel.plot_surface(*hole_surface(begin, end), color="grey", alpha=0.2, linewidth=0)
            panel.plot(result.s[part], across, toward, **line)
            panel.set(xlabel="from the head (m)", ylabel="east (mm)", zlabel="down (mm)",
                      yticks=SIDES, zticks=SIDES)
            panel.set_box_aspect((2.6, 1, 1), zoom=0.88)
        panel.invert_zaxis()
        panel.tick_params(labelsize=7)
    measure.save(picture, path)


def hole_surface(low, high):
    """The room of the midline from one arc length to another (m; across it mm)."""
    angle, along = np.meshgrid(np.linspace(0, 2 * np.pi, 40), [low, high])
    return along, 1e3 * CLEARANCE * np.sin(angle), 1e3 * CLEARANCE * np.cos(angle)


def draw_bending(results, path):
    """The two components of the bending moment."""
    picture, pairs = panels_of(results, f"Bending moment in the {results[0].well} well",
                               sharey="row")
    for panel, result in pairs:
        middle = 0.5 * (result.s[1:] + result.s[:-1])
        begin, end = SHOWN[result.well]
        part = (middle >= begin) & (middle <= end)
        for column, (colour, name) in enumerate(((measure.BLUE, "about d1"),
                                                 (measure.ORANGE, "about d2"))):
            panel.plot(middle[part], 1e-3 * result.bending[part, column], color=colour,
                       linewidth=0.9, label=name)
        panel.set(xlabel="from the head (m)", xlim=(begin, end))
    pairs[0][0].legend(fontsize=8, loc="upper left")
    for panel, _ in pairs[::3]:
        panel.set_ylabel("moment (kN m)")
    measure.save(picture, path)


def draw_angle(results, path):
    """Azimuth of the wall's force on a hanging string, where it touches."""
    picture, pairs = panels_of(results, "Azimuth of the contact in the vertical well")
    for panel, result in pairs:
        angle = buckled_shape.azimuth_along(result.lateral) / (2 * np.pi)
        touching = result.touches
        begin = angle[np.argmax(touching)]
        panel.plot(result.from_bit[touching], angle[touching] - begin, ".", markersize=2,
                   color=measure.BLUE, label="nodes that touch")
        force = 1e3 * result.load
        height = np.linspace(0, force / WEIGHT, 200)
        left = buckled_shape.vertical_turns(force - WEIGHT * height, BENDING, WEIGHT)
        hand = -1.0 if angle[-1] < begin else 1.0
        panel.plot(height, hand * left, "--", color=measure.RED, linewidth=0.9,
                   label="formula, $F^{1.5}/(3 \\pi w \\sqrt{2 EI})$")
        for turn in (-1, 1):
            panel.axhline(turn, color="grey", linewidth=0.7)
        panel.set(xlabel="above the bit (m)", xlim=(400, -5))
    pairs[1][0].legend(fontsize=8, loc="lower left")
    for panel, _ in pairs[::3]:
        panel.set_ylabel("azimuth (turns)")
    measure.save(picture, path)


def draw_upward(results, path):
    """Vertical part of the wall's force on a lying string: negative where the string presses on
    the upper side of its hole."""
    picture, pairs = panels_of(results, "Vertical wall force in the horizontal well")
    for panel, result in pairs:
        panel.plot(result.s, 1e-3 * result.upward, color=measure.BLUE, linewidth=0.5)
        panel.axhline(0, color="black", linewidth=0.7)
        inner = (result.s > END_ZONE) & (result.from_bit > END_ZONE)
        least, most = 1e-3 * np.percentile(result.upward[inner], (0, 100))
        panel.set(xlabel="from the head (m)", xlim=(0, 1000),
                  ylim=(least - 0.1 * (most - least), most + 0.1 * (most - least)))
    for panel, _ in pairs[::3]:
        panel.set_ylabel("upward (kN/m)")
    measure.save(picture, path)


def draw(results, folder):
    """All pictures."""
    vertical = [r for r in results if r.well == "vertical"]
    horizontal = [r for r in results if r.well == "horizontal"]
    for well in (vertical, horizontal):
        name = f"confined_buckling_{well[0].well}"
        draw_shapes(well, folder / f"{name}_shape.png")
        draw_bending(well, folder / f"{name}_bending.png")
    draw_angle(vertical, folder / "confined_buckling_vertical_azimuth.png")
    draw_upward(horizontal, folder / "confined_buckling_horizontal_wall.png")


def critical_loads():
    """The classical critical loads as a sentence."""
    def listed(limits):
        return ", ".join(f"{name} {1e-3 * load:.1f} kN" for name, load in limits.items())
    return ("Critical loads by formula: vertical "
            + listed(buckled_shape.vertical_limits(BENDING, WEIGHT)) + "; horizontal "
            + listed(buckled_shape.horizontal_limits(BENDING, WEIGHT, CLEARANCE)) + ".")


def publish(rows, facts, folder):
    tables = [measure.markdown([cells(row) for row in rows if row["well"] == well])
              for well, cells in (("vertical", vertical_cells),
                                  ("horizontal", horizontal_cells))]
    azimuth = folder / "confined_buckling_vertical_azimuth.png"
    measure.publish(
        "confined-buckling", facts,
        "The paper's six loads with `leapfrog`, on a fine mesh with a stiff wall, a dead load and "
        "a bit that touches 0.3 m of wall (`cases/vertical_resolved.toml`, "
        "`cases/horizontal_resolved.toml`), and with the paper's parameters: a mesh of 5 m, a "
        "wall of 1e5 Pa, a load that follows the bit (1 MN: 2.5 m and 1e6 Pa, which bear it). State at the "
        "end of the run. "
        + critical_loads(),
        "Vertical well:", tables[0],
        f"Horizontal well, without the {END_ZONE} m next to each end:", tables[1],
        f"![azimuth of the contact]({measure.link(azimuth)})",
        picture=folder / "confined_buckling_horizontal_wall.png")


def main():
    """Runs the twelve cases, writes CSV and pictures and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--results", type=Path,
                        help="folder that keeps the result files; runs whose file is there "
                             "already are not repeated")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.results or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        results = [run(options, folder, well, load, parameters)
                   for well, loads in WELLS.items() for load in loads
                   for parameters in (RESOLVED, PAPER)]
    rows = [vertical_numbers(r) if r.well == "vertical" else horizontal_numbers(r)
            for r in results]
    names = list(dict.fromkeys(name for row in rows for name in row))
    folder = measure.results_folder(options.machine)
    measure.write_csv(folder / "confined_buckling.csv", facts,
                      [{name: row.get(name) for name in names} for row in rows])
    draw(results, folder)
    if options.publish:
        publish(rows, facts, folder)


if __name__ == "__main__":
    main()

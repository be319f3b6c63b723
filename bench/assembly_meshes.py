#!/usr/bin/python3
"""A drilling assembly in casing and open hole on segments of 30, 15 and 7.5 ft: hook load, torque,
side force over windows of 30 ft and bending moment, drilling, sliding and pulled out.

Runs `drillstrand equilibrium` on cases/field_units.toml, with another survey where --survey names
one. Writes assembly_meshes.csv to bench/results/MACHINE/ and, with --publish, the table into
bench/RESULTS.md.
"""

import argparse
import subprocess
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

import measure

CASE = "field_units.toml"
FEET = (30, 15, 7.5)
MOTIONS = ("drilling", "sliding", "tripping_out")
# Depths at which side forces and moments of two meshes are compared (m apart).
SPACING = 3.0
# kN, kN m: less is rounding.
NOTHING = 1e-3


def equilibrium(options, motion, feet):
    """Numbers of an equilibrium on segments of at most that length."""
    settings = {
        "mesh.element_length": f"'{feet} ft'",
        "mesh.segments_per_joint": max(1, round(30 / feet)),
        "mesh.refine": "[]",
        "equilibrium.motion": f"'{motion}'",
    }
    if options.survey:
        settings["well.survey"] = f"'{options.survey.resolve()}'"
    settings |= dict(setting.split("=", 1) for setting in options.settings)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "equilibrium.h5"
        command = [str(measure.executable(options.build, "drillstrand")), "equilibrium",
                   str(measure.ROOT / "cases" / CASE), "-o", str(path),
                   *measure.set_options(settings)]
        start = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        seconds = time.monotonic() - start
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
        with h5py.File(path) as file:
            profiles = file["profiles"]
            moment = profiles["moment"][-1]
            return {
                "segments": file["string/cell"].size - 1,
                "hook load (kN)": file["series/hook_load"][-1] / 1e3,
                "torque (kN m)": file["series/surface_torque"][-1] / 1e3,
                "depth": profiles["well_depth"][-1],
                "side": profiles["side_force"][-1],
                "moment": np.hypot(moment[:, 1], moment[:, 2]),
                "seconds": seconds,
            }


def largest_difference(one, other, name):
    """Of a profile on two meshes, over the largest of the second."""
    depths = np.arange(one["depth"][0], min(one["depth"][-1], other["depth"][-1]), SPACING)
    difference = np.interp(depths, one["depth"], one[name]) - np.interp(
        depths, other["depth"], other[name])
    return float(np.max(np.abs(difference)) / np.max(np.abs(other[name])))


def row_of(motion, feet, found, finest):
    """A row of the table: numbers, and how far they are from the finest mesh's."""
    parts = {"motion": motion, "segments of (ft)": feet, "segments": found["segments"],
             "hook load (kN)": found["hook load (kN)"], "torque (kN m)": found["torque (kN m)"],
             "largest side force (kN/m)": float(np.max(found["side"])) / 1e3,
             "largest bending moment (kN m)": float(np.max(found["moment"])) / 1e3,
             "time (s)": found["seconds"]}
    for name in ("hook load (kN)", "torque (kN m)"):
        none = abs(finest[name]) < NOTHING
        parts[f"{name}: off (%)"] = "" if none else 100 * (found[name] / finest[name] - 1)
    parts["side force: off (%)"] = 100 * largest_difference(found, finest, "side")
    parts["moment: off (%)"] = 100 * largest_difference(found, finest, "moment")
    return parts


def text_of(row):
    """A row as the page shows it."""
    formats = {"segments": "d", "hook load (kN)": ".2f", "torque (kN m)": ".3f", "time (s)": ".2f"}
    return {name: value if isinstance(value, str) else format(value, formats.get(name, ".3g"))
            for name, value in row.items()}


def main():
    """Runs all meshes, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--survey", type=Path, help="instead of the case's own")
    parser.add_argument("--set", action="append", default=[], metavar="key.path=value",
                        dest="settings", help="of all runs, as for drillstrand")
    options = parser.parse_args()
    facts = measure.provenance(options.build)
    rows = []
    for motion in MOTIONS:
        found = {feet: equilibrium(options, motion, feet) for feet in FEET}
        rows += [row_of(motion, feet, found[feet], found[FEET[-1]]) for feet in FEET]
    facts.append(("load after", measure.load()))
    measure.write_csv(measure.results_folder(options.machine) / "assembly_meshes.csv", facts, rows)
    table = measure.markdown([text_of(row) for row in rows])
    print(table)
    if options.publish:
        measure.publish(
            "assembly-meshes", facts,
            "`cases/field_units.toml` in equilibrium, on meshes that follow the string with segments "
            "of at most these lengths (one, two and four from tool joint to tool joint). *Off*: "
            "from the finest; of side force over windows of 30 ft and of bending moment, the largest "
            "difference anywhere over the largest value.", table)


if __name__ == "__main__":
    main()

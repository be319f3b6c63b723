#!/usr/bin/python3
"""What the paper's section 4 says of its figures 20 to 25, in numbers: each field case with the paper's
numbers and as it is shipped, one run each, and the string at rest beside them.

The table of words and numbers is in cases/README.md.
"""

import argparse
import csv
import subprocess
import tempfile
import tomllib
from pathlib import Path

import h5py
import numpy as np

import measure

# Case, and windows (s) before and after something: the load, or the first and last of the rotation.
CASES = [("well1", (35, 45), (60, 70)), ("well2", (40, 60), (180, 200)),
         ("well3", (40, 60), (140, 160)), ("well2_drilling", (50, 60), (80, 200))]
VARIANTS = ["_paper", ""]
# Components of stress, in the order of the result file.
TWIST, BENDING, AXIAL, SHEAR = 0, (1, 2), 3, (4, 5)


def window_of(times, window):
    return (times >= window[0]) & (times <= window[1])


def at_rest(build, name, folder):
    """Axial force at the head (N) and strain energies of the string without friction and loads."""
    path = Path(folder) / "rest.h5"
    command = [measure.executable(build, "drillstrand"), "equilibrium",
               measure.ROOT / "cases" / f"{name}.toml", "--overwrite", "-o", path,
               *measure.set_options({"bit.weight": 0, "bit.torque": 0})]
    subprocess.run(command, check=True, capture_output=True)
    with h5py.File(path) as file:
        return float(file["series/head_stress"][-1, AXIAL]), strain_energies(file)[-1]


def elasticity(case_text):
    """Young's modulus (Pa) and Poisson's ratio of a case: each string here is of one steel."""
    string = tomllib.loads(case_text)["string"]
    if "components" not in string:
        component = string["component"][0]
        return float(component["youngs_modulus"].split()[0]) * 1e9, component["poisson_ratio"]
    text = (measure.ROOT / "cases" / string["components"]).read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    first = next(rows)
    return float(first["youngs_modulus[GPa]"]) * 1e9, float(first["poisson_ratio"])


def strain_energies(file):
    """Energy of twist, bending and stretch (J) of each profile. Sections are those of pipes."""
    young, poisson = elasticity(file.attrs["case"])
    node = file["mesh/node_s"][:]
    outer = file["string/outer_radius"][:]
    area = file["string/metal_area"][:]
    # a segment has the thinner of its nodes' pipes, but for the few at a change of section
    outer = np.minimum(outer[1:], outer[:-1])
    inertia = np.pi / 4 * (outer**4 - np.maximum(outer**2 - area / np.pi, 0)**2)
    stress, length = file["profiles/stress"][:], np.diff(node)
    shear_modulus = young / (2 * (1 + poisson))
    return np.stack([
        stress[:, :, TWIST]**2 @ (length / (4 * shear_modulus * inertia)),
        (stress[:, :, BENDING]**2).sum(axis=2) @ (length / (2 * young * inertia)),
        stress[:, :, AXIAL]**2 @ (length / (2 * young * area))], axis=1)


def numbers(path, before, after, rest):
    """What a run says, by name and unit."""
    rest_tension, rest_energy = rest
    with h5py.File(path) as file:
        series = {name: data[:] for name, data in file["series"].items()}
        time, stress = series["time"], series["head_stress"]
        profile_time = file["profiles/time"][:]
        late_profiles = window_of(profile_time, after)
        gained = strain_energies(file)[late_profiles].mean(axis=0) - rest_energy
        force = file["profiles/normal_force"][:][late_profiles].mean(axis=0) * file["string/cell"][:]
        found = {"status": str(file.attrs["status"]),
                 "deepest in the wall (mm)": 1e3 * series["max_penetration"].max(),
                 "largest step (s)": float(file.attrs["largest_step"])}
    for label, window in (("first", before), ("last", after)):
        part = window_of(time, window)

        def spread(components, part=part):
            return np.sqrt(stress[part][:, components].var(axis=0).sum()) / 1e3

        tension = stress[part, AXIAL]
        rotation = series["head_rotation_rate"][part]
        found |= {
            f"{label}: tension at the head (kN)": tension.mean() / 1e3,
            f"{label}: tension over rest (kN)": (tension.mean() - rest_tension) / 1e3,
            f"{label}: spread of tension (kN)": tension.std() / 1e3,
            f"{label}: twist moment (kN m)": stress[part, TWIST].mean() / 1e3,
            f"{label}: spread of twist moment (kN m)": stress[part, TWIST].std() / 1e3,
            f"{label}: mean bending moments (kN m)":
                np.hypot(*stress[part][:, BENDING].mean(axis=0)) / 1e3,
            f"{label}: spread of bending moments (kN m)": spread(BENDING),
            f"{label}: spread of shear forces (kN)": spread(SHEAR),
            f"{label}: largest shear force over its spread":
                np.hypot(*stress[part][:, SHEAR].T).max() / 1e3 / spread(SHEAR),
            f"{label}: bit torque (kN m)": series["bit_torque"][part].mean() / 1e3,
            f"{label}: nodes in contact": series["contact_nodes"][part].mean(),
            f"{label}: slowest rotation of the bit over the head's":
                (series["bit_rotation_rate"][part] / rotation).min(),
        }
    falling = window_of(time, (10, 20))
    return found | {
        "change of tension (kN)": (found["last: tension at the head (kN)"]
                                   - found["first: tension at the head (kN)"]),
        "change of twist moment (kN m)": (found["last: twist moment (kN m)"]
                                          - found["first: twist moment (kN m)"]),
        "10 to 20 s: spread of tension (kN)": stress[falling, AXIAL].std() / 1e3,
        "10 to 20 s: tension over rest (kN)": (stress[falling, AXIAL].mean() - rest_tension) / 1e3,
        "last: energy gained by twist (J)": gained[0],
        "last: energy gained by bending (J)": gained[1],
        "last: energy gained by stretch (J)": gained[2],
        "last: wall force (kN)": force.sum() / 1e3,
        "last: share of the lowest tenth in the wall force":
            force[-max(1, force.size // 10):].sum() / force.sum(),
    }


def main():
    """Runs the cases, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    columns = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, before, after in CASES:
            rest = at_rest(options.build, name, folder)
            for variant in VARIANTS:
                path = Path(folder) / "run.h5"
                measure.run_case(options.build, f"{name}{variant}.toml", {}, 1, path)
                columns[name + variant] = numbers(path, before, after, rest)
    rows = [{"": label} | {name: column[label] for name, column in columns.items()}
            for label in next(iter(columns.values()))]
    measure.write_csv(measure.results_folder(options.machine) / "paper_figures.csv", facts, rows)
    table = measure.markdown([{key: value if isinstance(value, str) else f"{value:.4g}"
                               for key, value in row.items()} for row in rows])
    print(table)
    if options.publish:
        windows = ", ".join(f"`{name}` {before[0]} to {before[1]} s and {after[0]} to {after[1]} s"
                            for name, before, after in CASES)
        measure.publish(
            "paper-figures", facts,
            f"One run of each. First and last: means over {windows}. Rest: `drillstrand equilibrium` of "
            "the shipped case off bottom. Twist moments are those on the string, against its rotation. "
            "Bending moments and shear forces are components in the turning section, their spread is "
            "the root of the sum of both variances. Energies: mean strain energy less that at rest.",
            table)


if __name__ == "__main__":
    main()

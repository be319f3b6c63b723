#!/usr/bin/python3
"""`drillstrand modes`: how long it takes, and how far frequencies are from those of exact beams.

Processor time of the whole command, beside that of `drillstrand equilibrium`, which it begins with;
and a stocky clamped-free beam of Timoshenko, at rest and turning.
"""

import argparse
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

import measure

TURNING = 120  # rpm, of the strings that are timed
HANGING = """[[string.component]]
length = 4000
outer_diameter = 0.127
inner_diameter = 0.1086
density = 7850
youngs_modulus = "206 GPa"
[mesh]
segments = 4000
"""
# I/(A L^2) = 0.0025, no Poisson's ratio, in units of sqrt(EI/(m L^4))
INERTIA, AXIAL, SHEAR, SPIN = 0.0025, 400.0, 200.0, 10.0
STOCKY = f"""gravity = 0
[[string.component]]
length = 1
linear_density = 1
inertia = {INERTIA}
polar_inertia = {2 * INERTIA}
bending_stiffness = 1
torsional_stiffness = 1
axial_stiffness = {AXIAL}
shear_stiffness = {SHEAR}
[mesh]
segments = """
BACKWARD, FORWARD = 3.34785424, 3.56763534  # published, at that spin


def call(options, arguments):
    """Runs drillstrand; returns its processor time (s)."""
    before = os.times()
    done = subprocess.run([str(measure.executable(options.build, "drillstrand")), *arguments],
                          capture_output=True, text=True, check=False)
    after = os.times()
    if done.returncode != 0:
        sys.exit(f"{' '.join(arguments)}\n{done.stderr}")
    return (after.children_user - before.children_user
            + after.children_system - before.children_system)


def timed(options, scratch, name, case, settings):
    """Least times of a string: equilibrium alone, modes at rest, modes turning."""
    chosen = ["--set", "run.threads=1", *measure.set_options(settings)]
    output = str(scratch / "modes.h5")
    modes = ["modes", str(case), "--overwrite", "-o", output, *chosen]
    commands = [["equilibrium", str(case), *chosen], modes, [*modes, "--rpm", str(TURNING)]]
    least = [min(call(options, command) for _ in range(options.rounds)) for command in commands]
    with h5py.File(output) as file:
        nodes = file["modes/static/position"].shape[0]
    return {"string": name, "nodes": nodes, "equilibrium alone (s)": least[0],
            "at rest (s)": least[1], "turning (s)": least[2]}


def bending_frequencies(count):
    """Of the clamped-free beam, w' = f + Q/GA, f' = M, M' = -Q - I w^2 f, Q' = -w^2 w, exactly."""
    def at_free_end(frequency):
        square = frequency * frequency
        rates = np.array([[0, 1, 0, 1 / SHEAR], [0, 0, 1, 0],
                          [0, -INERTIA * square, 0, -1], [-square, 0, 0, 0]])
        return np.linalg.det(expm(rates)[2:, 2:])
    grid = np.linspace(0.5, 150, 3000)
    signs = [at_free_end(frequency) for frequency in grid]
    return [brentq(at_free_end, a, b, xtol=1e-12) for a, b, at_a, at_b
            in zip(grid, grid[1:], signs, signs[1:]) if at_a * at_b < 0][:count]


def frequencies(options, scratch, case, arguments):
    """Lateral ones that `modes` finds (rad/s)."""
    output = str(scratch / "beam.h5")
    call(options, ["modes", str(case), "--overwrite", "-o", output, "--number", "16", *arguments])
    with h5py.File(output) as file:
        lateral = file["modes/kind"][:] == 0
        return 2 * math.pi * file["modes/frequency"][:][lateral]


def beam(options, scratch, segments):
    """Errors of the stocky beam on a mesh."""
    case = scratch / "stocky.toml"
    case.write_text(f"{STOCKY}{segments}\n", encoding="utf-8")
    still = frequencies(options, scratch, case, [])[::2]  # each bends twice
    turning = frequencies(options, scratch, case, ["--rpm", f"{SPIN * 30 / math.pi:.12g}"])
    row = {"N": segments}
    for k, exact in enumerate(bending_frequencies(4)):
        row[f"bending {k + 1}"] = still[k] / exact - 1
    return row | {"backward": turning[0] / BACKWARD - 1, "forward": turning[1] / FORWARD - 1}


def text_of(row):
    """Numbers of a row for a page."""
    return {key: f"{value:.2g}" if isinstance(value, float) else str(value)
            for key, value in row.items()}


def main():
    """Measures, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--rounds", type=int, default=5, help="of which the least time counts")
    options = parser.parse_args()

    facts = measure.provenance(options.build)
    cases = measure.ROOT / "cases"
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        hanging = scratch / "hanging.toml"
        hanging.write_text(HANGING, encoding="utf-8")
        times = [timed(options, scratch, "`well2`", cases / "well2.toml", {}),
                 timed(options, scratch, "5 in pipe that hangs", hanging, {}),
                 timed(options, scratch, "`torque_drag`, segments of 0.5 m",
                       cases / "torque_drag.toml", {"mesh.element_length": 0.5})]
        errors = [beam(options, scratch, segments) for segments in (32, 64, 128)]
    results = measure.results_folder(options.machine)
    measure.write_csv(results / "modes.csv", facts, times)
    measure.write_csv(results / "modes_errors.csv", facts, errors)
    tables = [measure.markdown([text_of(row) for row in rows]) for rows in (times, errors)]
    print("\n\n".join(tables))
    if options.publish:
        measure.publish(
            "modes", facts,
            f"Ten modes of strings: least processor time of {options.rounds} runs of the whole "
            f"command, one thread, turning at {TURNING} rpm. Below, relative errors of a stocky "
            "clamped-free beam on N segments against Timoshenko's frequencies, and turning at 10 "
            "in units of sqrt(EI/(m L^4)) against published ones.", *tables)


if __name__ == "__main__":
    main()

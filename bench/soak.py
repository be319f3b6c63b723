#!/usr/bin/python3
"""A field case that goes on for a day: what drifts. Energy that appears from nowhere, the length of
directors, memory, and the means of hook load and torque, hour by hour.
"""

import argparse
import subprocess
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

import measure

HOUR = 3600


def resident(process):
    """Memory of a running process (MB); None where it has ended."""
    try:
        status = Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    except OSError:
        return None
    lines = [line for line in status.splitlines() if line.startswith("VmRSS")]
    return int(lines[0].split()[1]) / 1024 if lines else None


def watched_run(options, path):
    """Runs the case; returns (wall seconds, MB) of it while it ran."""
    command = [measure.executable(options.build, "drillstrand"), "run",
               measure.ROOT / "cases" / options.case, "--quiet", "--threads", "1", "-o", path,
               *measure.set_options({"run.duration": options.hours * HOUR, "output.interval": 1,
                                     "output.profile_interval": HOUR})]
    begin = time.monotonic()
    memory = []
    with subprocess.Popen(command) as process:
        while process.poll() is None:
            megabytes = resident(process)
            if megabytes:
                memory.append((time.monotonic() - begin, megabytes))
            time.sleep(1)
    if process.returncode != 0:
        raise SystemExit(f"the run ended with {process.returncode}")
    return memory


def rows_of(path, memory):
    """What each hour of the run was like."""
    with h5py.File(path) as file:
        series = {name: data[:] for name, data in file["series"].items()}
        profile_time, director = file["profiles/time"][:], file["profiles/director"][:]
    moments = series["time"]
    # the contact springs' is part of the elastic one
    stored = sum(series[f"{kind}_energy"] for kind in ("kinetic", "half_step", "elastic", "potential"))
    appeared = stored + series["dissipation"] - series["work"]
    error = np.max(np.abs(np.linalg.norm(director, axis=2) - 1), axis=1)
    wall, megabytes = np.array(memory).T
    rows = []
    for hour in range(int(moments[-1] // HOUR)):
        first, last = np.searchsorted(moments, [hour * HOUR, (hour + 1) * HOUR - 0.5])
        last = min(last, moments.size - 1)
        inside = slice(first, last + 1)
        moved = max(np.ptp(series[name][inside]) for name in ("work", "dissipation"))
        at = wall[-1] * moments[last] / moments[-1]
        rows.append({
            "hour": hour + 1,
            "energy that appeared (J)": appeared[last] - appeared[first],
            "over energy that moved": (appeared[last] - appeared[first]) / moved,
            "director length - 1": error[np.searchsorted(profile_time, moments[last] + 1) - 1],
            "memory (MB)": np.interp(at, wall, megabytes),
            "hook load (kN)": np.mean(series["hook_load"][inside]) / 1e3,
            "torque (kN m)": np.mean(series["surface_torque"][inside]) / 1e3,
            "largest time error": np.max(series["time_error"][inside]),
        })
    return rows


def text_of(row):
    """A row of the table."""
    digits = {"hour": "d", "energy that appeared (J)": ".3g", "over energy that moved": ".1e",
              "director length - 1": ".1e", "memory (MB)": ".1f", "hook load (kN)": ".3f",
              "torque (kN m)": ".3f", "largest time error": ".1e"}
    return {name: format(value, digits[name]) for name, value in row.items()}


def main():
    """Runs, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--case", default="well1.toml")
    parser.add_argument("--hours", type=int, default=24, help="simulated (default: %(default)s)")
    options = parser.parse_args()
    if options.hours < 1:
        parser.error("--hours: expected one at least")

    facts = measure.provenance(options.build)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "soak.h5"
        memory = watched_run(options, path)
        rows = rows_of(path, memory)
    measure.write_csv(measure.results_folder(options.machine) / "soak.csv", facts, rows)
    shown = [row for row in rows if row["hour"] in (1, 2, 3, 6, 12, 18, len(rows))]
    table = measure.markdown([text_of(row) for row in shown])
    print(table)
    if options.publish:
        measure.publish(
            "soak", facts,
            f"`cases/{options.case}` for {options.hours} simulated hours, in {memory[-1][0] / 60:.0f} "
            "minutes on one thread. Energy that appeared: in that hour, and over what its loads did "
            "or its friction took.", table)


if __name__ == "__main__":
    main()

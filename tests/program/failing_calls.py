#!/usr/bin/env python3
"""Lets calls of a short run fail one by one, and looks at what is left.

usage: failing_calls.py PROGRAM LIBRARY [--calls write|memory] [--most N]

LIBRARY is built from failing_calls.cpp. Each n-th call that changes a file, and each n-th
allocation, fails: once, and with all calls after it; with --most, that many of them, spread over
the run. The program must end with one line and exit code 1, or, where it can do without that memory or
HDF5 writes a second time what it could not write at first, with exit code 0 and the whole result. (toml++
takes a number for which it has no memory for a wrong one: exit code 2.) The file holds the first records of the undisturbed
run bit by bit, or does not exist; nothing lies beside it.
"""

import argparse
import collections
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

CASE = """
[string]
[[string.component]]
length = 24
outer_diameter = 0.1397
inner_diameter = 0.1155
linear_density = 34.2277
youngs_modulus = "200 GPa"
[mesh]
segments = 2
[head]
direction = [1, 0, 0]
rotation = 0
[run]
duration = 0.009
threads = 1
[output]
interval = 1e-6
profile_interval = 0.002
"""


def records(path):
    """Every dataset, with the times of series and profiles as its length."""
    found = {}
    with h5py.File(path) as file:
        for group in ["mesh", "string"]:
            found |= {f"{group}/{name}": data[:] for name, data in file[group].items()}
        for group in ["series", "profiles"]:
            times = file[group]["time"][:]
            # times of a flush that was cut off read as 0
            count = 1 + int(np.argmax(np.append(np.diff(times) <= 0, True))) if len(times) else 0
            for name, data in file[group].items():
                found[f"{group}/{name}"] = data[:count]
        return found, file.attrs["status"]


class Runs:
    """Runs of one integrator in which calls of one kind fail."""

    def __init__(self, program, library, integrator, calls):
        self.program, self.library = Path(program).resolve(), Path(library).resolve()
        self.integrator, self.calls = integrator, calls
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name)
        (self.folder / "case.toml").write_text(CASE)
        count = self.folder / "count"
        ending = self.run("0", DRILLSTRAND_COUNT=str(count))
        assert ending.returncode == 0, ending.stderr
        self.total = int(count.read_text())
        self.whole, status = records(self.folder / "case.h5")
        assert status == "complete" and self.total > 10
        count.unlink()

    def run(self, wish, **environment):
        (self.folder / "case.h5").unlink(missing_ok=True)
        environment |= {"LD_PRELOAD": str(self.library), "DRILLSTRAND_FAIL": f"{self.calls}:{wish}",
                        "OMP_NUM_THREADS": "1"}
        return subprocess.run([self.program, "run", "case.toml", "--quiet", "--set",
                               f"run.integrator={self.integrator}"], cwd=self.folder,
                              env=os.environ | environment, capture_output=True, text=True,
                              check=False)

    def outcome(self, wish):
        """In words; those of a mistake begin with WRONG."""
        ending = self.run(wish)
        lines = [line for line in ending.stderr.splitlines() if line]  # libgomp begins with an empty one
        extra = {path.name for path in self.folder.iterdir()} - {"case.toml", "case.h5"}
        for name in extra:
            (self.folder / name).unlink()
        # HDF5's library (1.10.8) does not look at all that it allocates, or ends the process itself
        # (H5I_register calls exit(-1)). failing_calls.cpp makes sure that it is the one that crashed;
        # drillstrand has no exit code 255. What was recorded must be there all the same.
        in_hdf5 = self.calls == "memory" and ending.returncode in (77, 255)
        if in_hdf5 and not (self.folder / "case.h5").exists():
            return "ended by HDF5's library, no file"
        if extra and not in_hdf5:
            return f"WRONG: exit code {ending.returncode}, left {sorted(extra)}"
        # the OpenMP library ends a process in its own way
        spoken = [line for line in lines if line.startswith("drillstrand: error: ")]
        of_openmp = [line for line in lines if "libgomp: Out of memory" in line]
        if ending.returncode == 1 and not (len(lines) == 1 and (spoken or of_openmp)):
            return f"WRONG: said {lines}"
        if (self.calls == "memory" and ending.returncode == 2 and len(lines) == 1 and not (self.folder / "case.h5").exists()
                and ": not valid TOML: Error while parsing" in lines[0]):
            return "taken for a wrong number by toml++, no file"
        if ending.returncode not in [0, 1] and not in_hdf5:
            return f"WRONG: exit code {ending.returncode}, said {lines}"
        if not (self.folder / "case.h5").exists():
            return f"exit code {ending.returncode}, no file" if ending.returncode else "WRONG: no file"
        try:
            found, status = records(self.folder / "case.h5")
        except (OSError, KeyError) as problem:
            return f"WRONG: not readable: {problem}"
        for name, values in found.items():
            whole = self.whole[name]
            if name.split("/")[0] in ["series", "profiles"]:
                whole = whole[:len(values)]
            if values.tobytes() != whole.tobytes():
                return f"WRONG: other values in {name}"
        times = len(found["series/time"])
        if in_hdf5:
            return f"ended by HDF5's library, file {'with' if times else 'without'} records"
        if ending.returncode == 0:
            if times == len(self.whole["series/time"]) and status == "complete":
                return "exit code 0, whole"
            return f"WRONG: exit code 0 with {times} times, {status}"
        return f"exit code 1, file {'with' if times else 'without'} records" + (
            ", the OpenMP library's words" if of_openmp else "")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("library")
    parser.add_argument("--calls", choices=["write", "memory"], action="append")
    parser.add_argument("--most", type=int)
    arguments = parser.parse_args()
    wrong = 0
    for calls in arguments.calls or ["write", "memory"]:
        for integrator in ["leapfrog", "dormand-prince"]:
            runs = Runs(arguments.program, arguments.library, integrator, calls)
            step = max(1, -(-runs.total // arguments.most)) if arguments.most else 1
            outcomes = collections.Counter()
            for n in range(1, runs.total + 1, step):
                for wish in [str(n), f"{n}+"]:
                    outcome = runs.outcome(wish)
                    outcomes[outcome] += 1
                    if outcome.startswith("WRONG"):
                        wrong += 1
                        print(f"{integrator}, {calls}:{wish}: {outcome}", flush=True)
            print(f"{integrator}, {calls}: {runs.total} calls")
            for outcome, count in sorted(outcomes.items()):
                print(f"  {count:6} {outcome}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

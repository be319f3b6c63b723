#!/usr/bin/python3
"""Stops runs at random moments, takes them up again, and holds them against runs that were never stopped.

usage: bench/restart.py build/drillstrand [--stops 1000] [--seed 1] [--keep DIR]

Each run is stopped by TERM or by kill -9 after a random time, some of them again after their
restart, with other numbers of threads; what it has in the end must be what a run holds that was
never stopped, bit for bit, in every series and profile. A run that was killed before its first
checkpoint starts anew. Prints a line per kind of run, and ends with 1 where one differed.
"""

import argparse
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py

CASES = Path(__file__).resolve().parent.parent / "cases"

# name: case and settings; each takes a few tenths of a second
RUNS = {
    "leapfrog, well and mud": ("well1", {"run.duration": 10, "output.profile_interval": 1,
                                         "head.rotation": [[0, 0], [2, 11]]}),
    "leapfrog, drilling, tolerance": ("well2_drilling", {"run.duration": 2, "run.tolerance": 1e-3,
                                                         "head.rotation": [[0, 0], [1, 2]]}),
    "leapfrog, bare": ("cantilever", {"run.duration": 60, "run.integrator": "leapfrog"}),
    "dormand-prince, well": ("well1_paper", {"run.duration": 0.03, "run.integrator": "dormand-prince",
                                             "output.interval": 0.003, "output.profile_interval": 0.015}),
    "dormand-prince, bare": ("cantilever", {"run.duration": 0.15, "run.integrator": "dormand-prince",
                                            "output.interval": 0.01}),
}
SECONDS_BETWEEN_CHECKPOINTS = 0.02
MOST_STOPS_OF_A_RUN = 3


def settings(values):
    words = []
    for key, value in {**values, "output.checkpoint_interval": SECONDS_BETWEEN_CHECKPOINTS}.items():
        text = f'"{value}"' if isinstance(value, str) else str(value)
        words += ["--set", f"{key}={text}"]
    return words


def records(path):
    """Every series and profile of a result, as bytes."""
    with h5py.File(path, "r") as result:
        return {f"{group}/{name}": data[()].tobytes()
                for group in ("series", "profiles") for name, data in result[group].items()}


class Run:
    def __init__(self, program, name, folder, chance):
        case, values = RUNS[name]
        self.command = [program, "run", str(CASES / f"{case}.toml"), "--quiet", *settings(values)]
        self.name = name
        self.folder = folder
        self.chance = chance
        # those of dormand-prince wait for each other: on a busy machine, for ever
        self.threads = [1] if "dormand-prince" in name else [1, 2, 3]
        self.wanted = None
        self.seconds = 0
        self.stops = {"TERM": 0, "kill -9": 0}
        self.anew = 0
        self.wrong = []

    def once(self, result, *more, stop_after=None, how=None):
        """The exit code of a run that is stopped, where it is asked for and did not end before."""
        threads = str(self.chance.choice(self.threads))
        process = subprocess.Popen([*self.command, "-o", str(result), "--threads", threads, *more],
                                   cwd=self.folder, stderr=subprocess.PIPE, text=True)
        if stop_after is not None:
            try:
                process.wait(stop_after)
            except subprocess.TimeoutExpired:
                process.send_signal(how)
        message = process.communicate()[1]
        return process.returncode, message

    def reference(self):
        result = self.folder / "whole.h5"
        start = time.monotonic()
        code, message = self.once(result, "--overwrite")
        self.seconds = time.monotonic() - start
        if code != 0:
            sys.exit(f"bench/restart.py: {self.name}: {message}")
        self.wanted = records(result)

    def stopped_run(self):
        """One run, stopped and taken up until it is done."""
        result = self.folder / "stopped.h5"
        checkpoint = self.folder / "stopped.checkpoint.h5"
        for path in (result, checkpoint, self.folder / "stopped.checkpoint.previous.h5"):
            path.unlink(missing_ok=True)
        more = []
        for _ in range(self.chance.randint(1, MOST_STOPS_OF_A_RUN)):
            how = self.chance.choice([signal.SIGTERM, signal.SIGKILL])
            code, message = self.once(result, *more, how=how,
                                      stop_after=self.chance.uniform(0, 1.1 * self.seconds))
            if code == 0:
                break
            if code not in (130, -signal.SIGKILL, -signal.SIGTERM):
                return f"exit {code}: {message}"
            self.stops["TERM" if how == signal.SIGTERM else "kill -9"] += 1
            if checkpoint.exists():
                more = ["--restart", str(checkpoint)]
            else:
                self.anew += 1
                more = ["--overwrite"]
        else:
            code, message = self.once(result, *more)
            if code != 0:
                return f"exit {code}: {message}"
        found = records(result)
        different = [name for name in self.wanted if found.get(name) != self.wanted[name]]
        return f"different: {', '.join(different)}" if different else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--stops", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch:
        runs = []
        for k, name in enumerate(RUNS):
            folder = Path(scratch) / str(k)
            folder.mkdir()
            runs.append(Run(str(options.program.resolve()), name, folder, chance))
            runs[-1].reference()
        turn = 0
        while sum(sum(run.stops.values()) for run in runs) < options.stops:
            run = runs[turn % len(runs)]
            turn += 1
            problem = run.stopped_run()
            if problem:
                run.wrong.append(problem)
                print(f"{run.name}: {problem}", file=sys.stderr)
        print("| run | stopped by TERM | by kill -9 | begun anew | not the same |")
        print("|---|---|---|---|---|")
        for run in runs:
            print(f"| {run.name} | {run.stops['TERM']} | {run.stops['kill -9']} | {run.anew} | "
                  f"{len(run.wrong)} |")
            wrong += len(run.wrong)
    total = sum(sum(run.stops.values()) for run in runs)
    print(f"{total} stops, {wrong} runs that were not the same")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()

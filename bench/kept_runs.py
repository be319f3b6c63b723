"""Runs of a study, several at a time: finished ones are kept in a file, so that a study goes on where
it was interrupted, and none begins after the study's end."""

import functools
import hashlib
import json
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import measure


class Task(NamedTuple):
    """A run, and what is wanted of its result. `settings`: texts as --set takes them; `wanted`:
    anything that JSON can say; `label`: for people."""
    label: str
    case: str
    settings: dict
    threads: int
    wanted: object


@functools.cache
def case_text(name):
    return (measure.ROOT / "cases" / name).read_text(encoding="utf-8")


def in_toml(settings):
    """Values as the program reads them; JSON's and TOML's are the same for these."""
    return {key: json.dumps(value) for key, value in settings.items()}


class KeptRuns:
    """`path`: a line of JSON for each finished run. `look(result, wanted)`: the numbers of a result
    file, as a dict that JSON can hold. `program`: its version; another one's runs do not count.
    `end`: of time.monotonic()."""

    def __init__(self, build, path, program, look, end):
        self.build, self.path, self.program, self.look, self.end = build, path, program, look, end
        self.lock = threading.Lock()
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        self.kept = {entry["key"]: entry["numbers"] for entry in map(json.loads, lines)}

    def key_of(self, task):
        asked = [self.program, case_text(task.case), *task[2:]]
        return hashlib.sha256(json.dumps(asked).encode()).hexdigest()[:16]

    def numbers(self, task):
        """Of one run; {"failed": why}, which is kept where physics stopped the run at some time; None
        where no time is left."""
        key = self.key_of(task)
        if key in self.kept:
            return self.kept[key]
        if time.monotonic() > self.end:
            return None
        with tempfile.TemporaryDirectory() as folder:
            result = Path(folder) / "result.h5"
            try:
                measure.run_case(self.build, task.case, task.settings, task.threads, result)
            except SystemExit as failure:
                why = str(failure).strip().splitlines()[-1].split("error: ")[-1]
                numbers = {"failed": why.split("; ")[0]}  # without advice
                if " at t = " not in why:
                    return numbers
            else:
                numbers = self.look(result, task.wanted)
        with self.lock:
            entry = {"key": key, "run": task.label, "numbers": numbers}
            with open(self.path, "a", encoding="utf-8") as file:
                file.write(json.dumps(entry) + "\n")
            self.kept[key] = numbers
        print(task.label, file=sys.stderr)
        return numbers

    def all_numbers(self, tasks, jobs):
        """Of all runs, in the order of the tasks, which is also that of their beginnings."""
        with ThreadPoolExecutor(jobs) as pool:
            return list(pool.map(self.numbers, tasks))

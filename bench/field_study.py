"""Runs of the field cases and their statistics: motions, what is varied in them, independent starts,
and the equilibrium of the same motion beside them.

A string that rolls and slides in its well is chaotic: two runs are compared by their statistics over a
window of time, and means by what several starts agree on. A start differs from the others in when
rotation begins and how long it increases.
"""

import hashlib
import math
import subprocess
import tempfile
import time
import tomllib
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np

import measure
from confidence import describe, interval, with_confidence
from kept_runs import KeptRuns, Task, case_text, in_toml

# What a start changes: rotation begins so much later (s) and increases so much longer, each time.
DELAY, STRETCH = 0.31, 0.06
# Of records (s). The second is no simple part of a turn.
RECORDS = {"output.interval": 0.02, "output.profile_interval": 0.47,
           "output.checkpoint_interval": 0}
# Quantities and their units; besides: kinetic energy over that of the string's pure rotation, and how
# deep the string lies in its wall (mm).
UNITS = {"hook load": "kN", "torque": "kN m", "wall force": "kN", "in contact": "%"}
ROTATION = "kinetic over rotation"
DEPTH = "in the wall"


class Times(NamedTuple):
    """Of a run (s). `windows`: from and to, by name. `rotation`, `load`: when they begin; None: as
    the case has it."""
    windows: dict
    duration: float
    rotation: float | None = None
    load: float | None = None


class Motion(NamedTuple):
    """A case in a motion; `word`: of equilibrium.motion."""
    name: str
    case: str
    word: str
    times: Times
    settings: dict = {}


class Variation(NamedTuple):
    """What a row of a table changes. `mesh`: times the segments of the case; `times`: other than the
    motion's; `starts`: at most; `dear`: comes after everything else."""
    name: str
    settings: dict = {}
    mesh: int = 1
    threads: int = 1
    times: Times | None = None
    starts: int = 1000
    dear: bool = False


def last(seconds, duration):
    return {"last": (duration - seconds, duration)}


def friction(coefficient):
    return {"contact.static_friction": coefficient, "contact.dynamic_friction": coefficient}


def add_options(parser):
    """Options of a study."""
    measure.add_options(parser)
    parser.add_argument("--starts", type=int, default=8, help="of each row (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default: %(default)s)")
    parser.add_argument("--budget", type=float, default=math.inf, metavar="MINUTES",
                        help="start no run after that; the same command goes on another time")
    parser.add_argument("--set", action="append", default=[], metavar="key.path=value",
                        dest="settings", help="of all runs, as for drillstrand")
    parser.add_argument("--quick", action="store_true", help="a trial: two starts of a few seconds")


# ------------------------------------------------------------------ results

def samples(file):
    """Times and values of each quantity in a result file, in its unit."""
    series, profiles, cell = file["series"], file["profiles"], file["string/cell"][:]
    moments, kinetic = series["time"][:], series["kinetic_energy"][:]
    inertia = float(np.sum(file["string/polar_inertia"][:] * cell))
    pure = 0.5 * inertia * series["head_rotation_rate"][:]**2
    return {
        "hook load": (moments, series["hook_load"][:] / 1e3),
        "torque": (moments, series["surface_torque"][:] / 1e3),
        "wall force": (profiles["time"][:], profiles["normal_force"][:] @ cell / 1e3),
        "in contact": (moments, 100 * series["contact_nodes"][:] / cell.size),
        ROTATION: (moments, np.divide(kinetic, pure, out=np.zeros_like(kinetic), where=pure > 0)),
        DEPTH: (moments, 1e3 * series["max_penetration"][:]),
    }


def numbers_of(path, windows):
    """Statistics of each quantity in each window of a run, its speed and the digest of its series."""
    with h5py.File(path) as file:
        found = samples(file)
        digest = hashlib.sha256()
        for name in sorted(file["series"]):
            digest.update(file["series"][name][:].tobytes())
        speed = float(file.attrs["wall_seconds"]) / float(file["series/time"][-1])
    return {"windows": {name: {quantity: describe(values[(moments >= start) & (moments <= end)])
                               for quantity, (moments, values) in found.items()}
                        for name, (start, end) in windows.items()},
            "wall s per s": speed, "digest": digest.hexdigest()}


# ------------------------------------------------------------------ runs

def moved(schedule, start=None, delay=0.0, stretch=1.0):
    """A schedule that begins at `start`, or later by `delay`, and passes `stretch` times as slowly."""
    first = schedule[0][0]
    begin = (first if start is None else start) + delay
    return [[round(begin + stretch * (moment - first), 9), value] for moment, value in schedule]


def settings_of(motion, variation, times, start=0):
    """Case keys and values of a run."""
    case = tomllib.loads(case_text(motion.case))
    settings = dict(motion.settings)
    rotation = settings.get("head.rotation", case["head"]["rotation"])
    settings["head.rotation"] = moved(rotation, times.rotation, DELAY * start, 1 + STRETCH * start)
    for key in ("weight", "torque"):
        schedule = settings.get(f"bit.{key}", case.get("bit", {}).get(key))
        if times.load is not None and isinstance(schedule, list):
            settings[f"bit.{key}"] = moved(schedule, times.load)
    settings["mesh.segments"] = case["mesh"]["segments"] * variation.mesh
    settings["run.duration"] = times.duration
    return settings | RECORDS | variation.settings


class Study:
    """Runs of motions and their variations. `quick`: the times of a trial."""

    def __init__(self, options, quick):
        self.options = options
        self.quick = quick if options.quick else None
        self.starts = min(options.starts, 2) if options.quick else options.starts
        self.remark = "Trial of a few seconds. " if options.quick else ""
        self.facts = measure.provenance(options.build)
        self.facts.append(("starts", f"rotation begins {DELAY} s later with each, and increases for "
                                     f"{100 * STRETCH:.0f} % longer"))
        self.folder = measure.results_folder(options.machine)
        self.runs = KeptRuns(options.build, self.folder / "field_study_runs.jsonl",
                             dict(self.facts)["program"], numbers_of,
                             time.monotonic() + 60 * options.budget)
        self.given = dict(setting.split("=", 1) for setting in options.settings)

    def all_numbers(self, motions, variations):
        """{(motion, variation): numbers of its starts}. First starts come first, so that a study which
        was interrupted has something of everything."""
        entries = []
        for start in range(self.starts):
            for motion in motions:
                for variation in variations:
                    if start < variation.starts:
                        entries.append((motion, variation, start))
        entries.sort(key=lambda entry: entry[1].dear)
        tasks = []
        for motion, variation, start in entries:
            times = self.quick or variation.times or motion.times
            settings = in_toml(settings_of(motion, variation, times, start)) | self.given
            tasks.append(Task(f"{motion.name}, {variation.name}, start {start}", motion.case,
                              settings, variation.threads, times.windows))
        found = {}
        for (motion, variation, _), numbers in zip(entries,
                                                   self.runs.all_numbers(tasks, self.options.jobs)):
            found.setdefault((motion.name, variation.name), []).extend([numbers] if numbers else [])
        return found

    def static(self, motion, variation, word):
        """The quantities of the equilibrium of the same motion; {} where there is none."""
        settings = settings_of(motion, variation, motion.times) | {"equilibrium.motion": word}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "equilibrium.h5"
            command = [measure.executable(self.options.build, "drillstrand"), "equilibrium",
                       measure.ROOT / "cases" / motion.case, "-o", path,
                       *measure.set_options(in_toml(settings) | self.given)]
            if subprocess.run(command, capture_output=True, check=False).returncode != 0:
                return {}
            with h5py.File(path) as file:
                return {name: float(values[-1]) for name, (_, values) in samples(file).items()}

    def write(self, name, rows):
        """Rows as CSV."""
        trial = "_trial" if self.quick else ""
        measure.write_csv(self.folder / f"{name}{trial}.csv", self.facts, rows)


# ------------------------------------------------------------------ rows

def row_of(names, results, static, window="last"):
    """The numbers of a row, over its starts."""
    sound = [result for result in results if "failed" not in result]
    row = {**names, "starts": len(sound), "failed": len(results) - len(sound),
           "why": next((result["failed"] for result in results if "failed" in result), "")}
    for quantity in [*UNITS, ROTATION, DEPTH]:
        starts = [result["windows"][window][quantity] for result in sound]
        row[quantity], row[f"{quantity}, confidence"] = interval([start["mean"] for start in starts])
        for name in ("spread", "low", "high"):
            row[f"{quantity}, {name}"] = interval([start[name] for start in starts])[0]
        row[f"{quantity}, most"] = max((start["most"] for start in starts), default=math.nan)
        row[f"{quantity}, static"] = static.get(quantity, math.nan)
    row["wall s per s"] = interval([result["wall s per s"] for result in sound])[0]
    return row


def starts_text(row):
    return f"{row['starts']}" + (f"; {row['failed']} failed: {row['why']}" if row["failed"] else "")


def mean_text(row, quantity):
    return with_confidence(row[quantity], row[f"{quantity}, confidence"])


def static_text(row, quantity):
    """The equilibrium, and by how much a mean departs from it."""
    static = row[f"{quantity}, static"]
    if not static > 0 < row["starts"]:
        return ""
    return f"{static:.5g}; {100 * (row[quantity] / static - 1):+.2f} %"

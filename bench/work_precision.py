#!/usr/bin/python3
"""Time against error: leapfrog, dormand-prince and ARKODE of SUNDIALS on seven motions.

Each method runs each motion on several meshes, steps and tolerances; its error is measured against
an exact or independent solution where there is one, and otherwise against a converged run of the
other formulation. bench/README.md says how, and how times are compared at equal error.
"""

import argparse
import csv
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

import measure

PAPER = (1e-7, 1e-5)  # the paper's absolute and relative tolerance
LOOSE = (1e-5, 1e-3)
PROGRAM = "bench/bench_work_precision"
RESOLVED = 1.5  # times the distance of two references: what they can tell from no error
# at each station: north, east, down (m), tension (N), twist moment, bending moment (N m), normal
# force of the wall (N/m)
QUANTITIES = 7
TENSION, TORQUE, BENDING, SIDE_FORCE = 3, 4, 5, 6
NAMES = {TENSION: "tension", TORQUE: "torque", BENDING: "bending", SIDE_FORCE: "side force"}


# ---------------------------------------------------------------- methods

@dataclass(frozen=True)
class Variant:
    """A method with its settings, but for the mesh."""
    method: str
    inertia: bool
    accuracy: tuple  # (absolute, relative), (cfl,), (tolerance, order), or none
    before: bool = False  # of the release with the segment of second order

    @property
    def name(self):
        """As in the legend and in the table."""
        inertia = ", segment inertia" if self.inertia else ""
        method = self.method + (", old segment" if self.before else "")
        if self.method == "equilibrium":
            return method
        if self.method == "leapfrog":
            return f"{method}, cfl {self.accuracy[0]:g}"
        if self.method == "arkode":
            return f"ARKODE order {self.accuracy[1]}, {self.accuracy[0]:g}{inertia}"
        return f"dormand-prince, {self.accuracy[0]:g} and {self.accuracy[1]:g}{inertia}"

    def arguments(self):
        """Of the C++ program."""
        settings = {"mesh.segment_inertia": str(self.inertia).lower()}
        options = ["--method", self.method]
        if self.method == "equilibrium":
            pass
        elif self.method == "leapfrog":
            settings["run.cfl"] = self.accuracy[0]
        elif self.method == "arkode":
            options += ["--tolerance", str(self.accuracy[0]), "--order", str(self.accuracy[1])]
        else:
            settings["run.absolute_tolerance"], settings["run.relative_tolerance"] = self.accuracy
        return options + settings_arguments(settings)


def settings_arguments(settings):
    """`--set` for each key."""
    return [text for key, value in settings.items() for text in ("--set", f"{key}={value}")]


LEAPFROG = [Variant("leapfrog", False, (cfl,)) for cfl in (0.9, 0.45)]
PAPERS_METHOD = Variant("dormand-prince", False, PAPER)
DORMAND_PRINCE = [PAPERS_METHOD, Variant("dormand-prince", False, LOOSE),
                  Variant("dormand-prince", True, PAPER)]
ARKODE = [Variant("arkode", False, (1e-2, 4)), Variant("arkode", False, (1e-3, 4)),
          Variant("arkode", False, (1e-4, 4)), Variant("arkode", True, (1e-2, 4))]
EQUILIBRIUM = [Variant("equilibrium", False, ())]
LONG_RUN = 20.0  # s; a run that takes longer is not repeated: noise cannot change its verdict


# ---------------------------------------------------------------- motions

@dataclass
class Motion:
    """What is simulated, and how errors are measured."""
    key: str
    title: str
    segments: int  # of the coarsest mesh
    stations: int
    settings: dict
    error: str  # the name of its axis
    case: str = ""  # a file of cases/, or else
    text: str = ""  # the case file itself
    survey: str = ""  # of the well that the text names survey.csv
    reference: object = None  # function of time: exact stations; None: converged runs
    quick: dict = field(default_factory=dict)  # settings of a trial
    used: tuple = (TENSION, TORQUE)  # whose error counts; () for the place of the last station
    means: int = 1  # samples that a record's stresses and forces are the mean of
    bends: bool = False  # whether its error is that of bending
    rests: bool = False  # whether it ends at rest, where statics know it too


SWING_TIP = {0.5: (23.931912919, -1.724811036), 1: (23.118682909, -6.077534366),
             1.5: (21.146898634, -10.519013881), 2: (19.872558851, -12.390616597),
             3: (22.855870743, -6.869061354), 4: (23.999496493, 0.018200712)}


def swing_reference(time):
    """The tip of the undamped cantilever along and up: discontinuous Galerkin spectral elements,
    converged to about seven digits."""
    rows = np.full((len(time), 2, QUANTITIES), np.nan)
    for i, t in enumerate(time):
        if t in SWING_TIP:
            along, up = SWING_TIP[t]
            rows[i, 1, :3] = along, 0.0, -up
    return rows


HANGING = {"length": 1000.0, "outer": 0.14, "inner": 0.12, "density": 31.8557, "young": 200e9,
           "gravity": 9.81, "spin_up": 0.5, "rate": 2 * math.pi}


def hanging_reference(time):
    """Waves in a straight rod that hangs from a turning head: d'Alembert's solution with all
    reflections. The weight acts from t = 0 on; the head's rotation rises linearly."""
    p = HANGING
    stations = HANGING_STATIONS + 1
    area = math.pi / 4 * (p["outer"] ** 2 - p["inner"] ** 2)
    second = math.pi / 64 * (p["outer"] ** 4 - p["inner"] ** 4)
    axial = math.sqrt(p["young"] * area / p["density"])
    rigidity = p["young"] / 2 * 2 * second  # G J with Poisson's ratio 0
    polar = 2 * p["density"] * second / area
    torsional = math.sqrt(rigidity / polar)
    s = np.linspace(0.0, p["length"], stations)

    def waves(speed, history, sign):
        """sum over reflections of (-1)^k [history(t - (2kL + s)/c) +- history(t - (2(k+1)L - s)/c)]"""
        total = np.zeros((len(time), stations))
        for k in range(1 + int(max(time) * speed / (2 * p["length"]))):
            down = np.subtract.outer(time, (2 * k * p["length"] + s) / speed)
            back = np.subtract.outer(time, (2 * (k + 1) * p["length"] - s) / speed)
            total += (-1) ** k * (history(down) + sign * history(back))
        return total

    def fall(t):
        return np.maximum(t, 0.0)

    def rate(t):
        return p["rate"] * np.clip(t / p["spin_up"], 0.0, 1.0)

    rows = np.full((len(time), stations, QUANTITIES), np.nan)
    rows[:, :, :2] = 0.0
    t = np.asarray(time)[:, None]
    drop = waves(axial, lambda x: fall(x) ** 2 / 2, 1)
    rows[:, :, 2] = s + p["gravity"] * (t ** 2 / 2 - drop)
    rows[:, :, TENSION] = (p["young"] * area * p["gravity"] / axial) * waves(axial, fall, -1)
    rows[:, :, TORQUE] = -(rigidity / torsional) * waves(torsional, rate, -1)
    return rows


HANGING_STATIONS = 16
HANGING_CASE = """
title = "Straight string that hangs from a turning head"
gravity = {gravity}
[string]
shear_coefficient = 1.0
[[string.component]]
name = "pipe"
length = {length}
outer_diameter = {outer}
inner_diameter = {inner}
linear_density = {density}
youngs_modulus = {young}
poisson_ratio = 0.0
[mesh]
segments = 32
[head]
rotation = [[0, 0], [{spin_up}, {rate}]]
[initial]
# no string is perfectly straight: a bend of 5 mm over the whole length, too little to change the
# waves (1e-10), wakes the modes that an explicit method has to follow
curvature = [0, 1e-8, 0]
[run]
duration = 2
[output]
interval = 0.05
""".format(**HANGING)

CURVED_SURVEY = "md[m],inclination[deg],azimuth[deg]\n0,30,0\n300,60,0\n400,60,0\n"
DRILL_PIPE = """\
[string]
[[string.component]]
name = "drill pipe"
length = 300
outer_diameter = "5 in"
inner_diameter = "4.276 in"
linear_density = 31.9
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
[mesh]
segments = 32
"""
BUILD_SURVEY = "md[m],inclination[deg],azimuth[deg]\n0,30,0\n160,46,0\n400,46,0\n"
# Without friction, which would make the state of rest depend on the way to it.
AT_REST_CASE = """
title = "Drill pipe that comes to rest in a deviated well"
[well]
survey = "survey.csv"
diameter = "8.5 in"
""" + DRILL_PIPE + """\
[damping]
external_rotation = 1  # N s
external_translation = 300  # N s/m2: waves along the string die out ten times in two seconds
[contact]
normal_stiffness = 1e5
normal_damping = 1e3
static_friction = 0
dynamic_friction = 0
[initial]
state = "coaxial"
offset = [-0.028, 0, 0.034]  # near the low side
[run]
duration = 6
[output]
interval = 6
"""

CURVED_CASE = """
title = "Drill pipe that turns on the low side of a bent well"
[well]
survey = "survey.csv"
diameter = "8.5 in"
[fluid]
density = 1200
viscosity = "20 cP"
""" + DRILL_PIPE + """\
[head]
rotation = [[0.5, 0], [1.5, "1 Hz"]]
[contact]
normal_stiffness = 1e5
normal_damping = 1e3
tangential_stiffness = 1e4
static_friction = 0.3
dynamic_friction = 0.25
[initial]
state = "coaxial"  # but for the next
offset = [-0.031, 0, 0.031]  # near the low side in the middle of the bend
[run]
duration = 4
[output]
interval = 0.1
"""

MOTIONS = [
    Motion("cantilever", "Cantilever let go from level, undamped", 8, 1,
           {"damping.internal": 0, "damping.external": 0, "run.duration": 4,
            "output.interval": 0.5}, "error of the tip (m), root mean square of six times",
           case="cantilever.toml", reference=swing_reference, used=(), bends=True,
           quick={"run.duration": 2}),
    Motion("at-rest", "Drill pipe coming to rest in a deviated well", 32, 16, {},
           "error of side force and bending moment, of their ranges", text=AT_REST_CASE,
           survey=BUILD_SURVEY, used=(BENDING, SIDE_FORCE), bends=True, rests=True,
           quick={"run.duration": 4, "output.interval": 4}),
    Motion("ring-down-axial", "Hanging string, axial waves", 32, HANGING_STATIONS, {},
           "error of the tension, of its range", text=HANGING_CASE,
           reference=hanging_reference, used=(TENSION,), quick={"run.duration": 1}),
    Motion("ring-down-torsional", "Hanging string, torsional waves", 32, HANGING_STATIONS, {},
           "error of the twist moment, of its range", text=HANGING_CASE,
           reference=hanging_reference, used=(TORQUE,), quick={"run.duration": 1}),
    Motion("curved-well", "Drill pipe turning in a bent well", 32, 16, {},
           "error of tension and twist moment, of their ranges", text=CURVED_CASE,
           survey=CURVED_SURVEY, quick={"run.duration": 2}, means=10),
    Motion("well-1", "Well 1, drilling", 86, 43,
           {"head.rotation": '[[0.5, 0], [2, "1.83 Hz"]]', "bit.weight": '[[4, 0], [6, "65 kN"]]',
            "bit.torque": '[[4, 0], [6, "10 kN m"]]', "run.duration": 6, "output.interval": 0.1},
           "error of tension and twist moment, of their ranges", case="well1_paper.toml", means=10,
           quick={"run.duration": 3, "bit.weight": '[[1, 0], [2, "65 kN"]]',
                  "bit.torque": '[[1, 0], [2, "10 kN m"]]'}),
    Motion("well-3", "Well 3, turning", 147, 49,
           {"head.rotation": '[[0, 0], [1, "2 Hz"]]', "run.duration": 3, "output.interval": 0.1},
           "error of tension and twist moment, of their ranges", case="well3_paper.toml", means=10,
           quick={"run.duration": 0.5}),
]


# ---------------------------------------------------------------- runs

class Bench:
    """Runs motions by methods."""

    def __init__(self, options, scratch):
        self.options = options
        self.scratch = Path(scratch)
        self.program = {False: measure.executable(options.build, PROGRAM)}
        if options.before:
            self.program[True] = measure.executable(options.before, PROGRAM)

    def case_file(self, motion):
        """The case file of a motion."""
        if motion.case:
            return measure.ROOT / "cases" / motion.case
        folder = self.scratch / motion.key
        folder.mkdir(exist_ok=True)
        (folder / "survey.csv").write_text(motion.survey, encoding="utf-8")
        path = folder / "case.toml"
        path.write_text(motion.text, encoding="utf-8")
        return path

    def settings(self, motion):
        """What differs from the case file."""
        return motion.settings | (motion.quick if self.options.quick else {})

    def start(self, motion, variant, segments, repeat):
        """Starts a run."""
        command = [str(self.program[variant.before]), str(self.case_file(motion)), *variant.arguments(),
                   *settings_arguments(self.settings(motion) | {"mesh.segments": segments}),
                   "--stations", str(motion.stations), "--means", str(motion.means)]
        if repeat:
            command += ["--seconds", "0.3", "--most-repetitions", "15"]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def finish(self, process, limit=None):
        """The result of a run, or why there is none."""
        try:
            out, err = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return None, f"took longer than {limit:g} s"
        if process.returncode != 0:
            why = err.strip().removeprefix("bench_work_precision: error: ")
            return None, why or f"ended with code {process.returncode}"
        result = json.loads(out)
        rows = np.array(result.pop("rows"))
        result["rows"] = rows.reshape(len(rows), -1, QUANTITIES)
        return result, ""


def say(text):
    """Progress."""
    print(text, file=sys.stderr, flush=True)


# ---------------------------------------------------------------- errors

def root_mean_square(values):
    """Of the values that are there."""
    return math.sqrt(np.nanmean(np.square(values)))


def error_of(motion, rows, reference):
    """Errors of a run after its start: that of the motion's axis, and of place (m), stresses and
    side force (relative to the range in the reference)."""
    def relative(quantity):
        # bending and side force of the paper's method are not known at the very ends
        nodes = slice(1, -1) if quantity in (BENDING, SIDE_FORCE) else slice(None)
        true = reference[1:, nodes, quantity]
        span = np.nanmax(true) - np.nanmin(true) if np.isfinite(true).any() else 0.0
        if span == 0.0:
            return math.nan
        return root_mean_square(rows[1:, nodes, quantity] - true) / span

    place = root_mean_square(np.linalg.norm(rows[1:, 1:, :3] - reference[1:, 1:, :3], axis=2))
    errors = {"place (m)": place} | {name: relative(quantity) for quantity, name in NAMES.items()}
    if not motion.used:
        return place, errors
    parts = [errors[NAMES[quantity]] for quantity in motion.used]
    return root_mean_square(np.array(parts)), errors


def references_of(bench, motion, factor):
    """{method: (rows, what they are)}: what a method's error is measured against, and the distance
    between the two references where both are runs."""
    if motion.reference:
        settings = bench.settings(motion)
        text = motion.text or (measure.ROOT / "cases" / motion.case).read_text(encoding="utf-8")
        duration = settings.get("run.duration", number_in(text, "duration"))
        interval = settings.get("output.interval", number_in(text, "interval"))
        time = [i * interval for i in range(round(duration / interval) + 1)]
        exact = motion.reference(time)
        word = "independent solution" if motion.key == "cantilever" else "exact"
        return {method: (exact, word)
                for method in ("leapfrog", "dormand-prince", "arkode", "equilibrium")}, 0.0

    segments = factor * motion.segments
    fine = {"leapfrog": Variant("leapfrog", False, (0.3,)), "dormand-prince": PAPERS_METHOD}
    say(f"{motion.key}: converged runs with {segments} segments")
    started = {method: bench.start(motion, variant, segments, False)
               for method, variant in fine.items()}
    rows = {}
    for method, process in started.items():
        result, why = bench.finish(process)
        if result is None:
            sys.exit(f"{motion.key}: the converged run of {method} failed: {why}")
        rows[method] = result["rows"]
    floor, _ = error_of(motion, rows["leapfrog"], rows["dormand-prince"])
    strands = (rows["leapfrog"], f"{fine['leapfrog'].name}, N = {segments}")
    directors = (rows["dormand-prince"], f"{fine['dormand-prince'].name}, N = {segments}")
    return {"leapfrog": directors, "equilibrium": directors, "dormand-prince": strands,
            "arkode": strands}, floor


def number_in(text, key):
    """The value of a key of a case file that is a plain number."""
    for line in text.splitlines():
        name, _, value = line.partition("=")
        if name.strip() == key:
            return float(value.split("#")[0])
    raise KeyError(key)


# ---------------------------------------------------------------- the study of one motion

def jobs_of(options, motion):
    """(variant, segments) of all runs."""
    doublings = 2 if options.quick else 3
    jobs = []
    ours = LEAPFROG + (EQUILIBRIUM if motion.rests else [])
    half = motion.segments // 2  # of fourth order, it may do on half the segments
    for variant in ours:
        if half % motion.stations == 0:
            jobs.append((variant, half))
        jobs += [(variant, motion.segments << i) for i in range(doublings + 1)]
    if options.before:
        # its nodes had the inertia of rigid pieces by default
        old = [replace(variant, before=True, inertia=True) for variant in ours]
        jobs += [(variant, motion.segments << i) for variant in old for i in range(doublings + 1)]
    for variant in DORMAND_PRINCE:
        jobs += [(variant, motion.segments << i) for i in range(doublings)]
    if options.arkode and not motion.rests:  # it knows no side force
        for variant in ARKODE:
            jobs += [(variant, motion.segments << i) for i in range(2)]
    return jobs


def study(bench, motion):
    """Rows of the CSV file: one per method, setting and mesh."""
    options = bench.options
    references, floor = references_of(bench, motion, 4 if options.quick else 16)
    jobs = jobs_of(options, motion)
    times = {job: [] for job in jobs}
    last = {}
    given_up = {}
    order = random.Random(20241)
    for turn in range(options.rounds):
        order.shuffle(jobs)
        # coarse meshes first: a method that is too slow there is not asked for finer ones
        for variant, segments in sorted(jobs, key=lambda job: job[1]):
            job = (variant, segments)
            if times[job] and times[job][-1][0] > LONG_RUN:
                continue
            if variant in given_up:
                last.setdefault(job, (None, given_up[variant]))
                continue
            result, why = bench.finish(bench.start(motion, variant, segments, True), options.limit)
            if result is None:
                last[job] = (None, why)
                if why.startswith("took longer"):
                    given_up[variant] = f"not tried: a coarser mesh {why}"
                continue
            times[job].append((result["wall"], result["processor"]))
            last[job] = (result, "")
            say(f"{motion.key} {turn + 1}/{options.rounds}: {variant.name}, N = {segments}: "
                f"{result['wall']:.3g} s")
    return [row_of(motion, job, times[job], *last[job], references[job[0].method], floor)
            for job in jobs_of(options, motion)]


def row_of(motion, job, times, result, why, reference, floor):
    """One line of the CSV file."""
    variant, segments = job
    row = {"motion": motion.key, "method": variant.method, "variant": variant.name,
           "segment_inertia": variant.inertia, "segments": segments}
    numbers = dict.fromkeys(
        ("wall (s)", "least wall (s)", "most wall (s)", "processor (s)", "runs", "steps",
         "rejected", "evaluations", "error", "place error (m)",
         *(f"{name} error" for name in NAMES.values())), "")
    if result is not None:
        walls = [wall for wall, _ in times]
        error, parts = error_of(motion, result["rows"], reference[0])
        numbers = {
            "wall (s)": statistics.median(walls), "least wall (s)": min(walls),
            "most wall (s)": max(walls),
            "processor (s)": statistics.median(processor for _, processor in times),
            "runs": len(walls), "steps": result["steps"], "rejected": result["rejected"],
            "evaluations": result["evaluations"], "error": error,
            "place error (m)": parts["place (m)"],
            **{f"{name} error": parts[name] for name in NAMES.values()}}
    return row | numbers | {"reference": reference[1], "references differ by": floor,
                            "failure": why}


# ---------------------------------------------------------------- times at equal error

def front(rows, clock):
    """[(error, time, segments)] of the runs that no other of `rows` beats in both, errors
    descending. Errors that the references cannot tell from none count as the least they can."""
    points = sorted((row[clock], max(row["error"], RESOLVED * row["references differ by"]),
                     row["segments"]) for row in rows if not row["failure"])
    best = []
    for time, error, segments in points:
        if not best or error < best[-1][0]:
            best.append((error, time, segments))
    return best


def time_at(points, error):
    """Time of a front for an error, between its points by powers; the cheapest time where any of
    its points is better; None where none is as good."""
    if not points or error < points[-1][0]:
        return None
    if error >= points[0][0]:
        return points[0][1]
    for (e0, t0, _), (e1, t1, _) in zip(points, points[1:]):
        if e1 <= error <= e0:
            part = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** part
    raise AssertionError("a front is sorted")


def ratios(rows, of, clock):
    """[(segments, error, ratio)]: time of the front of the runs that `of` picks, over that of the
    leapfrog's at the same error."""
    fast = front([row for row in rows if is_leapfrog(row)], clock)
    found = []
    for error, time, segments in front([row for row in rows if of(row)], clock):
        reached = time_at(fast, error)
        found.append((segments, error, time / reached if reached else None))
    return found


def is_leapfrog(row):
    """Runs of the leapfrog as it is."""
    return row["method"] == "leapfrog" and "old segment" not in row["variant"]


def is_leapfrog_before(row):
    """Runs of the leapfrog with the segment of second order."""
    return row["method"] == "leapfrog" and not is_leapfrog(row)


def is_paper(row):
    """Runs of the paper's method: its tolerances, its inertia."""
    return row["variant"] == PAPERS_METHOD.name


def is_paper_with_inertia(row):
    """The same with segment inertia."""
    return row["variant"] == Variant("dormand-prince", True, PAPER).name


def is_arkode(row):
    """Runs of ARKODE, with all tolerances."""
    return row["method"] == "arkode"


def median_ratio(found):
    """Median of the ratios that exist."""
    known = [ratio for _, _, ratio in found if ratio]
    return statistics.median(known) if known else None


def as_text(ratio, missing="leapfrog does not get there"):
    """A ratio for a table."""
    return missing if ratio is None else f"{ratio:.3g}"


def summary(motions, rows, clock):
    """Lines of the table, and the medians of the paper's ratio over the motions, and of the old
    segment's over those that bend."""
    lines = []
    medians = []
    before = []
    for motion in motions:
        own = [row for row in rows if row["motion"] == motion.key]
        paper = ratios(own, is_paper, clock)
        middle = median_ratio(paper)
        if middle:
            medians.append(middle)
        old = median_ratio(ratios(own, is_leapfrog_before, clock))
        if old and motion.bends:
            before.append(old)
        lines.append({
            "motion": motion.title,
            "reference": reference_text(own),
            "dormand-prince over leapfrog": as_text(middle),
            "by mesh": ", ".join(f"N = {n} ({error:.1e}): {as_text(ratio)}"
                                 for n, error, ratio in paper),
            "old segment over new": as_text(old, "not measured"),
            "with segment inertia": as_text(median_ratio(ratios(own, is_paper_with_inertia,
                                                                clock))),
            "ARKODE over leapfrog": as_text(median_ratio(ratios(own, is_arkode, clock)))})
    return lines, *(statistics.median(found) if found else None for found in (medians, before))


def reference_text(rows):
    """What errors of a motion are measured against."""
    floor = rows[0]["references differ by"]
    if not floor:
        return rows[0]["reference"]
    return f"converged runs of each other, which differ by {floor:.1e}"


# ---------------------------------------------------------------- pictures

STYLES = {  # family: (colour, marker, line)
    "leapfrog": (measure.BLUE, "o", "-"),
    "leapfrog, old segment": (measure.SKY, "o", "--"),
    "equilibrium": (measure.PURPLE, "*", "-"),
    "equilibrium, old segment": (measure.PURPLE, "*", "--"),
    "dormand-prince, paper's inertia": (measure.RED, "s", "-"),
    "dormand-prince, segment inertia": (measure.ORANGE, "D", "-"),
    "ARKODE, paper's inertia": (measure.GREEN, "^", "--"),
    "ARKODE, segment inertia": (measure.PURPLE, "v", "--"),
}


def family(row):
    """Key of STYLES."""
    if row["method"] in ("leapfrog", "equilibrium"):
        return row["method"] + (", old segment" if "old segment" in row["variant"] else "")
    name = "ARKODE" if row["method"] == "arkode" else "dormand-prince"
    return f"{name}, {'segment' if row['segment_inertia'] else 'paper' + chr(39) + 's'} inertia"


def draw(motion, rows, clock, path, conditions):
    """Time against error of one motion, a line per variant through its meshes."""
    picture, panel = measure.figure(7, 5.8)
    done = [row for row in rows if not row["failure"]]
    seen = set()
    for variant in dict.fromkeys(row["variant"] for row in done):
        line = [row for row in done if row["variant"] == variant]
        name = family(line[0])
        colour, marker, style = STYLES[name]
        strong = line[0]["variant"] in (LEAPFROG[0].name, PAPERS_METHOD.name)
        panel.loglog([row[clock] for row in line], [row["error"] for row in line], marker=marker,
                     color=colour, linestyle=style, linewidth=1.6 if strong else 0.8,
                     markersize=6 if strong else 4, alpha=1.0 if strong else 0.75,
                     label=None if name in seen else name)
        seen.add(name)
        if strong:
            for row in line:
                panel.annotate(f"{row['segments']}", (row[clock], row["error"]), fontsize=7,
                               xytext=(4, 4), textcoords="offset points", color=colour)
    floor = done[0]["references differ by"]
    if floor:
        panel.axhline(floor, color="grey", linestyle=":", linewidth=1,
                      label="distance of the two references")
    panel.set(xlabel=f"{clock.removesuffix(' (s)')} time on one core (s)", ylabel=motion.error)
    panel.set_title(f"{motion.title}\nnumbers: segments; thin lines: other steps and tolerances",
                    fontsize=9)
    measure.legend_below(panel)
    picture.supxlabel(conditions, fontsize=6, color="grey")
    measure.save(picture, path)


# ---------------------------------------------------------------- all of it

def publish(options, facts, motions, rows, clock, pictures):
    """The table of RESULTS.md."""
    lines, median, before = summary(motions, rows, clock)
    kind = "Trial (short windows, coarse references). " if options.quick else ""
    introduction = (
        f"{kind}How many times longer other methods take on one core than `leapfrog` for the same error "
        "(against the reference named; of tension and twist moment along the string, or of the tip "
        "of the cantilever). dormand-prince runs with the paper's tolerances (1e-7, 1e-5); the "
        "number is the median of its best runs. *Old segment* is the leapfrog of the release before the "
        "rod of fourth order. ARKODE (SUNDIALS 6.4.1, diagonally implicit "
        "Runge-Kutta) runs with several tolerances; the number is the median of its best runs. "
        f"Median over the motions of dormand-prince over leapfrog: {as_text(median)}; of the old "
        f"segment over the new, in the motions that bend: {as_text(before, 'not measured')}. "
        f"Times: {clock.removesuffix(' (s)')} time.")
    links = ", ".join(f"[{motion.title}]({measure.link(pictures[motion.key])})"
                      for motion in motions)
    measure.publish("work-precision", facts, introduction, measure.markdown(lines),
                    f"Pictures, time against error: {links}.")


def has_arkode(build):
    """Whether the program was built with SUNDIALS."""
    program = measure.executable(build, PROGRAM)
    done = subprocess.run(["ldd", str(program)], capture_output=True, text=True, check=True)
    return "sundials_arkode" in done.stdout


def read_rows(path):
    """Facts and rows of an earlier run's CSV file, as they were written."""
    def value(text):
        for kind in (int, float):
            try:
                return kind(text)
            except ValueError:
                continue
        return {"True": True, "False": False}.get(text, text)

    with open(path, encoding="utf-8", newline="") as file:
        lines = file.read().splitlines()
    facts = [tuple(line[2:].split(": ", 1)) for line in lines if line.startswith("# ")]
    table = csv.DictReader(line for line in lines if not line.startswith("# "))
    return facts, [{name: value(text) for name, text in row.items()} for row in table]


def publish_again(options, folder):
    """The table of RESULTS.md from the CSV file of an earlier run."""
    facts, rows = read_rows(folder / f"{options.stem}.csv")
    measured = {row["motion"] for row in rows}
    motions = [motion for motion in MOTIONS if motion.key in measured]
    clock = dict(facts)["method"].rsplit(": ", 1)[1]
    pictures = {key: folder / f"{options.stem}_{key}.png" for key in measured}
    publish(options, facts, motions, rows, clock, pictures)


def rows_of_other_motions(options, folder, motions, facts):
    """What the last run of the same program measured of motions that this one leaves out."""
    path = folder / f"{options.stem}.csv"
    if not path.exists():
        return []
    old, rows = read_rows(path)
    if dict(old)["program"] != dict(facts)["program"]:
        return []
    return [row for row in rows if row["motion"] not in [motion.key for motion in motions]]


def choose_clock():
    """Wall time on a machine that does nothing else; processor time where others work."""
    return "wall (s)" if os.getloadavg()[0] < measure.IDLE else "processor (s)"


def main():
    """Measures, writes CSV and pictures and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--quick", action="store_true",
                        help="a trial: short windows, two meshes, coarser references, one round")
    parser.add_argument("--rounds", type=int, help="turns of all variants (default: 3, quick 1)")
    parser.add_argument("--motion", action="append", choices=[motion.key for motion in MOTIONS],
                        help="only this motion (may be repeated); the others keep what the last run of the "
                             "same program measured")
    parser.add_argument("--without-arkode", action="store_true", help="leave ARKODE out")
    parser.add_argument("--before", type=Path, metavar="DIR",
                        help="build directory of the release with the segment of second order, "
                             "which then is measured too (see bench/README.md)")
    parser.add_argument("--limit", type=float, default=600, help="longest run (s)")
    parser.add_argument("--from-csv", action="store_true",
                        help="run nothing: write the table of RESULTS.md from the last CSV file")
    options = parser.parse_args()
    options.stem = "work_precision_trial" if options.quick else "work_precision"
    folder = measure.results_folder(options.machine)
    if options.from_csv:
        publish_again(options, folder)
        return
    options.rounds = options.rounds or (1 if options.quick else 3)
    options.arkode = has_arkode(options.build) and not options.without_arkode
    os.nice(5)

    clock = choose_clock()
    facts = measure.provenance(options.build)
    facts.append(("method", f"median of {options.rounds} rounds, variants in turn, one thread, "
                            f"advancing alone; times compared: {clock}"))
    facts.append(("windows", "trial: short" if options.quick else "full"))
    if not options.arkode:
        facts.append(("left out", "ARKODE: not asked for, or without libsundials-dev in this build"))
    motions = [m for m in MOTIONS if not options.motion or m.key in options.motion]
    conditions = "; ".join(value for key, value in facts if key in ("machine", "compiler", "program",
                                                                    "windows"))
    rows = rows_of_other_motions(options, folder, motions, facts)
    pictures = {}
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options, scratch)
        for motion in motions:
            own = study(bench, motion)
            rows += own
            pictures[motion.key] = folder / f"{options.stem}_{motion.key}.png"
            draw(motion, own, clock, pictures[motion.key], conditions)
            measure.write_csv(folder / f"{options.stem}.csv", list(facts), rows)
    measure.write_csv(folder / f"{options.stem}.csv", facts, rows)
    motions = [motion for motion in MOTIONS if motion.key in {row["motion"] for row in rows}]
    lines, median, before = summary(motions, rows, clock)
    print(measure.markdown(lines))
    print(f"\nmedian over the motions, dormand-prince over leapfrog: {as_text(median)}; of those "
          f"that bend, old segment over new: {as_text(before, 'not measured')}")
    if options.publish:
        publish_again(options, folder)


if __name__ == "__main__":
    main()

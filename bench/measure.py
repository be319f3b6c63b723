"""What the benchmark scripts share: finding the program, running cases, writing tables.

Numbers are worth nothing without the machine, the compiler and the commit they were measured with:
every table carries them.
"""

import csv
import os
import re
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parent.parent
# The page of all measured tables.
PAGE = ROOT / "bench" / "RESULTS.md"

# Loads of a machine that does nothing else, before a measurement and after one on two threads.
IDLE, BUSY = 0.5, 2.5

# Okabe and Ito: told apart with every common kind of colour blindness.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9")


def add_options(parser):
    """Options that all scripts have."""
    parser.add_argument("--build", type=Path, default=ROOT / "build",
                        help="build directory with the programs to measure (default: build)")
    parser.add_argument("--machine", default=machine_name(),
                        help="folder of bench/results to write (default: %(default)s)")
    parser.add_argument("--publish", action="store_true",
                        help="also write the table into bench/RESULTS.md")


def machine_name():
    """Processor and number of cores, fit for the name of a folder."""
    text = f"{processor()}-{os.cpu_count()}-cores".lower()
    return re.sub(r"[^a-z0-9]+", "-", text).strip("-")


def processor():
    """Model of the processor, with family and model number: cloud machines hide its name."""
    info = Path("/proc/cpuinfo").read_text(encoding="utf-8")

    def field(name):
        match = re.search(rf"^{name}\s*:\s*(.*)$", info, re.MULTILINE)
        return match.group(1) if match else "?"

    return f"{field('model name')} family {field('cpu family')} model {field('model')}"


def executable(build, name):
    """A program of the build directory; ends with a clear message where there is none."""
    path = build / name
    if not path.exists():
        sys.exit(f"{path} is missing: build it with cmake --preset release && "
                 f"cmake --build --preset release, or name a build directory with --build")
    return path


def compiler(build):
    """The compiler of a build directory and its flags."""
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")

    def value(key):
        match = re.search(rf"^{key}:\w+=(.*)$", cache, re.MULTILINE)
        return match.group(1) if match else ""

    version = subprocess.run([value("CMAKE_CXX_COMPILER"), "--version"], check=True,
                             capture_output=True, text=True).stdout.splitlines()[0]
    kind = value("CMAKE_BUILD_TYPE")
    return f"{version}, {kind} {value(f'CMAKE_CXX_FLAGS_{kind.upper()}')}".strip()


def provenance(build):
    """Machine, compiler, program and load of a measurement, as (name, value) pairs."""
    program = executable(build, "drillstrand")
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True)
    return [("machine", f"{processor()}, {os.cpu_count()} cores"),
            ("compiler", compiler(build)),
            ("program", version.stdout.strip()),
            ("load before", load())]


def load():
    """Processes that ran or waited in the last minute, on average."""
    return f"{os.getloadavg()[0]:.1f}"


def set_options(settings):
    """Case keys and their values as options of the program."""
    options = []
    for key, value in settings.items():
        text = str(value).lower() if isinstance(value, bool) else str(value)
        options += ["--set", f"{key}={text}"]
    return options


def run_case(build, case, settings, threads=1, output=None):
    """Runs a case; returns root attributes, series (a dict of arrays) and processor time (s).

    `settings` maps case keys to values. Keeps the result file where `output` names one.
    """
    command = [str(executable(build, "drillstrand")), "run", str(ROOT / "cases" / case), "--quiet",
               "--threads", str(threads), *set_options(settings)]
    with tempfile.TemporaryDirectory() as scratch:
        result = Path(output or Path(scratch) / "result.h5")
        before = os.times()
        done = subprocess.run(command + ["--overwrite", "-o", str(result)], capture_output=True,
                              text=True, check=False)
        after = os.times()
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{done.stderr}")
        with h5py.File(result) as file:
            attributes = dict(file.attrs)
            series = {name: data[:] for name, data in file["series"].items()}
    seconds = (after.children_user - before.children_user
               + after.children_system - before.children_system)
    return attributes, series, seconds


def results_folder(machine):
    """Folder of a machine's results, made where it is missing."""
    folder = ROOT / "bench" / "results" / machine
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def write_csv(path, facts, rows):
    """A table with its facts as comments; adds the load that the measurement ends with. `rows` are
    dicts with the same keys."""
    if "load after" not in dict(facts):
        facts.append(("load after", load()))
    with open(path, "w", encoding="utf-8", newline="") as file:
        for name, value in facts:
            file.write(f"# {name}: {value}\n")
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"wrote {path}", file=sys.stderr)


def markdown(rows):
    """A table for RESULTS.md; `rows` are dicts of text with the same keys."""
    names = list(rows[0])
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    lines += ["| " + " | ".join(row[name] for name in names) + " |" for row in rows]
    return "\n".join(lines)


def link(path, page=PAGE):
    """A file of the project as a link on a page names it."""
    return path.resolve().relative_to(page.parent).as_posix()


def wrapped(text):
    """A paragraph of a page. A line ends at no hyphen, or the page would show a space after it."""
    return textwrap.fill(text, 120, break_on_hyphens=False)


def publish(name, facts, introduction, *tables, picture=None, page=PAGE):
    """Replaces the section of a page between the markers of a table. Says so where the machine was
    busy with something else."""
    begin, end = f"<!-- BEGIN table:{name} -->", f"<!-- END table:{name} -->"
    old = page.read_text(encoding="utf-8")
    if begin not in old or end not in old:
        sys.exit(f"{page} has no {begin} ... {end}")
    source = "; ".join(value for key, value in facts if key in ("machine", "compiler", "program"))
    parts = [wrapped(introduction), *tables]
    if picture:
        parts.append(f"![{name}]({link(picture, page)})")
    before, after = (dict(facts).get(key, load()) for key in ("load before", "load after"))
    remark = ("" if float(before) < IDLE and float(after) < BUSY else
              f" Other work ran at the same time (load {before} before, {after} after): wall times "
              "and all times of several threads are too long; processor times of one thread hold.")
    parts.append(wrapped(f"Measured on {source}.{remark}"))
    new = "\n".join([begin, "\n\n".join(parts), end])
    head, rest = old.split(begin)
    page.write_text(head + new + rest.split(end, 1)[1], encoding="utf-8")
    print(f"filled table {name} of {page}", file=sys.stderr)


def figure(width, height, **options):
    """A new matplotlib figure with subplots that needs no screen."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plot
    plot.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3,
                          "axes.spines.top": False, "axes.spines.right": False})
    return plot.subplots(figsize=(width, height), layout="constrained", **options)


def legend_below(panel):
    """The legend of a panel, where it hides no data."""
    panel.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2,
                 frameon=False)


def save(picture, path):
    """Writes a figure."""
    picture.savefig(path, dpi=150)
    print(f"wrote {path}", file=sys.stderr)

#!/usr/bin/python3
"""What a step of the leapfrog costs: against the length of the string, per feature of the scene, on
one and two threads, as a share of the processor's peak and of its memory's bandwidth.

Operations and memory traffic are counted, not estimated: one step runs instruction by instruction,
and each instruction is looked up in the program's disassembly. bench/README.md says more.
"""

import argparse
import collections
import csv
import io
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import measure

PROGRAM = "bench/bench_scaling"
SPACING = 7.0  # m, of nodes on every mesh: longer strings, not finer ones
HOLE, PIPE, JOINT = 0.2159, 0.127, 0.1905  # m
MESHES = (50, 100, 200, 322, 1000, 4000, 10000, 16000)
HEADLINE = 322  # segments: the paper's Well 2
LONG = 4000


# ---------------------------------------------------------------- scenes

def component(length, outer):
    """A stretch of pipe."""
    return ("[[string.component]]\n"
            f'name = "pipe"\nlength = {length}\nouter_diameter = {outer}\n'
            'inner_diameter = 0.1086\nlinear_density = 31\nyoungs_modulus = "206 GPa"\n'
            "poisson_ratio = 0.3\n")


def joints(segments):
    """Every second node on a joint wide enough to keep its neighbours off the wall."""
    parts = [(0.5 * SPACING, PIPE)]
    parts += [(SPACING, JOINT if k % 2 else PIPE) for k in range(1, segments)]
    parts.append((0.5 * SPACING, PIPE))
    return parts


def scene(segments, folder, *, well=False, lying=False, fluid=False, drag=True, touching=1.0,
          damping="", curvature="", gravity=None, rotation="", friction=(0.3, 0.25)):
    """Text of a case; a table that a feature does not need is not there.

    A string on the axis of a level well touches nothing for as long as it has next to no weight;
    one that lies in it touches everywhere, or at every second node.
    """
    text = [f"gravity = {gravity if gravity is not None else (9.81 if lying else 1e-9)}"]
    length = SPACING * segments
    if well:
        survey = folder / "level.csv"
        survey.write_text("md[m],inclination[deg],azimuth[deg]\n0,90,0\n"
                          f"{2 * SPACING * MESHES[-1]},90,0\n", encoding="utf-8")
        text += ["[well]", f'survey = "{survey}"', f"diameter = {HOLE}"]
        text += ["[contact]", "normal_stiffness = 1e7", "normal_damping = 1e5",
                 f"static_friction = {friction[0]}", f"dynamic_friction = {friction[1]}"]
    if fluid:
        text += ["[fluid]", "density = 1200", 'viscosity = "20 cP"', f"drag = {str(drag).lower()}"]
    text.append("[string]")
    parts = joints(segments) if touching < 1.0 else [(length, PIPE)]
    if len(parts) > 1:
        table = folder / f"joints_{segments}.csv"
        table.write_text(
            "name,length,outer_diameter,inner_diameter,linear_density,youngs_modulus,poisson_ratio\n"
            + "".join(f"pipe,{part},{outer},0.1086,31,206e9,0.3\n" for part, outer in parts),
            encoding="utf-8")
        text.append(f'components = "{table}"')
    else:
        text.append(component(length, PIPE) + (f"curvature = {curvature}\n" if curvature else ""))
    text += ["[mesh]", f"segments = {segments}"]
    if rotation or lying:
        text += ["[head]", f"rotation = {rotation or '[[0, 0], [1, 6.0]]'}"]
    if not well:
        text += ["[head]"] if not (rotation or lying) else []
        text += ["direction = [1, 0, 0]"]
    if damping:
        text += ["[damping]", damping]
    text.append("[initial]")
    if lying:
        widest = JOINT if touching < 1.0 else PIPE
        text.append(f"offset = [0, 0, {0.5 * (HOLE - widest) + 1e-5}]")
    if curvature and not well:
        text.append('state = "stress-free"')
    text += ["[run]", "duration = 1", 'integrator = "leapfrog"']
    return "\n".join(text) + "\n"


DAMPED = "internal = 1e-2"
SETS = {
    "no well": {},
    "no well, damped": {"damping": DAMPED},
    "no well, Kelvin-Voigt": {"damping": "kelvin_voigt = 1e-5"},
    "no well, curved": {"curvature": "[0, 1e-4, 0]"},
    "well, open hole": {"well": True},
    "well, lying": {"well": True, "lying": True},
    "well and fluid, open hole": {"well": True, "fluid": True},
    "well and fluid, lying": {"well": True, "fluid": True, "lying": True},
    "well and fluid, every second node lying": {"well": True, "fluid": True, "lying": True,
                                                "touching": 0.5, "gravity": 2.0},
    "well and fluid, every second node lying, damped": {
        "well": True, "fluid": True, "lying": True, "touching": 0.5, "gravity": 2.0,
        "damping": DAMPED},
    "well and fluid, lying, damped, curved": {"well": True, "fluid": True, "lying": True,
                                              "damping": DAMPED, "curvature": "[0, 1e-4, 0]"},
}

# (feature, scene with it, scene with it switched off in the case file, scene that never had it)
FEATURES = [
    ("damping (D_in)", {"damping": DAMPED},
     {"damping": "internal = 0\nexternal = 0\nkelvin_voigt = 0"}, {}),
    ("Kelvin-Voigt", {"damping": "kelvin_voigt = 1e-5"}, {"damping": "kelvin_voigt = 0"}, {}),
    ("stress-free curvature", {"curvature": "[0, 1e-4, 0]"}, {"curvature": "[0, 0, 0]"}, {}),
    ("rotation", {"rotation": "[[0, 0], [1, 6.0]]"}, {"rotation": "0"}, {}),
    ("contact and friction, in the open hole", {"well": True}, None, {}),
    ("contact and friction, lying", {"well": True, "lying": True}, None, {"lying": True,
                                                                          "gravity": 1e-9}),
    ("drag, in the open hole", {"well": True, "fluid": True},
     {"well": True, "fluid": True, "drag": False}, {"well": True}),
    ("drag, lying", {"well": True, "fluid": True, "lying": True},
     {"well": True, "fluid": True, "drag": False, "lying": True}, {"well": True, "lying": True}),
    ("drag, every second node lying",
     {"well": True, "fluid": True, "lying": True, "touching": 0.5, "gravity": 2.0},
     {"well": True, "fluid": True, "drag": False, "lying": True, "touching": 0.5, "gravity": 2.0},
     {"well": True, "lying": True, "touching": 0.5, "gravity": 2.0}),
    ("friction, lying", {"well": True, "lying": True},
     {"well": True, "lying": True, "friction": (0.0, 0.0)}, None),
]


def write_case(folder, name, segments, settings):
    """A case file; returns its path."""
    path = folder / f"{re.sub(r'[^a-z0-9]+', '_', name.lower())}_{segments}.toml"
    path.write_text(scene(segments, folder, **settings), encoding="utf-8")
    return path


# ---------------------------------------------------------------- the C++ program

def table_of(command):
    """Rows of a program's CSV output, as dicts."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return list(csv.DictReader(io.StringIO(done.stdout)))


def time_cases(options, paths, threads):
    """{(path, threads): row}: steps of all cases, in turn."""
    command = [options.program, "steps", *paths, "--threads", ",".join(map(str, threads)),
               "--rounds", options.rounds, "--seconds", options.seconds]
    return {(Path(row["case"]), int(row["threads"])): row for row in table_of(command)}


class Machine:
    """Peak and bandwidth of this machine."""

    def __init__(self, options, threads):
        sizes = [2 ** i for i in range(5, 19)]
        rows = table_of([options.program, "machine", "--threads", ",".join(map(str, threads)),
                         "--kilobytes", ",".join(map(str, sizes))])
        self.peak = {int(row["threads"]): float(row["value"]) for row in rows
                     if row["what"].startswith("peak")}
        self.speed = {(int(row["threads"]), float(row["kilobytes"])): float(row["value"])
                      for row in rows if row["what"].startswith("bandwidth")}

    def bandwidth(self, threads, size):
        """GB/s over `size` bytes of memory, by powers between the sizes that were measured."""
        points = sorted((kilobytes, speed) for (count, kilobytes), speed in self.speed.items()
                        if count == threads)
        wanted = size / 1024
        if wanted <= points[0][0]:
            return points[0][1]
        for (k0, s0), (k1, s1) in zip(points, points[1:]):
            if wanted <= k1:
                part = math.log(wanted / k0) / math.log(k1 / k0)
                return s0 * (s1 / s0) ** part
        return points[-1][1]


# ---------------------------------------------------------------- counting

ARITHMETIC = re.compile(r"v?(?:(?P<fused>fn?m(?:add|sub|addsub|subadd)(?:132|213|231)?)"
                        r"|add|sub|mul|div|sqrt)(?P<kind>[ps])d$")
OPERAND = re.compile(r"(?P<offset>-?0x[0-9a-f]+)?"
                     r"\((?P<base>%\w+)?(?:,(?P<index>%\w+)(?:,(?P<scale>\d))?)?\)")
REGISTERS = ("rax", "rbx", "rcx", "rdx", "rsi", "rdi", "rbp", "rsp", "r8", "r9", "r10", "r11",
             "r12", "r13", "r14", "r15")
LINE = 64  # bytes
STACK = 1 << 16  # bytes above the stack pointer that count as stack: never out of the first cache


def lanes(operands, kind):
    """Numbers that a floating-point instruction works on."""
    if kind == "s":
        return 1
    return 8 if "%zmm" in operands else 4 if "%ymm" in operands else 2


def operations(mnemonic, operands):
    """Floating-point operations in double precision: FMA counts two; comparing, moving, selecting
    and converting none."""
    match = ARITHMETIC.fullmatch(mnemonic)
    if not match:
        return 0
    return lanes(operands, match["kind"]) * (2 if match["fused"] else 1)


def width(mnemonic, operands):
    """Bytes that a memory operand spans."""
    if "{1to" in operands:
        return 8
    if mnemonic.endswith("sd"):
        return 8
    return 64 if "%zmm" in operands else 32 if "%ymm" in operands else 16 if "%xmm" in operands else 8


class Disassembly:
    """What each address of a program does."""

    def __init__(self, program):
        text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(program)], check=True,
                              capture_output=True, text=True).stdout
        self.instructions = {}
        for line in text.splitlines():
            match = re.match(r"\s+([0-9a-f]+):\s+(\S+)\s*([^#<]*)", line)
            if match:
                self.instructions[int(match[1], 16)] = (match[2], match[3].strip())

    def at(self, address):
        """(mnemonic, operands); those of other libraries are unknown."""
        return self.instructions.get(address, ("", ""))


def memory_operand(operands, registers, address):
    """(first byte, whether it is the last operand) of an instruction's memory operand, or None."""
    match = OPERAND.search(operands)
    if not match:
        return None
    base = (match["base"] or "").lstrip("%")
    index = (match["index"] or "").lstrip("%")
    if base == "rip":
        return None  # constants: a few lines in all
    if (base and base not in registers) or (index and index not in registers):
        return None  # gathers; 32-bit registers do not address memory
    first = int(match["offset"] or "0", 16) + registers.get(base, 0)
    if index:
        first += registers[index] * int(match["scale"] or 1)
    return first % (1 << 64), not operands[match.end():].strip("{}k0123456789% ")


Count = collections.namedtuple("Count", "flops loaded stored contact")


def count_step(program, disassembly, case):
    """Operations of one step per node, and the bytes of the cache lines that it only reads and that
    it writes, per node."""
    done = subprocess.run([str(program), "trace", str(case)], capture_output=True, text=True,
                          check=True)
    lines = done.stdout.splitlines()
    segments, contact, _ = lines[0][2:].split()
    nodes = int(segments) + 1
    flops = 0
    read, written = set(), set()
    for line in lines[1:]:
        numbers = [int(part, 16) for part in line.split()]
        mnemonic, operands = disassembly.at(numbers[0])
        if not mnemonic:
            continue
        flops += operations(mnemonic, operands)
        if "(" not in operands or mnemonic.startswith(("lea", "nop", "prefetch")):
            continue
        registers = dict(zip(REGISTERS, numbers[1:]))
        place = memory_operand(operands, registers, numbers[0])
        if place is None or 0 <= place[0] + 1024 - registers["rsp"] < STACK:
            continue
        first, last_operand = place
        touched = range(first // LINE, (first + width(mnemonic, operands) - 1) // LINE + 1)
        (written if last_operand and "mov" in mnemonic else read).update(touched)
    read -= written
    return Count(flops / nodes, LINE * len(read) / nodes, LINE * len(written) / nodes, int(contact))


# ---------------------------------------------------------------- results

def scaling_rows(options, folder, machine, threads):
    """One row per feature set, mesh and number of threads."""
    disassembly = Disassembly(options.program)
    cases = {(name, n): write_case(folder, name, n, settings)
             for name, settings in SETS.items() for n in options.meshes}
    counts = {}
    for name in SETS:
        counts[name] = count_step(options.program, disassembly, cases[name, HEADLINE])
        print(f"{name}: {counts[name].flops:.0f} operations, "
              f"{counts[name].loaded + 2 * counts[name].stored:.0f} bytes per node",
              file=sys.stderr)
    timings = time_cases(options, list(cases.values()), threads)
    rows = []
    for (name, n), path in cases.items():
        count = counts[name]
        one = None
        for number in threads:
            timing = timings[path, number]
            step = float(timing["step median (us)"])
            one = one or step
            per_node = 1e3 * step / (n + 1)  # ns
            traffic = count.loaded + 2 * count.stored  # written lines come in, and go out again
            footprint = (count.loaded + count.stored) * (n + 1)
            bandwidth = machine.bandwidth(number, footprint)
            rows.append({
                "features": name, "segments": n, "threads": number,
                "nodes in contact": timing["nodes in contact"],
                "step (us)": f"{step:.4g}",
                "least step (us)": f"{float(timing['step least (us)']):.4g}",
                "ns per node and step": f"{per_node:.3f}", "speed-up": f"{one / step:.3f}",
                "operations per node": f"{count.flops:.1f}",
                "Gflop/s": f"{count.flops / per_node:.2f}",
                "share of peak": f"{count.flops / per_node / machine.peak[number]:.4f}",
                "bytes per node": f"{traffic:.0f}", "footprint (kB)": f"{footprint / 1024:.0f}",
                "GB/s": f"{traffic / per_node:.1f}", "GB/s of a triad": f"{bandwidth:.1f}",
                "share of bandwidth": f"{traffic / per_node / bandwidth:.3f}"})
    return rows


def feature_rows(options, folder):
    """One row per feature: with it, switched off, never there."""
    cases = {}
    for number, (name, with_it, off, never) in enumerate(FEATURES):
        for kind, settings in (("with", with_it), ("off", off), ("never", never)):
            if settings is not None:
                cases[name, kind] = write_case(folder, f"feature {number} {kind}", HEADLINE,
                                               settings)
    timings = time_cases(options, list(cases.values()), (1,))

    def per_node(name, kind):
        if (name, kind) not in cases:
            return None
        row = timings[cases[name, kind], 1]
        return 1e3 * float(row["step median (us)"]) / (HEADLINE + 1)

    def difference(a, b):
        return "" if a is None or b is None else f"{a - b:+.2f}"

    rows = []
    for name, *_ in FEATURES:
        on, off, never = (per_node(name, kind) for kind in ("with", "off", "never"))
        base = never if never is not None else off
        rows.append({
            "feature": name,
            "with it (ns)": f"{on:.2f}",
            "switched off (ns)": "" if off is None else f"{off:.2f}",
            "never there (ns)": "" if never is None else f"{never:.2f}",
            "price (ns)": difference(on, base),
            "off over never": "" if off is None or never is None else f"{off / never:.3f}"})
    return rows


def draw(rows, machine, threads, path):
    """Time per node, gain of the second thread, shares of peak and bandwidth against N."""
    picture, panels = measure.figure(12, 5.4, ncols=3)
    chosen = {"no well": (measure.BLUE, "o"), "no well, damped": (measure.SKY, "s"),
              "well, lying": (measure.GREEN, "^"),
              "well and fluid, open hole": (measure.ORANGE, "D"),
              "well and fluid, every second node lying": (measure.RED, "v"),
              "well and fluid, lying, damped, curved": (measure.PURPLE, "P")}

    def line(name, number, key):
        own = [row for row in rows if row["features"] == name and row["threads"] == number]
        return [row["segments"] for row in own], [float(row[key]) for row in own]

    left, middle, right = panels
    for name, (colour, marker) in chosen.items():
        left.loglog(*line(name, 1, "ns per node and step"), color=colour, marker=marker,
                    label=name)
        if len(threads) > 1:
            middle.semilogx(*line(name, threads[-1], "speed-up"), color=colour, marker=marker)
        right.semilogx(*line(name, 1, "share of peak"), color=colour, marker=marker)
        right.semilogx(*line(name, 1, "share of bandwidth"), color=colour, marker=marker,
                       linestyle=":", fillstyle="none")
    left.set(xlabel="segments", ylabel="time per node and step (ns)", title="One thread")
    middle.set(xlabel="segments", ylabel=f"{threads[-1]} threads, times faster than one",
               title="Threads")
    right.set(xlabel="segments", ylabel="share", ylim=(0, None),
              title=f"Solid: of {machine.peak[1]:.0f} Gflop/s; dotted: of bandwidth")
    picture.get_layout_engine().set(rect=(0, 0.11, 1, 0.89))
    legend = picture.legend(*left.get_legend_handles_labels(), fontsize=8, loc="lower center",
                            ncols=3, frameon=False)
    legend.set_in_layout(False)
    measure.save(picture, path)


def publish(options, facts, rows, features, machine, threads, picture):
    """Two tables: sets of features, and the price of each."""
    def find(name, n, number):
        return next(row for row in rows if row["features"] == name and row["segments"] == n
                    and row["threads"] == number)

    lines = []
    longest = options.meshes[-1]
    for name in SETS:
        head = find(name, HEADLINE, 1)
        entry = {"scene": name,
                 f"N = {HEADLINE} (ns)": head["ns per node and step"],
                 f"N = {LONG} (ns)": find(name, LONG, 1)["ns per node and step"],
                 f"N = {longest} (ns)": find(name, longest, 1)["ns per node and step"]}
        for n in (HEADLINE, LONG):
            entry[f"{threads[-1]} threads, N = {n}"] = f"{find(name, n, threads[-1])['speed-up']}x"
        entry["operations"] = head["operations per node"]
        entry["of peak"] = f"{100 * float(head['share of peak']):.0f} %"
        entry[f"of bandwidth, N = {longest}"] = (
            f"{100 * float(find(name, longest, 1)['share of bandwidth']):.0f} %")
        lines.append(entry)
    trial = "Trial. " if options.quick else ""
    introduction = (
        f"{trial}Time of a step of `leapfrog` per node, on one thread and as the gain of the second; "
        "floating-point operations that it executes per node (counted instruction by instruction; "
        f"a fused multiply-add counts two), and their share of the measured peak, "
        f"{machine.peak[1]:.0f} Gflop/s a core. Below: what each feature adds at N = {HEADLINE}, "
        "and what it costs when the case file names it but switches it off.")
    measure.publish("scaling", facts, introduction, measure.markdown(lines),
                    measure.markdown(features), picture=picture)


def main():
    """Measures, writes CSV and picture and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    measure.add_options(parser)
    parser.add_argument("--quick", action="store_true", help="a trial: three meshes, few rounds")
    parser.add_argument("--rounds", type=int, help="measurements of each (default: 25, quick 5)")
    parser.add_argument("--seconds", type=float, default=0.01, help="of one measurement")
    options = parser.parse_args()
    options.program = measure.executable(options.build, PROGRAM)
    options.rounds = options.rounds or (5 if options.quick else 25)
    options.meshes = (50, HEADLINE, LONG) if options.quick else MESHES
    threads = (1, 2) if os.cpu_count() > 1 else (1,)

    facts = measure.provenance(options.build)
    machine = Machine(options, threads)
    facts.append(("peak", "; ".join(f"{value:.1f} Gflop/s with {number} threads"
                                    for number, value in machine.peak.items())))
    facts.append(("method", f"median of {options.rounds} measurements of {options.seconds} s each, "
                            "all in turn in random order; processor time of one thread, "
                            "wall time of several; operations and bytes counted "
                            f"in one step at N = {HEADLINE}"))
    folder = measure.results_folder(options.machine)
    stem = "scaling_trial" if options.quick else "scaling"
    with tempfile.TemporaryDirectory() as scratch:
        rows = scaling_rows(options, Path(scratch), machine, threads)
        features = feature_rows(options, Path(scratch))
    measure.write_csv(folder / f"{stem}.csv", facts, rows)
    measure.write_csv(folder / f"{stem}_features.csv", facts, features)
    measure.write_csv(folder / f"{stem}_bandwidth.csv", facts,
                      [{"threads": number, "kilobytes": size, "GB/s": speed}
                       for (number, size), speed in machine.speed.items()])
    draw(rows, machine, threads, folder / f"{stem}.png")
    keys = ("features", "segments", "threads", "ns per node and step", "speed-up",
            "operations per node", "share of peak", "share of bandwidth")
    print(measure.markdown([{key: str(row[key]) for key in keys} for row in rows]))
    print(measure.markdown(features))
    if options.publish:
        publish(options, facts, rows, features, machine, threads, folder / f"{stem}.png")


if __name__ == "__main__":
    main()

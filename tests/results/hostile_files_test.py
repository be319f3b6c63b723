#!/usr/bin/python3
"""Files that were made to break whoever reads them, before every command that does: exit code 0 or
2, one line of error, no control characters, nothing of another file.

usage: hostile_files_test.py PROGRAM SOURCE_FOLDER [TEST]...
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor

import hostile_files

FILE = "hostile.h5"
ABOVE = ".."  # the folder that holds the cases of all trials
COMMANDS = {
    "info": ["info", FILE],
    "report": ["report", FILE, "-o", "page.html", "--overwrite"],
    "csv": ["export", FILE, "--csv", "-o", "tables", "--overwrite"],
    "vtk": ["export", FILE, "--vtk", "-o", "lines", "--overwrite"],
    "restart": ["run", f"{ABOVE}/well1.toml", "-o", "new.h5", "--restart", FILE],
    # the last one: it may write over the file where that is drillstrand's own
    "replace": ["buckling", f"{ABOVE}/buckling_heavy.toml", "--set", "mesh.segments=9", "-o", FILE,
                "--overwrite"],
}
SHOW = ["info", "report", "csv", "vtk"]
MOST_MEMORY = 1 << 20  # kB
HANGS_AFTER = 120  # s; what a busy machine takes for one of them is far less
CUTS, FLIPS = 12, 24

# Where HDF5's library itself crashes, loops or asks for all memory, which the reading process keeps
# to itself; everything else is refused by drillstrand's own checks.
LIBRARY_FAILS = re.compile("HDF5's library fails|takes longer than|takes more memory than")
MAY_BREAK_THE_LIBRARY = {
    "chunk_that_inflates_to_a_gigabyte", "chunk_that_inflates_to_four_gigabytes",
    "huge_nodes_of_groups", "no_nodes_of_groups", "trees_that_point_at_themselves",
    "trees_of_level_255", "trees_of_65535_entries", "tables_of_65535_names", "heaps_of_all_memory",
    "heaps_of_4_gigabytes", "heaps_with_a_wrong_list", "texts_of_all_memory",
    "texts_of_4_gigabytes", "texts_longer_than_their_heap", "zeros_that_fill_the_memory",
}
# Where it reads beyond a buffer of its own, of which only the address sanitizer makes a crash.
BREAKS_THE_SANITIZED_LIBRARY = {"chunk_too_short"}


class Ending:
    """One command on one file."""

    def __init__(self, program, folder, command, path):
        words = [path if word == FILE else word for word in COMMANDS[command]]
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=err)
            alarm = threading.Timer(HANGS_AFTER, process.kill)
            alarm.start()
            _, status, usage = os.wait4(process.pid, 0)
            alarm.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            self.code = process.returncode
            self.memory = usage.ru_maxrss
            self.seconds = usage.ru_utime + usage.ru_stime
            self.out, self.err = (stream.seek(0) or stream.read() for stream in (out, err))

    def problems(self):
        found = []
        if self.code not in (0, 2):
            found.append(f"exit code {self.code}")
        if self.code == 2 and (self.err.count(b"\n") != 1 or self.out):
            found.append("more than one line of error")
        if self.memory > MOST_MEMORY:
            found.append(f"{self.memory} kB of memory")
        for stream in (self.out, self.err):
            text = stream.decode("utf-8", "surrogateescape")
            if re.search("[\0-\x09\x0b-\x1f\x7f-\x9f\u202e\ud800-\udfff]", text):
                found.append("control characters")
            if "root:" in text or "Sanitizer" in text or "runtime error" in text:
                found.append("text of others")
        return [f"{problem}: {self.err[:400]}" for problem in found]


class HostileFiles(unittest.TestCase):
    """Sets program and source before the tests start."""
    program: pathlib.Path
    source: pathlib.Path

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        shutil.copytree(cls.source / "cases" / "data", cls.folder / "data")
        for case in ["well1.toml", "buckling_heavy.toml"]:
            shutil.copy(cls.source / "cases" / case, cls.folder)
        settings = ["--set", "mesh.segments=18"]
        cls.make("run", "well1.toml", "-o", "sound.h5", "--quiet", *settings,
                 "--set", "run.duration=0.1", "--set", "output.profile_interval=0.05",
                 "--set", "output.interval=0.01", "--set", "output.checkpoint_interval=1e-9")
        cls.make("equilibrium", "well1.toml", "-o", "rest.h5", *settings)
        cls.make("buckling", "buckling_heavy.toml", "-o", "modes.h5", *settings)
        cls.make("torque-drag", "well1.toml", "-o", "drag.h5", *settings)

    @classmethod
    def make(cls, *words):
        ending = subprocess.run([cls.program, *words], cwd=cls.folder, capture_output=True, text=True)
        assert ending.returncode == 0, ending.stderr

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def try_all(self, makers):
        """Makes each file in a folder of its own and gives it to each command."""
        def endings_of(item):
            name, make = item
            with tempfile.TemporaryDirectory(dir=self.folder) as place:
                place = pathlib.Path(place)
                os.mkfifo(place / "pipe")
                shutil.copy(self.folder / "sound.h5", place)
                path = place / FILE
                make(path)
                return name, {command: Ending(self.program, place, command, FILE)
                              for command in COMMANDS}, self.leaked(place)
        with ThreadPoolExecutor(2) as pool:
            results = list(pool.map(endings_of, makers.items()))
        for name, endings, leaked in results:
            for command, ending in endings.items():
                with self.subTest(file=name, command=command):
                    self.assertEqual(ending.problems(), [])
            with self.subTest(file=name):
                self.assertEqual(leaked, [])
        slowest = max((ending.seconds, name, command) for name, endings, _ in results
                      for command, ending in endings.items())
        largest = max((ending.memory, name, command) for name, endings, _ in results
                      for command, ending in endings.items())
        print(f"{len(results)} files; most time {slowest}, most memory {largest}", file=sys.stderr)
        return results

    @staticmethod
    def leaked(place):
        """Files that hold something of a system file, or that a command left behind."""
        found = []
        for path in place.rglob("*"):
            if path.is_fifo() or path.is_dir():
                continue
            if ".new" in path.name or b"root:x:" in path.read_bytes():
                found.append(str(path))
        return found

    def damaged(self, damage):
        def make(path):
            shutil.copyfile(self.folder / "sound.h5", path)
            damage(path)
        return make

    def test_a_run_with_one_thing_wrong_is_shown_or_refused(self):
        makers = {name: self.damaged(damage) for name, damage in hostile_files.KINDS.items()}
        self.assertGreater(len(makers), 80)
        may_break = set(MAY_BREAK_THE_LIBRARY)
        if b"__asan_init" in self.program.read_bytes():
            may_break |= BREAKS_THE_SANITIZED_LIBRARY
        for name, endings, _ in self.try_all(makers):
            if name in may_break:
                continue
            for command, ending in endings.items():
                with self.subTest(file=name, command=command):
                    self.assertIsNone(LIBRARY_FAILS.search(ending.err.decode()), ending.err)

    def test_only_a_sound_file_is_written_over(self):
        for name, endings, _ in self.try_all({
                "sound": self.damaged(lambda path: None),
                "title_missing": self.damaged(hostile_files.KINDS["title_missing"])}):
            self.assertEqual(endings["replace"].code, 0 if name == "sound" else 2, endings["replace"].err)
            self.assertIn(b"not a checkpoint", endings["restart"].err)

    def test_files_that_are_cut_off_or_partly_overwritten_are_shown_or_refused(self):
        makers = {}
        for seed, name in enumerate(["sound.h5", "sound.checkpoint.h5", "rest.h5", "modes.h5", "drag.h5"]):
            data = (self.folder / name).read_bytes()
            copies = hostile_files.cut_off(data, CUTS)
            copies.update(hostile_files.flipped(data, FLIPS, seed))
            for kind, copy in copies.items():
                makers[f"{name}_{kind}"] = lambda path, copy=copy: path.write_bytes(copy)
        self.try_all(makers)

    def test_what_is_no_file_is_refused_at_once(self):
        with tempfile.TemporaryDirectory(dir=self.folder) as place:
            for name in hostile_files.special_files(pathlib.Path(place)):
                for command in [*SHOW, "restart"]:
                    with self.subTest(file=name, command=command):
                        ending = Ending(self.program, place, command, name)
                        self.assertEqual(ending.problems(), [])
                        self.assertEqual(ending.code, 2)

    def test_sound_files_are_shown(self):
        for name in ["sound.h5", "rest.h5"]:
            for command in SHOW:
                with self.subTest(file=name, command=command):
                    self.assertEqual(Ending(self.program, self.folder, command, name).code, 0)
        for name in ["modes.h5", "drag.h5"]:
            self.assertEqual(Ending(self.program, self.folder, "info", name).code, 0)


if __name__ == "__main__":
    HostileFiles.program, HostileFiles.source = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])

"""A short run that the tests of this folder share: Well 1 turns, in a hole of two diameters."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py

SEGMENTS, PROFILES = 40, 31


class SmallRun(unittest.TestCase):
    """Sets program and source (folders) before the tests start."""
    program: Path
    source: Path

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.holder.name)
        shutil.copytree(cls.source / "cases" / "data", cls.folder / "data")
        text = (cls.source / "cases" / "well1.toml").read_text()
        case = text.replace("diameter = 0.3111", "section = [{to = 103.5, diameter = 0.34}, "
                            "{to = 600, diameter = 0.3111}]")
        assert case != text
        (cls.folder / "case.toml").write_text(case)
        cls.simulate("case.toml", "out.h5", "run.duration=3", "output.profile_interval=0.1",
                     "output.interval=0.02", "head.rotation=[[0, 0], [1, 10]]",
                     f"mesh.segments={SEGMENTS}", "output.cycles={}",
                     'output.sensor=[{name = "mwd", depth = 12, measured_from = "bit", radius = 0.05}]')
        cls.file = h5py.File(cls.folder / "out.h5", "r")

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        cls.holder.cleanup()

    @classmethod
    def run_program(cls, *arguments):
        return subprocess.run([cls.program, *arguments], cwd=cls.folder, capture_output=True, text=True)

    @classmethod
    def simulate(cls, case, output, *settings):
        options = [word for setting in settings for word in ["--set", setting]]
        ending = cls.run_program("run", case, "-o", output, "--quiet", *options)
        assert ending.returncode == 0, ending.stderr

    def profile(self, name):
        return self.file["profiles"][name][...]

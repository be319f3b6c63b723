"""Tests of field_study.py and kept_runs.py: `python3 -m unittest discover -s bench -p '*_test.py'`."""

import math
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

import field_study
from field_study import DEPTH, ROTATION, Motion, Times, Variation, last
from kept_runs import KeptRuns, Task, in_toml

RATE = 10.0  # rad/s
CELL = np.array([1.0, 2.0, 2.0, 1.0])  # m
INERTIA = 3.0  # kg m
TIME = np.arange(0, 100.001, 0.5)


def write_result(path):
    """A string that does nothing but rotate, its loads growing with time."""
    with h5py.File(path, "w") as file:
        file.attrs["wall_seconds"] = 25.0
        for name, values in {
                "string/cell": CELL, "string/polar_inertia": np.full(4, INERTIA),
                "series/time": TIME, "series/hook_load": 1e3 * TIME,
                "series/surface_torque": np.full(TIME.size, 2e3),
                "series/contact_nodes": np.full(TIME.size, 3),
                "series/max_penetration": 1e-6 * TIME,
                "series/head_rotation_rate": np.full(TIME.size, RATE),
                "series/kinetic_energy": np.full(TIME.size, 0.5 * INERTIA * 6 * RATE**2),
                "profiles/time": TIME[::10],
                "profiles/normal_force": np.tile([1e3, 2e3, 3e3, 4e3], (TIME[::10].size, 1))}.items():
            file[name] = values


class Numbers(unittest.TestCase):
    def test_of_a_run_are_those_of_its_window(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "run.h5"
            write_result(path)
            numbers = field_study.numbers_of(path, {"late": (80, 100)})
        late = numbers["windows"]["late"]
        self.assertAlmostEqual(late["hook load"]["mean"], 90)  # kN, and a line's mean and limits
        self.assertAlmostEqual(late["hook load"]["low"], 81)
        self.assertAlmostEqual(late["hook load"]["spread"], 20 / math.sqrt(12), delta=0.2)
        self.assertEqual(late["torque"], {"mean": 2, "spread": 0, "low": 2, "high": 2, "most": 2})
        self.assertAlmostEqual(late["wall force"]["mean"], 1 * 1 + 2 * 2 + 2 * 3 + 1 * 4)
        self.assertAlmostEqual(late["in contact"]["mean"], 75)
        self.assertAlmostEqual(late[ROTATION]["mean"], 1)
        self.assertAlmostEqual(late[DEPTH]["most"], 0.1)  # mm
        self.assertEqual(numbers["wall s per s"], 0.25)

    def test_of_a_row_tell_what_failed_and_how_far_statics_are(self):
        starts = [{"windows": {"last": {quantity: {"mean": mean, "spread": 1, "low": 0, "high": 2,
                                                    "most": mean}
                                        for quantity in [*field_study.UNITS, ROTATION, DEPTH]}},
                   "wall s per s": 0.1} for mean in (99.0, 101.0)]
        row = field_study.row_of({"variation": "N"}, [*starts, {"failed": "no"}], {"torque": 80.0})
        self.assertEqual((row["torque"], row["starts"], row["failed"]), (100, 2, 1))
        self.assertEqual(row["torque, most"], 101)
        self.assertAlmostEqual(row["torque, confidence"], 12.706, delta=0.01)
        self.assertEqual(field_study.static_text(row, "torque"), "80; +25.00 %")
        self.assertEqual(field_study.static_text(row, "hook load"), "")
        self.assertEqual(field_study.starts_text(row), "2; 1 failed: no")


class Settings(unittest.TestCase):
    def test_a_schedule_is_moved_delayed_and_stretched(self):
        schedule = [[20, 0], [22, "1.83 Hz"]]
        self.assertEqual(field_study.moved(schedule), schedule)
        self.assertEqual(field_study.moved(schedule, 5, 0.5, 2), [[5.5, 0], [9.5, "1.83 Hz"]])
        self.assertEqual(field_study.moved(schedule, delay=1), [[21, 0], [23, "1.83 Hz"]])

    def test_of_every_start_differ_in_nothing_but_its_rotation(self):
        motion = Motion("", "well1.toml", "drilling", Times(last(30, 100), 100))
        finer = Variation("2N, cfl 0.45", {"run.cfl": 0.45}, mesh=2)
        first, second = (field_study.settings_of(motion, finer, motion.times, start)
                         for start in (0, 1))
        self.assertEqual(first["run.cfl"], 0.45)
        self.assertEqual(first["mesh.segments"] % 2, 0)
        self.assertEqual({key for key in first if first[key] != second[key]}, {"head.rotation"})

    def test_are_written_as_toml_has_them(self):
        self.assertEqual(in_toml({"a": True, "b": "rotating", "c": [[0, "2 Hz"]], "d": 1e7}),
                         {"a": "true", "b": '"rotating"', "c": '[[0, "2 Hz"]]', "d": "10000000.0"})


class Kept(unittest.TestCase):
    def test_a_finished_run_is_not_made_again_and_none_begins_past_the_end(self):
        tasks = [Task("", "well1.toml", {"run.cfl": cfl}, 1, {}) for cfl in ("0.9", "0.45")]
        with tempfile.TemporaryDirectory() as folder, mock.patch("measure.run_case") as run_case:
            kept = Path(folder) / "kept.jsonl"
            runs = KeptRuns(None, kept, "1", lambda path, wanted: {"mean": 5}, math.inf)
            self.assertEqual(runs.numbers(tasks[0]), {"mean": 5})
            again = KeptRuns(None, kept, "1", None, -math.inf)
            self.assertEqual(again.all_numbers(tasks, 2), [{"mean": 5}, None])
            self.assertEqual(run_case.call_count, 1)
            # another version of the program makes it anew, and what fails is not kept
            run_case.side_effect = SystemExit("command\ndrillstrand: error: no such key")
            other = KeptRuns(None, kept, "2", None, math.inf)
            self.assertEqual(other.numbers(tasks[0]), {"failed": "no such key"})
            self.assertEqual(len(kept.read_text(encoding="utf-8").splitlines()), 1)


if __name__ == "__main__":
    unittest.main()

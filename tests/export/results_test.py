#!/usr/bin/python3
"""tools/drillstrand_results.py against the result file that h5py reads.

usage: results_test.py PROGRAM SOURCE_FOLDER [TEST]...
"""

import os
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

from small_run import PROFILES, SEGMENTS, SmallRun

os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(Path(sys.argv[2]) / "tools"))
import drillstrand_results as results


class Results(SmallRun):
    def setUp(self):
        self.result = results.read_result(self.folder / "out.h5")

    def script(self, *arguments):
        script = self.source / "tools" / "drillstrand_results.py"
        return subprocess.run(["/usr/bin/python3", script, *arguments], cwd=self.folder,
                              capture_output=True, text=True)

    def test_the_reader_gives_every_dataset_with_its_units(self):
        for group in ["mesh", "string", "well", "series", "profiles", "cycles", "sensors/mwd"]:
            values = (self.result.sensors["mwd"] if group == "sensors/mwd" else
                      getattr(self.result, group))
            self.assertEqual(set(values), set(self.file[group]))
            for name, data in self.file[group].items():
                np.testing.assert_array_equal(values[name], data[...])
                self.assertEqual(self.result.units[f"{group}/{name}"], data.attrs["units"])
        self.assertEqual(self.result.attributes["status"], "complete")
        self.assertEqual(self.result.attributes["title"], "Well 1, drilling")

    def test_the_reader_gives_only_records_that_are_whole(self):
        """A flush writes values before times: a reader may see more of the former."""
        shutil.copy(self.folder / "out.h5", self.folder / "growing.h5")
        with h5py.File(self.folder / "growing.h5", "r+") as file:
            file["series/time"].resize(70, axis=0)
            file["profiles/time"].resize(11, axis=0)
        growing = results.read_result(self.folder / "growing.h5")
        for group, count in [("series", 70), ("profiles", 11)]:
            for values in getattr(growing, group).values():
                self.assertEqual(len(values), count)

    def test_a_run_can_be_read_while_it_goes_on(self):
        run = subprocess.Popen([self.program, "run", "case.toml", "-o", "live.h5", "--quiet",
                                "--set", "run.duration=100000"], cwd=self.folder, stderr=subprocess.DEVNULL)
        try:
            while not (self.folder / "live.h5").exists():
                self.assertIsNone(run.poll())
                time.sleep(0.01)
            live = results.read_result(self.folder / "live.h5")
        finally:
            run.terminate()
            run.wait()
        self.assertEqual(live.attributes["status"], "running")
        self.assertEqual(len(live.series["head_stress"]), len(live.series["time"]))

    def test_the_axis_goes_through_the_stations_and_the_offset_is_the_eccentricity(self):
        well = self.file["well"]
        axis, tangent = self.result.axis_at(well["measured_depth"])
        np.testing.assert_allclose(axis, well["position"], rtol=0, atol=1e-9)
        np.testing.assert_allclose(tangent[:, 2], np.cos(well["inclination"]), rtol=1e-12)
        # where a node touches the plane of its section, to the rounding of a depth of 500 m
        np.testing.assert_allclose(np.linalg.norm(self.result.lateral_offset(), axis=-1),
                                   self.profile("eccentricity"), rtol=0, atol=1e-8)

    def test_the_clearance_is_that_of_the_diameter_at_the_depth(self):
        depth = self.profile("well_depth")[-1]
        expected = np.where(depth <= 103.5, 0.34, 0.3111) / 2 - 0.2445 / 2
        np.testing.assert_allclose(self.result.clearance(), expected, rtol=1e-12)

    def test_the_spin_of_the_head_is_that_of_the_series(self):
        spin = self.result.spin()
        self.assertEqual(spin.shape, (PROFILES, SEGMENTS + 1))
        expected = np.interp(self.profile("time"), self.file["series/time"],
                             self.file["series/head_rotation_rate"])
        np.testing.assert_allclose(spin[:, 0], expected, rtol=1e-9, atol=1e-12)

    def test_the_head_stresses_are_drawn_as_they_are(self):
        figure = results.draw_head_stress(self.result)
        self.assertEqual(len(figure.axes), 6)
        for k, axes in enumerate(figure.axes):
            (line,) = axes.get_lines()
            np.testing.assert_array_equal(line.get_xdata(), self.file["series/time"])
            np.testing.assert_allclose(line.get_ydata(), self.file["series/head_stress"][:, k] / 1e3)
            self.assertRegex(axes.get_ylabel(), r"\(kN( m)?\)$")

    def test_the_contact_map_has_every_node_and_profile(self):
        (mesh,) = results.draw_contact(self.result).axes[0].collections
        np.testing.assert_allclose(np.asarray(mesh.get_array()).reshape(SEGMENTS + 1, PROFILES),
                                   self.profile("normal_force").T / 1e3)

    def test_the_string_is_drawn_with_its_axial_force(self):
        figure = results.draw_string(self.result)
        space = figure.axes[0]
        sides = [axes for axes in figure.axes if axes.get_xlabel().startswith("offset")]
        self.assertEqual(len(sides), 2)
        (lines,) = [item for item in space.collections if item.get_array() is not None]
        np.testing.assert_allclose(lines.get_array(), self.profile("stress")[-1, :, 3] / 1e3)
        for k, axes in enumerate(sides):
            drawn = axes.get_lines()[0]
            np.testing.assert_allclose(drawn.get_xdata(),
                                       self.result.lateral_offset()[-1, :, k] * 1e3)
            np.testing.assert_allclose(drawn.get_ydata(), self.profile("well_depth")[-1])

    def test_the_orbit_of_a_node_keeps_its_eccentricity(self):
        axes = results.draw_orbit(self.result, node=7, duration=2).axes[0]
        points = axes.collections[0].get_offsets() / 1e3
        late = self.profile("time") >= self.profile("time")[-1] - 2
        np.testing.assert_allclose(np.linalg.norm(points, axis=1),
                                   self.profile("eccentricity")[late, 7], atol=1e-8)

    def test_the_spectrogram_finds_the_frequency_of_a_torque(self):
        times = np.arange(0, 120, 0.05)
        self.result.series = {"time": times, "head_stress": np.zeros((len(times), 6))}
        self.result.series["head_stress"][:, 0] = 5e3 * np.sin(2 * np.pi * 1.25 * times)
        (mesh,) = results.draw_spectrogram(self.result).axes[0].collections
        corners = mesh.get_coordinates()
        frequency = (corners[:-1, 0, 1] + corners[1:, 0, 1]) / 2
        level = np.asarray(mesh.get_array()).reshape(len(frequency), -1)
        np.testing.assert_allclose(frequency[level.argmax(axis=0)], 1.25, atol=0.5 / 12.8)

    def test_the_script_writes_every_figure(self):
        ending = self.script("out.h5", "-o", "figures")
        self.assertEqual((ending.returncode, ending.stderr), (0, ""))
        names = ["contact.png", "head_stress.png", "orbit.png", "spectrogram.png", "string.png"]
        self.assertEqual(sorted(os.listdir(self.folder / "figures")), names)

    def test_the_script_says_what_it_leaves_out_without_a_well(self):
        shutil.copy(self.source / "cases" / "cantilever.toml", self.folder)
        self.simulate("cantilever.toml", "beam.h5", "run.duration=0.3",
                      "output.profile_interval=0.1", "mesh.segments=8")
        ending = self.script("beam.h5")
        self.assertEqual(ending.returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder / "beam")), ["head_stress.png", "string.png"])
        for name in ["contact", "orbit", "spectrogram"]:
            self.assertIn(f"drillstrand_results: no {name}: ", ending.stderr)

    def test_the_script_refuses_what_is_no_result_in_one_line(self):
        for name, words in [("missing.h5", "there is no such file"), ("case.toml", "cannot read")]:
            ending = self.script(name)
            self.assertEqual(ending.returncode, 2)
            self.assertEqual(ending.stderr.count("\n"), 1)
            self.assertIn(f"drillstrand_results: error: {name}: {words}", ending.stderr)


if __name__ == "__main__":
    SmallRun.program, SmallRun.source = Path(sys.argv[1]), Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])

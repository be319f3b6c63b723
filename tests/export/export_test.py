#!/usr/bin/python3
"""drillstrand export against the result file that h5py reads, with VTK's own reader.

usage: export_test.py PROGRAM SOURCE_FOLDER [TEST]...
"""

import csv
import os
import shutil
import sys
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from small_run import PROFILES, SEGMENTS, SmallRun

STRESS = ["twist_moment[N m]", "bending_1[N m]", "bending_2[N m]", "axial_force[N]", "shear_1[N]",
          "shear_2[N]"]
SERIES = {  # columns of series.csv and where the file has them: dataset, component
    "time[s]": ("time", None),
    **{"head_stress_" + name: ("head_stress", k) for k, name in enumerate(STRESS)},
    **{"bit_stress_" + name: ("bit_stress", k) for k, name in enumerate(STRESS)},
    **{f"{end}_position_{name}[m]": (end + "_position", k) for end in ["head", "bit"]
       for k, name in enumerate(["north", "east", "down"])},
    "head_rotation_rate[rad/s]": ("head_rotation_rate", None),
    "bit_rotation_rate[rad/s]": ("bit_rotation_rate", None),
    "hook_load[N]": ("hook_load", None),
    "dead_line_tension[N]": ("dead_line_tension", None),
    "surface_torque[N m]": ("surface_torque", None),
    "drive_torque[N m]": ("drive_torque", None),
    "weight_on_bit[N]": ("weight_on_bit", None),
    "bit_torque[N m]": ("bit_torque", None),
    "depth_of_cut[m]": ("depth_of_cut", None),
    "drilled[m]": ("drilled", None),
    "jar_force[N]": ("jar_force", None),
    "jar_travel[m]": ("jar_travel", None),
    "jar_blows": ("jar_blows", None),
    "kinetic_energy[J]": ("kinetic_energy", None),
    "rotation_energy[J]": ("rotation_energy", None),
    "half_step_energy[J]": ("half_step_energy", None),
    "elastic_energy[J]": ("elastic_energy", None),
    "spring_energy[J]": ("spring_energy", None),
    "potential_energy[J]": ("potential_energy", None),
    "work[J]": ("work", None),
    "dissipation[J]": ("dissipation", None),
    "step_size[s]": ("step_size", None),
    "time_error": ("time_error", None),
    "max_penetration[m]": ("max_penetration", None),
    "relative_penetration": ("relative_penetration", None),
    "penetration_depth[m]": ("penetration_depth", None),
    "helix_penetration[m]": ("helix_penetration", None),
    "wall_drag[N]": ("wall_drag", None),
    "drag_depth[m]": ("drag_depth", None),
    "whirl_forward": ("whirl_forward", None),
    "whirl_backward": ("whirl_backward", None),
    "whirl_rate[rad/s]": ("whirl_rate", None),
    "rolling_rate[rad/s]": ("rolling_rate", None),
    "whirl_depth[m]": ("whirl_depth", None),
    "contact_nodes": ("contact_nodes", None),
    "impacts": ("impacts", None),
    "contact_changes": ("contact_changes", None),
    "slips": ("slips", None),
}


def read_vtk(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def arrays(data):
    """Arrays of points, cells or fields, by name."""
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def lines_of(data):
    """The points of each line."""
    cells = data.GetLines()
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    points = vtk_to_numpy(cells.GetConnectivityArray())
    return [points[first:last] for first, last in zip(offsets[:-1], offsets[1:])]


def read_table(path):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    values = np.array(rows, dtype=float).reshape(len(rows), len(header))
    return dict(zip(header, values.T))


class Export(SmallRun):
    """The files of drillstrand export."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for option in ["vtk", "csv"]:
            ending = cls.run_program("export", "out.h5", "--" + option, "-o", option)
            assert ending.returncode == 0 and ending.stdout == "", ending.stderr

    def collection(self, folder="vtk"):
        """Times and files of a time series, as ParaView reads them."""
        root = xml.parse(self.folder / folder / "string.pvd").getroot()
        self.assertEqual(root.get("type"), "Collection")
        return [(float(entry.get("timestep")), self.folder / folder / entry.get("file"))
                for entry in root.iter("DataSet")]

    def test_the_time_series_holds_every_profile_at_its_time(self):
        collection = self.collection()
        self.assertEqual(len(collection), PROFILES)
        np.testing.assert_array_equal([time for time, path in collection], self.profile("time"))
        for time, path in collection:
            fields = arrays(read_vtk(path).GetFieldData())
            np.testing.assert_array_equal(fields["TimeValue"], [time])

    def test_the_string_has_a_line_per_segment_through_its_nodes(self):
        for k, (time, path) in enumerate(self.collection()):
            data = read_vtk(path)
            self.assertEqual((data.GetNumberOfPoints(), data.GetNumberOfCells()), (SEGMENTS + 1, SEGMENTS))
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()),
                                          self.profile("position")[k])
            np.testing.assert_array_equal(lines_of(data), [[node, node + 1] for node in range(SEGMENTS)])

    def test_the_fields_at_the_nodes_are_those_of_the_result_file(self):
        inertia = self.file["string/polar_inertia"][...]
        for k, (time, path) in enumerate(self.collection()):
            expected = {
                "arc_length[m]": self.file["mesh/node_s"][...],
                "director": self.profile("director")[k],
                "angular_momentum[kg m/s]": self.profile("momentum")[k, :, :3],
                "linear_momentum[kg/s]": self.profile("momentum")[k, :, 3:],
                "eccentricity[m]": self.profile("eccentricity")[k],
                "well_depth[m]": self.profile("well_depth")[k],
                "contact_force[N/m]": self.profile("contact_force")[k],
                "normal_force[N/m]": self.profile("normal_force")[k],
                "side_force[N/m]": self.profile("side_force")[k],
                "whirl_rate[rad/s]": self.profile("whirl_rate")[k],
                "spin[rad/s]": self.profile("momentum")[k, :, 0] / inertia,
                "outer_radius[m]": self.file["string/outer_radius"][...],
            }
            fields = arrays(read_vtk(path).GetPointData())
            offset = fields.pop("offset_from_axis[m]")
            self.assertEqual(sorted(fields), sorted(expected))
            for name, values in expected.items():
                np.testing.assert_array_equal(fields[name], values, err_msg=name)
            # rounding of positions of hundreds of metres
            np.testing.assert_allclose(np.linalg.norm(offset, axis=1),
                                       expected["eccentricity[m]"], rtol=0, atol=1e-9)

    def test_the_fields_on_the_segments_are_those_of_the_result_file(self):
        for k, (time, path) in enumerate(self.collection()):
            stress = self.profile("stress")[k]
            fields = arrays(read_vtk(path).GetCellData())
            np.testing.assert_array_equal(fields.pop("arc_length[m]"), self.file["mesh/segment_s"])
            np.testing.assert_allclose(fields.pop("bending_moment[N m]"),
                                       np.hypot(stress[:, 1], stress[:, 2]), rtol=1e-15)
            self.assertEqual(sorted(fields), sorted(STRESS))
            for component, name in enumerate(STRESS):
                np.testing.assert_array_equal(fields[name], stress[:, component], err_msg=name)

    def test_vector_components_have_names(self):
        data = read_vtk(self.collection()[0][1]).GetPointData()
        for name, components in [("contact_force[N/m]", ["north", "east", "down"]),
                                 ("linear_momentum[kg/s]", ["d3", "d1", "d2"])]:
            array = data.GetArray(name)
            self.assertEqual([array.GetComponentName(k) for k in range(3)], components)

    def test_the_well_is_a_line_per_diameter_along_the_axis(self):
        data = read_vtk(self.folder / "vtk" / "well.vtp")
        points = vtk_to_numpy(data.GetPoints().GetData())
        fields = arrays(data.GetPointData())
        upper, shoulder, lower = lines_of(data)
        np.testing.assert_array_equal(fields["radius[m]"][upper], 0.17)
        np.testing.assert_allclose(fields["radius[m]"][shoulder], (0.17 + 0.15555) / 2, rtol=1e-6)
        np.testing.assert_array_equal(fields["radius[m]"][lower], 0.15555)
        depth = fields["measured_depth[m]"]
        self.assertEqual((depth[upper[-1]], depth[shoulder[0]]), (103.5, 103.5))
        self.assertAlmostEqual(depth[shoulder[-1]], 103.5 + 0.34, delta=1e-9)
        self.assertEqual(depth[lower[0]], depth[shoulder[-1]])
        self.assertTrue((np.diff(depth[upper]) > 0).all() and (np.diff(depth[lower]) > 0).all())
        stations = self.file["well/measured_depth"][...]
        # the survey, or the string where it reaches deeper
        self.assertEqual(depth.max(), max(stations[-1], self.profile("well_depth").max()))
        for station, position in zip(stations, self.file["well/position"][...]):
            nearest = np.argmin(np.abs(depth - station))
            self.assertAlmostEqual(depth[nearest], station, delta=1e-9)
            np.testing.assert_allclose(points[nearest], position, rtol=0, atol=1e-9)

    def test_vtk_makes_tubes_of_string_and_well(self):
        for path, radius, widest in [(self.collection()[-1][1], "outer_radius[m]", 0.12225),
                                     (self.folder / "vtk" / "well.vtp", "radius[m]", 0.17)]:
            data = read_vtk(path)
            data.GetPointData().SetActiveScalars(radius)
            tube = vtkTubeFilter()
            tube.SetInputData(data)
            tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
            tube.SetNumberOfSides(16)
            tube.Update()
            output = tube.GetOutput()
            self.assertEqual(output.GetNumberOfPoints(), 16 * sum(map(len, lines_of(data))))
            first = vtk_to_numpy(output.GetPoints().GetData())[:16]
            head = vtk_to_numpy(data.GetPoints().GetData())[0]
            np.testing.assert_allclose(np.linalg.norm(first - head, axis=1), widest, rtol=1e-4)

    def test_the_series_table_has_every_number_of_the_file(self):
        table = read_table(self.folder / "csv" / "series.csv")
        self.assertEqual(list(table), list(SERIES))
        self.assertEqual({dataset for dataset, component in SERIES.values()}, set(self.file["series"]))
        for column, (dataset, component) in SERIES.items():
            values = self.file["series"][dataset][...]
            np.testing.assert_array_equal(table[column],
                                          values if component is None else values[:, component],
                                          err_msg=column)

    def test_the_table_of_nodes_has_a_row_per_profile_and_node(self):
        table = read_table(self.folder / "csv" / "nodes.csv")
        np.testing.assert_array_equal(table["time[s]"], np.repeat(self.profile("time"), SEGMENTS + 1))
        np.testing.assert_array_equal(table["arc_length[m]"], np.tile(self.file["mesh/node_s"], PROFILES))
        for name, units in [("position", "[m]"), ("director", ""), ("contact_force", "[N/m]")]:
            for k, side in enumerate(["north", "east", "down"]):
                np.testing.assert_array_equal(table[f"{name}_{side}{units}"],
                                              self.profile(name)[..., k].ravel(), err_msg=name)
        for k, body in enumerate(["d3", "d1", "d2"]):
            momentum = self.profile("momentum")
            np.testing.assert_array_equal(table[f"angular_momentum_{body}[kg m/s]"],
                                          momentum[..., k].ravel())
            np.testing.assert_array_equal(table[f"linear_momentum_{body}[kg/s]"],
                                          momentum[..., k + 3].ravel())
        for name in ["eccentricity[m]", "well_depth[m]", "normal_force[N/m]", "side_force[N/m]",
                     "whirl_rate[rad/s]"]:
            np.testing.assert_array_equal(table[name], self.profile(name.split("[")[0]).ravel())

    def test_the_table_of_segments_has_a_row_per_profile_and_segment(self):
        table = read_table(self.folder / "csv" / "segments.csv")
        np.testing.assert_array_equal(table["time[s]"], np.repeat(self.profile("time"), SEGMENTS))
        for k, name in enumerate(STRESS):
            np.testing.assert_array_equal(table[name], self.profile("stress")[..., k].ravel())

    def test_the_table_of_the_well_has_the_axis_of_the_vtk_file(self):
        table = read_table(self.folder / "csv" / "well.csv")
        data = read_vtk(self.folder / "vtk" / "well.vtp")
        np.testing.assert_array_equal(
            np.stack([table[f"{side}[m]"] for side in ["north", "east", "down"]], axis=1),
            vtk_to_numpy(data.GetPoints().GetData()))
        np.testing.assert_array_equal(table["radius[m]"], arrays(data.GetPointData())["radius[m]"])

    def test_the_table_of_a_sensor_has_a_column_for_each_of_its_values(self):
        table = read_table(self.folder / "csv" / "sensor_mwd.csv")
        sensor = self.file["sensors/mwd"]
        columns = {
            "time[s]": ("time", None), "rotation_rate[rad/s]": ("rotation_rate", None),
            "torque[N m]": ("torque", None), "tension[N]": ("tension", None),
            **{f"acceleration_{name}[m/s2]": ("acceleration", k) for k, name in enumerate(["d3", "d1", "d2"])},
            **{f"bending_moment_{name}[N m]": ("bending_moment", k) for k, name in enumerate(["d1", "d2"])},
        }
        self.assertEqual(set(table), set(columns))
        for column, (name, component) in columns.items():
            values = sensor[name][...] if component is None else sensor[name][:, component]
            np.testing.assert_array_equal(table[column], values)
        self.assertEqual(len(table["time[s]"]), 301)

    def test_a_string_without_a_well_is_exported_without_one(self):
        shutil.copy(self.source / "cases" / "cantilever.toml", self.folder)
        self.simulate("cantilever.toml", "beam.h5", "run.duration=0.2", "output.profile_interval=0.1",
                      "mesh.segments=8")
        ending = self.run_program("export", "beam.h5", "--vtk")  # a folder by its own name
        self.assertEqual((ending.returncode, ending.stderr.count("\n")), (0, 1))
        self.assertFalse((self.folder / "beam" / "well.vtp").exists())
        (first, *_, last) = self.collection("beam")
        self.assertEqual((first[0], last[0]), (0, 0.2))
        self.assertNotIn("offset_from_axis[m]", arrays(read_vtk(last[1]).GetPointData()))

    def test_a_file_of_an_older_version_is_exported_with_a_warning(self):
        shutil.copy(self.folder / "out.h5", self.folder / "older.h5")
        with h5py.File(self.folder / "older.h5", "r+") as file:
            del file["well"], file["string"]
        ending = self.run_program("export", "older.h5", "--vtk")
        self.assertEqual(ending.returncode, 0)
        self.assertIn("drillstrand: warning: older.h5: ", ending.stderr)
        self.assertEqual(ending.stderr.count("\n"), 2)
        fields = arrays(read_vtk(self.collection("older")[3][1]).GetPointData())
        np.testing.assert_array_equal(fields["normal_force[N/m]"], self.profile("normal_force")[3])
        self.assertNotIn("spin[rad/s]", fields)

    def test_a_wrong_command_line_or_file_is_one_line_and_writes_nothing(self):
        (self.folder / "notes").write_text("in the way")
        before = sorted(self.folder.rglob("*"))
        for code, words, arguments in [
                (2, "--vtk", ["out.h5"]),
                (2, "--vtk", ["out.h5", "--vtk", "--csv"]),
                (2, "OUT.h5", ["--vtk"]),
                (2, "missing.h5", ["missing.h5", "--csv"]),
                (2, "case.toml", ["case.toml", "--csv"]),
                (2, "notes", ["out.h5", "--csv", "-o", "notes"]),
                (2, "standard output", ["out.h5", "--csv", "-o", "-"]),
                (1, "notes/deeper", ["out.h5", "--csv", "-o", "notes/deeper"]),
                (1, "/dev/null/x", ["out.h5", "--vtk", "-o", "/dev/null/x"])]:
            ending = self.run_program("export", *arguments)
            self.assertEqual(ending.returncode, code, arguments)
            self.assertTrue(ending.stderr.startswith("drillstrand: error: "), ending.stderr)
            self.assertIn(words, ending.stderr)
            self.assertEqual(ending.stderr.count("\n"), 1)
        self.assertEqual(sorted(self.folder.rglob("*")), before)
        (self.folder / "notes").unlink()

    def test_a_file_of_buckling_modes_is_refused(self):
        shutil.copy(self.source / "cases" / "buckling_heavy.toml", self.folder)
        self.run_program("buckling", "buckling_heavy.toml", "-o", "modes.h5")
        ending = self.run_program("export", "modes.h5", "--csv")
        self.assertEqual(ending.returncode, 2)
        self.assertIn("drillstrand: error: modes.h5: this holds buckling modes", ending.stderr)

    def test_an_equilibrium_is_exported(self):
        ending = self.run_program("equilibrium", "case.toml", "-o", "rest.h5", "--set",
                                  "mesh.segments=20")
        self.assertEqual(ending.returncode, 0, ending.stderr)
        self.assertEqual(self.run_program("export", "rest.h5", "--vtk").returncode, 0)
        ((time, path),) = self.collection("rest")
        with h5py.File(self.folder / "rest.h5") as file:
            np.testing.assert_array_equal(vtk_to_numpy(read_vtk(path).GetPoints().GetData()),
                                          file["profiles/position"][0])

    def test_a_file_that_cannot_be_written_is_one_line(self):
        blocked = self.folder / "blocked"
        (blocked / "series.csv").mkdir(parents=True)
        ending = self.run_program("export", "out.h5", "--csv", "-o", "blocked")
        self.assertEqual(ending.returncode, 1)
        self.assertIn("error: blocked/series.csv: cannot write: Is a directory", ending.stderr)
        self.assertEqual(os.listdir(blocked), ["series.csv"])


if __name__ == "__main__":
    SmallRun.program, SmallRun.source = Path(sys.argv[1]), Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])

#!/usr/bin/python3
"""`perifrac export`: frames as VTK reads them, cells, facets, names, units; and as tables."""
import csv
import sys
import types
import unittest

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from perifrac_runs import CONFIGS, RunTest, perifrac, settings

VERTEX, LINE, QUAD, HEXAHEDRON = 1, 3, 9, 12
ROUND = ("--set", "cracks=[{name: notch, centre: [0 mm, 0 mm, 16 mm], normal: [0, 0, 1], radius: 8 mm}]", "--set",
         "body.spacing=2 mm", "--until", "1 us")


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def names(grid):
    data = grid.GetCellData()
    return {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}


def array(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def components(grid, name):
    data = grid.GetCellData().GetArray(name)
    return [data.GetComponentName(i) for i in range(data.GetNumberOfComponents())]


def sizes(grid):
    """Of every cell, its volume in VTK's own reckoning of corners."""
    found = []
    for place in range(grid.GetNumberOfCells()):
        box = np.array(grid.GetCell(place).GetBounds()).reshape(3, 2)
        edges = box[:, 1] - box[:, 0]
        found.append(np.prod(edges[edges > 0]))
    return np.array(found)


class Export(RunTest):
    def run_scene(self, scene, *arguments):
        done = perifrac("run", CONFIGS / scene, *arguments, "--no-report", "--output", self.folder / "run")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "run"

    def export(self, run, *arguments):
        done = perifrac("export", run, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [line.rpartition("/")[2] for line in done.stdout.splitlines()]

    def test_plane(self):
        run = self.run_scene("hf_complete.yaml", "--until", "0.1 ms")
        files = self.export(run)
        self.assertEqual(files, ["body_000001.vtu", "body.pvd", "crack_000001.vtu", "crack.pvd", "fluid_000001.vtu",
                                 "fluid.pvd", "paraview_state.py"])
        body, crack, fluid = (read(run / "export" / f"{name}_000001.vtu") for name in ("body", "crack", "fluid"))
        self.assertEqual((body.GetNumberOfCells(), body.GetCellType(0)), (3088, QUAD))
        # Neighbours share corners: those of 52 by 60 squares, less what lies within the notch.
        self.assertEqual(body.GetNumberOfPoints(), 53 * 61 - 3 * 8)
        np.testing.assert_allclose(sizes(body), 4e-6, rtol=1e-9)
        self.assertLessEqual({"pore_pressure [Pa]", "displacement [m]", "effective_stress [Pa]", "volume [m^2]"}, names(body))
        self.assertEqual(components(body, "effective_stress [Pa]"), ["xx", "yy", "xy"])
        with h5py.File(run / "frames/body_000001.hdf") as frame:
            rows = frame["VTKHDF/PointData/effective_stress"][()]
            self.assertEqual(body.GetFieldData().GetArray("TimeValue").GetValue(0), frame["VTKHDF/FieldData/TimeValue"][0])
        self.assertGreater(np.abs(rows).max(), 1e5)
        np.testing.assert_allclose(array(body, "effective_stress [Pa]"), rows[:, [0, 3, 1]], rtol=1e-9, atol=1e-3)
        self.assertEqual((crack.GetNumberOfCells(), crack.GetCellType(0)), (14, LINE))
        self.assertLessEqual({"crack_opening [m]", "normal", "area [m]"}, names(crack))
        self.assertAlmostEqual(array(crack, "area [m]").sum(), 8e-3 + np.hypot(14e-3, 14e-3), delta=1e-9)
        down = array(crack, "normal")[:4]  # the starter's: it goes straight down
        np.testing.assert_allclose(np.abs(down), [[1, 0, 0]] * 4, atol=1e-9)
        self.assertEqual((fluid.GetNumberOfCells(), fluid.GetCellType(0)), (32, VERTEX))
        self.assertIn("fluid_pressure [Pa]", names(fluid))

    def test_solid_with_quads_and_six_components(self):
        run = self.run_scene("radial.yaml", *ROUND)
        self.export(run, "--frame", "first")
        body, crack = (read(run / "export" / f"{name}_000000.vtu") for name in ("body", "crack"))
        self.assertEqual((body.GetNumberOfCells(), body.GetCellType(0)), (1600, HEXAHEDRON))
        self.assertEqual(body.GetNumberOfPoints(), 11 * 11 * 17)
        np.testing.assert_allclose(array(body, "volume [m^3]"), sizes(body), rtol=1e-9)
        self.assertEqual(components(body, "effective_stress [Pa]"), ["xx", "yy", "zz", "xy", "yz", "xz"])
        self.assertTrue({crack.GetCellType(i) for i in range(crack.GetNumberOfCells())} == {QUAD})
        np.testing.assert_allclose(np.abs(array(crack, "normal")), [[0, 0, 1]] * crack.GetNumberOfCells(), atol=1e-9)
        np.testing.assert_allclose(array(crack, "area [m^2]"), 4e-6, rtol=1e-9)

    def test_regions_all_frames_and_a_time(self):
        run = self.run_scene("hf_barriers.yaml", *settings({"body.spacing": "10 mm", "output.interval": "0.5 ms"}),
                             "--until", "1 ms")
        files = self.export(run, "--frame", "all")
        self.assertEqual([f for f in files if f.startswith("body_")], [f"body_00000{k}.vtu" for k in (0, 1, 2)])
        body = read(run / "export/body_000000.vtu")
        x = np.array([0.5 * sum(body.GetCell(i).GetBounds()[:2]) for i in range(body.GetNumberOfCells())])
        np.testing.assert_array_equal(array(body, "region"), x > 0.05)
        self.assertIn('timestep="0.0005" file="body_000001.vtu"', (run / "export/body.pvd").read_text())
        self.assertIn("body_000001.vtu", self.export(run, "--frame", "0.6 ms"))
        self.assertIn("body_000002.vtu", self.export(run, "--frame", "2"))
        self.assert_refused(perifrac("export", run, "--frame", "3"), "no frame 3", "0 to 2")
        self.assert_refused(perifrac("export", run, "--frame", "soon"), "--frame", "soon")
        self.assert_refused(perifrac("export", run, "--to", "obj"), "--to")
        self.assert_refused(perifrac("export", self.folder), str(self.folder), "frames")
        (run / "frames/body_000001.hdf").write_bytes(b"cut short")
        done = perifrac("export", run, "--frame", "all")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("no export", done.stderr)

    def test_tables(self):
        run = self.run_scene("radial.yaml", *ROUND)
        files = self.export(run, "--to", "csv", "--output", self.folder / "tables")
        self.assertEqual(files, ["body_000001.csv", "crack_000001.csv"])
        rows = list(csv.DictReader((self.folder / "tables/body_000001.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 1600)
        for name in ("x [m]", "z [m]", "displacement y [m]", "effective_stress xz [Pa]", "volume [m^3]"):
            self.assertIn(name, rows[0])
        with h5py.File(run / "frames/body_000001.hdf") as frame:
            moved = frame["VTKHDF/PointData/displacement"][()]
        self.assertGreater(np.abs(moved).max(), 0)
        np.testing.assert_array_equal([float(row["displacement z [m]"]) for row in rows], moved[:, 2])

    def test_the_state_names_what_is_there(self):
        """ParaView itself is not asked for: its module stands in, and notes what it is told."""
        run = self.run_scene("hf_complete.yaml", "--until", "0.1 ms")
        self.export(run)
        told = []

        class Anything:
            def __init__(self, word=""):
                self.word = word

            def __getattr__(self, name):
                return Anything(name)

            def __call__(self, *arguments, **named):
                told.append((self.word, arguments, named))
                return Anything(self.word)

        simple = types.ModuleType("paraview.simple")
        words = ("ColorBy", "FindSource", "GetActiveViewOrCreate", "GetAnimationScene", "GetDisplayProperties",
                 "PVDReader", "Render", "ResetCamera", "Show")
        simple.__dict__.update({word: Anything(word) for word in words})
        sys.modules.update({"paraview": types.ModuleType("paraview"), "paraview.simple": simple})
        state = run / "export/paraview_state.py"
        exec(compile(state.read_text(), state, "exec"), {"__file__": str(state)})
        opened = [named["FileName"].rpartition("/")[2] for word, _, named in told if word == "PVDReader"]
        self.assertEqual(opened, ["body.pvd", "crack.pvd", "fluid.pvd"])
        shown = [arguments[1][1] for word, arguments, _ in told if word == "ColorBy"]
        for file, name in zip(opened, shown):
            self.assertIn(name, names(read(run / "export" / file.replace(".pvd", "_000001.vtu"))))


if __name__ == "__main__":
    unittest.main()

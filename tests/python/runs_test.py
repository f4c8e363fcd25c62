#!/usr/bin/python3
"""Runs of the program as arrays with units.

Usage: runs_test.py PROGRAM BUILD [unittest's arguments]
"""
import csv
import importlib.util
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import perifrac

PROGRAM = Path(sys.argv.pop(1)).resolve()
sys.argv.pop(1)


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name) / "run"
        words = ("body.spacing=4 m", "time.end=4 s", "output.times=[1 s]")
        subprocess.run([PROGRAM, "run", "--example", "mandel", "--no-report", "--output", cls.folder,
                        *(f"--set={word}" for word in words)], check=True, capture_output=True)  # fmt: skip
        cls.run_read = perifrac.read_run(cls.folder)

    def test_history_has_columns_by_name_with_units(self):
        history = self.run_read.history
        with (self.folder / "history.csv").open(newline="") as stream:
            header, *rows = csv.reader(stream)
        said = [f"{name} [{unit}]" if unit else name for name, unit in history.units.items()]
        self.assertEqual(said, header)
        np.testing.assert_array_equal(np.array(rows, dtype=float).T, np.array(list(history.values())))
        self.assertEqual(history.units["time"], "s")

    def test_frames_have_fields_with_units(self):
        self.assertEqual(list(self.run_read.frames), ["body"])
        frames = self.run_read.frames["body"]
        self.assertEqual([frame.time for frame in frames], [0.0, 1.0, 4.0])
        last = frames[-1]
        self.assertEqual((last.units["pore_pressure"], last.units["displacement"]), ("Pa", "m"))
        self.assertEqual((last["pore_pressure"].shape, last["displacement"].shape), ((50,), (50, 3)))
        self.assertEqual(last.points.max(axis=0).tolist(), [38.0, 18.0, 0.0])
        self.assertGreater(last["pore_pressure"][0], last["pore_pressure"].min())

    def test_summary_and_scene(self):
        self.assertEqual(self.run_read.outcome, "done")
        self.assertIn("# --set body.spacing=4 m", self.run_read.scene)
        self.assertLess(self.run_read.summary["ledger"]["mass_error"], 1e-12)

    def test_an_unfinished_run_and_none(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            with self.assertRaisesRegex(perifrac.Error, "holds no run"):
                perifrac.read_run(folder)
            (folder / "history.csv").write_text("time [s],p [Pa]\n0,1\n1,")
            run = perifrac.read_run(folder)
            self.assertEqual(run.outcome, "unfinished")
            np.testing.assert_array_equal(run.history["p"], [1, np.nan])

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "python3-xarray is not installed")
    def test_xarray(self):
        data = self.run_read.to_xarray()
        self.assertEqual(data["time"].attrs["units"], "s")
        np.testing.assert_array_equal(data["top_plate_displacement"], self.run_read.history["top_plate_displacement"])
        fields = self.run_read.fields_to_xarray("body")
        self.assertEqual(fields["displacement"].dims, ("time", "point", "displacement_component"))
        self.assertEqual(fields["pore_pressure"].attrs["units"], "Pa")


if __name__ == "__main__":
    unittest.main()

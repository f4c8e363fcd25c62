#!/usr/bin/python3
"""A physics that the scene does not name makes no module, array, link, field or column."""
import json
import unittest

import h5py
from perifrac_runs import HERE, MANDEL, RunTest, checkpoints, listed_frames, perifrac, settings

# What each physics would bring: words in the names of arrays, links, fields and columns.
TRACES = {"solid": ("solid", "displacement", "dilatation", "elastic"),
          "pore_flow": ("pore", "fluid", "darcy", "mass")}


class AbsentPhysics(RunTest):
    def check(self, scene, keys=None):
        done = perifrac("check", scene, "--json", "--trial", "0", *settings(keys or {}))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def names_made(self, folder):
        """Names of fields in frames, of columns, and of arrays in the checkpoint."""
        names = []
        for _, frame in listed_frames(folder):
            with h5py.File(frame, "r") as opened:
                names += opened["VTKHDF/PointData"].keys()
        with h5py.File(checkpoints(folder)[-1], "r") as opened:
            opened["state"].visit(names.append)
        names += (folder / "history.csv").read_text().splitlines()[0].split(",")
        return names

    def assert_absent(self, physics, names):
        for name in names:
            for trace in TRACES[physics]:
                self.assertNotIn(trace, name)

    def test_one_physics_alone(self):
        for present, absent in (("solid", "pore_flow"), ("pore_flow", "solid")):
            with self.subTest(present=present):
                scene = HERE / f"{present}_only.yaml"
                said = self.check(scene)
                self.assertEqual(said["modules"], [present])
                self.assertEqual(said["links"], [])
                self.assertEqual(len(said["effects"]), 1)
                self.assert_absent(absent, [array["name"] for array in said["arrays"]])
                folder = self.run_scene({}, present, scene=scene)
                self.assertEqual([time for time, _ in listed_frames(folder)], [0.0, 0.5, 1.0])
                self.assert_absent(absent, self.names_made(folder))
                summary = json.loads((folder / "summary.json").read_text())
                self.assertEqual([module["name"] for module in summary["modules"]], [present])
                self.assertEqual("mass_error" in summary["ledger"], present == "pore_flow")

    def test_the_solid_alone_is_the_exact_one(self):
        # Uniform plane strain: the force over the width, E' = E / (1 - nu^2).
        folder = self.run_scene({}, "run", scene=HERE / "solid_only.yaml")
        header, *_, last = (folder / "history.csv").read_text().splitlines()
        row = dict(zip(header.split(","), last.split(",")))
        expected = -20e3 / 20.0 * 20.0 * (1 - 0.25**2) / 1e9
        self.assertAlmostEqual(float(row["top_plate_displacement [m]"]) / expected, 1.0, delta=1e-9)

    def test_a_rigid_solid_has_no_arrays(self):
        alone = self.check(HERE / "pore_flow_only.yaml")
        beside = self.check(HERE / "pore_flow_only.yaml", {"solid": "{type: rigid}"})
        self.assertEqual(sorted(beside["modules"]), ["pore_flow", "solid"])
        self.assertEqual(beside["arrays"], alone["arrays"])
        self.assertEqual(beside["links"], [])
        flow = self.run_scene({}, "alone", scene=HERE / "pore_flow_only.yaml")
        both = self.run_scene({"solid": "{type: rigid}"}, "beside", scene=HERE / "pore_flow_only.yaml")
        self.assert_same_frames(flow, both)
        self.assert_same_history(flow, both)

    def test_both_are_there_where_both_are_named(self):
        said = self.check(MANDEL)
        self.assertEqual(sorted(said["modules"]), ["pore_flow", "solid"])
        self.assertEqual(len(said["links"]), 2)
        for physics, traces in TRACES.items():
            self.assertTrue(any(traces[0] in array["name"] for array in said["arrays"]), physics)


if __name__ == "__main__":
    unittest.main()

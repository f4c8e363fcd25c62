#!/usr/bin/python3
"""Values that overflow stop the run with field, place and time; the last good checkpoint is kept and can be used."""
import json
import math
import unittest

import h5py
from perifrac_runs import FLUIDS, MANDEL, RunTest, SMALL, checkpoints, perifrac, settings

# A load that rises until its work, a square, overflows after some 150 windows.
OVERFLOWING = SMALL | {"pore_flow.integrator.type": "explicit", "time.end": "1000 s", "output.interval": "10 s",
                       "output.times": "[]", "solid.boundary.top":
                       "{type: rigid_plate, force: 1e160 N/m, schedule: {times: [0 s, 20 s, 500 s], factors: [1e-12, 1e-12, 1]}}"}
# An overflow at a point that the scene names; storage that reaches from point to point would spread it.
SOURCE = SMALL | {"pore_flow.integrator.type": "explicit", "pore_flow.undrained_stabilisation": "0",
                  "pore_flow.sources": "[{at: [21 m, 7 m], rate: 1e306}]"}


class NotANumber(RunTest):
    def fail_to_run(self, keys, folder, *options, scene=MANDEL):
        done = perifrac("run", scene, "--no-report", "--output", self.folder / folder, *settings(keys), *options)
        self.assertEqual(done.returncode, 1, done.stderr)
        errors = [line for line in done.stderr.splitlines() if "error" in line.split(":")[2]]
        self.assertEqual(len(errors), 1, done.stderr)
        self.assertEqual(json.loads((self.folder / folder / "summary.json").read_text())["outcome"], "failed")
        return errors[0]

    def test_names_field_point_and_time(self):
        error = self.fail_to_run(SOURCE, "run")
        self.assertRegex(error, r"(infinite value|not a number|not finite) in pore_flow/pore_pressure "
                                r"at point \d+ at \(21, 7\) m, t = 0\.02 s; ")

    def test_names_a_fluid_point(self):
        error = self.fail_to_run({"fluid.inlets[0].rate": "1e306 kg/(m s)"}, "run", scene=FLUIDS["tank"])
        self.assertRegex(error, r"(not a|is not) (finite )?number in fluid_velocity at point \d+ at \(.*\) m, t = .* s; ")

    def test_keeps_a_checkpoint_from_which_the_same_follows(self):
        error = self.fail_to_run(OVERFLOWING, "run")
        self.assertRegex(error, r"infinite value in solid/external_work at .*, t = \d+(\.\d+)? s; ")
        last = checkpoints(self.folder / "run")[-1]
        with h5py.File(last, "r") as opened:
            self.assertGreater(opened["step"][0], 0)
            opened["state"].visititems(self.assert_finite)
        again = self.fail_to_run(OVERFLOWING, "run", "--restart", last)
        self.assertEqual(error.split("error")[1], again.split("error")[1])

    def assert_finite(self, name, node):
        if isinstance(node, h5py.Dataset):
            self.assertTrue(all(map(math.isfinite, node[()].flat)), name)

    def test_a_checkpoint_from_before_can_end_well(self):
        # The run of the same scene that is stopped in time has nothing to complain of.
        self.fail_to_run(OVERFLOWING, "run")
        start = checkpoints(self.folder / "run")[-1]
        with h5py.File(start, "r") as opened:
            until = opened["time"][0]
        self.run_scene(OVERFLOWING, "run", "--restart", start, "--until", repr(float(until)))


if __name__ == "__main__":
    unittest.main()

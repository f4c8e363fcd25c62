#!/usr/bin/python3
"""A run whose fluid mass drifts beyond the scene's bound stops, says so, and keeps a checkpoint from before."""
import json
import unittest

import h5py
from perifrac_runs import MANDEL, RunTest, SMALL, checkpoints, perifrac, settings

# The nested operator's smoothing makes fluid from the first window on, where no neighbours make up for it.
LEAKING = SMALL | {"pore_flow.operator": "nested", "pore_flow.integrator.type": "explicit",
                   "pore_flow.nested.compensation": "none"}


class MassBound(RunTest):
    def run_leaking(self, keys, folder, *options):
        return perifrac("run", MANDEL, "--no-report", "--output", self.folder / folder, *settings(LEAKING | keys),
                        *options)

    def test_stops_beyond_the_default(self):
        done = self.run_leaking({}, "run")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"error: a relative error of \d\.\de[-+]\d\d, above ledger.mass_error 1e-06, in "
                                      r"fluid_mass at the ledger, t = \S+ s; .+\n")
        summary = json.loads((self.folder / "run" / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "failed")
        self.assertGreater(summary["ledger"]["mass_error"], 1e-6)
        with h5py.File(checkpoints(self.folder / "run")[-1], "r") as last:
            self.assertLess(last["time"][0], summary["time"]["value"])

    def test_goes_on_where_the_scene_allows_it(self):
        done = self.run_leaking({"ledger.mass_error": "10"}, "run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("fluid mass kept to", done.stdout)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
"""Results are the same bits at any number of threads."""
import json
import unittest
from itertools import product

from perifrac_runs import CONFIGS, FLUIDS, METHODS, RunTest, SMALL, VARIANTS

# Enough points for every loop to be shared out.
FINE = SMALL | {"body.spacing": "0.25 m", "body.size": "[40 m, 13 m]", "output.times": "[0.01 s]",
                "time.end": "0.02 s"}
SCHEMES = {"explicit": {"pore_flow.integrator.type": "explicit"},
           "cvode, krylov": {"pore_flow.integrator.linear_solver": "krylov"},
           "stabilised, solid by multigrid": {"pore_flow.undrained_stabilisation": "0.25",
                                              "solid.linear_solver.type": "multigrid"},
           "cvode, direct, iterated": {"coupling.iterations.max": "20", "coupling.iterations.tolerance": "1e-3",
                        "coupling.acceleration": "quasi_newton"}}

# More than 8000 fluid points, of which some are split, made and removed in a few steps.
FINE_FLUIDS = {
    "tank": {"time.end": "0.6 ms", "output.times": "[0.3 ms]", "fluid.spacing": "5 mm",
             "fluid.inlets[0].schedule.ramp": "1e-6 s", "fluid.inlets[0].rate": "3e4 kg/(m s)",
             "fluid.inlets[1].rate": "500 kg/(m s)"},
    "seeping pool": {"time.end": "0.2 ms", "output.times": "[0.1 ms]", "body.spacing": "2.5 mm",
                     "body.size": "[0.8 m, 0.05 m]", "pore_flow.permeability": "1e-10 m^2",
                     "fluid.blocks[0].from": "[0 m, 0.05 m]", "fluid.blocks[0].to": "[0.8 m, 0.125 m]"},
}


class Threads(RunTest):
    def test_the_number_of_threads_changes_nothing(self):
        for name, keys in SCHEMES.items():
            one = self.run_scene(FINE | keys, f"{name}/1", "--threads", "1")
            for number in ("2", "4") if name == "explicit" else ("4",):
                with self.subTest(name, threads=number):
                    other = self.run_scene(FINE | keys, f"{name}/{number}", "--threads", number)
                    self.assert_same_results(one, other)

    def test_nor_in_other_scenes(self):
        for name in ("dynamic", "the paper's, in windows of one step"):
            scene, keys = VARIANTS[name]
            keys = keys | {"body.spacing": "0.25 m", "body.size": "[40 m, 13 m]", "time.end": "0.4 ms",
                           "output.times": "[0.2 ms]", "output.history_interval": "0 s"}
            one = self.run_scene(keys, f"{name}/1", "--threads", "1", scene=scene)
            other = self.run_scene(keys, f"{name}/4", "--threads", "4", scene=scene)
            with self.subTest(name):
                self.assert_same_results(one, other)

    def test_nor_where_a_crack_grows(self):
        scene = CONFIGS / "hf_storage.yaml"
        keys = {"body.spacing": "1.25 mm", "time.end": "1.5 ms", "output.interval": "1.5 ms", "solid.type": "dynamic"}
        one = self.run_scene(keys, "crack/1", "--threads", "1", scene=scene)
        other = self.run_scene(keys, "crack/4", "--threads", "4", scene=scene)
        self.assert_same_results(one, other)

    def test_nor_where_points_move_come_and_go(self):
        for name, method in product(FINE_FLUIDS, METHODS):
            scene = FLUIDS[name]
            keys = FINE_FLUIDS[name] | {"output.history_interval": "0 s", "fluid.type": method}
            one = self.run_scene(keys, f"{name}/{method}/1", "--threads", "1", scene=scene)
            other = self.run_scene(keys, f"{name}/{method}/4", "--threads", "4", scene=scene)
            with self.subTest(name, method=method):
                self.assert_same_results(one, other)
                self.assertGreater(json.loads((one / "summary.json").read_text())["counts"]["fluid_points"], 8000)


if __name__ == "__main__":
    unittest.main()

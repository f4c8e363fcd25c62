#!/usr/bin/python3
"""Modules written in Python, in coupled runs, and what is said where they go wrong. That they keep the contract is
tested by contract_python_test.cpp.

Usage: modules_test.py PROGRAM BUILD [unittest's arguments]
"""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import perifrac

sys.argv[1:3] = []
EXAMPLES = Path(__file__).resolve().parents[2] / "python/examples"
sys.path.insert(0, str(EXAMPLES))
import own_flow  # noqa: E402


class Spring(perifrac.Module):
    """A solid of springs, point by point."""

    keys = [perifrac.Key("stiffness", unit="Pa", range="(0, inf)", required=True, meaning="Of each.")]
    fails = {}

    def __init__(self, section, body):
        self.stiffness, self.count = section.number("stiffness"), len(body.volumes)
        self.ports = [perifrac.Port("pore_stress", "Pa", direction="in"), perifrac.Port("dilatation", "1")]
        self.stress = np.empty(0)

    def port(self, name):
        if name in self.fails:
            return self.fails[name](self)
        if name == "pore_stress":
            return self.stress
        return perifrac.View(self.dilatation, slope=np.full(self.count, 1 / self.stiffness))

    def initialize(self, t):
        self.dilatation = np.zeros(self.count)

    def connect(self, name):
        self.stress = np.zeros(self.count)

    def advance(self, begin, end):
        if "advance" in self.fails:
            return self.fails["advance"](self, begin, end)
        self.dilatation[:] = (self.stress + 1e6) / self.stiffness
        return end

    def visit_state(self, state):
        self.dilatation = state.visit("dilatation", self.dilatation)


perifrac.add_module_type("solid", "springs", Spring)


class Drops(perifrac.Module):
    """Points of its own that move, one of which goes in each window; needs no body."""

    needs_body = False

    def __init__(self, section, body):
        self.ports = [perifrac.Port("height", "m"), perifrac.Port("drops", "1", kind="extensive", role="work")]

    def port(self, name):
        return float(len(self.height)) if name == "drops" else perifrac.View(self.height, points=self.points)

    def initialize(self, t):
        self.height = np.arange(5.0)
        self.points = perifrac.PointSet("drops", self.positions())

    def positions(self):
        return np.column_stack((np.zeros(len(self.height)), self.height))

    def advance(self, begin, end):
        if end > begin:
            self.height = self.height[1:] - 0.5
            self.points.move(self.positions())
        return end

    def visit_state(self, state):
        self.height = state.visit("height", self.height)

    def on_restored(self, t):
        self.points.move(self.positions())


perifrac.add_module_type("drops", "falling", Drops)


def springs(**keys):
    return perifrac.Scene({
        "dimension": 2, "time": {"end": "1 s"}, "body": {"shape": "box", "size": [1, 1], "spacing": 0.25},
        "coupling": {"window": {"first": "0.5 s", "growth": 1, "largest": "0.5 s"}},
        "solid": {"type": "springs", "stiffness": "1 GPa", **keys}})  # fmt: skip


class Modules(unittest.TestCase):
    def setUp(self):
        Spring.fails = {}

    def test_own_flow_drains_mandels_slab_as_darcy_does(self):
        scene = perifrac.Scene.from_file(str(EXAMPLES / "own_flow.yaml"))
        own = perifrac.Simulation(scene)
        scene = perifrac.Scene.example("mandel")
        scene["body.spacing"], scene["time.end"], scene["output.times"] = "4 m", "30 s", ["15 s"]
        known = perifrac.Simulation(scene)
        for t in (0.0, 5.0, 15.0, 30.0):
            own.advance_to(t)
            known.advance_to(t)
            one, other = own.fields["pore_pressure"], known.fields["pore_pressure"]
            self.assertLess(np.abs(one - other).max(), 0.0145 * other.max(), t)
        self.assertLess(own.summary()["ledger"]["mass_error"], 1e-14)

    def test_its_keys_are_in_the_catalogue(self):
        with self.assertRaisesRegex(perifrac.SceneError, "scene: solid: unknown key 'stifness'.*did you mean 'stiffness'"):
            springs(stifness="1 GPa")
        with self.assertRaisesRegex(perifrac.SceneError, r"a pressure \[Pa\]"):
            springs(stiffness="1 m")
        with self.assertRaisesRegex(perifrac.SceneError, "there is a 'solid: {type: rigid}' already"):
            perifrac.add_module_type("solid", "rigid", Spring)
        perifrac.add_module_type("solid", "springs", Spring)  # a cell that runs once more

    def test_what_it_refuses_is_placed_at_the_scene(self):
        scene = perifrac.Scene.from_file(str(EXAMPLES / "own_flow.yaml"))
        scene["pore_flow.drained"] = "rihgt"
        with self.assertRaisesRegex(perifrac.SceneError, r'scene\["pore_flow.drained"\]: pore_flow.drained: no such face'):
            perifrac.Simulation(scene)

    def test_what_it_raises_is_one_line_that_names_it(self):
        def fail(self, *_):
            return {}["nothing"]

        for where in ("advance", "dilatation"):
            Spring.fails = {where: fail}
            method = "port" if where == "dilatation" else where
            expected = rf"Spring.{method} \(modules_test.py:\d+\): KeyError: 'nothing'"
            with self.subTest(where), self.assertRaisesRegex(perifrac.ModuleError, expected) as caught:
                perifrac.Simulation(springs()).run()
            self.assertIsInstance(caught.exception.__cause__, KeyError)
            self.assertNotIn("\n", str(caught.exception))

    def test_answers_of_another_kind(self):
        for where, answer, expected in (
            ("advance", lambda *_: None, "Spring.advance: returned what is of another kind; expected a number"),
            ("dilatation", lambda _: np.zeros(16, dtype=int), "no array of 8-byte numbers"),
            ("dilatation", lambda _: np.zeros((16, 2))[:, 0], "in one piece"),
            ("dilatation", lambda _: [0.0] * 16, "no array of 8-byte numbers"),
        ):
            Spring.fails = {where: answer}
            with self.subTest(expected), self.assertRaisesRegex(RuntimeError, expected):
                perifrac.Simulation(springs()).run()

    def test_a_numerical_error_is_tried_again_half_as_long(self):
        tried = []

        def fail_where_long(self, begin, end):
            tried.append(end - begin)
            if end - begin > 0.3:
                raise perifrac.NumericalError("too long", field="dilatation", place="point 3", time=begin)
            return end

        Spring.fails = {"advance": fail_where_long}
        simulation = perifrac.Simulation(springs())
        simulation.run()
        self.assertEqual(tried[:3], [0.0, 0.5, 0.25])
        self.assertGreaterEqual(simulation.summary()["coupling"]["window_cuts"], 1)

    def test_points_of_its_own_that_come_and_go(self):
        with tempfile.TemporaryDirectory() as folder:
            window = {"first": "0.5 s", "growth": 1, "largest": "0.5 s"}
            scene = {"dimension": 2, "time": {"end": "1 s"}, "coupling": {"window": window}, "drops": {"type": "falling"}}
            simulation = perifrac.Simulation(scene, output=folder)
            self.assertEqual(simulation.points("height").shape, (5, 2))
            simulation.run()
            np.testing.assert_array_equal(simulation.fields["height"], [1.0, 2.0, 3.0])
            np.testing.assert_array_equal(simulation.points("height")[:, 1], [1.0, 2.0, 3.0])
            frames = perifrac.read_run(folder).frames["drops"]
            self.assertEqual([len(frame["height"]) for frame in frames], [5, 3])

    def test_ctrl_c_in_a_module_is_no_failure_of_it(self):
        def interrupt(self, begin, end):
            raise KeyboardInterrupt

        Spring.fails = {"advance": interrupt}
        with self.assertRaises(KeyboardInterrupt):
            perifrac.Simulation(springs())


if __name__ == "__main__":
    unittest.main()

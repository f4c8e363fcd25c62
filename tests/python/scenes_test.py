#!/usr/bin/python3
"""Scenes as objects: keys by the paths of the command line, checked by the program's catalogue.

Usage: scenes_test.py PROGRAM BUILD [unittest's arguments]
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import perifrac

PROGRAM = Path(sys.argv.pop(1)).resolve()
sys.argv.pop(1)


class Scenes(unittest.TestCase):
    def wrong(self, action, *words):
        with self.assertRaises(perifrac.SceneError) as caught:
            action()
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        return str(caught.exception)

    def test_sets_and_gives_keys_by_path(self):
        scene = perifrac.Scene.example("kgd_viscosity")
        scene["crack_fluid.inlets[0].rate"] = "2e-4 m^2/s"
        scene["body.size"] = np.array([0.4, 0.8])
        scene["crack_fluid.viscosity"] = 0.1
        self.assertEqual(scene["crack_fluid.inlets[0].rate"], "2e-4 m^2/s")
        self.assertEqual(scene["body.size"], [0.4, 0.8])
        self.assertEqual(scene["solid.boundary.top"], {"type": "roller"})
        read = scene.section()
        self.assertEqual(read.number("crack_fluid.inlets[0].rate"), 2e-4)
        self.assertEqual(read.number("solid.material.youngs_modulus"), 700e6)
        self.assertIn("damage", scene)
        del scene["reference"]
        self.assertNotIn("reference", scene)
        with self.assertRaises(KeyError):
            scene["reference"]

    def test_a_wrong_key_is_the_line_of_the_program(self):
        scene = perifrac.Scene.example("mandel")
        for key, value, rest in (
            ("pore_flow.porosty", "0.2", "porosity"),
            ("pore_flow.porosity", "2", "in (0, 1)"),
            ("pore_flow.porosity", "3 Pa", ""),
            ("sollid.type", "rigid", "solid"),
            ("output.probes[9].name", "x", "no item"),
            ("solid.boundary.top.force", "10 kN", "N/m"),
        ):
            with self.subTest(key):
                before = scene.yaml()
                line = self.wrong(lambda: scene.__setitem__(key, value), rest)
                done = subprocess.run([PROGRAM, "check", "--example", "mandel", f"--set={key}={value}"],
                                      capture_output=True, text=True, check=False)  # fmt: skip
                said = done.stderr.strip().replace(f"--set {key}={value}", f'scene["{key}"]')
                self.assertIn(line.replace("scene: ", f'scene["{key}"]: '), said)
                self.assertEqual(scene.yaml(), before)  # it stays as it was

    def test_what_lies_between_keys_is_said_when_it_is_built(self):
        scene = perifrac.Scene.example("mandel")
        scene["time.end"] = "1 s"
        self.wrong(lambda: perifrac.Simulation(scene), "output.times")

    def test_may_be_built_key_by_key(self):
        scene = perifrac.Scene()
        for key, value in {
            "dimension": 2, "body.shape": "box", "body.size": [1, 1], "body.spacing": 0.25, "time.end": 1,
            "pore_flow.type": "darcy", "pore_flow.permeability": "1 mD", "pore_flow.porosity": 0.1,
            "pore_flow.grain_bulk_modulus": "10 GPa", "pore_flow.biot_coefficient": 1,
            "pore_flow.fluid": {"bulk_modulus": "2 GPa", "viscosity": "1 cP", "density": 1000},
            "pore_flow.boundary.left": {"type": "pressure", "pressure": "1 MPa"},
        }.items():  # fmt: skip
            scene[key] = value
        simulation = perifrac.Simulation(scene)
        simulation.run()
        self.assertGreater(simulation.fields["pore_pressure"].max(), 0.0)
        again = perifrac.Scene({"dimension": 2})
        self.wrong(lambda: perifrac.Simulation(again), "missing key")

    def test_a_dictionary_is_read_as_a_file_is(self):
        self.wrong(lambda: perifrac.Scene({"dimension": 2, "time": {"ennd": 3}}), "time", "did you mean 'end'?")
        self.wrong(lambda: perifrac.Scene({"dimension": object()}), "a object has no place in a scene")
        self.wrong(lambda: perifrac.Scene({"modules": ["./libmine.so"]}), "by the program alone")
        self.wrong(lambda: perifrac.Scene.from_file("nowhere.yaml"), "nowhere.yaml")

    def test_yaml_is_a_scene_of_the_program(self):
        scene = perifrac.Scene.example("mandel")
        scene["title"] = 'a "title": #1'
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "scene.yaml"
            file.write_text(scene.yaml())
            self.assertEqual(perifrac.Scene.from_file(str(file)).yaml(), scene.yaml())
            self.assertEqual(perifrac.Scene.from_file(str(file))["title"], 'a "title": #1')


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
"""What helps to write a scene: `perifrac new`, `explain` and `schema`.

Usage: scene_writing_test.py PERIFRAC [unittest's arguments]
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema
import yaml

from catalogue_cases import ROOT, SCHEMA_LINE, schema_of, shipped_scenes, wrong_by_the_catalogue

PERIFRAC = os.path.abspath(sys.argv.pop(1))
KINDS = ("consolidation", "constant_head", "fault", "fractures_in_layers", "impact", "kgd", "mandel", "natural_fracture",
         "own_points", "radial")  # fmt: skip


def perifrac(*arguments, cwd=None):
    return subprocess.run([PERIFRAC, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=cwd)


class New(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_writes_scenes_that_are_fine(self):
        for kind in KINDS:
            with self.subTest(kind):
                self.assertEqual(perifrac("new", kind, cwd=self.folder).returncode, 0)
                said = perifrac("check", kind + ".yaml", "--trial", "0", "--json", cwd=self.folder)
                self.assertEqual((said.returncode, said.stderr), (0, ""))
                warnings = json.loads(said.stdout)["warnings"]
                self.assertEqual([warning for warning in warnings if "those of an infinite body" not in warning], [])
                text = (self.folder / (kind + ".yaml")).read_text(encoding="utf-8")
                self.assertGreaterEqual(text.count("# "), 5, "comments")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         sorted([k + ".yaml" for k in KINDS] + ["own_points.csv", "perifrac.schema.json"]))
        schema = (self.folder / "perifrac.schema.json").read_text(encoding="utf-8")
        self.assertEqual(schema, perifrac("schema").stdout)

    def test_names_all_that_it_wrote(self):
        said = perifrac("new", "own_points", cwd=self.folder).stdout
        self.assertEqual(said, "wrote own_points.yaml, own_points.csv, perifrac.schema.json; next: perifrac check own_points.yaml\n")
        self.assertEqual(perifrac("new", "kgd", cwd=self.folder).stdout, "wrote kgd.yaml; next: perifrac check kgd.yaml\n")

    def test_lists_its_kinds(self):
        done = perifrac("new", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for kind in KINDS:
            self.assertRegex(done.stdout, rf"(?m)^  {kind} +\S")
        self.assertIn("  material NAME\n", done.stdout)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_keeps_a_schema_that_is_there(self):
        (self.folder / "perifrac.schema.json").write_text("{}", encoding="utf-8")
        self.assertEqual(perifrac("new", "kgd", cwd=self.folder).returncode, 0)
        self.assertEqual((self.folder / "perifrac.schema.json").read_text(encoding="utf-8"), "{}")

    def test_never_replaces_a_file(self):
        for name in ("own_points.yaml", "own_points.csv"):
            (self.folder / name).write_text("mine", encoding="utf-8")
            done = perifrac("new", "own_points", cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"'{name}' is there already; expected", done.stderr)
            self.assertEqual([p.name for p in self.folder.iterdir()], [name])
            self.assertEqual((self.folder / name).read_text(encoding="utf-8"), "mine")
            (self.folder / name).unlink()
        os.symlink("nowhere", self.folder / "kgd.yaml")
        self.assertEqual(perifrac("new", "kgd", cwd=self.folder).returncode, 2)

    def test_has_another_name_on_demand_and_names_its_kinds(self):
        self.assertEqual(perifrac("new", "kgd", "--output", self.folder / "mine.yaml").returncode, 0)
        self.assertTrue((self.folder / "mine.yaml").exists())
        done = perifrac("new", "kdg", cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "perifrac new: unknown kind 'kdg'; expected one of: " + ", ".join(KINDS) +
                         "; did you mean 'kgd'?\n")


class Explain(unittest.TestCase):
    def said(self, key):
        done = perifrac("explain", key)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_says_what_is_known_of_a_key(self):
        said = self.said("pore_flow.porosity")
        for line in ("pore_flow.porosity", "value     number", "range     (0, 1)", "none, it must be written",
                     "holds     pore_flow.type=darcy"):  # fmt: skip
            self.assertIn(line, said)
        self.assertRegex(said, "used by   aquifer, .* more")
        said = self.said("crack_fluid.inlets[0].holds")
        self.assertIn("choices   rate, pressure, fluid", said)
        self.assertIn("default   rate", said)
        self.assertIn("holds     crack_fluid.type=network|uniform_pressure", said)
        self.assertEqual(said.count("crack_fluid.inlets[].holds\n"), 1, "what holds under two types is told once")
        self.assertIn("only with type=pressure", self.said("pore_flow.boundary.top.pressure"))

    def test_finds_a_key_by_its_end_and_lists_a_section(self):
        self.assertTrue(self.said("leak_off_coefficient").startswith("crack_fluid.leak_off_coefficient\n"))
        self.assertIn("  crack_fluid.inlets[].rate: ", self.said("crack_fluid"))

    def test_lists_a_group_by_its_last_name(self):
        self.assertIn("  crack_fluid.inlets[].rate: ", self.said("inlets"))
        self.assertIn("  coupling.window.largest: ", self.said("window"))

    def test_names_what_is_near(self):
        for key, near in (("porosty", "pore_flow.porosity"), ("solid.material.young", "solid.material.youngs_modulus"),
                          ("", None), ("xyzzy", None), ("a..b", None)):
            done = perifrac("explain", key)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
            self.assertIn("expected a key of `perifrac list`", done.stderr)
            if near:
                self.assertIn("did you mean " + near, done.stderr)


class CoreLoader(yaml.SafeLoader):  # pylint: disable=too-many-ancestors
    """YAML 1.2's core schema, as editors read it."""


CoreLoader.yaml_implicit_resolvers = {}
for _tag, _pattern, _first in (
        ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"), ("int", r"[-+]?[0-9]+", "-+0123456789"),
        ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
        ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""])):  # fmt: skip
    CoreLoader.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", re.compile(f"^(?:{_pattern})$"), list(_first))
CoreLoader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value, 10))
CoreLoader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = perifrac("schema")
        schema = json.loads(done.stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        cls.schema, cls.validator = schema, jsonschema.Draft7Validator(schema)

    def errors(self, path):
        return [f"{list(e.path)}: {e.message}" for e in
                self.validator.iter_errors(yaml.load(path.read_text(encoding="utf-8"), Loader=CoreLoader))]  # fmt: skip

    def test_lies_beside_the_shipped_scenes(self):
        """`make docs` writes it."""
        committed = (ROOT / "configs/perifrac.schema.json").read_text(encoding="utf-8")
        self.assertTrue(committed == perifrac("schema").stdout, "out of date: run 'make docs'")

    def test_is_named_by_every_shipped_scene(self):
        for path in shipped_scenes():
            with self.subTest(path.name):
                first = path.read_text(encoding="utf-8").split("\n", 1)[0]
                self.assertTrue(first.startswith(SCHEMA_LINE))
                self.assertEqual((path.parent / first.removeprefix(SCHEMA_LINE)).resolve(), schema_of(path))

    def test_takes_every_shipped_scene(self):
        scenes = shipped_scenes()
        self.assertGreater(len(scenes), 55)
        for path in scenes:
            with self.subTest(path.name):
                self.assertEqual(self.errors(path), [])

    def test_refuses_what_is_wrong_by_the_catalogue(self):
        cases = list(wrong_by_the_catalogue())
        for path, said in cases:
            with self.subTest(path.name):
                self.assertNotEqual(self.errors(path), [], said)
        self.assertGreater(len(cases), 30)

    def test_says_meaning_unit_range_and_default(self):
        flow = next(c["then"] for c in self.schema["properties"]["pore_flow"]["allOf"]
                    if c["if"]["properties"]["type"]["const"] == "darcy")  # fmt: skip
        porosity = flow["properties"]["porosity"]
        self.assertIn("Range: (0, 1).", porosity["description"])
        self.assertEqual(porosity["type"], ["number", "string"])
        self.assertEqual((porosity["exclusiveMinimum"], porosity["exclusiveMaximum"]), (0.0, 1.0))
        self.assertIn("Unit: m^2.", flow["properties"]["permeability"]["description"])
        self.assertEqual(self.schema["properties"]["coupling"]["properties"]["acceleration"]["default"], "anderson")
        self.assertEqual(sorted(self.schema["required"]), ["dimension", "time"])


if __name__ == "__main__":
    unittest.main()

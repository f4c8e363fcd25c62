#!/usr/bin/python3
"""Type stubs name what the package holds, no more and no less, and all that is public says what it is.

Usage: stubs_test.py PROGRAM BUILD [unittest's arguments]
"""
import ast
import inspect
import sys
import unittest
from pathlib import Path

import perifrac
from perifrac import _perifrac

sys.argv[1:3] = []
FOLDER = Path(perifrac.__file__).parent
OF_PYBIND = {"__module__", "__doc__", "__new__", "__repr__", "__dict__", "__weakref__"}


def names_of(body):
    """Names that a stub declares, classes with theirs."""
    found = {}
    for node in body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = names_of(node.body)
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = None
        elif isinstance(node, ast.ImportFrom):
            found.update({alias.asname: None for alias in node.names if alias.asname})
    return found


class Stubs(unittest.TestCase):
    extension = names_of(ast.parse((FOLDER / "_perifrac.pyi").read_text()).body)

    def test_of_the_extension(self):
        held = {name for name in vars(_perifrac) if not name.startswith("__")}
        self.assertEqual(held, set(self.extension))
        for name, members in self.extension.items():
            if isinstance(members, dict):
                held = {member for member in vars(getattr(_perifrac, name)) if member not in OF_PYBIND}
                self.assertEqual(held - {"__init__"}, set(members) - {"__init__"}, name)

    def test_arguments_have_their_names(self):
        for name, members in self.extension.items():
            for member, node in members.items() if isinstance(members, dict) else [("", members)]:
                if node is None or member.startswith("_") and member != "__init__":
                    continue
                function = getattr(_perifrac, name) if not member else vars(getattr(_perifrac, name)).get(member)
                if not inspect.isroutine(function):
                    continue  # a property
                function = getattr(function, "__func__", function)  # of a static method
                said = (function.__doc__ or "").split("->")[0]
                for argument in [a.arg for a in node.args.args if a.arg != "self"]:
                    self.assertRegex(said, rf"\b{argument}: ", f"{name}.{member}")

    def test_of_the_package(self):
        declared = set(names_of(ast.parse((FOLDER / "__init__.pyi").read_text()).body)) - {"__version__"}
        self.assertEqual(declared, set(perifrac.__all__))
        self.assertTrue((FOLDER / "py.typed").exists())

    def test_everything_public_has_a_docstring(self):
        for name in perifrac.__all__:
            thing = getattr(perifrac, name)
            if not callable(thing):
                continue
            members = vars(thing).items() if inspect.isclass(thing) else ()
            for member, value in [("", thing), *((m, v) for m, v in members if not m.startswith("_"))]:
                if callable(value) or isinstance(value, property):
                    said = [line for line in (value.__doc__ or "").splitlines() if line.strip() and "->" not in line]
                    self.assertTrue(said, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()

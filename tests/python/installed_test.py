#!/usr/bin/python3
"""The package as `cmake --install` puts it, alone and in a virtual environment, without a network.

Usage: installed_test.py PROGRAM BUILD [unittest's arguments]
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD = Path(sys.argv.pop(2)).resolve()
sys.argv.pop(1)

PLACES = {"python": "lib/python3/dist-packages", "python_folder": "lib/python"}  # by component
CODE = """
import perifrac
simulation = perifrac.Simulation({"dimension": 2, "time": {"end": 1}, "body": {"size": [1, 1], "shape": "box",
    "spacing": 0.25}, "solid": {"type": "quasi_static", "material": {"youngs_modulus": "1 GPa", "poisson_ratio": 0},
    "boundary": {"left": {"type": "roller"}, "bottom": {"type": "roller"}}}})
simulation.run()
print(perifrac.__file__)
"""


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        for component in PLACES:
            subprocess.run(["cmake", "--install", BUILD, "--component", component, "--prefix", cls.folder / component],
                           check=True, capture_output=True)  # fmt: skip

    def run_python(self, python, **environment):
        clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run([python, "-c", CODE], capture_output=True, text=True, check=False, env=clean | environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Path(done.stdout.strip())

    def test_a_path_is_enough(self):
        for component, place in PLACES.items():
            package = self.folder / component / place
            self.assertEqual(self.run_python(sys.executable, PYTHONPATH=str(package)).parent, package / "perifrac")
            self.assertTrue((package / "perifrac/py.typed").exists())
            self.assertTrue(all(not file.is_symlink() for file in (package / "perifrac").iterdir()))

    def test_a_system_that_says_nothing_of_its_processor(self):
        """As in a chroot without /proc: the build for any processor."""
        code = "from pathlib import Path; from perifrac._instructions import _features; print(_features(Path('/nowhere')))"
        environment = os.environ | {"PYTHONPATH": str(self.folder / "python" / PLACES["python"])}
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment)
        self.assertEqual((done.returncode, done.stdout), (0, "set()\n"), done.stderr)

    def test_a_virtual_environment_with_the_systems_packages(self):
        place = self.folder / "environment"
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", place], check=True)
        (site,) = place.glob("lib/python*/site-packages")
        package = self.folder / "python" / PLACES["python"]
        (site / "perifrac.pth").write_text(f"{package}\n")
        self.assertEqual(self.run_python(place / "bin/python").parent, package / "perifrac")


if __name__ == "__main__":
    unittest.main()

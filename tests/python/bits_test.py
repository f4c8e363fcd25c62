#!/usr/bin/python3
"""A run in the process has the bits of the program: rows, frames, checkpoints, ledger.

Usage: bits_test.py PROGRAM BUILD [unittest's arguments]
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import perifrac

PROGRAM = Path(sys.argv.pop(1)).resolve()
sys.argv.pop(1)

SCENES = {
    "mandel": {"body.spacing": "4 m", "time.end": "20 s", "output.times": ["1.6533 s", "8.2665 s"]},
    "kgd_viscosity": {"body.spacing": "10 mm", "time.end": "30 ms", "output.interval": "10 ms"},
    "hf_complete": {"time.end": "1.2 ms", "output.interval": "0.6 ms", "output.history_interval": "0 s"},
    "dam_break": {"fluid.spacing": "5.715 mm", "time.end": "40 ms"},
}


def text(value):
    return "[" + ", ".join(value) + "]" if isinstance(value, list) else value


def arrays_of(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def files_of(folder):
    """Frames, and the last checkpoint: which one is kept besides depends on the clock."""
    frames = sorted(path.relative_to(folder) for path in folder.glob("frames/*.hdf"))
    return [*frames, max(folder.glob("checkpoint_*.h5"), key=lambda p: int(re.sub(r"\D", "", p.stem))).relative_to(folder)]


class Bits(unittest.TestCase):
    maxDiff = 500

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, name):
        words = [f"--set={key}={text(value)}" for key, value in SCENES[name].items()]
        output = self.folder / "program"
        done = subprocess.run(
            [PROGRAM, "run", "--example", name, *words, "--no-report", "--output", output],
            capture_output=True, text=True, check=False)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        return output

    def scene(self, name):
        scene = perifrac.Scene.example(name)
        for key, value in SCENES[name].items():
            scene[key] = value
        return scene

    def expect_same(self, one, other, restarted=False):
        self.assertEqual((one / "history.csv").read_text(), (other / "history.csv").read_text())
        files = files_of(one)
        self.assertEqual(files, files_of(other))
        for file in files:
            here, there = arrays_of(one / file), arrays_of(other / file)
            self.assertEqual(here.keys(), there.keys(), file)
            for name, values in here.items():
                np.testing.assert_array_equal(values, there[name], f"{file} {name}")
        summaries = [json.loads((folder / "summary.json").read_text()) for folder in (one, other)]
        for key in ("outcome", "ledger", "counts", "effects", "reference", "warnings", "coupling", "read", "scene"):
            if restarted and key == "counts":
                continue  # of one process
            self.assertEqual(*(without_seconds(summary.get(key)) for summary in summaries), key)

    def check(self, name):
        perifrac.Simulation(self.scene(name), output=self.folder / "python").run()
        self.expect_same(self.run_program(name), self.folder / "python")

    def test_mandel(self):
        self.check("mandel")

    def test_kgd_viscosity(self):
        self.check("kgd_viscosity")

    def test_hf_complete(self):
        self.check("hf_complete")

    def test_dam_break(self):
        self.check("dam_break")

    def test_without_files_and_side_by_side(self):
        """Two at once in one process, none of which writes, end where those end that do."""
        simulations = {name: perifrac.Simulation(self.scene(name)) for name in ("mandel", "dam_break")}
        while any([simulation.advance() for simulation in simulations.values()]):
            pass
        for name, field, points in (("mandel", "pore_pressure", "body"), ("dam_break", "fluid_pressure", "fluid")):
            with self.subTest(name):
                output = self.folder / name
                perifrac.Simulation(self.scene(name), output=output).run()
                frames = perifrac.read_run(output).frames
                last = next(series[-1] for series in frames.values() if field in series[-1])
                np.testing.assert_array_equal(simulations[name].fields[field], last[field])

    def test_the_program_goes_on_from_it(self):
        """A checkpoint of a run in the process is one of the program."""
        simulation = perifrac.Simulation(self.scene("mandel"), output=self.folder / "python")
        while simulation.step < 60:
            simulation.advance()
        simulation.close()
        checkpoint = max((self.folder / "python").glob("checkpoint_*.h5"), key=lambda p: int(re.sub(r"\D", "", p.stem)))
        words = [f"--set={key}={text(value)}" for key, value in SCENES["mandel"].items()]
        done = subprocess.run(
            [PROGRAM, "run", perifrac.Scene.example("mandel").name, *words, "--no-report", "--restart", checkpoint],
            capture_output=True, text=True, check=False)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_same(self.run_program("mandel"), self.folder / "python", restarted=True)


def without_seconds(value):
    """What depends on the machine's speed, left out."""
    if isinstance(value, dict):
        return {k: without_seconds(v) for k, v in value.items() if "seconds" not in k and "share" not in k}
    return [without_seconds(v) for v in value] if isinstance(value, list) else value


if __name__ == "__main__":
    unittest.main()

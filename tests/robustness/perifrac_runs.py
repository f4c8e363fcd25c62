"""What the robustness tests share: running the program, and comparing what runs leave behind."""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py

HERE = Path(__file__).resolve().parent
MANDEL = HERE.parents[1] / "configs" / "mandel.yaml"

# Mandel's problem, small: frames every 2 s; past the fast start a window is 0.5 s.
SMALL = {"body.spacing": "2 m", "output.times": "[2 s, 5 s, 9 s]", "output.checkpoint_interval": "0 s",
         "time.end": "20 s"}

# What the scenes of the other modules have that Mandel's has not: (scene, keys).
CONFIGS = MANDEL.parent
VARIANTS = {
    "dynamic": (CONFIGS / "mandel_dynamic.yaml", {}),
    "the paper's, in windows of one step": (CONFIGS / "paper" / "mandel.yaml", {"output.history_interval": "0 s"}),
    "layers": (CONFIGS / "mandel_layers.yaml", {}),
    "nested, smoothed": (MANDEL, {"pore_flow.operator": "nested", "pore_flow.integrator.type": "explicit",
                                  "ledger.mass_error": "10"}),
    "tait, explicit": (CONFIGS / "aquifer.yaml", {"pore_flow.fluid.equation_of_state": "tait",
                                                  "pore_flow.integrator.type": "explicit"}),
    "tait, cvode": (CONFIGS / "aquifer.yaml", {"pore_flow.fluid.equation_of_state": "tait"}),
    "irregular": (MANDEL, {"body.jitter": "0.2"}),
    "finite volumes": (CONFIGS / "aquifer.yaml", {"pore_flow.type": "finite_volume",
                                                  "pore_flow.integrator.type": "explicit"}),
    "finite volumes, irregular": (MANDEL, {"pore_flow.type": "finite_volume", "body.jitter": "0.2"}),
    "ball": (CONFIGS / "cryer.yaml", {}),
}

# Points that move, come and go: split, made, removed at an outlet, lost, merged.
FLUIDS = {"tank": HERE / "tank.yaml", "seeping pool": HERE / "seeping_pool.yaml"}
METHODS = ("semi_lagrangian", "sph")


# A program that takes longer hangs [s]; no run here takes a hundredth of it, on a machine that is not busy.
PATIENCE = 900.0


def _read_arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--times", type=int, default=0, help="repetitions; 0: few enough to be quick")
    arguments, rest = parser.parse_known_args()
    sys.argv[1:] = rest  # what is left is for unittest
    return os.path.abspath(arguments.perifrac), arguments.times


PERIFRAC, TIMES = _read_arguments()


def settings(keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


def run_command(scene, keys, folder, *options):
    return [PERIFRAC, "run", str(scene), "--no-report", "--output", str(folder), *settings(keys), *options]


def perifrac(*arguments, **options):
    """Runs the program to its end; gives exit code, stdout and stderr."""
    return subprocess.run([PERIFRAC, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE, **options)


def checkpoints(folder):
    """The checkpoints in a folder, the latest last."""
    return sorted(Path(folder).glob("checkpoint_*.h5"))


def datasets(file):
    """Every dataset and attribute of an HDF5 file, as bytes."""
    content = {}
    with h5py.File(file, "r") as opened:
        def note(name, node):
            for key, value in node.attrs.items():
                content[f"{name}@{key}"] = value.tobytes() if hasattr(value, "tobytes") else value
            if isinstance(node, h5py.Dataset):
                content[name] = (node.shape, str(node.dtype), node[()].tobytes())
        opened.visititems(note)
    return content


def listed_frames(folder):
    """(time, path) of all frames that ParaView is told of."""
    frames = []
    for series in sorted(Path(folder, "frames").glob("*.hdf.series")):
        for entry in json.loads(series.read_text())["files"]:
            frames.append((entry["time"], series.parent / entry["name"]))
    return frames


class RunTest(unittest.TestCase):
    """A test case with a folder of its own, in which the program runs."""

    maxDiff = 2000

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def run_scene(self, keys, folder, *options, scene=MANDEL, code=0, **subprocess_options):
        done = subprocess.run(run_command(scene, keys, self.folder / folder, *options), capture_output=True,
                              text=True, timeout=PATIENCE, cwd=self.folder, **subprocess_options)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return self.folder / folder

    def assert_same_frames(self, one, other):
        first, second = listed_frames(one), listed_frames(other)
        self.assertEqual([time for time, _ in first], [time for time, _ in second])
        self.assertGreater(len(first), 1)
        for (time, file), (_, other_file) in zip(first, second):
            # Not assertEqual: it would print megabytes.
            self.assertTrue(datasets(file) == datasets(other_file), f"frames at {time} s differ")

    def assert_same_history(self, one, other):
        first, second = (Path(folder, "history.csv").read_text().splitlines() for folder in (one, other))
        self.assertGreater(len(first), 2)
        for row, (line, other_line) in enumerate(zip(first, second)):
            self.assertEqual(line, other_line, f"row {row}")
        self.assertEqual(len(first), len(second))

    def assert_same_checkpoint(self, one, other):
        self.assertEqual(one.name, other.name)
        first, second = datasets(one), datasets(other)
        self.assertEqual(first.keys(), second.keys())
        self.assertEqual([name for name in first if first[name] != second[name]], [])

    def assert_same_results(self, one, other):
        """All that two runs left is the same, bit for bit, except what tells of this computer."""
        self.assert_same_frames(one, other)
        self.assert_same_history(one, other)
        self.assert_same_checkpoint(checkpoints(one)[-1], checkpoints(other)[-1])
        first, second = (json.loads(Path(folder, "summary.json").read_text()) for folder in (one, other))
        self.assertEqual(first.keys(), second.keys())
        for part in ("time", "outcome", "ledger", "reference"):
            self.assertTrue(first.get(part) == second.get(part), f"{part} in summary.json differs")
        self.assert_no_remains(one)
        self.assert_no_remains(other)

    def assert_no_remains(self, folder):
        """No half-written file, no frame that the list does not name."""
        self.assertEqual(list(Path(folder).rglob("*.tmp")), [])
        self.assertEqual(sorted(Path(folder, "frames").glob("*.hdf")), sorted(file for _, file in listed_frames(folder)))

    def assert_refused(self, done, *words):
        """Exit 2, one line on stderr that holds the words, nothing on stdout."""
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for word in words:
            self.assertIn(word, done.stderr)

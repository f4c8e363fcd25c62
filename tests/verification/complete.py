#!/usr/bin/python3
"""configs/hf_complete.yaml, coarse: free fluid, crack, pores and rock exchange at every wet surface.

Usage: complete.py PERIFRAC
"""
import csv
import json
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "robustness"))
from perifrac_runs import CONFIGS, RunTest, checkpoints, run_command  # noqa: E402

SCENE = CONFIGS / "hf_complete.yaml"
COARSE = {"body.spacing": "4 mm", "time.end": "30 ms", "output.interval": "5 ms", "output.history_interval": "0 s",
          "output.checkpoint_interval": "0 s"}
DYNAMIC = COARSE | {"solid.type": "dynamic", "solid.damping": "5000 1/s", "coupling": "{iterations: {max: 1}}", "time.end": "2 ms",
                    "output.interval": "0.5 ms"}
SHARES = ("exchanged_mass_from_fluid", "exchanged_mass_from_crack_fluid")


def history(folder):
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [{name.split(" [")[0]: float(value) for name, value in row.items() if value} for row in rows]


class Complete(RunTest):
    def assert_books_close(self, folder, energy):
        ledger = json.loads((folder / "summary.json").read_text())["ledger"]
        self.assertLessEqual(ledger["mass_error"], 1e-12)
        self.assertLessEqual(ledger["energy_error"], energy)
        rows = history(folder)
        last = rows[-1]
        self.assertGreater(last[SHARES[0]], 1e-7)
        self.assertGreater(abs(last[SHARES[1]]), 1e-7)
        self.assertGreater(last["mass_given_to_cracks"], 1e-7)
        # What the pores hold is what both brought; what leaked is what the crack brought.
        brought = sum(last[share] for share in SHARES)
        self.assertAlmostEqual(last["pore_fluid_mass"] - rows[0]["pore_fluid_mass"], brought, delta=1e-9 * brought)
        self.assertAlmostEqual(-last["leaked_crack_fluid_mass"], last[SHARES[1]], delta=1e-9 * brought)
        return rows

    def test_books_close_in_equilibrium(self):
        # Settled windows: in those of 3e-3 events fall elsewhere with other rounding, and 0.7 to 1.3 % are open.
        keys = COARSE | {"coupling.iterations.tolerance": "1e-4"}
        rows = self.assert_books_close(self.run_scene(keys, "run", "--threads", "1", scene=SCENE), energy=0.01)
        self.assertGreater(rows[-1][SHARES[1]], 1e-5)
        self.assertGreater(rows[-1]["crack_length"], rows[0]["crack_length"])

    def test_books_close_with_inertia(self):
        self.assert_books_close(self.run_scene(DYNAMIC, "run", "--threads", "1", scene=SCENE), energy=0.0145)

    def test_goes_on_bit_for_bit_after_a_kill_on_other_threads(self):
        keys = COARSE | {"time.end": "8 ms", "output.interval": "1 ms"}
        whole = self.run_scene(keys, "whole", "--threads", "1", scene=SCENE)
        killed = self.folder / "killed"
        process = subprocess.Popen(run_command(SCENE, keys, killed, "--threads", "2"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while len(list(killed.glob("frames/body_*.hdf"))) < 4:
            self.assertIsNone(process.poll(), "the run ended by itself")
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.run_scene(keys, "killed", "--threads", "2", "--restart", str(checkpoints(killed)[-1]), scene=SCENE)
        self.assert_same_results(whole, killed)


if __name__ == "__main__":
    unittest.main()

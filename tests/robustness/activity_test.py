#!/usr/bin/python3
"""Work is done where something happens, as `run --profile` counts it: pore flow puts its matrix together anew in
windows in which bonds broke, and in no other."""
import sys
import unittest
from pathlib import Path

from perifrac_runs import PERIFRAC, RunTest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "effects"))
import effects  # noqa: E402

BODY = {"body.spacing": "5 mm", **effects.STRETCH, **effects.PORES, "pore_flow.integrator.type": "cvode",
        "output.history_interval": "0 s"}


class Activity(RunTest):
    def windows(self, keys):
        """Calls of every part of pore flow after the set-up, and the windows in which bonds broke."""
        summary = effects.run(PERIFRAC, effects.BODY, {**BODY, **keys}, self.folder / "run")
        part = next(part for part in summary["profile"]["parts"] if part["name"] == "pore_flow")
        calls = {inner["name"]: inner["calls"] for inner in part.get("parts", [])}
        header, *rows = (self.folder / "run" / "history.csv").read_text().splitlines()
        column = [name.split(" [")[0] for name in header.split(",")].index("fracture_energy")
        energies = [float(row.split(",")[column]) for row in rows]
        broke = sum(after != before for before, after in zip(energies, energies[1:]))
        return calls, broke, summary["counts"]["windows"]

    def test_pore_flow_is_put_together_where_bonds_broke(self):
        calls, broke, windows = self.windows({"damage.stretch": "4e-5"})
        self.assertGreater(broke, 2)
        self.assertLess(broke, 0.6 * windows)
        for part in ("broken bonds", "assembly"):
            self.assertIn(calls[part], (broke - 1, broke))  # what broke in the last window, nobody followed

    def test_and_never_where_none_did(self):
        calls, broke, windows = self.windows({})
        self.assertEqual(broke, 0)
        self.assertGreater(windows, 20)
        self.assertNotIn("assembly", calls)
        self.assertNotIn("broken bonds", calls)
        self.assertGreater(calls["solves"], 20)


if __name__ == "__main__":
    unittest.main()

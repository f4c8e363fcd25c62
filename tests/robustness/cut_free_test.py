#!/usr/bin/python3
"""Cracks that cut a piece of rock free which nothing holds end a run with exit code 1 and the piece's place.

With `--times N` N more cracks, from anywhere on the body's upper faces, are let grow (`make sanitize` does).
"""
import json
import random
import unittest

from perifrac_runs import CONFIGS, TIMES, RunTest, perifrac, settings

# Of hf_storage at 5 mm: the crack's path [mm], its fracture energy [J/m^2], the rate [m^2/s]. Such wrote out of bounds
# once, or went on without a word.
VARIANTS = [
    ([50, 200, 50, 150], 50, 1e-3),
    ([100, 200, 60, 175], 0.5, 1.6e-4),
    ([20, 200, 85, 130], 5, 1.6e-4),
    ([0, 175, 13.5, 190], 2, 5e-4),
]


class CutFree(RunTest):
    def run_variant(self, path, energy, rate, folder):
        keys = {"body.spacing": "5 mm", "cracks[0].path": "[" + ", ".join(f"{x} mm" for x in path) + "]",
                "crack_fluid.inlets[0].at": f"[{path[0]} mm, {path[1]} mm]",
                "damage.fracture_energy": f"{energy} J/m^2", "crack_fluid.inlets[0].rate": f"{rate} m^2/s",
                "time.end": "0.4 s"}
        return perifrac("run", CONFIGS / "hf_storage.yaml", "--no-report", "--threads", 1, "--output", folder,
                        *settings(keys))

    def test_says_which_piece_came_free(self):
        for number, variant in enumerate(VARIANTS):
            folder = self.folder / str(number)
            with self.subTest(variant=variant):
                done = self.run_variant(*variant, folder)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr, r"error: cracks (cut a piece free that nothing holds.*at a piece of \d+ "
                                              r"points, from \(.*\) to \(.*\) m|leave a piece too thin to bear anything"
                                              r".*at point \d+ at \(.*\) m), t = \S+ s\n")
                # No shorter window would help.
                self.assertNotRegex(done.stderr, r"is cut from.*(nothing holds|too thin)")
                summary = json.loads((folder / "summary.json").read_text())
                self.assertEqual(summary["outcome"], "failed")
                self.assertLess(summary["ledger"]["mass_error"], 1e-12)

    def test_any_crack_ends_in_order(self):
        """Some cut a piece free, some grow to a face, some are refused."""
        seeded = random.Random(20)
        for number in range(TIMES):
            start = seeded.choice([[0, seeded.randint(30, 39) * 5], [150, seeded.randint(30, 39) * 5],
                                   [seeded.randint(1, 29) * 5, 200]])
            end = [seeded.randint(4, 26) * 5, seeded.randint(24, 38) * 5]
            variant = (start + end, seeded.choice([0.5, 2, 5, 50]), seeded.choice([1.6e-4, 5e-4, 1e-3]))
            with self.subTest(variant=variant):
                done = self.run_variant(*variant, self.folder / f"any_{number}")
                self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                self.assertNotRegex(done.stderr, "Sanitizer|runtime error|Assertion")
                if done.returncode == 1:
                    self.assertIn("error: ", done.stderr)


if __name__ == "__main__":
    unittest.main()

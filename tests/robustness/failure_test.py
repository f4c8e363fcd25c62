#!/usr/bin/python3
"""A run that fails says why where people look: log, summary, page, picture and the last frame."""
import json
import re
import unittest

from perifrac_runs import MANDEL, RunTest, SMALL, checkpoints, listed_frames, perifrac, settings

# What is pumped in grows from window to window, until nothing is left of the balance of energy after the frames at 0
# and 2 s.
LATE = SMALL | {"coupling.split": "drained", "pore_flow.integrator.type": "explicit", "time.end": "1000 s",
                "output.interval": "900 s", "output.times": "[2 s]"}


class Failures(RunTest):
    def run_that_fails(self, scene, keys, *options):
        done = perifrac("run", scene, "--output", self.folder / "run", *settings(keys), *options)
        self.assertEqual(done.returncode, 1, done.stderr)
        summary = json.loads((self.folder / "run" / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "failed")
        line = next(line for line in done.stderr.splitlines() if " error: " in line)
        return summary, line.split(" error: ")[1], done.stderr

    def test_says_what_where_when_and_what_to_change(self):
        summary, said, log = self.run_that_fails(MANDEL, LATE)
        failure = summary["failure"]
        self.assertEqual(f"{failure['error']}; {failure['advice']}", said)
        for key in ("field", "place"):
            self.assertIn(failure[key], failure["error"])
        self.assertGreater(failure["time"]["value"], 2.0)
        self.assertIn("coupling.iterations.max", failure["advice"])
        # What the run warned of on its way is there too.
        warnings = re.findall("^.* warning: (.*)$", log, re.MULTILINE)
        self.assertEqual(summary["warnings"], [w for w in warnings if "no report" not in w])
        self.assertTrue(any("drained" in warning for warning in warnings))
        page = (self.folder / "run" / "report.html").read_text()
        for words in ("Why it failed", failure["place"], "To change: ", "<h2 id=\"warnings-title\">"):
            self.assertIn(words, page)
        self.assertTrue((self.folder / "run" / "report.png").read_bytes().startswith(b"\x89PNG"))

    def test_windows_that_are_not_stable_end_a_run_whose_balance_is_lost(self):
        """Pressures had come to 1e18 times what is right, with exit code 0."""
        summary, said, _ = self.run_that_fails(MANDEL, LATE, "--no-report")
        self.assertRegex(said, r"^windows of one pass are not stable: the balance is \d+ % open in energy at the ledger")
        self.assertIn("leave `coupling.iterations.max`", summary["failure"]["advice"])

    def test_leaves_a_frame_of_the_moment(self):
        summary, _, _ = self.run_that_fails(MANDEL, LATE, "--no-report")
        times = [time for time, _ in listed_frames(self.folder / "run")]
        self.assertEqual(times[:2], [0.0, 2.0])
        self.assertEqual(times[2:], [summary["time"]["value"]])
        # A run that goes on from the checkpoint before drops it, and comes to the same end.
        last = checkpoints(self.folder / "run")[-1]
        self.run_that_fails(MANDEL, LATE, "--no-report", "--restart", last)
        self.assertEqual([time for time, _ in listed_frames(self.folder / "run")], times)
        self.assert_no_remains(self.folder / "run")

    def test_a_window_that_fails_is_taken_back(self):
        """What is shown is the state before it, not a pass of it that led nowhere."""
        wild = SMALL | {"coupling.split": "drained", "coupling.iterations.max": "3", "coupling.window.retries": "2",
                        "pore_flow.fluid.bulk_modulus": "200 GPa"}
        summary, _, _ = self.run_that_fails(MANDEL, wild, "--no-report")
        self.assertIn("the coupling does not converge", summary["failure"]["error"])
        self.assertIn("coupling.split: automatic", summary["failure"]["advice"])
        self.assertEqual(summary["coupling"]["window_cuts"], 2)
        self.assertLess(summary["ledger"]["mass_error"], 1e-9)


if __name__ == "__main__":
    unittest.main()

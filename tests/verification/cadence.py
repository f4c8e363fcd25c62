#!/usr/bin/python3
"""Holds what outputs and windows change to what was measured, within a half of it, and prints it.

Usage: cadence.py PERIFRAC

A crack that fluid drives: when it has crossed each facet, over the time from one to the next, and the
inlet's pressure in its mean over the run. Pores that CVODE drains: the pressure in the middle.
"""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PERIFRAC = os.path.abspath(sys.argv.pop(1))


def run(scene, keys):
    """history.csv as columns by name."""
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PERIFRAC, "run", os.path.join(ROOT, "configs", scene + ".yaml"), "--no-report", "--threads", "1",
                        "--output", folder, *settings], check=True, capture_output=True)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
    return {name.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def crack(output, window):
    """When facets were crossed [s], and the mean inlet pressure [Pa], of hf_storage at 5 mm; output and window in ms."""
    history = run("hf_storage", {"body.spacing": "5 mm", "output.interval": f"{output} ms", "output.history_interval": "0 s",
                                 "coupling.window.largest": f"{window} ms"})
    time, length, pressure = (history[name] for name in ("time", "crack_length", "inlet_notch_pressure"))
    growths = []
    for s, t, before, after in zip(time, time[1:], length, length[1:]):
        next_one = length[0] + 5e-3 * (len(growths) + 1)
        if before < next_one <= after:
            growths.append(s + (t - s) * (next_one - before) / (after - before))
    work = sum(0.5 * (p + q) * (t - s) for s, t, p, q in zip(time, time[1:], pressure, pressure[1:]))
    return growths, work / time[-1]


def shifts(growths, others):
    """How far the steps of two runs are apart, over the time from one to the next."""
    step = (growths[-1] - growths[0]) / (len(growths) - 1)
    return [abs(one - other) / step for one, other in zip(growths, others)]


class Cadence(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shipped = crack(100, 0.5)

    def test_outputs_do_not_move_a_crack(self):
        growths, pressure = crack(5, 0.5)
        self.assertEqual(len(growths), len(self.shipped[0]))
        apart = shifts(self.shipped[0], growths)
        largest, mean, change = max(apart), sum(apart) / len(apart), abs(pressure / self.shipped[1] - 1.0)
        print(f"\noutputs of 5 ms in place of 100 ms: steps apart by {largest:.3f} at most, {mean:.4f} in the mean, "
              f"mean pressure by {change:.1e}")
        self.assertLessEqual(largest, 0.012)
        self.assertLessEqual(mean, 0.0024)

    def test_windows_are_of_first_order_for_a_crack(self):
        growths, fine = crack(100, 0.125)
        errors = {}
        for window in (1.0, 0.5, 0.25):
            others, pressure = self.shipped if window == 0.5 else crack(100, window)
            self.assertEqual(len(others), len(growths))
            apart = shifts(growths, others)
            errors[window] = abs(pressure / fine - 1.0)
            print(f"\nwindows of {window} ms beside 0.125 ms: steps apart by {max(apart):.3f} at most, "
                  f"{sum(apart) / len(apart):.4f} in the mean, mean pressure by {errors[window]:.1e}", end="")
        print()
        self.assertGreater(errors[0.5], errors[0.25])
        self.assertGreater(errors[1.0], errors[0.5])
        self.assertGreater(errors[1.0] / errors[0.25], 3.3)

    def test_outputs_do_not_wear_out_cvode(self):
        probe = "probes: [{name: middle, at: [0 m, 0 m], field: pore_pressure}]"
        keys = {"body.spacing": "2 m", "time.end": "50 s", "coupling.window": "{first: 0.5 s, growth: 1, largest: 0.5 s}",
                "output.history_interval": "0 s"}
        none, all_windows = (run("mandel", keys | {"output": f"{{interval: {interval} s, {probe}}}"})["pore_pressure at middle"]
                             for interval in (50, 0.5))
        self.assertEqual(len(none), len(all_windows))
        change = max(abs(one - other) for one, other in zip(none, all_windows)) / max(none)
        print(f"\nan output a window in place of none: pressure by {change:.1e} of its largest")
        self.assertLessEqual(change, 3.7e-5)


if __name__ == "__main__":
    unittest.main()

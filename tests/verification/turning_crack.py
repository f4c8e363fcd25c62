#!/usr/bin/python3
"""Oblique notches that fluid drives between unequal stresses, held to displacement discontinuities.

Usage: turning_crack.py PERIFRAC [SPACING...]

The notch of inclined_crack.yaml in a body of 6 m, at spacings of 50 mm, a fifth of its half length, or of those given
[mm]: the pressure at which its tips first go on, that beyond the stress across them until the crack is 1.8 times as
long, and where the tips go, against tests/references/turning_crack.py.
"""
import csv
import glob
import math
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "references"))
import turning_crack as reference  # noqa: E402

PERIFRAC = os.path.abspath(sys.argv.pop(1))
SPACINGS = [float(sys.argv.pop(1)) for _ in sys.argv[1:] if sys.argv[1][0].isdigit()] or [50.0]
STRESS, TOUGHNESS, HALF_LENGTH = (6e6, 5e6), 0.6535e6, 0.25  # Pa, Pa m^0.5, m
ANGLES = (0.0, 10.0, 20.0, 30.0, 45.0, 50.0)  # degrees; beyond, notches kink by more than 60 at once


def run(angle, spacing):
    """history.csv as columns by name, and middles of the facets in the end, from the middle of the crack [m]."""
    x, y = (1000.0 * HALF_LENGTH * part(math.radians(angle)) for part in (math.cos, math.sin))
    at = 3000.0 + 0.5 * spacing  # else points lie on a notch at 45 degrees
    keys = {"body.size": "[6 m, 6 m]", "body.spacing": f"{spacing} mm", "crack_fluid.inlets[0].at": f"[{at} mm, 3 m]",
            "cracks[0].path": f"[{at - x} mm, {3000 - y} mm, {at + x} mm, {3000 + y} mm]",
            "crack_fluid.inlets[0].rate": "1e-8 m^2/s", "time.end": "3600 s", "coupling.window.largest": "40 s"}
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PERIFRAC, "run", os.path.join(HERE, "inclined_crack.yaml"), "--no-report", "--threads", "1",
                        "--output", folder, *settings], check=True, capture_output=True)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
        with h5py.File(sorted(glob.glob(os.path.join(folder, "frames", "crack_*.hdf")))[-1]) as file:
            middles = file["VTKHDF/Points"][:, :2] - (1e-3 * at, 3.0)
    history = {name.split(" [")[0]: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}
    return history, middles


class Turned:
    """A run beside its reference: first growth, net pressures over the reference's, places aside of it [spacings]."""

    def __init__(self, angle, spacing):
        history, middles = run(angle, spacing)
        half, pressure = 0.5 * history["crack_length"], history["inlet_well_pressure"]
        path = np.array(reference.march(math.radians(angle), STRESS, TOUGHNESS, HALF_LENGTH, 0.55))
        begin = int(np.argmax(half > half[0] + 1e-6))
        self.first = max(pressure[:begin + 1]) / path[0, 1]
        self.farthest = half[-1]
        known = [k for k in range(begin, len(half)) if half[k] < min(1.8 * HALF_LENGTH, path[-1, 0])]
        self.net = (pressure[known] - STRESS[1]) / (np.interp(half[known], path[:, 0], path[:, 1]) - STRESS[1])
        aside = [(y - np.interp(x, path[:, 2], path[:, 3])) / (1e-3 * spacing)
                 for sign in (1, -1) for x, y in sign * middles[np.sign(middles[:, 0]) == sign]
                 if math.hypot(x, y) > HALF_LENGTH + 3e-4 * spacing and x < min(0.42, path[-1, 2])]
        self.aside = max(np.abs(aside))
        print(f"\n{angle:g} degrees, {spacing:g} mm: first growth {self.first:.4f}, net pressure {self.net.mean():.3f}, "
              f"at most {self.net.max():.3f}, of the reference; {self.aside:.2f} spacings aside")


class TurningCrack(unittest.TestCase):
    def test_goes_on_where_and_at_what_pressure_the_reference_does(self):
        for angle in ANGLES:
            for spacing in SPACINGS:
                with self.subTest(angle=angle, spacing=spacing):
                    turned = Turned(angle, spacing)
                    self.assertGreater(turned.farthest, 1.8 * HALF_LENGTH)
                    self.assertAlmostEqual(turned.first, 1.0, delta=0.008)
                    self.assertAlmostEqual(turned.net.mean(), 1.0, delta=0.066)
                    self.assertLess(turned.aside, 0.9)


if __name__ == "__main__":
    unittest.main()

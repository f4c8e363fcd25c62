#!/usr/bin/python3
"""Cracks that fluid drives across the rows of points, between stresses that shear them.

Usage: inclined_crack.py PERIFRAC
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

HERE = os.path.dirname(os.path.abspath(__file__))
PERIFRAC = os.path.abspath(sys.argv.pop(1))
TOUGHNESS, HALF_LENGTH = 0.6535e6, 0.25  # Pa m^0.5, m


def run(keys):
    """history.csv as columns by name."""
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PERIFRAC, "run", os.path.join(HERE, "inclined_crack.yaml"), "--no-report", "--threads", "1",
                        "--output", folder, *settings], check=True, capture_output=True)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
    return {name.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def run_notch(spacing):
    """A notch 20 degrees off the largest stress: history.csv's last row, and the middles of the facets beyond it."""
    keys = {"body.spacing": spacing, "cracks[0].path": "[75 mm, 200 mm, 80 mm, 186 mm]",
            "solid.confining_stress": "[0.9 MPa, 5.567 MPa]", "crack_fluid.bulk_modulus": "0.208 GPa",
            "time.end": "60 ms"}
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    scene = os.path.join(HERE, "..", "..", "configs", "hf_leakoff_stiff_water.yaml")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PERIFRAC, "run", scene, "--no-report", "--threads", "1", "--output", folder, *settings],
                       check=True, capture_output=True)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        with h5py.File(sorted(glob.glob(os.path.join(folder, "frames", "crack_*.hdf")))[-1]) as file:
            middles = file["VTKHDF/Points"][:, :2].tolist()
    return {name.split(" [")[0]: float(value) for name, value in last.items()}, [p for p in middles if p[1] < 0.186]


def hoop_intensity(opening, sliding):
    """K_I of the crack that turns to the largest hoop stress (Erdogan & Sih 1963), found by trying angles."""
    angles = (math.radians(0.1 * k) for k in range(-1800, 1801))
    return max(math.cos(a / 2) * (opening * math.cos(a / 2) ** 2 - 1.5 * sliding * math.sin(a)) for a in angles)


def pressure_of_first_growth(normal, shear):
    """In the crack in an infinite body under these stresses across and along it [Pa]."""
    low, high = normal, normal + TOUGHNESS / math.sqrt(math.pi * HALF_LENGTH)
    root = math.sqrt(math.pi * HALF_LENGTH)
    for _ in range(50):
        middle = 0.5 * (low + high)
        grows = hoop_intensity((middle - normal) * root, shear * root) > TOUGHNESS
        low, high = (low, middle) if grows else (middle, high)
    return low


class InclinedCrack(unittest.TestCase):
    def test_begins_to_grow_where_hoop_stress_says(self):
        """Points on the notch, in rows beside it, and neither. It is closed at first, and fills. In the scene's body of 2 m
        K is 3 % lower than without its faces."""
        exact = pressure_of_first_growth(5.5e6, 0.5e6)
        half = 1000.0 * HALF_LENGTH * math.sqrt(0.5)
        for x, y in ((3000.0, 3000.0), (3025.0, 3000.0), (3020.0, 3010.0)):
            history = run({"cracks[0].path": f"[{x - half} mm, {y - half} mm, {x + half} mm, {y + half} mm]",
                           "crack_fluid.inlets[0].at": f"[{x} mm, {y} mm]", "body.size": "[6 m, 6 m]",
                           "crack_fluid.inlets[0].rate": "1e-8 m^2/s", "time.end": "800 s",
                           "coupling.window.largest": "10 s"})
            length, pressure = history["crack_length"], history["inlet_well_pressure"]
            first = next((k for k, after in enumerate(length) if after > length[0] + 1e-6), None)
            self.assertIsNotNone(first, "it never goes on")
            highest = max(pressure[:first + 1])
            print(f"\nfirst growth at {highest / 1e6:.4f} MPa, largest hoop stress {exact / 1e6:.4f} MPa")
            self.assertAlmostEqual(highest / exact, 1.0, delta=0.0083)
            self.assertGreater(length[-1], 2.0 * HALF_LENGTH + 0.049)

    def test_follows_the_largest_stress_without_swinging(self):
        """(K_IC / difference of the stresses)^2, over which the stress turns a crack, is a sixth of the coarse spacing.
        The first facets, at 12 to 19 to the notch, are those that know least of their direction."""
        found = {}
        for spacing in ("2.5 mm", "1.25 mm"):
            found[spacing], path = run_notch(spacing)
            angles = [math.degrees(math.atan2(b[0] - a[0], a[1] - b[1])) for a, b in zip(path, path[1:])]
            turns = [abs(b - a) for a, b in zip(angles, angles[1:])]
            print(f"\n{spacing}: inlet at {found[spacing]['inlet_notch_pressure'] / 1e6:.4f} MPa, turns of at most "
                  f"{max(turns):.1f} degrees, {max(turns[len(turns) // 2:]):.1f} in the second half, "
                  f"{angles[-1]:.1f} degrees off the largest stress in the end")
            self.assertLess(max(turns), 25.0)
            self.assertLess(max(turns[len(turns) // 2:]), 3.0)
            self.assertLess(abs(angles[-1]), 2.0)
        for figure in ("inlet_notch_pressure", "crack_length", "leak_off_volume"):
            self.assertAlmostEqual(found["2.5 mm"][figure] / found["1.25 mm"][figure], 1.0, delta=0.022, msg=figure)

    def test_asks_for_one_pressure_at_any_angle(self):
        means = {}
        for angle in (0.0, 26.565, 45.0):
            x, y = 100.0 * math.cos(math.radians(angle)), 100.0 * math.sin(math.radians(angle))
            history = run({"body.spacing": "20 mm", "solid.confining_stress": "[5 MPa, 5 MPa]",
                           "cracks[0].path": f"[{1000 - x} mm, {1000 - y} mm, {1000 + x} mm, {1000 + y} mm]",
                           "crack_fluid.inlets[0].rate": "5.22e-7 m^2/s",  # K_m = 4.2
                           "time.end": "24 s", "coupling.window.largest": "0.5 s", "output.interval": "24 s"})
            columns = (history[name] for name in ("time", "crack_length", "inlet_well_pressure"))
            time, length, pressure = columns
            spans = [(b - a, 0.5 * (p + q) - 5e6)
                     for a, b, at, p, q in zip(time, time[1:], length[1:], pressure, pressure[1:]) if at > 0.22]
            means[angle] = sum(dt * p for dt, p in spans) / sum(dt for dt, _ in spans)
            print(f"\n{angle} degrees: mean net pressure {means[angle] / 1e6:.4f} MPa, length {length[-1]:.3f} m")
        for angle, mean in means.items():
            self.assertAlmostEqual(mean / means[0.0], 1.0, delta=0.03, msg=angle)


if __name__ == "__main__":
    unittest.main()

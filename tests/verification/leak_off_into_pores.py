#!/usr/bin/python3
"""Leak-off into pores against diffusion in the plane under the same pressures (tests/references/leak_off.py).

Usage: leak_off_into_pores.py PERIFRAC
"""
import csv
import io
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PERIFRAC = os.path.abspath(sys.argv.pop(1))


class LeakOffIntoPores(unittest.TestCase):
    def test_is_what_diffusion_in_the_plane_takes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PERIFRAC, "run", os.path.join(ROOT, "configs", "hf_leakoff_pores.yaml"), "--no-report",
                            "--output", folder, "--set", "output.interval=1 ms"], check=True, capture_output=True)
            rock = {"young": "4e9", "permeability": "1.02e-14", "bulk-modulus": "22e6"}
            words = [word for key, value in rock.items() for word in ("--" + key, value)]
            done = subprocess.run(["/usr/bin/python3", "-B", os.path.join(ROOT, "tests", "references", "leak_off.py"), folder,
                                   "--facet", "1e-3", "--cell", "5e-4", "--sealed", "0.014", "--closing", "0.9e6", *words],
                                  check=True, capture_output=True, text=True)
        for row in csv.DictReader(io.StringIO(done.stdout)):
            time, ratio = float(row["time"]), float(row["run_over_plane"])
            if time >= 0.0499:
                self.assertAlmostEqual(ratio, 1.0, delta=0.05, msg=row)
            elif time >= 0.0199:  # the front is 6 points deep
                self.assertAlmostEqual(ratio, 1.0, delta=0.12, msg=row)


if __name__ == "__main__":
    unittest.main()

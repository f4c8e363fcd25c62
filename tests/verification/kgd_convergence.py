#!/usr/bin/python3
"""KGD from viscosity to toughness: errors against the self-similar solution fall with the facets.

Usage: kgd_convergence.py PERIFRAC [--facets N ...] [--regimes K_m ...]

A wing from the axis of symmetry, by the rock and rate of configs/kgd_mixed.yaml; K_m is set by the
viscosity. The stress at rest is 30 MPa, so that no tip is dry, and the fluid as good as
incompressible; a window is an eighth of the time that the last facet takes. Means over growth from
0.75 to 0.95 of the facets of half the length, in %: length, net pressure, opening at the inlet; how
far pressure swings from t^(-1/3); the energy that is left open. Faces that hold the body add
0.179 E' V / h^2 to the pressure, where h is its length and half its height and V the volume of both
wings: that is taken off. Pressure and opening are those in the middle of the facet at the inlet.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

# gamma, Omega, Pi at the inlet, by tests/references/kgd.py
SOLUTION = {
    0.1: (0.61542, 1.12563, 0.54484), 0.3: (0.61504, 1.12595, 0.54506), 1.0: (0.59930, 1.14132, 0.55582),
    3.0: (0.43427, 1.48172, 0.87677), 10.0: (0.20082, 3.17046, 3.94803),
}  # fmt: skip
SPACING, RATE, MODULUS, REST = 5e-3, 1.6e-4, 700e6 / (1 - 0.25**2), 30e6  # m, m^2/s, Pa, Pa
TOUGHNESS = (32 / 3.141592653589793 * MODULUS * 5.0) ** 0.5  # K' [Pa m^0.5]
SIZE, HELD = 8, 0.179  # of the body, in half lengths; what its faces add
# Largest errors of length, pressure, opening; swing of pressure; energy left open. By facets.
BOUNDS = {10: (3.5, 3.4, 1.5, 2.5, 0.002), 20: (0.86, 1.07, 1.05, 0.62, 0.002), 40: (0.35, 1.08, 0.8, 0.2, 0.002)}


def viscosity_of(K_m):
    """12 mu."""
    return (TOUGHNESS / K_m) ** 4 / (RATE * MODULUS**3)


def run(perifrac, facets, viscosity, end, rest):
    """A wing of so many facets in the end, under that stress: history.csv as columns by name, and the open part of
    the energy. `viscosity` is 12 mu."""
    size, seed = SIZE * facets * SPACING, max(3, facets // 4) * SPACING
    scene = f"""
dimension: 2
body: {{shape: box, size: [{size} m, {2 * size} m], spacing: {SPACING} m}}
cracks:
  - {{name: wing, path: [0 m, {size} m, {seed} m, {size} m]}}
solid:
  type: quasi_static
  linear_solver: {{type: direct}}
  material: {{youngs_modulus: 700 MPa, poisson_ratio: 0.25}}
  confining_stress: [{rest} Pa, {rest} Pa]
  boundary: {{left: {{type: roller}}, bottom: {{type: roller}}, top: {{type: roller}}}}
damage: {{type: energy_release, fracture_energy: 5 J/m^2}}
crack_fluid:
  type: network
  density: 1000 kg/m^3
  viscosity: {viscosity / 12} Pa s
  bulk_modulus: 1e14 Pa
  counts: both
  inlets: [{{name: well, at: [0 mm, {size} m], rate: {RATE} m^2/s}}]
time: {{end: {end} s}}
coupling: {{window: {{largest: {end * 1.5 / facets / 8} s}}, iterations: {{max: 40}}}}
output: {{interval: {end} s}}
"""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(scene)
        done = subprocess.run([perifrac, "run", path, "--no-report", "--threads", "1", "--overwrite", "--output", folder],
                              capture_output=True, text=True, check=False)  # fmt: skip
        if done.returncode != 0:
            sys.exit(done.stderr)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
    history = {name.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}
    return history, summary["ledger"]["energy_error"]


def errors(perifrac, regime, facets):
    """In %: means of length, pressure, opening; swing of pressure; energy left open."""
    gamma, omega, pi = SOLUTION[regime]
    viscosity = viscosity_of(regime)
    end = (facets * SPACING / gamma / (MODULUS * RATE**3 / viscosity) ** (1 / 6)) ** 1.5
    history, energy = run(perifrac, facets, viscosity, end, REST)
    size = SIZE * facets * SPACING
    sums, lasted, swing = [0.0, 0.0, 0.0], 0.0, []
    columns = [history[name] for name in
               ("time", "crack_length", "inlet_well_pressure", "inlet_well_opening", "crack_volume")]  # fmt: skip
    before = 0.0
    for t, length, pressure, opening, volume in zip(*columns):
        step, before = t - before, t
        if not 0.75 <= length / (facets * SPACING) <= 0.95:
            continue
        scale = (MODULUS * RATE**3 * t**4 / viscosity) ** (1 / 6)
        thin = (viscosity / (MODULUS * t)) ** (1 / 3)
        exact = (gamma * scale, pi * MODULUS * thin, omega * thin * scale)
        fall = viscosity * RATE / 2 * SPACING / 2 / exact[2] ** 3
        net = pressure - REST - HELD * MODULUS * 2 * volume / size**2
        for k, ratio in enumerate((length / exact[0], net / (exact[1] - fall), opening / exact[2])):
            sums[k] += step * (ratio - 1)
        lasted += step
        swing.append((net + fall) * t ** (1 / 3))
    return [100 * s / lasted for s in sums] + [100 * (max(swing) / min(swing) - 1), 100 * energy]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("perifrac")
    parser.add_argument("--facets", type=int, nargs="+", default=[10, 20])
    parser.add_argument("--regimes", type=float, nargs="+", default=list(SOLUTION))
    given = parser.parse_args()
    missed = False
    print("K_m facets: length, pressure, opening, swing of pressure, energy left open [%]")
    for regime in given.regimes:
        for facets in given.facets:
            found = errors(os.path.abspath(given.perifrac), regime, facets)
            beyond = [abs(f) > bound for f, bound in zip(found, BOUNDS[facets])]
            missed = missed or any(beyond)
            print(f"{regime:5g}{facets:4d}: " + "  ".join(f"{f:7.3f}" for f in found[:-1]), f"{found[-1]:8.1e}", "MISSED" * any(beyond), flush=True)
    sys.exit(missed)


if __name__ == "__main__":
    main()

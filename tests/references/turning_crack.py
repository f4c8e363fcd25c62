#!/usr/bin/python3
"""A crack in an infinite body under unequal stresses, filled at one pressure, that turns as it grows.

Displacement discontinuities, constant on straight elements, from Muskhelishvili's potentials; both tips go on
together, by a step at a time, in the direction of largest hoop stress, at the pressure at which its intensity is the
toughness. Faces do not touch: runs end where they would.

Usage: turning_crack.py --test
       turning_crack.py [--angle 45] [--stress 6e6 5e6] [--toughness 6.535e5] > path.csv
"""
import argparse
import math
import sys

import numpy as np


def influence(nodes):
    """Traction sigma_nn + i sigma_ns at middles of elements, for an opening and a slip of one in each, G / (kappa + 1) = 1.

    nodes: along the crack, complex [m]. Positive slip: the left face goes ahead of the right one.
    """
    middle, half = 0.5 * (nodes[1:] + nodes[:-1]), 0.5 * (nodes[1:] - nodes[:-1])
    a, along = np.abs(half), half / np.abs(half)
    z = (middle[:, None] - middle[None, :]) / along[None, :]  # in the frame of the element that opens
    turn = along[:, None] / along[None, :]
    parts = []
    for jump in (1j, 1.0):  # opening, slip
        A = jump / (1j * math.pi)
        phi = A * (1 / (z - a) - 1 / (z + a))
        slope = -A * (1 / (z - a) ** 2 - 1 / (z + a) ** 2)
        psi = np.conj(A) * (1 / (z - a) - 1 / (z + a)) + A * a * (1 / (z - a) ** 2 + 1 / (z + a) ** 2)
        parts.append(2 * phi.real + turn**2 * (np.conj(z) * slope + psi))  # on faces turned so
    return parts


def traction_at_rest(nodes, stress):
    """sigma_nn + i sigma_ns on elements, of compressive stresses along x and y [Pa]."""
    along = np.diff(nodes) / np.abs(np.diff(nodes))
    return -0.5 * (stress[0] + stress[1]) - 0.5 * (stress[1] - stress[0]) * along**2


def jumps(nodes, stress):
    """Opening and slip times G / (kappa + 1) [Pa m] as (those without fluid, those for a pressure of 1 Pa)."""
    opening, slip = influence(nodes)
    matrix = np.block([[opening.real, slip.real], [opening.imag, slip.imag]])
    rest, count = traction_at_rest(nodes, stress), len(nodes) - 1
    ones = np.concatenate([-np.ones(count), np.zeros(count)])
    found = np.linalg.solve(matrix, np.column_stack([np.concatenate([-rest.real, -rest.imag]), ones]))
    return found[:, 0], found[:, 1]


def tip_intensity(jump, size):
    """K from the jump of the last element, in the middle of which a tip's is K sqrt(size / 4 pi) times (kappa + 1) / G.

    Constant elements see a fixed share more there: calibrate()."""
    return jump * math.sqrt(4.0 * math.pi / size) / calibrate()


def calibrate(cache={}):
    """What the last of many elements opens by, over what it has to."""
    if not cache:
        count = 400
        nodes = np.linspace(-1.0, 1.0, count + 1) + 0j
        last = jumps(nodes, (0.0, 0.0))[1][count - 1]
        cache["share"] = last * math.sqrt(4.0 * math.pi * count / 2.0) / math.sqrt(math.pi)
    return cache["share"]


ANGLES = np.radians(np.linspace(-120.0, 120.0, 24001))


def hoop(opening, sliding):
    """K_I of a crack that turns to the largest hoop stress, and the angle, to the left positive; slip as in influence()."""
    of = np.cos(ANGLES / 2) * (opening * np.cos(ANGLES / 2) ** 2 - 1.5 * sliding * np.sin(ANGLES))
    k = int(np.argmax(of))
    return of[k], ANGLES[k]


def modes(nodes, stress):
    """K_I and K_II of the last tip, each as (at no pressure, for 1 Pa)."""
    size, count = abs(nodes[-1] - nodes[-2]), len(nodes) - 1
    parts = jumps(nodes, stress)
    return [[tip_intensity(part[k], size) for part in parts] for k in (count - 1, 2 * count - 1)]


def ready_at(nodes, stress, toughness):
    """The pressure at which the last tip goes on [Pa], and by what angle it turns.

    The intensity is the largest of functions linear in the pressure: convex, and from above Newton's method comes to
    the upper of its roots, beneath which the crack does not close."""
    first, second = modes(nodes, stress)
    pressure = 10.0 * max(stress) + toughness / first[1]
    for _ in range(100):
        intensity, angle = hoop(*(part[0] + part[1] * pressure for part in (first, second)))
        slope = math.cos(angle / 2) * (first[1] * math.cos(angle / 2) ** 2 - 1.5 * second[1] * math.sin(angle))
        step = (intensity - toughness) / slope
        pressure -= step
        if abs(step) < 1e-9 * pressure:
            return pressure, angle
    raise RuntimeError("no pressure at which the crack goes on")


def march(angle, stress, toughness, half_length, end, elements=40, step=4):
    """Rows of (half length along the path [m], pressure [Pa], x, y of the tip [m] from the middle)."""
    size = half_length / elements
    wing = np.exp(1j * angle) * size * np.arange(0, elements + 1)
    rows = []
    while True:
        nodes = np.concatenate([-wing[:0:-1], wing])
        length = (len(wing) - 1) * size
        pressure, turn = ready_at(nodes, stress, toughness)
        rest, of_one = jumps(nodes, stress)
        if np.any((rest + pressure * of_one)[:len(nodes) - 1] < 0.0):
            return rows
        rows.append((length, pressure, wing[-1].real, wing[-1].imag))
        if length >= end:
            return rows
        ahead = (wing[-1] - wing[-2]) * np.exp(1j * turn)
        wing = np.concatenate([wing, wing[-1] + ahead * np.arange(1, step + 1)])


def test():
    nodes = np.linspace(-1.0, 1.0, 81) * np.exp(0.3j)
    rest, of_one = jumps(nodes, (0.0, 1.0))
    normal, shear = traction_at_rest(nodes, (0.0, 1.0))[0].real, traction_at_rest(nodes, (0.0, 1.0))[0].imag
    x = 0.5 * (nodes[1:] + nodes[:-1]) * np.exp(-0.3j)
    ellipse = 0.5 * np.sqrt(1.0 - x.real**2)  # (kappa + 1) / G of a unit: 2 (1 - nu) / G = (kappa + 1) / (2 G)
    for name, found, exact in (("opening", of_one[:80], ellipse), ("opening at rest", rest[:80], normal * ellipse),
                               ("slip at rest", rest[80:], shear * ellipse)):
        error = np.max(np.abs(found - exact)[20:60]) / np.max(np.abs(exact))
        print(f"{name}: {error:.2e} off in the middle half")
        assert error < 0.015, name
    for count in (20, 80):
        nodes = np.linspace(-1.0, 1.0, count + 1) + 0j
        first = modes(nodes, (0.0, 0.0))[0][1] / math.sqrt(math.pi)
        print(f"K_I of {count} elements: {first - 1.0:.2e} off")
        assert abs(first - 1.0) < 0.02
    # One that ends in a vanishing kink of 45 degrees: series of Amestoy & Leblond (1992) for F11 and F21.
    for arm, mode, exact in ((8, 0, 0.7909), (16, 1, 0.3244)):
        nodes = np.concatenate([np.linspace(-2.0, 0.0, 801), np.arange(1, arm + 1) / 400 * np.exp(0.25j * math.pi)])
        error = modes(nodes, (0.0, 0.0))[mode][1] / math.sqrt(math.pi) / exact - 1.0
        print(f"K_{'I' * (mode + 1)} of a kink of {arm} elements: {error:.2e} off")
        assert abs(error) < 0.015
    rows = march(0.0, (6e6, 5e6), 0.6535e6, 0.25, 0.4)
    error = max(abs((row[1] - 5e6) / (0.6535e6 / math.sqrt(math.pi * row[0])) - 1.0) for row in rows)
    print(f"pressure of a crack that goes straight on: {error:.2e} off")
    assert error < 0.005 and abs(rows[-1][3]) < 1e-9
    coarse, fine = (march(0.25 * math.pi, (6e6, 5e6), 0.6535e6, 0.25, 0.5, count)[-1] for count in (40, 80))
    aside, error = abs(complex(*coarse[2:]) - complex(*fine[2:])), (coarse[1] - fine[1]) / (fine[1] - 5e6)
    print(f"tip of 45 degrees at twice its length, half the elements: {aside:.1e} m aside, net pressure {error:.1e} off")
    assert aside < 2e-4 and abs(error) < 0.005


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--test", action="store_true")
    parser.add_argument("--angle", type=float, default=45.0, help="of the crack to x [degrees]")
    parser.add_argument("--stress", type=float, nargs=2, default=(6e6, 5e6), help="along x and y, compressive [Pa]")
    parser.add_argument("--toughness", type=float, default=0.6535e6, help="[Pa m^0.5]")
    parser.add_argument("--half-length", type=float, default=0.25, help="[m]")
    parser.add_argument("--end", type=float, default=0.5, help="half length along the path [m]")
    parser.add_argument("--elements", type=int, default=40, help="in the half length")
    parser.add_argument("--step", type=int, default=4, help="elements")
    chosen = parser.parse_args()
    if chosen.test:
        return test()
    print("half_length [m],pressure [Pa],x [m],y [m]")
    for row in march(math.radians(chosen.angle), chosen.stress, chosen.toughness, chosen.half_length, chosen.end,
                     chosen.elements, chosen.step):
        print(",".join(f"{value:.7g}" for value in row))
    return None


if __name__ == "__main__":
    sys.exit(main())

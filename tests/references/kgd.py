#!/usr/bin/env python3
"""Plane-strain hydraulic fracture of two wings in an infinite body: length, inlet opening and inlet
net pressure over time. Newtonian fluid; options: Carter leak-off, compressible fluid, fluid lag.

Elasticity: the opening under piecewise constant pressure in closed form (Spence and Sharp 1985,
the logarithmic kernel), K = 2 (l/pi)^(1/2) int p/(l^2 - x^2)^(1/2) dx. Flow: lubrication.py.
"""

from __future__ import annotations

import argparse
import csv
import sys

import numpy as np
from scipy.optimize import root

from lubrication import Array, Crack, Fluid, History, March, State, graded_faces


class InfiniteBody:
    """Crack of two wings, symmetric; `stress` closes it."""

    def __init__(self, modulus: float, stress: float = 0.0):
        self.modulus, self.stress = modulus, stress  # E' = E/(1 - nu^2)

    def matrix(self, points: Array, faces: Array, length: float) -> tuple[Array, Array]:
        to = self.opening_to(points, faces, length)
        angle = np.arcsin(np.minimum(faces / length, 1))
        root = 2 * np.sqrt(length / np.pi)
        G = np.zeros((len(points) + 2, len(faces)))
        G[1:-1, 1:] = np.diff(to, axis=1)
        G[-1, 1:] = root * np.diff(angle)
        g = np.zeros(len(points) + 2)
        g[1:-1] = -self.stress * 4 / self.modulus * np.sqrt(np.maximum(length**2 - points**2, 0))
        g[-1] = -self.stress * np.sqrt(np.pi * length)
        return G, g

    def opening_to(self, points: Array, ends: Array, length: float) -> Array:
        """Opening at each point under unit pressure on |x| < each end."""
        x, s = points[:, None] / length, ends[None, :] / length
        A, B = np.sqrt(np.maximum(1 - x * x, 0)), np.sqrt(np.maximum(1 - s * s, 0))
        same = np.abs(x - s) < 1e-13
        with np.errstate(all="ignore"):
            # (A - B)(A + B) = (s - x)(s + x) and its like keep digits near the tip
            apart = np.where(same, 1, (s - x) * (s + x))
            first = s * np.log((A + B) ** 2 / np.abs(apart))
            second = x * np.log((s * A + x * B) ** 2 / np.abs(apart))
            logs = np.where(same, -2 * x * np.log(x), first - second)
        logs = np.where((x == 0) & (s == 0) | (A == 0) | ((x == 0) & same), 0, logs)
        logs = np.where((x == 0) & (s > 0), s * np.log((1 + B) ** 2 / np.maximum(s * s, 1e-300)), logs)
        return 4 * length / (np.pi * self.modulus) * (logs + 2 * A * np.arcsin(np.minimum(s, 1)))


def corners(modulus: float, toughness: float, viscosity: float, rate: float, time: float) -> dict:
    """Length, opening, pressure at the inlet of the two storage corners; rate feeds both wings."""
    k, m = 4 * np.sqrt(2 / np.pi) * toughness, 12 * viscosity
    corner = {"viscosity": (.6152 * (rate**3 * modulus * time**4 / m) ** (1 / 6),
                            1.1265 * (m * rate**3 * time**2 / modulus) ** (1 / 6),
                            .5455 * (modulus**2 * m / time) ** (1 / 3))}  # fmt: skip
    if k > 0:
        corner["toughness"] = (.9324 * (modulus * rate * time / k) ** (2 / 3),
                               .6828 * (k**2 * rate * time / modulus**2) ** (1 / 3),
                               .18307 * (k**4 / (modulus * rate * time)) ** (1 / 3))  # fmt: skip
    return corner


def solve(modulus: float, toughness: float, viscosity: float, rate: float, end: float, *,
          leak_off: float = 0.0, bulk_modulus: float = np.inf, stress: float = 0.0, lag: bool = False,
          cells: int = 40, change: float = 0.02, start: float = 1e-3,
          smallest: float = 1e-6, body=None) -> History:  # fmt: skip
    """From `start` x `end` to `end`. `rate` feeds both wings, `leak_off` is C' = 2 C_L. Pressures in
    the history are whole, those that the body is at rest under included."""
    body = body or InfiniteBody(modulus, stress)
    time = start * end
    length = min(c[0] for c in corners(modulus, toughness, viscosity, rate, time).values())
    if leak_off > 0:
        length = 0.7 * min(length, rate * np.sqrt(time) / (np.pi * leak_off))  # so that it grows
    faces = graded_faces(cells, smallest)
    leaked = 4 * leak_off * np.sqrt(time) * 0.7392 * length  # int (1 - s^1.5)^.5 ds
    kept = max(rate * time - leaked, 0.3 * rate * time)
    net = kept / (2 * np.pi * length**2) * modulus  # an ellipse that holds the fluid
    hidden = tip_beyond(length, net + stress, stress, toughness) - length if lag else 0.0
    state = State(time, length, hidden, np.full(len(faces), net + stress))
    crack = Crack(body, Fluid(viscosity, bulk_modulus, leak_off), toughness,
                  lambda t: rate / 2, lag=lag, stops=False)  # fmt: skip
    march = March(crack, state, faces)
    return march.run(end, 0.01 * time, change)


def tip_beyond(front: float, pressure: float, stress: float, toughness: float) -> float:
    """The length at which a uniform pressure up to `front`, none beyond, meets the toughness."""

    def excess(length: float) -> float:
        wet = 2 * np.sqrt(length / np.pi) * pressure * np.arcsin(front / length)
        return wet - stress * np.sqrt(np.pi * length) - toughness

    low, high = 1.001 * front, 50 * front
    for _ in range(50):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return low


def table_row(K_m: float, **options) -> tuple[float, float, float]:
    """gamma, Omega, Pi of the march at dimensionless toughness K_m (unit modulus, rate and 12 mu)."""
    modulus, rate, mu, end = 1e9, 1e-4, 1e-3, 1.0
    toughness = K_m * (12 * mu * rate * modulus**3) ** 0.25 / (4 * np.sqrt(2 / np.pi))
    h = solve(modulus, toughness, mu, rate, end, **options)
    scale = (modulus * rate**3 * end**4 / (12 * mu)) ** (1 / 6)
    thin = (12 * mu / (modulus * end)) ** (1 / 3)
    last = dict(zip(h.names, h.rows[-1]))
    return (last["length"] / scale, last["opening"] / (thin * scale), last["pressure"] / (modulus * thin))


# Checks, run by --test

TABLE = {  # K_m: gamma, Omega, Pi of the full self-similar solution
    0.3: (.6145, 1.127, .545), 1.16: (.5908, 1.151, .563), 2.0: (.5239, 1.256, .648),
    3.0: (.4342, 1.482, .877), 5.0: (.3174, 2.009, 1.589), 6.0: (.2817, 2.261, 2.011),
}  # fmt: skip
ROCK = dict(modulus=700e6 / 0.9375, toughness=np.sqrt(5 * 700e6 / 0.9375), viscosity=1e-3, rate=1.6e-4,
            end=0.1)  # fmt: skip
LEAKY = dict(modulus=4e9 / 0.9375, toughness=np.sqrt(2 * 4e9 / 0.9375), viscosity=1e-3, rate=1.6e-4,
             leak_off=4e-4)  # fmt: skip


def check(what: str, value: float, expected: float, tolerance: float) -> None:
    print(f"{what:58s} {value:11.5g} expected {expected:9.5g}, {value / expected - 1:+.2e}")
    assert abs(value / expected - 1) <= tolerance, what


def test_table() -> None:
    for K_m, expected in TABLE.items():
        values = table_row(K_m, cells=30)
        for name, value, reference in zip(("gamma", "Omega", "Pi"), values, expected):
            check(f"K_m {K_m}: {name}", value, reference, 2e-3)


def test_corners() -> None:
    for name, K_m, tolerance in (("viscosity", 0.15, 2e-3), ("toughness", 9.0, 5e-3)):
        toughness = K_m * (12e-3 * 1e-4 * 1e27) ** 0.25 / (4 * np.sqrt(2 / np.pi))
        h = solve(1e9, toughness, 1e-3, 1e-4, 1.0, cells=30)
        last = dict(zip(h.names, h.rows[-1]))
        expected = corners(1e9, toughness, 1e-3, 1e-4, 1.0)[name]
        for quantity, reference in zip(("length", "opening", "pressure"), expected):
            check(f"{name} corner (K_m {K_m}): {quantity}", last[quantity], reference, tolerance)


def test_convergence() -> None:
    results = []
    for cells, change in ((15, 0.04), (30, 0.02), (60, 0.01)):
        h = solve(**LEAKY, end=0.1, cells=cells, change=change)
        results.append(np.array(h.rows[-1]))
        print(f"leak-off, {cells} cells: length {results[-1][1]:.6g} m, pressure {results[-1][2]:.6g} Pa, "
              f"opening {results[-1][3]:.6g} m, leaked {results[-1][6]:.6g} m^2")  # fmt: skip
        check("volume and leak-off against injection", sum(results[-1][5:7]), 8e-6, 5e-5)
    for name, column in (("length", 1), ("pressure", 2), ("opening", 3), ("leak-off", 6)):
        check(f"{name}: 30 cells against 60", results[1][column], results[2][column], 1e-3)


def tough_leaky_length(modulus: float, toughness: float, rate: float, leak_off: float, end: float) -> float:
    """Uniform pressure at K_IC and Carter's law: one balance of volume, marched on a grid of time."""
    times = end * np.linspace(0, 1, 4001)[1:] ** 3
    lengths: list[float] = []
    for i, time in enumerate(times):
        old = lengths[-1] if lengths else 0.0
        past = np.diff(np.concatenate(([0.0], lengths)))
        arrived = (times[:i] + np.concatenate(([0.0], times[: max(i - 1, 0)]))[:i]) / 2
        leaked = 4 * leak_off * np.sum(past * np.sqrt(time - arrived))
        fresh = 4 * leak_off * np.sqrt((time - (times[i - 1] if i else 0.0)) / 2)
        low, high = old, old + 1.0
        for _ in range(60):
            middle = (low + high) / 2
            volume = 2 * np.sqrt(np.pi) * toughness * middle**1.5 / modulus
            full = volume + leaked + fresh * (middle - old) > rate * time
            low, high = (low, middle) if full else (middle, high)
        lengths.append(low)
    return lengths[-1]


def test_leak_off() -> None:
    h = solve(**LEAKY, end=10.0, start=1e-7, cells=30)
    efficiency = 1 - h.rows[-1][6] / (0.8e-4 * 10)
    corner = 1.6e-4 * np.sqrt(10.0) / (np.pi * 4e-4)
    print(f"leak-off corner: efficiency {efficiency:.3f}, length over corner {h.rows[-1][1] / corner:.4f}")
    assert 1 - efficiency < h.rows[-1][1] / corner < 1
    tough = dict(LEAKY, toughness=20 * LEAKY["toughness"])  # K_m 9.5
    h = solve(**tough, end=0.1, cells=30)
    expected = tough_leaky_length(tough["modulus"], tough["toughness"], 1.6e-4, 4e-4, 0.1)
    check("leak-off and toughness: length", h.rows[-1][1], expected, 5e-3)


def test_little_leak_off() -> None:
    """What the crack that does not leak would lose, along its l ~ t^(2/3)."""
    little = dict(LEAKY, leak_off=1e-3 * LEAKY["leak_off"])
    h = solve(**little, end=0.1, cells=30)
    expected = 2 * little["leak_off"] * h.rows[-1][1] * np.sqrt(0.1) * 0.7392
    check("little leak-off: its volume", h.rows[-1][6], expected, 1e-3)


def leak_off_corner(cells: int) -> tuple[float, float]:
    """Opening and pressure at the inlet of a crack of unit length without toughness, unit mu' Q and E',
    through which flows what Carter's law takes ahead where all leaks: Q/pi arccos(x/l)."""
    faces = graded_faces(cells, 1e-6)
    centres, inner = (faces[1:] + faces[:-1]) / 2, faces[1:-1]
    G = InfiniteBody(1.0).matrix(np.concatenate(([0.0], inner)), faces, 1.0)[0][:, 1:]

    def excess(p: Array) -> Array:
        response = G @ p
        carried = response[2:-1] ** 3 * np.diff(p) / np.diff(centres)
        return np.append(carried + np.arccos(inner) / np.pi, response[-1])

    found = root(excess, 0.6 - 1.2 * centres**4, options={"maxfev": 20000, "xtol": 1e-12})
    assert found.success, found.message
    return (G @ found.x)[1], found.x[0]


def test_much_leak_off() -> None:
    """Late figures go straight with the efficiency, which tends to zero."""
    thin = dict(LEAKY, toughness=0.05 * LEAKY["toughness"])
    h = solve(**thin, end=10.0, start=1e-7, cells=30)
    efficiency, figures = [], []
    for time in (1.0, 10.0):
        length = h.at("length", time)
        efficiency.append(1 - h.at("leak_off", time) / (0.8e-4 * time))
        scale = (12e-3 * 1.6e-4 * length**2 / LEAKY["modulus"]) ** 0.25
        figures.append(np.array((length * np.pi * 4e-4 / (1.6e-4 * np.sqrt(time)), h.at("opening", time) / scale,
                                 h.at("pressure", time) * length / (LEAKY["modulus"] * scale))))  # fmt: skip
    share = efficiency[1] / (efficiency[0] - efficiency[1])
    limit = figures[1] + share * (figures[1] - figures[0])
    for name, value, expected in zip(("length", "opening", "pressure"), limit, (1.0, *leak_off_corner(120))):
        check(f"all leaks, no toughness: {name}", value, expected, 1e-2)


def test_compressible() -> None:
    soft = solve(**ROCK, bulk_modulus=22e6, cells=30).rows[-1]
    stiff = solve(**ROCK, bulk_modulus=22e12, cells=30).rows[-1]
    none = solve(**ROCK, cells=30).rows[-1]
    check("bulk modulus without end: length", stiff[1], none[1], 1e-6)
    print(f"volume at 22 MPa over that of incompressible fluid: {soft[5] / none[5]:.5f}")
    assert 1 - soft[2] / 22e6 < soft[5] / none[5] < 1


def test_lag() -> None:
    none = solve(**ROCK, cells=30).rows[-1]
    confined = solve(**ROCK, lag=True, stress=3e6, cells=30).rows[-1]
    for name, column in (("length", 1), ("opening", 3)):
        check(f"lag at 3 MPa against none: {name}", confined[column], none[column], 2e-3)
    check("lag at 3 MPa against none: net pressure", confined[2] - 3e6, none[2], 2e-3)

    h = solve(**ROCK, lag=True, smallest=1e-4, cells=30, start=1e-5)
    late = h.rows[-1]
    check("no stress, self-similar: length over t^(2/3)", late[1], h.at("length", 0.01) * 10 ** (2 / 3), 1e-4)
    early_share = h.at("lag", 0.01) / h.at("length", 0.01)
    check("no stress, self-similar: lag over length", late[4] / late[1], early_share, 1e-4)
    fine = solve(**ROCK, lag=True, smallest=1e-4, cells=60, change=0.01).rows[-1]
    check("lag: 30 cells against 60: length", late[1], fine[1], 2e-3)
    check("lag: 30 cells against 60: lag", late[4], fine[4], 1e-2)

    # Garagash and Detournay 2000: lag = .3574 mu' V E'^2/stress^3 at a straight front, no toughness
    ratios, sizes = [], []
    for stress in (3e6, 10e6):
        h = solve(**dict(ROCK, toughness=1e-3 * ROCK["toughness"]), lag=True, stress=stress, cells=30)
        last = h.rows[-1]
        speed = 2 / 3 * last[1] / last[0]
        ratios.append(last[4] / (12e-3 * speed * ROCK["modulus"] ** 2 / stress**3))
        sizes.append((last[4] / last[1]) ** (1 / 3))
    limit = ratios[1] + (ratios[1] - ratios[0]) * sizes[1] / (sizes[0] - sizes[1])
    check("lag of a short tip over mu' V E'^2/stress^3", limit, 0.3574, 3e-2)


def test_kernel() -> None:
    body, x, faces = InfiniteBody(1.0), np.linspace(0, 1, 9), np.linspace(0, 1, 5)
    G, _ = body.matrix(x, faces, 1.0)
    assert np.abs(G[1:-1].sum(axis=1) - 4 * np.sqrt(1 - x * x)).max() < 1e-12
    fine = np.linspace(0, 0.6, 200001)
    middle = (fine[1:] + fine[:-1]) / 2
    A, B = np.sqrt(1 - 0.3**2), np.sqrt(1 - middle**2)
    brute = 4 / np.pi * np.sum(np.log(np.abs((A + B) / (A - B)))) * (fine[1] - fine[0])
    check("kernel against quadrature", body.opening_to(np.array([0.3]), np.array([0.6]), 1.0)[0, 0], brute, 1e-5)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = lambda name, default, help: parser.add_argument(name, type=float, default=default, help=help)
    add("--young", 700e6, "Young's modulus [Pa]")
    add("--poisson", 0.25, "Poisson's ratio")
    add("--energy", 5.0, "critical energy release rate [J/m^2]")
    add("--viscosity", 1e-3, "[Pa s]")
    add("--rate", 1.6e-4, "of both wings together [m^2/s]")
    add("--leak-off", 0.0, "Carter's coefficient C_L [m/s^(1/2)]")
    add("--bulk-modulus", np.inf, "of the fluid [Pa]")
    add("--stress", 0.0, "closing the crack [Pa]; pressures are whole, not net")
    add("--end", 0.1, "[s]")
    parser.add_argument("--lag", action="store_true", help="pressure >= 0, dry tip")
    parser.add_argument("--cells", type=int, default=40)
    parser.add_argument("--rows", type=int, default=100, help="equal steps of time to print")
    parser.add_argument("--table", action="store_true", help="one wing, whole pressures, in a scene's words")
    parser.add_argument("--test", action="store_true", help="verify this script")
    a = parser.parse_args()
    if a.test:
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
        return
    modulus = a.young / (1 - a.poisson**2)
    h = solve(modulus, np.sqrt(a.energy * modulus), a.viscosity, a.rate, a.end,
              leak_off=2 * a.leak_off, bulk_modulus=a.bulk_modulus, stress=a.stress, lag=a.lag,
              cells=a.cells)  # fmt: skip
    writer = csv.writer(sys.stdout, lineterminator="\n")
    if a.table:
        names = {"crack_length [m]": "length", "inlet_well_pressure [Pa]": "pressure",
                 "inlet_well_opening [m]": "opening", "leak_off_volume [m^2]": "leak_off"}  # fmt: skip
        writer.writerow(("time [s]", *names))
        for time in np.linspace(0, a.end, a.rows + 1)[1:]:
            values = [h.at(name, time) for name in names.values()]
            writer.writerow([f"{v:.6g}" for v in (time, *values)])
        return
    writer.writerow(("time", "length", "pressure", "opening", "lag", "volume", "leak_off"))
    for time in np.linspace(0, a.end, a.rows + 1)[1:]:
        values = [h.at(name, time) for name in h.names[1:7]]
        values[4:] = [2 * v for v in values[4:]]  # both wings
        writer.writerow([f"{v:.6g}" for v in (time, *values)])


if __name__ == "__main__":
    main()

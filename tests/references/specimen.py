#!/usr/bin/env python3
"""Hydraulic fracture growing straight down from the notch of a rectangular specimen, with viscous
flow and fluid lag: length, inlet pressure and opening, lag and leaked volume over time.

Elasticity: the weight functions of this specimen, plate.py. Flow: lubrication.py. The crack begins
as a slit; its length counts from the notch's floor. The notch is full of fluid at zero pressure at
time zero, its walls carry the inlet pressure and its growth takes fluid in (`--notch dry`: no fluid
and no pressure in it; `--notch slit`: notch and slit are one slit from the top, as in the scenes, and
length counts from there: soft water in a wide notch takes up most of what is pumped in). Until K_I reaches K_IC the pressure is uniform over notch and slit. The rate
is a mass rate over the density at zero pressure.

Outer faces. `stress`: constant lateral stress on left and right, vertical on top and bottom.
`rollers`: the specimen is confined by these stresses, crack and slit closed; then left, right and
bottom keep their normal displacement, the top its stress. All without friction. What the notch does
not carry of the vertical stress, and its pressure, the bottom balances uniformly.

Leak-off. Carter's law with C_L of the case's pore fluid at the mean pressure over the wet walls and
over the time of growth (found by iteration); the slit's walls do not leak; the notch's
walls with `--leaking-notch` only.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass, replace
from typing import Callable, Iterator

import numpy as np
from scipy.interpolate import CubicSpline

from kgd import ROCK, solve
from lubrication import Array, Crack, Fluid, History, March, State, graded_faces
from plate import TERMS, Mesh, Plate, WeightFunctions, axis_of, shape, weight_functions

NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)
NODES, WEIGHTS = (NODES + 1) / 2, WEIGHTS / 2


@dataclass
class EdgeCrack:
    """Openings and K_I of a crack from its weight functions: w(x) = (2/E') int_x^l m(x, c) K(c) dc."""

    functions: WeightFunctions
    lateral: float  # stress on left and right [Pa]
    vertical: float  # on top and bottom
    wet_notch: bool = True

    def intensity(self, c: Array, faces: Array) -> tuple[Array, Array]:
        """K_I of the part s < c under each unit pressure, notch first; under the outer stresses."""
        terms = np.concatenate((np.ones((len(c), 1)), self.functions.terms(c)), axis=1)
        ahead = np.maximum(c[:, None] - faces, 0)
        share, power, to_face = ahead / c[:, None], np.sqrt(ahead), 0.0
        for k in range(terms.shape[1]):
            to_face = to_face + terms[:, k, None] * power / (k + 0.5)
            power = power * share
        unit = self.functions.unit(c) * np.sqrt(c)[:, None]
        by_pressure = np.empty((len(c), len(faces)))
        by_pressure[:, 0] = unit[:, 0] * self.wet_notch
        by_pressure[:, 1:] = -np.sqrt(2 / np.pi) * np.diff(to_face, axis=1)
        return by_pressure, unit[:, 1] * self.lateral + unit[:, 2] * self.vertical

    def matrix(self, points: Array, faces: Array, length: float) -> tuple[Array, Array]:
        if length > self.functions.terms.x[-1]:
            raise ValueError(f"crack of {length:g} m is longer than the weight functions know")
        compliance = 2 / self.functions.plate.modulus
        beyond = (length - points)[:, None]
        c = points[:, None] + beyond * NODES**2  # takes the singularity of m away
        u = points[:, None] / c
        M = shape(self.functions.terms(c.ravel()), u.ravel()).reshape(c.shape)
        weight = compliance * 2 * np.sqrt(2 * np.maximum(beyond, 0) / np.pi) * WEIGHTS * M
        G, g = np.zeros((len(points) + 2, len(faces))), np.zeros(len(points) + 2)
        by_pressure, by_stress = self.intensity(c.ravel(), faces)
        G[1:-1] = (weight[:, None, :] @ by_pressure.reshape(*c.shape, -1))[:, 0]
        g[1:-1] = np.sum(weight * by_stress.reshape(c.shape), axis=1)

        if self.wet_notch:
            c = length * NODES**2
            by_pressure, by_stress = self.intensity(c, faces)
            weight = compliance * 2 * length * NODES * WEIGHTS * by_pressure[:, 0]
            G[0], g[0] = weight @ by_pressure, weight @ by_stress
            G[0, 0] += self.functions.notch_compliance
        by_pressure, by_stress = self.intensity(np.array([length]), faces)
        G[-1], g[-1] = by_pressure[0], by_stress[0]
        return G, g


@dataclass
class Case:
    energy: float  # Gc [J/m^2]
    rate: float  # [m^2/s]
    lateral: float  # [Pa]
    viscosity: float = 1e-3
    bulk_modulus: float = np.inf
    slit: float = 0.004  # [m], it does not leak
    leak_off: float = 0.0  # C_L [m/s^(1/2)]
    leaking_notch: bool = False
    wet_notch: bool = True


class Filling:
    """Notch and slit under uniform pressure, before the crack grows."""

    def __init__(self, case: Case, elasticity: EdgeCrack):
        plate = elasticity.functions.plate
        self.case = case
        self.cavity = plate.notch_width * plate.notch_depth if case.wet_notch else 0.0
        self.wall = (plate.notch_width + 2 * plate.notch_depth) if case.leaking_notch else 0.0
        points = np.linspace(0, case.slit, 41)
        G, self.by_stress = elasticity.matrix(points, np.array([0.0, 1.0]) * case.slit, case.slit)
        self.by_pressure = G.sum(axis=1)

    def response(self, pressure: float) -> tuple[float, float, float]:
        """Notch's growth, slit's volume and opening at the mouth."""
        values = np.maximum(self.by_pressure * pressure + self.by_stress, 0)
        return values[0], self.case.slit / 40 * (np.sum(values[1:-1]) - values[1] / 2), values[1]

    def leaked(self, time: float) -> float:
        return 2 * self.case.leak_off * self.wall * np.sqrt(time)

    def pressure(self, time: float) -> float:
        def surplus(p: float) -> float:
            growth, slit, _ = self.response(p)
            content = (1 + p / self.case.bulk_modulus) * (self.cavity + growth + slit)
            return content - self.cavity - self.case.rate * time + self.leaked(time)

        return bisect(surplus, 0.0, 1e9)

    def row(self, time: float) -> tuple[float, ...]:
        p = self.pressure(time)
        _, slit, opening = self.response(p)
        return time, self.case.slit, p, opening, 0.0, slit, self.leaked(time), p, np.nan, np.nan


def bisect(rising: Callable[[float], float], low: float, high: float) -> float:
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < 0 else (low, middle)
    return low


def march(case: Case, elasticity: EdgeCrack, end: float, cells: int = 40, change: float = 0.02,
          smallest: float = 1e-4) -> History:  # fmt: skip
    faces, filling = graded_faces(cells, smallest), Filling(case, elasticity)
    toughness = np.sqrt(case.energy * elasticity.functions.plate.modulus)
    G, g = elasticity.matrix(faces, np.array([0.0, 0.98, 1.0]) * case.slit, case.slit)
    pressure = (toughness - g[-1]) / (G[-1, 0] + G[-1, 1])
    growth = bisect(lambda t: filling.pressure(t) - pressure, 0.0, end)
    start = State(growth, 0.98 * case.slit, 0.02 * case.slit, np.full(len(faces), pressure))
    crack = Crack(elasticity, Fluid(case.viscosity, case.bulk_modulus, 2 * case.leak_off), toughness,
                  lambda t: case.rate, filling.cavity, filling.wall, case.slit, lag=True)  # fmt: skip
    history = March(crack, start, faces).run(end, 1e-5 * growth, change)
    history.rows[:0] = [filling.row(t) for t in np.linspace(0, growth, 42)[:-1]]
    return history


def carter_coefficient(pressure: float, *, young: float, poisson: float, permeability: float,
                       viscosity: float, porosity: float, bulk_modulus: float) -> float:  # fmt: skip
    """C_L into a poroelastic half-space, alpha = 1, that strains along the flow only."""
    uniaxial = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
    storage = porosity / bulk_modulus + 1 / uniaxial
    return pressure * np.sqrt(permeability * storage / (np.pi * viscosity))


def with_leak_off(case: Case, elasticity: EdgeCrack, end: float, coefficient: Callable[[float], float],
                  **options) -> tuple[History, float]:  # fmt: skip
    """The march, and the mean pressure on the crack's wet walls that its Carter coefficient takes."""
    pressure = 1.4 * case.lateral
    for _ in range(6):
        history = march(replace(case, leak_off=coefficient(pressure)), elasticity, end, **options)
        times = np.linspace(history.column("time")[41], end, 101)
        mean = float(np.mean(history.at("mean_pressure", times)))
        if abs(mean / pressure - 1) < 5e-3:
            break
        pressure = mean
    return history, pressure


ROCKS = {
    "storage": dict(young=700e6, energy=5.0, rate=1.6e-4, lateral=0.21e6, permeability=0.0),
    "leak-off": dict(young=4e9, energy=2.0, rate=0.8e-4, lateral=0.9e6, permeability=1.02e-14),
}
COLUMNS = ("time", "length", "pressure", "opening", "lag", "volume", "leak_off")


def rows(history: History, end: float, step: float) -> Iterator[list[str]]:
    for time in np.arange(0, end + step / 2, step):
        yield [f"{time:.6g}", *(f"{history.at(name, time):.5g}" for name in COLUMNS[1:])]


def coefficient_of(rock: dict, bulk_modulus: float, pressure: float) -> float:
    return carter_coefficient(pressure, young=rock["young"], poisson=0.25, viscosity=Case.viscosity,
                              permeability=rock["permeability"], porosity=0.1,
                              bulk_modulus=bulk_modulus)  # fmt: skip


def results(rock: dict, outer: str, bulk_modulus: float, end: float, fine: float, *,
            notch: str = "wet", leaking_notch: bool = False, vertical: float | None = None,
            lateral: float | None = None, **options) -> tuple[History, History | None, float]:  # fmt: skip
    """Without leak-off, with it if the rock is permeable, and the pressure of its C_L."""
    lateral = rock["lateral"] if lateral is None else lateral
    vertical = lateral / 2 if vertical is None else vertical
    plate, slit = Plate(young=rock["young"], outer=outer), Case.slit
    if notch == "slit":
        plate, slit = replace(plate, notch_depth=0.0), slit + plate.notch_depth
    elasticity = EdgeCrack(weight_functions(plate, fine), lateral, vertical, notch == "wet")
    case = Case(rock["energy"], rock["rate"], lateral, bulk_modulus=bulk_modulus, slit=slit,
                leaking_notch=leaking_notch, wet_notch=notch == "wet")  # fmt: skip
    plain = march(case, elasticity, end, **options)
    if rock["permeability"] == 0:
        return plain, None, 0.0

    return plain, *with_leak_off(case, elasticity, end, lambda p: coefficient_of(rock, bulk_modulus, p), **options)


def tables(name: str, writer, end: float, step: float, fine: float, **options) -> None:
    """Both kinds of outer face, fluids of 22 MPa, 2.2 GPa and (storage) no compressibility."""
    leaking = name == "leak-off"
    more = ("length_without_leak_off", "leak_off_pressure") if leaking else ()
    writer.writerow(("outer", "bulk_modulus", *COLUMNS, *more))
    for outer in ("stress", "rollers"):
        for bulk_modulus in (22e6, 2.2e9) if leaking else (22e6, 2.2e9, np.inf):
            plain, leaky, pressure = results(ROCKS[name], outer, bulk_modulus, end, fine, **options)
            for row in rows(leaky or plain, end, step):
                without = (f"{plain.at('length', float(row[0])):.5g}", f"{pressure:.4g}")
                writer.writerow((outer, f"{bulk_modulus:g}", *row, *(without if leaking else ())))


def scene_table(history: History, writer, begin: float, end: float, step: float) -> None:
    writer.writerow(("time [s]", "crack_length [m]", "inlet_notch_pressure [Pa]", "leak_off_volume [m^2]"))
    for time in np.arange(begin, end + step / 2, step):
        values = (history.at(name, time) for name in ("length", "pressure", "leak_off"))
        writer.writerow([f"{time:.6g}", *(f"{v:.5g}" for v in values)])


# Checks, run by --test


def check(what: str, value: float, expected: float, tolerance: float) -> None:
    print(f"{what:62s} {value:11.5g} expected {expected:10.5g}, {value / expected - 1:+.2e}")
    assert abs(value / expected - 1) <= tolerance, what


def strip_factor(x: float) -> float:
    """K_I/(p (pi a)^(1/2)) of an edge crack a = x W in a long strip in tension (Tada, within .5 %)."""
    angle = np.pi * x / 2
    top = 0.752 + 2.02 * x + 0.37 * (1 - np.sin(angle)) ** 3
    return np.sqrt(np.tan(angle) / angle) * top / np.cos(angle)


def test_strip() -> None:
    """Crack of unit pressure, and unit tension far away, in a plate four times as long as wide."""
    long = weight_functions(Plate(width=0.8, notch_depth=0.0, longest=0.16), 4e-4)
    edge = EdgeCrack(long, 1.0, 0.0)
    for x in (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6):
        a = 0.2 * x
        by_pressure, by_stress = edge.intensity(np.array([a]), np.array([0.0, a]))
        root = np.sqrt(np.pi * a)
        check(f"strip, a/W {x}: K_I of pressure", by_pressure[0, 1] / root, strip_factor(x), 1e-2)
        check(f"strip, a/W {x}: K_I of tension", -by_stress[0] / root, strip_factor(x), 1e-2)


def test_compliance() -> None:
    """Openings and notch put together from weight functions against one solve of the same elements."""
    plate = Plate()
    axis, functions = axis_of(plate, 2e-4), weight_functions(plate, 2e-4)
    edge, faces = EdgeCrack(functions, 1.0, 0.5), np.array([0.0, 0.025, 0.05])
    last = int(np.searchsorted(axis.s, 0.05))
    length = axis.s[last]  # the first node held
    faces *= length / faces[-1]
    wide = Mesh.shares(axis.s)
    loads = np.column_stack((axis.forces[:, 0], wide * (axis.s < faces[1]), wide * (axis.s >= faces[1]),
                             axis.forces[:, 1] + 0.5 * axis.forces[:, 2]))[:last]  # fmt: skip
    moved = 2 * np.linalg.solve(axis.stiffness[:last, :last], loads)
    G, g = edge.matrix(axis.s[:last], faces, length)
    for node in (0, np.searchsorted(axis.s, 0.02)):
        for what, value, expected in (("notch", G[node + 1, 0], moved[node, 0]),
                                      ("whole crack", G[node + 1, 1:].sum(), moved[node, 1:3].sum()),
                                      ("stresses", g[node + 1], moved[node, 3])):  # fmt: skip
            check(f"opening at {axis.s[node] * 1e3:.0f} mm under {what}", value, expected, 2e-2)
    volume = axis.notch_compliance + axis.forces[:last, 0] @ moved[:, 0]
    check("volume of the notch under its own pressure", G[0, 0], volume, 2e-2)

    faces = np.linspace(0, 0.05, 26)
    points = np.sort(np.concatenate((faces, (faces[1:] + faces[:-1]) / 2)))
    G, _ = edge.matrix(points, faces, 0.05)
    parts = np.vstack((G[0], (G[1:-1:2][:-1] + 4 * G[2:-1:2] + G[3:-1:2]) / 6 * 0.002))
    shapes = np.zeros((26, 3))  # the notch alone, the crack uniformly, the crack more and more
    shapes[0, 0], shapes[1:, 1], shapes[1:, 2] = 1, 1, faces[1:] / 0.05
    work = shapes.T @ parts @ shapes
    scale = np.sqrt(np.outer(np.diag(work), np.diag(work)))
    print(f"asymmetry of the compliance (Maxwell) {np.abs((work - work.T) / scale).max():.1e}")
    assert np.abs((work - work.T) / scale).max() < 2e-3


@dataclass
class Unbounded:
    """Stands in for the weight functions: two wings in an infinite body, M = (2/(1 + s/c))^(1/2)."""

    plate: Plate
    notch_compliance: float = 0.0

    def __post_init__(self) -> None:
        u = np.linspace(0, 1, 201)
        powers = (1 - u)[:, None] ** np.arange(1, TERMS + 1)
        fitted = np.linalg.lstsq(powers, np.sqrt(2 / (1 + u)) - 1, rcond=None)[0]
        self.terms = CubicSpline((0.0, 100.0), np.array((fitted, fitted)))
        unit = np.array((0.0, -np.sqrt(np.pi), 0.0))
        self.unit = CubicSpline((0.0, 100.0), np.array((unit, unit)))


def test_flow() -> None:
    """The marches of kgd.py, whose kernel is in closed form."""
    options = dict(ROCK, cells=20, smallest=1e-4)
    for lag, stress in ((False, 0.0), (True, 0.21e6)):
        body = EdgeCrack(Unbounded(Plate()), stress, 0.0, wet_notch=False)
        mine = solve(**options, lag=lag, stress=stress, body=body).rows[-1]
        theirs = solve(**options, lag=lag, stress=stress).rows[-1]
        for name, column in (("length", 1), ("pressure", 2), ("opening", 3)):
            check(f"infinite body, lag {lag}: {name}", mine[column], theirs[column], 2e-3)


def test_convergence() -> None:
    """Storage case, 2.2 GPa: mesh of the plate, then cells and steps of the flow."""
    case = Case(5.0, 1.6e-4, 0.21e6, bulk_modulus=2.2e9)
    for outer in ("stress", "rollers"):
        histories = []
        for fine, cells, change in ((4e-4, 12, 0.04), (2e-4, 12, 0.04), (4e-4, 24, 0.02)):
            functions = weight_functions(Plate(outer=outer), fine)
            h = march(case, EdgeCrack(functions, 0.21e6, 0.105e6), 0.05, cells=cells, change=change)
            histories.append(h)
            content = h.rows[-1][h.names.index("content")] - 4e-5
            check(f"{outer}: fluid stored against injected", content, 0.8e-5, 2e-4)
        for what, other in (("elements", histories[1]), ("cells and steps", histories[2])):
            for name, tolerance in (("length", 1e-2), ("pressure", 1e-2), ("opening", 4e-2)):
                for time in (0.02, 0.05):
                    check(f"{outer}: {name} at {time} s, {what} halved",
                          histories[0].at(name, time), other.at(name, time), tolerance)  # fmt: skip


def test_soft_water() -> None:
    """The leak-off case, 22 MPa, one slit: elements, then cells and steps, halved."""
    def marched(fine: float, **options) -> History:
        return results(ROCKS["leak-off"], "stress", 22e6, 0.1, fine, notch="slit", **options)[1]

    coarse = marched(2e-4, cells=12, change=0.03)
    check("fluid stored and leaked against injected", coarse.rows[-1][-1], 8e-6, 1e-3)
    for what, other in (("elements", marched(1e-4, cells=12, change=0.03)),
                        ("cells and steps", marched(2e-4, cells=24, change=0.015))):  # fmt: skip
        for name, tolerance in (("length", 5e-3), ("pressure", 2e-3), ("leak_off", 5e-3)):
            for time in (0.02, 0.05, 0.1):
                check(f"22 MPa: {name} at {time} s, {what} halved",
                      coarse.at(name, time), other.at(name, time), tolerance)  # fmt: skip


def test_leak_off() -> None:
    coefficient = carter_coefficient(1e6, young=4e9, poisson=0.25, permeability=1.02e-14,
                                     viscosity=1e-3, porosity=0.1, bulk_modulus=22e6)  # fmt: skip
    check("C_L at 1 MPa", coefficient, 1e6 * np.sqrt(1.02e-14 * (0.1 / 22e6 + 1 / 4.8e9) / (np.pi * 1e-3)), 1e-9)
    functions = weight_functions(Plate(young=4e9), 4e-4)
    edge = EdgeCrack(functions, 0.9e6, 0.45e6)
    case = Case(2.0, 0.8e-4, 0.9e6, bulk_modulus=2.2e9)
    plain = march(case, edge, 0.05, cells=16, change=0.03)
    none = march(replace(case, leak_off=1e-12), edge, 0.05, cells=16, change=0.03)
    check("leak-off without end: length", none.rows[-1][1], plain.rows[-1][1], 1e-5)
    leaky = march(replace(case, leak_off=coefficient), edge, 0.05, cells=16, change=0.03)
    kept = leaky.rows[-1][leaky.names.index("content")] - 4e-5  # leaked fluid counts
    check("fluid stored and leaked against injected", kept, 4e-6, 2e-3)
    assert leaky.rows[-1][1] < 0.95 * plain.rows[-1][1]
    # all of the crack exposed at once, and as it grows in proportion to time
    most = 4 * coefficient * leaky.rows[-1][1] * np.sqrt(0.05)
    print(f"leaked {leaky.rows[-1][6]:.4g} m^2 of at most {most:.4g}")
    assert 0.4 * most < leaky.rows[-1][6] < most


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", choices=ROCKS, default="storage")
    parser.add_argument("--outer", choices=("stress", "rollers"), default="stress")
    parser.add_argument("--bulk-modulus", type=float, default=np.inf, help="of the fluid [Pa]")
    parser.add_argument("--lateral", type=float, help="stress on left and right [Pa]")
    parser.add_argument("--vertical", type=float, help="on top and bottom [Pa], else half the lateral")
    parser.add_argument("--notch", choices=("wet", "dry", "slit"), default="wet")
    parser.add_argument("--leaking-notch", action="store_true")
    parser.add_argument("--end", type=float, default=0.1, help="[s]")
    parser.add_argument("--step", type=float, default=1e-3, help="between rows [s]")
    parser.add_argument("--cells", type=int, default=24)
    parser.add_argument("--fine", type=float, default=1e-4, help="a fifth of the elements down the path [m], twice those at the mouth")
    parser.add_argument("--table", action="store_true", help="all variants of the case")
    parser.add_argument("--scene", type=float, help="in a scene's words, from this time on [s]")
    parser.add_argument("--test", action="store_true", help="verify this script")
    a = parser.parse_args()
    if a.test:
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
        return
    writer = csv.writer(sys.stdout, lineterminator="\n")
    if a.table:
        return tables(a.case, writer, a.end, a.step, a.fine, cells=a.cells)
    plain, leaky, pressure = results(
        ROCKS[a.case], a.outer, a.bulk_modulus, a.end, a.fine, notch=a.notch,
        leaking_notch=a.leaking_notch, lateral=a.lateral, vertical=a.vertical, cells=a.cells)  # fmt: skip
    if leaky:
        coefficient = coefficient_of(ROCKS[a.case], a.bulk_modulus, pressure)
        print(f"# C_L {coefficient:.5g} m/s^.5, at {pressure:.4g} Pa; length without leak-off {plain.rows[-1][1]:.5g} m",
              file=sys.stderr)  # fmt: skip
    if a.scene is not None:
        return scene_table(leaky or plain, writer, a.scene, a.end, a.step)
    writer.writerow(COLUMNS)
    writer.writerows(rows(leaky or plain, a.end, a.step))


if __name__ == "__main__":
    main()

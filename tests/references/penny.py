#!/usr/bin/env python3
"""Penny-shaped hydraulic fracture in an infinite body under uniform stress: radius, opening and net
pressure over time. Newtonian fluid that fills the crack up to its edge, no leak-off.

Elasticity: opening and K under pressure constant in rings, in closed form (Sneddon's solution; elliptic
integrals). Flow: Poiseuille's law between rings, finite volumes on a mesh that grows with the crack and is
fine at its edge, so that no tip asymptote is assumed; backward differences of second order; Newton. The
fluid enters evenly over a disc of given radius, for the pressure at a point would have no bound.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass, field

import numpy as np
from scipy.special import ellipeinc, ellipkinc

Array = np.ndarray


def opening_to(r: Array, ends: Array) -> Array:
    """Opening at each r of a crack of unit radius and modulus under unit pressure within each end."""
    r, a = np.broadcast_arrays(r[:, None], ends[None, :])
    low, high = np.minimum(r, a), np.maximum(r, a)
    # int (s^2 - a^2)^(1/2) / (s^2 - r^2)^(1/2) ds from the larger of both to 1, by x = B tan(angle)
    apart = (high - low) * (high + low)
    reach = np.sqrt((1 - high) * (1 + high))
    with np.errstate(all="ignore"):
        B = np.sqrt(apart)
        tangent, angle = reach / B, np.arctan2(reach, B)
        m = (low / high) ** 2
        rest = np.hypot(np.cos(angle), B / high * np.sin(angle)) * tangent - ellipeinc(angle, m)
        outside = high * (rest + apart / high**2 * ellipkinc(angle, m))
        held_back = np.where(r > a, outside, high * rest)
    held_back = np.where(low == 0, np.where(a > 0, reach - a * np.arctan2(reach, a), reach), held_back)
    held_back = np.where(apart == 0, 1 - high, held_back)
    return 8 / np.pi * (np.sqrt((1 - r) * (1 + r)) - held_back)


class Mesh:
    """Rings of a crack of unit radius, fine at the edge and at the middle, and what they respond to
    pressures in them at unit modulus."""

    def __init__(self, cells: int, at_edge: float, at_middle: float, halvings: int = 0):
        ratio, largest = 1 + 4 / cells, 1.5 / cells

        def graded(smallest: float) -> Array:
            widths = [smallest]
            while sum(widths) < 0.5:
                widths.append(min(widths[-1] * ratio, largest))
            return np.cumsum(widths) / sum(widths) / 2

        self.faces = np.concatenate(([0.0], graded(at_middle)[:-1], 1 - graded(at_edge)[::-1], [1.0]))
        for _ in range(halvings):
            self.faces = np.sort(np.concatenate((self.faces, (self.faces[1:] + self.faces[:-1]) / 2)))
        self.centres = (self.faces[1:] + self.faces[:-1]) / 2
        self.areas = np.pi * np.diff(self.faces**2)
        to_faces = np.diff(opening_to(self.faces, self.faces), axis=1)
        to_centres = np.diff(opening_to(self.centres, self.faces), axis=1)
        self.opening = to_faces
        widths = np.diff(self.faces)[:, None]
        moment = lambda r, w: 2 * np.pi * r[:, None] * w
        self.volume = widths / 6 * (moment(self.faces[:-1], to_faces[:-1])
                                    + 4 * moment(self.centres, to_centres)
                                    + moment(self.faces[1:], to_faces[1:]))  # fmt: skip
        root = np.sqrt((1 - self.faces) * (1 + self.faces))
        self.intensity = -2 / np.sqrt(np.pi) * np.diff(root)


def corners(modulus: float, toughness: float, viscosity: float, rate: float, time: float) -> dict:
    """Radius and opening in the middle where viscosity alone or toughness alone counts (Savitski and
    Detournay 2002)."""
    k, m = 4 * np.sqrt(2 / np.pi) * toughness, 12 * viscosity
    corner = {"viscosity": (.6944 * (rate**3 * modulus * time**4 / m) ** (1 / 9),
                            1.1901 * (m**2 * rate**3 * time / modulus**2) ** (1 / 9))}  # fmt: skip
    if k > 0:
        corner["toughness"] = (.8546 * (modulus * rate * time / k) ** (2 / 5),
                               .6537 * (k**4 * rate * time / modulus**4) ** (1 / 5))  # fmt: skip
    return corner


def dimensionless_toughness(modulus, toughness, viscosity, rate, time):
    """Below 1 viscosity decides, above 3.5 toughness."""
    k, m = 4 * np.sqrt(2 / np.pi) * toughness, 12 * viscosity
    return k * (time**2 / (m**5 * rate**3 * modulus**13)) ** (1 / 18)


@dataclass
class History:
    rows: list[tuple[float, ...]] = field(default_factory=list)
    # opening: in the middle; pressures are net: of the disc its mean over area, `mean` over volume
    names = ("time", "radius", "opening", "disc_pressure", "mean_pressure", "volume")

    def column(self, name: str) -> Array:
        return np.array(self.rows)[:, self.names.index(name)]

    def at(self, name: str, times: Array) -> Array:
        """Straight lines between logarithms."""
        return np.exp(np.interp(np.log(times), np.log(self.column("time")), np.log(self.column(name))))


class StepFailed(Exception):
    pass


class March:
    def __init__(self, modulus: float, toughness: float, viscosity: float, rate: float, start: float,
                 source: float, mesh: Mesh):  # fmt: skip
        """`source`: radius [m] of the disc that the fluid enters by; where it is more than .3 of the
        crack's, that."""
        self.modulus, self.toughness, self.thickness = modulus, toughness, 12 * viscosity
        self.rate, self.source, self.mesh = rate, source, mesh
        corner = corners(modulus, toughness, viscosity, rate, start).values()
        self.time, self.radius = start, 0.9 * min(c[0] for c in corner)
        # Even pressure less what falls towards the edge as viscosity has it; K and volume are as they should.
        falling = (1 - mesh.centres) ** (-1 / 3)
        responses = [(np.sqrt(self.radius) * (mesh.intensity @ p), self.volume(self.radius, p).sum())
                     for p in (np.ones_like(falling), falling)]  # fmt: skip
        even, fall = np.linalg.solve(np.transpose(responses), (toughness, rate * start))
        self.pressure = even + fall * falling
        self.times, self.radii = [start], [self.radius]
        self.volumes = [self.volume(self.radius, self.pressure)]
        self.history = History()
        self.record()

    def volume(self, radius: float, p: Array) -> Array:
        return radius**3 / self.modulus * (self.mesh.volume @ p)

    def shares(self, radius: float) -> Array:
        """Of the source's area in each ring."""
        disc = min(self.source / radius, 0.3)
        return np.diff(np.minimum(self.mesh.faces, disc) ** 2) / disc**2

    def weights(self, step: float) -> tuple[float, float, float]:
        """Of the rate at the step's end: values there, at its start, and one step before."""
        if len(self.times) < 2:
            return 1 / step, -1 / step, 0.0
        r = step / (self.times[-1] - self.times[-2])
        return (1 + 2 * r) / (1 + r) / step, -(1 + r) / step, r * r / (1 + r) / step

    def rate_of(self, new, past: list, step: float):
        weights = self.weights(step)
        return weights[0] * new + weights[1] * past[-1] + weights[2] * past[0]

    def speed(self, radius: float, step: float) -> float:
        """Differences in logarithms: the radius goes with a power of time."""
        if len(self.times) < 2:
            return (radius - self.radii[-1]) / step
        time = self.times[-1] + step
        last = np.log(time / self.times[-1])
        r = last / np.log(self.times[-1] / self.times[-2])
        grown, before = np.log(radius / self.radii[-1]), np.log(self.radii[-1] / self.radii[-2])
        return radius / time / last * ((1 + 2 * r) / (1 + r) * grown - r * r / (1 + r) * before)

    def residual(self, radius: float, p: Array, step: float) -> tuple[Array, Array]:
        """Volume balance of each ring and K - K_IC; their derivatives by p."""
        mesh, E = self.mesh, self.modulus
        inner, gaps = mesh.faces[1:-1], np.diff(mesh.centres)
        slope = radius / E * mesh.opening[1:-1]
        w = slope @ p
        gradient = np.diff(p) / (gaps * radius)
        drift = inner * self.speed(radius, step)  # of the mesh
        around = 2 * np.pi * inner * radius
        flux = around * (-(w**3) / self.thickness * gradient - w * drift)
        by_p = (around * (-3 * w**2 / self.thickness * gradient - drift))[:, None] * slope
        carried = around * w**3 / self.thickness / (gaps * radius)
        rows = np.arange(len(inner))
        by_p[rows, rows + 1] -= carried
        by_p[rows, rows] += carried

        balance = self.rate_of(self.volume(radius, p), self.volumes, step) - self.rate * self.shares(radius)
        balance += np.diff(np.concatenate(([0.0], flux, [0.0])))
        none = np.zeros((1, len(p)))
        J = self.weights(step)[0] * radius**3 / E * mesh.volume + np.diff(np.vstack((none, by_p, none)), axis=0)
        excess = np.sqrt(radius) * (mesh.intensity @ p) - self.toughness
        return np.append(balance, excess), np.vstack((J, np.sqrt(radius) * mesh.intensity))

    def solve(self, step: float) -> tuple[float, Array]:
        """Newton's method; the column of the radius by differences."""
        radius, p = self.radius, self.pressure.copy()
        if len(self.times) > 1:
            growth = np.log(radius / self.radii[-2]) / np.log(self.times[-1] / self.times[-2])
            radius *= (1 + step / self.time) ** growth
        for _ in range(25):
            value, J = self.residual(radius, p, step)
            small = 1e-7 * radius
            column = (self.residual(radius + small, p, step)[0] - value) / small
            scale = np.append(np.full(len(p), np.abs(p).max()), radius)
            J = np.hstack((J, column[:, None])) * scale
            rows = np.abs(J).max(axis=1)
            change = np.linalg.solve(J / rows[:, None], -value / rows)
            if not np.isfinite(change).all():
                raise StepFailed
            part = min(1.0, 0.1 / max(abs(change[-1]), 1e-300))
            for _ in range(12):
                trial = p + part * (change * scale)[:-1]
                if (self.mesh.opening[:-1] @ trial).min() > 0:
                    break
                part /= 2
            else:
                raise StepFailed
            radius, p = radius * (1 + part * change[-1]), trial
            if part == 1 and np.abs(change[:-1]).max() < 1e-6 and abs(change[-1]) < 1e-9:
                return radius, p
        raise StepFailed

    def step(self, step: float) -> None:
        radius, p = self.solve(step)
        if not 0 < radius / self.radius - 1 < 0.06:
            raise StepFailed
        self.times = [self.time, self.time + step]
        self.radii = [self.radius, radius]
        self.volumes = [self.volumes[-1], self.volume(radius, p)]
        self.time, self.radius, self.pressure = self.time + step, radius, p
        self.record()

    def record(self) -> None:
        p, volumes = self.pressure, self.volumes[-1]
        opening = self.radius / self.modulus * (self.mesh.opening @ p)
        self.history.rows.append((self.time, self.radius, opening[0], self.shares(self.radius) @ p,
                                  volumes @ p / volumes.sum(), volumes.sum()))  # fmt: skip

    def run(self, end: float, change: float) -> History:
        """To time `end`: steps in which the radius grows by `change` of itself."""
        step = 0.01 * self.time
        while self.time < end * (1 - 1e-12):
            step = min(step, end - self.time)
            old = self.radius
            try:
                self.step(step)
            except StepFailed:
                step /= 2
                if step < 1e-9 * self.time:
                    raise RuntimeError(f"no step found at {self.time:g} s, radius {self.radius:g} m")
                continue
            step *= min(1.3, max(0.5, change / (self.radius / old - 1)))
        return self.history


def march(modulus: float, toughness: float, viscosity: float, rate: float, end: float, *,
          source: float, cells: int = 40, change: float = 0.02, start: float = 1e-4,
          at_edge: float = 1e-8, halvings: int = 0) -> March:  # fmt: skip
    """From `start` x `end` to `end`; `rate` [m^3/s] feeds the whole crack."""
    final = min(c[0] for c in corners(modulus, toughness, viscosity, rate, end).values())
    mesh = Mesh(cells, at_edge, min(source / final / 4, 1.5 / cells), halvings)
    found = March(modulus, toughness, viscosity, rate, start * end, source, mesh)
    found.run(end, change)
    return found


def unit_march(K: float, source: float, **options) -> March:
    """At time 1, for E' = 1 GPa, mu = 1 mPa s and 1 cm^3/s; `source` in shares of (Q^3 E' t^4/mu')^(1/9)."""
    modulus, viscosity, rate = 1e9, 1e-3, 1e-6
    toughness = K / dimensionless_toughness(modulus, 1.0, viscosity, rate, 1.0)
    length = (rate**3 * modulus / (12 * viscosity)) ** (1 / 9)
    return march(modulus, toughness, viscosity, rate, 1.0, source=source * length, **options)


def table_row(K: float, source: float, **options) -> tuple[float, ...]:
    """Radius over that length, opening over (mu'^2 Q^3 t/E'^2)^(1/9), pressure at the source and mean over
    (E'^2 mu'/t)^(1/3)."""
    found = unit_march(K, source, **options)
    length, thin = (1e-18 * 1e9 / 0.012) ** (1 / 9), (0.012 / 1e9) ** (1 / 3)
    _, radius, opening, disc, mean, _ = found.history.rows[-1]
    return radius / length, opening / (thin * length), disc / (1e9 * thin), mean / (1e9 * thin)


# Checks, run by --test


def check(what: str, value: float, expected: float, tolerance: float) -> None:
    print(f"{what:62s} {value:11.5g} expected {expected:9.5g}, {value / expected - 1:+.2e}")
    assert abs(value / expected - 1) <= tolerance, what


def test_kernel() -> None:
    r = np.linspace(0, 1, 17)
    assert np.abs(opening_to(r, np.array([1.0]))[:, 0] - 8 / np.pi * np.sqrt(1 - r * r)).max() < 1e-14
    fine = np.linspace(0, 1, 400001)
    middle = (fine[1:] + fine[:-1]) / 2
    for at, end in ((0.3, 0.6), (0.6, 0.3), (0.3, 0.3), (0.0, 0.5), (0.95, 0.99)):
        s = np.sqrt(at**2 + (1 - at**2) * middle**2)  # of Sneddon's double integral the outer one
        inner = s - np.sqrt(np.maximum(s**2 - end**2, 0))
        brute = 8 / np.pi * np.sqrt(1 - at**2) * np.mean(inner / s)
        check(f"kernel against quadrature: {at} from {end}", opening_to(np.array([at]), np.array([end]))[0, 0],
              brute, 1e-7)  # fmt: skip


def test_corners() -> None:
    for name, K, tolerance in (("viscosity", 0.1, 1e-2), ("toughness", 8.0, 2e-3)):
        found = unit_march(K, 1e-3)
        expected = corners(1e9, found.toughness, 1e-3, 1e-6, 1.0)[name]
        last = dict(zip(History.names, found.history.rows[-1]))
        for quantity, reference in zip(("radius", "opening"), expected):
            check(f"{name} corner (K {K}): {quantity}", last[quantity], reference, tolerance)
        check(f"{name} corner (K {K}): volume", last["volume"], 1e-6, 1e-12)
        power = np.log(last["radius"] / found.history.at("radius", 0.1)) / np.log(10)
        check(f"{name} corner (K {K}): power of time of the radius", power, {0.1: 4 / 9, 8.0: 2 / 5}[K], 2e-3)


def test_reciprocity() -> None:
    """The volume tells the mean of the pressure weighted by the opening under an even one."""
    for K in (0.1, 2.0):
        found = unit_march(K, 1e-2)
        mesh = found.mesh
        weights = -np.diff(((1 - mesh.faces) * (1 + mesh.faces)) ** 1.5)
        check(f"K {K}: mean pressure by the volume", 3e9 * 1e-6 / (16 * found.radius**3),
              weights @ found.pressure, 1e-4)  # fmt: skip


def test_edge() -> None:
    """w^3 = (K' s^(1/2)/E')^3 + 2 3^(5/2) mu' V/E' s^2, good to about .8 % behind a straight front."""
    for K in (0.1, 1.0, 2.0, 4.0):
        found = unit_march(K, 1e-2, start=1e-3)
        mesh, h = found.mesh, found.history
        speed = found.radius * np.log(h.rows[-1][1] / h.rows[-2][1]) / np.log(h.rows[-1][0] / h.rows[-2][0])
        w = found.radius / 1e9 * (mesh.opening @ found.pressure)
        for share in (1e-4, 1e-3, 1e-2):
            s = share * found.radius
            tough = 4 * np.sqrt(2 / np.pi) * found.toughness * np.sqrt(s) / 1e9
            expected = (tough**3 + 2 * 3**2.5 * 0.012 * speed / 1e9 * s**2) ** (1 / 3)
            value = np.exp(np.interp(np.log(share), np.log(1 - mesh.faces[-2::-1]), np.log(w[-2::-1])))
            check(f"K {K}: opening at {share:g} R from the edge", value, expected, 8e-3)


def test_source() -> None:
    """Friction about the source: log of the radius outside, and within a disc fed evenly a parabola."""
    wide, narrow = unit_march(4.0, 2e-2), unit_march(4.0, 5e-3)
    last = dict(zip(History.names, narrow.history.rows[-1]))
    friction = 0.012 * 1e-6 / (2 * np.pi * last["opening"] ** 3)
    fall = last["disc_pressure"] - wide.history.rows[-1][3]
    check("a source of a quarter the radius: pressure", fall, friction * np.log(4), 1e-2)
    ring = np.interp(4 * narrow.source / narrow.radius, narrow.mesh.centres, narrow.pressure)
    check("fall to four radii of the source", last["disc_pressure"] - ring, friction * (np.log(4) + 1 / 4), 1e-2)


def test_convergence() -> None:
    """Rings and steps are halved twice. The disc's rim falls anywhere in a ring: no order of its pressure."""
    rows = [np.array(table_row(1.0, 0.05, cells=10, halvings=k, change=0.04 / 2**k, start=1e-2))
            for k in range(3)]  # fmt: skip
    for k, name in enumerate(("radius", "opening", "source pressure", "mean pressure")):
        check(f"{name}: halved", rows[1][k], rows[2][k], 1e-3)
        if name != "source pressure":
            order = np.log2(abs(rows[1][k] - rows[0][k]) / abs(rows[2][k] - rows[1][k]))
            print(f"{name}, {', '.join(f'{r[k]:.6f}' for r in rows)}: order {order:.2f}")
            assert order > 1.5
    later = table_row(1.0, 0.05, cells=10, change=0.04, start=1e-4)
    check("start 100 times earlier: radius", rows[0][0], later[0], 1e-5)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = lambda name, default, text: parser.add_argument(name, type=float, default=default, help=text)
    add("--young", 20e9, "[Pa]")
    add("--poisson", 0.25, "")
    add("--energy", 20.0, "Gc [J/m^2]")
    add("--viscosity", 4e-3, "[Pa s]")
    add("--rate", 2e-8, "of the whole crack [m^3/s]")
    add("--source", 0.92e-3, "radius of the disc that the fluid enters by [m]")
    add("--end", 0.1, "[s]")
    parser.add_argument("--cells", type=int, default=40)
    parser.add_argument("--rows", type=int, default=20, help="equal steps of time to print")
    parser.add_argument("--test", action="store_true", help="verify this script")
    a = parser.parse_args()
    if a.test:
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
        return
    modulus = a.young / (1 - a.poisson**2)
    toughness = np.sqrt(a.energy * modulus)
    h = march(modulus, toughness, a.viscosity, a.rate, a.end, source=a.source, cells=a.cells).history
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow((*h.names, "dimensionless_toughness"))
    for time in np.linspace(0, a.end, a.rows + 1)[1:]:
        K = dimensionless_toughness(modulus, toughness, a.viscosity, a.rate, time)
        writer.writerow([f"{v:.6g}" for v in (time, *(h.at(name, time) for name in h.names[1:]), K)])


if __name__ == "__main__":
    main()

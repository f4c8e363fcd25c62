#!/usr/bin/env python3
"""A tip that moves within its facet, tried out: KGD on facets of one size, without a lattice.

The facet that the tip is within is cut, and held together by a spring: every answer of the body is
between that without the cut and that with it (docs/decisions/0018-the-tip-between-facets.md). The
tip is where the openings behind it are those of its asymptote (implicit level sets). Two kernels:
`dd`, displacement discontinuities constant on each facet, whose facets at the tip open too far as a
lattice's do; `exact`, the opening in the middle of facets by kgd.py. Prints errors of length, net
pressure and opening against the self-similar solution, how far pressure is from going as t^(-1/3),
and where the energy goes. Not used by the simulator.
"""

from __future__ import annotations

import argparse

import numpy as np

from kgd import InfiniteBody
from lubrication import Array

MODULUS, RATE, VISCOSITY = 1e9, 1e-4, 12e-3  # E', into both wings, 12 mu; a facet is 1 m long
SOLUTION = {  # K_m: gamma, Omega, Pi, by kgd.table_row
    0.1: (0.61542, 1.12563, 0.54484), 0.3: (0.61504, 1.12595, 0.54506), 1.0: (0.59930, 1.14132, 0.55582),
    3.0: (0.43427, 1.48172, 0.87677), 10.0: (0.20082, 3.17046, 3.94803),
}  # fmt: skip


def compliance(count: int, kernel: str) -> Array:
    """Openings of the facets of one wing by unit pressures, its mirror image with it."""
    middle, h = np.arange(count) + 0.5, 0.5
    if kernel == "exact":
        return np.diff(InfiniteBody(MODULUS).opening_to(middle, np.arange(count + 1.0), float(count)), axis=1)
    stiff = lambda d: -MODULUS / (4 * np.pi) * 2 * h / (d * d - h * h)  # noqa: E731
    x, y = middle[:, None], middle[None, :]
    return np.linalg.inv(stiff(x - y) + stiff(x + y))


class Facet:
    """The `count`th facet while a tip crosses it; `part` is how much of it the tip has."""

    def __init__(self, count: int, kernel: str, toughness: float):
        self.count, self.toughness = count, toughness  # K'
        self.cut, self.uncut = compliance(count, kernel), np.zeros((count, count))
        self.uncut[:-1, :-1] = compliance(count - 1, kernel)
        self.own = self.cut[-1, -1]
        one = [0.5 * (compliance(n, kernel).sum() - compliance(n - 1, kernel).sum())
               for n in (count - 1, count, count + 1)]  # fmt: skip
        self.release, self.curvature = one[1], np.log(one[2] / one[0]) / 2

    def opened(self, part: float) -> float:
        return part + self.curvature * (part * part - part) / 2

    def slope(self, part: float) -> float:
        return 1 + self.curvature * (part - 0.5)

    def response(self, part: float) -> Array:
        return self.uncut + self.opened(part) * (self.cut - self.uncut)

    def law(self, s: float, whole: float, speed: float, toughness: float) -> float:
        """w^3 of toughness and viscosity, s behind a tip of a crack of half length `whole`."""
        dry = toughness / MODULUS * np.sqrt(s * (1 - s / (2 * whole)))
        return np.cbrt(dry**3 + 2 * 3**2.5 * VISCOSITY * speed / MODULUS * s * s)

    def readiness(self, part: float, opening: Array, speed: float) -> float:
        """The openings behind the tip over the asymptote: of the last whole facet, and of the one
        before, which count by `part` so that nothing jumps from facet to facet."""
        whole = self.count - 1 + part
        even = self.response(part).sum(axis=1)
        intensity = np.sqrt(32 / np.pi * self.slope(part) * self.release * MODULUS)

        def of(behind: int) -> float:
            s = part + behind - 0.5
            asked = even[-1 - behind] / self.law(s, whole, 0.0, intensity)
            return opening[-1 - behind] / (asked * self.law(s, whole, speed, self.toughness))

        return (1 - part) * of(2) + part * of(1)


class March:
    """From `first` facets to `last`, `steps` a facet; a step ends where its tip is due there."""

    def __init__(self, K_m: float, kernel: str, first: int, last: int, steps: int):
        self.kernel, self.last, self.steps = kernel, last, steps
        self.toughness = K_m * (VISCOSITY * RATE * MODULUS**3) ** 0.25
        self.energy_to_cut = self.toughness**2 * np.pi / 32 / MODULUS
        gamma, _, pressure = SOLUTION[K_m]
        t = (first / gamma / (MODULUS * RATE**3 / VISCOSITY) ** (1 / 6)) ** 1.5
        self.p = np.full(first, 0.6 * pressure * MODULUS * (VISCOSITY / (MODULUS * t)) ** (1 / 3))
        self.opening = compliance(first, kernel) @ self.p
        self.t = self.opening.sum() / (RATE / 2)
        self.rows: list[tuple[float, float, float, float]] = []
        self.energy = dict(work=0.0, stored=0.0, released=0.0, cut=0.0)

    def residual(self, facet: Facet, x: Array, part: float, before: float) -> Array:
        p, dt = x[:-1], np.exp(x[-1])
        w = facet.response(part) @ p
        flux = (0.5 * (w[1:] + w[:-1])) ** 3 / VISCOSITY * (p[:-1] - p[1:])
        balance = w - self.held
        balance[0] -= RATE / 2 * dt
        balance[:-1] += dt * flux
        balance[1:] -= dt * flux
        ready = facet.readiness(part, w, (part - before) / dt)
        return np.append(balance / (RATE / 2 * self.scale), np.log(max(ready, 1e-9)))

    def step(self, facet: Facet, part: float, before: float, dt: float) -> float:
        x, self.scale = np.append(self.p, np.log(dt)), dt
        sizes = np.append(np.full(facet.count, max(np.abs(self.p).max(), 1.0)), 1.0) * 1e-6
        for _ in range(80):
            F = self.residual(facet, x, part, before)
            if np.abs(F).max() < 1e-9:
                break
            moved = [self.residual(facet, x + d, part, before) for d in np.diag(sizes)]
            change = np.linalg.solve((np.array(moved) - F).T / sizes, -F)
            w, more = facet.response(part) @ x[:-1], facet.response(part) @ change[:-1]
            shrinks = np.max(-more / np.maximum(w, 1e-12))
            x = x + change * min(1.0, 0.7 / max(shrinks, 1e-9), 1 / max(abs(change[-1]), 1e-9))
        else:
            raise RuntimeError("Newton's method does not converge")
        self.p = x[:-1]
        return float(np.exp(x[-1]))

    def cross(self, facet: Facet, dt: float) -> float:
        old = np.append(self.p, 0.0)
        w_old = np.append(self.opening, 0.0)
        self.p, self.held = np.append(self.p, 0.999 * self.p[-1]), w_old.copy()
        before = 0.0
        for part in np.arange(1, self.steps + 1) / self.steps:
            dt = self.step(facet, part, before, dt)
            self.t += dt
            self.opening = facet.response(part) @ self.p
            e, opens = self.energy, facet.opened(part) - facet.opened(before)
            e["work"] += 0.5 * (old + self.p) @ (self.opening - w_old)
            e["stored"] += 0.5 * (self.p @ self.opening - old @ w_old)
            e["released"] += 0.5 * opens * (facet.cut[-1] @ old) * (facet.cut[-1] @ self.p) / facet.own
            e["cut"] += self.energy_to_cut * (part - before)
            self.rows.append((self.t, facet.count - 1 + part, self.p[0], self.opening[0]))
            old, w_old, before = self.p.copy(), self.opening.copy(), part
            self.held = w_old
        return dt

    def run(self) -> Array:
        dt = 0.02 * self.t
        for count in range(len(self.p) + 1, self.last + 1):
            dt = self.cross(Facet(count, self.kernel, self.toughness), dt)
        return np.array(self.rows)


def errors(K_m: float, rows: Array, last: int) -> tuple[float, ...]:
    """In %, from 0.75 to 0.95 of the last length: means of length, pressure, opening; swing of
    pressure beyond t^(-1/3)."""
    gamma, Omega, Pi = SOLUTION[K_m]
    t, length, pressure, opening = rows.T
    scale, thin = (MODULUS * RATE**3 * t**4 / VISCOSITY) ** (1 / 6), (VISCOSITY / (MODULUS * t)) ** (1 / 3)
    exact = Omega * thin * scale
    fall = VISCOSITY * RATE / 2 * 0.5 / exact**3  # from the inlet to the middle of its facet
    among = (length >= 0.75 * last) & (length <= 0.95 * last)
    mean = lambda v: 100 * (np.average(v[among], weights=np.gradient(t)[among]) - 1)  # noqa: E731
    swing = (pressure * t ** (1 / 3))[among]
    return (mean(length / (gamma * scale)), mean(pressure / (Pi * MODULUS * thin - fall)),
            mean(opening / exact), 100 * (swing.max() / swing.min() - 1))  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--facets", type=int, nargs="+", default=[10, 20, 40])
    parser.add_argument("--steps", type=int, default=8, help="of a facet")
    given = parser.parse_args()
    print("kernel K_m facets: errors of length, pressure, opening, swing of pressure [%]; of the work on the")
    print("faces: stored, what Gc takes, what viscosity takes in the tip's facet, what is left open")
    for kernel in ("dd", "exact"):
        for K_m in (0.1, 1.0, 3.0, 10.0):
            for facets in given.facets:
                march = March(K_m, kernel, max(4, facets // 3), facets, given.steps)
                line = " ".join(f"{e:6.2f}" for e in errors(K_m, march.run(), facets))
                e = march.energy
                tip, left = e["released"] - e["cut"], e["work"] - e["stored"] - e["released"]
                shares = " ".join(f"{v / e['work']:6.3f}" for v in (e["stored"], e["cut"], tip))
                # The difference of two exact answers in the middle of facets is not of rank one.
                open_ = f"{abs(left) / e['work']:.0e}" if kernel == "dd" else "-"
                print(f"{kernel:6s}{K_m:5g}{facets:4d}: {line} | {shares} {open_}", flush=True)


if __name__ == "__main__":
    main()

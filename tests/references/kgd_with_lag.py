#!/usr/bin/env python3
"""Plane-strain hydraulic fracture of two wings whose fluid lags behind the tips, over the whole range of
time: no leak-off, incompressible Newtonian fluid, constant rate, a stress that closes the crack.

All is dimensionless: E' = 1, mu' = 12 mu = 1, rate Q of both wings = 1, far-field stress = 1 (Garagash
2006; Lecampion and Detournay 2007). Units, with t_om = E'^2 mu' / stress^3:

    time t_om    pressure stress    length L = (Q t_om E' / stress)^(1/2)    opening stress L / E'

What is left is K_m = K' / (mu' Q E'^3)^(1/4) and T = t / t_om. Pressures are whole: zero in the lag, so that
net pressure is -1 there.

Elasticity: pressure is continuous and linear between nodes; the moments of the logarithmic kernel (Spence
and Sharp 1985) are in closed form. Flow: control volumes around nodes that are fixed in x / front and fine
at the front. The last one, which nothing leaves, says how fast the front is. Steps are even in log T (BDF2),
all unknowns at once: pressures, front, lag. The march starts with the self-similar solution for no stress.
Nothing is shared with kgd.py and lubrication.py, which are one of the checks.
"""

from __future__ import annotations

import argparse
import csv
import sys
from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass
class State:
    time: float
    front: float
    lag: float
    pressure: Array  # at the nodes but the last, where it is zero

    @property
    def length(self) -> float:
        return self.front + self.lag


def graded_nodes(cells: int, smallest: float) -> Array:
    """Distance from the front over its own from the inlet, 1 to 0: shrinking by a constant ratio."""
    ratio, widths = 1 + 4 / cells, [smallest]
    while sum(widths) < 1:
        widths.append(min(widths[-1] * ratio, 1.5 / cells))
    back = np.concatenate(([0.0], np.cumsum(widths)))
    return back[::-1] / back[-1]


class Elasticity:
    """A crack |x| < length in an infinite body with E' = 1; places by their distance to the tip, which
    keeps digits near it."""

    def __init__(self, points: Array, nodes: Array, length: float):
        """`points` where openings are asked, `nodes` between which pressure is linear."""
        zeroth, first = self.moments(points[:, None] / length, nodes[None, :] / length)
        x = 1 - nodes / length
        self.opening = 4 * length / np.pi * hats(zeroth, first, x)  # of unit pressure at each node
        root = np.sqrt(np.maximum(nodes / length * (2 - nodes / length), 0))
        self.intensity = 2 * np.sqrt(length / np.pi) * hats(np.arcsin(x)[None], -root[None], x)[0]
        self.stress_opening = 4 * length * np.sqrt(points / length * (2 - points / length))
        self.stress_intensity = np.sqrt(np.pi * length)

    @staticmethod
    def moments(dx: Array, ds: Array) -> tuple[Array, Array]:
        """int G ds and int s G ds from 0 to s of G = ln |(A + B) / (A - B)|, A^2 = 1 - x^2, B^2 = 1 - s^2,
        the latter but for what does not depend on s; dx, ds are 1 - x, 1 - s."""
        x, s = 1 - dx, 1 - ds
        A, B = np.sqrt(dx * (2 - dx)), np.sqrt(np.maximum(ds * (2 - ds), 0))
        apart = np.abs((dx - ds) * (s + x))  # |A^2 - B^2|
        same = apart == 0
        safe = np.where(same, 1.0, apart)
        kernel = np.log((A + B) ** 2 / safe)
        cross = np.log(np.maximum((s * A + x * B) ** 2, 1e-300) / safe)
        # s ln(.) - x ln(.) has a limit where s = x: 2 x ln(1 / x), the logarithms of `apart` cancel
        zeroth = np.where(same, -2 * x * np.log(np.maximum(x, 1e-300)), s * kernel - x * cross)
        first = np.where(same, 0.0, (s - x) * (s + x) / 2 * kernel) - A * B
        return zeroth + 2 * A * np.arcsin(np.minimum(s, 1.0)), first


def hats(zeroth: Array, first: Array, x: Array) -> Array:
    """From moments up to each node to the integrals against each node's hat function."""
    width = np.diff(x)
    m0, m1 = np.diff(zeroth, axis=-1), np.diff(first, axis=-1)
    left, right = (x[1:] * m0 - m1) / width, (m1 - x[:-1] * m0) / width
    total = np.zeros_like(zeroth)
    total[..., :-1] += left
    total[..., 1:] += right
    return total


class Fracture:
    """Residuals of a step; the stress is 1, or 0 for the early solution."""

    def __init__(self, K_m: float, cells: int = 40, smallest: float = 1e-5, stress: float = 1.0):
        self.toughness = K_m / (4 * np.sqrt(2 / np.pi))  # K_IC
        self.stress = stress
        self.back = graded_nodes(cells, smallest)
        middles = (self.back[1:] + self.back[:-1]) / 2
        # Nodes, middles of elements, and the quarters between: openings at these
        self.points = np.sort(np.concatenate((self.back, middles, (self.back[1:] + middles) / 2,
                                              (self.back[:-1] + middles) / 2)))[::-1]  # fmt: skip
        self.halves = -np.diff(np.sort(np.concatenate((self.back, middles)))[::-1])

    def elastic(self, s: State) -> Elasticity:
        return Elasticity(s.front * self.points + s.lag, s.front * self.back + s.lag, s.length)

    def openings(self, s: State, e: Elasticity) -> Array:
        return e.opening[:, :-1] @ s.pressure - self.stress * e.stress_opening

    def volumes(self, w: Array, front: float) -> Array:
        """Of the control volumes, from middle to middle of the elements (Simpson's rule by halves)."""
        half = front * self.halves * (w[:-2:2] + 4 * w[1::2] + w[2::2]).T / 6
        half = half.T
        whole = np.zeros((len(self.back), *half.shape[1:]))
        whole[:-1] += half[::2]
        whole[1:] += half[1::2]
        return whole

    def residual(self, s: State, e: Elasticity, growth: Array, speed: float) -> Array:
        """`growth` = d(volumes)/dt; per wing."""
        w = self.openings(s, e)[2::4]  # in the middle of elements
        p = np.append(s.pressure, 0.0)
        x = s.front * (1 - (self.back[1:] + self.back[:-1]) / 2)
        flux = w**3 * np.diff(p) / (s.front * np.diff(self.back))  # back falls from node to node
        through = np.concatenate(([0.5], flux - w * x / s.front * speed, [0.0]))
        K = e.intensity[:-1] @ s.pressure - self.stress * e.stress_intensity
        return np.append(growth + np.diff(through), K - self.toughness)

    def jacobian_of_pressures(self, s: State, e: Elasticity, weight: float, speed: float) -> Array:
        n = len(self.back)
        W = e.opening[:, :-1]
        w = self.openings(s, e)[2::4]
        p = np.append(s.pressure, 0.0)
        x = s.front * (1 - (self.back[1:] + self.back[:-1]) / 2)
        span = s.front * np.diff(self.back)
        slope = np.diff(np.eye(n), axis=0)[:, :-1] / span[:, None]
        flux = (3 * w**2 * np.diff(p) / span - x / s.front * speed)[:, None] * W[2::4] + w[:, None] ** 3 * slope
        zero = np.zeros((1, n - 1))
        J = weight * self.volumes(W, s.front) + np.diff(np.vstack((zero, flux, zero)), axis=0)
        return np.vstack((J, e.intensity[None, :-1]))

    def solve(self, guess: State, rates) -> State:
        """Newton's method. `rates(state, volumes)` gives growth of volumes, speed of the front, and the
        weight of the newest volumes in that growth."""

        def at(s: State) -> tuple[Array, Elasticity, float, float]:
            e = self.elastic(s)
            growth, speed, weight = rates(s, self.volumes(self.openings(s, e), s.front))
            return self.residual(s, e, growth, speed), e, speed, weight

        s = guess
        for _ in range(60):
            r, e, speed, weight = at(s)
            columns = [self.jacobian_of_pressures(s, e, weight, speed)]
            for front, lag in ((1e-7 * s.front, 0.0), (0.0, 1e-7 * s.lag)):
                moved = at(State(s.time, s.front + front, s.lag + lag, s.pressure))[0]
                columns.append(((moved - r) / (front + lag))[:, None])
            unit = np.append(np.full(len(s.pressure), np.abs(s.pressure).max()), (s.front, s.lag))
            J = np.hstack(columns) * unit
            rows = np.abs(J).max(axis=1)
            change = np.linalg.solve(J / rows[:, None], -r / rows)
            part = min(1.0, 0.3 / np.abs(change[-2:]).max(), 0.5 / np.abs(change[:-2]).max())
            for _ in range(12):
                step = part * change * unit
                new = State(s.time, s.front + step[-2], s.lag + step[-1], s.pressure + step[:-2])
                if self.openings(new, self.elastic(new)).min() > 0:
                    break
                part /= 2
            else:
                raise RuntimeError("openings stay negative")
            s = new
            if part == 1 and np.abs(change[:-1]).max() < 1e-9 and abs(change[-1]) < 1e-6:
                return s
        raise RuntimeError(f"no solution at time {guess.time:g}")

    def self_similar(self, guess: State) -> State:
        """For no stress: volumes go with t, the front with t^(2/3)."""
        assert self.stress == 0
        return self.solve(guess, lambda s, v: (v / s.time, s.front * 2 / 3 / s.time, 1 / s.time))


def early(K_m: float, time: float = 1.0, **mesh) -> State:
    """The self-similar solution for no stress, reached from a tougher crack."""
    state = None
    K = 2.0
    while True:
        f = Fracture(K, stress=0.0, **mesh)
        if state is None:
            x = 1 - f.back[:-1]
            state = State(1.0, 0.5, 0.03, 0.9 * (1 - x**8) + 0.2)
        state = f.self_similar(state)
        if K == K_m:
            break
        K = max(K / 1.15, K_m) if K > K_m else min(K * 1.15, K_m)
    growth = time ** (2 / 3)
    return State(time, state.front * growth, state.lag * growth, state.pressure / time ** (1 / 3))


NAMES = ("time", "length", "lag", "pressure", "opening", "volume", "intensity")


class March:
    """History from `start` on; columns are NAMES, `volume` that of the fluid of one wing."""

    def __init__(self, K_m: float, start: float = 1e-6, cells: int = 40, smallest: float = 1e-5,
                 stress: float = 1.0, rise: float = 0.0):  # fmt: skip
        """The stress is `stress` + `rise` T: a body held at its faces presses back on what is pumped in."""
        self.first_stress, self.rise = stress, rise
        self.fracture = Fracture(K_m, cells, smallest, stress)
        self.state = early(K_m, start, cells=cells, smallest=smallest)
        free = Fracture(K_m, cells, smallest, stress=0.0)
        e = free.elastic(self.state)
        w = free.openings(self.state, e)
        self.past = [(self.state, free.volumes(w, self.state.front))]
        self.rows: list[tuple[float, ...]] = []
        self.record(self.state, e, w)

    def record(self, s: State, e: Elasticity, w: Array) -> None:
        K = e.intensity[:-1] @ s.pressure - self.fracture.stress * e.stress_intensity
        volume = self.fracture.volumes(w, s.front).sum()
        self.rows.append((s.time, s.length, s.lag, s.pressure[0], w[0], volume, K))

    def step(self, time: float) -> None:
        self.fracture.stress = self.first_stress + self.rise * time
        old, volumes = self.past[-1]
        step = time - old.time
        if len(self.past) > 1:
            before, volumes_before = self.past[-2]
            r = step / (old.time - before.time)
            a, b, c = (1 + 2 * r) / (1 + r) / step, -(1 + r) / step, r * r / (1 + r) / step
        else:
            before, volumes_before, a, b, c = old, volumes, 1 / step, -1 / step, 0.0

        def rates(s: State, v: Array) -> tuple[Array, float, float]:
            return (a * v + b * volumes + c * volumes_before,
                    a * s.front + b * old.front + c * before.front, a)  # fmt: skip

        if len(self.past) > 1:
            reach = np.log(time / old.time) / np.log(old.time / before.time)
            on = lambda new, last: new * (new / last) ** reach
            guess = State(time, on(old.front, before.front), on(old.lag, before.lag), old.pressure)
        else:
            grown = (time / old.time) ** (2 / 3)
            guess = State(time, old.front * grown, old.lag * grown, old.pressure)
        new = self.fracture.solve(guess, rates)
        e = self.fracture.elastic(new)
        w = self.fracture.openings(new, e)
        self.past = [self.past[-1], (new, self.fracture.volumes(w, new.front))]
        self.state = new
        self.record(new, e, w)

    def run(self, end: float, steps_a_decade: float = 25.0, shortest: float = 1e-5) -> March:
        """To `end`, or until the lag is below `shortest` of the length: then there is none."""
        count = int(np.ceil(np.log10(end / self.state.time) * steps_a_decade))
        for time in np.geomspace(self.state.time, end, count + 1)[1:]:
            self.step(time)
            if self.state.lag < shortest * self.state.length:
                break
        return self

    def column(self, name: str) -> Array:
        return np.array(self.rows)[:, NAMES.index(name)]

    def at(self, name: str, times: Array) -> Array:
        """By straight lines in the logarithms."""
        return np.exp(np.interp(np.log(times), np.log(self.column("time")), np.log(self.column(name))))


# Checks, run by --test


def check(what: str, value: float, expected: float, tolerance: float) -> None:
    print(f"{what:58s} {value:11.5g} expected {expected:9.5g}, {value / expected - 1:+.2e}", flush=True)
    assert abs(value / expected - 1) <= tolerance, what


def test_kernel() -> None:
    """Pressure 1 - 2 x up to 0.5, none beyond, in a crack of length 1."""
    nodes = 1 - np.linspace(0, 0.5, 3)
    p = np.array([1.0, 0.5, 0.0])
    s = (np.arange(400000) + 0.5) / 400000 * 0.5
    B = np.sqrt(1 - s * s)
    for x in (0.0, 0.2, 0.25, 0.7):
        A = np.sqrt(1 - x * x)
        brute = 4 / np.pi * np.sum((1 - 2 * s) * np.log(np.abs((A + B) / (A - B)))) * (s[1] - s[0])
        value = Elasticity(np.array([1 - x]), nodes, 1.0).opening[0] @ p
        check(f"opening at {x} under linear pressure: quadrature", value, brute, 2e-5)
    e = Elasticity(np.array([0.5]), nodes, 1.0)
    check("K under linear pressure: quadrature", e.intensity @ p,
          2 / np.sqrt(np.pi) * np.sum((1 - 2 * s) / B) * (s[1] - s[0]), 1e-9)  # fmt: skip
    even = Elasticity(np.array([0.9, 0.5, 1e-6]), 1 - np.linspace(0, 1, 7), 1.0)
    assert np.abs(even.opening.sum(axis=1) / even.stress_opening - 1).max() < 1e-9
    check("K under even pressure", even.intensity.sum(), np.sqrt(np.pi), 1e-12)


def test_superposition() -> None:
    """K by the openings in the lag, of fluid and stress together, is K by the weight function; the volume
    of the whole wing is what reciprocity with an even pressure says."""
    march = March(0.5, 1e-3).run(1e-2)
    s, f = march.state, march.fracture
    points = s.lag * np.array([1e-6, 2e-6])
    e = Elasticity(points, s.front * f.back + s.lag, s.length)
    by_opening = (e.opening[:, :-1] @ s.pressure - e.stress_opening) * np.sqrt(np.pi / 32 / points)
    check("K by the opening in the lag", 2 * by_opening[0] - by_opening[1], f.toughness, 1e-5)
    angle = (np.arange(4000) + 0.5) / 4000 * np.pi / 2
    x = s.length * np.sin(angle)
    e = Elasticity(s.length - x, s.front * f.back + s.lag, s.length)
    weight = s.length * np.cos(angle) * np.pi / 8000
    volume = weight @ (e.opening[:, :-1] @ s.pressure - e.stress_opening)
    pressure = np.interp(x, s.front * (1 - f.back), np.append(s.pressure, 0.0), right=0.0) - 1
    check("volume by reciprocity", volume, weight @ (pressure * e.stress_opening), 1e-5)


def test_volume() -> None:
    march = March(0.5, 1e-4).run(1e-2)
    check("fluid in a wing over what came in", march.column("volume")[-1], 1e-2 / 2, 1e-9)


def test_early() -> None:
    """Without stress a march that begins with half of the lag comes to the self-similar solution, whose
    length goes with t^(2/3), pressure with t^(-1/3)."""
    exact = early(0.5)
    march = March(0.5, 1e-6, stress=0.0)
    s = march.state
    moved = State(s.time, s.front, s.lag / 2, s.pressure)
    march.past[0] = (moved, march.past[0][1])
    march.run(1.0)
    check("no stress: length", march.state.length, exact.length, 1e-3)
    check("no stress: lag", march.state.lag, exact.lag, 1e-3)
    for name, exponent in (("length", 2 / 3), ("lag", 2 / 3), ("pressure", -1 / 3), ("opening", 1 / 3)):
        logs = np.log(march.column(name))[-6:]
        check(f"no stress: exponent of {name}", (logs[-1] - logs[0]) / (5 * np.log(10) / 25), exponent, 1e-3)


def test_late() -> None:
    """Where the lag is no more, the solution without it by kgd.py."""
    from kgd import table_row

    for K_m, end, shortest in ((0.5, 200.0, 3e-5), (1.5, 10.0, 1e-5)):
        march = March(K_m, 1e-4, smallest=1e-6).run(end, shortest=shortest)
        T = march.state.time
        gamma, omega, pi = table_row(K_m, cells=30)
        last = dict(zip(NAMES, march.rows[-1]))
        what = f"K_m {K_m}, T {T:.3g}, lag/length {last['lag'] / last['length']:.1e}: "
        check(what + "length", last["length"] / T ** (2 / 3), gamma, 3e-3)
        check(what + "opening", last["opening"] / T ** (1 / 3), omega, 3e-3)
        check(what + "pressure", (last["pressure"] - 1) * T ** (1 / 3), pi, 3e-3)


def test_beside_kgd() -> None:
    """The march of kgd.py with its lag, which has other cells, kernel, condition at the front and steps."""
    from kgd import solve

    modulus, rate, viscosity, end = 7e8, 1.6e-4, 1e-3, 0.1
    for K_m, T in ((0.5, 0.01), (0.5, 1.0), (1.0, 0.01)):
        mine = March(K_m, 1e-5 * T).run(T)
        toughness = mine.fracture.toughness * (12 * viscosity * rate * modulus**3) ** 0.25
        stress = (T * modulus**2 * 12 * viscosity / end) ** (1 / 3)
        other = solve(modulus, toughness, viscosity, rate, end, lag=True, stress=stress, smallest=1e-5, start=1e-4)
        row = other.rows[-1]
        unit = np.sqrt(rate * end / T * modulus / stress)
        for name, value, tolerance in (("length", row[1] / unit, 1e-3), ("lag", row[4] / unit, 1e-2),
                                       ("pressure", row[2] / stress, 1e-3)):  # fmt: skip
            check(f"K_m {K_m}, T {T:g}: {name} by kgd.py", value, mine.at(name, T), tolerance)


def test_convergence() -> None:
    runs = [March(0.5, 1e-4, cells, small).run(0.1, steps)
            for cells, small, steps in ((20, 4e-5, 12), (40, 1e-5, 25), (80, 1e-5, 50))]  # fmt: skip
    for T in (1e-3, 1e-2, 1e-1):
        for name, tolerance in (("length", 5e-4), ("lag", 5e-3), ("pressure", 5e-4)):
            coarse, middle, fine = (march.at(name, T) for march in runs)
            print(f"{name} at T {T:g}: 20 cells {coarse / fine - 1:+.2e}")
            check(f"{name} at T {T:g}: 40 cells against 80", middle, fine, tolerance)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = lambda name, default, help: parser.add_argument(name, type=float, default=default, help=help)
    add("--toughness", 0.5, "K_m")
    add("--start", 1e-6, "T")
    add("--end", 10.0, "T; it ends where the lag is below 1e-5 of the length")
    add("--steps", 25.0, "of time a decade")
    parser.add_argument("--cells", type=int, default=40)
    parser.add_argument("--test", action="store_true", help="verify this script")
    a = parser.parse_args()
    if a.test:
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
        return
    march = March(a.toughness, a.start, a.cells).run(a.end, a.steps)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(NAMES)
    writer.writerows([f"{v:.6g}" for v in row] for row in march.rows)


if __name__ == "__main__":
    main()

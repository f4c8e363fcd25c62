"""Viscous flow in a growing crack: finite volumes on a mesh that moves with the fluid front.

One wing 0 <= x <= length carries fluid to x = front <= length; beyond it the pressure is zero (the
lag). Cells are fixed in x/front and fine at the front, so that no tip asymptote is needed. Unknown
are the pressure of the cavity that feeds the crack (its volume may be zero), the pressures of the
cells, the front and the lag; equations are the masses of cavity and cells (backward differences of
second order), the front's speed (pressure zero there) or lag zero, and K = K_IC or length held.
The elastic body enters as one matrix, see `Elasticity`. SI units, per metre of thickness, pressure
positive in compression.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable, Protocol

import numpy as np

Array = np.ndarray
SEAL_RAMP = 0.3e-3  # [m]


class Elasticity(Protocol):
    def matrix(self, points: Array, faces: Array, length: float) -> tuple[Array, Array]:
        """(G, g): G p + g, p = [cavity pressure, cell pressures] constant between `faces`, gives the
        growth of the cavity's volume [m^2] (of one wing), the openings at `points` [m], and K_I."""


@dataclass
class Fluid:
    viscosity: float
    bulk_modulus: float = np.inf
    leak_off: float = 0.0  # C' = 2 C_L [m/s^(1/2)]

    def density(self, pressure: Array) -> Array:
        """Over that at zero pressure."""
        return 1 + pressure / self.bulk_modulus


@dataclass
class Crack:
    """What a march starts from; a wing's share of rate and cavity."""

    elasticity: Elasticity
    fluid: Fluid
    toughness: float
    rate: Callable[[float], float]  # [m^2/s] at zero pressure
    cavity: float = 0.0  # [m^2]
    cavity_wall: float = 0.0  # [m] of it leak, from time zero
    tight: float = 0.0  # walls nearer to the mouth do not leak [m]
    lag: bool = False
    stops: bool = True  # never grows shorter, K < K_IC then


@dataclass
class State:
    time: float
    front: float
    lag: float
    pressure: Array  # cavity first

    @property
    def length(self) -> float:
        return self.front + self.lag


@dataclass
class History:
    rows: list[tuple[float, ...]] = field(default_factory=list)
    names = ("time", "length", "pressure", "opening", "lag", "volume", "leak_off", "mean_pressure",
             "intensity", "content")  # fmt: skip

    def column(self, name: str) -> Array:
        return np.array(self.rows)[:, self.names.index(name)]

    def at(self, name: str, times: Array) -> Array:
        return np.interp(times, self.column("time"), self.column(name))


class StepFailed(Exception):
    pass


def graded_faces(cells: int, smallest: float) -> Array:
    """0 to 1: cells of about 1.5/cells, shrinking by a constant ratio to `smallest` at 1."""
    ratio, widths, width = 1 + 4 / cells, [smallest], smallest
    while sum(widths) < 1:
        width = min(width * ratio, 1.5 / cells)
        widths.append(width)
    faces = np.concatenate(([0.0], np.cumsum(widths[::-1])))
    return faces / faces[-1]


class Arrival:
    """When the front came to x: straight lines through the steps taken, front ~ t^(2/3) before."""

    def __init__(self, state: State):
        self.front, self.time = [state.front], [state.time]

    def add(self, state: State) -> None:
        if state.front > self.front[-1]:
            self.front.append(state.front)
            self.time.append(state.time)

    def leaked(self, x: Array, now: State, twice_rate: float) -> Array:
        """Per length [m]: 2 C' (t - arrival)^(1/2)."""
        fronts, times = list(self.front), list(self.time)
        if now.front > fronts[-1]:
            fronts.append(now.front)
            times.append(now.time)
        early = times[0] * (np.minimum(x, fronts[0]) / fronts[0]) ** 1.5
        arrival = np.where(x < fronts[0], early, np.interp(x, fronts, times))
        return twice_rate * np.sqrt(np.maximum(now.time - arrival, 0))


class March:
    def __init__(self, crack: Crack, start: State, faces: Array):
        """`start.pressure`: one for the cavity and one for each cell."""
        self.crack, self.state, self.faces = crack, start, faces
        self.points = np.sort(np.concatenate((faces, (faces[1:] + faces[:-1]) / 2)))
        self.arrival = Arrival(start)
        self.history = History()
        self.stored = [self.mass(start, *self.elastic(start), start.pressure[:, None])[:, 0]]
        self.fronts, self.times = [start.front], [start.time]
        self.longest = start.length
        self.growing = True
        self.record()

    def elastic(self, state: State) -> tuple[Array, Array]:
        return self.crack.elasticity.matrix(
            self.points * state.front, self.faces * state.front, state.length
        )

    def leaked(self, state: State) -> Array:
        if self.crack.fluid.leak_off == 0:
            return np.zeros_like(self.points)
        return self.arrival.leaked(self.points * state.front, state, 2 * self.crack.fluid.leak_off)

    def leaking(self, x: Array) -> tuple[Array, Array]:
        """Which share of the wall leaks at x, and how much of it does up to x [m]: from none to all of it
        within a third of a millimetre about where it is tight, so that a step sees no jump."""
        tight, ramp = self.crack.tight, SEAL_RAMP
        if tight == 0:
            return np.ones_like(x), x
        share = np.clip((x - tight) / ramp + 0.5, 0, 1)
        return share, ramp * share**2 / 2 + np.maximum(x - tight - ramp / 2, 0)

    def leaked_in_cells(self, state: State) -> Array:
        """[m^2]"""
        v = self.leaked(state)
        length = np.diff(self.leaking(self.faces * state.front)[1])
        return length * (v[:-1:2] + 4 * v[1::2] + v[2::2]) / 6

    def leaked_from_cavity(self, state: State) -> float:
        return self.crack.cavity_wall * self.crack.fluid.leak_off * np.sqrt(state.time)

    def mass(self, state: State, G: Array, g: Array, p: Array) -> Array:
        """Of cavity and cells, leaked fluid included, over the density at zero pressure."""
        response = G @ p + g[:, None]
        density = self.crack.fluid.density(p)
        widths = np.diff(self.faces)[:, None] * state.front
        mean = lambda v: (v[:-1:2] + 4 * v[1::2] + v[2::2]) / 6
        cells = widths * density[1:] * mean(response[1:-1]) + self.leaked_in_cells(state)[:, None]
        cavity = density[:1] * (self.crack.cavity + response[:1]) + self.leaked_from_cavity(state)
        return np.vstack((cavity, cells))

    def residual(self, state: State, G: Array, g: Array, p: Array, step: float) -> Array:
        """Of all equations, for each column of p."""
        fluid, crack = self.crack.fluid, self.crack
        weights = self.difference_weights(step)
        stored = sum(w * s[:, None] for w, s in zip(weights[1:], self.stored[::-1]))
        speed = weights[0] * state.front
        speed += sum(w * f for w, f in zip(weights[1:], self.fronts[::-1]))
        mass = self.mass(state, G, g, p)

        response = G @ p + g[:, None]
        opening, density = response[1:-1:2], fluid.density(p)
        centres = np.concatenate(([0.0], self.points[1::2])) * state.front
        conductivity = np.maximum(opening, 0) ** 3 / (12 * fluid.viscosity)
        face_density = (density[1:] + density[:-1]) / 2
        flux = -face_density * conductivity[:-1] * np.diff(p, axis=0) / np.diff(centres)[:, None]
        leaked = self.leaked(state)[::2] * self.leaking(self.faces * state.front)[0]
        carried = face_density * opening[:-1] + leaked[:-1, None]
        flux -= carried * (self.faces[:-1] * speed)[:, None]
        left_behind = -leaked[-1] * speed  # nothing while the front advances
        ends = [np.full((1, p.shape[1]), v) for v in (crack.rate(state.time), left_behind)]
        flux = np.vstack((ends[0], flux, ends[1]))
        balance = weights[0] * mass + stored + np.diff(flux, axis=0)

        if crack.lag:
            to_front = state.front - centres[-1]
            tip = conductivity[-1] * p[-1] / np.maximum(opening[-1], 1e-12) / to_front - speed
        else:
            tip = np.full(p.shape[1], state.lag)
        if self.growing:
            grow = response[-1] - crack.toughness
        else:
            grow = np.full(p.shape[1], state.length - self.longest)
        return np.vstack((balance, tip, grow))

    def difference_weights(self, step: float) -> tuple[float, ...]:
        """Of the rate at the step's end: values there, at its start, and one step before."""
        if len(self.times) < 2:
            return 1 / step, -1 / step
        r = step / (self.times[-1] - self.times[-2])
        return (1 + 2 * r) / (1 + r) / step, -(1 + r) / step, r * r / (1 + r) / step

    def solve(self, step: float) -> State:
        """Newton's method, columns by differences."""
        old = self.state
        new = State(old.time + step, old.front, old.lag, old.pressure.copy())
        if len(self.times) > 1:
            ahead = step / (self.times[-1] - self.times[-2])
            new.front += min(ahead * (self.fronts[-1] - self.fronts[-2]), 0.05 * old.front)
            if not self.growing:
                new.front = min(new.front, old.length)
                new.lag = old.length - new.front
        for iteration in range(25):
            G, g = self.elastic(new)
            p = new.pressure
            scale = max(np.abs(p).max(), 1.0)
            shifted = p[:, None] + 1e-7 * scale * np.eye(len(p))
            at = self.residual(new, G, g, p[:, None], step)
            by_pressure = (self.residual(new, G, g, shifted, step) - at) / (1e-7 * scale)
            columns = [by_pressure]
            for front, lag in ((1e-7 * new.length, 0.0), (0.0, 1e-7 * new.length)):
                moved = State(new.time, new.front + front, new.lag + lag, p)
                shifted_at = self.residual(moved, *self.elastic(moved), p[:, None], step)
                columns.append((shifted_at - at) / (front + lag))
            J = np.hstack(columns)
            rows = np.abs(J).max(axis=1)
            rows[rows == 0] = 1
            J /= rows[:, None]
            unit = np.concatenate((np.full(len(p), scale), (new.length, new.length)))
            try:
                change = np.linalg.solve(J * unit, -at[:, 0] / rows) * unit
            except np.linalg.LinAlgError as error:
                raise StepFailed from error
            if not np.isfinite(change).all():
                raise StepFailed
            part = min(1.0, 0.1 * new.length / max(np.abs(change[-2:]).max(), 1e-300))
            if self.crack.lag and change[-1] < 0:
                part = min(part, 0.7 * new.lag / -change[-1])
            for _ in range(12):
                trial = State(new.time, new.front + part * change[-2], new.lag + part * change[-1],
                              p + part * change[:-2])  # fmt: skip
                G, g = self.elastic(trial)
                opening = (G @ trial.pressure + g)[1:-1]
                if opening[:-1].min() > 0:
                    break
                part /= 2
            else:
                raise StepFailed
            new = trial
            small = np.abs(change / unit)
            if part == 1 and small[:-2].max() < 1e-6 and small[-2:].max() < 1e-8:
                return new
        raise StepFailed

    def step(self, step: float) -> None:
        old = self.state
        new = self.solve(step)
        if self.crack.stops:
            G, g = self.elastic(new)
            held = new.length < self.longest
            if self.growing == held and (held or (G @ new.pressure + g)[-1] > self.crack.toughness):
                self.growing = not held
                new = self.solve(step)
        change = abs(new.length - old.length) / old.length, abs(new.front - old.front) / old.front
        if max(change) > 0.06:
            raise StepFailed
        self.stored = [*self.stored[-1:], self.mass(new, *self.elastic(new), new.pressure[:, None])[:, 0]]
        self.fronts = [*self.fronts[-1:], new.front]
        self.times = [*self.times[-1:], new.time]
        self.arrival.add(new)
        self.longest = max(self.longest, new.length)
        self.state = new
        self.record()

    def record(self) -> None:
        state = self.state
        G, g = self.elastic(state)
        response = G @ state.pressure + g
        widths = np.diff(self.faces) * state.front
        cells = lambda v: widths @ (v[:-1:2] + 4 * v[1::2] + v[2::2]) / 6
        self.history.rows.append(
            (state.time, state.length, state.pressure[0], response[1], state.lag,
             cells(response[1:-1]),
             self.leaked_in_cells(state).sum() + self.leaked_from_cavity(state),
             np.diff(self.faces) @ state.pressure[1:], response[-1],
             self.mass(state, G, g, state.pressure[:, None]).sum())
        )  # fmt: skip

    def run(self, end: float, step: float, change: float = 0.02) -> History:
        """To time `end`: steps in which length or front grows by `change` of itself."""
        smallest = 1e-7 * step
        while self.state.time < end * (1 - 1e-12):
            old = self.state
            step = min(step, end - old.time)
            try:
                self.step(step)
            except StepFailed:
                step /= 2
                if step < smallest:
                    raise RuntimeError(f"no step found at {old.time:g} s, length {old.length:g} m")
                continue
            moved = max(abs(self.state.length / old.length - 1), abs(self.state.front / old.front - 1))
            step *= min(1.3, max(0.5, change / max(moved, 1e-12)))
        return self.history

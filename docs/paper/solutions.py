"""Analytic solutions of the paper's sections 3.1 to 3.3, written apart from those in app/references."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Terzaghi:
    """Consolidation in one dimension with compressible fluid: drained at the top, sealed at the bottom."""

    height: float  # [m]
    stiffness: float  # lambda + 2 mu [Pa]
    storage: float  # [1/Pa]
    biot: float
    mobility: float  # permeability / viscosity [m^2/(Pa s)]
    load: float  # [Pa]
    terms: int = 400

    @property
    def diffusivity(self) -> float:
        return self.mobility / (self.storage + self.biot**2 / self.stiffness)

    @property
    def initial_pressure(self) -> float:
        return self.biot * self.load / (self.storage * self.stiffness + self.biot**2)

    def wave_numbers(self) -> np.ndarray:
        return np.pi * (np.arange(self.terms) + 0.5)

    def decay(self, time: np.ndarray) -> np.ndarray:
        """(times, terms)."""
        number = self.diffusivity * np.asarray(time, dtype=float) / self.height**2
        return np.exp(-np.outer(number, self.wave_numbers() ** 2))

    def pressure(self, depth: np.ndarray, time: float) -> np.ndarray:
        m = self.wave_numbers()
        if time <= 0.0:
            return np.full_like(depth, self.initial_pressure)
        waves = 2.0 / m * np.sin(np.outer(depth / self.height, m))
        return self.initial_pressure * waves @ self.decay(time)[0]

    def consolidation(self, time: np.ndarray) -> np.ndarray:
        """Degree of consolidation: the part of the settlement beyond the undrained one that is done."""
        return 1.0 - self.decay(time) @ (2.0 / self.wave_numbers() ** 2)


@dataclass(frozen=True)
class Mandel:
    """Mandel's problem for compressible constituents, x from the middle, drained at x = width."""

    lame_lambda: float  # [Pa]
    shear_modulus: float  # [Pa]
    storage: float  # [1/Pa]
    biot: float
    mobility: float  # [m^2/(Pa s)]
    width: float  # a [m]
    force: float  # on half the width [N/m]
    terms: int = 200

    @property
    def poisson(self) -> float:
        return 0.5 * self.lame_lambda / (self.lame_lambda + self.shear_modulus)

    @property
    def undrained_poisson(self) -> float:
        undrained = self.lame_lambda + self.biot**2 / self.storage
        return 0.5 * undrained / (undrained + self.shear_modulus)

    @property
    def diffusivity(self) -> float:
        return self.mobility / (self.storage + self.biot**2 / (self.lame_lambda + 2 * self.shear_modulus))

    @property
    def skempton(self) -> float:
        undrained_bulk = self.lame_lambda + 2 / 3 * self.shear_modulus + self.biot**2 / self.storage
        return self.biot / self.storage / undrained_bulk

    @property
    def initial_pressure(self) -> float:
        return self.skempton * (1 + self.undrained_poisson) * self.force / (3 * self.width)

    def roots(self) -> np.ndarray:
        """Of tan(b) = ratio b, one in every ((n - 1/2) pi, (n + 1/2) pi), by bisection."""
        ratio = (1 - self.poisson) / (self.undrained_poisson - self.poisson)
        n = np.arange(self.terms)
        low = np.where(n == 0, 1e-9, (n - 0.5) * np.pi + 1e-12)
        high = (n + 0.5) * np.pi - 1e-12
        for _ in range(80):
            middle = 0.5 * (low + high)
            above = np.tan(middle) > ratio * middle
            high, low = np.where(above, middle, high), np.where(above, low, middle)
        return 0.5 * (low + high)

    def pressure(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        """(times, places)."""
        b = self.roots()
        size = np.sin(b) / (b - np.sin(b) * np.cos(b))
        shape = np.cos(np.outer(np.asarray(x) / self.width, b)) - np.cos(b)
        decay = np.exp(-np.outer(self.diffusivity * np.asarray(time) / self.width**2, b**2))
        return 2 * self.initial_pressure * (decay * size) @ shape.T

    def vertical_displacement(self, y: np.ndarray, time: np.ndarray) -> np.ndarray:
        """(times, places)."""
        b = self.roots()
        size = np.sin(b) * np.cos(b) / (b - np.sin(b) * np.cos(b))
        decay = np.exp(-np.outer(self.diffusivity * np.asarray(time) / self.width**2, b**2))
        per_height = self.force / (self.shear_modulus * self.width) * (
            -(1 - self.poisson) / 2 + (1 - self.undrained_poisson) * decay @ size
        )
        return np.outer(per_height, np.asarray(y))


@dataclass(frozen=True)
class Seepage:
    """Water under a head that rises evenly from 0 and then stays, on a specimen that is drained at its bottom."""

    length: float  # [m]
    storage: float  # [1/Pa]
    mobility: float  # [m^2/(Pa s)]
    head: float  # [Pa]
    ramp: float  # [s]
    terms: int = 400

    @property
    def diffusivity(self) -> float:
        return self.mobility / self.storage

    @property
    def steady_flux(self) -> float:
        return self.mobility * self.head / self.length

    def volume_after_jump(self, time: np.ndarray) -> np.ndarray:
        """Volume an area passed since the whole head came at once, at time 0; 0 before."""
        t = np.maximum(np.asarray(time, dtype=float), 0.0)
        n = np.arange(1, self.terms + 1)
        rate = self.diffusivity * (n * np.pi / self.length) ** 2
        filled = self.length**2 / (3.0 * self.diffusivity)  # the sum of 2 / rate over all n
        volume = self.steady_flux * (t + filled - 2.0 * (np.exp(-np.outer(t, rate)) / rate).sum(axis=1))
        return np.where(t > 0.0, volume, 0.0)

    def volume(self, time: np.ndarray) -> np.ndarray:
        """Volume an area passed since the ramp began, at `time` after its beginning: many small jumps."""
        return np.mean([self.volume_after_jump(np.asarray(time) - start) for start in self.jumps()], axis=0)

    def jumps(self) -> np.ndarray:
        return (np.arange(200) + 0.5) / 200 * self.ramp

    def profile(self, height: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
        """Pressure and downward flux at heights above the bottom, `time` after the ramp began, when it is over."""
        n = np.arange(1, self.terms + 1)
        rate = self.diffusivity * (n * np.pi / self.length) ** 2
        decay = 2.0 * (-1.0) ** n * np.mean(np.exp(-np.outer(time - self.jumps(), rate)), axis=0)
        angle = np.outer(height, n * np.pi / self.length)
        pressure = self.head * (np.asarray(height) / self.length + np.sin(angle) @ (decay / (n * np.pi)))
        return pressure, self.steady_flux * (1.0 + np.cos(angle) @ decay)

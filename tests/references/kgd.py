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
    the history are net of `stress` if there is no lag, else whole."""
    body = body or InfiniteBody(modulus, stress)
    time = start * end
    length = min(c[0] for c in corners(modulus, toughness, viscosity, rate, time).values())
    if leak_off > 0:
        length = min(length, rate * np.sqrt(time) / (np.pi * leak_off))
    faces = graded_faces(cells, smallest)
    hidden = 0.05 * length if lag else 0.0
    net = rate * time / (2 * np.pi * length**2) * modulus  # an ellipse that holds the fluid
    state = State(time, length - hidden, hidden, np.full(len(faces), net + stress))
    crack = Crack(body, Fluid(viscosity, bulk_modulus, leak_off), toughness,
                  lambda t: rate / 2, lag=lag)  # fmt: skip
    march = March(crack, state, faces)
    return march.run(end, 0.01 * time, change)


def table_row(K_m: float, **options) -> tuple[float, float, float]:
    """gamma, Omega, Pi of the march at dimensionless toughness K_m (unit modulus, rate and 12 mu)."""
    modulus, rate, mu, end = 1e9, 1e-4, 1e-3, 1.0
    toughness = K_m * (12 * mu * rate * modulus**3) ** 0.25 / (4 * np.sqrt(2 / np.pi))
    h = solve(modulus, toughness, mu, rate, end, **options)
    scale = (modulus * rate**3 * end**4 / (12 * mu)) ** (1 / 6)
    thin = (12 * mu / (modulus * end)) ** (1 / 3)
    last = dict(zip(h.names, h.rows[-1]))
    return (last["length"] / scale, last["opening"] / (thin * scale), last["pressure"] / (modulus * thin))

#!/usr/bin/env python3
"""What a crack leaks by its own history, against what the run says went into the pores.

`carter`: Carter's law superposed over the pressures of all its facets, as if fluid went straight into
the rock on both sides. `plane`: diffusion in the plane of a box that the crack enters straight down
from the middle of its top, by finite volumes in one half, implicit. In both the rock's storage is that
of strain along the flow only, as it is for any flow in an infinite body.

A facet is the share of the crack around a point of the frames `crack`. Its pressure is taken as
linear between frames, of which there should be many.

`strained`: the rock's strain moves pore water. Near a face, where water flows along the normal n only,
fluid content is S p + alpha (sigma_nn + 2 G e_tt) / (lambda + 2 G), S the storage above, and it diffuses
as pressure does in the other accounts. Rock that the crack has loaded before water could move holds
none more than at rest: it is under p_u = -alpha (sigma_nn + 2 G e_tt) / (S (lambda + 2 G)), and Carter's
law is driven by the crack's pressure beyond that. sigma_nn: from the closing stress to the crack's
pressure; e_tt, the strain along the crack, from the run's displacements beside it (frames `body`).
"""

from __future__ import annotations

import argparse
import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from scipy.sparse.linalg import LinearOperator, cg

Array = np.ndarray


@dataclass
class Rock:
    permeability: float = 1.02e-15
    viscosity: float = 1e-3
    porosity: float = 0.1
    bulk_modulus: float = 2.2e9  # of the fluid
    young: float = 700e6
    poisson: float = 0.25

    @property
    def mobility(self) -> float:
        return self.permeability / self.viscosity

    @property
    def shear_modulus(self) -> float:
        return self.young / (2 * (1 + self.poisson))

    @property
    def uniaxial_modulus(self) -> float:
        return self.young * (1 - self.poisson) / ((1 + self.poisson) * (1 - 2 * self.poisson))

    @property
    def storage(self) -> float:
        return self.porosity / self.bulk_modulus + 1 / self.uniaxial_modulus

    def undrained_pressure(self, normal: Array, along: Array) -> Array:
        """Beside a face, of compression on it [Pa] and of strain along it."""
        loaded = normal - 2 * self.shear_modulus * along
        return loaded / (self.storage * self.uniaxial_modulus)

    def half_space(self) -> float:
        """Fluid that a face at unit pressure takes per area: twice this times sqrt(t)."""
        return np.sqrt(self.mobility * self.storage / np.pi)


def superposed(times: Array, pressure: Array, coefficient: float) -> Array:
    """Volume per area of one face at `times`, for a pressure that is linear between them."""
    rate = np.diff(pressure) / np.diff(times)
    since = np.maximum(times[:, None] - times, 0) ** 1.5
    return 4 / 3 * coefficient * (since[:, :-1] - since[:, 1:]) @ rate


class Half:
    """Diffusion in x > 0, cells of a square lattice; a part of the edge x = 0 is under pressure."""

    def __init__(self, rock: Rock, cell: float, columns: int, rows: int):
        self.rock, self.shape = rock, (columns, rows)
        self.stored = rock.storage * cell**2
        self.pressure = np.zeros(self.shape)

    def outflow(self, p: Array, held: Array) -> Array:
        """Over the mobility; the edge lies half a cell from the first column's centres."""
        q = np.zeros_like(p)
        for axis in (0, 1):
            fall = -np.diff(p, axis=axis)
            low, high = (slice(None, -1), slice(None)), (slice(1, None), slice(None))
            q[low if axis == 0 else low[::-1]] += fall
            q[high if axis == 0 else high[::-1]] -= fall
        q[0] += 2 * held * p[0]
        return q

    def step(self, dt: float, held: Array, edge: Array) -> float:
        """Backward Euler; returns what came in through the edge [m^2]."""
        scale = self.stored / (self.rock.mobility * dt)
        size = self.pressure.size
        matrix = LinearOperator(
            (size, size), lambda v: scale * v + self.outflow(v.reshape(self.shape), held).ravel()
        )
        right_side = scale * self.pressure
        right_side[0] += 2 * held * edge
        solution, failed = cg(matrix, right_side.ravel(), self.pressure.ravel(), tol=1e-9)
        assert failed == 0
        self.pressure = solution.reshape(self.shape)
        return dt * self.rock.mobility * np.sum(2 * held * (edge - self.pressure[0]))


def diffused(rock: Rock, times: Array, depth: Array, pressure: Array, facet: float, cell: float,
             size: tuple[float, float], steps: int = 4) -> Array:  # fmt: skip
    """Volume that left the crack by `times`; `depth` of the facets' centres below the top."""
    half = Half(rock, cell, round(size[0] / 2 / cell), round(size[1] / cell))
    y = (np.arange(half.shape[1]) + 0.5) * cell
    facet_at = np.argmin(np.abs(y[:, None] - depth), axis=1)
    near = np.abs(y - depth[facet_at]) < facet / 2 * (1 + 1e-9)
    leaked = [0.0]
    for begin, end, before, after in zip(times[:-1], times[1:], pressure[:-1], pressure[1:]):
        dt, volume = (end - begin) / steps, 0.0
        for k in range(1, steps + 1):
            edge = (before + (after - before) * k / steps)[facet_at] * near
            volume += half.step(dt, near & (edge > 0), edge)
        leaked.append(leaked[-1] + 2 * volume)
    return np.array(leaked)


def frames(folder: Path) -> tuple[Array, Array, Array]:
    """Times, places of the facets, and pressures by frame and facet; facets come one by one, behind
    those before."""
    listed = json.loads((folder / "frames" / "crack.hdf.series").read_text())["files"]
    rows = []
    for entry in listed:
        with h5py.File(folder / "frames" / entry["name"]) as file:
            rows.append(np.array(file["VTKHDF/PointData/crack_pressure"]))
            places = np.array(file["VTKHDF/Points"])
    pressure = np.zeros((len(rows), max(map(len, rows))))
    for row, values in zip(pressure, rows):
        row[: len(values)] = values
    return np.array([entry["time"] for entry in listed]), places, pressure


def strain_along(folder: Path, places: Array, middle: float) -> Array:
    """Of the rock beside a crack straight down at x = `middle`, by frame and facet."""
    listed = json.loads((folder / "frames" / "body.hdf.series").read_text())["files"]
    rows = []
    for entry in listed:
        with h5py.File(folder / "frames" / entry["name"]) as file:
            points = np.array(file["VTKHDF/Points"])
            moved = np.array(file["VTKHDF/PointData/displacement"])
        aside = np.abs(points[:, 0] - middle)
        beside = aside < 1.01 * aside.min()
        y, row = np.unique(points[beside, 1].round(9), return_inverse=True)
        mean = np.bincount(row, moved[beside, 1]) / np.bincount(row)
        rows.append(np.interp(places[:, 1], y, np.gradient(mean, y)))
    return np.array(rows)


def leaked_by_run(folder: Path, times: Array, density: float) -> Array:
    with open(folder / "history.csv") as file:
        rows = list(csv.DictReader(file))
    column = next(name for name in rows[0] if name.startswith("leaked_crack_fluid_mass"))
    time = next(name for name in rows[0] if name.startswith("time"))
    return -np.interp(times, [float(r[time]) for r in rows], [float(r[column]) for r in rows]) / density


def test_half_space() -> None:
    """Constant pressure: Carter's; a steady rise: two thirds of it at the pressure in the end."""
    times, coefficient = np.linspace(0, 4, 401), 0.7
    steady = superposed(np.concatenate(([0.0, 1e-9], times[1:])), np.append(0.0, np.ones(401)), coefficient)
    assert abs(steady[-1] / (2 * coefficient * 2) - 1) < 1e-6
    rising = superposed(times, times, coefficient)
    assert abs(rising[-1] / (2 / 3 * 2 * coefficient * 2 * 4) - 1) < 1e-12
    print("half space: constant and rising pressure")


def test_plane() -> None:
    """A crack through the whole box is two half-spaces; one that ends takes more."""
    rock, facet = Rock(), 1e-3
    times = np.concatenate(([0.0, 1e-9], np.linspace(0, 0.05, 101)[1:]))
    depth = (np.arange(40) + 0.5) * facet
    pressure = np.ones((len(times), 40)) * (times > 0)[:, None]
    carter = 2 * facet * 40 * superposed(times, pressure[:, 0], rock.half_space())[-1]
    through = diffused(rock, times, depth, pressure, facet, facet / 4, (0.08, 0.04))[-1]
    assert abs(through / carter - 1) < 0.02, through / carter
    ends = diffused(rock, times, depth, pressure, facet, facet / 4, (0.08, 0.08))[-1]
    # Early, an end takes the mobility times pressure and time more: that of a band in a plane.
    expected = 1 + rock.mobility * 0.05 / carter
    print(f"plane: through the box {through / carter:.4f}, with an end {ends / carter:.4f} ({expected:.4f})")
    assert abs(ends / carter - expected) < 0.005


def test_undrained() -> None:
    """Skempton's pressure in plane strain, 2 B (1 + nu_u) / 3 under equal stresses; loading efficiency."""
    rock = Rock()
    bulk = rock.young / (3 * (1 - 2 * rock.poisson))
    undrained = bulk + rock.bulk_modulus / rock.porosity  # of stiff grains
    skempton = 1 - bulk / undrained
    g = rock.shear_modulus
    nu = (3 * undrained - 2 * g) / (2 * (3 * undrained + g))
    equal = rock.undrained_pressure(1.0, -(1 - 2 * nu) / (2 * g))
    confined = rock.undrained_pressure(1.0, 0.0)
    assert abs(equal / (2 / 3 * skempton * (1 + nu)) - 1) < 1e-12
    assert abs(confined / (skempton * (1 + nu) / (3 * (1 - nu))) - 1) < 1e-12
    print("undrained pressure under equal stresses, and where no strain is along the face")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, nargs="?", help="folder of results")
    parser.add_argument("--sealed", type=float, default=0.0, help="depth to which walls are sealed [m]")
    parser.add_argument("--facet", type=float, default=1e-3, help="length of a facet [m]")
    parser.add_argument("--size", type=float, nargs=2, default=(0.15, 0.2), help="of the box [m]")
    parser.add_argument("--cell", type=float, default=5e-4, help="of `plane` [m]")
    parser.add_argument("--closing", type=float, default=0.21e6, help="stress across the crack [Pa]")
    parser.add_argument("--density", type=float, default=1000.0)
    for name, value in vars(Rock()).items():
        parser.add_argument(f"--{name.replace('_', '-')}", type=float, default=value)
    parser.add_argument("--test", action="store_true", help="verify this script")
    a = parser.parse_args()
    if a.test:
        test_half_space()
        test_undrained()
        return test_plane()
    rock = Rock(**{name: getattr(a, name) for name in vars(Rock())})
    times, places, pressure = frames(a.run)
    pressure = pressure * (a.size[1] - places[:, 1] > a.sealed)
    carter = 2 * a.facet * sum(superposed(times, p, rock.half_space()) for p in pressure.T)
    plane = diffused(rock, times, a.size[1] - places[:, 1], pressure, a.facet, a.cell, a.size)
    strain = strain_along(a.run, places, a.size[0] / 2)
    drive = np.where(pressure > 0, pressure - rock.undrained_pressure(pressure - a.closing, strain), 0.0)
    strained = 2 * a.facet * sum(superposed(times, p, rock.half_space()) for p in drive.T)
    run = leaked_by_run(a.run, times, a.density)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(("time", "run", "carter", "plane", "strained", "run_over_carter", "run_over_plane", "run_over_strained"))
    for time, leaked, *expected in zip(times, run, carter, plane, strained):
        ratios = [leaked / e if e > 0 else np.nan for e in expected]
        writer.writerow([f"{time:.6g}", *(f"{v:.4g}" for v in (leaked, *expected, *ratios))])


if __name__ == "__main__":
    main()

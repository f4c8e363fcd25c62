"""Frames as the page shows them: whole point sets in 2D or 3D, coarsened to what a page may hold."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from frames import nearest_gap, spacing

STRESS = "stress"


@dataclass(frozen=True)
class Points:
    """One frame of a point set, read."""

    positions: np.ndarray  # (count, 2 or 3) [m]
    edges: np.ndarray  # of the squares or cubes that points stand for [m]
    scalars: dict[str, np.ndarray]  # by name; components of vectors as `displacement x`
    units: dict[str, str]
    stress: np.ndarray | None = None  # (count, D, D) [Pa], of the set's stress
    stress_name: str = ""


@dataclass(frozen=True)
class Coarsening:
    """Points put together in cells of a grid: each cell shows the mean of its points."""

    members: np.ndarray  # cell of each point
    counts: np.ndarray  # points of each cell
    side: int  # cells of so many points along each axis

    def mean(self, values: np.ndarray) -> np.ndarray:
        """Over the points where there is a value."""
        known = np.isfinite(values)
        weights = np.bincount(self.members, known, len(self.counts))
        sums = np.bincount(self.members, np.where(known, values, 0.0), len(self.counts))
        return np.divide(sums, weights, out=np.full(len(self.counts), np.nan), where=weights > 0)


def unit_of(data: h5py.Dataset) -> str:
    unit = data.attrs.get("units", "")
    return unit.decode() if isinstance(unit, bytes) else str(unit)


def is_tensor(values: np.ndarray, dimension: int) -> bool:
    return values.ndim == 2 and values.shape[1] in ((4, 6, 9) if dimension == 2 else (6, 9))


def tensor(values: np.ndarray, dimension: int) -> np.ndarray:
    """(count, D, D) of rows as frames hold them: all D x D components, or the six of a symmetric one in VTK's order."""
    if values.shape[1] == dimension**2:
        return values.reshape(-1, dimension, dimension)
    if values.shape[1] == 6:  # xx, yy, zz, xy, yz, xz
        whole = values[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
    else:
        whole = values[:, :9].reshape(-1, 3, 3)
    return whole[:, :dimension, :dimension]


def principal(stress: np.ndarray) -> np.ndarray:
    """Principal values, the largest (most tensile) first."""
    values = np.full(stress.shape[:2], np.nan)
    known = np.isfinite(stress).all(axis=(1, 2))
    values[known] = np.linalg.eigvalsh(0.5 * (stress[known] + stress[known].transpose(0, 2, 1)))[:, ::-1]
    return values


def edges_of(points: np.ndarray, scalars: dict[str, np.ndarray], flat: bool) -> np.ndarray:
    """Squares or cubes of the points' own volumes where these are known, as of fluid; else all alike."""
    if "fluid_mass" in scalars and "fluid_density" in scalars:
        return (scalars["fluid_mass"] / scalars["fluid_density"]) ** (1 / points.shape[1])
    return np.full(len(points), nearest_gap(points) if flat else spacing(points))


def is_flat(points: np.ndarray) -> bool:
    """Points in a plane or on a line of the space that they are in."""
    extent = np.ptp(points, axis=0) if len(points) > 1 else np.ones(1)
    return bool(extent.min() <= 1e-9 * extent.max())


def read_points(path: Path, dimension: int) -> Points:
    with h5py.File(path, "r") as file:
        group = file["VTKHDF"]
        positions = group["Points"][()].astype(float)[:, :dimension]
        scalars: dict[str, np.ndarray] = {}
        units: dict[str, str] = {}
        stress, stress_name = None, ""
        for name, data in group["PointData"].items():
            values = data[()]
            if len(values) != len(positions) or not np.issubdtype(values.dtype, np.number):
                continue
            if values.ndim == 1:
                scalars[name], units[name] = values.astype(float), unit_of(data)
            elif values.shape[1] == 3:
                for axis in range(dimension):
                    scalars[f"{name} {'xyz'[axis]}"] = values[:, axis].astype(float)
                    units[f"{name} {'xyz'[axis]}"] = unit_of(data)
            elif is_tensor(values, dimension):
                whole = tensor(values.astype(float), dimension)
                largest = principal(whole)
                for place, word in ((0, "largest"), (-1, "smallest")):
                    scalars[f"{word} principal {name}"] = largest[:, place]
                    units[f"{word} principal {name}"] = unit_of(data)
                if STRESS in name:
                    stress, stress_name = whole, name
    return Points(positions, edges_of(positions, scalars, is_flat(positions)), scalars, units, stress, stress_name)


def coarsening(points: np.ndarray, edge: float, most: int) -> Coarsening | None:
    """Of `points` that fill a body, in as few cells as `most` asks for; None where they are few enough."""
    if len(points) <= most:
        return None
    start = points.min(axis=0) - 0.5 * edge
    side = 2
    while True:
        cells = np.floor((points - start) / (side * edge) + 1e-6).astype(np.int64)
        _, members, counts = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
        if len(counts) <= most:
            return Coarsening(members.ravel(), counts, side)
        side += 1


def coarsened(points: Points, by: Coarsening | None) -> Points:
    if by is None:
        return points
    positions = np.column_stack([by.mean(along) for along in points.positions.T])
    scalars = {name: by.mean(values) for name, values in points.scalars.items()}
    dimension = positions.shape[1]
    edges = by.mean(points.edges) * by.side * np.minimum(by.counts / by.counts.max(), 1.0) ** (1 / dimension)
    stress = points.stress
    if stress is not None:
        flat = stress.reshape(len(stress), -1)
        stress = np.column_stack([by.mean(one) for one in flat.T]).reshape(-1, *stress.shape[1:])
    return Points(positions, edges, scalars, points.units, stress, points.stress_name)


@dataclass
class SetFiles:
    """The frames of a point set, by name and time."""

    name: str
    files: list[tuple[Path, float]] = field(default_factory=list)

    def nearest(self, time: float) -> Path | None:
        """The frame of that time; none where the set has none."""
        found = [path for path, at in self.files if abs(at - time) <= 1e-12 * max(abs(time), abs(at))]
        return found[0] if found else None

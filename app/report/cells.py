"""A frame as the cells that its points stand for: squares or cubes of rock, facets of cracks, points of free fluid."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from point_sets import is_tensor, tensor, unit_of

VERTEX, LINE, QUAD, HEXAHEDRON = 1, 3, 9, 12  # of VTK
SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2  # going round, as VTK numbers corners
CUBE = np.concatenate([np.column_stack([SQUARE, np.full(4, z)]) for z in (-0.5, 0.5)])
COMPONENTS = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "xy", "yz", "xz")}


@dataclass(frozen=True)
class Array:
    """Of one row a cell."""

    name: str
    unit: str
    values: np.ndarray  # (cells,) or (cells, components)
    components: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        return f"{self.name} [{self.unit}]" if self.unit not in ("", "1") else self.name


@dataclass(frozen=True)
class Cells:
    time: float  # [s]
    dimension: int
    points: np.ndarray  # (cells, 3): middles [m]
    corners: np.ndarray  # (corners, 3) [m]
    connectivity: np.ndarray  # (cells, corners of each)
    kind: int  # of VTK
    arrays: list[Array]


def set_names(frames: Path) -> list[str]:
    return sorted(path.name.removesuffix(".hdf.series") for path in frames.glob("*.hdf.series"))


def field_array(name: str, data: h5py.Dataset, dimension: int) -> Array:
    values, unit = data[()], unit_of(data)
    if values.ndim == 1:
        return Array(name, unit, values)
    if values.shape[1] == 3:
        return Array(name, unit, values, ("x", "y", "z"))
    if is_tensor(values, dimension):
        whole = tensor(values, dimension)
        words = COMPONENTS[dimension]
        rows = [0.5 * (whole[:, i, j] + whole[:, j, i]) for i, j in (("xyz".index(w[0]), "xyz".index(w[1])) for w in words)]
        return Array(name, unit, np.column_stack(rows), words)
    return Array(name, unit, values, tuple(map(str, range(values.shape[1]))))


def merged(corners: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners that neighbours share, each once, and where each of the given ones is among them."""
    keys = np.round(corners / step).astype(np.int64)
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return corners[first], place.reshape(-1)


def boxes(points: np.ndarray, volume: np.ndarray, dimension: int) -> tuple[np.ndarray, np.ndarray, int]:
    edge = volume ** (1 / dimension)
    shape = CUBE if dimension == 3 else np.column_stack([SQUARE, np.zeros(4)])
    corners = points[:, None, :] + edge[:, None, None] * shape
    unique, place = merged(corners.reshape(-1, 3), 1e-4 * float(edge.min(initial=1.0)))
    return unique, place.reshape(-1, len(shape)), HEXAHEDRON if dimension == 3 else QUAD


def normals(facets: np.ndarray) -> np.ndarray:
    """Of unit length; in 2D to the left of the facet's direction."""
    along = facets[:, 1] - facets[:, 0]
    other = facets[:, 3] - facets[:, 0] if facets.shape[1] == 4 else np.broadcast_to([0.0, 0.0, -1.0], along.shape)
    across = np.cross(along, other)
    return across / np.linalg.norm(across, axis=1, keepdims=True)


def geometry(group: h5py.Group | None, points: np.ndarray, known: dict[str, Array], dimension: int):
    """Corners, connectivity, kind of cell, and what is known of each cell."""
    if group is not None and "corners" in group:
        facets = group["corners"][()].reshape(len(points), -1, 3)
        flat = facets.reshape(-1, 3)
        corners, place = merged(flat, 1e-4 * float(np.linalg.norm(facets[:, 1] - facets[:, 0], axis=1).min(initial=1.0)))
        area = np.linalg.norm(facets[:, 1] - facets[:, 0], axis=1)
        if dimension == 3:
            area = np.linalg.norm(np.cross(facets[:, 1] - facets[:, 0], facets[:, 3] - facets[:, 0]), axis=1)
        extra = [Array("normal", "", normals(facets), ("x", "y", "z")), Array("area", "m" if dimension == 2 else "m^2", area)]
        return corners, place.reshape(len(points), -1), LINE if dimension == 2 else QUAD, extra
    if group is not None and "volume" in group and len(points):
        volume = np.broadcast_to(group["volume"][()], len(points)).astype(float)
        extra = [Array("volume", unit_of(group["volume"]), volume)]
        if "region" in group:
            extra.append(Array("region", "", group["region"][()].astype(np.int32)))
        return *boxes(points, volume, dimension), extra
    extra = []
    if "fluid_mass" in known and "fluid_density" in known:
        volume = known["fluid_mass"].values / known["fluid_density"].values
        extra.append(Array("volume", "m^2" if dimension == 2 else "m^3", volume))
    return points, np.arange(len(points))[:, None], VERTEX, extra


def cells_of(path: Path) -> Cells:
    with h5py.File(path, "r") as file:
        group, about = file["VTKHDF"], file.get("geometry")
        points = group["Points"][()].astype(float).reshape(-1, 3)
        flat = len(points) == 0 or np.ptp(points[:, 2]) == 0
        dimension = int(np.ravel(about.attrs["dimension"])[0]) if about is not None else 2 if flat else 3
        arrays = [field_array(name, data, dimension) for name, data in group["PointData"].items()]
        corners, connectivity, kind, extra = geometry(about, points, {a.name: a for a in arrays}, dimension)
        time = float(group["FieldData/TimeValue"][()][0])
    return Cells(time, dimension, points, corners, connectivity, kind, arrays + extra)

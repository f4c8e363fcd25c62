"""Frames of a run: VTKHDF 1.0 UnstructuredGrid files, listed with their times in `*.hdf.series`."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from quantities import quantity

# A page of some 20 MB still opens at once: 4 bytes a value, 4/3 for base64.
LARGEST_VALUES = 4_000_000
MOST_FRAMES = 120


@dataclass(frozen=True)
class Field:
    name: str
    unit: str
    values: np.ndarray  # one number a point


@dataclass(frozen=True)
class Frame:
    time: float  # [s]
    points: np.ndarray  # (count, 2) [m], along the two axes that are drawn
    fields: list[Field]


@dataclass(frozen=True)
class Slice:
    """The layer of points that a body is drawn by: all of them in 2D, else one across its shortest edge."""

    axes: tuple[int, int]  # across and up
    normal: int
    at: float | None  # [m]; None in 2D

    @property
    def names(self) -> tuple[str, str]:
        return "xyz"[self.axes[0]], "xyz"[self.axes[1]]

    def note(self, digits: int = 4) -> str:
        return "" if self.at is None else f"slice at {'xyz'[self.normal]} = {quantity(self.at, 'm', digits)}"


@dataclass(frozen=True)
class FrameSeries:
    name: str
    frames: list[Frame]  # in the order of time, the last one always among them
    available: int  # how many the run has written
    cut: Slice


def spacing(points: np.ndarray) -> float:
    """Edge of the squares (cubes) with which `points` fill their bounding box [m].

    Solves prod(extent + s) = count s^D, so it is exact on a lattice, whose outermost points lie
    half a spacing inside the body.
    """
    if len(points) < 2:
        return 1.0
    extent = np.ptp(points, axis=0)
    dimension = points.shape[1]
    low, high = 0.0, 2.0 * float(extent.max())
    for _ in range(100):
        middle = 0.5 * (low + high)
        too_small = np.prod(extent + middle) > len(points) * middle**dimension
        low, high = (middle, high) if too_small else (low, middle)
    return high


def middle_layer(points: np.ndarray) -> tuple[np.ndarray, Slice]:
    """Indices of the points to draw: all in 2D, in 3D the layer in the middle of the shortest edge.

    A body as long in depth as in height or width is cut along x and z: what falls shows.
    """
    if len(points) == 0 or np.ptp(points[:, 2]) == 0:
        return np.arange(len(points)), Slice((0, 1), 2, None)
    extent = np.ptp(points, axis=0)
    normal = 1 if extent[1] <= 1.001 * extent.min() else int(np.argmin(extent))
    along = points[:, normal]
    nearest = along[np.argmin(np.abs(along - 0.5 * (along.min() + along.max())))]
    chosen = np.flatnonzero(np.abs(along - nearest) <= 0.499 * spacing(points))
    first, second = (axis for axis in range(3) if axis != normal)
    return chosen, Slice((first, second), normal, float(nearest))


def scalar_fields(name: str, unit: str, values: np.ndarray, axes: str) -> list[Field]:
    """A vector becomes its magnitude and its components along `axes`; other tensors are left out."""
    if values.ndim == 1:
        return [Field(name, unit, values)]
    if values.shape[1] != 3:
        return []
    magnitude = Field(f"{name} (magnitude)", unit, np.linalg.norm(values, axis=1))
    return [magnitude] + [Field(f"{name} {axis}", unit, values[:, i]) for i, axis in enumerate(axes)]


def read_frame(path: Path, time: float) -> tuple[Frame, Slice]:
    with h5py.File(path, "r") as file:
        group = file["VTKHDF"]
        points = group["Points"][()].astype(float)
        chosen, cut = middle_layer(points)
        fields: list[Field] = []
        for name, data in group["PointData"].items():
            unit = data.attrs.get("units", "")
            unit = unit.decode() if isinstance(unit, bytes) else str(unit)
            axes = "xy" if cut.at is None else "xyz"
            fields += scalar_fields(name, unit, data[()][chosen], axes)
    return Frame(time, points[chosen][:, cut.axes], fields), cut


def evenly(count: int, wanted: int) -> list[int]:
    """At most `wanted` of `count` places, spread evenly, first and last included."""
    return sorted({round(i) for i in np.linspace(count - 1, 0, max(1, min(count, wanted)))})


def readable(path: Path, time: float) -> tuple[Frame, Slice] | None:
    try:
        return read_frame(path, time)
    except (OSError, KeyError) as error:
        print(f"{path}: unreadable, left out of the report ({error})", file=sys.stderr)
        return None


def read_series(path: Path) -> FrameSeries | None:
    listed = json.loads(path.read_text(encoding="utf-8"))["files"]
    files = [(path.parent / entry["name"], float(entry["time"])) for entry in listed]
    last = None
    while files and last is None:
        last = readable(*files[-1])
        if last is None:
            files.pop()
    if last is None:
        return None
    frame, cut = last
    values = len(frame.points) * (len(frame.fields) + 2)
    places = evenly(len(files), min(MOST_FRAMES, LARGEST_VALUES // max(values, 1)))
    earlier = [readable(*files[place]) for place in places[:-1]]
    frames = [e[0] for e in earlier if e] + [frame]
    if not any(len(f.points) for f in frames):
        return None
    name = path.name.removesuffix(".series").removesuffix(".hdf")
    return FrameSeries(name, frames, len(files), cut)


def read_all_series(folder: Path) -> list[FrameSeries]:
    found = [read_series(path) for path in sorted(folder.glob("*.hdf.series"))]
    return [series for series in found if series is not None]

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
    edges: np.ndarray  # of the squares that points are drawn as [m]
    fields: list[Field]


@dataclass(frozen=True)
class Slice:
    """The layer of points that a run is drawn by: all of them in 2D, else one across its shortest edge."""

    axes: tuple[int, int]  # across and up
    normal: int
    at: float | None  # [m]; None in 2D
    flat: bool = False  # all points lie in it

    @property
    def names(self) -> tuple[str, str]:
        return "xyz"[self.axes[0]], "xyz"[self.axes[1]]

    def note(self, digits: int = 4) -> str:
        kind = "plane" if self.flat else "slice at"
        return "" if self.at is None else f"{kind} {'xyz'[self.normal]} = {quantity(self.at, 'm', digits)}"


@dataclass(frozen=True)
class FrameSeries:
    name: str
    frames: list[Frame]  # in the order of time, the last one always among them
    available: int  # how many the run has written
    cut: Slice

    @property
    def moves(self) -> bool:
        return not np.array_equal(self.frames[0].points, self.frames[-1].points)

    @property
    def velocity(self) -> list[str]:
        """The fields of its components along the map's axes, where points move; else none."""
        names = [field.name for field in self.frames[-1].fields]
        found = [next((n for n in names if n.endswith(f"velocity {axis}")), "") for axis in self.cut.names]
        return found if self.moves and all(found) else []


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


def middle_cut(points: np.ndarray) -> Slice:
    """None in 2D, in 3D through the middle of the shortest edge.

    A body as long in depth as in height or width is cut along x and z: what falls shows.
    """
    if len(points) == 0 or np.ptp(points[:, 2]) == 0:
        return Slice((0, 1), 2, None)
    extent = np.ptp(points, axis=0)
    normal = 1 if extent[1] <= 1.001 * extent.min() else int(np.argmin(extent))
    first, second = (axis for axis in range(3) if axis != normal)
    along = points[:, normal]
    middle = 0.5 * (along.min() + along.max())
    return Slice((first, second), normal, float(along[np.argmin(np.abs(along - middle))]))


def own_cut(points: np.ndarray, common: Slice) -> Slice:
    """The plane that all points lie in, as those of a plane crack in 3D do; else the cut that the run is drawn by."""
    if common.at is None or len(points) < 2:
        return common
    extent = np.ptp(points, axis=0)
    flat = int(np.argmin(extent))
    if extent[flat] > 1e-9 * extent.max():
        return common
    first, second = (axis for axis in range(3) if axis != flat)
    return Slice((first, second), flat, float(points[0, flat]), flat=True)


def layer(points: np.ndarray, cut: Slice) -> np.ndarray:
    """Indices of the points that the cut shows: those about as far along its normal as the nearest to it."""
    if cut.at is None or len(points) == 0:
        return np.arange(len(points))
    along = points[:, cut.normal]
    nearest = along[np.argmin(np.abs(along - cut.at))]
    if np.ptp(along) == 0:
        return np.arange(len(points))
    return np.flatnonzero(np.abs(along - nearest) <= 0.499 * spacing(points))


def scalar_fields(name: str, unit: str, values: np.ndarray, axes: str) -> list[Field]:
    """A vector becomes its magnitude and its components along `axes`; other tensors are left out."""
    if values.ndim == 1:
        return [Field(name, unit, values)]
    if values.shape[1] != 3:
        return []
    magnitude = Field(f"{name} (magnitude)", unit, np.linalg.norm(values, axis=1))
    return [magnitude] + [Field(f"{name} {axis}", unit, values[:, i]) for i, axis in enumerate(axes)]


def nearest_gap(points: np.ndarray) -> float:
    """The least step between different coordinates of points on a square grid [m]."""
    steps = np.concatenate([np.diff(np.unique(along.round(12))) for along in points.T])
    return float(steps.min()) if len(steps) else 1.0


def square_edges(points: np.ndarray, fields: list[Field], cut: Slice) -> np.ndarray:
    """Squares of the points' own volumes where these are known, as of fluid; else all alike."""
    if cut.flat:
        return np.full(len(points), nearest_gap(points))
    known = {field.name: field.values for field in fields}
    if "fluid_mass" in known and "fluid_density" in known:
        return (known["fluid_mass"] / known["fluid_density"]) ** (1 / (2 if cut.at is None else 3))
    return np.full(len(points), spacing(points))


def read_points(path: Path) -> np.ndarray:
    with h5py.File(path, "r") as file:
        return file["VTKHDF"]["Points"][()].astype(float)


def read_frame(path: Path, time: float, cut: Slice) -> Frame:
    with h5py.File(path, "r") as file:
        group = file["VTKHDF"]
        points = group["Points"][()].astype(float)
        chosen = layer(points, cut)
        fields: list[Field] = []
        for name, data in group["PointData"].items():
            unit = data.attrs.get("units", "")
            unit = unit.decode() if isinstance(unit, bytes) else str(unit)
            axes = "xy" if cut.at is None else "xyz"
            fields += scalar_fields(name, unit, data[()][chosen], axes)
    shown = points[chosen][:, cut.axes]
    return Frame(time, shown, square_edges(shown, fields, cut), fields)


def evenly(count: int, wanted: int) -> list[int]:
    """At most `wanted` of `count` places, spread evenly, first and last included."""
    return sorted({round(i) for i in np.linspace(count - 1, 0, max(1, min(count, wanted)))})


WHOLE = Slice((0, 1), 2, None)


def readable(path: Path, time: float, cut: Slice) -> Frame | None:
    try:
        return read_frame(path, time, cut)
    except (OSError, KeyError) as error:
        print(f"{path}: unreadable, left out of the report ({error})", file=sys.stderr)
        return None


def listed_frames(path: Path) -> list[tuple[Path, float]]:
    """What a series lists, up to the last that can be read."""
    listed = json.loads(path.read_text(encoding="utf-8"))["files"]
    files = [(path.parent / entry["name"], float(entry["time"])) for entry in listed]
    while files and readable(*files[-1], WHOLE) is None:
        files.pop()
    return files


def values_of(files: list[tuple[Path, float]], cut: Slice) -> int:
    """Numbers that a frame takes: points may have come or gone since the start."""
    ends = [readable(*files[place], cut) for place in (0, -1)]
    return max(len(end.points) * (len(end.fields) + 3) for end in ends if end)


def read_series(name: str, files: list[tuple[Path, float]], cut: Slice, wanted: int) -> FrameSeries | None:
    read = [readable(*files[place], cut) for place in evenly(len(files), wanted)]
    frames = [frame for frame in read if frame]
    if not any(len(frame.points) for frame in frames):
        return None
    return FrameSeries(name, frames, len(files), cut)


def quantity_of(name: str) -> str:
    """What fields of several points may share: `pore_pressure` -> `pressure`, `fluid_velocity x` -> `velocity x`."""
    base, _, component = name.partition(" ")
    return f"{base.rpartition('_')[2]} {component}".strip()


def by_quantity(frame: Frame) -> dict[tuple[str, str], np.ndarray]:
    """Values by quantity and unit; the first of a frame where there are two, as of velocities."""
    found: dict[tuple[str, str], np.ndarray] = {}
    for field in frame.fields:
        found.setdefault((quantity_of(field.name), field.unit), field.values)
    return found


def together(series: list[FrameSeries]) -> FrameSeries | None:
    """All points in one map, by what they share and what moving points have besides; None elsewhere."""
    series = [s for s in series if not s.cut.flat]
    if len(series) < 2:
        return None
    known = [by_quantity(s.frames[-1]) for s in series]
    shown = [
        key
        for key in dict.fromkeys(key for k in known for key in k)
        if sum(key in k for k in known) > 1 or any(s.moves and key in k for s, k in zip(series, known))
    ]
    times = [{frame.time: frame for frame in s.frames} for s in series]
    frames = []
    for time in sorted(set.intersection(*(set(t) for t in times))):
        parts = [t[time] for t in times]
        values = [by_quantity(part) for part in parts]
        fields = [
            Field(name, unit, np.concatenate([v.get((name, unit), np.full(len(p.points), np.nan))
                                              for v, p in zip(values, parts)]))
            for name, unit in shown
        ]  # fmt: skip
        points, edges = (np.concatenate([getattr(part, name) for part in parts]) for name in ("points", "edges"))
        frames.append(Frame(time, points, edges, fields))
    if not frames:
        return None
    return FrameSeries("all", frames, min(s.available for s in series), series[0].cut)


def read_all_series(folder: Path) -> list[FrameSeries]:
    """Every point set's series, plane cracks in 3D first; before them, where several are cut alike, one of all points."""
    listed = {path.name.removesuffix(".hdf.series"): listed_frames(path) for path in folder.glob("*.hdf.series")}
    files = {name: found for name, found in sorted(listed.items()) if found}
    if not files:
        return []
    cut = middle_cut(np.concatenate([read_points(found[-1][0]) for found in files.values()]))
    wanted = min(MOST_FRAMES, LARGEST_VALUES // max(sum(values_of(found, cut) for found in files.values()), 1))
    cuts = {name: own_cut(read_points(found[-1][0]), cut) for name, found in files.items()}
    series = [s for name, found in files.items() if (s := read_series(name, found, cuts[name], wanted)) is not None]
    series.sort(key=lambda s: not s.cut.flat)
    all_points = together(series)
    return [all_points, *series] if all_points else series

"""The fields of a run as the page shows them: point sets, frames, and what may be shown of them."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from charts import time_label
from chunks import Chunks
from crack_paths import crack_paths
from frames import evenly, listed_frames, quantity_of, read_points as read_positions
from point_sets import Coarsening, Points, SetFiles, coarsened, coarsening, read_points
from quantities import display_for, pretty_unit, sentence, words

# How much a page may show, the most first: points of a set, frames.
RUNGS = [(cells, frames) for cells, frames in ((40_000, 60), (40_000, 30), (40_000, 21), (20_000, 60), (20_000, 30),
                                               (10_000, 40), (10_000, 21), (5_000, 30), (5_000, 16), (2_500, 16), (1_000, 10))]  # fmt: skip
CROSSES_ACROSS = {2: 20, 3: 9}
TELLING = ("pressure", "opening", "largest principal", "damage", "displacement", "velocity", "smallest principal")
COMPONENTS = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "xy", "yz", "xz")}


@dataclass
class Range:
    """Of a field over all frames: its ends, and those of all but a hundredth of it."""

    unit: str
    low: float = np.inf
    high: float = -np.inf
    most_low: float = np.inf
    most_high: float = -np.inf

    def take(self, values: np.ndarray) -> None:
        known = values[np.isfinite(values)]
        if not known.size:
            return
        self.low, self.high = min(self.low, float(known.min())), max(self.high, float(known.max()))
        ends = np.quantile(known[:: max(known.size // 5000, 1)], [0.005, 0.995])
        self.most_low, self.most_high = min(self.most_low, float(ends[0])), max(self.most_high, float(ends[1]))

    @property
    def ends(self) -> tuple[float, float]:
        return (self.low, self.high) if self.low <= self.high else (0.0, 0.0)

    @property
    def shown(self) -> tuple[float, float]:
        """The colours' ends: peaks, as of stress at a tip, do not take them all."""
        low, high = self.ends
        if high - low > 2.5 * (self.most_high - self.most_low) > 0:
            return self.most_low, self.most_high
        return low, high


@dataclass
class PointSet:
    """A set as it is put into the page, frame by frame."""

    files: SetFiles
    dimension: int
    most: int
    cells: Coarsening | None = None
    coarse: bool = False
    ranges: dict[str, Range] = field(default_factory=dict)
    last: np.ndarray | None = None
    moves: bool = False
    crack: bool = False
    crosses: list[int] = field(default_factory=list)
    stress_name: str = ""

    def read(self, time: float) -> Points | None:
        path = self.files.nearest(time)
        if path is None:
            return None
        points = read_points(path, self.dimension)
        self.crack = any("opening" in name or "aperture" in name for name in points.scalars)
        if len(points.positions) > self.most and not self.crack:
            if self.cells is None or len(self.cells.members) != len(points.positions):
                self.cells = coarsening(points.positions, float(np.median(points.edges)), self.most)
            self.coarse = True
            points = coarsened(points, self.cells)
        return points


def magnitudes(names: Any) -> dict[str, list[str]]:
    """`velocity (magnitude)` -> its components, of every vector among `names`."""
    bases = dict.fromkeys(name[:-2] for name in names if name.endswith((" x", " y", " z")))
    return {f"{base} (magnitude)": [n for n in (f"{base} {axis}" for axis in "xyz") if n in names] for base in bases}


def cross_gap(points: Points, dimension: int) -> float:
    """Between directions of stress that are drawn [m]: whole spacings, so that they stand evenly on a lattice."""
    edge = float(np.median(points.edges))
    longest = float(np.ptp(points.positions, axis=0).max()) + edge
    return edge * max(np.ceil(longest / (CROSSES_ACROSS[dimension] * edge)), 1.0)


def cross_places(points: Points, dimension: int) -> list[int]:
    """Points at which directions of stress are drawn: the one nearest the middle of each cell of a coarse grid."""
    if points.stress is None or not len(points.positions):
        return []
    at = points.positions
    cell = cross_gap(points, dimension)
    where = (at - at.min(axis=0)) / cell + 0.5 * float(np.median(points.edges)) / cell
    off = np.linalg.norm(where - np.floor(where) - 0.5, axis=1)
    order = np.argsort(off.round(3), kind="stable")  # of equals always the same corner
    _, first = np.unique(np.floor(where[order]).astype(int), axis=0, return_index=True)
    return sorted(int(i) for i in order[first])


def stress_data(points: Points, places: list[int], chunks: Chunks) -> dict[str, Any]:
    """Components of stress at `places`."""
    taken = 0.5 * (points.stress[places] + points.stress[places].transpose(0, 2, 1))
    return {name: chunks.add(taken[:, "xyz".index(name[0]), "xyz".index(name[1])], fine=True)
            for name in COMPONENTS[points.positions.shape[1]]}  # fmt: skip


def frame_data(one: PointSet, points: Points, chunks: Chunks) -> dict[str, Any]:
    """Positions are written only where they differ from the frame before: most bodies keep theirs."""
    data: dict[str, Any] = {"values": {}}
    if one.last is None or not np.array_equal(one.last, points.positions):
        one.moves = one.moves or one.last is not None
        one.last = points.positions
        one.crosses = cross_places(points, one.dimension)
        data["points"] = {axis: chunks.add(along, fine=True) for axis, along in zip("xyz", points.positions.T)}
        data["points"]["edge"] = chunks.add(points.edges)
        if one.crosses:
            data["crosses"] = one.crosses
            data["crossGap"] = cross_gap(points, one.dimension)
        if one.crack and one.dimension == 2 and (paths := crack_paths(points.positions)):
            data["paths"] = {"branch": paths.branch.tolist(), "along": chunks.add(paths.along, fine=True),
                             "joined": [[int(a), int(b)] for a, b in paths.joined]}  # fmt: skip
    for name, values in points.scalars.items():
        data["values"][name] = chunks.add(values)
        one.ranges.setdefault(name, Range(points.units[name])).take(values)
    for name, parts in magnitudes(points.scalars).items():
        size = np.sqrt(sum(points.scalars[part] ** 2 for part in parts))
        one.ranges.setdefault(name, Range(points.units[parts[0]])).take(size)
    if one.crosses and points.stress is not None:
        one.stress_name = points.stress_name
        data["stress"] = stress_data(points, one.crosses, chunks)
    return data


def rank(name: str) -> tuple[int, str]:
    """What tells most comes first."""
    place = next((i for i, word in enumerate(TELLING) if word in name), len(TELLING))
    component = name.endswith((" x", " y", " z"))
    return place + (len(TELLING) if component else 0), name


def shown_field(name: str, ranges: list[Range], of: dict[str, Any]) -> dict[str, Any]:
    low, high = min(r.ends[0] for r in ranges), max(r.ends[1] for r in ranges)
    shown = min(r.shown[0] for r in ranges), max(r.shown[1] for r in ranges)
    display = display_for(ranges[0].unit, max(abs(shown[0]), abs(shown[1])))
    return {"name": name, "label": words(name), "unit": display.unit, "factor": display.factor,
            "low": low, "high": high, "shown": shown, "of": of}  # fmt: skip


def fields_of(one: PointSet) -> dict[str, tuple[Range, list[str]]]:
    """What may be shown: scalars, and magnitudes that the page makes of components."""
    parts = magnitudes([n for n in one.ranges if "(magnitude)" not in n])
    return {name: (found, parts.get(name, [name])) for name, found in sorted(one.ranges.items(), key=lambda r: rank(r[0]))}


def own_view(one: PointSet) -> dict[str, Any]:
    fields = [shown_field(name, [found], {one.files.name: parts}) for name, (found, parts) in fields_of(one).items()]
    return {"name": one.files.name, "sets": [one.files.name], "fields": fields}


def common_view(sets: list[PointSet]) -> dict[str, Any] | None:
    """All points in one map, by quantities that they share and those of points that move; none of one set."""
    if len(sets) < 2:
        return None
    known = []
    for one in sets:
        quantities: dict[tuple[str, str], tuple[Range, list[str]]] = {}
        for name, (found, parts) in fields_of(one).items():
            quantities.setdefault((quantity_of(name), found.unit), (found, parts))
        known.append(quantities)
    fields = []
    for key in dict.fromkeys(key for quantities in known for key in quantities):
        having = [(one, quantities[key]) for one, quantities in zip(sets, known) if key in quantities]
        if len(having) > 1 or having[0][0].moves:
            of = {one.files.name: parts for one, (_, parts) in having}
            fields.append(shown_field(key[0], [found for _, (found, _) in having], of))
    return {"name": "all", "sets": [one.files.name for one in sets], "fields": fields} if fields else None


def set_data(one: PointSet, frames: list[dict[str, Any] | None]) -> dict[str, Any]:
    note = ""
    if one.coarse and one.cells is not None:
        note = f"{words(one.files.name)}: means of up to {one.cells.side ** one.dimension} points are shown"
    displacement = [f"displacement {axis}" for axis in "xyz"[: one.dimension]]
    velocity = next(([f"{name} {axis}" for axis in "xyz"[: one.dimension]] for name in
                     (n[:-2] for n in one.ranges if n.endswith("velocity x")) if one.moves), [])  # fmt: skip
    return {"name": one.files.name, "kind": "crack" if one.crack else "points", "note": note, "frames": frames,
            "displacement": displacement if all(d in one.ranges for d in displacement) else [],
            "velocity": velocity if all(v in one.ranges for v in velocity) else [],
            "stress": words(one.stress_name)}  # fmt: skip


def found_sets(folder: Path) -> list[SetFiles]:
    listed = {path.name.removesuffix(".hdf.series"): listed_frames(path) for path in folder.glob("*.hdf.series")}
    return [SetFiles(name, files) for name, files in sorted(listed.items()) if files]


def dimension_of(sets: list[SetFiles]) -> int:
    """3 where points lie off the plane z = 0."""
    ends = [read_positions(one.files[-1][0]) for one in sets]
    return 3 if any(len(points) and np.ptp(points[:, 2]) > 0 for points in ends) else 2


def each_frame(sets: list[PointSet], times: list[float], chunks: Chunks) -> Iterator[list[dict[str, Any] | None]]:
    for time in times:
        read = [one.read(time) for one in sets]
        yield [frame_data(one, points, chunks) if points is not None else None for one, points in zip(sets, read)]


def assembled(sets: list[PointSet], times: list[float], available: int, dimension: int,
              frames: list[list[dict[str, Any] | None]]) -> dict[str, Any]:  # fmt: skip
    solid = [one for one in sets if not one.crack]
    common = common_view(solid)
    views = [common] if common else []
    views += [own_view(one) for one in sorted(sets, key=lambda one: one.crack) if one.ranges]
    largest = max((float(np.abs(one.last).max(initial=0.0)) for one in sets if one.last is not None), default=1.0)
    length = display_for("m", largest)
    note = f"{len(times)} of {available} frames, evenly chosen" if available > len(times) else ""
    return {"dimension": dimension, "length": {"factor": length.factor, "unit": pretty_unit(length.unit)},
            "times": [{"time": time, "label": time_label(time)} for time in times], "note": sentence(note),
            "sets": [set_data(one, [frame[place] for frame in frames]) for place, one in enumerate(sets)],
            "views": views}  # fmt: skip


def build(found: list[SetFiles], times: list[float], chosen: list[int], cells: int, chunks: Chunks) -> dict[str, Any]:
    dimension = dimension_of(found)
    sets = [PointSet(one, dimension, cells) for one in found]
    picked = [times[place] for place in chosen]
    frames = list(each_frame(sets, picked, chunks))
    return assembled(sets, picked, len(times), dimension, frames)


def json_size(data: dict[str, Any]) -> int:
    return len(json.dumps(data, separators=(",", ":")))


def page_size(data: dict[str, Any], chunks: Chunks) -> int:
    """Bytes that they take in a page: chunks as base64."""
    return json_size(data) + 4 * len(chunks) // 3 + 3 * len(chunks.packed)


def all_times(found: list[SetFiles]) -> list[float]:
    return sorted({time for one in found for _, time in one.files})


def expected_size(found: list[SetFiles], times: list[float], cells: int) -> tuple[int, int]:
    """Bytes of a page with the last frame alone, and what a further one takes: most frames share their points."""
    sizes = []
    for chosen in ([len(times) - 1], sorted({len(times) // 2, len(times) - 1})):
        trial = Chunks()
        sizes.append(page_size(build(found, times, chosen, cells, trial), trial))
    return sizes[0], sizes[1] - sizes[0]


def fields_data(folder: Path, budget: int) -> tuple[dict[str, Any] | None, Chunks]:
    """As much of a run's frames as `budget` bytes of a page hold: points are put together and frames left out."""
    found = found_sets(folder)
    if not found:
        return None, Chunks()
    times = all_times(found)
    sizes: dict[int, tuple[int, int]] = {}
    for cells, most in RUNGS:
        chosen = evenly(len(times), most)
        if cells not in sizes:
            sizes[cells] = expected_size(found, times, cells)
        one, further = sizes[cells]
        if one + further * (len(chosen) - 1) > 1.2 * budget and (cells, most) != RUNGS[-1]:
            continue
        chunks = Chunks()
        data = build(found, times, chosen, cells, chunks)
        if page_size(data, chunks) <= budget or (cells, most) == RUNGS[-1]:
            return data, chunks
    raise AssertionError("the last rung is always taken")

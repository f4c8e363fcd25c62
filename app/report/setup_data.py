"""What a scene sets up, as a picture shows it: boxes, places, conditions of faces and stresses, from what `perifrac check` says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from quantities import quantity

Scene = dict[str, Any]


@dataclass(frozen=True)
class Box:
    """An axis-parallel part of space; infinite where it does not end."""

    kind: str  # region, cut-out, free fluid, container, inlet, outlet, wall
    low: np.ndarray
    high: np.ndarray
    label: str


@dataclass(frozen=True)
class Place:
    kind: str  # inlet, well, probe, pin
    at: np.ndarray
    label: str


@dataclass(frozen=True)
class Condition:
    """Of one physics on one face of the body."""

    physics: str  # solid, pore_flow
    kind: str
    face: str
    label: str
    direction: np.ndarray | None = None  # of a load, where it has one
    within: Box | None = None  # the part of the face that it holds on


@dataclass(frozen=True)
class Face:
    name: str
    axis: int  # -1: curved
    direction: int
    coordinate: float  # of a curved one its radius
    centre: tuple[float, ...] = (0.0, 0.0, 0.0)
    along: int = -1  # the axis of a hole in 3D

    @property
    def is_hole(self) -> bool:
        return self.axis < 0 and self.direction < 0


@dataclass(frozen=True)
class Setup:
    dimension: int
    title: str
    low: np.ndarray  # of all that is drawn
    high: np.ndarray
    faces: list[Face]
    points: np.ndarray  # of a body that is no lattice
    boxes: list[Box]
    places: list[Place]
    conditions: list[Condition]
    cracks: dict[str, np.ndarray]  # by name: facets, their corners going round
    stress: list[tuple[int, str]]  # axis and figure of the stress at rest, compressive
    stress_name: str
    gravity: np.ndarray | None

    @property
    def radius(self) -> float | None:
        return next((face.coordinate for face in self.faces if face.axis < 0 and not face.is_hole), None)

    @property
    def has_body(self) -> bool:
        return bool(self.faces)


def box(kind: str, entry: Scene, dimension: int, label: str) -> Box:
    low, high = (np.array(entry.get(end, [sign * np.inf] * dimension)) for end, sign in (("from", -1), ("to", 1)))
    return Box(kind, low, high, label)


def stress_of(section: Scene) -> tuple[str, list[float]] | None:
    for key, word in (("confining_stress", "effective"), ("total_stress", "total")):
        if key in section:
            return word, section[key]
    return None


def region_label(scene: Scene, name: str) -> str:
    """With the stress that it bears, where that is its own."""
    own = stress_of(scene.get("solid", {}).get("regions", {}).get(name, {}))
    return name if own is None else f"{name}: {own[0]} stress " + " and ".join(quantity(s, "Pa", 3) for s in own[1])


def flow_label(entry: Scene, dimension: int) -> str:
    if entry.get("holds") == "fluid":
        return "of free fluid"
    if "pressure" in entry:
        return quantity(entry["pressure"], "Pa", 3)
    if "volume_rate" in entry:
        return quantity(entry["volume_rate"], "m^3/s", 3)
    return quantity(entry["rate"], "m^2/s" if dimension == 2 else "m^3/s", 3) if "rate" in entry else ""


def boxes_of(scene: Scene, dimension: int) -> list[Box]:
    body, fluid = scene.get("body", {}), scene.get("fluid", {})
    found = [box("region", entry, dimension, region_label(scene, name)) for name, entry in body.get("regions", {}).items()]
    found += [box("cut-out", entry, dimension, name) for name, entry in body.get("cutouts", {}).items() if "radius" not in entry]
    if "container" in fluid:
        found.append(box("container", fluid["container"], dimension, ""))
    found += [box("free fluid", entry, dimension, entry["name"]) for entry in fluid.get("blocks", [])]
    unit = "kg/(m s)" if dimension == 2 else "kg/s"
    for kind in ("inlet", "outlet", "wall"):
        for entry in fluid.get(kind + "s", []):
            rate = f": {quantity(entry['rate'], unit, 3)}" if "rate" in entry else ""
            found.append(box(kind, entry, dimension, entry["name"] + rate))
    return found


def places_of(scene: Scene, dimension: int) -> list[Place]:
    found = []
    for entry in scene.get("crack_fluid", {}).get("inlets", []):
        found.append(Place("inlet", np.array(entry["at"]), f"{entry['name']}: {flow_label(entry, dimension)}"))
    for entry in scene.get("pore_flow", {}).get("sources", []):
        found.append(Place("well", np.array(entry["at"]), flow_label(entry, dimension)))
    for entry in scene.get("solid", {}).get("pins", []):
        found.append(Place("pin", np.array(entry["at"]), entry["axis"]))
    for entry in scene.get("output", {}).get("probes", []):
        found.append(Place("probe", np.array(entry["at"]), entry["name"]))
    return found


def load_label(entry: Scene, kind: str, dimension: int, outward: np.ndarray) -> tuple[str, np.ndarray | None]:
    """The figure of a condition, and the direction of a load or a motion."""
    if kind == "traction":
        load = np.array(entry["traction"])
        size = float(np.linalg.norm(load))
        return quantity(size, "Pa", 3), load / size if size > 0 else None
    if kind == "pressure":
        return ("hydrostatic" if entry.get("hydrostatic") else quantity(entry["pressure"], "Pa", 3)), None
    if kind == "flux":
        return quantity(entry["flux"], "m/s", 3), None
    if kind == "rigid_plate":
        return quantity(entry["force"], "N/m" if dimension == 2 else "N", 3), None
    for key, unit in (("normal_velocity", "m/s"), ("normal_displacement", "m")):
        if entry.get(key):
            return quantity(abs(entry[key]), unit, 3), np.sign(entry[key]) * outward
    for key, unit in (("velocity", "m/s"), ("displacement", "m")):
        if any(entry.get(key, [])):
            given = np.array(entry[key])
            return quantity(float(np.linalg.norm(given)), unit, 3), given / np.linalg.norm(given)
    return "", None


def conditions_of(scene: Scene, dimension: int, boxes: list[Box], faces: list[Face]) -> list[Condition]:
    found = []
    outward = {face.name: np.eye(dimension)[face.axis] * face.direction for face in faces}
    for physics in ("solid", "pore_flow"):
        for face, entry in scene.get(physics, {}).get("boundary", {}).items():
            kind = entry["type"]
            if kind in ("free", "sealed"):
                continue
            label, direction = load_label(entry, kind, dimension, outward[face])
            varies = " × schedule" if label and "schedule" in entry else ""
            within = next((b for b in boxes if b.kind == "region" and b.label.partition(":")[0] == entry.get("region")), None)
            found.append(Condition(physics, kind, face, label + varies, direction, within))
    return found


def extent(setup: Scene, boxes: list[Box]) -> tuple[np.ndarray, np.ndarray, list[Face]]:
    """Of the body, and of what lies beside it; with its faces."""
    dimension = setup["dimension"]
    faces = [Face(**face) for face in setup.get("body", {}).get("faces", [])]
    low, high = np.full(dimension, np.inf), np.full(dimension, -np.inf)
    for face in faces:
        if face.is_hole:
            continue
        if face.axis < 0:
            flat = {f.axis for f in faces}
            low = np.minimum(low, [0.0 if a in flat else -face.coordinate for a in range(dimension)])
            high = np.maximum(high, face.coordinate)
        else:
            low[face.axis] = min(low[face.axis], face.coordinate)
            high[face.axis] = max(high[face.axis], face.coordinate)
    for one in (b for b in boxes if b.kind != "region"):
        low = np.minimum(low, np.where(np.isfinite(one.low), one.low, np.inf))
        high = np.maximum(high, np.where(np.isfinite(one.high), one.high, -np.inf))
    return low, high, faces


def clipped(one: Box, low: np.ndarray, high: np.ndarray) -> Box:
    return Box(one.kind, np.maximum(one.low, low), np.minimum(one.high, high), one.label)


def read_setup(said: Scene) -> Setup:
    scene, dimension = said["scene"], said["dimension"]
    boxes, places = boxes_of(scene, dimension), places_of(scene, dimension)
    low, high, faces = extent(said, boxes)
    boxes = [clipped(one, low, high) for one in boxes]
    stated = stress_of(scene.get("solid", {}))
    stress = [(axis, quantity(s, "Pa", 3)) for axis, s in enumerate(stated[1]) if s] if stated else []
    gravity = np.array(scene["gravity"]) if any(scene.get("gravity", [])) else None
    return Setup(dimension, scene.get("title", "Set-up"), low, high, faces,
                 np.array(said.get("body", {}).get("points", [])).reshape(-1, dimension),
                 boxes, places, conditions_of(scene, dimension, boxes, faces),
                 {crack["name"]: np.array(crack["facets"]) for crack in said.get("cracks", []) if crack["facets"]},
                 stress, f"{stated[0]} stress at rest" if stated else "", gravity)  # fmt: skip

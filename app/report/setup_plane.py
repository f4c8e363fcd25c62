"""The set-up of a scene in 2D, drawn as engineers draw one: supports, loads and wells by their symbols."""

from __future__ import annotations

import matplotlib.patches as patches
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from quantities import display_for
from setup_data import Box, Condition, Face, Setup

INK, FAINT = "#1c2733", "#5b6875"
ROCK, WATER, STRESS = "#ece5d8", "#56B4E9", "#D55E00"
REGIONS = ("#CC79A7", "#009E73", "#E69F00", "#0072B2")
FLOW = "#0072B2"
BOXES = {"free fluid": {"facecolor": WATER, "alpha": 0.55}, "cut-out": {"facecolor": "white", "edgecolor": INK, "linewidth": 1.0},
         "container": {"facecolor": "none", "edgecolor": FLOW, "linestyle": "--", "linewidth": 1.0},
         "inlet": {"facecolor": "#009E73", "alpha": 0.6}, "outlet": {"facecolor": "#E69F00", "alpha": 0.6},
         "wall": {"facecolor": FAINT}}  # fmt: skip
PLACES = {"inlet": ("inlet of a crack", "v", "#D55E00"), "well": ("well in the pores", "*", FLOW),
          "probe": ("probe", "x", "#009E73"), "pin": ("pin", "^", INK)}  # fmt: skip
ORDER = ("region", "cut-out", "free fluid", "wall", "inlet", "outlet", "container")  # from below
ARROWS = 6  # along a face, at most


class Plane:
    """Axes in a unit that suits, and sizes of symbols."""

    def __init__(self, axes: Axes, setup: Setup) -> None:
        self.axes, self.setup = axes, setup
        largest = float(np.abs([setup.low, setup.high]).max())
        self.length = display_for("m", largest)
        self.low, self.high = setup.low * self.length.factor, setup.high * self.length.factor
        self.size = float((self.high - self.low).max())
        self.used: dict[str, Line2D | patches.Patch] = {}  # for the legend

    def scaled(self, at: np.ndarray) -> np.ndarray:
        return np.asarray(at) * self.length.factor

    def rectangle(self, one: Box, **style) -> None:
        low, high = self.scaled(one.low), self.scaled(one.high)
        self.axes.add_patch(patches.Rectangle(low, *(high - low), **style))

    def note(self, at: np.ndarray, text: str, shift=(0, 0), **style) -> None:
        if text:
            box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
            self.axes.annotate(text, at, xytext=shift, textcoords="offset points", fontsize=8,
                               bbox=box, zorder=9, **{"ha": "center", "va": "center", **style})  # fmt: skip

    def arrow(self, tail: np.ndarray, head: np.ndarray, colour: str, width: float = 1.2) -> None:
        self.axes.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": width,
                                                       "shrinkA": 0, "shrinkB": 0}, zorder=7)  # fmt: skip


def draw_body(plane: Plane) -> None:
    setup, axes = plane.setup, plane.axes
    style = {"facecolor": ROCK, "edgecolor": INK, "linewidth": 1.2, "zorder": 1}
    if not setup.has_body:
        return
    if setup.radius is not None:
        part = len(setup.faces) > 1
        axes.add_patch(patches.Wedge((0, 0), setup.radius * plane.length.factor, 0, 90 if part else 360, **style))
        return
    planes = sorted((face for face in setup.faces if not face.is_hole), key=lambda face: face.axis)
    low, high = (plane.scaled([face.coordinate for face in planes if face.direction == side])
                 for side in (-1, 1))  # fmt: skip
    rock = axes.add_patch(patches.Rectangle(low, *(high - low), **style))
    for hole in (face for face in setup.faces if face.is_hole):
        circle = patches.Circle(plane.scaled(np.array(hole.centre[:2])), hole.coordinate * plane.length.factor,
                                **{**style, "facecolor": "white", "zorder": 1.5})  # fmt: skip
        axes.add_patch(circle).set_clip_path(rock)
    if len(setup.points):
        axes.plot(*plane.scaled(setup.points).T, ".", color=FAINT, markersize=1.5, zorder=2)


def draw_boxes(plane: Plane) -> None:
    colours = iter(REGIONS * 10)
    for one in sorted(plane.setup.boxes, key=lambda b: ORDER.index(b.kind)):
        style = BOXES.get(one.kind) or {"facecolor": next(colours), "alpha": 0.25}
        plane.rectangle(one, zorder=2 + 0.1 * ORDER.index(one.kind), **style)
        if one.kind not in ("region", "cut-out", "container"):
            plane.used.setdefault(one.kind, patches.Patch(**style))
        if one.kind == "region":
            high = plane.scaled(one.high)
            plane.note([0.5 * (plane.scaled(one.low)[0] + high[0]), high[1]], one.label, (0, -9), color=INK)
        elif one.kind in ("inlet", "outlet", "free fluid"):
            plane.note(plane.scaled(0.5 * (one.low + one.high)), one.label)


def draw_cracks(plane: Plane) -> None:
    for name, facets in plane.setup.cracks.items():
        corners = plane.scaled(facets)
        for facet in corners:
            plane.axes.plot(*facet.T, color=INK, linewidth=2.2, solid_capstyle="round", zorder=6)
        plane.note(corners[len(corners) // 2].mean(axis=0), name, (10, -8), ha="left")
        plane.used.setdefault("crack", Line2D([], [], color=INK, linewidth=2.2))


def draw_places(plane: Plane) -> None:
    for place in plane.setup.places:
        word, marker, colour = PLACES[place.kind]
        plane.axes.plot(*plane.scaled(place.at), marker, color=colour, markersize=8 if place.kind != "pin" else 6,
                        markeredgecolor="white" if marker != "x" else colour, markeredgewidth=0.6 if marker != "x" else 1.6,
                        zorder=8, clip_on=False)  # fmt: skip
        plane.used.setdefault(word, Line2D([], [], linestyle="none", marker=marker, color=colour, markersize=7))
        if place.kind in ("inlet", "well", "probe"):
            plane.note(plane.scaled(place.at), place.label, (8, 8), ha="left", color=colour)


def line_of(plane: Plane, face: Face, condition: Condition) -> np.ndarray:
    """Both ends of the part of a face on which a condition holds."""
    along = 1 - face.axis
    ends = np.empty((2, 2))
    own = [f.coordinate for f in plane.setup.faces if f.axis == along] or [plane.setup.low[along]]
    ends[:, along] = min(own), max(own) if len(own) > 1 else plane.setup.high[along]
    ends[:, face.axis] = face.coordinate
    if condition.within is not None:
        ends[:, along] = condition.within.low[along], condition.within.high[along]
    return plane.scaled(ends)


def draw_roller(plane: Plane, line: np.ndarray, outward: np.ndarray, gap: float) -> None:
    count = max(int(round(12 * np.linalg.norm(line[1] - line[0]) / plane.size)), 2)
    at = line[0] + np.linspace(0.5 / count, 1 - 0.5 / count, count)[:, None] * (line[1] - line[0]) + 0.5 * gap * outward
    plane.axes.plot(*at.T, "o", color="white", markeredgecolor=INK, markersize=5, markeredgewidth=1.0, zorder=5, clip_on=False)
    plane.used.setdefault("roller", Line2D([], [], linestyle="none", marker="o", color="white", markeredgecolor=INK))


def draw_strip(plane: Plane, line: np.ndarray, outward: np.ndarray, gap: float, kind: str) -> None:
    low, high = np.minimum(line[0], line[1] + gap * outward), np.maximum(line[0], line[1] + gap * outward)
    style = {"fixed": {"facecolor": "none", "edgecolor": INK, "hatch": "////"}, "rigid_plate": {"facecolor": FAINT}}[kind]
    plane.axes.add_patch(patches.Rectangle(low, *(high - low), linewidth=0.5, zorder=4, **style))
    plane.used.setdefault(kind.replace("_", " "), patches.Patch(**style))


def draw_load(plane: Plane, line: np.ndarray, outward: np.ndarray, direction: np.ndarray, gap: float, colour: str) -> None:
    """Arrows that end at the face, or begin there where they pull."""
    length = 0.07 * plane.size
    count = min(max(int(12 * np.linalg.norm(line[1] - line[0]) / plane.size), 1), ARROWS)
    for share in np.linspace(0.5 / count, 1 - 0.5 / count, count):
        at = line[0] + share * (line[1] - line[0]) + gap * outward
        if direction @ outward > 1e-9:
            plane.arrow(at, at + length * direction, colour)
        else:
            plane.arrow(at - length * direction, at, colour)


def draw_hole(plane: Plane, hole: Face, condition: Condition) -> None:
    """What presses on its wall as arrows from within; pressure of pores as a line along it."""
    centre, radius = plane.scaled(np.array(hole.centre[:2])), hole.coordinate * plane.length.factor
    if condition.physics == "pore_flow":
        plane.axes.add_patch(patches.Circle(centre, radius, fill=False, edgecolor=FLOW, linewidth=3, alpha=0.8, zorder=4.5))
        plane.used.setdefault("pressure of pores held", Line2D([], [], color=FLOW, linewidth=3))
        plane.note(centre - [0, radius], f"{hole.name}: {condition.label}", (0, -10), color=FLOW)
        return
    for angle in np.pi * (0.125 + 0.25 * np.arange(8)):
        out = np.array([np.cos(angle), np.sin(angle)])
        plane.arrow(centre + 0.35 * radius * out, centre + radius * out, INK, 0.8)
    plane.note(centre + [0, radius], f"{hole.name}: {condition.label}", (0, 12))


def draw_condition(plane: Plane, condition: Condition) -> None:
    face = next((f for f in plane.setup.faces if f.name == condition.face), None)
    if face is None:
        return
    if face.is_hole:
        draw_hole(plane, face, condition)
        return
    if face.axis < 0:
        angle = np.pi / 4
        out = np.array([np.cos(angle), np.sin(angle)])
        at = face.coordinate * plane.length.factor * out
        plane.note(at, f"{condition.kind.replace('_', ' ')} {condition.label}", tuple(14 * out), ha="left")
        return
    outward = np.eye(2)[face.axis] * face.direction
    line = line_of(plane, face, condition)
    middle, gap = line.mean(axis=0), 0.022 * plane.size
    if condition.physics == "pore_flow":
        plane.axes.plot(*line.T, color=FLOW, linewidth=3, zorder=4.5, alpha=0.8)
        plane.used.setdefault("pressure of pores held" if condition.kind == "pressure" else "flux into pores",
                              Line2D([], [], color=FLOW, linewidth=3))  # fmt: skip
        plane.note(middle - 0.2 * (line[1] - line[0]), condition.label, tuple(-14 * outward), color=FLOW)
        return
    if condition.kind == "roller":
        draw_roller(plane, line, outward, gap)
    if condition.kind in ("fixed", "rigid_plate"):
        draw_strip(plane, line, outward, gap, condition.kind)
    if condition.kind in ("pressure", "traction", "rigid_plate") or condition.label:
        direction = condition.direction if condition.direction is not None else -outward
        beyond = gap if condition.kind in ("fixed", "rigid_plate", "roller") else 0.0
        draw_load(plane, line, outward, direction, beyond, INK)
        plane.note(middle + 0.12 * plane.size * outward, condition.label)


def draw_stress(plane: Plane) -> None:
    """Pairs of arrows that press from both sides, outside of what is drawn."""
    for axis, figure in plane.setup.stress:
        unit = np.eye(2)[axis]
        middle = 0.5 * (plane.low + plane.high)
        middle[1 - axis] = plane.low[1 - axis] + 0.25 * (plane.high - plane.low)[1 - axis]
        for side in (-1, 1):
            edge = middle.copy()
            edge[axis] = (plane.low if side < 0 else plane.high)[axis]
            head = edge + 0.05 * side * plane.size * unit
            plane.arrow(head + 0.10 * side * plane.size * unit, head, STRESS, 2.4)
            if side > 0:
                plane.note(head + 0.05 * plane.size * unit, figure, (0, 11) if axis == 0 else (26, 0), color=STRESS)
    if plane.setup.stress:
        plane.used[plane.setup.stress_name] = Line2D([], [], color=STRESS, linewidth=2.4, marker=">")


def draw_gravity(plane: Plane) -> None:
    if plane.setup.gravity is None:
        return
    tail = np.array([plane.low[0] - 0.14 * plane.size, plane.high[1]])
    along = plane.setup.gravity / np.linalg.norm(plane.setup.gravity)
    plane.arrow(tail, tail + 0.12 * plane.size * along, FAINT, 1.8)
    plane.note(tail + 0.06 * plane.size * along, "g", (-9, 0))


def draw_plane(axes: Axes, setup: Setup) -> None:
    plane = Plane(axes, setup)
    draw_body(plane)
    draw_boxes(plane)
    for condition in setup.conditions:
        draw_condition(plane, condition)
    draw_cracks(plane)
    draw_places(plane)
    draw_stress(plane)
    draw_gravity(plane)
    around = 0.18 * plane.size
    axes.set(xlim=(plane.low[0] - around, plane.high[0] + around), ylim=(plane.low[1] - around, plane.high[1] + around),
             aspect="equal", xlabel=f"x [{plane.length.unit}]", ylabel=f"y [{plane.length.unit}]")  # fmt: skip
    axes.grid(False)
    axes.legend(plane.used.values(), plane.used.keys(), loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0)

"""The set-up of a scene in 3D: the body's edges, boxes in it, cracks as facets, conditions by the colours of faces."""

from __future__ import annotations

import itertools

import matplotlib.patches as patches
import numpy as np
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from quantities import display_for
from setup_data import Condition, Face, Setup
from setup_plane import BOXES, FAINT, FLOW, INK, PLACES, REGIONS, STRESS

FACES = {"roller": "#E69F00", "fixed": INK, "rigid_plate": FAINT, "traction": "#CC79A7", "pressure": "#D55E00"}


def corners(low: np.ndarray, high: np.ndarray) -> np.ndarray:
    return np.array(list(itertools.product(*zip(low, high))))


def edges(low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
    at = corners(low, high)
    return [at[[i, i | bit]] for i in range(8) for bit in (1, 2, 4) if not i & bit]


def side(low: np.ndarray, high: np.ndarray, face: Face) -> np.ndarray:
    """Its four corners, going round."""
    first, second = (axis for axis in range(3) if axis != face.axis)
    square = np.empty((4, 3))
    square[:, face.axis] = (low if face.direction < 0 else high)[face.axis]
    square[:, first] = [low[first], high[first], high[first], low[first]]
    square[:, second] = [low[second], low[second], high[second], high[second]]
    return square


class Solid:
    """Axes in a unit that suits."""

    def __init__(self, axes: Axes3D, setup: Setup) -> None:
        self.axes, self.setup = axes, setup
        self.length = display_for("m", float(np.abs([setup.low, setup.high]).max()))
        self.low, self.high = setup.low * self.length.factor, setup.high * self.length.factor
        self.size = float((self.high - self.low).max())
        self.used: dict[str, Line2D | patches.Patch] = {}

    def frame(self, low: np.ndarray, high: np.ndarray, **style) -> None:
        self.axes.add_collection3d(Line3DCollection(edges(low, high), **style))

    def note(self, at: np.ndarray, text: str, colour: str = INK) -> None:
        if text:
            self.axes.text(*at, text, fontsize=8, color=colour, zorder=20)

    def arrow(self, tail: np.ndarray, along: np.ndarray, colour: str) -> None:
        self.axes.quiver(*tail, *along, color=colour, linewidth=2, arrow_length_ratio=0.35)


def draw_ball(solid: Solid) -> None:
    part = len(solid.setup.faces) > 1
    around = np.linspace(0, np.pi / 2 if part else 2 * np.pi, 25)
    down = np.linspace(0, np.pi / 2 if part else np.pi, 13)
    radius = solid.setup.radius * solid.length.factor
    x, y, z = (radius * np.outer(np.sin(down), np.cos(around)), radius * np.outer(np.sin(down), np.sin(around)),
               radius * np.outer(np.cos(down), np.ones_like(around)))  # fmt: skip
    solid.axes.plot_wireframe(x, y, z, color=FAINT, linewidth=0.5)


def rim(solid: Solid, hole: Face, level: np.ndarray) -> np.ndarray:
    """Points around the end of a hole, at that side of the body."""
    around = np.linspace(0, 2 * np.pi, 49)
    first, second = (axis for axis in range(3) if axis != hole.along)
    points = np.empty((len(around), 3))
    points[:, hole.along] = level[hole.along]
    for axis, way in ((first, np.cos(around)), (second, np.sin(around))):
        at = (hole.centre[axis] + hole.coordinate * way) * solid.length.factor
        points[:, axis] = np.clip(at, solid.low[axis], solid.high[axis])
    return points


def draw_holes(solid: Solid) -> None:
    for hole in (face for face in solid.setup.faces if face.is_hole):
        ends = [rim(solid, hole, level) for level in (solid.low, solid.high)]
        lines = [*ends, *(np.array([ends[0][k], ends[1][k]]) for k in range(0, 48, 6))]
        solid.axes.add_collection3d(Line3DCollection(lines, colors=INK, linewidths=0.8))


def draw_boxes(solid: Solid) -> None:
    colours = iter(REGIONS * 10)
    for one in solid.setup.boxes:
        style = BOXES.get(one.kind, {})
        colour = next(colours) if one.kind == "region" else style.get("facecolor", FLOW)
        if colour in ("none", "white"):
            colour = style["edgecolor"]
        low, high = one.low * solid.length.factor, one.high * solid.length.factor
        solid.frame(low, high, colors=colour, linewidths=1.2, linestyles="--" if one.kind in ("cut-out", "container") else "-")
        if one.kind in ("free fluid", "wall", "inlet", "outlet", "region"):
            sides = [side(low, high, Face("", axis, way, 0.0)) for axis in range(3) for way in (-1, 1)]
            solid.axes.add_collection3d(Poly3DCollection(sides, facecolors=colour, alpha=0.12))
        if one.kind == "region":
            solid.note(high, one.label, colour)
        else:
            solid.used.setdefault(one.kind, Line2D([], [], color=colour))
            solid.note(0.5 * (low + high), one.label)


def draw_condition(solid: Solid, condition: Condition) -> None:
    face = next((f for f in solid.setup.faces if f.name == condition.face), None)
    if face is None:
        return
    words = condition.kind.replace("_", " ")
    if condition.physics == "pore_flow":
        words = "pressure of pores held" if condition.kind == "pressure" else "flux into pores"
    colour = FLOW if condition.physics == "pore_flow" else FACES[condition.kind]
    solid.used.setdefault(words, patches.Patch(facecolor=colour, alpha=0.45))
    if face.is_hole:
        solid.note(rim(solid, face, solid.high)[0], f"{face.name}: {words} {condition.label}", colour)
        return
    if face.axis < 0:
        at = np.full(3, solid.setup.radius * solid.length.factor / np.sqrt(3))
        solid.note(at, f"{words} {condition.label}", colour)
        return
    low, high = solid.low.copy(), solid.high.copy()
    if condition.within is not None:
        low, high = condition.within.low * solid.length.factor, condition.within.high * solid.length.factor
    square = side(low, high, face)
    solid.axes.add_collection3d(Poly3DCollection([square], facecolors=colour, alpha=0.22))
    outward = np.eye(3)[face.axis] * face.direction
    if condition.label:
        if condition.physics == "solid":
            along = condition.direction if condition.direction is not None else -outward
            solid.arrow(square.mean(axis=0) - 0.15 * solid.size * along * (1 if along @ outward <= 0 else 0),
                        0.15 * solid.size * along, colour)  # fmt: skip
        solid.note(square.mean(axis=0) + 0.05 * solid.size * outward, condition.label, colour)


def draw_places(solid: Solid) -> None:
    for place in solid.setup.places:
        word, marker, colour = PLACES[place.kind]
        at = place.at * solid.length.factor
        solid.axes.plot(*at[:, None], marker, color=colour, markersize=8)
        solid.used.setdefault(word, Line2D([], [], linestyle="none", marker=marker, color=colour))
        if place.kind in ("inlet", "well", "probe"):
            solid.note(at, f"  {place.label}", colour)


def draw_stress(solid: Solid) -> None:
    for axis, figure in solid.setup.stress:
        along = np.eye(3)[axis]
        tail = 0.5 * (solid.low + solid.high)
        tail[axis] = solid.high[axis] + 0.3 * solid.size
        solid.arrow(tail, -0.22 * solid.size * along, STRESS)
        solid.note(tail, f" {figure}", STRESS)
    if solid.setup.stress:
        solid.used[solid.setup.stress_name] = Line2D([], [], color=STRESS, linewidth=2, marker=">")


def draw_solid(axes: Axes3D, setup: Setup) -> None:
    solid = Solid(axes, setup)
    if setup.radius is not None:
        draw_ball(solid)
    elif setup.has_body:
        solid.frame(solid.low, solid.high, colors=INK, linewidths=1.2)
        if len(setup.points):
            axes.plot(*(setup.points * solid.length.factor).T, ".", color=FAINT, markersize=1)
    draw_holes(solid)
    draw_boxes(solid)
    for condition in setup.conditions:
        draw_condition(solid, condition)
    for name, facets in setup.cracks.items():
        axes.add_collection3d(Poly3DCollection(list(facets * solid.length.factor), facecolors=INK, alpha=0.75))
        below = np.array([0.0, 0.0, 0.06 * solid.size])
        solid.note(facets[-1].mean(axis=0) * solid.length.factor - below, f"  {name}")
        solid.used.setdefault("crack", patches.Patch(facecolor=INK, alpha=0.75))
    draw_places(solid)
    draw_stress(solid)
    if setup.gravity is not None:
        solid.arrow(solid.low + 0.0, 0.2 * solid.size * setup.gravity / np.linalg.norm(setup.gravity), FAINT)
        solid.note(solid.low, "g ")
    axes.set(xlim=(solid.low[0], solid.high[0]), ylim=(solid.low[1], solid.high[1]), zlim=(solid.low[2], solid.high[2]),
             xlabel=f"x [{solid.length.unit}]", ylabel=f"y [{solid.length.unit}]", zlabel=f"z [{solid.length.unit}]")  # fmt: skip
    axes.set_box_aspect(np.maximum(solid.high - solid.low, 0.05 * solid.size), zoom=0.85)
    for axis, edge in zip("xyz", solid.high - solid.low):
        axes.locator_params(axis=axis, nbins=6 if edge > 0.6 * solid.size else 3)
    axes.view_init(elev=22, azim=-55)
    axes.legend(solid.used.values(), solid.used.keys(), loc="upper left", bbox_to_anchor=(-0.2, 1.0))

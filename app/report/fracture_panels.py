"""Panels about a fracture in 2D: the rock around it, the fluid in it and beside it, and where the fluid went."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import h5py
import matplotlib
import matplotlib.patheffects as effects
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D

from crack_paths import Paths, crack_paths, neighbours
from frames import spacing
from quantities import Display, display_for, quantity
from run import Run

INK, FAINT = "#1c2733", "#5b6875"
FLUID = matplotlib.colormaps["plasma"]
PORES = matplotlib.colormaps["YlGnBu"]
STRESS = matplotlib.colormaps["RdBu_r"]
# Okabe and Ito's colours, distinct to every kind of colour vision.
SHARES = {"notch": "#56B4E9", "crack": "#D55E00", "by_crack": "#009E73", "by_notch": "#CC79A7"}
THINNEST, WIDEST = 1.0, 5.0  # lines of closed and widest facets [points]
DASHES = ("-", "--", ":", "-.")  # of one crack after another
LOWEST_OPENING = 0.01  # of the widest: below it a facet is drawn as closed
Panel = Callable[[Axes], None]


@dataclass(frozen=True)
class PointSet:
    points: np.ndarray  # (count, 2) [m]
    fields: dict[str, np.ndarray]


@dataclass(frozen=True)
class Fracture:
    """The last frame that all of its point sets have."""

    time: float
    rock: PointSet
    crack: PointSet
    fluid: PointSet | None
    pairs: np.ndarray  # (count, 2): facets of the crack that are neighbours

    @property
    def opening(self) -> np.ndarray:
        return self.crack.fields["crack_opening"]

    @property
    def pressure(self) -> np.ndarray | None:
        return self.crack.fields.get("crack_pressure")

    @property
    def slip(self) -> np.ndarray | None:
        """How far the faces of each facet have slid, either way; None without friction."""
        return np.abs(self.crack.fields["crack_slip"]) if "crack_slip" in self.crack.fields else None

    @property
    def is_wet(self) -> np.ndarray:
        """Facets whose pressure says something: those that hold fluid, though they be closed."""
        wetted = self.crack.fields.get("crack_wetted_fraction")
        return self.is_open if wetted is None else wetted > 0.0

    @property
    def length(self) -> Display:
        """How places are shown: the window's largest coordinate decides."""
        return display_for("m", float(np.abs(window(self)).max()))

    @property
    def is_open(self) -> np.ndarray:
        return self.opening > LOWEST_OPENING * max(float(self.opening.max(initial=0.0)), 1e-12)


def read_points(path: Path) -> PointSet:
    with h5py.File(path, "r") as file:
        group = file["VTKHDF"]
        fields = {name: data[()].astype(float) for name, data in group["PointData"].items()}
        return PointSet(group["Points"][()][:, :2].astype(float), fields)


def last_frame(run: Run, name: str) -> PointSet | None:
    files = sorted((run.folder / "frames").glob(f"{name}_*.hdf"))
    try:
        return read_points(files[-1]) if files else None
    except (OSError, KeyError):  # a run that was killed; the other pictures say so
        return None


def read_fracture(run: Run) -> Fracture | None:
    """None where a run is not in 2D, or has no cracks or no rock around them."""
    found = {s.name: s for s in run.series}
    if "body" not in found or "crack" not in found or found["body"].cut.at is not None:
        return None
    rock, crack, fluid = (last_frame(run, name) for name in ("body", "crack", "fluid"))
    if rock is None or crack is None or "crack_opening" not in crack.fields or len(crack.points) < 2:
        return None
    return Fracture(found["body"].frames[-1].time, rock, crack, fluid, neighbours(crack.points))


def principal_stress(stress: np.ndarray) -> np.ndarray:
    """The largest, tension positive, of tensors whose rows are xx, xy, yx, yy."""
    mean, half = 0.5 * (stress[:, 0] + stress[:, 3]), 0.5 * (stress[:, 0] - stress[:, 3])
    return mean + np.hypot(half, 0.5 * (stress[:, 1] + stress[:, 2]))


def window(fracture: Fracture) -> tuple[np.ndarray, np.ndarray]:
    """What the maps show: cracks and free fluid with as much rock around as they are long, a third wider than high."""
    shown = [fracture.crack.points] + ([fracture.fluid.points] if fracture.fluid is not None else [])
    points = np.concatenate(shown)
    low, high = points.min(axis=0), points.max(axis=0)
    edge = 0.5 * spacing(fracture.rock.points)
    body_low, body_high = fracture.rock.points.min(axis=0) - edge, fracture.rock.points.max(axis=0) + edge
    around = 0.3 * float((high - low).max())
    low, high = np.maximum(low - around, body_low), np.minimum(high + around, body_high)
    missing = max(0.0, 1.3 * (high[1] - low[1]) - (high[0] - low[0]))
    low[0], high[0] = max(low[0] - 0.5 * missing, body_low[0]), min(high[0] + 0.5 * missing, body_high[0])
    return low, high


def draw_rock(axes: Axes, fracture: Fracture, values: np.ndarray, factor: float, colours, limits) -> PolyCollection:
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    low, high = window(fracture)
    edge = spacing(fracture.rock.points)
    inside = np.all((fracture.rock.points > low - edge) & (fracture.rock.points < high + edge), axis=1)
    tiles = fracture.length.factor * (fracture.rock.points[inside, None, :] + edge * corners)
    squares = PolyCollection(list(tiles), array=factor * values[inside], cmap=colours, edgecolors="face",
                             linewidths=0.3, rasterized=True)  # fmt: skip
    squares.set_clim(*limits)
    axes.add_collection(squares)
    shown = fracture.length
    axes.set(xlim=shown.factor * np.array([low[0], high[0]]), ylim=shown.factor * np.array([low[1], high[1]]))
    axes.set_aspect("equal", anchor="NW")
    axes.grid(False)
    axes.set(xlabel=f"x [{shown.unit}]", ylabel=f"y [{shown.unit}]")
    return squares


def draw_cracks(axes: Axes, fracture: Fracture, colour_of=None) -> None:
    """Lines as wide as the crack is open, on a scale of their own; what is closed is dotted."""
    pairs = fracture.pairs
    if len(pairs) == 0:
        return
    lines = fracture.length.factor * fracture.crack.points[pairs]
    is_open = fracture.is_open[pairs].all(axis=1)
    closed = LineCollection(list(lines[~is_open]), colors=INK, linewidths=THINNEST, linestyles=(0, (1, 1)), zorder=4)
    axes.add_collection(closed)
    widest = max(float(fracture.opening.max()), 1e-12)
    widths = THINNEST + (WIDEST - THINNEST) * fracture.opening[pairs].mean(axis=1)[is_open] / widest
    colours = INK if colour_of is None else colour_of(pairs[is_open])
    outline = [effects.Stroke(linewidth=WIDEST + 1.0, foreground="white"), effects.Normal()]
    opened = LineCollection(list(lines[is_open]), colors=colours, linewidths=widths, capstyle="round", zorder=5)
    opened.set_path_effects(outline if colour_of is not None else [])
    axes.add_collection(opened)


def draw_bar(axes: Axes, drawn, at: float, label: str) -> None:
    bar = axes.figure.colorbar(drawn, cax=axes.inset_axes((at, 0.0, 0.03, 1.0)))
    bar.outline.set_visible(False)
    bar.ax.grid(False)
    bar.ax.ticklabel_format(useOffset=False)
    bar.ax.tick_params(labelsize=8)
    bar.set_label(label, fontsize=8, labelpad=2)


def time_of(fracture: Fracture) -> str:
    return f"t = {quantity(fracture.time, 's')}"


def pore_panel(fracture: Fracture) -> Panel:
    """Pore pressure in the rock, and that of the fluid in notch and crack."""

    def draw(axes: Axes) -> None:
        pores = fracture.rock.fields["pore_pressure"]
        pore = display_for("Pa", float(np.abs(pores).max()))
        least, most = (float(np.quantile(pores, part)) for part in (0.01, 0.995))
        if most - least < 1e-3 * abs(most):  # the same everywhere
            least = min(0.0, least)
        rock = draw_rock(axes, fracture, pores, pore.factor, PORES, (pore.factor * least, pore.factor * most))
        inside = [fracture.pressure[fracture.is_open]] if fracture.pressure is not None else []
        free = fracture.fluid.fields.get("fluid_pressure") if fracture.fluid is not None else None
        highest = max((float(v.max(initial=0.0)) for v in [*inside, *([free] if free is not None else [])]), default=0.0)
        fluid = display_for("Pa", highest)
        norm = matplotlib.colors.Normalize(0.0, fluid.factor * highest or 1.0)

        def colours(pairs: np.ndarray) -> np.ndarray:
            return FLUID(norm(fluid.factor * fracture.pressure[pairs].mean(axis=1)))

        draw_cracks(axes, fracture, colours if inside else None)
        if free is not None:
            axes.scatter(*(fracture.length.factor * fracture.fluid.points.T), c=fluid.factor * free, cmap=FLUID, norm=norm, s=9,
                         edgecolors="white", linewidths=0.3, zorder=6)  # fmt: skip
        axes.set_title(f"Pressure in pores{', notch' if free is not None else ''} and crack at {time_of(fracture)}")
        draw_bar(axes, rock, 1.02, f"in the pores [{pore.unit}]")
        if free is not None or fracture.is_open.any():  # what is closed is dotted
            draw_bar(axes, matplotlib.cm.ScalarMappable(norm, FLUID), 1.26, f"notch and crack [{fluid.unit}]")

    return draw


def stress_panel(fracture: Fracture) -> Panel:
    """The largest principal effective stress, white where it is what it is in most of the rock that is
    shown; the outermost per cent is cut off, for tips are sharp."""

    def draw(axes: Axes) -> None:
        stress = principal_stress(fracture.rock.fields["effective_stress"])
        low, high = window(fracture)
        seen = np.all((fracture.rock.points > low) & (fracture.rock.points < high), axis=1)
        least, usual, most = np.quantile(stress[seen], [0.01, 0.5, 0.99])
        away = max(usual - least, most - usual)
        shown = display_for("Pa", max(abs(usual - away), abs(usual + away)))
        limits = (shown.factor * (usual - away), shown.factor * (usual + away))
        rock = draw_rock(axes, fracture, stress, shown.factor, STRESS, limits)
        draw_cracks(axes, fracture)
        axes.set_title(f"Largest principal effective stress at {time_of(fracture)}")
        draw_bar(axes, rock, 1.02, f"tension positive [{shown.unit}]")
        handles = [Line2D([], [], color=INK, linewidth=THINNEST, linestyle=(0, (1, 1)), label="closed")]
        if fracture.is_open.any():
            widest = quantity(float(fracture.opening.max()), "m", 3)
            handles.insert(0, Line2D([], [], color=INK, linewidth=WIDEST, label=f"open crack, at most {widest}"))
        axes.legend(handles=handles, loc="lower left", frameon=True, framealpha=0.85, edgecolor="none", handlelength=1.4)

    return draw


def draw_along(axes: Axes, paths: Paths, shown: np.ndarray, x: np.ndarray, y: np.ndarray, **style) -> None:
    """A line for every branch, of those of its facets that are shown."""
    for branch in range(int(paths.branch.max()) + 1):
        members = np.flatnonzero((paths.branch == branch) & shown)
        members = members[np.argsort(x[members])]
        axes.plot(x[members], y[members], linestyle=DASHES[branch % len(DASHES)], markersize=3, linewidth=1.2, **style)


def along_panel(fracture: Fracture, paths: Paths) -> Panel:
    """Opening, or where all is closed and faces slid their slip, and pressure along the cracks, each counted from its
    oldest facet."""

    def draw(axes: Axes) -> None:
        slides = fracture.slip is not None and not fracture.is_open.any()
        apart, shown = (fracture.slip, np.ones(len(fracture.opening), bool)) if slides else (fracture.opening, fracture.is_open)
        seen = paths.along[shown]
        length = display_for("m", float(np.abs(seen).max(initial=0.0)))
        width = display_for("m", float(apart.max()))
        draw_along(axes, paths, shown, length.factor * paths.along, width.factor * apart, color="#0072B2", marker="o")
        cracks, wings = int(paths.branch.max()) + 1, seen.min(initial=0.0) < 0
        begun = "where it began" if wings else "its mouth"
        axes.set(title=f"Along the crack{'s' if cracks > 1 else ''} at {time_of(fracture)}", xlabel=f"from {begun} [{length.unit}]")
        axes.set_ylabel(f"{'slip' if slides else 'opening'} [{width.unit}]", color="#0072B2")
        axes.set_ylim(bottom=0)
        if 1 < cracks <= len(DASHES):
            axes.legend(handles=[Line2D([], [], color=INK, linestyle=dash, label=f"crack {n + 1}")
                                 for n, dash in enumerate(DASHES[:cracks])])  # fmt: skip
        if fracture.pressure is None:
            return
        beside = axes.twinx()
        pressure = display_for("Pa", float(np.abs(fracture.pressure).max()))
        borne = shown & fracture.is_wet if slides else shown
        draw_along(beside, paths, borne, length.factor * paths.along, pressure.factor * fracture.pressure, color="#D55E00", marker="s")
        beside.set_ylabel(f"pressure [{pressure.unit}]", color="#D55E00")
        beside.grid(False)
        beside.spines["right"].set_visible(True)
        beside.set_ylim(bottom=min(0.0, beside.get_ylim()[0]))

    return draw


def share_columns(run: Run) -> list[tuple[str, str, np.ndarray]]:
    """What there is of free fluid (since the start), in the crack, and what passed into the pores by each of both."""
    known = {column.name: column.values for column in run.history.columns}
    shares = []
    if "free_fluid_mass" in known:
        shares.append(("notch", "more in the notch", known["free_fluid_mass"] - known["free_fluid_mass"][0]))
    if "crack_fluid_stored_mass" in known:
        shares.append(("crack", "in the crack", known["crack_fluid_stored_mass"]))
    by_crack = known.get("exchanged_mass_from_crack_fluid")
    if by_crack is not None:
        shares.append(("by_crack", "in the pores, from the crack", by_crack))
    if "exchanged_mass_from_fluid" in known:
        shares.append(("by_notch", "in the pores, through the notch's walls", known["exchanged_mass_from_fluid"]))
    return shares


def shares_panel(run: Run) -> Panel | None:
    """Where the fluid that was brought in is; None where it is all in one place."""
    shares = share_columns(run)
    if len(shares) < 3:
        return None

    def draw(axes: Axes) -> None:
        time = display_for("s", float(run.history.time[-1]))
        x = time.factor * run.history.time
        axes.stackplot(x, [1e3 * np.nan_to_num(values) for _, _, values in shares], colors=[SHARES[key] for key, _, _ in shares],
                       labels=[label for _, label, _ in shares], alpha=0.85, linewidth=0)  # fmt: skip
        axes.set(title="Where the water is that the pump brought", xlabel=f"time [{time.unit}]", ylabel="mass [g/m]",
                 xlim=(x[0], x[-1]))  # fmt: skip
        handles, labels = axes.get_legend_handles_labels()
        axes.legend(handles[::-1], labels[::-1], loc="upper left", handlelength=1.2)

    return draw


def fracture_panels(run: Run) -> list[Panel]:
    """Maps first; empty where the run has no fracture in 2D to draw."""
    fracture = read_fracture(run)
    if fracture is None:
        return []
    panels = []
    if "pore_pressure" in fracture.rock.fields:
        panels.append(pore_panel(fracture))
    if fracture.rock.fields.get("effective_stress", np.zeros(0)).ndim == 2:
        panels.append(stress_panel(fracture))
    if not panels:
        return []
    if (paths := crack_paths(fracture.crack.points)) is not None:
        panels.append(along_panel(fracture, paths))
    shares = shares_panel(run)
    return panels + ([shares] if shares else [])

"""report.png: the run at a glance, 2000 x 1500 pixels, legible at half that width."""

from __future__ import annotations

from pathlib import Path
from typing import Callable

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from charts import Chart, Series, all_charts, start_of_change, telling_range, time_label
from fracture_panels import fracture_panels
from frames import Field, Frame, FrameSeries
from quantities import described, display_for, quantity, sentence, words
from run import Run

INCHES, DOTS_PER_INCH = (10.0, 7.5), 200
COLOUR_MAP = matplotlib.colormaps["viridis"].with_extremes(bad="#c9cfd6")  # grey: the quantity is not there
ARROWS_ACROSS = 24
# Okabe and Ito's colours, distinct to every kind of colour vision.
PALETTE = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#5D5D5D"]
INK, FAINT = "#1c2733", "#5b6875"
MOST_MARKERS = 26
LONGEST_LINE = 150  # characters across the picture
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlepad": 7,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e3e7eb",
    "grid.linewidth": 0.7,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "text.color": INK,
    "legend.fontsize": 8,
    "legend.frameon": False,
}
Panel = Callable[[Axes], None]


def colours(chart: Chart) -> list:
    count = len(chart.groups)
    if chart.ordered:
        return list(COLOUR_MAP(np.linspace(0.05, 0.85, max(count, 2))))
    return [PALETTE[i % len(PALETTE)] for i in range(count)]


def marker_places(series: Series, chart: Chart) -> np.ndarray:
    """Few enough markers to be told apart, evenly spaced along the axis as drawn."""
    usable = np.isfinite(series.x) & np.isfinite(series.y)
    if chart.log_x:
        usable &= series.x > start_of_change(chart) / 10
    places = np.flatnonzero(usable)
    if len(places) <= MOST_MARKERS:
        return places
    along = np.log(series.x[places]) if chart.log_x else series.x[places]
    wanted = np.linspace(along[0], along[-1], MOST_MARKERS)
    return np.unique(places[np.abs(along[:, None] - wanted).argmin(axis=0)])


def draw_series(axes: Axes, chart: Chart, series: Series, colour) -> None:
    x, y = series.x * chart.x.display.factor, series.y * chart.y.display.factor
    if not series.markers:
        axes.plot(x, y, color=colour, linewidth=1.4, zorder=2)
        return
    at = marker_places(series, chart)
    line = "-" if chart.kind == "error" else "none"
    face = colour if chart.kind == "error" else "white"
    axes.plot(x[at], y[at], linestyle=line, marker="o", markersize=4, color=colour, linewidth=1.0,
              markerfacecolor=face, markeredgewidth=1.1, zorder=3)  # fmt: skip


def draw_legend(axes: Axes, chart: Chart, palette: list) -> None:
    handles = [Line2D([], [], color=c, linewidth=2, label=g) for c, g in zip(palette, chart.groups)]
    if chart.kind in ("comparison", "profile"):
        handles += [
            Line2D([], [], color=FAINT, linewidth=1.4, label=chart.reference),
            Line2D([], [], color=FAINT, linestyle="none", marker="o", markersize=4, markerfacecolor="white",
                   label="computed"),  # fmt: skip
        ]
    # Profiles fill their panel from edge to edge: their legend stands beside it.
    beside = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)} if chart.ordered else {"loc": "best"}
    if len(handles) > 1:
        axes.legend(handles=handles, handlelength=1.5, labelspacing=0.35, **beside)


def annotate_peak(axes: Axes, chart: Chart) -> None:
    """The largest computed value, where it rises above both ends of its curve (Mandel-Cryer)."""
    computed = [s for s in chart.series if s.markers]
    top = max(computed, key=lambda s: np.nanmax(s.y), default=None)
    if top is None:
        return
    known = top.y[np.isfinite(top.y)]
    if known.max() <= 1.02 * max(known[0], known[-1]):
        return
    at = int(np.nanargmax(top.y))
    text = f"peak {top.y[at] * chart.y.display.factor:.4g} {chart.y.display.unit} at {time_label(top.x[at])}"
    place = (top.x[at] * chart.x.display.factor, top.y[at] * chart.y.display.factor)
    axes.annotate(text, place, xytext=(0, 9), textcoords="offset points", ha="center", va="bottom", fontsize=8,
                  arrowprops={"arrowstyle": "-", "color": FAINT, "linewidth": 0.7, "shrinkB": 3})  # fmt: skip


def set_scales(axes: Axes, chart: Chart) -> None:
    if chart.log_x:
        axes.set_xscale("log")
        start = start_of_change(chart) * chart.x.display.factor / 10
        axes.set_xlim(left=max(start, axes.get_xlim()[0]) or None)
    if chart.log_y:
        axes.set_yscale("log")
    elif reach := telling_range(chart):
        axes.set_ylim(*reach)
    elif min(np.nanmin(s.y) for s in chart.series) >= 0:
        axes.set_ylim(0, 1.12 * axes.get_ylim()[1])


def chart_panel(chart: Chart) -> Panel:
    def draw(axes: Axes) -> None:
        palette = colours(chart)
        for series in chart.series:
            draw_series(axes, chart, series, palette[series.group])
        axes.set(title=chart.title, xlabel=chart.x.label, ylabel=chart.y.label)
        set_scales(axes, chart)
        if chart.kind == "comparison":
            annotate_peak(axes, chart)
        draw_legend(axes, chart, palette)

    return draw


def tiles(frame: Frame) -> np.ndarray:
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    return frame.points[:, None, :] + frame.edges[:, None, None] * corners


def draw_arrows(axes: Axes, series: FrameSeries, frame: Frame, factor: float) -> str:
    """Velocities at a few points, evenly spread; says how fast the longest is."""
    fields = {field.name: field.values for field in frame.fields}
    velocity = [fields[name] for name in series.velocity]
    speed = np.hypot(*velocity) if velocity else np.zeros(0)
    fastest = float(np.nanmax(speed, initial=0.0))
    if fastest == 0.0:
        return ""
    known = np.flatnonzero(speed > 0.01 * fastest)
    cells = np.floor(frame.points[known] / (np.ptp(frame.points, axis=0).max() / ARROWS_ACROSS))
    at = known[np.unique(cells, axis=0, return_index=True)[1]]
    x, y = factor * frame.points[at].T
    u, v = (component[at] for component in velocity)
    axes.quiver(x, y, u, v, scale=fastest * ARROWS_ACROSS / 2, scale_units="width", width=0.003, color=INK)
    return f"; longest arrow {quantity(fastest, 'm/s', 3)}"


def map_panel(series: FrameSeries, frame: Frame, field: Field) -> Panel:
    def draw(axes: Axes) -> None:
        known = np.ma.masked_invalid(field.values)
        length = display_for("m", float(np.abs(frame.points).max(initial=0.0)))
        shown = display_for(field.unit, float(np.abs(known).max()) if known.count() else 0.0)
        squares = PolyCollection(list(tiles(frame) * length.factor), array=known * shown.factor,
                                 cmap=COLOUR_MAP, edgecolors="face", linewidths=0.4, rasterized=True)  # fmt: skip
        squares.autoscale_None()
        axes.add_collection(squares)
        axes.autoscale_view()
        # A column a few points wide is drawn wider than it is: its map is about the other direction.
        width, height = np.maximum(np.ptp(frame.points, axis=0), frame.edges.max())
        axes.set_aspect("equal" if 1 / 6 < width / height < 6 else "auto", anchor="N")
        arrows = draw_arrows(axes, series, frame, length.factor)
        lowest, highest = squares.get_clim()
        if highest - lowest < 1e-9 * max(abs(lowest), abs(highest)):  # round-off is not a pattern
            squares.set_clim(*sorted((0.999 * lowest, 1.001 * highest)))
        axes.grid(False)
        across, up = series.cut.names
        at = f", {series.cut.note(3)}" if series.cut.note() else ""
        axes.set(title=f"{sentence(words(field.name))} at t = {time_label(frame.time)}",
                 xlabel=f"{across} [{length.unit}]{at}{arrows}", ylabel=f"{up} [{length.unit}]")  # fmt: skip
        # An inset follows the map's own box, which the equal aspect makes smaller than its cell.
        bar = axes.figure.colorbar(squares, cax=axes.inset_axes((1.04, 0.0, 0.035, 1.0)))
        bar.outline.set_visible(False)
        bar.ax.grid(False)
        bar.ax.ticklabel_format(useOffset=False)
        bar.set_label(f"[{shown.unit}]" if shown.unit else "")

    return draw


def field_rank(field: Field) -> int:
    """Pressure tells most, and how wide a crack is; where they are missing, damage, displacement and velocity."""
    telling = ("pressure", "opening", "damage", "displacement (magnitude)", "velocity (magnitude)")
    return next((i for i, word in enumerate(telling) if word in field.name), len(telling))


def map_panels(run: Run, count: int) -> list[Panel]:
    """Of the last frame; of all points together where there are several sets."""
    found = [(series, series.frames[-1], field) for series in run.series[:1] for field in series.frames[-1].fields]
    found.sort(key=lambda entry: field_rank(entry[2]))
    return [map_panel(*entry) for entry in found[:count]]


def panels(run: Run) -> list[Panel]:
    """At most four: against a reference where there is one, then of a fracture, else curves and maps of the run itself."""
    charts = all_charts(run)
    chosen = [c for kind in ("comparison", "profile", "error") for c in [c for c in charts if c.kind == kind][:1]]
    of_fracture = fracture_panels(run)
    if of_fracture:
        shown = [chart_panel(chart) for chart in chosen] + of_fracture[: 4 - len(chosen)]
        return shown + [chart_panel(c) for c in charts if c.kind == "history"][: 4 - len(shown)]
    chosen += [c for c in charts if c.kind == "history"][: max(0, 2 - len(chosen))]
    return [chart_panel(chart) for chart in chosen] + map_panels(run, 4 - len(chosen))


def facts(run: Run) -> str:
    parts = [run.outcome] + [f"{described(v)} {words(k)}" for k, v in run.counts.items()]
    if "wall_time" in run.summary:
        parts.append(f"{quantity(run.summary['wall_time'], 's', 3)} wall time")
    return "  ·  ".join(parts)


def verdict(run: Run) -> str:
    """Why the run failed, or the largest errors, in one line."""
    if run.failure:
        error = run.failure["error"]
        return error if len(error) <= LONGEST_LINE else error[: LONGEST_LINE - 1] + "…"
    errors = run.reference.get("quantities", [])
    largest = [(words(e["name"]).split(" over the exact")[0], quantity(e["max_error"], e.get("unit", ""), 2)) for e in errors]
    return "  ·  ".join(f"{name}: max error {error}" for name, error in largest)


def draw_header(figure: Figure, run: Run) -> None:
    figure.text(0.012, 0.985, run.title, fontsize=14, fontweight="bold", va="top", parse_math=False)
    figure.text(0.012, 0.945, facts(run), fontsize=8.5, color=FAINT, va="top", parse_math=False)
    figure.text(0.012, 0.920, verdict(run), fontsize=8.5, color=INK, va="top", parse_math=False)


def write_picture(run: Run, path: Path) -> None:
    chosen = panels(run)
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=INCHES, dpi=DOTS_PER_INCH)
        figure.set_layout_engine("constrained", rect=(0.005, 0.005, 0.99, 0.89), hspace=0.06, wspace=0.05)
        draw_header(figure, run)
        columns = min(len(chosen), 2)
        rows = (len(chosen) + 1) // 2
        for place, draw in enumerate(chosen):
            draw(figure.add_subplot(rows, columns, place + 1))
        figure.savefig(path)
        plt.close(figure)

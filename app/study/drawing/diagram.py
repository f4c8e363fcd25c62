"""study.png and study.svg: error against cost, and what they follow."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from picture import FAINT, PALETTE, STYLE
from study_data import Curve, Study

INCHES, DOTS_PER_INCH = (10.0, 4.6), 160
MARKERS = "osD^vP*hX"
LINES = ["-", "--", ":", "-."]
MOST_LABELS = 26


def look(curve: Curve) -> dict:
    return {"color": PALETTE[curve.colour % len(PALETTE)], "linestyle": LINES[curve.style % len(LINES)],
            "marker": MARKERS[curve.style % len(MARKERS)]}  # fmt: skip


def draw_curve(axes: Axes, study: Study, curve: Curve, x: list[float], y: list[float]) -> None:
    style = look(curve)
    axes.plot(x, y, label=curve.label, linewidth=1.2, markersize=5, markerfacecolor="white",
              markeredgewidth=1.2, zorder=3, **(style if study.line_axis else style | {"linestyle": "none"}))  # fmt: skip


def fill_front(axes: Axes, study: Study, curve: Curve) -> None:
    """Filled: no other variant is both cheaper and better."""
    best = [v for v in curve.variants if v["name"] in study.front]
    axes.plot([v["cost"]["median"] for v in best], [v["error"] for v in best], linestyle="none", markersize=5,
              marker=look(curve)["marker"], color=look(curve)["color"], zorder=4)  # fmt: skip


def draw_fronts(axes: Axes, study: Study) -> None:
    by_name = {v["name"]: v for v in study.variants}
    for ranking in study.data["rankings"]:
        front = [by_name[name] for name in ranking["front"]]
        axes.step([v["cost"]["median"] for v in front], [v["error"] for v in front], where="post",
                  color="#c3cad2", linewidth=3.5, zorder=1, solid_capstyle="round")  # fmt: skip


def draw_unranked(axes: Axes, study: Study) -> None:
    """At the upper edge, at the time that they took."""
    shown = [v for v in study.unranked if v["cost"]["median"] > 0]
    for place, variant in enumerate(shown):
        x = variant["cost"]["median"]
        axes.plot([x], [0.97], marker="x", color="#a63a00", transform=axes.get_xaxis_transform(), markersize=6)
        if len(shown) <= 8:
            status = variant["status"] if variant["status"] != "done" else "no error"
            axes.annotate(f"{variant['name']}: {status}", (x, 0.97), xycoords=axes.get_xaxis_transform(),
                          xytext=(5, -8 * (place % 3) - 2), textcoords="offset points", fontsize=6,
                          color="#a63a00")  # fmt: skip
    never = [v["name"] for v in study.unranked if not v["cost"]["median"]]
    if never:
        axes.text(0.01, 1.005, "never ran: " + ", ".join(never[:4]) + (" ..." if len(never) > 4 else ""), fontsize=6,
                  color="#a63a00", transform=axes.transAxes)  # fmt: skip


def label_points(axes: Axes, study: Study) -> None:
    along = study.line_axis
    if len(study.ranked) > MOST_LABELS:
        return
    for variant in study.ranked:
        text = variant["choice"][along] if along else variant["name"]
        axes.annotate(text, (variant["cost"]["median"], variant["error"]), xytext=(4, 4),
                      textcoords="offset points", fontsize=6, color=FAINT)  # fmt: skip


def draw_precision(axes: Axes, study: Study) -> None:
    draw_fronts(axes, study)
    for curve in study.curves(study.line_axis):
        ranked = [v for v in curve.variants if v["error"] is not None]
        if not ranked:
            continue
        x, y = [v["cost"]["median"] for v in ranked], [v["error"] for v in ranked]
        spread = np.array([[v["cost"]["median"] - v["cost"]["least"] for v in ranked],
                           [v["cost"]["most"] - v["cost"]["median"] for v in ranked]])  # fmt: skip
        axes.errorbar(x, y, xerr=spread, fmt="none", ecolor=look(curve)["color"], elinewidth=0.8, alpha=0.6)
        draw_curve(axes, study, curve, x, y)
        fill_front(axes, study, curve)
    for accuracy in study.data["accuracies"]:
        axes.axhline(accuracy, color="#d5dae0", linewidth=0.7, linestyle=(0, (4, 4)), zorder=0)
    axes.set(title="Error against cost", xlabel=study.cost_label, ylabel=study.error_label)
    set_logarithmic(axes, study)
    label_points(axes, study)
    draw_unranked(axes, study)


def set_logarithmic(axes: Axes, study: Study) -> None:
    if any(v["cost"]["median"] > 0 for v in study.variants):
        axes.set_xscale("log")
    if any(v["error"] > 0 for v in study.ranked):
        axes.set_yscale("log", nonpositive="clip")
        low, high = axes.get_ylim()
        axes.set_ylim(low, high * (high / low) ** 0.12)  # room for those without an error


def with_unit(study: Study, axis: str) -> str:
    unit = study.axes[axis]["unit"]
    return f"{axis} [{unit}]" if unit else axis


def draw_side(axes: Axes, study: Study) -> None:
    """Over a problem that varies, what it costs; over the fineness, the error and its order."""
    axis = study.side_axis
    problem = study.axes[axis]["problem"]
    orders = study.orders(axis)
    for curve in study.curves(axis):
        shown = [v for v in curve.variants if v["error"] is not None]
        if not shown:
            continue
        y = [v["cost"]["median"] if problem else v["error"] for v in shown]
        order = orders.get(curve.label, {}).get("cost" if problem else "error")
        named = Curve(curve.label + (f": power {order:.1f}" if order is not None else ""), curve.colour,
                      curve.style, curve.variants)  # fmt: skip
        draw_curve(axes, study, named, [study.number(v, axis) for v in shown], y)
    for crossing in study.data["crossings"]:
        if crossing["axis"] == axis and problem:
            for place in crossing["places"]:
                axes.axvline(place, color=FAINT, linewidth=0.8, linestyle=":")
                axes.annotate(f"{place:.2g}", (place, 0.02), xycoords=axes.get_xaxis_transform(), fontsize=7,
                              xytext=(3, 0), textcoords="offset points", color=FAINT)  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log", nonpositive="clip")
    places = study.axes[axis]["numbers"]
    axes.set_xticks(places, [f"{place:g}" for place in places], fontsize=7 if len(places) > 6 else None)
    axes.xaxis.set_minor_locator(NullLocator())
    ylabel = study.cost_label if problem else study.error_label
    axes.set(title="Cost" if problem else "Order", xlabel=with_unit(study, axis), ylabel=ylabel)
    draw_legend(axes)


def draw_legend(axes: Axes) -> None:
    """Many curves get a legend of their own room, above them."""
    count = len(axes.get_legend_handles_labels()[0])
    if count <= 8:
        axes.legend(loc="best", fontsize=7)
        return
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * (high / low) ** 0.45)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.94), fontsize=5.5, ncols=2, labelspacing=0.25)


def subtitle(study: Study) -> str:
    machine = next(iter(study.data["machines"]), {})
    parts = [study.data["scene"], machine.get("processor", ""), f"{len(study.variants)} variants"]
    jobs = study.data["jobs"]
    return "  ·  ".join(part for part in parts + ([f"{jobs} at a time"] if jobs > 1 else []) if part)


def write_picture(study: Study, path: Path) -> None:
    with plt.rc_context(STYLE | {"svg.hashsalt": "perifrac", "svg.fonttype": "none"}):
        figure = plt.figure(figsize=INCHES, dpi=DOTS_PER_INCH)
        figure.set_layout_engine("constrained", rect=(0.005, 0.005, 0.99, 0.89), wspace=0.06)
        figure.text(0.012, 0.985, study.data["title"], fontsize=13, fontweight="bold", va="top", parse_math=False)
        figure.text(0.012, 0.925, subtitle(study), fontsize=8, color=FAINT, va="top", parse_math=False)
        panels = 2 if study.side_axis and study.ranked else 1
        left = figure.add_subplot(1, panels, 1)
        draw_precision(left, study)
        if panels == 2:
            draw_side(figure.add_subplot(1, 2, 2), study)
        if study.ranked and (panels == 1 or study.side_axis != study.line_axis or len(left.lines) == 0):
            draw_legend(left)
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
        plt.close(figure)

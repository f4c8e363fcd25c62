"""report.html: one page that holds everything it needs, and fetches nothing."""

from __future__ import annotations

import base64
import json
from html import escape
from pathlib import Path
from string import Template
from typing import Any

import matplotlib
import numpy as np

import tables
from charts import Axis, Chart, all_charts, start_of_change, time_label
from frames import Frame, FrameSeries
from quantities import display_for, pretty_unit, quantity, sentence, words
from run import Run

HERE = Path(__file__).resolve().parent
COLOUR_MAP = "viridis"


def encoded(values: np.ndarray) -> str:
    """32-bit floats, little-endian, base64: half the size of the digits, and enough to look at."""
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def plain(values: np.ndarray) -> list[float | None]:
    """JSON knows no NaN."""
    return [float(v) if np.isfinite(v) else None for v in values]


def axis_data(axis: Axis) -> dict[str, Any]:
    return {"label": axis.label, "factor": axis.display.factor, "unit": axis.display.unit}


def chart_data(chart: Chart) -> dict[str, Any]:
    return {
        "title": chart.title,
        "kind": chart.kind,
        "x": axis_data(chart.x),
        "y": axis_data(chart.y),
        "logX": chart.log_x,
        "logY": chart.log_y,
        "start": start_of_change(chart) / 10 if chart.log_x else 0.0,
        "ordered": chart.ordered,
        "groups": len(chart.groups),
        "series": [
            {"label": s.label, "x": plain(s.x), "y": plain(s.y), "group": s.group, "markers": s.markers}
            for s in chart.series
        ],
    }  # fmt: skip


def field_data(series: FrameSeries) -> list[dict[str, Any]]:
    """Names, display units and the range over all frames, so that colours compare between times."""
    described = []
    for field in series.frames[-1].fields:
        arrays = [f.values for frame in series.frames for f in frame.fields if f.name == field.name]
        finite = np.concatenate([a[np.isfinite(a)] for a in arrays])
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
        shown = display_for(field.unit, max(abs(low), abs(high)))
        described.append({"name": field.name, "label": words(field.name), "unit": shown.unit,
                          "factor": shown.factor, "low": low, "high": high})  # fmt: skip
    return described


def frame_data(frame: Frame, before: Frame | None) -> dict[str, Any]:
    """Points are written only where they differ from the frame before: most bodies keep theirs."""
    data: dict[str, Any] = {
        "time": frame.time,
        "label": time_label(frame.time),
        "values": {field.name: encoded(field.values) for field in frame.fields},
    }
    if before is None or not np.array_equal(before.points, frame.points):
        x, y = frame.points.T
        data["points"] = {"x": encoded(x), "y": encoded(y), "edge": encoded(frame.edges)}
    return data


def series_data(series: FrameSeries) -> dict[str, Any]:
    frames = series.frames
    largest = max(float(np.abs(frame.points).max(initial=0.0)) for frame in frames)
    length = display_for("m", largest)
    note = f"{sentence(series.cut.note())}. " if series.cut.note() else ""
    if series.available > len(frames):
        note += f"{len(frames)} of {series.available} frames, evenly chosen."
    return {
        "name": series.name,
        "note": note,
        "axes": series.cut.names,
        "length": {"factor": length.factor, "unit": pretty_unit(length.unit)},
        "velocity": series.velocity,
        "fields": field_data(series),
        "frames": [frame_data(f, b) for f, b in zip(frames, [None, *frames[:-1]])],
    }


def run_data(run: Run) -> dict[str, Any]:
    colours = matplotlib.colormaps[COLOUR_MAP](np.linspace(0, 1, 256))[:, :3]
    return {
        "charts": [chart_data(chart) for chart in all_charts(run)],
        "series": [series_data(series) for series in run.series],
        "colours": [[round(255 * c) for c in rgb] for rgb in colours.tolist()],
    }


def embedded(data: dict[str, Any]) -> str:
    """JSON inside a script element must not spell that element's end."""
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def chart_sections(charts: list[dict[str, Any]]) -> str:
    def figures(*kinds: str) -> list[str]:
        return [f'<div class="chart" data-chart="{i}"></div>' for i, c in enumerate(charts) if c["kind"] in kinds]

    compared = tables.section("comparison", "Computed and exact", *figures("comparison", "profile", "error"))
    return compared + tables.section("histories", "Histories", *figures("history"))


def page_parts(run: Run, data: dict[str, Any]) -> dict[str, str]:
    reference = run.reference
    title = reference.get("title", reference.get("type", "the exact solution"))
    return {
        "title": escape(run.title),
        "outcome": escape(run.outcome),
        "facts": tables.facts(run),
        "effects": tables.effects(run),
        "failure": tables.section("failure", "Why it failed", tables.failure(run)),
        "warnings": tables.section("warnings", "Warnings", tables.warnings(run)),
        "errors": tables.section("errors", sentence(f"errors against {title}"),
                                 tables.error_summary(reference), tables.error_table(reference)),  # fmt: skip
        "charts": chart_sections(data["charts"]),
        "map_hidden": "" if data["series"] else "hidden",
        "ledger": tables.section("ledger", "Ledger", tables.ledger(run)),
        "cost": tables.section("cost", "Cost by module", tables.cost(run)),
        "scene": tables.section("scene", "Scene and build", tables.scene(run)),
        "data": embedded(data),
    }


def file_parts() -> dict[str, str]:
    files = {
        "uplot_licence": "assets/uPlot.LICENSE",
        "uplot_style": "assets/uPlot.min.css",
        "uplot_script": "assets/uPlot.iife.min.js",
        "style": "report.css",
        "chart_script": "chart.js",
        "map_script": "point_map.js",
        "report_script": "report.js",
    }
    return {name: (HERE / path).read_text(encoding="utf-8") for name, path in files.items()}


def write_page(run: Run, path: Path) -> None:
    template = Template((HERE / "report.html").read_text(encoding="utf-8"))
    path.write_text(template.substitute(page_parts(run, run_data(run)) | file_parts()), encoding="utf-8")

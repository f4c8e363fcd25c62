"""study.html: one page that holds everything it needs, and fetches nothing."""

from __future__ import annotations

from html import escape
from pathlib import Path
from string import Template
from typing import Any

from page import embedded
from quantities import quantity
from study_data import Study

HERE = Path(__file__).resolve().parent
REPORT = HERE.parents[1] / "report"


def point(study: Study, variant: dict[str, Any]) -> dict[str, Any]:
    """What hovering tells of a variant."""
    modules = variant["modules"]
    work = [f"{m['name']}: {quantity(m['wall_time'], 's', 3)} wall, {quantity(m['cpu_time'], 's', 3)} CPU"
            + "".join(f", {value:g} {name.replace('_', ' ')}" for name, value in m["statistics"].items())
            for m in modules]  # fmt: skip
    spread = variant["cost"]
    lines = [f"{quantity(spread['median'], 's', 3)} ({quantity(spread['least'], 's', 3)} to "
             f"{quantity(spread['most'], 's', 3)}, {variant['runs']} runs)",
             f"CPU {quantity(variant['cpu_time'], 's', 3)}, output {quantity(variant['output_time'], 's', 3)}, "
             f"memory {quantity(variant['peak_memory'], 'B', 3)}"]  # fmt: skip
    error = variant["error"]
    head = variant["status"] if error is None else f"error {error:.2e}"
    return {"name": variant["name"], "x": spread["median"], "least": spread["least"], "most": spread["most"],
            "y": error, "best": variant["name"] in study.front,
            "lines": [head, *([variant["message"] or variant["why_no_error"]] if error is None else []),
                      *lines, *work]}  # fmt: skip


def precision(study: Study) -> dict[str, Any]:
    return {"title": "Error against cost", "xLabel": study.cost_label, "yLabel": study.error_label,
            "curves": [{"label": c.label, "colour": c.colour, "style": c.style, "joined": bool(study.line_axis),
                        "points": [point(study, v) for v in c.variants if v["cost"]["median"] > 0]}
                       for c in study.curves(study.line_axis)],
            "fronts": [[{"x": v["cost"]["median"], "y": v["error"]} for name in ranking["front"]
                        for v in study.variants if v["name"] == name] for ranking in study.data["rankings"]]}  # fmt: skip


def side(study: Study) -> dict[str, Any] | None:
    axis = study.side_axis
    if axis is None:
        return None
    problem = study.axes[axis]["problem"]
    unit = study.axes[axis]["unit"]
    curves = []
    for curve in study.curves(axis):
        points = []
        for variant in curve.variants:
            drawn = point(study, variant)
            y = drawn["x"] if problem else drawn["y"]
            if variant["error"] is not None:
                x = study.number(variant, axis)
                points.append(drawn | {"x": x, "least": x, "most": x, "y": y})
        curves.append({"label": curve.label, "colour": curve.colour, "style": curve.style, "joined": True,
                       "points": points})  # fmt: skip
    return {"title": "Cost" if problem else "Order", "xLabel": f"{axis} [{unit}]" if unit else axis,
            "yLabel": study.cost_label if problem else study.error_label, "curves": curves, "fronts": []}  # fmt: skip


def table(study: Study) -> str:
    axes = list(study.axes)
    names = [*axes, "status", "error", "cost", "CPU", "memory", "of its wall time in output"]
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    rows = []
    for v in sorted(study.variants, key=lambda v: (v["error"] is None, v["cost"]["median"])):
        share = v["output_time"] / v["wall_time"]["median"] if v["wall_time"]["median"] else 0.0
        cells = [*(v["choice"][a] for a in axes), v["status"],
                 f"{v['error']:.2e}" if v["error"] is not None else v["message"] or v["why_no_error"],
                 quantity(v["cost"]["median"], "s", 3), quantity(v["cpu_time"], "s", 3),
                 quantity(v["peak_memory"], "B", 3), f"{100 * share:.0f} %"]  # fmt: skip
        mark = ' class="best"' if v["name"] in study.front else ""
        rows.append(f"<tr{mark}>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in cells) + "</tr>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def facts(study: Study) -> str:
    entries = []
    for kind in ("machines", "builds"):
        for found in study.data[kind]:
            entries += [(name, f"{value:.3g}" if isinstance(value, float) else value) for name, value in found.items()]
    entries += [("perifrac", study.data["version"]), ("variants at a time", study.data["jobs"])]
    if study.data["launcher"]:
        entries.append(("launcher", " ".join(study.data["launcher"])))
    return "".join(f"<tr><th>{escape(name)}</th><td>{escape(str(value))}</td></tr>" for name, value in entries)


def write_page(study: Study, path: Path) -> None:
    charts = [chart for chart in (precision(study), side(study)) if chart]
    parts = {
        "title": escape(study.data["title"]),
        "study": escape(study.data["study"]),
        "sentences": "".join(f"<li>{escape(text)}</li>" for text in study.data["sentences"]),
        "table": table(study),
        "facts": facts(study),
        "data": embedded({"charts": charts}),
        "uplot_licence": (REPORT / "assets/uPlot.LICENSE").read_text(encoding="utf-8"),
        "uplot_style": (REPORT / "assets/uPlot.min.css").read_text(encoding="utf-8"),
        "uplot_script": (REPORT / "assets/uPlot.iife.min.js").read_text(encoding="utf-8"),
        "style": (REPORT / "report.css").read_text(encoding="utf-8"),
        "study_style": (HERE / "study.css").read_text(encoding="utf-8"),
        "study_script": (HERE / "study.js").read_text(encoding="utf-8"),
    }
    template = Template((HERE / "study.html").read_text(encoding="utf-8"))
    path.write_text(template.substitute(parts), encoding="utf-8")

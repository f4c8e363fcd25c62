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
from matplotlib.colors import to_hex

import setup
import tables
from charts import Chart, all_charts
from curves import chart_data, leading
from field_data import fields_data
from quantities import sentence
from reference_words import curve_word, heading
from run import Run

HERE = Path(__file__).resolve().parent
PALETTES = {"sequential": "viridis", "diverging": "RdBu_r", "crack": "inferno"}
SCRIPTS = ["chart.js", "chunks.js", "map_axes.js", "field_frames.js", "field_map.js", "solid_view.js", "along_charts.js", "fields.js"]
LARGEST_PAGE = 3_000_000  # [bytes]
OF_THE_PAGE = 250_000  # [bytes] for scripts, style and tables


def palettes() -> dict[str, list[str]]:
    return {use: [to_hex(rgb) for rgb in matplotlib.colormaps[name](np.linspace(0, 1, 256))]
            for use, name in PALETTES.items()}  # fmt: skip


def embedded(data: dict[str, Any]) -> str:
    """JSON inside a script element must not spell that element's end."""
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def run_fields(run: Run, budget: int) -> dict[str, Any]:
    fields, chunks = fields_data(run.folder / "frames", budget)
    return {"title": run.title, "fields": fields, "chunks": [base64.b64encode(one).decode("ascii") for one in chunks.packed]}


def page_data(charts: list[Chart], runs: list[Run]) -> dict[str, Any]:
    drawn = [chart_data(chart) for chart in charts]
    budget = (LARGEST_PAGE - OF_THE_PAGE - len(embedded({"charts": drawn}))) // len(runs)
    return {"charts": drawn, "palettes": palettes(), "runs": [run_fields(run, max(budget, 200_000)) for run in runs]}


def figure(place: int) -> str:
    return f'<div class="chart" data-chart="{place}"></div>'


def chart_sections(charts: list[Chart], reference: dict[str, Any], shown: list[int]) -> str:
    def figures(*kinds: str) -> list[str]:
        return [figure(i) for i, chart in enumerate(charts) if chart.kind in kinds and i not in shown]

    def grid(kinds: tuple[str, ...]) -> str:
        found = "".join(figures(*kinds))
        return f'<div class="charts">{found}</div>' if found else ""

    compared = tables.section("comparison", f"Computed and {curve_word(reference)}", grid(("comparison", "profile", "error")))
    return compared + tables.section("histories", "Histories", grid(("history",)))


def fields_fragment() -> str:
    return (HERE / "fields.html").read_text(encoding="utf-8")


def fields_section(has_fields: bool, charts: list[int]) -> str:
    """The picture: fields, and beside them what tells most of the run's course."""
    beside = "".join(figure(i) for i in charts)
    if not has_fields:
        return tables.section("course", "Course", beside)
    beside = f'<div class="beside">{beside}</div>' if beside else ""
    return tables.section("fields", "Fields", f'<div class="hero">{fields_fragment()}{beside}</div>')


def header(run: Run) -> str:
    return (
        f'<p class="kicker">perifrac report <span class="outcome" data-outcome="{escape(run.outcome)}">{escape(run.outcome)}</span></p>\n'
        f"<h1>{escape(run.title)}</h1>\n"
        f'<ul class="effects" aria-label="effects that are on">{tables.effects(run)}</ul>\n'
        f'<dl class="facts">{tables.facts(run)}</dl>'
    )


def page_parts(run: Run) -> dict[str, str]:
    reference = run.reference
    charts = all_charts(run)
    shown = leading(charts)
    data = page_data(charts, [run])
    return {
        "title": escape(run.title),
        "width": "",
        "header": header(run),
        "failure": tables.section("failure", "Why it failed", tables.failure(run)),
        "fields": fields_section(bool(data["runs"][0]["fields"]), shown),
        "errors": tables.section("errors", sentence(heading(reference)),
                                 tables.error_summary(reference), tables.error_table(reference)),  # fmt: skip
        "charts": chart_sections(charts, reference, shown),
        "warnings": tables.section("warnings", "Warnings", tables.warnings(run)),
        "setup": setup.setup(run),
        "ledger": tables.section("ledger", "Ledger", tables.ledger(run)),
        "cost": tables.section("cost", "Cost by module", tables.cost(run)),
        "reproduce": setup.reproduce(run),
        "data": embedded(data),
    }


def file_parts(last_script: str) -> dict[str, str]:
    """Style and scripts; the last script says what the page does with them."""
    def text(path: str) -> str:
        return (HERE / path).read_text(encoding="utf-8")

    scripts = [text(name) for name in (*SCRIPTS, last_script)]
    return {
        "uplot_licence": text("assets/uPlot.LICENSE"),
        "uplot_style": text("assets/uPlot.min.css"),
        "uplot_script": text("assets/uPlot.iife.min.js"),
        "style": text("report.css"),
        "script": "\n".join(script.replace('"use strict";\n', "", i > 0) for i, script in enumerate(scripts)),
    }  # fmt: skip


def write_parts(parts: dict[str, str], path: Path) -> None:
    template = Template((HERE / "report.html").read_text(encoding="utf-8"))
    path.write_text(template.substitute(parts | file_parts("report.js")), encoding="utf-8")


def write_page(run: Run, path: Path) -> None:
    write_parts(page_parts(run), path)

"""Two runs side by side: what was put in differently, and what came out."""

from __future__ import annotations

from dataclasses import replace
from html import escape
from pathlib import Path
from typing import Any

import setup
import tables
from charts import Chart, history_charts
from curves import chart_data, leading
from page import LARGEST_PAGE, OF_THE_PAGE, embedded, fields_fragment, figure, palettes, run_fields, write_parts
from quantities import described, quantity, words
from run import Run

NAMES = "AB"


def merged_charts(first: Run, second: Run) -> list[Chart]:
    """Histories of one unit in one chart, A's curves and B's by the same colours."""
    others = {(chart.y.display.unit.lstrip("pnµmkMGT"), chart.title): chart for chart in history_charts(second)}
    merged = []
    for chart in history_charts(first):
        other = others.pop((chart.y.display.unit.lstrip("pnµmkMGT"), chart.title), None)
        merged.append(together(chart, other))
    return merged + [together(None, chart) for chart in others.values()]


def together(first: Chart | None, second: Chart | None) -> Chart:
    base = first or second
    assert base is not None
    groups = list(dict.fromkeys(label for chart in (first, second) if chart for label in chart.groups))
    series = [
        replace(s, label=f"{NAMES[place]}: {s.label}", group=groups.index(s.label))
        for place, chart in enumerate((first, second)) if chart for s in chart.series
    ]  # fmt: skip
    return replace(base, series=series, groups=groups)


def drawn(chart: Chart) -> dict[str, Any]:
    data = chart_data(chart)
    for series in data["series"]:
        series["dashed"] = series["label"].startswith(f"{NAMES[1]}:")
    return data


def beside(first: dict[str, str], second: dict[str, str], only_different: bool = False) -> list[list[str]]:
    rows = [[name, first.get(name, "–"), second.get(name, "–")] for name in dict.fromkeys([*first, *second])]
    return [row for row in rows if not only_different or row[1] != row[2]]


def inputs_table(first: Run, second: Run) -> str:
    rows = beside(dict(setup.inputs(first)), dict(setup.inputs(second)), only_different=True)
    if rows:
        return tables.table(["input", "A", "B"], rows)
    return "<p>Their scenes say the same.</p>" if setup.inputs(first) and setup.inputs(second) else ""


def outcome_of(run: Run) -> dict[str, str]:
    summary = run.summary
    found = {"outcome": run.outcome}
    if isinstance(summary.get("time"), dict):
        found["time reached"] = described(summary["time"])
    found |= {words(name): described(count) for name, count in run.counts.items()}
    for name, unit in (("wall_time", "s"), ("cpu_time", "s"), ("peak_memory", "B")):
        if name in summary:
            found[words(name)] = quantity(summary[name], unit, 3)
    for module in summary.get("modules", []):
        found[f"wall time of {words(module['name'])}"] = quantity(module["wall_time"], "s", 3)
    for error in run.reference.get("quantities", []):
        found[f"max error of {words(error['name'])}"] = quantity(error["max_error"], error.get("unit", ""), 3)
    return found


def errors_at_end(run: Run) -> dict[str, str]:
    table = run.reference.get("table", [])
    if not table:
        return {}
    return {f"{words(name)} at the end": described(value, 3) for name, value in table[-1].items()
            if name not in ("time", "dimensionless_time")}  # fmt: skip


def ledger_of(run: Run) -> dict[str, str]:
    return {words(name): described(value) for name, value in run.summary.get("ledger", {}).items()}


def header(runs: list[Run]) -> str:
    lines = "".join(
        f'<p><strong>{name}</strong> <span class="outcome" data-outcome="{escape(run.outcome)}">{escape(run.outcome)}</span> '
        f"{escape(run.title)} <span class=\"note\">{escape(str(run.folder))}</span></p>"
        for name, run in zip(NAMES, runs)
    )
    return f'<p class="kicker">perifrac report, two runs</p>\n<h1>{escape(title(runs))}</h1>\n{lines}'


def title(runs: list[Run]) -> str:
    titles = list(dict.fromkeys(run.title for run in runs))
    return titles[0] if len(titles) == 1 else " and ".join(titles)


def parts(runs: list[Run]) -> dict[str, str]:
    charts = merged_charts(*runs)
    first = leading(charts)
    charts = [charts[i] for i in first] + [chart for i, chart in enumerate(charts) if i not in first]
    data: dict[str, Any] = {"charts": [drawn(chart) for chart in charts], "palettes": palettes()}
    budget = (LARGEST_PAGE - OF_THE_PAGE - len(embedded(data))) // 2
    data["runs"] = [run_fields(run, budget) for run in runs]
    fragments = "".join(f"<div><h3>{name}</h3>{fields_fragment()}</div>" if run["fields"] else f"<div><h3>{name}</h3><p>No frames.</p></div>"
                        for name, run in zip(NAMES, data["runs"]))  # fmt: skip
    curves = "".join(figure(i) for i in range(len(charts)))
    note = '<p class="note">A by whole lines, B by dashed ones.</p>'
    has_fields = any(run["fields"] for run in data["runs"])
    return {
        "title": escape(title(runs)),
        "width": "wide",
        "header": header(runs),
        "failure": "",
        "fields": tables.section("inputs", "Put in differently", inputs_table(*runs))
        + tables.section("fields", "Fields", f'<div class="pair">{fragments}</div>' if has_fields else ""),
        "charts": tables.section("histories", "Histories", note, f'<div class="charts">{curves}</div>') if curves else "",
        "warnings": "".join(tables.section(f"warnings-{name}", f"Warnings of {name}", tables.warnings(run))
                            for name, run in zip(NAMES, runs)),
        "errors": tables.section("outcome", "What came of it", tables.table(["", "A", "B"], beside(
            *({**outcome_of(run), **errors_at_end(run)} for run in runs)))),
        "setup": "",
        "ledger": tables.section("ledger", "Ledger", tables.table(["entry", "A", "B"], beside(*map(ledger_of, runs)))
                                 if any(map(ledger_of, runs)) else ""),
        "cost": "",
        "reproduce": tables.section("reproduce", "How to reproduce", *(
            f'<p class="note">{name}</p><pre tabindex="0">{escape(setup.command(run))}</pre>'
            for name, run in zip(NAMES, runs) if run.summary.get("scene", {}).get("path"))),
        "data": embedded(data),
    }  # fmt: skip


def write_comparison(first: Run, second: Run) -> Path:
    """Writes the page into the first run's folder and returns its path."""
    path = first.folder / f"compared_with_{second.folder.resolve().name}.html"
    write_parts(parts([first, second]), path)
    return path

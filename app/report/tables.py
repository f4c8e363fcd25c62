"""The parts of the page that need no script: facts and tables, as HTML."""

from __future__ import annotations

from html import escape
from typing import Any, Iterable

from charts import error_columns, time_label
from quantities import described, number, quantity, words
from reference_words import curve_word
from run import Run

Row = list[str]


def cells(tag: str, row: Row) -> str:
    """The first cell names the row, the others are figures."""
    first, *others = row
    head = f'<th scope="{"col" if tag == "th" else "row"}">{escape(first)}</th>'
    scope = ' scope="col"' if tag == "th" else ""
    return "<tr>" + head + "".join(f"<{tag}{scope}>{escape(c)}</{tag}>" for c in others) + "</tr>"


def table(header: Row, rows: Iterable[Row], caption: str = "") -> str:
    body = "\n".join(cells("td", row) for row in rows)
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    head = f"<thead>{cells('th', header)}</thead>"
    return f'<div class="scroll"><table>{title}{head}<tbody>{body}</tbody></table></div>'


def section(key: str, title: str, *content: str) -> str:
    """Empty without content: a run that lacks something does not show its heading."""
    inside = "\n".join(part for part in content if part)
    if not inside:
        return ""
    heading = f'<h2 id="{key}-title">{escape(title)}</h2>'
    return f'<section id="{key}" aria-labelledby="{key}-title">{heading}\n{inside}</section>'


def facts(run: Run) -> str:
    summary = run.summary
    known = [(words(name), described(value)) for name, value in run.counts.items()]
    if "dimension" in summary:
        known.insert(0, ("dimension", f"{summary['dimension']}D"))
    if "wall_time" in summary:
        known.append(("wall time", quantity(summary["wall_time"], "s", 3)))
    if "peak_memory" in summary:
        known.append(("peak memory", quantity(summary["peak_memory"], "B", 3)))
    return "".join(f"<div><dt>{escape(n)}</dt><dd>{escape(v)}</dd></div>" for n, v in known)


def failure(run: Run) -> str:
    """What went wrong, where and when, and what to change."""
    known = run.failure
    if not known:
        return ""
    rows = [[name, described(known[name])] for name in ("field", "place", "time") if name in known]
    advice = f'<p>To change: {escape(known["advice"])}.</p>' if known.get("advice") else ""
    return f'<p class="error" role="alert">{escape(known["error"])}</p>' + advice + (table(["what", "value"], rows) if rows else "")


def warnings(run: Run) -> str:
    items = "".join(f"<li>{escape(warning)}</li>" for warning in run.warnings)
    return f'<ul class="warnings">{items}</ul>' if items else ""


def effects(run: Run) -> str:
    return "".join(f"<li>{escape(words(effect))}</li>" for effect in run.summary.get("effects", []))


def where(at: dict[str, Any]) -> str:
    return ", ".join(f"{words(name)} = {described(value)}" for name, value in at.items())


def error_summary(reference: dict[str, Any]) -> str:
    entries = reference.get("quantities", [])
    values = [key for key in ("computed", "exact") if any(key in entry for entry in entries)]
    rows = []
    for entry in entries:
        error = quantity(entry["max_error"], entry.get("unit", ""), 3)
        shown = [described(entry[key], 6) if key in entry else "" for key in values]
        rows.append([words(entry["name"]), *shown, error, where(entry.get("at", {}))])
    names = {"computed": "computed", "exact": curve_word(reference)}
    return table(["quantity", *(names[key] for key in values), "max error", "at"], rows) if rows else ""


def error_table(reference: dict[str, Any]) -> str:
    lines = reference.get("table", [])
    if not lines:
        return ""
    columns = error_columns(lines)
    dimensionless = any("dimensionless_time" in line for line in lines)
    header = ["time"] + ["dimensionless time"] * dimensionless + [words(c) for c in columns]
    rows = []
    for line in lines:
        row = [time_label(line["time"])]
        if dimensionless:
            row.append(number(line["dimensionless_time"]) if "dimensionless_time" in line else "")
        rows.append(row + [number(line[c], 3) if line.get(c) is not None else "" for c in columns])
    return table(header, rows)


def ledger(run: Run) -> str:
    rows = [[words(name), described(value)] for name, value in run.summary.get("ledger", {}).items()]
    return table(["entry", "value"], rows) if rows else ""


def cost(run: Run) -> str:
    modules = run.summary.get("modules", [])
    if not modules:
        return ""
    total = run.summary.get("wall_time") or sum(m["wall_time"] for m in modules)
    rows = []
    for module in modules:
        share = 100 * module["wall_time"] / total if total else 0.0
        statistics = "; ".join(f"{words(n)} {described(v)}" for n, v in module.get("statistics", {}).items())
        advances = described(module["advances"]) if "advances" in module else ""
        name = f"{words(module['name'])} ({words(module['type'])})" if "type" in module else words(module["name"])
        rows.append([name, quantity(module["wall_time"], "s", 3), f"{share:.0f} %", advances, statistics])
    return table(["module", "wall time", "share", "advances", "statistics"], rows)

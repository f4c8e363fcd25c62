"""References called what they are: a table from elsewhere, or an experiment, is no exact solution."""

from __future__ import annotations

from typing import Any

# By `reference.type`: one word for a curve, and what errors are against. Those not named are exact.
KINDS = {
    "table": ("table", "the table"),
    "dam_break": ("measured", "the experiment"),
    "kgd": ("solution", "the solution"),
    "radial": ("solution", "the solution"),
    "cantilever": ("beam theory", "beam theory"),
    "water_on_plate": ("beam theory", "beam theory"),
}


def curve_word(reference: dict[str, Any]) -> str:
    """`exact`, `table`, `measured`, ..."""
    return KINDS.get(reference.get("type", ""), ("exact", ""))[0]


def against(reference: dict[str, Any]) -> str:
    """`the exact solution`, `the table`, ..."""
    return KINDS.get(reference.get("type", ""), ("", "the exact solution"))[1]


def heading(reference: dict[str, Any]) -> str:
    """`errors against Mandel's analytic solution`, `errors against the table hf_storage_reference.csv`."""
    title = reference.get("title")
    if reference.get("type") == "table":
        return f"errors against the table {title}" if title else "errors against a table"
    return f"errors against {title or reference.get('type') or against(reference)}"

"""Charts as the page holds them: numbers of six digits, and of long histories what can be seen."""

from __future__ import annotations

from typing import Any

import numpy as np

from charts import Axis, Chart, Series, start_of_change, telling_range

MOST_POINTS = 1200  # of a curve; the widest chart has as many pixels
DIGITS = 6


def plain(values: np.ndarray) -> list[float | None]:
    """JSON knows no NaN."""
    return [float(f"{v:.{DIGITS}g}") if np.isfinite(v) else None for v in values]


def seen(series: Series) -> np.ndarray:
    """Places that show a curve as well as all of it: of each stretch its first, least and largest value."""
    count = len(series.y)
    if count <= MOST_POINTS:
        return np.arange(count)
    chosen = {0, count - 1}
    for stretch in np.array_split(np.arange(count), MOST_POINTS // 3):
        chosen.add(int(stretch[0]))
        known = stretch[np.isfinite(series.y[stretch])]
        if known.size:
            chosen |= {int(known[np.argmin(series.y[known])]), int(known[np.argmax(series.y[known])])}
    return np.array(sorted(chosen))


def axis_data(axis: Axis) -> dict[str, Any]:
    return {"label": axis.label, "factor": axis.display.factor, "unit": axis.display.unit}


def series_data(series: Series) -> dict[str, Any]:
    at = seen(series)
    return {"label": series.label, "x": plain(series.x[at]), "y": plain(series.y[at]), "group": series.group,
            "markers": series.markers}  # fmt: skip


def chart_data(chart: Chart) -> dict[str, Any]:
    reach = telling_range(chart)
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
        "series": [series_data(s) for s in chart.series],
        **({"yRange": reach} if reach else {}),
    }


def leading(charts: list[Chart]) -> list[int]:
    """The two that stand beside the fields: pressure at an inlet and length of a crack, else what comes first."""
    def score(chart: Chart) -> int:
        names = f"{chart.title} {' '.join(s.label for s in chart.series)}".lower()
        told = next((i for i, words in enumerate((("inlet", "pressure"), ("crack", "length"), ("front",), ("pressure",)))
                     if all(word in names for word in words)), 9)  # fmt: skip
        return 2 * told + (chart.kind != "comparison")

    over_time = [i for i, chart in enumerate(charts) if chart.kind in ("comparison", "history")]
    return sorted(over_time, key=lambda i: (score(charts[i]), i))[:2]

"""Which charts a run deserves. Picture and page draw the same ones, each with its own library."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Iterable

import numpy as np

from history import Column
from quantities import Display, display_for, sentence, words
from reference_words import against, curve_word
from run import Run


@dataclass(frozen=True)
class Axis:
    name: str
    display: Display

    @property
    def label(self) -> str:
        return f"{self.name} [{self.display.unit}]" if self.display.unit else self.name


@dataclass(frozen=True)
class Series:
    """One curve in SI; series of the same `group` share a colour."""

    label: str
    x: np.ndarray
    y: np.ndarray
    group: int
    markers: bool = False  # computed against an exact line


@dataclass(frozen=True)
class Chart:
    title: str
    x: Axis
    y: Axis
    series: list[Series]
    kind: str  # "comparison", "profile", "error" or "history"
    log_x: bool = False
    log_y: bool = False
    groups: list[str] = field(default_factory=list)
    reference: str = "exact"  # what the curves that markers lie over are called

    @property
    def ordered(self) -> bool:
        """Groups follow one another, as times do: so shall their colours."""
        return self.kind == "profile"


def array(values: Iterable[float | None]) -> np.ndarray:
    return np.array([np.nan if v is None else v for v in values], dtype=float)


def axis(name: str, unit: str, arrays: Iterable[np.ndarray]) -> Axis:
    largest = max((float(np.nanmax(np.abs(a))) for a in arrays if np.isfinite(a).any()), default=0.0)
    return Axis(words(name), display_for(unit, largest))


def spans_decades(times: np.ndarray) -> bool:
    """Whether times ask for a logarithmic axis: where all steps are alike, what happens is spread evenly."""
    positive = np.unique(times[times > 0])
    if positive.size < 3 or positive[-1] < 300 * positive[0]:
        return False
    steps = np.diff(positive)
    return bool(np.quantile(steps, 0.9) > 3 * steps[0])


def telling_range(chart: Chart) -> tuple[float, float] | None:
    """Of the axis, as displayed, where a reference leaves what is computed far behind, as pressure at time 0 does."""
    if chart.kind != "comparison":
        return None
    computed, others = (np.concatenate([s.y[np.isfinite(s.y)] for s in chart.series if s.markers == marked] or [np.empty(0)])
                        for marked in (True, False))  # fmt: skip
    if not computed.size or not others.size:
        return None
    low, high = float(computed.min()), float(computed.max())
    span = high - low or abs(high)
    if others.max() <= high + 2 * span and others.min() >= low - 2 * span:
        return None
    ends = max(float(others.min()), low - 0.3 * span), min(float(others.max()), high + 0.3 * span)
    return min(low, ends[0]) * chart.y.display.factor, max(high, ends[1]) * chart.y.display.factor


def place_of(name: str) -> tuple[str, str]:
    """`QUANTITY at PLACE` taken apart; a name without a place stands for itself."""
    quantity, _, place = name.partition(" at ")
    return quantity, place or words(name)


def start_of_change(chart: Chart) -> float:
    """When the first curve has moved by 1 % of its range: what lies long before it is a flat line."""
    moved = []
    for series in chart.series:
        usable = np.isfinite(series.y) & (series.x > 0)
        x, y = series.x[usable], series.y[usable]
        away = np.abs(y - y[0]) > 0.01 * np.ptp(y) if y.size else np.empty(0, dtype=bool)
        moved += [float(x[np.argmax(away)])] if away.any() else []
    return min(moved, default=0.0)


def comparison(label: str, x: np.ndarray, entry: dict[str, Any], group: int, word: str) -> list[Series]:
    """The curve of the reference first, so that the computed markers lie over it."""
    computed, exact = array(entry["computed"]), array(entry["exact"])
    return [
        Series(f"{label}, {word}", x, exact, group),
        Series(f"{label}, computed", x, computed, group, markers=True),
    ]


def reference_history_charts(reference: dict[str, Any]) -> list[Chart]:
    """`QUANTITY at PLACE`: one chart a quantity, one colour a place."""
    gathered: dict[tuple[str, str], list[tuple[str, dict[str, Any]]]] = {}
    for entry in reference.get("histories", []):
        name, place = place_of(entry["name"])
        gathered.setdefault((name, entry.get("unit", "")), []).append((place, entry))
    charts = []
    word = curve_word(reference)
    for (name, unit), entries in gathered.items():
        series = [s for i, (place, e) in enumerate(entries) for s in comparison(place, array(e["time"]), e, i, word)]
        time = np.concatenate([s.x for s in series])
        charts.append(
            Chart(
                f"{sentence(words(name))}: computed and {word}",
                axis("time", "s", [time]),
                axis(name, unit, [s.y for s in series if s.markers]),
                series,
                "comparison",
                log_x=spans_decades(time),
                groups=[place for place, _ in entries],
                reference=word,
            )
        )
    return charts


def profile_charts(reference: dict[str, Any]) -> list[Chart]:
    charts = []
    word = curve_word(reference)
    for profile in reference.get("profiles", []):
        times = array(profile["times"])
        shown = [time_label(t) for t in times]
        series: list[Series] = []
        for i, label in enumerate(shown):
            rows = {key: profile[key][i] for key in ("computed", "exact")}
            series += comparison(label, array(profile["x"][i]), rows, i, word)
        name, _, path = profile["name"].partition(" along ")
        charts.append(
            Chart(
                sentence(words(profile["name"])),
                axis(profile.get("x_name", path or "x"), profile.get("x_unit", "m"), [s.x for s in series]),
                axis(name, profile.get("unit", ""), [s.y for s in series]),
                series,
                "profile",
                groups=shown,
                reference=word,
            )
        )
    return charts


def time_label(time: float) -> str:
    shown = display_for("s", abs(time))
    return f"{time * shown.factor:.4g} {shown.unit}"


def error_columns(table: list[dict[str, Any]]) -> list[str]:
    return [key for key in table[0] if key not in ("time", "dimensionless_time")] if table else []


def error_charts(reference: dict[str, Any]) -> list[Chart]:
    """Errors of the table against time; a zero has no place on a logarithmic axis."""
    table = reference.get("table", [])
    series = []
    for i, column in enumerate(error_columns(table)):
        rows = [r for r in table if r.get(column) and r["time"] > 0]
        x, y = array(r["time"] for r in rows), array(abs(r[column]) for r in rows)
        series.append(Series(words(column), x, y, i, markers=True))
    series = [s for s in series if s.x.size]
    if not series:
        return []
    return [
        Chart(
            f"Error against {against(reference)}",
            axis("time", "s", [s.x for s in series]),
            Axis("relative error", Display(1.0, "")),
            series,
            "error",
            log_x=True,
            log_y=True,
            groups=[words(column) for column in error_columns(table)],
        )
    ]


def shared_words(columns: list[Column]) -> str:
    """Those that all names have, in the order of the first: `fluid mass` of stored and gained ones."""
    first, *others = [words(place_of(c.name)[0]).split() for c in columns]
    return " ".join(word for word in first if all(word in other for other in others))


# What columns are together that have but their unit in common.
OF_UNIT = {"m": "lengths", "m^2": "areas", "Pa": "pressures and stresses", "J": "energies", "J/m": "energies",
           "kg": "masses", "kg/m": "masses", "N": "forces", "N/m": "forces", "m/s": "velocities"}  # fmt: skip


def history_title(columns: list[Column]) -> str:
    """The quantity that all `columns` are of, else all their names, or what many have in common."""
    quantities = list(dict.fromkeys(place_of(c.name)[0] for c in columns))
    if len(quantities) <= 3:
        return words(", ".join(quantities))
    return shared_words(columns) or OF_UNIT.get(columns[0].unit, "several quantities")


def history_charts(run: Run) -> list[Chart]:
    """history.csv, one chart a unit, and one of openings, which beside lengths would be zero; counters (no unit) tell
    nothing as curves."""
    alike: dict[tuple[str, bool], list[Column]] = {}
    for column in run.history.columns:
        if column.unit and np.isfinite(column.values).any():
            alike.setdefault((column.unit, "opening" in column.name), []).append(column)
    charts = []
    time = run.history.time
    for (unit, _), columns in alike.items():
        title = history_title(columns)
        same = len({place_of(c.name)[0] for c in columns}) == 1
        names = [place_of(c.name)[1] if same else words(c.name) for c in columns]
        series = [Series(name, time, c.values, i) for i, (name, c) in enumerate(zip(names, columns))]
        label = title if same else shared_words(columns) or title
        x, y = axis("time", "s", [time]), axis(label, unit, [c.values for c in columns])
        charts.append(
            Chart(sentence(title), x, y, series, "history", log_x=spans_decades(time), groups=names)
        )
    return sorted(charts, key=is_level)  # what goes on comes first


def is_level(chart: Chart) -> bool:
    return all(np.nanmin(s.y) == np.nanmax(s.y) for s in chart.series)


def all_charts(run: Run) -> list[Chart]:
    """Those with something to show: a run that failed at once may have written empty curves."""
    reference = run.reference
    charts = [
        *reference_history_charts(reference),
        *profile_charts(reference),
        *error_charts(reference),
        *history_charts(run),
    ]
    drawable = [replace(c, series=[s for s in c.series if np.isfinite(s.y).any()]) for c in charts]
    return [chart for chart in drawable if chart.series]

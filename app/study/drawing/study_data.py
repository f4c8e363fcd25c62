"""A study as study.json tells of it, sorted into the curves that picture and page draw alike."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Curve:
    """Variants that differ on one axis only, in its order."""

    label: str
    colour: int  # by the value of the compared axis
    style: int  # by all other values
    variants: list[dict[str, Any]]


class Study:
    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.axes = {axis["name"]: axis for axis in data["axes"]}
        self.variants = [v for v in data["variants"] if v["choice"]]  # without the finer run
        self.front = {name for ranking in data["rankings"] for name in ranking["front"]}

    @property
    def ranked(self) -> list[dict[str, Any]]:
        return [v for v in self.variants if v["error"] is not None]

    @property
    def unranked(self) -> list[dict[str, Any]]:
        """Those that ran but have no error: drawn at the edge, so that none is missing."""
        return [v for v in self.variants if v["error"] is None]

    def numeric(self, problem: bool) -> str | None:
        names = [a["name"] for a in self.data["axes"] if a["numeric"] and a["problem"] == problem]
        return names[-1] if names else None

    @property
    def line_axis(self) -> str | None:
        """The axis along which points are joined: of those with numbers the innermost."""
        return self.numeric(problem=False) or self.numeric(problem=True)

    @property
    def side_axis(self) -> str | None:
        """What the second panel is drawn over: the problem where that varies, else the fineness."""
        return self.numeric(problem=True) or self.numeric(problem=False)

    def number(self, variant: dict[str, Any], axis: str) -> float:
        labels, numbers = self.axes[axis]["labels"], self.axes[axis]["numbers"]
        return numbers[labels.index(variant["choice"][axis])]

    def curves(self, along: str | None) -> list[Curve]:
        """All variants, those without an error too; without an axis to follow, one a compared value."""
        kept = [name for name in self.axes if name != along] if along else [self.data["compare"]]
        groups: dict[tuple, list] = {}
        for variant in self.variants:
            groups.setdefault(tuple(variant["choice"][name] for name in kept), []).append(variant)
        colours = self.axes[self.data["compare"]]["labels"]
        styles: list[tuple] = []
        curves = []
        for key, members in groups.items():
            values = dict(zip(kept, key))
            other = tuple(v for name, v in values.items() if name != self.data["compare"])
            if other not in styles:
                styles.append(other)
            compared = values.get(self.data["compare"])
            colour = colours.index(compared) if compared in colours else 0
            if along:
                members = sorted(members, key=lambda v: self.number(v, along))
            curves.append(Curve(", ".join(key) or along, colour, styles.index(other), members))
        return curves

    def orders(self, along: str) -> dict[str, dict[str, Any]]:
        """Observed orders by the label of their curve."""
        others = [name for name in self.axes if name != along]
        return {", ".join(o["others"][name] for name in others) or along: o
                for o in self.data["orders"] if o["axis"] == along}  # fmt: skip

    @property
    def cost_label(self) -> str:
        of, cpu = self.data["cost"]["of"], self.data["cost"]["time"] == "cpu"
        if of == "run":
            return "CPU time [s]" if cpu else "wall time without output [s]"
        return f"{'CPU' if cpu else 'wall'} time in {of.replace('_', ' ')} [s]"

    @property
    def error_label(self) -> str:
        error = self.data["error"]
        what = error.get("quantity", "difference of histories").replace("_", " ")
        start, end = error["from"], error["to"]
        if not start and end is None:
            times = ""
        elif end is None:
            times = f", from {start:g} s"
        else:
            times = f", {start:g} to {end:g} s"
        return f"{what} ({error['norm']}{times})"

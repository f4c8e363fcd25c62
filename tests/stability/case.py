"""What the stability suite says of one run, and how it is judged."""
import dataclasses
import typing

import numpy

MASS = ("mass error", 1e-12)


@dataclasses.dataclass(frozen=True)
class Figure:
    """A measured number that may be at most `limit`."""
    name: str
    value: float
    limit: float

    @property
    def holds(self):
        return bool(self.value <= self.limit)  # false of what is not a number

    def __str__(self):
        return f"{self.name} {self.value:.1e}" + ("" if self.holds else f" > {self.limit:g}")


@dataclasses.dataclass(frozen=True)
class Case:
    """One hard case in one combination of modules.

    `measure` gives the bounds and the accuracy of a run: two lists of figures. `known` says why a
    scheme that is there for comparison, or a limit of ours (`ours`), is expected to fail; `refused`
    is what a scene that the program cannot take is told.
    """
    group: str
    name: str
    modules: str
    scene: str
    settings: dict
    measure: typing.Callable
    known: str = ""
    ours: bool = False
    refused: str = ""
    fine: dict = None  # settings of a second run to compare with, which `measure` then gets too


@dataclasses.dataclass
class Outcome:
    case: Case
    bounds: list
    accuracy: list
    complaint: str = ""
    code: int = 0
    seconds: float = 0.0
    warned: bool = False

    @property
    def holds(self):
        figures = self.bounds + self.accuracy
        return self.code == 0 and bool(self.accuracy) and all(figure.holds for figure in figures)

    @property
    def as_expected(self):
        if self.case.refused:
            return self.code == 2 and self.case.refused in self.complaint
        if self.code not in (0, 1):
            return False
        return self.holds != bool(self.case.known)

    @property
    def symptom(self):
        if self.code != 0:
            return f"exit {self.code}: {self.complaint}"
        figures = ", ".join(str(figure) for figure in self.bounds + self.accuracy if not figure.holds)
        return figures + ("; the run warns" if self.warned else "; no warning")


def rise(values):
    """By how much of its first value what should fall rises at most from one to the next."""
    steps = numpy.diff(values)
    return max(0.0, float(steps.max(initial=0.0))) / max(abs(values[0]), 1e-300)


def zigzag(values, x, axis=1):
    """Part of a field that changes sign from point to point along each row of an axis: its product
    with (-1)^n over n points, without what is smooth (second differences once more), over the
    largest value."""
    order = numpy.lexsort((x[:, axis], x[:, 1 - axis]))
    rows = values[order].reshape(-1, len(numpy.unique(numpy.round(x[:, axis], 9))))
    second = rows[:, 2:] - 2.0 * rows[:, 1:-1] + rows[:, :-2]
    fourth = second[:, 2:] - 2.0 * second[:, 1:-1] + second[:, :-2]
    signs = (-1.0)**numpy.arange(fourth.shape[1])
    # A checkerboard of amplitude a has fourth differences of 16 a.
    amplitude = numpy.abs((fourth * signs).mean(axis=1)).max() / 16.0
    return float(amplitude / numpy.abs(values).max())

"""Physics of one's own in Python: slow, but through the contract that every module of the program keeps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from perifrac._perifrac import Body, Key, PointSet, Port, Section, State


@dataclass
class View:
    """What a port shows: arrays of `components * points` numbers, component by component.

    An input is, within the window, `value + rate (t - window end) + slope x`, x being what the module sends back
    over the coupled port; whoever carries `slope` must add it. Of an output, `slope` is d(output)/d(coupled input).
    `points`: None for the body's, of a total none.
    """

    value: np.ndarray | float
    rate: np.ndarray | None = None
    slope: np.ndarray | None = None
    forecast: np.ndarray | None = None
    points: PointSet | None = None


class Module:
    """To derive from. `core/module/physics_module.hpp` has the contract, docs/add_a_module.md explains it.

    Class attributes say what `ModuleType` says of a module of the program; `__init__` sets `ports`.
    """

    #: What stands in the list of modules.
    meaning: str = "A module written in Python."
    #: What its section of the scene may hold.
    keys: list[Key] = []
    #: Is refused in a scene without a body.
    needs_body: bool = True
    #: In an order that never changes.
    ports: list[Port]

    def __init__(self, section: Section, body: Body):
        """`section` is the scene's, in SI; `body` has positions [m] and volumes [m^3], in 2D [m^2]."""
        self.ports = []

    def port(self, name: str) -> np.ndarray | float | View:
        """The values of a port as they stand; to read them changes nothing. Arrays of float64 in one piece."""
        raise NotImplementedError

    def initialize(self, t: float) -> None:
        """Makes the state ready at time t [s]."""

    def connect(self, name: str) -> None:
        """Some module writes this in-port from now on: makes room for it."""

    def stable_time_step(self) -> float:
        """The longest stable step of its own [s]; infinity where implicit."""
        return math.inf

    def prepare(self, begin: float, end: float) -> None:
        """This window [s] is about to be tried."""

    def advance(self, begin: float, end: float) -> float:
        """Advances over the window [s] with steps of its own; returns the time reached. `begin == end` asks for the
        instant answer to a jump. Less than `end` is an event. Raises NumericalError."""
        raise NotImplementedError

    def wants_another_pass(self) -> bool:
        """What it does with its inputs is not settled yet."""
        return False

    def conclude(self, begin: float, end: float) -> float:
        """All modules agree: lets the window stand, or returns where it should end [s]."""
        return end

    def may_end_windows(self) -> bool:
        """Whether advance or conclude ever end a window early."""
        return True

    def path(self) -> str:
        """How its loops go over bonds, in words."""
        return ""

    def visit_state(self, state: State) -> None:
        """Shows everything that evolves, once each: `self.x = state.visit("x", self.x)`."""

    def on_restored(self, t: float) -> None:
        """The state was replaced: drop what was derived from the old one."""

"""Scenes that run in this process, window by window."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from perifrac import _perifrac
from perifrac.errors import ModuleError


@dataclass(frozen=True)
class PortInfo:
    """A port of a module: `module.name`, unit, and what else is fixed of it."""

    module: str
    name: str
    unit: str
    direction: str  # in, out
    kind: str  # intensive: a value at a point; extensive: a total over a window
    role: str  # field, property, mass_stored, ...
    components: int
    points: str  # the set that it lives on
    count: int  # of its points now
    linked: bool  # to another module


class _Fields(Mapping):
    """Fields by name, fetched anew each time."""

    def __init__(self, simulation: Simulation):
        self._simulation = simulation

    def _names(self) -> list[str]:
        return [p.name for p in self._simulation.ports() if p.direction == "out" and p.role == "field"]

    def __getitem__(self, name: str) -> np.ndarray:
        return self._simulation.port(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())


class _Given(MutableMapping):
    """What the simulation was asked to let Python give, by name."""

    def __init__(self, names: list[str], read: Callable, write: Callable):
        self._names, self._read, self._write = names, read, write

    def __getitem__(self, name: str) -> Any:
        return self._read(name)

    def __setitem__(self, name: str, value: Any) -> None:
        self._write(name, value)

    def __delitem__(self, name: str) -> None:
        raise TypeError("what was asked for stays until the simulation ends")

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


class Simulation(_perifrac.Simulation):
    """A scene, settled at t = 0, to be taken through time.

    scene: a Scene, a dictionary, or the path of a scene's file.
    output: folder for the files that the program leaves; None: nothing is written.
    inputs: in-ports that the scene leaves unlinked and Python writes, as `solid.interface_impulse`.
    loads: what the scene prescribes and Python changes on the way, by the path of what has a schedule, as
        `solid.boundary.top`, `crack_fluid.inlets[0]`.
    overwrite: files in `output` that no run wrote may be replaced.
    report: make the picture and the page at the end.

    Windows, rows, frames and restart points are those of the program, so that results are the same bit for bit; a
    `stop` of one's own, inputs and loads make others. One thread at a time may use it.
    """

    def __init__(self, scene: _perifrac.Scene | dict | str | os.PathLike, *, output: str | os.PathLike | None = None,
                 inputs: list[str] = (), loads: list[str] = (), overwrite: bool = False,
                 report: bool = False):  # fmt: skip
        if isinstance(scene, dict):
            scene = _perifrac.Scene(scene)
        elif not isinstance(scene, _perifrac.Scene):
            scene = _perifrac.Scene.from_file(os.fspath(scene))
        folder = "" if output is None else os.fspath(output)
        super().__init__(scene, folder, list(inputs), list(loads), overwrite, report)
        self.fields: Mapping[str, np.ndarray] = _Fields(self)
        #: Arrays to be written between windows; what is written stays until it is written again.
        self.inputs: MutableMapping[str, np.ndarray] = _Given(list(inputs), self._input, self._set_input)
        #: Factors [1] on what the scene prescribes; the next window begins with the instant answer to a new one.
        self.loads: MutableMapping[str, float] = _Given(list(loads), self._load, self._set_load)

    def _set_input(self, name: str, value: Any) -> None:
        self._input(name)[...] = value

    def advance(self, stop: float | None = None) -> bool:
        """One window, not past `stop` [s]. False where the end had been reached before."""
        return self._advance(stop)

    def advance_to(self, t: float) -> None:
        """Windows up to time t [s], or the scene's end."""
        while self.time < t and self._advance(t):
            pass

    def run(self, on_window: Callable[[Simulation], Any] | None = None) -> None:
        """To the end; `on_window(simulation)` is called after every window. What it raises ends the run as failed,
        Ctrl-C as stopped."""
        try:
            while self._advance():
                if on_window is not None:
                    self._call(on_window)
        except KeyboardInterrupt:
            self.close()
            raise

    def _call(self, callback: Callable[[Simulation], Any]) -> None:
        try:
            callback(self)
        except Exception as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            name = getattr(callback, "__qualname__", repr(callback))
            place = f"{os.path.basename(last.filename)}:{last.lineno}"
            line = f"{name} ({place}): {type(error).__name__}: {error}".replace("\n", " ")
            self._close(line)
            raise ModuleError(line) from error

    def close(self) -> None:
        """Ends it where it stands, as a signal ends the program: with a checkpoint and a summary where files are
        written. Nothing after the end."""
        self._close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def ports(self) -> list[PortInfo]:
        """All ports of all modules, in their order."""
        return [
            PortInfo(module, p.name, p.unit, p.direction, p.kind, p.role, p.components, points, count, linked)
            for module, p, points, count, linked in self._ports()
        ]

    def port(self, name: str, part: str = "value") -> np.ndarray:
        """A field by its name, any port as `module.name`: `(points,)` or `(points, components)`, in its unit.

        A read-only view without a copy, good until the simulation goes on; `.copy()` keeps it. `part` is value,
        rate, slope or forecast (docs/architecture.md); what is not carried is empty.
        """
        return self._port(name, part)

    def __repr__(self) -> str:
        return f"<Simulation t = {self.time:g} s of {self.end:g} s, {self.step} windows>"

"""What goes wrong, as exceptions; the text of each is the one line that the program would print."""


class Error(Exception):
    """Anything that perifrac raises."""


class SceneError(Error, ValueError):
    """A scene, or what a simulation is asked for, cannot be used: a line a mistake, with its place."""


class NumericalError(Error):
    """The run went wrong numerically. A module that raises one has its window tried again, half as long."""

    def __init__(self, problem: str, field: str = "state", place: str = "a module of Python", time: float = 0.0):
        super().__init__(problem)
        self.field = field  # what visit_state calls it
        self.place = place
        self.time = time  # [s]


class OutputError(Error, OSError):
    """A result cannot be written, or is gone."""


class ModuleError(Error, RuntimeError):
    """Code of one's own raised inside a run: the line names it, `__cause__` is what it raised."""

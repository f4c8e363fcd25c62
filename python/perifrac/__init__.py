"""Peridynamic simulation of porous rock and the fluid in it: scenes as objects, runs in the process, results as
arrays, and modules of one's own. docs/python.md begins with examples."""

from pathlib import Path as _Path

from perifrac._instructions import folder_of_extension
from perifrac.errors import Error, ModuleError, NumericalError, OutputError, SceneError

__path__.append(str(folder_of_extension(_Path(__file__).parent)))

from perifrac import _perifrac  # noqa: E402
from perifrac._perifrac import Body, Key, PointSet, Port, Scene, Section, State, add_module_type, report, set_threads
from perifrac.module import Module, View
from perifrac.runs import Frame, History, Run, read_run
from perifrac.simulation import PortInfo, Simulation

__version__ = _perifrac.version
#: What loops over bonds were compiled for.
instruction_set = _perifrac.instruction_set

__all__ = [
    "Body", "Error", "Frame", "History", "Key", "Module", "ModuleError", "NumericalError", "OutputError", "PointSet",
    "Port", "PortInfo", "Run", "Scene", "SceneError", "Section", "Simulation", "State", "View", "add_module_type",
    "instruction_set", "read_run", "report", "set_threads",
]  # fmt: skip

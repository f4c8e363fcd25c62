from perifrac._perifrac import Body as Body
from perifrac._perifrac import Key as Key
from perifrac._perifrac import PointSet as PointSet
from perifrac._perifrac import Port as Port
from perifrac._perifrac import Scene as Scene
from perifrac._perifrac import Section as Section
from perifrac._perifrac import State as State
from perifrac._perifrac import add_module_type as add_module_type
from perifrac._perifrac import instruction_set as instruction_set
from perifrac._perifrac import report as report
from perifrac._perifrac import set_threads as set_threads
from perifrac.errors import Error as Error
from perifrac.errors import ModuleError as ModuleError
from perifrac.errors import NumericalError as NumericalError
from perifrac.errors import OutputError as OutputError
from perifrac.errors import SceneError as SceneError
from perifrac.module import Module as Module
from perifrac.module import View as View
from perifrac.runs import Frame as Frame
from perifrac.runs import History as History
from perifrac.runs import Run as Run
from perifrac.runs import read_run as read_run
from perifrac.simulation import PortInfo as PortInfo
from perifrac.simulation import Simulation as Simulation

__version__: str

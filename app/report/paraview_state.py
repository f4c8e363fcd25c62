"""A state for ParaView that shows what was exported: rock by its pressure or stress, cracks by their opening."""

from __future__ import annotations

from pathlib import Path

from cells import Array, Cells

STATE = '''\
"""Shows what `perifrac export` wrote. In ParaView: File > Load State; or `paraview --state={name}`."""
import os

from paraview.simple import *  # noqa: F403

FOLDER = os.path.dirname(os.path.abspath(__file__))
SETS = {sets!r}  # file, what it is coloured by, width of lines or size of points

view = GetActiveViewOrCreate("RenderView")
for file, array, width in SETS:
    data = PVDReader(registrationName=file, FileName=os.path.join(FOLDER, file))
    shown = Show(data, view)
    shown.LineWidth, shown.PointSize = width, 2 * width
    if array:
        ColorBy(shown, ("CELLS", array))
        shown.SetScalarBarVisibility(view, True)
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
for file, array, width in SETS:
    GetDisplayProperties(FindSource(file), view).RescaleTransferFunctionToDataRange(False)
view.InteractionMode = {mode!r}
ResetCamera(view)
Render(view)
'''
TELLING = ("pore_pressure", "opening", "pressure", "damage", "displacement", "velocity")


def telling(arrays: list[Array]) -> str:
    for word in TELLING:
        for array in arrays:
            if word in array.name:
                return array.title
    return arrays[0].title if arrays else ""


def write_state(sets: dict[str, Cells], path: Path) -> Path:
    shown = [(f"{name}.pvd", telling(cells.arrays), 1 if name == "body" else 4) for name, cells in sets.items()]
    mode = "3D" if any(cells.dimension == 3 for cells in sets.values()) else "2D"
    path.write_text(STATE.format(name=path.name, sets=shown, mode=mode), encoding="utf-8")
    return path

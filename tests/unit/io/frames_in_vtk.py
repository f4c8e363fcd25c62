"""Reads the frames of write_sample_frames back with VTK: frames_in_vtk.py PROGRAM"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

VTK_VERTEX = 1


def read(path):
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path)), f"VTK does not take {path}"
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def columns(formula, count, dimension):
    """Three columns by component; those beyond the dimension are 0."""
    result = np.zeros((count, 3))
    for axis in range(dimension):
        result[:, axis] = formula(np.arange(count), axis)
    return result


def check(path, dimension, count, time):
    grid = read(path)
    assert grid.GetClassName() == "vtkUnstructuredGrid"
    assert grid.GetNumberOfPoints() == count
    assert grid.GetNumberOfCells() == count
    for cell in range(count):
        assert grid.GetCellType(cell) == VTK_VERTEX
        assert grid.GetCell(cell).GetPointId(0) == cell
    position = vtk_to_numpy(grid.GetPoints().GetData())
    np.testing.assert_array_equal(
        position, columns(lambda i, axis: i + 0.25 * axis, count, dimension))
    data = grid.GetPointData()
    assert data.GetNumberOfArrays() == 2
    np.testing.assert_array_equal(
        vtk_to_numpy(data.GetArray("pressure")), 1 / (1 + np.arange(count)))
    np.testing.assert_array_equal(
        vtk_to_numpy(data.GetArray("velocity")),
        columns(lambda i, axis: np.sqrt(i) - axis, count, dimension))
    assert grid.GetFieldData().GetArray("TimeValue").GetValue(0) == time


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder], check=True)
        frames = pathlib.Path(folder) / "frames"
        for name, dimension, count in (("solid", 2, 5), ("fluid", 3, 300)):
            series = json.loads((frames / f"{name}.hdf.series").read_text())
            assert [entry["time"] for entry in series["files"]] == [0.0, 0.125]
            for entry in series["files"]:
                check(frames / entry["name"], dimension, count, entry["time"])
        assert read(frames / "empty_000000.hdf").GetNumberOfPoints() == 0


main(sys.argv[1])

"""Cells as VTK's XML files and as tables; both name the units."""

from __future__ import annotations

import base64
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from cells import Array, Cells

TYPES = {"f": ("Float64", np.float64), "i": ("Int64", np.int64), "u": ("UInt8", np.uint8)}


def data_array(name: str, values: np.ndarray, components: tuple[str, ...] = (), more: str = "") -> str:
    word, kind = TYPES[values.dtype.kind]
    content = np.ascontiguousarray(values, dtype=kind).tobytes()
    packed = base64.b64encode(np.uint64(len(content)).tobytes() + content).decode()
    names = "".join(f" ComponentName{place}={quoteattr(c)}" for place, c in enumerate(components))
    columns = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    return f'<DataArray type="{word}" Name={quoteattr(name)}{columns}{names}{more} format="binary">{packed}</DataArray>\n'


def write_vtu(cells: Cells, path: Path) -> None:
    count, each = cells.connectivity.shape
    offsets = each * np.arange(1, count + 1)
    time = data_array("TimeValue", np.array([cells.time]), more=' NumberOfTuples="1"')
    arrays = "".join(data_array(a.title, a.values, a.components) for a in cells.arrays)
    path.write_text(
        '<?xml version="1.0"?>\n'
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f"<UnstructuredGrid>\n<FieldData>{time}</FieldData>\n"
        f'<Piece NumberOfPoints="{len(cells.corners)}" NumberOfCells="{count}">\n'
        f'<Points>{data_array("Points", cells.corners)}</Points>\n'
        f'<Cells>{data_array("connectivity", cells.connectivity.reshape(-1))}{data_array("offsets", offsets)}'
        f'{data_array("types", np.full(count, cells.kind, dtype=np.uint8))}</Cells>\n'
        f"<CellData>{arrays}</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", encoding="utf-8")  # fmt: skip


def write_collection(files: list[tuple[Path, float]], path: Path) -> Path:
    """The list of files and times that ParaView opens."""
    entries = "".join(f'<DataSet timestep="{time!r}" file={quoteattr(file.name)}/>\n' for file, time in files)
    path.write_text(f'<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n{entries}'
                    "</Collection>\n</VTKFile>\n", encoding="utf-8")  # fmt: skip
    return path


def columns(array: Array) -> list[tuple[str, np.ndarray]]:
    if array.values.ndim == 1:
        return [(array.title, array.values)]
    return [(Array(f"{array.name} {word}", array.unit, column).title, column)
            for word, column in zip(array.components, array.values.T)]  # fmt: skip


def write_csv(cells: Cells, path: Path) -> None:
    """A row a point, in the frame's order: its place, then every field."""
    axes = "xyz"[: cells.dimension]
    shown = [(f"{axis} [m]", cells.points[:, place]) for place, axis in enumerate(axes)]
    for array in cells.arrays:
        flat = cells.dimension == 2 and array.components == ("x", "y", "z")
        shown += columns(array)[: 2 if flat else None]
    with path.open("w", encoding="utf-8") as file:
        file.write(",".join(title for title, _ in shown) + "\n")
        for row in zip(*(values.tolist() for _, values in shown)):
            file.write(",".join(map(repr, row)) + "\n")

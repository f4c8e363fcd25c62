#!/usr/bin/python3
"""Writes frames of a run for other programs: export.py RUN FRAME vtu|csv FOLDER"""

from __future__ import annotations

import sys
from pathlib import Path

try:
    from cells import Cells, cells_of, set_names
    from no_run import NoRun
    from paraview_state import write_state
    from vtu import write_collection, write_csv, write_vtu
    from frames import listed_frames
except ImportError as missing:
    sys.exit(f"perifrac: no export: {missing}; needed is the Debian package python3-h5py")

Frames = list[tuple[int, Path, float]]  # number, file, time [s]


def chosen(frames: Frames, which: str) -> Frames:
    if which == "all":
        return frames
    if which in ("first", "last"):
        return [frames[0 if which == "first" else -1]]
    if which.startswith("t="):
        return [min(frames, key=lambda frame: abs(frame[2] - float(which[2:])))]
    if int(which) >= len(frames):
        raise NoRun(f"--frame: there is no frame {which}; expected 0 to {len(frames) - 1}")
    return [frames[int(which)]]


def found_frames(folder: Path) -> dict[str, Frames]:
    found = {name: [(place, *frame) for place, frame in enumerate(listed_frames(folder / "frames" / f"{name}.hdf.series"))]
             for name in set_names(folder / "frames")}  # fmt: skip
    found = {name: frames for name, frames in found.items() if frames}
    if not found:
        raise NoRun(f"{folder}: holds no frames; expected a folder of a run, with frames/*.hdf.series")
    return found


def export(folder: Path, which: str, kind: str, output: Path) -> list[Path]:
    picked = {name: chosen(frames, which) for name, frames in found_frames(folder).items()}
    output.mkdir(parents=True, exist_ok=True)
    written, shown = [], {}
    for name, frames in picked.items():
        files = []
        for number, path, time in frames:
            cells = cells_of(path)
            file = output / f"{name}_{number:06}.{kind}"
            (write_vtu if kind == "vtu" else write_csv)(cells, file)
            files.append((file, time))
            shown[name] = cells
        written += [file for file, _ in files]
        if kind == "vtu":
            written.append(write_collection(files, output / f"{name}.pvd"))
    if kind == "vtu":
        written.append(write_state(shown, output / "paraview_state.py"))
    return written


def main(arguments: list[str]) -> int:
    folder, which, kind, output = arguments
    try:
        for path in export(Path(folder), which, kind, Path(output)):
            print(path)
    except NoRun as error:
        print(f"perifrac: {error}", file=sys.stderr)
        return 2
    except (OSError, KeyError, ValueError) as error:  # a frame that is cut short, a disk that is full
        print(f"perifrac: no export of {folder}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

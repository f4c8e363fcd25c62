#!/usr/bin/python3
"""Draws what a scene sets up: setup_picture.py FILE, with what `perifrac check` says of it on standard input."""

from __future__ import annotations

import json
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from picture import STYLE
    from setup_data import Setup, read_setup
    from setup_plane import draw_plane
    from setup_solid import draw_solid
except ImportError as missing:
    sys.exit(f"perifrac: no picture: {missing}; needed are the Debian packages python3-matplotlib and python3-h5py")

WIDTH, LOWEST, HIGHEST = 9.0, 4.0, 9.0  # [inches]


def inches(setup: Setup) -> tuple[float, float]:
    if setup.dimension == 3:
        return WIDTH, 7.0
    across, up = setup.high - setup.low + 0.36 * (setup.high - setup.low).max()
    return WIDTH, min(max(0.75 * WIDTH * up / across, LOWEST), HIGHEST)


def write_setup(setup: Setup, path: Path) -> None:
    with plt.rc_context({**STYLE, "svg.hashsalt": "perifrac", "svg.fonttype": "none"}):
        solid = setup.dimension == 3
        figure = plt.figure(figsize=inches(setup), dpi=120, layout=None if solid else "constrained")
        axes = figure.add_subplot(projection="3d" if solid else None)
        (draw_solid if solid else draw_plane)(axes, setup)
        axes.set_title(setup.title, parse_math=False)
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
        plt.close(figure)


def main(arguments: list[str]) -> int:
    path = Path(arguments[0])
    try:
        write_setup(read_setup(json.load(sys.stdin)), path)
    except OSError as error:
        print(f"perifrac: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

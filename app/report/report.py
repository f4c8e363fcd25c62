"""Writes DIR/report.png and DIR/report.html for a run folder; what `perifrac report DIR` calls.

Of two folders it writes A/compared_with_B.html, both side by side. Exit 0 done, 2 a folder holds no run.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

try:
    from compare import write_comparison
    from page import write_page
    from picture import write_picture
    from no_run import NoRun
    from run import read_run
except ModuleNotFoundError as missing:
    sys.exit(f"report: {missing}; install the Debian packages python3-matplotlib and python3-h5py")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="perifrac report", description="Write a picture and a page about a run.")
    parser.add_argument("folders", type=Path, nargs="+", metavar="DIR", help="the folder that 'perifrac run' wrote; or two")
    folders = parser.parse_args(arguments).folders
    if len(folders) > 2:
        parser.error("more than two folders; expected one, or two to be compared")
    try:
        runs = [read_run(folder) for folder in folders]
    except NoRun as error:
        print(f"perifrac: {error}", file=sys.stderr)
        return 2
    if len(runs) == 2:
        print(write_comparison(*runs))
        return 0
    folder = folders[0]
    write_picture(runs[0], folder / "report.png")
    write_page(runs[0], folder / "report.html")
    print(folder / "report.png")
    print(folder / "report.html")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

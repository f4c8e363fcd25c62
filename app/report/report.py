"""Writes DIR/report.png and DIR/report.html for a run folder; what `perifrac report DIR` calls.

Exit 0 done, 2 the folder holds no run.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

try:
    from page import write_page
    from picture import write_picture
    from no_run import NoRun
    from run import read_run
except ModuleNotFoundError as missing:
    sys.exit(f"report: {missing}; install the Debian packages python3-matplotlib and python3-h5py")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="perifrac report", description="Write a picture and a page about a run.")
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder that 'perifrac run' wrote")
    folder = parser.parse_args(arguments).folder
    try:
        run = read_run(folder)
    except NoRun as error:
        print(f"perifrac: {error}", file=sys.stderr)
        return 2
    write_picture(run, folder / "report.png")
    write_page(run, folder / "report.html")
    print(folder / "report.png")
    print(folder / "report.html")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

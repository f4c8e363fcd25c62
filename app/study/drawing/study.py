"""Writes DIR/study.png, DIR/study.svg and DIR/study.html from DIR/study.json; `perifrac study` calls it.

Usage: study.py DIR

Exit 0 done, 2 the folder holds no study.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "report"))

try:
    from diagram import write_picture
    from study_data import Study
    from study_page import write_page
except ModuleNotFoundError as missing:
    sys.exit(f"study: {missing}; install the Debian packages python3-matplotlib and python3-h5py")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description="Draw a study.")
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder that 'perifrac study' wrote")
    folder = parser.parse_args(arguments).folder
    try:
        study = Study(json.loads((folder / "study.json").read_text(encoding="utf-8")))
    except (OSError, json.JSONDecodeError) as error:
        print(f"perifrac: {folder}: holds no study ({error})", file=sys.stderr)
        return 2
    for name in ("study.png", "study.svg"):
        write_picture(study, folder / name)
        print(folder / name)
    write_page(study, folder / "study.html")
    print(folder / "study.html")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

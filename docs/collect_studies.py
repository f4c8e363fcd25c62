#!/usr/bin/python3
"""Takes pictures, sentences and tables of finished studies over into docs/studies.md.

Usage: collect_studies.py RUNS

What stands between `<!-- NAME -->` and `<!-- end -->` is written anew from RUNS/NAME, if that is there.
"""
import json
import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
PAGE = DOCS / "studies.md"


def block(name, folder):
    study = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    shutil.copy(folder / "study.svg", DOCS / "images" / f"study_{name}.svg")
    machine = next(iter(study["machines"]), {})
    build = next(iter(study["builds"]), {})
    table = (folder / "table.md").read_text(encoding="utf-8").rstrip()
    lines = [f"    perifrac study configs/studies/{name}.yaml", "", f"![{study['title']}](images/study_{name}.svg)", ""]
    lines += [f"- {sentence}" for sentence in study["sentences"] if not sentence.startswith("Power of")]
    lines += ["", f"<details><summary>All variants ({machine.get('processor', '')}, {machine.get('cores', '')} cores, "
              f"commit {build.get('commit', '')})</summary>", "", table, "", "</details>"]  # fmt: skip
    return "\n".join(lines)


def main():
    runs = Path(sys.argv[1])
    page = PAGE.read_text(encoding="utf-8")
    for name in re.findall(r"<!-- (\w+) -->\n", page):
        folder = runs / name
        if name == "end" or not (folder / "study.json").exists():
            continue
        page = re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)",
                      lambda found, text=block(name, folder): f"{found[1]}{text}\n{found[2]}", page, flags=re.S)
        print(f"{name}: taken over")
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()

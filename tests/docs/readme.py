#!/usr/bin/python3
"""Runs the commands of the README's indented blocks, as a reader does who has cloned and built.

Usage: readme.py PERIFRAC

Those of `perifrac` are run, beside the scenes; of those of `make` it is asked what they would do.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMAND = re.compile(r"^    (perifrac|make|git) (.*?)(?:\s+#.*)?$", flags=re.M)


def main():
    perifrac = Path(sys.argv[1]).resolve()
    environment = dict(os.environ, PATH=f"{perifrac.parent}:{os.environ['PATH']}", OMP_NUM_THREADS="1")
    commands = COMMAND.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    counts = {program: sum(name == program for name, _ in commands) for program in ("perifrac", "make", "git")}
    failures = [] if counts["perifrac"] > 3 and counts["make"] > 2 and counts["git"] == 1 else [f"found {counts}"]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "configs").symlink_to(ROOT / "configs")
        for program, words in commands:
            if program == "git":
                continue  # from where the reader's page is
            where, line = (folder, f"perifrac {words}") if program == "perifrac" else (ROOT, f"make --dry-run {words}")
            done = subprocess.run(line, shell=True, cwd=where, env=environment, text=True, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode != 0:
                failures.append(f"exit code {done.returncode} of\n{line}\n{done.stdout[-2000:]}")
    print("\n".join(failures) or f"{len(commands)} commands")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

"""docs/configuration.md is what `perifrac list --page` prints: python3 THIS PROGRAM PAGE."""

import difflib
import subprocess
import sys

program, page = sys.argv[1:]
printed = subprocess.run([program, "list", "--page"], check=True, capture_output=True, text=True).stdout
with open(page, encoding="utf-8") as file:
    committed = file.read()
difference = "".join(
    difflib.unified_diff(committed.splitlines(True), printed.splitlines(True), page, "perifrac list --page")
)
sys.exit(f"{difference}\n{page} is out of date: run 'make docs'" if difference else 0)

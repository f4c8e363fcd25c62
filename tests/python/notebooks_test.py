#!/usr/bin/python3
"""The notebooks of the docs run from top to bottom, and show what they say they do, numbers apart.

Usage: notebooks_test.py PROGRAM BUILD [--write] [unittest's arguments]; with --write their outputs are taken anew.
"""
import ast
import base64
import contextlib
import io
import json
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.pyplot as plt

SOURCE = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((SOURCE / "docs/notebooks").glob("*.ipynb"))
sys.argv[1:3] = []
WRITE = "--write" in sys.argv and not sys.argv.remove("--write")
sys.path.insert(0, str(SOURCE / "python/examples"))


def run_cell(code, names):
    """What a notebook shows of a cell: printed text, the value of its last line, figures."""
    tree = ast.parse(code)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    outputs = []
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(last, "cell", "eval"), names) if last else None
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(True)})
    for number in plt.get_fignums():
        image = io.BytesIO()
        plt.figure(number).savefig(image, format="png", dpi=80, bbox_inches="tight")
        data = {"image/png": base64.b64encode(image.getvalue()).decode()}
        outputs.append({"output_type": "display_data", "metadata": {}, "data": data})
        plt.close(number)
    if value is not None and not outputs:
        outputs.append({"output_type": "execute_result", "execution_count": None, "metadata": {},
                        "data": {"text/plain": repr(value).splitlines(True)}})  # fmt: skip
    return outputs


def shown(outputs):
    """Text without its numbers, and that there is a picture."""
    words = []
    for output in outputs:
        text = output.get("text") or output["data"].get("text/plain", ["picture"])
        words.append(re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", "".join(text)))
    return words


class Notebooks(unittest.TestCase):
    def test_there_are_three(self):
        self.assertEqual(len(NOTEBOOKS), 3)


def make_test(path):
    def test(self):
        notebook = json.loads(path.read_text(encoding="utf-8"))
        names = {"__name__": "__main__"}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            self.addCleanup(os.chdir, before)
            for count, cell in enumerate((c for c in notebook["cells"] if c["cell_type"] == "code"), 1):
                outputs = run_cell("".join(cell["source"]), names)
                if WRITE:
                    cell.update(execution_count=count, outputs=outputs)
                self.assertEqual(shown(outputs), shown(cell["outputs"]), f"cell {count}; --write takes them anew")
            os.chdir(before)
        if WRITE:
            path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")

    return test


for each in NOTEBOOKS:
    setattr(Notebooks, f"test_{each.stem}", make_test(each))

if __name__ == "__main__":
    unittest.main()

"""What all figures share: panels, marks, the table of errors."""

from __future__ import annotations

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MARKS = ["o", "s", "^", "D", "v", "P"]


class Errors:
    """What errors.csv will hold."""

    def __init__(self):
        self.rows: list[list[str]] = []

    def add(self, figure: str, scheme: str, case: str, computed: np.ndarray, exact: np.ndarray) -> None:
        off = np.abs(np.asarray(computed) - np.asarray(exact)).ravel()
        off = off[np.isfinite(off)]
        if off.size:
            self.rows.append([figure, scheme, case, f"{off.max():.2e}", f"{np.sqrt((off**2).mean()):.2e}"])

    def write(self, path: Path) -> None:
        drawn = {row[0] for row in self.rows}
        if path.exists():
            with path.open(newline="", encoding="utf-8") as stream:
                self.rows += [row for row in list(csv.reader(stream))[1:] if row[0] not in drawn]
        self.rows.sort(key=lambda row: int(row[0]))
        with path.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["figure", "scheme", "case", "largest error", "root mean square"])
            writer.writerows(self.rows)


def panels(count: int, title: str, height: float = 4.2, **keywords):
    figure, axes = plt.subplots(1, count, figsize=(5.2 * count, height), squeeze=False, **keywords)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, fontweight="bold")
    for axis in axes[0]:
        axis.spines[["top", "right"]].set_visible(False)
        axis.grid(color="#e3e7eb", linewidth=0.7)
    return figure, list(axes[0])


def save(figure, images: Path, name: str) -> None:
    figure.tight_layout()
    figure.savefig(images / f"{name}.png", dpi=130)
    plt.close(figure)
    print(images / f"{name}.png")

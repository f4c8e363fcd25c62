"""What a run was of, and how to run it again: the scene's inputs with their units, and commands."""

from __future__ import annotations

import shlex
from html import escape
from typing import Any, Iterator

import tables
from quantities import described, words
from run import Run

SET = "# --set "
LONGEST_LIST = 12
ELSEWHERE = ("title", "output", "reference")  # shown as what they are


def flattened(value: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """`solid.material.youngs_modulus`, as error messages and --set spell it, and what was written there."""
    if isinstance(value, dict):
        for name, below in value.items():
            yield from flattened(below, f"{path}.{name}" if path else str(name))
    elif isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value) and len(value) <= LONGEST_LIST:
        for place, item in enumerate(value):
            yield from flattened(item, f"{path}[{place}]")
    else:
        yield path, ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def overrides(text: str) -> list[str]:
    return [line.removeprefix(SET) for line in text.splitlines() if line.startswith(SET)]


def inputs(run: Run) -> list[tuple[str, str]]:
    """Every key of the scene as it was run; none where its text cannot be read (or PyYAML is missing)."""
    text = run.summary.get("scene", {}).get("text", "")
    try:
        import yaml

        written = yaml.load(text, Loader=yaml.BaseLoader)  # all stays text, as it was written
    except Exception:  # noqa: BLE001  a table less, whatever is wrong
        return []
    found = dict(flattened(written)) if isinstance(written, dict) else {}
    for override in overrides(text):
        path, _, value = override.partition("=")
        found[path.strip()] = value.strip()
    return list(found.items())


def by_section(run: Run) -> str:
    """The inputs of each section as a small table."""
    sections: dict[str, list[list[str]]] = {}
    for path, value in inputs(run):
        section, _, rest = path.partition(".")
        section = section.partition("[")[0]
        if section not in ELSEWHERE:
            sections.setdefault(section if rest or "[" in path else "scene", []).append([path, value])
    parts = [tables.table([words(section), "as written"], rows) for section, rows in sections.items()]
    return f'<div class="inputs">{"".join(parts)}</div>' if parts else ""


def understood(run: Run) -> str:
    """What the program made of it, in SI."""
    lines = "".join(f"<li>{escape(line)}</li>" for line in run.summary.get("read", []))
    return f"<details><summary>as the program read it, in SI</summary><ul>{lines}</ul></details>" if lines else ""


def scene_text(run: Run) -> str:
    scene = run.summary.get("scene", {})
    if not scene.get("text"):
        return ""
    name = escape(scene.get("path", "scene"))
    return f'<details><summary>{name}</summary><pre tabindex="0">{escape(scene["text"])}</pre></details>'


def setup(run: Run) -> str:
    return tables.section("setup", "Set-up", by_section(run), understood(run), scene_text(run))


def command(run: Run) -> str:
    """The line that runs it again."""
    scene = run.summary.get("scene", {})
    words_of = ["perifrac", "run", scene.get("path") or "scene.yaml"]
    for override in overrides(scene.get("text", "")):
        words_of += ["--set", override]
    return shlex.join(words_of)


def reproduce(run: Run) -> str:
    """Command, version, build and machine."""
    summary = run.summary
    if not summary.get("scene", {}).get("path"):
        return ""
    rows = [["perifrac", summary["version"]]] if "version" in summary else []
    rows += [[words(name), described(value)] for name, value in summary.get("build", {}).items()]
    built = tables.table(["build", "is"], rows) if rows else ""
    known = [[words(name), described(value)] for name, value in summary.get("machine", {}).items()]
    if "threads" in summary:
        known.append(["threads", described(summary["threads"])])
    machine = tables.table(["machine", "is"], known) if known else ""
    line = f'<pre tabindex="0">{escape(command(run))}</pre>'
    note = '<p class="note">Any number of threads gives the same bits; another machine, compiler or library may not.</p>'
    return tables.section("reproduce", "How to reproduce", line, note, f'<div class="inputs">{built}{machine}</div>')

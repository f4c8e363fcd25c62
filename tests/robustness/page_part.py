"""Parts of a page that programs write, between marks that they know again."""
from pathlib import Path


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(cell(entry) for entry in row) + " |" for row in rows])


def put_part(page, name, text):
    """Puts `text` between the marks of that name."""
    begin, end = f"<!-- {name}: generated -->", f"<!-- end of {name} -->"
    before, rest = Path(page).read_text(encoding="utf-8").split(begin)
    after = rest.split(end)[1]
    Path(page).write_text(f"{before}{begin}\n{text}\n{end}{after}", encoding="utf-8")

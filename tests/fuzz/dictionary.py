"""The fuzzers' dictionary and first inputs, from the program itself and from the scenes that there are."""
import json
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# What YAML and quantities are made of.
MARKS = [": ", "- ", "{", "}", "[", "]", ", ", "\n", "  ", "# ", "&a ", "*a", "!!", "---", "...", "|", ">", "\"", "'",
         "? ", "~", "null", "true", "1e", "1e308", "-1", "0", "nan", "inf", "0x1", " m", " Pa", " s", " m^2", "sqrt(", "^0.5"]


def words(perifrac):
    """Every name and word that a scene may hold."""
    listed = json.loads(subprocess.run([perifrac, "list", "--json"], capture_output=True, text=True, check=True).stdout)
    found = set(MARKS)
    for key in listed["keys"]:
        found.update(re.split(r"[.\[\]]+", key["path"]), key["words"],
                     *([entry] for entry in (key["section"], key["type"], key["unit"], key["default"])))
    return sorted(word for word in found if word)


def write_dictionary(perifrac, file):
    """In libFuzzer's format."""
    lines = []
    for word in words(perifrac):
        quoted = "".join(c if c.isalnum() or c in " _.-+^/*()" else f"\\x{byte:02x}" for c in word
                         for byte in (c.encode()[:1] if c.isascii() else c.encode()))
        lines.append(f'"{quoted}"')
    Path(file).write_text("\n".join(lines) + "\n", encoding="ascii")


def first_scenes():
    return [*ROOT.glob("configs/**/*.yaml"), *ROOT.glob("tests/config_errors/*.yaml"), *ROOT.glob("tests/**/*.yaml"),
            *ROOT.glob("tests/fuzz/regressions/scene/*")]

"""Scenes as schemas must judge them: those that are shipped, and the wrong ones of tests/config_errors."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Of what is wrong by the catalogue alone; what is not is asked for by the modules.
WRONG = ("unknown key", "missing key '", "unknown word", "is not used where", "is out of range", "is a single value",
         " is a list", " is a map", "is not a whole number;", "is no truth value", "has no value", "is not a number")  # fmt: skip
BEYOND = {"crack_without_normal_in_3d", "damage_without_fracture_energy", "scatter_without_length",
          "strength_of_a_region_only", "well_perforations_without_diameter", "well_without_thickness",  # needed by what else the scene says
          "number_with_decimals_for_integer"}  # 2.0 is an integer there  # fmt: skip


SCHEMA_LINE = "# yaml-language-server: $schema="  # and where it lies, from the scene
TEMPLATES = ROOT / "app/writing/templates"  # `perifrac new` writes the schema beside its scenes


def shipped_scenes():
    return sorted([*ROOT.glob("configs/*.yaml"), *ROOT.glob("configs/paper/*.yaml"), *ROOT.glob("docs/paper/*.yaml"),
                   *TEMPLATES.glob("*.yaml")])


def schema_of(scene):
    return (TEMPLATES if scene.parent == TEMPLATES else ROOT / "configs") / "perifrac.schema.json"


def wrong_by_the_catalogue():
    """Files, and what `perifrac check` says of each."""
    for path in sorted((ROOT / "tests" / "config_errors").glob("*.yaml")):
        header = dict(re.findall(r"^# (expect|args|scene): (.*)$", path.read_text(encoding="utf-8"), re.M)[::-1])
        if {"args", "scene"} & set(header) or path.stem in BEYOND or "valid YAML" in header["expect"]:
            continue
        if any(word in header["expect"] for word in WRONG):
            yield path, header["expect"]

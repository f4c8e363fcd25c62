"""A scene as the files of configs hold it, with its numbers in SI."""
import re

import yaml

PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}
BASE = {"m": 1.0, "s": 1.0, "g": 1e-3, "Pa": 1.0, "N": 1.0, "J": 1.0, "D": 9.869233e-13, "P": 0.1, "l": 1e-3, "h": 3600.0,
        "d": 86400.0, "min": 60.0}
QUANTITY = re.compile(r"^([-+]?\d+\.?\d*(?:[eE][-+]?\d+)?)(?:\s*(\S.*))?$")


def symbol(word):
    for base in sorted(BASE, key=len, reverse=True):
        if word.endswith(base) and word[:-len(base)] in PREFIXES:
            return PREFIXES[word[:-len(base)]] * BASE[base]
    raise ValueError(word)


def factor(unit):
    """Of a unit such as `kg/(m s)`, `mm^2/ms`, `m/s*sqrt(s)`."""
    total, below = 1.0, False
    for word in re.findall(r"sqrt\(\w+\)|[A-Za-z]+(?:\^-?\d+)?|[/*()]|1", unit):
        if word == "/":
            below = True
        elif word == "*":
            below = False
        elif word not in ("(", ")", "1"):
            if word.startswith("sqrt"):
                size = symbol(word[5:-1])**0.5
            else:
                name, _, power = word.partition("^")
                size = symbol(name)**int(power or 1)
            total = total / size if below else total * size
    return total


def in_si(value):
    """`5 mm` -> 0.005; words stay."""
    if isinstance(value, dict):
        return {name: in_si(one) for name, one in value.items()}
    if isinstance(value, list):
        return [in_si(one) for one in value]
    found = QUANTITY.match(value) if isinstance(value, str) else None
    if not found:
        return value
    try:
        return float(found[1]) * factor(found[2] or "")
    except ValueError:
        return value


def read(path):
    with open(path, encoding="utf-8") as file:
        return in_si(yaml.safe_load(file))


def leaves(node, path=()):
    """(path, value) of all numbers and words; the items of lists of numbers one by one."""
    if isinstance(node, dict):
        for name, one in node.items():
            yield from leaves(one, (*path, str(name)))
    elif isinstance(node, list):
        for n, one in enumerate(node):
            yield from leaves(one, (*path, n))
    else:
        yield path, node


def put(scene, path, value):
    """As `--set path=value` does."""
    parts = [int(part) if part.isdigit() else part for part in re.findall(r"[^.\[\]]+", path)]
    for part, following in zip(parts, parts[1:]):
        if isinstance(scene, list):
            scene = scene[part]
        else:
            if not isinstance(scene.get(part), (dict, list)):
                scene[part] = {}
            scene = scene[part]
    scene[parts[-1]] = in_si(yaml.safe_load(value) if isinstance(value, str) else value)

"""Scenes moved, turned, mirrored and measured in other units, and what that does to their results.

A scene is a dictionary in SI, as its YAML would be. A transform makes another scene of it, and of
each result the value that the other scene must give.
"""
import copy
import re

# Of a key's last part: what kind of vector it is. What is left are true vectors.
PLACES = ("at", "from", "to", "centre", "path")
BY_AXIS = ("size", "confining_stress", "sides")
FACES = ("left", "right", "bottom", "top")
# [M, L, T]
DIMENSIONS = {"m": (0, 1, 0), "s": (0, 0, 1), "kg": (1, 0, 0), "Pa": (1, -1, -2), "N": (1, 1, -2), "J": (1, 2, -2)}
SIZES = {"um": ("m", 1e-6), "mm": ("m", 1e-3), "kPa": ("Pa", 1e3), "MPa": ("Pa", 1e6), "ms": ("s", 1e-3)}
WALL_TIME = ("checkpoint_interval",)


def dimension_of(unit):
    """Powers of mass, length and time of a unit such as `kg/(m s)` or `m/s*sqrt(s)`."""
    powers = [0.0, 0.0, 0.0]
    above, _, below = unit.partition("/")
    below, _, root = below.partition("*")
    for text, sign in ((above, 1.0), (below, -1.0), (root, 1.0)):
        for word in re.findall(r"sqrt\(\w+\)|[A-Za-z]+(?:\^-?\d+)?", text):
            if word.startswith("sqrt"):
                word, power = word[5:-1], 0.5
            else:
                word, _, exponent = word.partition("^")
                power = float(exponent or 1)
            for k, one in enumerate(DIMENSIONS[word]):
                powers[k] += sign * power * one
    return powers


class Keys:
    """The catalogue of `perifrac list --json`, asked about the places of a scene."""

    def __init__(self, catalogue):
        self.keys = catalogue["keys"]

    def find(self, path, scene):
        """The key at a path such as ("solid", "boundary", "left", "traction"), or None."""
        for key in self.keys:
            pattern = [key["section"]] * bool(key["section"]) + key["path"].replace("[]", ".[]").split(".")
            section = scene.get(key["section"]) or {}
            if key["type"] and section.get("type") != key["type"]:
                continue
            fits = len(pattern) == len(path) and all(
                one == other or one == "*" or (one == "[]" and isinstance(other, int))
                for one, other in zip(pattern, path))
            if fits:
                return key
        return None

    def unit(self, path, scene):
        key = self.find(path, scene)
        if key is None:
            return ""
        return key["unit"].split("|")[0 if scene["dimension"] == 2 else -1]

    def with_defaults(self, scene):
        """With what has a dimension and is not nothing written out, so that it takes part."""
        scene = copy.deepcopy(scene)
        for key in self.keys:
            section = scene.get(key["section"])
            plain = not re.search(r"[*\[]", key["path"]) and key["path"] not in WALL_TIME
            if not (key["unit"] and key["default"] and key["section"] and isinstance(section, dict) and plain):
                continue
            if key["type"] not in ("", section.get("type")) or (key["when"] and not holds(key["when"], section)):
                continue
            amount, unit = key["default"].split(" ", 1)
            if float(amount) == 0.0:
                continue
            base, size = SIZES.get(unit, (unit, 1.0))
            if base != key["unit"].split("|")[0]:
                raise ValueError(f"{key['section']}.{key['path']}: what is {unit} in {key['unit']}?")
            *folders, last = key["path"].split(".")
            for folder in folders:
                section = section.setdefault(folder, {})
            section.setdefault(last, float(amount) * size)
        return scene


def holds(condition, section):
    name, _, words = condition.partition("=")
    return section.get(name) in words.split("|")


def walk(node, change, path=()):
    """The scene with every number, list of numbers and word replaced by what `change` makes of it."""
    if isinstance(node, dict):
        return {name: walk(one, change, (*path, name)) for name, one in node.items()}
    if isinstance(node, list) and node and isinstance(node[0], dict):
        return [walk(one, change, (*path, n)) for n, one in enumerate(node)]
    return change(path, node)


class Transform:
    """One that changes nothing."""

    name = "same"
    tolerance = 1e-9

    def scene(self, scene, keys):
        return scene

    def name_of(self, column):
        """Where the other run has this column, and with which sign."""
        return column, 1.0

    def tells_of(self, column):
        return True

    def factor(self, unit):
        return 1.0

    def place(self, x):
        return x


class Scaled(Transform):
    """Every quantity in other units of mass, length and time."""

    def __init__(self, mass=1.0, length=1.0, time=1.0):
        self.sizes = (mass, length, time)
        self.name = "scaled by " + ", ".join(f"{size:g}" for size in self.sizes)

    def factor(self, unit):
        factor = 1.0
        for power, size in zip(dimension_of(unit), self.sizes):
            factor *= size**power
        return factor

    def scene(self, scene, keys):
        def change(path, value):
            factor = self.factor(keys.unit(path, scene)) if path[-1] not in WALL_TIME else 1.0
            if isinstance(value, (bool, str)) or factor == 1.0:
                return value
            if path[-1] == "permeability":  # a bare one so large is refused
                return f"{value * factor!r} m^2"
            return [one * factor for one in value] if isinstance(value, list) else value * factor

        return walk(keys.with_defaults(scene), change)

    def place(self, x):
        return [self.sizes[1] * one for one in x]


class Doubled(Transform):
    """All loads twice as large; for scenes that are linear."""

    name = "doubled"
    LOADS = ("traction", "force", "body_force", "pressure", "flux", "rate", "normal_displacement", "initial_pressure")
    FIELDS = ("displacement", "dilatation", "effective_stress", "pore_pressure", "velocity")

    def scene(self, scene, keys):
        def change(path, value):
            if path[-1] not in self.LOADS:
                return value
            return [2.0 * one for one in value] if isinstance(value, list) else 2.0 * value

        return walk(scene, change)

    def tells_of(self, column):
        return column.startswith(self.FIELDS)

    def factor(self, unit):
        return 2.0


class Moved(Transform):
    """Another set of axes: places, vectors and faces."""

    faces = {face: face for face in FACES}

    def vector(self, v):
        return v

    def by_axis(self, v):
        return v

    def scene(self, scene, keys):
        moved = self._named(copy.deepcopy(scene))
        return walk(moved, lambda path, value: self._value(path, value, keys, moved))

    def _named(self, node):
        if isinstance(node, dict):
            node = {name: self._named(one) for name, one in node.items()}
            for name in ("boundary", "faces"):
                if isinstance(node.get(name), dict):
                    node[name] = {self.faces[face]: one for face, one in node[name].items()}
            if "from" in node or "to" in node:
                self._box(node)
            return node
        return [self._named(one) for one in node] if isinstance(node, list) else node

    def _box(self, node):
        """Corners change places where an axis turns round; a corner left out is far away."""
        far = 1e300
        corners = [self.place(list(node.get(name, [sign * far] * 2))) for name, sign in (("from", -1), ("to", 1))]
        low, high = ([pick(ends) for ends in zip(*corners)] for pick in (min, max))
        for name, corner in (("from", low), ("to", high)):
            if all(abs(x) > 1e200 for x in corner):
                node.pop(name, None)
            else:
                node[name] = [max(-1e30, min(1e30, x)) for x in corner]

    def _value(self, path, value, keys, scene):
        if path[-1] == "axis":
            return self._axis(value)
        if not isinstance(value, list) or isinstance(value[0], str) or len(value) % 2:
            return value
        key = keys.find(path, scene)
        if path[-1] in ("from", "to") or (path[-1] != "path" and (key is None or key["kind"] != "vector")):
            return value
        if path[-1] in PLACES:
            return [x for n in range(0, len(value), 2) for x in self.place(value[n:n + 2])]
        return self.by_axis(value) if path[-1] in BY_AXIS else self.vector(value)

    def _axis(self, axis):
        return "xy"[0 if abs(self.vector([axis == "x", axis == "y"])[0]) else 1]

    def name_of(self, column):
        for face in FACES:
            if column.startswith(face + "_plate"):  # along its axis
                across = [float(face in ("left", "right")), float(face in ("bottom", "top"))]
                return column.replace(face, self.faces[face], 1), sum(self.vector(across))
        found = re.match(r"(\w+?)_([xy])([xy]?)( at .*|)$", column)
        if not found:
            return column, 1.0
        sign, axes = 1.0, ""
        for axis in found[2] + found[3]:
            image = self.vector([float(axis == "x"), float(axis == "y")])
            k = 0 if image[0] else 1
            sign *= image[k]
            axes += "xy"[k]
        return f"{found[1]}_{axes}{found[4]}", sign


class Translated(Moved):
    def __init__(self, shift, tolerance):
        self.shift = shift
        self.name = f"translated by {shift:g} m"
        self.tolerance = tolerance

    def place(self, x):
        return [x[0] + self.shift, x[1] - 0.5 * self.shift]

    def scene(self, scene, keys):
        moved = super().scene(scene, keys)
        if "body" in moved:
            moved["body"]["from"] = self.place([0.0, 0.0])
        return moved


class Mirrored(Moved):
    """At x = width / 2."""

    name = "mirrored"
    faces = {"left": "right", "right": "left", "bottom": "bottom", "top": "top"}

    def __init__(self, width):
        self.width = width

    def place(self, x):
        return [self.width - x[0], x[1]]

    def vector(self, v):
        return [-v[0], v[1]]


class Turned(Moved):
    """By a quarter, to the left."""

    name = "turned"
    faces = {"left": "bottom", "bottom": "right", "right": "top", "top": "left"}

    def __init__(self, height):
        self.height = height

    def place(self, x):
        return [self.height - x[1], x[0]]

    def vector(self, v):
        return [-v[1], v[0]]

    def by_axis(self, v):
        return [v[1], v[0]]

"""Made-up scenes: shipped ones under random changes of one to five keys.

A scene of a number follows from seed and number alone. Kinds of changes: a number times 1e-3 to 1e3
or, where the catalogue bounds it, anywhere in its range; another word; a body or block larger or
smaller by spacings; a crack, inlet, source or pin elsewhere or a crack of another length; another
spacing; windows; all of it in other units of mass, length and time.
"""
import copy
import math
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "metamorphic")]
import scene_values  # noqa: E402
import transforms  # noqa: E402

CONFIGS = os.path.join(HERE, "..", "..", "configs")
MOST_POINTS = 1500  # of a shipped scene before it is changed; 5000 after
FACTORS = (1, 2, 2.5, 4, 5, 8, 10)
FIXED = ("dimension", "title", "seed", "name", "output", "reference", "ledger")
PLACES = ("at", "from", "to", "centre", "path")
OTHER_KEYS = ("shape", "holds", "motion", "initial_state", "axis")  # another word of these calls for other keys
ON_LATTICE = ("cutouts", "blocks", "container", "walls")


def cells(size, spacing):
    return [extent / spacing for extent in size]


def coarsened(scene):
    """At the widest spacing that leaves whole numbers of points, of those with enough points."""
    body, fluid = scene.get("body"), scene.get("fluid", {})
    if body and "size" in body and body["shape"] == "box":
        for factor in FACTORS:
            counts = cells(body["size"], body["spacing"] * factor)
            if all(abs(c - round(c)) < 1e-6 for c in counts):
                fitting = factor
                if math.prod(counts) <= MOST_POINTS:
                    break
        body["spacing"] *= fitting
    elif body and body["shape"] == "ball":
        body["spacing"] = max(body["spacing"], body["radius"] / 6.0)
    if not body and fluid.get("container"):
        box = [b - a for a, b in zip(fluid["container"]["from"], fluid["container"]["to"])]
        while math.prod(cells(box, fluid["spacing"])) > 4 * MOST_POINTS:
            fluid["spacing"] *= 2.0
    return scene


def shipped():
    """By name, in SI, without what belongs to one set of parameters: references and times of output."""
    scenes = {}
    for name in sorted(os.listdir(CONFIGS)):
        if not name.endswith(".yaml"):
            continue
        scene = coarsened(scene_values.read(os.path.join(CONFIGS, name)))
        scene.pop("reference", None)
        for crack in scene.get("cracks", []):
            if "file" in crack:
                crack["file"] = os.path.join(os.path.abspath(CONFIGS), crack["file"])
        if scene.get("body", {}).get("shape") == "points":
            scene["body"]["file"] = os.path.join(os.path.abspath(CONFIGS), scene["body"]["file"])
        scene["output"] = {"probes": places(scene)}
        scenes[name[:-5]] = scene
    return scenes


def places(scene):
    """Where answers are read."""
    size = scene.get("body", {}).get("size")
    if not size:
        return []
    return [{"name": f"p{n}", "at": [part * extent for part, extent in zip(parts, size)]}
            for n, parts in enumerate(((0.31, 0.37, 0.43), (0.72, 0.58, 0.66)))]


def numbers(scene, keys):
    """(path, value, key) of the scene's numbers that the catalogue knows."""
    found = []
    for path, value in scene_values.leaves(scene):
        if isinstance(value, (str, bool)) or value is None or any(part in FIXED for part in path):
            continue
        whole = path[:-1] if isinstance(path[-1], int) else path
        key = keys.find(whole, scene)
        if key and key["kind"] != "integer" and not any(part in PLACES for part in path if isinstance(part, str)):
            found.append((path, value, key))
    return found


def assign(scene, path, value):
    for part in path[:-1]:
        scene = scene[part]
    scene[path[-1]] = value


def in_range(random, value, key):
    ends = re.match(r"[\[(]([^,]+), ([^\])]+)[\])]", key["range"] or "")
    if ends and "inf" not in ends[0]:
        low, high = float(ends[1]), float(ends[2])
        return low + (high - low) * random.uniform(0.001, 0.999)
    return value * 10.0**random.uniform(-3, 3)


def change_number(random, scene, keys):
    choices = [one for one in numbers(scene, keys) if one[0][-1] != "spacing" and "size" not in one[0] and "window" not in one[0]]
    path, value, key = random.choice(choices)
    if value == 0.0:
        return None
    changed = in_range(random, value, key)
    assign(scene, path, changed)
    return f"{dotted(path)}={changed:.6g}"


def change_word(random, scene, keys):
    choices = []
    for path, value in scene_values.leaves(scene):
        key = keys.find(path, scene)
        other = "boundary" in path or "faces" in path or path[-1] in OTHER_KEYS
        if isinstance(value, str) and key and len(key["words"]) > 1 and not other and not any(p in FIXED for p in path):
            choices.append((path, value, key))
    if not choices:
        return None
    path, value, key = random.choice(choices)
    word = random.choice([word for word in key["words"] if word != value])
    assign(scene, path, word)
    return f"{dotted(path)}={word}"


def change_option(random, scene, keys):
    """A key with a default that the scene leaves out."""
    choices = []
    for key in keys.keys:
        section = scene.get(key["section"])
        plain = not re.search(r"[*\[]", key["path"]) and key["path"].split(".")[-1] not in FIXED
        if not (isinstance(section, dict) and plain and key["default"] and key["section"] not in FIXED):
            continue
        if key["type"] in ("", section.get("type")) and (not key["when"] or transforms.holds(key["when"], section)):
            choices.append(key)
    key = random.choice(choices)
    value = scene_values.in_si(key["default"])
    if key["words"]:
        value = random.choice(key["words"])
    elif key["kind"] == "boolean":
        value = random.random() < 0.5
    elif key["kind"] == "integer":
        value = random.choice([0, 1, 2, 5, 20])
    elif isinstance(value, float):
        value = in_range(random, value or 1.0, key)
    scene_values.put(scene, f"{key['section']}.{key['path']}", value)
    return f"{key['section']}.{key['path']}={value}"


def change_size(random, scene, keys):
    body = scene.get("body")
    if not body or body["shape"] != "box":
        return None
    axis = random.randrange(len(body["size"]))
    count = round(body["size"][axis] / body["spacing"])
    new = max(1, round(count * 2.0**random.uniform(-1.5, 1.0)))
    body["size"][axis] = new * body["spacing"]
    return f"body.size[{axis}]={body['size'][axis]:.6g}"


def change_place(random, scene, keys):
    spacing = scene.get("body", {}).get("spacing") or scene.get("fluid", {}).get("spacing")
    choices = [(path, value) for path, value in scene_values.leaves(scene)
               if not isinstance(value, str) and len(path) > 1 and path[-2] in PLACES and "output" not in path]
    if not choices or not spacing:
        return None
    path, value = random.choice(choices)
    steps = [-20, -5, -2, -1, 1, 2, 5, 20]
    changed = value + spacing * random.choice(steps if any(part in ON_LATTICE for part in path) else [-0.5, 0.5] + steps)
    assign(scene, path, changed)
    return f"{dotted(path)}={changed:.6g}"


def change_spacing(random, scene, keys):
    factor = random.choice([0.5, 0.8, 1.25, 2.0, 2.5])
    if scene.get("body", {}).get("spacing"):
        body = scene["body"]
        body["spacing"] *= factor
        if body["shape"] == "box":  # whole spacings
            body["size"] = [max(1, round(c)) * body["spacing"] for c in cells(body["size"], body["spacing"])]
        return f"body.spacing={scene['body']['spacing']:.6g}"
    if scene.get("fluid", {}).get("spacing"):
        scene["fluid"]["spacing"] *= factor
        return f"fluid.spacing={scene['fluid']['spacing']:.6g}"
    return None


def change_windows(random, scene, keys):
    window = scene.setdefault("coupling", {}).setdefault("window", {})
    end = scene["time"]["end"]
    name = random.choice(["first", "largest"])
    default = {"first": 1e-5, "largest": 0.02}[name] * end
    window[name] = min(end, window.get(name, default) * 10.0**random.uniform(-1.5, 2))
    if "first" in window and "largest" in window:
        window["first"] = min(window["first"], window["largest"])
    return f"coupling.window.{name}={window[name]:.6g}"


CHANGES = (change_number,) * 6 + (change_option,) * 2 + (change_word, change_size, change_place, change_spacing,
                                                        change_windows)


def dotted(path):
    return ".".join(str(part) for part in path)


def made_up(random, scenes, keys):
    """(name, what was changed, the scene)."""
    name = random.choice(sorted(scenes))
    scene, changes = copy.deepcopy(scenes[name]), []
    for _ in range(random.randint(1, 5)):
        change = random.choice(CHANGES)(random, scene, keys)
        if change:
            changes.append(change)
    if random.random() < 0.1:
        scaled = transforms.Scaled(*(10.0**random.uniform(-3, 3) for _ in range(3)))
        scene = scaled.scene(scene, keys)
        changes.append(scaled.name)
    return name, changes, scene


def points_of(scene):
    """Roughly, before anything is built."""
    body, fluid = scene.get("body", {}), scene.get("fluid", {})
    total = 0.0
    if body.get("shape") == "box":
        total += math.prod(cells(body["size"], body["spacing"]))
    if body.get("shape") == "ball":
        total += 4.2 * (body["radius"] / body["spacing"])**3
    spacing = fluid.get("spacing") or body.get("spacing")
    for block in fluid.get("blocks", []):
        total += math.prod(max(1.0, abs(b - a) / spacing) for a, b in zip(block["from"], block["to"]))
    return total


def finer(scene):
    """At half the spacing, or None where there is none to halve."""
    scene = copy.deepcopy(scene)
    halved = False
    for section in ("body", "fluid"):
        if isinstance(scene.get(section), dict) and isinstance(scene[section].get("spacing"), float):
            scene[section]["spacing"] *= 0.5
            halved = True
    return scene if halved else None


def shorter_windows(scene):
    """Of half the length, or None where windows are one step long."""
    scene = copy.deepcopy(scene)
    window = scene.setdefault("coupling", {}).setdefault("window", {})
    if window.get("type") == "one_step":
        return None
    end = scene["time"]["end"]
    window["first"] = 0.5 * window.get("first", 1e-5 * end)
    window["largest"] = 0.5 * window.get("largest", 0.02 * end)
    return scene

"""Made-up scenes: small ones of those shipped under random changes of one to five keys.

A scene of a number follows from seed and number alone. Kinds of changes: a number times 1e-3 to 1e3
or, where the catalogue bounds it, anywhere in its range; another word; a body larger or smaller by
spacings; a crack, inlet, source or pin elsewhere or a crack of another length; another spacing;
windows; all of it in other units of mass, length and time. What a change calls for changes with it:
what lies on a face goes with the face, one fluid has one density.
"""
import copy
import math
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "metamorphic")]
import geometry  # noqa: E402
import scene_values  # noqa: E402
import small  # noqa: E402
import transforms  # noqa: E402

FIXED = ("dimension", "title", "seed", "name", "output", "reference", "ledger")
# Another word of these calls for other keys, beside them or in another section.
OTHER_KEYS = ("shape", "holds", "motion", "initial_state", "axis", "leak_off", "exchange", "part", "damaged_rock")
OTHERWISE = ("times", "normal", "radius", "sides", "spacing", "size", "window")  # changed in ways of their own, or not
SPACINGS = (0.5, 2.0 / 3.0, 0.8, 1.25, 1.5, 2.0, 2.5)


def cells(size, spacing):
    return [extent / spacing for extent in size]


def numbers(scene, keys):
    """(path, value, key) of the scene's numbers that the catalogue knows."""
    found = []
    for path, value in scene_values.leaves(scene):
        if isinstance(value, (str, bool)) or value is None or any(part in FIXED for part in path):
            continue
        whole = path[:-1] if isinstance(path[-1], int) else path
        key = keys.find(whole, scene)
        if key and key["kind"] != "integer" and not any(part in (*transforms.PLACES, *OTHERWISE) for part in path if isinstance(part, str)):
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
    choices = [one for one in numbers(scene, keys) if one[1] != 0.0]
    path, value, key = random.choice(choices)
    changed = in_range(random, value, key)
    assign(scene, path, changed)
    return f"{dotted(path)}={changed:.6g}"


def fitting_words(scene, path, words):
    """Of those another of which asks for nothing that the scene has not."""
    solid, cracks = scene.get("solid", {}), bool(scene.get("cracks")) or "damage" in scene
    if path[-1] in OTHER_KEYS or "boundary" in path or "faces" in path or any(part in FIXED for part in path):
        return []
    if path[0] == "damage" or path == ("fluid", "type") or (path == ("crack_fluid", "counts") and scene["dimension"] == 3):
        return []
    if path in (("solid", "type"), ("solid", "material", "type")) and (cracks or "fluid" in scene):
        return []
    if path == ("solid", "type"):
        stressed = any("stress" in key for key in solid)
        return [word for word in words if word != "rigid" and not stressed]
    if path == ("solid", "kinematics") and (solid.get("type") != "dynamic" or cracks or len(scene) > 6):
        return []
    if path == ("coupling", "split"):
        own = {"quasi_static": ["fixed_stress"], "dynamic": ["undrained"]}.get(solid.get("type"), [])
        return ["automatic", "drained", *own] if "pore_flow" in scene else []
    if path == ("solid", "material", "type") and scene["dimension"] == 3:
        return [word for word in words if word != "lps_printed"]
    return words


def change_word(random, scene, keys):
    choices = []
    for path, value in scene_values.leaves(scene):
        key = keys.find(path, scene)
        if isinstance(value, str) and key:
            others = [word for word in fitting_words(scene, path, key["words"]) if word != value]
            if others:
                choices.append((path, others))
    if not choices:
        return None
    path, others = random.choice(choices)
    word = random.choice(others)
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
        words = fitting_words(scene, (key["section"], *key["path"].split(".")), key["words"])
        if not words:
            return None
        value = random.choice(words)
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
    other = geometry.resized(scene, axis, max(1, round(count * 2.0**random.uniform(-1.5, 1.0))))
    if other is None:
        return None
    scene.update(other)
    return f"body.size[{axis}]={scene['body']['size'][axis]:.6g}"


def change_place(random, scene, keys):
    found = geometry.moved(random, scene) if scene.get("body", {}).get("spacing") else None
    if found is None:
        return None
    scene.update(found[1])
    return found[0]


def change_spacing(random, scene, keys):
    factor = random.choice(SPACINGS)
    body, fluid = scene.get("body", {}), scene.get("fluid", {})
    if body.get("spacing"):
        if not geometry.is_whole(scene, body["spacing"] * factor):
            return None
        body["spacing"] *= factor
        geometry.thin_layers(scene, factor)
        return f"body.spacing={body['spacing']:.6g}"
    if fluid.get("spacing") and geometry.is_whole(scene, fluid["spacing"] * factor):
        fluid["spacing"] *= factor
        return f"fluid.spacing={fluid['spacing']:.6g}"
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


def make_consistent(scene):
    """What a change calls for elsewhere."""
    pores, solid = scene.get("pore_flow", {}), scene.get("solid", {})
    if "biot_coefficient" in pores:
        pores["porosity"] = min(pores["porosity"], pores["biot_coefficient"])
    if "solid" in scene and solid.get("type") == "dynamic":
        solid.setdefault("density", 2000.0)
    if pores.get("operator") == "nested":
        pores.setdefault("integrator", {})["type"] = "explicit"
    iterations = scene.get("coupling", {}).get("iterations", {})
    tolerance = pores.get("integrator", {}).get("tolerance", 1e-5)
    if pores and "solid" in scene and iterations.get("tolerance", 1e-4) < tolerance:
        scene.setdefault("coupling", {}).setdefault("iterations", {})["tolerance"] = tolerance
    fluids = [one for one in (scene.get("fluid"), pores.get("fluid"), scene.get("crack_fluid")) if one is not None]
    if len(fluids) > 1:
        for one in fluids:
            one["density"] = fluids[0].get("density", 1000.0)


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
    make_consistent(scene)
    scene["output"] = {"probes": small.places(scene)}
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
    geometry.thin_layers(scene, 0.5)
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

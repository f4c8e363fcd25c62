"""Geometry of made-up scenes: what lies on a face goes with it, what feeds a crack goes with the crack."""
import copy
import itertools

NEAR = 1e-6  # of a spacing
SHORTEST_CRACK = 4.0  # spacings; for what is shorter the program wants a finer spacing
HALF_STEPS = [0.5 * n for n in (-20, -10, -4, -2, -1, 1, 2, 4, 10, 20)]


def corners(crack, dimension):
    """Of a crack, as lists in the scene are: (list, where its x is)."""
    if "path" in crack:
        return [(crack["path"], n) for n in range(0, len(crack["path"]), dimension)]
    return [(crack["centre"], 0)] if "centre" in crack else []


def points(scene):
    """What lies at a point: pins, inlets and sources."""
    for section in ("solid", "crack_fluid", "pore_flow"):
        for name in ("pins", "inlets", "sources"):
            for one in scene.get(section, {}).get(name, []):
                if "at" in one:
                    yield one["at"]


def cut_boxes(scene):
    """Cut-outs that are no round holes."""
    return [one for one in scene.get("body", {}).get("cutouts", {}).values() if "radius" not in one]


def whole_boxes(scene):
    """Boxes around what moves as a whole."""
    crack_fluid = scene.get("crack_fluid", {})
    yield from itertools.chain(crack_fluid.get("sealed", []), crack_fluid.get("filled", []), cut_boxes(scene))


def free_boxes(scene):
    """Boxes whose corners move on their own."""
    fluid = scene.get("fluid", {})
    yield from scene.get("body", {}).get("regions", {}).values()
    for name in ("blocks", "walls", "inlets", "outlets"):
        yield from fluid.get(name, [])
    if "container" in fluid:
        yield fluid["container"]


def groups(scene):
    """Lists of corners that move together: a crack with what is at it, every other point for itself."""
    dimension = scene["dimension"]
    left = list(points(scene))
    for crack in scene.get("cracks", []):
        places = corners(crack, dimension)
        at = [one for one in left if any(all(abs(one[a] - where[n + a]) < 1e-12 for a in range(dimension))
                                         for where, n in places)]
        left = [one for one in left if not any(one is other for other in at)]
        yield places + [(one, 0) for one in at]
    for one in left:
        yield [(one, 0)]


def shift(group, axis, by):
    for place, n in group:
        place[n + axis] += by


def move_face(scene, axis, old, by):
    """The body has got longer by so much; what was at its upper face stays at it."""
    close = old - NEAR * scene["body"]["spacing"]
    for group in groups(scene):
        if any(place[n + axis] >= close for place, n in group):
            shift(group, axis, by)
    for box in whole_boxes(scene):
        if "to" in box and box["to"][axis] >= close:
            for corner in ("from", "to"):
                box[corner][axis] += by if corner in box else 0.0
    for box in free_boxes(scene):
        for corner in ("from", "to"):
            if corner in box and box[corner][axis] >= close:
                box[corner][axis] += by


def resized(scene, axis, cells):
    """With so many spacings along an axis, or None where something would lie outside then."""
    scene = copy.deepcopy(scene)
    body = scene["body"]
    old = body["size"][axis]
    body["size"][axis] = cells * body["spacing"]
    move_face(scene, axis, old, body["size"][axis] - old)
    return scene if fits(scene) else None


def fits(scene):
    """Points and boxes hold something of the body, and cracks lie in it."""
    body = scene.get("body", {})
    if body.get("shape") != "box":
        return True
    room = NEAR * body["spacing"]
    layers = 4.0 * body["spacing"] if body.get("boundary") else room  # bonded ones
    for group in groups(scene):
        for place, n in group:
            if not all(-layers <= place[n + a] <= size + layers for a, size in enumerate(body["size"])):
                return False
    boxes = [*whole_boxes(scene), *body.get("regions", {}).values()]
    return all(box.get("from", body["size"])[a] <= size + room if "from" in box else True
               for box in boxes for a, size in enumerate(body["size"]))


def thin_layers(scene, factor):
    """Bonded layers are as thick as so many spacings: what of a crack lies in them is so, too."""
    if not scene.get("body", {}).get("boundary"):
        return
    for crack in scene.get("cracks", []):
        if "path" in crack:
            crack["path"] = [x * factor if x < 0.0 else x for x in crack["path"]]


def crack_lengths(scene):
    for crack in scene.get("cracks", []):
        if "radius" in crack:
            yield 1.5 * crack["radius"]
        if "path" in crack:
            ends = list(zip(crack["path"][::2], crack["path"][1::2]))
            yield sum(((b[0] - a[0])**2 + (b[1] - a[1])**2)**0.5 for a, b in zip(ends, ends[1:]))


def is_whole(scene, spacing):
    """Edges of what lies on the lattice are whole spacings, and cracks long enough."""
    body, fluid = scene.get("body", {}), scene.get("fluid", {})
    edges = list(body.get("size", []))
    boxes = [cut_boxes(scene), fluid.get("blocks", []), fluid.get("walls", []), fluid.get("inlets", [])]
    for box in itertools.chain(*boxes):
        edges += [b - a for a, b in zip(box["from"], box["to"])]
    cells = [edge / spacing for edge in edges]
    whole = all(abs(one - round(one)) < NEAR and round(one) > 0 for one in cells)
    return whole and all(length >= SHORTEST_CRACK * spacing * (1.0 - NEAR) for length in crack_lengths(scene))


def moved(random, scene):
    """(what was moved, scene): a crack with what feeds it, its free end, or a point; None where it leaves the body."""
    scene = copy.deepcopy(scene)
    spacing = scene["body"]["spacing"]
    choices = list(groups(scene))
    if not choices:
        return None
    group = random.choice(choices)
    axis, by = random.randrange(scene["dimension"]), random.choice(HALF_STEPS) * spacing
    if scene["dimension"] == 2 and len(group) > 1 and random.random() < 0.5:
        corner = group[1 if len(group) > 2 else 0]  # the path's second: inlets mostly are at its first
        before = list(crack_lengths(scene))
        where = [corner[0][corner[1] + a] for a in range(2)]
        shift([(place, n) for place, n in group if place[n:n + 2] == where], axis, by)
        short = any(length < SHORTEST_CRACK * spacing for length in crack_lengths(scene))
        return (f"a crack's end by {by:.6g} along {'xyz'[axis]}", scene) if fits(scene) and before and not short else None
    shift(group, axis, by)
    return (f"{'a crack' if len(group) > 1 else 'a point'} by {by:.6g} along {'xyz'[axis]}", scene) if fits(scene) else None

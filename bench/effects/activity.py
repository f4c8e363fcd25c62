"""Work follows activity: the same body with an effect in 1 % of where it could be, and everywhere."""
import statistics
from pathlib import Path

HERE = Path(__file__).resolve().parent


def _slits():
    """Ten slits of 40 facets: the points that they touch are a third of all."""
    heights = [15.0 + 12.5 * k for k in range(10)]
    return ", ".join(f"{{name: s{k}, path: [100 mm, {y} mm, 200 mm, {y} mm], opening: 0.1 mm}}"
                     for k, y in enumerate(heights))


# What is active, the scene, the keys that make it active everywhere, the parts that are the effect's own.
PAIRS = [
    ("damage: bonds pulled near their limit", "strip.yaml",
     {"body.regions.pulled": "{from: [0 mm, 19 mm], to: [1000 mm, 40 mm]}"}, ["damage"]),
    ("fluid and interface: water that seeps into rock", "film.yaml",
     {"fluid.container": "{from: [0 m, 10 m], to: [1000 m, 20 m], faces: {bottom: open, top: open}}",
      "fluid.blocks": "[{name: film, from: [0 m, 10 m], to: [1000 m, 15 m], hydrostatic: true}]"}, ["fluid"]),
    ("crack network and leak-off: slits in porous rock", "slits.yaml",
     {"cracks": f"[{_slits()}]",
      "crack_fluid.inlets": "[{name: well, at: [100 mm, 77.5 mm], rate: 1e-6 m^2/s}]"}, ["crack_fluid"]),
]


def measure(perifrac, rounds, folder, run, per_step, part_seconds):
    """A row a pair: s a step of the effect and of the whole scene, in 1 % and everywhere."""
    rows = []
    for name, scene, everywhere, parts in PAIRS:
        own, whole = [], []
        for _ in range(rounds):
            both = [run(perifrac, HERE / scene, keys, folder) for keys in ({}, everywhere)]
            own.append([sum(part_seconds(summary, part) for part in parts) for summary in both])
            whole.append([per_step(summary) for summary in both])
        rows.append({"name": name, "scene": scene, "own": _best(own), "whole": _best(whole)})
    return rows


def _best(times):
    """Least times, and the median ratio."""
    few, everywhere = zip(*times)
    return min(few), min(everywhere), statistics.median(a / b for a, b in times)


def table(rows):
    lines = ["| active | scene | the effect's own, 1 % [ms] | everywhere [ms] | ratio | the whole scene, 1 % [ms] | "
             "everywhere [ms] | ratio |", "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        cells = [f"{1e3 * value:.3g}" for value in row["own"][:2]] + [f"{row['own'][2]:.3f}"]
        cells += [f"{1e3 * value:.3g}" for value in row["whole"][:2]] + [f"{row['whole'][2]:.2f}"]
        lines.append(f"| {row['name']} | [{row['scene']}](../bench/effects/{row['scene']}) | {' | '.join(cells)} |")
    return "\n".join(lines)


TEXT = """## Work follows activity

The same body, with the effect in 1 % of where it could be and everywhere (slits: where they touch a third of all points); times are of a window, results are the same bits as those of a program that looks everywhere.

{table}

- Bonds are looked at where they may have come to their limit since they were last looked at: a block of 32 points (64 in 3D) is left alone until its points have moved against each other as far as its most stretched bond had left. What stays everywhere is to add up those ways, once a step.
- Fluid seeks walls around itself, and exchanges mass with the wall points that it reaches.
- The crack network has unknowns on facets, leak-off on the points that facets touch.
- Pore flow puts its matrix together anew in windows in which bonds broke, and in no other.

What cannot follow: a solid's bonds carry forces everywhere, explicit pore flow flows everywhere, and what modules hand to each other on the body's points (displacement, pore pressure) is copied for all of them once a window. Where those are most of the scene, as under a solid that is pulled in one place, the whole costs nearly the same; where the effect is most of it, as water on rock, the whole follows too. So of the limit, that what is active in 1 % costs at most a fifth of what is active everywhere: the effect's own work keeps it in all three scenes, the whole scene in `film.yaml` only. `make instructions` holds just that, and prints the two wholes that do not follow. When a crack grows, pore flow and a solid go over all bonds of the body once.
"""


def section(rows):
    return TEXT.format(table=table(rows))

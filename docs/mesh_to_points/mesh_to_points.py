#!/usr/bin/python3
"""A mesh (Gmsh's .msh, .vtu, what else meshio reads) as points of a body: mesh_to_points.py MESH NAME

Writes NAME.csv, a point a cell: its middle, its area or volume [m]. In 2D, lines that the mesh names become cracks,
NAME_LINE.csv. Prints what goes into the scene: regions are the boxes around what the mesh names, or numbers `region`."""
import sys

import meshio
import numpy as np

mesh, name = meshio.read(sys.argv[1]), sys.argv[2]
SIMPLICES = {"triangle": [[0, 1, 2]], "quad": [[0, 1, 2], [0, 2, 3]], "tetra": [[0, 1, 2, 3]], "hexahedron":
             [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]}
D = 3 if {"tetra", "hexahedron"} & set(mesh.cells_dict) else 2  # plane cells beside those of a solid are its faces
tags = mesh.cell_data_dict.get("gmsh:physical") or mesh.cell_data_dict.get("region", {})
named = {int(about[0]): word for word, about in mesh.field_data.items() if len(about) == 2}
rows, groups = [], {}
for kind in ("triangle", "quad") if D == 2 else ("tetra", "hexahedron"):
    for place, cell in enumerate(mesh.cells_dict.get(kind, [])):
        parts = [mesh.points[cell[corners], :D] for corners in SIMPLICES[kind]]
        sizes = [abs(np.linalg.det(part[1:] - part[0])) / (2 if D == 2 else 6) for part in parts]
        rows.append([*(sum(s * part.mean(axis=0) for s, part in zip(sizes, parts)) / sum(sizes)), sum(sizes)])
        tag = int(tags[kind][place]) if kind in tags else 0
        groups.setdefault(named.get(tag, f"region_{tag}" if tag else ""), []).extend(mesh.points[cell, :D])
np.savetxt(f"{name}.csv", rows, "%.12g", ",", header=",".join("xyz"[:D]) + ",volume", comments="")
ends = {word: (np.min(at, axis=0).tolist(), np.max(at, axis=0).tolist()) for word, at in groups.items()}
low, high = np.min([low for low, _ in ends.values()], axis=0), np.max([high for _, high in ends.values()], axis=0)
print(f"body:\n  shape: points\n  file: {name}.csv\n  from: {low.tolist()}\n  size: {(high - low).tolist()}")
print("  regions:" if set(ends) - {""} else "", *(f"    {word}: {{from: {ends[word][0]}, to: {ends[word][1]}}}"
                                                  for word in sorted(set(ends) - {""})), sep="\n")
lines = list(zip(tags.get("line", []), mesh.cells_dict.get("line", []))) if D == 2 else []
print("cracks:" if lines else "")
for tag in sorted({int(tag) for tag, _ in lines} & set(named)):
    left = [list(pair) for other, pair in lines if other == tag]
    path = [next(node for pair in left for node in pair if sum(node in other for other in left) == 1)]
    while left:  # from an end on, one line after the other
        pair = left.pop(next(place for place, pair in enumerate(left) if path[-1] in pair))
        path.append(pair[0] if pair[1] == path[-1] else pair[1])
    np.savetxt(f"{name}_{named[tag]}.csv", mesh.points[path, :2], "%.12g", ",", header="x,y", comments="")
    print(f"  - {{name: {named[tag]}, file: {name}_{named[tag]}.csv}}")

"""Cracks in 2D as lines: which facets follow one another, and how far along each lies."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from crack_path import neighbours

MOST_FACETS = 4000


@dataclass
class Paths:
    """Every facet belongs to one branch and lies `along` [m] it, counted from the oldest facet of its crack."""

    branch: np.ndarray
    along: np.ndarray
    joined: list[tuple[int, int]] = field(default_factory=list)  # a branch's first facet and what it begins at


def tree_of(root: int, links: list[list[int]], points: np.ndarray, parent: np.ndarray) -> list[int]:
    """The facets that hang together with `root`, nearest first; fills in what each follows."""
    order, queue = [root], [root]
    while queue:
        at = queue.pop(0)
        free = [n for n in links[at] if parent[n] == -2]
        for n in sorted(free, key=lambda n: float(np.hypot(*(points[n] - points[at])))):
            parent[n] = at
            order.append(n)
            queue.append(n)
    return order


def branches_of(root: int, order: list[int], parent: np.ndarray, step: np.ndarray, found: Paths, next_branch: int) -> int:
    """Splits the tree of one crack: its longest arms on both sides of the oldest facet are one branch."""
    children: dict[int, list[int]] = {at: [] for at in order}
    for at in order[1:]:
        children[int(parent[at])].append(at)
    depth = {}
    for at in reversed(order):
        depth[at] = 1 + max((depth[child] for child in children[at]), default=0)
    sign = {next_branch: 1.0}
    found.branch[root], found.along[root] = next_branch, 0.0
    main, last = next_branch, next_branch
    for at in order:
        branch = int(found.branch[at])
        for place, child in enumerate(sorted(children[at], key=lambda c: -depth[c])):
            backwards = at == root and place == 1
            goes_on = place == 0 or backwards
            if not goes_on:
                last += 1
                sign[last] = 1.0
                found.joined.append((child, at))
            found.branch[child] = branch if goes_on else last
            if backwards:
                found.along[child] = -step[child]
            else:
                direction = -1.0 if goes_on and found.along[at] < 0 and branch == main else sign[int(found.branch[child])]
                found.along[child] = found.along[at] + direction * step[child]
    return last + 1


def crack_paths(points: np.ndarray) -> Paths | None:
    """Of the facets' middles, in 2D; none of very many."""
    count = len(points)
    if not 0 < count <= MOST_FACETS:
        return None
    found = Paths(np.zeros(count, dtype=int), np.zeros(count))
    if count == 1:
        return found
    links: list[list[int]] = [[] for _ in range(count)]
    for i, j in neighbours(points)[0]:
        links[i].append(int(j))
        links[j].append(int(i))
    parent = np.full(count, -2)
    next_branch = 0
    for root in range(count):
        if parent[root] != -2:
            continue
        parent[root] = -1
        order = tree_of(root, links, points, parent)
        step = np.zeros(count)
        for at in order[1:]:
            step[at] = np.hypot(*(points[at] - points[parent[at]]))
        next_branch = branches_of(root, order, parent, step, found, next_branch)
    return found

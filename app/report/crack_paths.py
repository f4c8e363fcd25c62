"""Cracks in 2D as lines: which facets follow one another, and how far along each lies."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

MOST_FACETS = 4000
REACH = 1.6  # of the usual gap: facets farther apart are no neighbours


@dataclass
class Paths:
    """Every facet belongs to one branch and lies `along` [m] it, counted from the oldest facet of its crack."""

    branch: np.ndarray
    along: np.ndarray
    joined: list[tuple[int, int]] = field(default_factory=list)  # a branch's first facet and what it begins at


def nearest_gaps(distance: np.ndarray) -> np.ndarray:
    return np.where(distance > 0, distance, np.inf).min(axis=1)


def neighbours(middles: np.ndarray) -> np.ndarray:
    """Pairs: of every facet the nearest, and the nearest on its other side."""
    if len(middles) < 2:
        return np.empty((0, 2), dtype=int)
    away = middles[None, :, :] - middles[:, None, :]
    distance = np.hypot(away[..., 0], away[..., 1])
    reach = REACH * float(np.median(nearest_gaps(distance)))
    found = set()
    for i in range(len(middles)):
        near = [j for j in np.argsort(distance[i], kind="stable") if j != i and distance[i, j] < 1.5 * reach]
        if not near or distance[i, near[0]] > reach:
            continue
        found.add((min(i, near[0]), max(i, near[0])))
        first = away[i, near[0]]
        other = [j for j in near[1:] if distance[i, j] < reach and away[i, j] @ first < 0]
        if other:
            found.add((min(i, other[0]), max(i, other[0])))
    return np.array(sorted(found), dtype=int).reshape(-1, 2)


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


def branches_of(root: int, order: list[int], parent: np.ndarray, points: np.ndarray, found: Paths, next_branch: int) -> int:
    """Splits the tree of one crack: its longest arms on both sides of the oldest facet are one branch, counted
    towards larger x, or y; so that it does not turn round as one arm outgrows the other."""
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
        ranked = sorted(children[at], key=lambda c: -depth[c])
        if at == root:
            ranked[:2] = sorted(ranked[:2], key=lambda c: tuple(points[c]), reverse=True)
        for place, child in enumerate(ranked):
            backwards = at == root and place == 1
            goes_on = place == 0 or backwards
            if not goes_on:
                last += 1
                sign[last] = 1.0
                found.joined.append((child, at))
            found.branch[child] = branch if goes_on else last
            step = np.hypot(*(points[child] - points[at]))
            if backwards:
                found.along[child] = -step
            else:
                direction = -1.0 if goes_on and found.along[at] < 0 and branch == main else sign[int(found.branch[child])]
                found.along[child] = found.along[at] + direction * step
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
    for i, j in neighbours(points):
        links[i].append(int(j))
        links[j].append(int(i))
    parent = np.full(count, -2)
    next_branch = 0
    for root in range(count):
        if parent[root] != -2:
            continue
        parent[root] = -1
        order = tree_of(root, links, points, parent)
        next_branch = branches_of(root, order, parent, points, found, next_branch)
    return found

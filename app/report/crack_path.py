"""The cracks of a run in 2D, from the middles of their facets: which are neighbours, and how far along each lies."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

REACH = 1.6  # of the usual gap: facets farther apart are no neighbours


@dataclass(frozen=True)
class CrackPath:
    middles: np.ndarray  # (count, 2) [m]
    pairs: np.ndarray  # (count, 2): neighbours
    along: np.ndarray  # from the first facet [m]; infinite where no path leads there


def nearest_gaps(distance: np.ndarray) -> np.ndarray:
    return np.where(distance > 0, distance, np.inf).min(axis=1)


def neighbours(middles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of every facet the nearest, and the nearest on its other side; with the distances of all."""
    away = middles[None, :, :] - middles[:, None, :]
    distance = np.hypot(away[..., 0], away[..., 1])
    if len(middles) < 2:
        return np.empty((0, 2), dtype=int), distance
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
    return np.array(sorted(found), dtype=int).reshape(-1, 2), distance


def distances(pairs: np.ndarray, distance: np.ndarray, count: int) -> np.ndarray:
    """Dijkstra's, from the first facet."""
    beside: list[list[int]] = [[] for _ in range(count)]
    for i, j in pairs:
        beside[i].append(j)
        beside[j].append(i)
    along = np.full(count, np.inf)
    waiting = [(0.0, 0)] if count else []
    while waiting:
        so_far, i = heapq.heappop(waiting)
        if so_far >= along[i]:
            continue
        along[i] = so_far
        for j in beside[i]:
            heapq.heappush(waiting, (so_far + float(distance[i, j]), j))
    return along


def crack_path(middles: np.ndarray) -> CrackPath:
    pairs, distance = neighbours(middles)
    return CrackPath(middles, pairs, distances(pairs, distance, len(middles)))

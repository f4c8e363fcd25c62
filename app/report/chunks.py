"""Numbers as the page holds them: quantised between their ends, differences packed. For looking at, not for computing.

A chunk is told by `{"key", "count", "low", "step", "top", "bytes"}`: value = low + step * code, with codes up to `top`
in 1 or 2 bytes, of which the largest stands for "not there". Codes are written as differences from the one before, low bytes of all first,
then high bytes, by zlib: what varies smoothly along the points packs well.
"""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

FEW = 3000  # so many values may always have two bytes
MOST_LEVELS = 65_534
LEVELS = 120  # the middle nine tenths of a field are shown in at least so many steps


class Chunks:
    """Packed arrays by key; equal ones are held once."""

    def __init__(self) -> None:
        self.packed: list[bytes] = []
        self.places: dict[bytes, int] = {}

    def __len__(self) -> int:
        return sum(len(one) for one in self.packed)

    def add(self, values: np.ndarray, fine: bool = False) -> dict[str, Any]:
        described, packed = pack(values, fine)
        if packed not in self.places:
            self.places[packed] = len(self.packed)
            self.packed.append(packed)
        return {"key": self.places[packed], **described}


def levels_for(values: np.ndarray, low: float, high: float) -> int:
    """Steps between the ends: more where most values lie within a small part of the range, as stress off a tip does."""
    if high <= low:
        return 0
    if values.size <= FEW:
        return MOST_LEVELS
    ends = np.quantile(values[:: max(values.size // 4000, 1)], [0.05, 0.95])
    wanted = LEVELS * (high - low) / max(ends[1] - ends[0], (high - low) * LEVELS / MOST_LEVELS)
    return int(min(max(wanted, 254), MOST_LEVELS))


def pack(values: np.ndarray, fine: bool = False) -> tuple[dict[str, Any], bytes]:
    values = np.asarray(values, dtype=float).ravel()
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    top = MOST_LEVELS if fine and high > low else levels_for(known, low, high)
    size = 1 if top <= 254 else 2
    absent = 256**size - 1
    step = (high - low) / top if top else 0.0
    codes = np.full(values.size, absent, dtype=np.int64)
    codes[np.isfinite(values)] = np.rint((known - low) / step) if step else 0
    differences = np.diff(codes, prepend=0) % 256**size
    planes = [(differences >> (8 * plane)).astype(np.uint8).tobytes() for plane in range(size)]
    described = {"count": int(values.size), "low": low, "step": step, "top": top, "bytes": size}
    return described, zlib.compress(b"".join(planes), 9)


def unpack(described: dict[str, Any], packed: bytes) -> np.ndarray:
    """What the page makes of a chunk; for tests and for reading a page back."""
    count, size = described["count"], described["bytes"]
    planes = np.frombuffer(zlib.decompress(packed), dtype=np.uint8).reshape(size, count).astype(np.int64)
    differences = sum(plane << (8 * place) for place, plane in enumerate(planes))
    codes = np.cumsum(differences) % 256**size
    return np.where(codes == 256**size - 1, np.nan, described["low"] + described["step"] * codes)

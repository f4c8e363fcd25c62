"""Numbers as the page holds them: quantised between their ends, differences packed. For looking at, not for computing.

A chunk is told by `{"key", "count", "low", "step", "bytes"}`: value = low + step * code, in codes of 1 or 2 bytes of
which the largest stands for "not there". Codes are written as differences from the one before, low bytes of all first,
then high bytes, by zlib: what varies smoothly along the points packs well.
"""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

FEW = 3000  # so many values may always have two bytes
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


def needs_two_bytes(values: np.ndarray, low: float, high: float) -> bool:
    """Few values, or most of them within a small part of the range, as stress away from the tip of a crack."""
    if values.size <= FEW or high <= low:
        return values.size <= FEW
    ends = np.quantile(values[:: max(values.size // 4000, 1)], [0.05, 0.95])
    return bool((ends[1] - ends[0]) * 254 < LEVELS * (high - low))


def pack(values: np.ndarray, fine: bool = False) -> tuple[dict[str, Any], bytes]:
    values = np.asarray(values, dtype=float).ravel()
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    size = 2 if fine or needs_two_bytes(known, low, high) else 1
    absent = 256**size - 1
    step = (high - low) / (absent - 1) if high > low else 0.0
    codes = np.full(values.size, absent, dtype=np.int64)
    codes[np.isfinite(values)] = np.rint((known - low) / step) if step else 0
    differences = np.diff(codes, prepend=0) % 256**size
    planes = [(differences >> (8 * plane)).astype(np.uint8).tobytes() for plane in range(size)]
    described = {"count": int(values.size), "low": low, "step": step, "bytes": size}
    return described, zlib.compress(b"".join(planes), 9)


def unpack(described: dict[str, Any], packed: bytes) -> np.ndarray:
    """What the page makes of a chunk; for tests and for reading a page back."""
    count, size = described["count"], described["bytes"]
    planes = np.frombuffer(zlib.decompress(packed), dtype=np.uint8).reshape(size, count).astype(np.int64)
    differences = sum(plane << (8 * place) for place, plane in enumerate(planes))
    codes = np.cumsum(differences) % 256**size
    return np.where(codes == 256**size - 1, np.nan, described["low"] + described["step"] * codes)

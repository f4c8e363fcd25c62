"""Which build of the extension this processor takes, where a package holds several (docs/install.md)."""

from __future__ import annotations

import os
from pathlib import Path

from perifrac.errors import Error

#: From the best to the least, with what the system calls what each needs.
SETS = {
    "x86-64-v4": "avx512f avx512bw avx512cd avx512dq avx512vl",
    "x86-64-v3": "avx avx2 bmi1 bmi2 f16c fma abm movbe",
    "x86-64": "",
}


def _features(cpuinfo: Path = Path("/proc/cpuinfo")) -> set[str]:
    """What the system says of the processor; nothing where it says nothing, as in a bare chroot."""
    lines = cpuinfo.read_text(encoding="utf-8").splitlines() if cpuinfo.exists() else []
    return next((set(line.split(":")[1].split()) for line in lines if line.startswith("flags")), set())


def folder_of_extension(package: Path) -> Path:
    """Where it lies: in the package itself, or in the folder of the best set, or of PERIFRAC_INSTRUCTIONS."""
    have = [name for name in SETS if (package / name).is_dir()]
    if not have:
        return package
    features = _features()
    usable = [name for name in have if features.issuperset(SETS[name].split())]
    chosen = os.environ.get("PERIFRAC_INSTRUCTIONS", usable[0] if usable else "")
    if chosen not in usable:
        expected = ", ".join(usable)
        raise Error(f"PERIFRAC_INSTRUCTIONS: '{chosen}' is not what this machine and this package have; "
                    f"expected one of: {expected}")  # fmt: skip
    return package / chosen

"""What the walk of faults shares: scenes of several kinds, and what must hold of a run after a fault."""
import dataclasses
import os
import re
import subprocess
import time
from pathlib import Path

from long_runs import rows
from perifrac_runs import CONFIGS, FLUIDS, PATIENCE, RunTest, checkpoints, datasets, listed_frames, run_command

CHECK = RunTest()
OFTEN = {"output.checkpoint_interval": "0 s"}
# name: scene, keys; each runs for about half a second.
SCENES = {
    "consolidation": (CONFIGS / "terzaghi.yaml", {"time.end": "20 s", "output.times": "[]", "output.interval": "0.5 s"}),
    "dynamic solid": (CONFIGS / "mandel_dynamic.yaml", {"body.spacing": "2 m", "time.end": "3 s", "output.times": "[]",
                                                        "output.interval": "0.1 s"}),
    "tank": (FLUIDS["tank"], {"output.times": "[]", "output.interval": "0.01 s"}),
    "crack driven by fluid": (CONFIGS / "hf_storage.yaml", {"body.spacing": "2.5 mm", "time.end": "15 ms",
                                                            "output.interval": "1 ms"}),
}
# Small scenes need no more memory than the program itself; these run out of it while they run.
LARGE = {
    "large consolidation": (CONFIGS / "terzaghi.yaml", {"body.spacing": "0.25 m", "time.end": "10 ms",
                                                        "output.times": "[]", "output.interval": "1 ms"}),
    "crack driven by fluid": SCENES["crack driven by fluid"],
}
LONGEST = PATIENCE  # [s] of wall time; a run that takes more hangs
# What a user must never see.
NEWS = re.compile(r"^\d\d:\d\d:\d\d info: .*\n", re.MULTILINE)  # of a run that goes well
CRASH = re.compile(r"terminate called|Segmentation|Traceback|std::|Assertion|core dumped|Sanitizer|HDF5-DIAG")


class Fault(AssertionError):
    """What must hold after a fault does not."""


def require(holds, what):
    if not holds:
        raise Fault(what)


@dataclasses.dataclass
class Done:
    code: int
    said: str  # on stderr

    def complaint(self):
        """What it said last, up to its advice, without paths and numbers of files, as `exit CODE: WORDS`."""
        words = self.said.strip().splitlines()[-1].removeprefix("perifrac: ").split(";")[0] if self.said else ""
        return f"exit {self.code}: " + re.sub(r"_\d{6}", "_*", re.sub(r"/\S*/", "", words))


class Scene:
    """A scene, and the run of it that nothing disturbs."""

    def __init__(self, name, holder):
        self.name = name
        self.path, keys = (SCENES | LARGE)[name]
        self.keys = keys | OFTEN
        self.whole = Path(holder) / "whole" / name.replace(" ", "_")
        process = self.start(self.whole)
        self.memory = 0  # [bytes] of address space, at most
        while process.poll() is None:
            self.memory = max(self.memory, address_space(process.pid, "VmPeak"))
            time.sleep(0.002)
        require(process.returncode == 0, f"{name}: {process.communicate()[1]}")
        self.rows = rows(self.whole)
        self.bytes = sum(file.stat().st_size for file in self.whole.rglob("*") if file.is_file())

    def command(self, folder, *options):
        return run_command(self.path, self.keys, folder, "--threads", "2", *options)

    def start(self, folder, *options, **subprocess_options):
        return subprocess.Popen(self.command(folder, *options), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                text=True, **subprocess_options)

    def run(self, folder, *options, **subprocess_options):
        return wait(self.start(folder, *options, **subprocess_options))


def wait_for(moment, scene, folder, process):
    """Until a part of the run's rows is there, or for its beginning (below 0) some tenths of a second."""
    if moment < 0.0:
        time.sleep(-moment)
    while process.poll() is None and rows(folder) < moment * scene.rows:
        time.sleep(0.0005)


def address_space(pid, what="VmSize"):
    """[bytes], 0 of a process that has ended."""
    try:
        return int(re.search(what + r":\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) * 1024
    except (OSError, TypeError):
        return 0


def wait(process):
    """Waits for the end; a hang is a fault."""
    try:
        said = NEWS.sub("", process.communicate(timeout=LONGEST)[1])
    except subprocess.TimeoutExpired as error:
        raise Fault(f"still running after {LONGEST:g} s") from error
    finally:
        process.kill()
    require(not CRASH.search(said), f"said: {said}")
    return Done(process.returncode, said)


def require_word(done, codes, words):
    """A plain end: an expected exit code, one line that holds one of the words."""
    require(done.code in codes, f"exit {done.code}: {done.said}")
    lines = [line for line in done.said.splitlines() if "warning" not in line]
    require(len(lines) == 1 and re.search(words, lines[0]), f"exit {done.code}, said: {done.said!r}")


def require_no_loss(scene, folder):
    """What is complete can be read and is what it should be: frames, rows, checkpoints."""
    whole = {frame.name: when for when, frame in listed_frames(scene.whole)}
    for when, frame in listed_frames(folder):
        same = when == whole.get(frame.name) and datasets(frame) == datasets(scene.whole / "frames" / frame.name)
        require(same, f"{frame.name} at {when} s differs")
    history = Path(folder) / "history.csv"
    if history.exists():
        table = history.read_bytes()
        require(table.endswith(b"\n"), "a torn row in history.csv")
        require((scene.whole / "history.csv").read_bytes().startswith(table), "other rows in history.csv")
    for checkpoint in checkpoints(folder):
        require("scene" in datasets(checkpoint), f"{checkpoint.name} cannot be read")


def require_same_end(scene, folder, *options):
    """Goes on from the last checkpoint, if there is one, and ends like the run that nothing disturbed."""
    latest = checkpoints(folder)[-1:]
    done = scene.run(folder, *(["--restart", str(latest[0])] if latest else []), *options)
    require(done.code == 0, f"the restart: exit {done.code}: {done.said}")
    try:
        CHECK.assert_same_results(scene.whole, folder)
    except AssertionError as error:
        raise Fault(f"after the restart: {error}") from error
    return bool(latest)


def files(folder):
    return {file: file.read_bytes() for file in Path(folder).rglob("*") if file.is_file() and file.name != ".lock"}


def is_writing(folder):
    """Some file is half-written."""
    for place in (folder, os.path.join(folder, "frames")):
        try:
            if any(entry.name.endswith(".tmp") for entry in os.scandir(place)):
                return True
        except OSError:
            pass
    return False

"""The faults: each is done to one run of a scene at a random moment, and tells what came of it."""
import os
import resource
import shutil
import signal
import subprocess
import time

from fault_runs import (address_space, files, is_writing, require, require_no_loss, require_same_end,
                        require_word, wait, wait_for)
from perifrac_runs import checkpoints

NOBODY = 65534
MARGIN = 4096  # [bytes]


def kill(scene, folder, moments):
    """kill -9; every other time while a file is half-written."""
    process = scene.start(folder)
    wait_for(moments.uniform(-0.1, 0.97), scene, folder, process)
    time.sleep(moments.uniform(0.0, 0.005))
    in_writing = False
    if moments.random() < 0.5:
        while process.poll() is None and not in_writing:
            in_writing = is_writing(folder)
    process.kill()
    done = wait(process)
    require(done.said == "" or "warning" in done.said, done.said)
    require_no_loss(scene, folder)
    writing = is_writing(folder)
    restarted = require_same_end(scene, folder)
    return "left a half-written file, which the restart removed" if writing else \
        "restarted" if restarted else "nothing was there yet; begun anew"


def storm(scene, folder, moments):
    """SIGTERM and SIGINT, some hundred a second, from a random moment until the run has ended."""
    process = scene.start(folder)
    wait_for(moments.uniform(-0.1, 0.9), scene, folder, process)
    while process.poll() is None:
        process.send_signal(moments.choice([signal.SIGTERM, signal.SIGTERM, signal.SIGINT]))
        time.sleep(moments.expovariate(300.0))
    done = wait(process)
    early = done.code in (-signal.SIGTERM, -signal.SIGINT)
    require(done.code in (130, 143) or early, f"exit {done.code}: {done.said}")
    require(not early or not checkpoints(folder), "killed by a signal that it should have heeded")
    require_no_loss(scene, folder)
    require_same_end(scene, folder)
    return "before the program had begun; begun anew" if early else "exit 130 or 143, restarted"


def file_limit(scene, folder, moments):
    """Files that cannot grow beyond a random size (ulimit -f)."""
    largest = max(len(content) for content in files(scene.whole).values())
    limit = moments.randrange(largest)
    done = scene.run(folder, restore_signals=False,
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    require_word(done, (1,), "cannot be written: File too large")
    require_no_loss(scene, folder)
    require(not is_writing(folder), "a half-written file was left")
    require_same_end(scene, folder)
    return done.complaint()


def full_disk(scene, folder, moments):
    """A small file system (tmpfs) that fills up; then it is made larger."""
    folder.mkdir(parents=True)
    size = moments.randrange(MARGIN, scene.bytes)
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    subprocess.run(mount, check=True)
    try:
        done = scene.run(folder / "run")
        require_word(done, (1, 2), "No space left on device")
        require_no_loss(scene, folder / "run")
        require(not is_writing(folder / "run"), "a half-written file was left")
        subprocess.run(["mount", "-o", f"remount,size={8 * scene.bytes}", str(folder)], check=True)
        require_same_end(scene, folder / "run")
    finally:
        subprocess.run(["umount", str(folder)], check=True)
    return done.complaint()


def read_only(scene, folder, moments):
    """A folder that becomes read-only at a random moment, or is from the start; as another user than root."""
    root = os.geteuid() == 0
    folder.mkdir(parents=True)
    run = folder / "run"
    run.mkdir()
    (run / "frames").mkdir()
    for place in (folder, run, run / "frames"):
        place.chmod(0o755)
        if root:
            os.chown(place, NOBODY, NOBODY)
    user = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if root else {}
    from_start = moments.random() < 0.2
    locked = [run, run / "frames"] if from_start or moments.random() < 0.5 else [run / "frames"]
    for place in locked if from_start else []:
        place.chmod(0o555)
    process = scene.start(run, **user)
    if not from_start:
        wait_for(moments.uniform(0.0, 0.7), scene, run, process)
        for place in locked:
            place.chmod(0o555)
    done = wait(process)
    require_word(done, (1, 2), "Permission denied")
    require(done.code == 1 or not files(run), "refused, but something was written")
    for place in locked:
        place.chmod(0o755)
    require_no_loss(scene, run)
    require_same_end(scene, run)
    return done.complaint()


def spoil(scene, folder, moments, change):
    """Spoils the last checkpoint: it is refused, nothing is touched, and the one before it serves."""
    shutil.copytree(scene.whole, folder)
    before, last = checkpoints(folder)
    if moments.random() < 0.5:
        before, last = last, before  # an old one may be given too
    last.write_bytes(change(last.read_bytes()))
    untouched = files(folder)
    done = scene.run(folder, "--restart", str(last))
    require_word(done, (2,), "not a checkpoint|damaged or cut short")
    require(files(folder) == untouched, "a refused restart touched the folder")
    last.unlink()
    require_same_end(scene, folder)
    return done.complaint()


def truncated(scene, folder, moments):
    """A checkpoint cut to a random length."""
    return spoil(scene, folder, moments, lambda content: content[:moments.randrange(len(content))])


def flipped(scene, folder, moments):
    """A checkpoint with one bit flipped, anywhere."""
    def flip(content):
        spoilt = bytearray(content)
        spoilt[moments.randrange(len(spoilt))] ^= 1 << moments.randrange(8)
        return bytes(spoilt)
    return spoil(scene, folder, moments, flip)


def out_of_memory(scene, folder, moments):
    """Address space that ends: from the start at a random size, or at a random moment near what is used by then."""
    kind = moments.random()
    if kind < 0.7:
        least = scene.loaders_memory if kind < 0.2 else scene.least_memory
        limit = moments.randrange(least, scene.memory)
        process = scene.start(folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
    else:
        process = scene.start(folder)
        wait_for(moments.uniform(0.0, 0.6), scene, folder, process)
        limit = address_space(process.pid) + moments.randrange(1 << 21) - (1 << 20)
        if process.poll() is None:
            resource.prlimit(process.pid, resource.RLIMIT_AS, (limit, limit))
    done = wait(process)
    if done.code != 0:
        require_word(done, (1, 2), "memory")
    if done.code == 2:  # what is free when it asks is too little for what it foretells
        require(not files(folder), "a run that was refused has written")
    require_no_loss(scene, folder)
    require(not is_writing(folder), "a half-written file was left")
    require_same_end(scene, folder)
    return done.complaint() if done.code else "enough after all"


def two_runs(scene, folder, moments):
    """A second run, new or a restart, into a folder that a run writes into."""
    first = scene.start(folder)
    wait_for(moments.uniform(-0.1, 0.4), scene, folder, first)
    latest = checkpoints(folder)[-1:] if moments.random() < 0.5 else []
    second = scene.start(folder, *(["--restart", str(latest[0])] if latest else []))
    ends = [wait(second), wait(first)]
    codes = sorted(done.code for done in ends)
    require(codes in ([0, 2], [0, 0]), f"exit {codes}: {ends}")
    if codes == [0, 2]:  # the checkpoint may have been superseded before it could be read
        require_word(ends[0] if ends[0].code else ends[1], (2,), "another run is writing into it|No such file")
    require_no_loss(scene, folder)
    require_same_end(scene, folder)
    return "one is refused (exit 2), the other ends well" if codes == [0, 2] else "the first had ended"


FAULTS = {
    "kill -9": kill,
    "SIGTERM and SIGINT, in storms": storm,
    "full disk (tmpfs)": full_disk,
    "full disk (limit of files)": file_limit,
    "folder that becomes read-only": read_only,
    "checkpoint cut short": truncated,
    "checkpoint with one bit flipped": flipped,
    "out of memory": out_of_memory,
    "two runs into one folder": two_runs,
}

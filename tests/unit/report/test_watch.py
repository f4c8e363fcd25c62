"""The page on which a run is watched: what it serves, to whom, and what it can ask of the run.

With the path of the program as an argument a real run is watched too; without, a stand-in process alone.
"""

from __future__ import annotations

import http.client
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse
from pathlib import Path
from typing import Any

import fractured_run
from browser import PATIENCE, BrowserTest

ROOT = Path(__file__).resolve().parents[3]
WATCH = ROOT / "app" / "report" / "watch.py"
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and os.access(sys.argv[1], os.X_OK) else ""
# Says which of the two signals came, and ends with the first that stops it.
STAND_IN = """
import signal, sys
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM, signal.SIGUSR1})
print("ready", flush=True)
while True:
    came = signal.sigwait({signal.SIGTERM, signal.SIGUSR1})
    print(came.name, flush=True)
    if came == signal.SIGTERM:
        break
"""


class Server:
    """`perifrac watch` on a folder, and who asks it."""

    def __init__(self, folder: Path, *words: str) -> None:
        self.process = subprocess.Popen([sys.executable, WATCH, folder, *words], stderr=subprocess.PIPE, text=True)
        self.url = address_in(self.process.stderr)
        self.port, self.token = parts_of(self.url)

    def ask(self, path: str, method: str = "GET", token: str | None = None, **headers: str) -> tuple[int, bytes]:
        return ask(self.port, path, method, self.token if token is None else token, **headers)

    def state(self) -> dict[str, Any]:
        return json.loads(self.ask("/state")[1])

    def end(self) -> int:
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(PATIENCE)
        self.process.stderr.close()
        return code


def address_in(lines: Any) -> str:
    for line in lines:
        if found := re.match(r"watch at (http://127\.0\.0\.1:\d+/#\S+)", line):
            return found[1]
    raise AssertionError("no address")


def parts_of(url: str) -> tuple[int, str]:
    parts = urllib.parse.urlsplit(url)
    return parts.port or 0, parts.fragment


def ask(port: int, path: str, method: str, token: str, **headers: str) -> tuple[int, bytes]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
    sent = {"X-Perifrac-Token": token} | {name.capitalize(): value for name, value in headers.items()}
    connection.request(method, path, headers=sent)
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer.status, content


def start_of(process: int) -> int:
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[19])


def write_progress(folder: Path, process: int, time_reached: float = 0.25, /, **changed: Any) -> None:
    progress = {"begin": 0.0, "end": 1.0, "time": time_reached, "step": 7, "left": 75.0, "process": process,
                "process_start": start_of(process), "host": socket.gethostname()} | changed  # fmt: skip
    summary = fractured_run.summary(2) | {"outcome": "running", "progress": progress, "wall_time": 25.0}
    del summary["reference"]
    (folder / "progress.json").write_text(json.dumps(summary))


class WatchTest(unittest.TestCase):
    def setUp(self) -> None:
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)
        self.folder = self.scratch / "run"
        self.folder.mkdir()

    def serve(self, *words: str) -> Server:
        server = Server(self.folder, *words)
        self.addCleanup(server.end)
        return server

    def begin_run(self, frames: int = 2) -> subprocess.Popen:
        """A process that stands in for a run, and what that would have written so far."""
        process = subprocess.Popen([sys.executable, "-c", STAND_IN], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "ready\n")
        fractured_run.write_frames(self.folder / "frames", 2, 20, 5e-4, fractured_run.TIMES[:frames])
        fractured_run.write_history(self.folder / "history.csv")
        write_progress(self.folder, process.pid)
        return process


class Served(WatchTest):
    def test_progress_history_and_fields(self) -> None:
        self.begin_run()
        server = self.serve()
        state = server.state()
        self.assertEqual((state["outcome"], state["part"], state["title"], state["may"]), ("running", 0.25, "A made-up crack", True))
        self.assertIn(["left", "1 min 15 s"], state["facts"])
        self.assertIn("mass error", state["ledger"])
        self.assertIn("made up", state["warnings"])
        charts = json.loads(server.ask("/charts")[1])["charts"]
        self.assertEqual([c["title"] for c in charts], ["Inlet well pressure", "Crack length"])
        self.assertEqual(charts[0]["series"][0]["y"][0], 3e6)
        fields = json.loads(server.ask("/fields")[1])["fields"]
        self.assertEqual([t["time"] for t in fields["times"]], fractured_run.TIMES[:2])
        chunk = next(s for s in fields["sets"] if s["name"] == "body")["frames"][1]["values"]["damage"]
        code, packed = server.ask(f"/chunk/{chunk['key']}")
        self.assertEqual(code, 200)
        sys.path.insert(0, str(WATCH.parent))
        from chunks import unpack

        self.assertEqual(set(unpack(chunk, packed)), {0.0, 1.0})

    def test_what_comes_while_it_is_watched(self) -> None:
        process = self.begin_run(1)
        server = self.serve()
        first = server.state()
        shutil.rmtree(self.folder / "frames")
        fractured_run.write_frames(self.folder / "frames", 2, 20, 5e-4, fractured_run.TIMES)
        write_progress(self.folder, process.pid, 0.75)
        time.sleep(0.5)
        second = server.state()
        self.assertEqual(second["part"], 0.75)
        self.assertGreater(second["fields_version"], first["fields_version"])
        self.assertEqual(len(json.loads(server.ask("/fields")[1])["fields"]["times"]), 3)
        self.assertEqual(second["charts_version"], first["charts_version"], "no new row, no new chart")

    def test_a_folder_before_during_and_after_a_run(self) -> None:
        server = self.serve()
        self.assertEqual(server.state()["outcome"], "waiting")
        process = self.begin_run()
        time.sleep(0.5)
        self.assertEqual(server.state()["outcome"], "running")
        process.kill()
        process.wait()
        time.sleep(0.5)
        self.assertEqual((server.state()["outcome"], server.state()["may"]), ("gone", False))
        (self.folder / "summary.json").write_text(json.dumps(fractured_run.summary(2)))
        time.sleep(0.5)
        self.assertEqual(server.state()["outcome"], "done")

    def test_broken_files_are_passed_over(self) -> None:
        process = self.begin_run()
        (self.folder / "frames" / "body_000001.hdf").write_bytes(b"cut short")
        (self.folder / "history.csv").write_text("no time\n1\n")
        server = self.serve()
        self.assertEqual(server.state()["outcome"], "running")
        self.assertEqual(server.ask("/fields")[0], 200)
        (self.folder / "progress.json").write_text("{")
        time.sleep(0.5)
        self.assertEqual(server.state()["outcome"], "waiting")
        self.assertIsNone(process.poll())


class Wishes(WatchTest):
    def test_checkpoint_and_stop_reach_the_run(self) -> None:
        process = self.begin_run()
        server = self.serve()
        self.assertEqual(server.ask("/checkpoint", "POST")[0], 202)
        self.assertEqual(process.stdout.readline(), "SIGUSR1\n")
        self.assertEqual(server.ask("/stop", "POST")[0], 202)
        self.assertEqual(process.stdout.readline(), "SIGTERM\n")
        process.wait(PATIENCE)
        self.assertEqual(server.ask("/stop", "POST")[0], 409)

    def test_another_process_of_that_number_is_left_alone(self) -> None:
        process = self.begin_run()
        server = self.serve()
        for changed in ({"process_start": start_of(process.pid) + 1}, {"host": "elsewhere"}, {"process": 1}, {"process": "x"},
                        {"process": -1}):  # fmt: skip
            write_progress(self.folder, process.pid, **changed)
            self.assertEqual(server.ask("/stop", "POST")[0], 409, changed)
        self.assertIsNone(process.poll())

    def test_no_get_asks_anything_of_the_run(self) -> None:
        process = self.begin_run()
        server = self.serve()
        for wish in ("/stop", "/checkpoint"):
            self.assertEqual(server.ask(wish)[0], 404)
        self.assertIsNone(process.poll())


class Guarded(WatchTest):
    def setUp(self) -> None:
        super().setUp()
        self.run_process = self.begin_run()
        self.server = self.serve()

    def test_wrong_token(self) -> None:
        for path, method in (("/state", "GET"), ("/charts", "GET"), ("/fields", "GET"), ("/chunk/0", "GET"), ("/stop", "POST"),
                             ("/checkpoint", "POST")):  # fmt: skip
            for token in ("", "wrong", self.server.token[:-1], self.server.token + "x"):
                code, content = self.server.ask(path, method, token=token)
                self.assertEqual(code, 403, (path, token))
                self.assertIn(b"token", content)
        self.assertIsNone(self.run_process.poll())

    def test_foreign_host_and_origin(self) -> None:
        port = self.server.port
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port + 1}", ""):
            for path, method in (("/", "GET"), ("/state", "GET"), ("/stop", "POST")):
                self.assertEqual(self.server.ask(path, method, host=host)[0], 403, (host, path))
        for origin in ("http://evil.example", "null", f"https://127.0.0.1:{port}", f"http://127.0.0.1:{port}.evil.example"):
            self.assertEqual(self.server.ask("/stop", "POST", origin=origin)[0], 403, origin)
        self.assertEqual(self.server.ask("/state", host=f"localhost:{port}")[0], 200)
        self.assertEqual(self.server.ask("/state", origin=f"http://127.0.0.1:{port}")[0], 200)
        self.assertIsNone(self.run_process.poll())

    def test_no_other_file_is_served(self) -> None:
        for path in ("/../run/history.csv", "/history.csv", "/chunk/../../etc/passwd", "/chunk/-1", "/chunk/%2e%2e", "/chunk/99999999",
                     "/chunk/9999999999999", "/chunk/", "/chunk/²", "//etc/passwd", "/state/", "/?x"):  # fmt: skip
            self.assertEqual(self.server.ask(urllib.parse.quote(path, safe="/%.?-"))[0], 404, path)

    def test_it_listens_on_this_machine_alone(self) -> None:
        listening = [line.split()[1] for line in Path("/proc/net/tcp").read_text().splitlines()[1:] if line.split()[3] == "0A"]
        self.assertIn(f"0100007F:{self.server.port:04X}", listening)
        self.assertNotIn(f"00000000:{self.server.port:04X}", listening)

    def test_the_empty_page_holds_nothing_of_the_run(self) -> None:
        code, page = self.server.ask("/", token="")
        self.assertEqual(code, 200)
        for secret in (self.server.token.encode(), str(self.folder).encode(), b"made-up"):
            self.assertNotIn(secret, page)
        self.assertIsNone(re.search(rb"(src|href)=", page))


class Refused(WatchTest):
    def test_no_folder_and_no_port(self) -> None:
        done = subprocess.run([sys.executable, WATCH, self.scratch / "none"], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("no such folder", done.stderr)
        taken = self.serve()
        done = subprocess.run([sys.executable, WATCH, self.folder, "--port", str(taken.port)], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("expected one that is free", done.stderr)


class InTheBrowser(BrowserTest):
    def test_a_run_that_goes_on_and_ends(self) -> None:
        scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, scratch)
        process = subprocess.Popen([sys.executable, "-c", STAND_IN], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "ready\n")
        fractured_run.write_frames(scratch / "frames", 2, 20, 5e-4, [0.0, 0.5])
        fractured_run.write_history(scratch / "history.csv")
        write_progress(scratch, process.pid)
        server = Server(scratch)
        self.addCleanup(server.end)
        self.open(server.url)
        self.until("document.querySelector('[data-fields]').dataset.shown")
        self.assertEqual(self.ask("document.getElementById('outcome').textContent"), "running")
        self.assertEqual(self.ask("document.getElementById('progress').getAttribute('aria-valuenow')"), "25")
        self.assertEqual(self.text("now"), "t = 500 ms")
        self.assertGreater(self.colours("map"), 20)
        for width in (390, 1400):
            self.open(server.url, width=width, dark=width == 390)
            self.until("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
        fractured_run.write_frames(scratch / "new" / "frames", 2, 20, 5e-4, [0.0, 0.5, 1.0])
        for path in sorted((scratch / "new" / "frames").iterdir()):  # lists last, as a run writes them
            path.replace(scratch / "frames" / path.name)
        self.until(f"{self.part('now')}.textContent === 't = 1 s'")
        self.browser.execute_script("document.querySelector('[data-wish=checkpoint]').click()")
        self.assertEqual(process.stdout.readline(), "SIGUSR1\n")
        self.until("document.getElementById('answer').textContent.includes('checkpoint')")
        self.browser.execute_script("confirm = () => true; document.querySelector('[data-wish=stop]').click()")
        self.assertEqual(process.stdout.readline(), "SIGTERM\n")
        (scratch / "summary.json").write_text(json.dumps(fractured_run.summary(2) | {"outcome": "stopped"}))
        self.until("document.getElementById('outcome').textContent === 'stopped'")
        self.until("document.querySelector('[data-wish=stop]').disabled")


@unittest.skipUnless(PROGRAM, "the program's path was not given")
class WithTheProgram(WatchTest):
    """`perifrac run --watch`: a checkpoint on request changes nothing; a stop ends run and server."""

    def begin(self, *words: str) -> tuple[subprocess.Popen, int, str]:
        command = [PROGRAM, "run", ROOT / "configs/mandel.yaml", "--set", "time.end=1e6 s", "--set", "output.interval=1e5 s",
                   "--set", "coupling.window.largest=0.1 s", "--output", self.folder / "watched", "--no-report", "--threads", "1", *words]  # fmt: skip
        run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        return run, *parts_of(address_in(run.stderr))

    def wait(self, found: Any, what: str) -> Any:
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            if value := found():
                return value
            time.sleep(0.2)
        raise AssertionError(f"not within {PATIENCE} s: {what}")

    def test_watched_run(self) -> None:
        run, port, token = self.begin("--watch")
        state = lambda: json.loads(ask(port, "/state", "GET", token)[1])  # noqa: E731
        self.wait(lambda: state()["progress"].get("step", 0) > 60, "windows")
        self.assertEqual(state()["outcome"], "running")
        self.assertTrue(json.loads(ask(port, "/charts", "GET", token)[1])["charts"])
        folder = self.folder / "watched"
        first = set(folder.glob("checkpoint_*.h5"))
        self.assertEqual(ask(port, "/checkpoint", "POST", token)[0], 202)
        self.wait(lambda: set(folder.glob("checkpoint_*.h5")) - first, "a checkpoint")
        reached = state()["progress"]["step"]
        self.wait(lambda: state()["progress"]["step"] > reached, "it goes on")
        self.assertEqual(ask(port, "/stop", "POST", "wrong")[0], 403)
        self.assertEqual(ask(port, "/stop", "POST", token)[0], 202)
        self.assertEqual(run.wait(PATIENCE), 143)
        self.assertEqual(json.loads((folder / "summary.json").read_text())["outcome"], "stopped")
        self.assertFalse((folder / "progress.json").exists())
        with self.assertRaises(OSError):
            ask(port, "/state", "GET", token)


if __name__ == "__main__":
    unittest.main()

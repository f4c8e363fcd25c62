"""Serves the page on which a run can be watched, on this machine alone; what `perifrac watch DIR` calls.

All but the empty page needs the token of its address, so that others on the machine neither read nor stop the run.
"""

from __future__ import annotations

import argparse
import hmac
import json
import secrets
import signal
import sys
import threading
import time
from html import escape
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from string import Template
from typing import Any

try:
    from page import HERE, fields_fragment, file_parts, palettes
    from watch_data import SIGNALS, WatchedRun
except ModuleNotFoundError as missing:
    sys.exit(f"watch: {missing}; install the Debian packages python3-matplotlib and python3-h5py")

ADDRESS = "127.0.0.1"
TOKEN = "X-Perifrac-Token"
LONGEST_FAREWELL = 3.0  # [s] that an open page has to see the end of the run
ACTIVE = 4.0  # [s]: a page that asked within that time is open
LEAST_BETWEEN_LOOKS = 0.4  # [s]


class Watch(ThreadingHTTPServer):
    """The server and the one run that it shows."""

    daemon_threads = True

    def __init__(self, folder: Path, port: int) -> None:
        super().__init__((ADDRESS, port), Page)
        self.run = WatchedRun(folder)
        self.token = secrets.token_urlsafe(24)
        self.lock = threading.Lock()
        self.looked = -1.0e9
        self.asked = -1.0e9
        self.seen_end = threading.Event()
        self.html = page_text()

    @property
    def own_hosts(self) -> set[str]:
        return {f"{name}:{self.server_port}" for name in (ADDRESS, "localhost")}

    @property
    def url(self) -> str:
        return f"http://{ADDRESS}:{self.server_port}/#{self.token}"

    def look(self) -> None:
        """Held by the lock; several pages share one look."""
        if time.monotonic() - self.looked > LEAST_BETWEEN_LOOKS:
            self.run.refresh()
            self.looked = time.monotonic()

    def state(self) -> dict[str, Any]:
        with self.lock:
            self.asked = time.monotonic()
            self.look()
            state = self.run.state()
        if state["outcome"] not in ("running", "waiting"):
            self.seen_end.set()
        return state

    def charts(self) -> dict[str, Any]:
        with self.lock:
            return {"version": self.run.charts_version, **self.run.charts}

    def fields(self) -> dict[str, Any]:
        with self.lock:
            return {"version": self.run.fields.version, "fields": self.run.fields.data()}

    def chunk(self, name: str) -> bytes | None:
        with self.lock:
            packed = self.run.fields.chunks.packed
            return packed[int(name)] if name.isdecimal() and len(name) < 10 and int(name) < len(packed) else None

    def wish(self, what: str) -> bool:
        with self.lock:
            self.run.refresh()
            return self.run.outcome == "running" and self.run.process.send(what)

    def say_farewell(self) -> None:
        """Lets an open page see how the run ended."""
        if time.monotonic() - self.asked < ACTIVE:
            self.seen_end.clear()
            self.seen_end.wait(LONGEST_FAREWELL)
            time.sleep(0.3)  # charts and fields are asked for after the state


class Page(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server_version = "perifrac"
    sys_version = ""
    timeout = 30
    server: Watch

    def log_message(self, *_: Any) -> None:
        """The terminal belongs to the run."""

    def refused(self) -> tuple[int, str] | None:
        """Names that a foreign page has made point here, pages from elsewhere, and who does not know the token."""
        if self.headers.get("Host") not in self.server.own_hosts:
            return 403, "foreign host"
        origin = self.headers.get("Origin")
        if origin is not None and origin.removeprefix("http://") not in self.server.own_hosts:
            return 403, "foreign origin"
        if self.path != "/" and not hmac.compare_digest(self.headers.get(TOKEN, "").encode(), self.server.token.encode()):
            return 403, "wrong token; open the whole address that the terminal shows"
        return None

    def answer(self, code: int, content: bytes, kind: str) -> None:
        self.send_response(code)
        for name, value in (("Content-Type", kind), ("Content-Length", str(len(content))), ("Cache-Control", "no-store"),
                            ("X-Content-Type-Options", "nosniff"), ("Referrer-Policy", "no-referrer"),
                            ("Cross-Origin-Resource-Policy", "same-origin"), ("X-Frame-Options", "DENY")):  # fmt: skip
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(content)

    def answer_json(self, code: int, data: Any) -> None:
        self.answer(code, json.dumps(data, allow_nan=False).encode(), "application/json")

    def do_GET(self) -> None:  # noqa: N802  named by the library
        if refusal := self.refused():
            return self.answer_json(refusal[0], {"error": refusal[1]})
        if self.path == "/":
            return self.answer(200, self.server.html, "text/html; charset=utf-8")
        known = {"/state": self.server.state, "/charts": self.server.charts, "/fields": self.server.fields}
        if self.path in known:
            return self.answer_json(200, known[self.path]())
        chunk = self.server.chunk(self.path.removeprefix("/chunk/")) if self.path.startswith("/chunk/") else None
        if chunk is None:
            return self.answer_json(404, {"error": "nothing of that name"})
        return self.answer(200, chunk, "application/octet-stream")

    def do_POST(self) -> None:  # noqa: N802
        self.close_connection = True  # what was sent along is not read
        if refusal := self.refused():
            return self.answer_json(refusal[0], {"error": refusal[1]})
        what = self.path[1:]
        if what not in SIGNALS:
            return self.answer_json(404, {"error": "nothing of that name"})
        if not self.server.wish(what):
            return self.answer_json(409, {"error": "no run of this machine is under way there"})
        return self.answer_json(202, {"asked": what})


def page_text() -> bytes:
    """The empty page: it holds nothing of the run."""
    template = Template((HERE / "watch.html").read_text(encoding="utf-8"))
    data = json.dumps({"palettes": palettes()}).replace("<", "\\u003c")
    parts = file_parts("watch.js") | {"fields": fields_fragment(), "data": data, "token_header": escape(TOKEN)}
    return template.substitute(parts).encode("utf-8")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="perifrac watch", description="Serve a page to watch a run on.")
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder that 'perifrac run' writes")
    parser.add_argument("--port", type=int, default=0, help="of 127.0.0.1; 0: one that is free")
    parser.add_argument("--with-run", action="store_true", help="ends with the run that started it")
    options = parser.parse_args(arguments)
    if not options.folder.is_dir():
        print(f"perifrac: {options.folder}: no such folder; expected the folder that 'perifrac run' writes", file=sys.stderr)
        return 2
    try:
        server = Watch(options.folder, options.port)
    except OSError as error:
        print(f"perifrac: port {options.port}: {error.strerror}; expected one that is free", file=sys.stderr)
        return 2
    ended = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ended.set())
    threading.Thread(target=server.serve_forever, daemon=True).start()
    print(f"watch at {server.url}", file=sys.stderr, flush=True)
    ended.wait()
    if options.with_run:
        server.say_farewell()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

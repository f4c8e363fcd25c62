#!/usr/bin/python3
"""What an editor shows of scenes: a YAML language server, given `perifrac schema`, finds nothing in the shipped ones,
marks every wrong one, and completes and explains keys.

Usage: language_server_test.py PERIFRAC FOLDER [unittest's arguments]

The server is fetched into FOLDER by npm, once; exit code 77 where npm is not there.
"""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from catalogue_cases import ROOT, SCHEMA_LINE, TEMPLATES, shipped_scenes, wrong_by_the_catalogue

PERIFRAC = Path(sys.argv.pop(1)).resolve()
FOLDER = Path(sys.argv.pop(1)).resolve()
SERVER = FOLDER / "node_modules/yaml-language-server/bin/yaml-language-server"
VERSION = "1.15.0"


class LanguageServer:
    """Speaks the language server protocol over pipes, one question after the other."""

    def __init__(self):
        self.process = subprocess.Popen(["node", SERVER, "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.count = 0
        self.ask("initialize", processId=None, rootUri=None, capabilities={"textDocument": {"publishDiagnostics": {}}})
        self.tell("initialized")

    def send(self, **message):
        body = json.dumps({"jsonrpc": "2.0"} | message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def tell(self, method, **params):
        self.send(method=method, params=params)

    def messages(self):
        """What the server says, one by one; what it asks is answered by nothing."""
        while True:
            length = 0
            while line := self.process.stdout.readline().strip():
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            if not length:
                raise EOFError("the language server ended")
            message = json.loads(self.process.stdout.read(length))
            if "id" in message and "method" in message:
                self.send(id=message["id"], result=[None] * len(message["params"].get("items", [])) or None)
            yield message

    def ask(self, method, **params):
        self.count += 1
        self.send(id=self.count, method=method, params=params)
        return next(m["result"] for m in self.messages() if m.get("id") == self.count and "method" not in m)

    def diagnostics(self, uri, text):
        self.tell("textDocument/didOpen", textDocument={"uri": uri, "languageId": "yaml", "version": 1, "text": text})
        found = next(m["params"]["diagnostics"] for m in self.messages()
                     if m.get("method") == "textDocument/publishDiagnostics" and m["params"]["uri"] == uri)  # fmt: skip
        return [one["message"] for one in found]

    def close(self):
        self.process.kill()
        self.process.communicate()


class Editor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = Path(holder.name)
        schema = subprocess.run([PERIFRAC, "schema"], capture_output=True, check=True).stdout
        (cls.folder / "perifrac.schema.json").write_bytes(schema)
        cls.server = LanguageServer()
        cls.addClassCleanup(cls.server.close)

    def open(self, name, text):
        """With the first line that names the schema; its messages."""
        self.uri = (self.folder / name).as_uri()
        self.text = text if text.startswith(SCHEMA_LINE) else f"{SCHEMA_LINE}perifrac.schema.json\n{text}"
        return self.server.diagnostics(self.uri, self.text)

    def ask_at(self, method, line, character):
        return self.server.ask(method, textDocument={"uri": self.uri}, position={"line": line, "character": character})

    def test_finds_nothing_in_shipped_scenes(self):
        scenes = shipped_scenes()
        self.assertGreater(len(scenes), 55)
        for path in scenes:
            with self.subTest(path.name):
                text = path.read_text(encoding="utf-8")
                if path.parent == TEMPLATES:  # as `perifrac new` writes them
                    self.assertEqual(self.open(path.name, text), [])
                else:
                    self.assertEqual(self.server.diagnostics(path.as_uri(), text), [])
                    wrong = path.with_name("wrong_" + path.name).as_uri()
                    self.assertNotEqual(self.server.diagnostics(wrong, text + "\nxyzzy: 1\n"), [])

    def test_marks_every_wrong_one(self):
        cases = list(wrong_by_the_catalogue())
        self.assertGreater(len(cases), 30)
        for path, said in cases:
            if path.stem == "merge_key":  # which editors know
                continue
            with self.subTest(path.name):
                self.assertNotEqual(self.open("wrong_" + path.name, path.read_text(encoding="utf-8")), [], said)

    def test_says_what_is_wrong(self):
        scene = (ROOT / "configs/mandel.yaml").read_text(encoding="utf-8")
        for wrong, right, words in (("  porositty: 0.1\n", "  porosity: ", "porositty is not allowed"),
                                    ("dimension: 4\n", "dimension: ", "maximum of 3"), ("  type: darcie\n", "  type: darcy", "darcy")):  # fmt: skip
            with self.subTest(wrong):
                lines = scene.splitlines(keepends=True)
                at = next(n for n, line in enumerate(lines) if line.startswith(right))
                said = self.open(f"{at}.yaml", "".join(lines[:at] + [wrong] + lines[at + 1:]))
                self.assertTrue(any(words in one for one in said), said)

    def test_completes_keys(self):
        self.open("begun.yaml", "dimension: 2\npore_flow:\n  type: darcy\n  perm")
        items = self.ask_at("textDocument/completion", 4, 6)["items"]
        self.assertIn("permeability", [item["label"] for item in items])

    def test_explains_keys(self):
        self.open("explained.yaml", (ROOT / "configs/mandel.yaml").read_text(encoding="utf-8"))
        lines = self.text.split("\n")
        for key, words in (("permeability", "Unit: m^2"), ("porosity", "Range: (0, 1)"), ("end", "Unit: s")):
            line = next(n for n, text in enumerate(lines) if text.startswith(f"  {key}: "))
            shown = self.ask_at("textDocument/hover", line, 4)["contents"]["value"].replace("\\", "")
            self.assertIn(words, shown)


def main():
    if not shutil.which("npm"):
        print("no npm here; `tools/install editor` installs it")
        return 77
    if not SERVER.exists():
        subprocess.run(["npm", "install", "--no-fund", "--no-audit", "--prefix", FOLDER, f"yaml-language-server@{VERSION}"],
                       check=True)  # fmt: skip
    return not unittest.main(exit=False).result.wasSuccessful()


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3
"""The gallery is made by its command, and what is committed is whole: gallery_test.py PERIFRAC"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PERIFRAC = Path(sys.argv.pop(1)).resolve()
DOCS = Path(__file__).resolve().parents[2] / "docs"
LARGEST = 80_000
PICTURE = re.compile(r"!\[[^]]*\]\((images/gallery/(\w+)\.png)\)")


class Gallery(unittest.TestCase):
    def test_made_anew(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder, "gallery.md")
            said = subprocess.run([DOCS / "collect_gallery.py", PERIFRAC, "--page", page, "--runs", Path(folder, "runs"),
                                   "layered_column", "dam_break"], check=True, text=True, capture_output=True).stdout
            self.assertEqual([line.partition(":")[0] for line in said.splitlines()], ["layered_column", "dam_break"])
            self.assertFalse(page.exists())
            for name in ("layered_column", "dam_break"):
                picture = Path(folder, f"images/gallery/{name}.png").read_bytes()
                self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
                self.assertTrue(8_000 < len(picture) <= LARGEST, len(picture))

    def test_committed_page(self):
        page = (DOCS / "gallery.md").read_text(encoding="utf-8")
        shown = PICTURE.findall(page)
        self.assertEqual(len(shown), 12)
        for path, name in shown:
            self.assertLessEqual((DOCS / path).stat().st_size, LARGEST)
            self.assertIn(f"perifrac run --example {name}", page)
            self.assertTrue((DOCS.parent / f"configs/{name}.yaml").exists())
        self.assertEqual({path.stem for path in (DOCS / "images/gallery").iterdir()}, {name for _, name in shown})


if __name__ == "__main__":
    unittest.main()

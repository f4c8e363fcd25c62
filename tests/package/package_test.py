#!/usr/bin/python3
"""The packages that `make package` makes: what they hold, that they run from anywhere, each instruction set, and that
a module outside the tree can be built against them.

Usage: package_test.py SOURCE [--packages DIR] [unittest's arguments]; without DIR they are made first.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
PACKAGES = SOURCE / "build/package/packages"
if "--packages" in sys.argv:
    at = sys.argv.index("--packages")
    PACKAGES = Path(sys.argv.pop(at + 1)).resolve()
    sys.argv.pop(at)
else:
    subprocess.run(["make", "-C", SOURCE, "package"], check=True)

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(perifrac 0.1.0 REQUIRED)
add_executable(outside main.cpp {example}/compaction.cpp)
target_include_directories(outside PRIVATE {source})
target_link_libraries(outside PRIVATE perifrac::perifrac_app)
"""
MAIN = """#include <cstdio>
#include "app/command_line.hpp"
#include "docs/example_module/compaction.hpp"
int main(int argc, char** argv) {
  std::printf("%s\\n", perifrac::compaction_type().name.c_str());
  return perifrac::run_command_line(argc, argv);
}
"""


def run(*words, **more):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, **more)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.deb = next(PACKAGES.glob("perifrac*.deb"))
        subprocess.run(["dpkg-deb", "-x", cls.deb, cls.folder / "deb"], check=True)
        subprocess.run(["tar", "-xf", next(PACKAGES.glob("*.tar.gz")), "-C", cls.folder], check=True)
        cls.portable = next(cls.folder.glob("perifrac-*"))
        cls.usr = cls.folder / "deb/usr"

    def test_holds_what_it_says(self):
        for path in ("bin/perifrac", "share/perifrac/configs/mandel.yaml", "share/perifrac/app/report/report.py",
                     "share/perifrac/app/writing/templates/kgd.yaml", "share/man/man1/perifrac.1.gz",
                     "share/bash-completion/completions/perifrac", "share/zsh/vendor-completions/_perifrac",
                     "share/fish/vendor_completions.d/perifrac.fish", "share/doc/perifrac/copyright",
                     "share/doc/perifrac/configuration.md", "include/perifrac/core/module/physics_module.hpp"):
            self.assertTrue((self.usr / path).exists(), path)
        depends = run("dpkg-deb", "-f", self.deb, "Depends").stdout
        for package in ("libc6", "libhdf5", "libsundials-cvode", "python3-matplotlib", "libudunits2"):
            self.assertIn(package, depends)
        self.assertEqual(list((self.folder / "deb").rglob("__pycache__")), [])

    def check_runs(self, program, **environment):
        with tempfile.TemporaryDirectory() as folder:
            done = run(program, "run", "--example", "terzaghi", "--threads", 1, "--json", cwd=folder,
                       env=os.environ | environment)  # fmt: skip
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((Path(folder) / "runs/terzaghi/report.html").exists())
            self.assertEqual(run(program, "new", "kgd", cwd=folder).returncode, 0)
            return json.loads(done.stdout)

    def test_runs_from_where_it_lies(self):
        for prefix in (self.usr, self.portable):
            self.check_runs(prefix / "bin/perifrac")
        libraries = run("ldd", next(p for p in self.portable.rglob("perifrac") if p.is_file() and p.stat().st_size > 3e6
                                    and os.access(p, os.X_OK))).stdout  # fmt: skip
        outside = [line.split()[0] for line in libraries.splitlines() if "=> /" in line and str(self.portable) not in line]
        self.assertLessEqual(set(outside), {"libc.so.6", "libm.so.6", "libresolv.so.2"}, "those of the C library alone")

    def test_every_instruction_set_runs(self):
        sets = sorted(path.name for path in (self.usr / "libexec/perifrac").glob("*"))
        if not sets:
            self.skipTest("built for one processor")
        self.assertEqual(sets, ["x86-64", "x86-64-v3", "x86-64-v4"])
        words = {"x86-64": "SSE2", "x86-64-v3": "AVX2", "x86-64-v4": "AVX-512"}
        errors = []
        for name in sets:
            done = run(self.usr / "bin/perifrac", "list", env=os.environ | {"PERIFRAC_INSTRUCTIONS": name})
            if done.returncode == 2:
                self.assertIn("expected one of", done.stderr)  # this processor lacks it
                continue
            said = self.check_runs(self.usr / "bin/perifrac", PERIFRAC_INSTRUCTIONS=name)
            self.assertTrue(said["build"]["instructions"].startswith(words[name]))
            errors.append(said["ledger"]["mass_error"])
        self.assertLess(max(errors), 1e-12)
        none = run(self.usr / "bin/perifrac", "list", env=os.environ | {"PERIFRAC_INSTRUCTIONS": "x86-64-v9"})
        self.assertEqual((none.returncode, none.stderr.count("\n")), (2, 1))

    def test_modules_outside_the_tree_are_built(self):
        project = self.folder / "outside"
        project.mkdir()
        # Sources of the tree would hide headers that the package lacks: only the example is taken along.
        example = project / "tree/docs/example_module"
        subprocess.run(["mkdir", "-p", example.parent], check=True)
        subprocess.run(["cp", "-r", SOURCE / "docs/example_module", example], check=True)
        (project / "CMakeLists.txt").write_text(PROJECT.format(example=example, source=project / "tree"))
        (project / "main.cpp").write_text(MAIN)
        made = run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.usr}")
        self.assertEqual(made.returncode, 0, made.stderr)
        made = run("cmake", "--build", project / "build")
        self.assertEqual(made.returncode, 0, made.stdout[-3000:])
        said = run(project / "build/outside", "--version")
        self.assertEqual((said.returncode, said.stdout.splitlines()), (0, ["compaction", "perifrac 0.1.0"]))


if __name__ == "__main__":
    unittest.main()

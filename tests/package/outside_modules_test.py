#!/usr/bin/python3
"""Modules and materials outside the tree: what `perifrac new module` writes is built against an installed program,
runs, and each way in which a library does not fit is one line and exit code 2.

Usage: outside_modules_test.py CMAKE BUILD [unittest's arguments]
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CMAKE = sys.argv.pop(1)
BUILD = Path(sys.argv.pop(1)).resolve()

THROWING = """#include <stdexcept>
#include "core/module/outside_modules.hpp"
extern "C" void perifrac_modules(std::vector<perifrac::ModuleType>&) { throw std::runtime_error("no licence\\nfound"); }
"""
THROWING_EARLY = """#include <stdexcept>
#include "core/module/outside_modules.hpp"
namespace { const int value = [] { if (true) throw std::runtime_error("at the start"); return 1; }(); }
"""
LACKING = """#include "core/module/outside_modules.hpp"
namespace perifrac { ModuleType not_there_type(); }
PERIFRAC_MODULES(perifrac::not_there_type())
"""
EMPTY = """#include "core/module/outside_modules.hpp"
"""
# The laws of unit tests under words of scenes, and one whose stress beyond the linear is too large.
LAWS = f'''#include "{Path(__file__).resolve().parents[2] / "tests/unit/solid/nonlinear_laws.hpp"}"
#include "modules/solid/material/law_material.hpp"
#include "modules/solid/material/outside_materials.hpp"
''' + """namespace perifrac {
template <int D>
struct Stiffening : test::Stiffening<D> {
  static Stiffening read(const Section&, const IsotropicElasticity<D>& rock) {
    return {{rock, 1e4 * rock.shear_modulus}};
  }
};
template <int D>
struct Mistaken : test::Stiffening<D> {
  static Mistaken read(const Section&, const IsotropicElasticity<D>& rock) {
    return {{rock, 1e4 * rock.shear_modulus}};
  }
  Tensor<D, D> stress(const Tensor<D, D>& g) const {
    const Tensor<D, D> linear = this->rock.stress(g);
    return linear + 1.5 * (test::Stiffening<D>::stress(g) - linear);
  }
};
template <int D>
struct Flowing : test::Hardening<D> {
  static Flowing read(const Section&, const IsotropicElasticity<D>& rock) { return {{rock, 5e6, 2e9}}; }
};
}
PERIFRAC_MATERIALS(perifrac::law_material<perifrac::Stiffening>("stiffening", "stiffens"),
                   perifrac::law_material<perifrac::Mistaken>("mistaken", "is mistaken"),
                   perifrac::law_material<perifrac::Flowing>("hardening", "flows"))
"""
PLATE = """modules: [LIBRARY]
dimension: 2
body: {shape: box, size: [10 m, 10 m], spacing: 1 m}
solid:
  type: TYPE
  density: 2000 kg/m^3
  material: {type: NAME, lame_lambda: 4 GPa, shear_modulus: 3 GPa}
  boundary:
    left: {type: roller}
    bottom: {type: roller}
    top: {type: roller}
    right: {type: traction, traction: [20 MPa, 0 Pa]}
time: {end: 0.05 s}
"""


def run(*words, **more):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, **more)


class OutsideModules(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.prefix = cls.folder / "usr"
        for component in ("set", "program", "development"):
            subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.prefix, "--component", component],
                           check=True, stdout=subprocess.DEVNULL)  # fmt: skip
        cls.program = cls.prefix / "bin/perifrac"
        cls.rock = cls.new("module", "my_rock")

    @classmethod
    def new(cls, kind, name):
        done = run(cls.program, "new", kind, name, cwd=cls.folder)
        assert done.returncode == 0, done.stderr
        cls.build(cls.folder / name)
        return cls.folder / name

    @classmethod
    def build(cls, project, *targets):
        # Not with the launcher of compilers that the environment may name: as somebody else's machine has it.
        # Unoptimised, which builds sooner: what is tried is whether they fit, not how fast they are.
        made = run(CMAKE, "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={cls.prefix}", "-DCMAKE_BUILD_TYPE=Release",
                   "-DCMAKE_CXX_FLAGS_RELEASE=-O0")  # fmt: skip
        assert made.returncode == 0, made.stderr
        made = run(CMAKE, "--build", project / "build", *targets)
        assert made.returncode == 0, made.stdout[-4000:]

    def library(self, name, source):
        """A library of that one source."""
        project = self.folder / name
        project.mkdir()
        (project / "library.cpp").write_text(source)
        (project / "CMakeLists.txt").write_text(
            f"""cmake_minimum_required(VERSION 3.25)
project({name} LANGUAGES CXX)
find_package(perifrac REQUIRED COMPONENTS modules)
perifrac_add_module({name} library.cpp)
"""
        )
        self.build(project)
        return project / f"build/lib{name}.so"

    def run_scene(self, scene, *options, verb="run"):
        self.output = self.folder / f"out_{self.id().rsplit('.', 1)[-1]}"
        words = ["--output", self.output, "--no-report"] if verb == "run" else ["--trial", 0]
        return run(self.program, verb, scene, *words, "--threads", 1, *options)

    def refused(self, text, *expected, options=("--allow-modules",)):
        """One line that places what it says at the scene's list; nothing written."""
        scene = self.rock / "wrong.yaml"
        written = (self.rock / "scene.yaml").read_text().splitlines()
        scene.write_text("\n".join([text] + written[1:]))
        for verb in ("run", "check"):
            done = self.run_scene(scene, *options, verb=verb)
            self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (2, 1, ""), done.stderr)
            self.assertRegex(done.stderr, re.escape(str(scene)) + r":\d+:\d+: modules")
            for words in expected:
                self.assertIn(words, done.stderr)
            self.assertFalse(self.output.exists())

    def test_runs_and_settles(self):
        """Drained at the end, every point is a spring under the overburden: dilatation -q / stiffness."""
        done = self.run_scene(self.rock / "scene.yaml", "--allow-modules", "--set", "time.end=1e6 s",
                              "--set", "coupling.window.largest=2e4 s")  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        stored = [float(value) for key, value in self.history().items() if key.startswith("energy_stored")]
        q, stiffness, area = 1e6, 1.2e9, 160.0
        self.assertAlmostEqual(stored[0] / (0.5 * q * q / stiffness * area), 1.0, delta=1e-6)

    def test_is_the_module_in_the_tree(self):
        """The contract suite that the folder brings, against the installed libraries."""
        self.build(self.rock, "--target", "my_rock_test")
        done = run(self.rock / "build/my_rock_test", "--gtest_brief=1")
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])
        self.assertRegex(done.stdout, r"\d\d tests")

    def test_needs_the_users_word(self):
        self.refused("modules: [build/libmy_rock.so]", "expected --allow-modules", options=())

    def test_missing_file(self):
        self.refused("modules: [./libnone.so]", "modules[0]: './libnone.so' is not there")

    def test_no_library(self):
        self.refused("modules: [my_rock.cpp]", "is no library of modules")
        self.refused("modules: [.]", "is no library of modules")

    def test_other_build(self):
        library = self.rock / "build/libmy_rock.so"
        stamp = b"built-as:perifrac "
        for before, after in ((stamp + b"0.1.0", stamp + b"9.9.9"), (b", compiler ", b", compiled ")):
            other = self.rock / "build/libother.so"
            other.write_bytes(library.read_bytes().replace(before, after))
            self.refused("modules: [build/libother.so]", "was built as 'perifrac", "build it anew")

    def test_duplicate_name(self):
        (self.rock / "build/libagain.so").write_bytes((self.rock / "build/libmy_rock.so").read_bytes())
        self.refused("modules: [build/libmy_rock.so, build/libagain.so]", "modules[1]", "there is one already")

    def test_exceptions(self):
        self.refused(f"modules: [{self.library('throwing', THROWING)}]", "threw an exception", "no licence found")
        self.refused(f"modules: [{self.library('early', THROWING_EARLY)}]", "threw an exception", "at the start")

    def test_lacking(self):
        self.refused(f"modules: [{self.library('lacking', LACKING)}]", "cannot be loaded", "not_there_type")
        self.refused(f"modules: [{self.library('empty', EMPTY)}]", "shows nothing")

    def test_no_list(self):
        for text in ("modules: build/libmy_rock.so", "modules: []", "modules: [[a]]"):
            self.refused(text, "text")

    def test_wrong_keys_of_it_are_told(self):
        scene = self.rock / "wrong_key.yaml"
        scene.write_text((self.rock / "scene.yaml").read_text().replace("stiffness:", "stifness:"))
        done = self.run_scene(scene, "--allow-modules")
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'stiffness'", done.stderr)

    def history(self):
        with open(self.output / "history.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))[-1]

    def column(self, name):
        """The last value of history.csv's column."""
        return [float(value) for key, value in self.history().items() if key.split(" [")[0] == name][0]

    def test_anisotropic_material(self):
        """Stretched by sigma / (lambda + 2 mu + k), as the scene's first lines say."""
        law = self.new("material", "my_law")
        done = self.run_scene(law / "scene.yaml", "--allow-modules")
        self.assertEqual(done.returncode, 0, done.stderr)
        stretch = [float(value) for key, value in self.history().items() if "dilatation" in key][0]
        self.assertAlmostEqual(stretch / 1e-4, 1.0, delta=1e-9)
        self.build(law, "--target", "my_law_test")
        done = run(law / "build/my_law_test", "--gtest_brief=1")
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])

    def plate(self, name, kind):
        if not hasattr(OutsideModules, "laws"):
            OutsideModules.laws = self.library("laws", LAWS)
        scene = self.folder / f"{name}_{kind}.yaml"
        words = {"LIBRARY": str(self.laws), "TYPE": kind, "NAME": name}
        text = PLATE
        for word, value in words.items():
            text = text.replace(word, value)
        scene.write_text(text)
        return scene

    def test_nonlinear_material(self):
        """In equilibrium it is stretched as its law says; with inertia its energy is kept."""
        done = self.run_scene(self.plate("stiffening", "quasi_static"), "--allow-modules")
        self.assertEqual(done.returncode, 0, done.stderr)
        soft, hard, pull, stretch = 10e9, 3e13, 20e6, 2e-3
        for _ in range(20):
            stretch -= (soft * stretch + hard * stretch**3 - pull) / (soft + 3 * hard * stretch**2)
        expected = 100.0 * (soft * stretch**2 / 2 + hard * stretch**4 / 4)
        self.assertAlmostEqual(self.column("energy_stored") / expected, 1.0, delta=1e-9)
        self.assertGreater(abs(100.0 * pull**2 / soft / 2 / expected - 1.0), 1e-2, "is linear")
        scene = self.plate("stiffening", "dynamic")
        done = self.run_scene(scene, "--allow-modules", "--overwrite", "--set", "solid.integrator.safety=0.2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(self.column("energy_error"), 3e-4)

    def test_material_with_a_memory(self):
        """What it remembers is in frames, restart files and the ledger."""
        scene = self.plate("hardening", "quasi_static")
        text = scene.read_text().replace("[20 MPa, 0 Pa]}", "[20 MPa, 0 Pa], schedule: {ramp: 0.05 s}}")
        scene.write_text(text + "coupling: {window: {first: 1 ms, growth: 1, largest: 1 ms}}\noutput: {times: [0.05 s]}\n")
        done = self.run_scene(scene, "--allow-modules")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(self.column("energy_dissipated"), 0.05 * self.column("energy_gained"))
        self.assertLess(self.column("energy_error"), 1e-3)
        done = run(self.program, "info", "--json", next(self.output.rglob("body_*.hdf")))
        self.assertIn("material_memory", done.stdout)

    def test_a_law_that_is_none(self):
        done = self.run_scene(self.plate("mistaken", "dynamic"), "--allow-modules")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("is not the derivative of its energy", done.stderr)

    def test_studies_load_them(self):
        study = self.rock / "study.yaml"
        study.write_text("""scene: scene.yaml
set: {time.end: 1000 s}
axes:
  - {name: stiffness, key: solid.stiffness, values: [1 GPa, 2 GPa], problem: true}
  - {name: spacing, key: body.spacing, values: [1 m, 0.8 m]}
error: {against: finer, columns: [energy_stored], finer: {body.spacing: 0.5 m}}
repetitions: 1
""")
        for options, code in (((), 2), (("--allow-modules",), 0)):
            done = run(self.program, "study", study, "--no-report", "--output", self.folder / "study", *options)
            self.assertEqual(done.returncode, code, done.stderr)

    def test_new_says_what_it_cannot_write(self):
        for words, expected in (
            (("module",), "the name is missing"),
            (("module", "My-Rock"), "is no name"),
            (("module", "my_rock"), "is there already"),
            (("kgd", "my_rock"), "stands beside a scene"),
        ):
            done = run(self.program, "new", *words, cwd=self.folder)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(expected, done.stderr)


if __name__ == "__main__":
    for launcher in ("CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_C_COMPILER_LAUNCHER"):
        os.environ.pop(launcher, None)
    unittest.main()

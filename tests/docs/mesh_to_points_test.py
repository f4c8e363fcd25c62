#!/usr/bin/python3
"""docs/mesh_to_points: meshes as meshio writes them become bodies of points that the program takes."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import meshio
import numpy as np

PERIFRAC = Path(sys.argv.pop(1)).resolve()
SCRIPT = Path(__file__).resolve().parents[2] / "docs/mesh_to_points/mesh_to_points.py"
REST = """dimension: {0}
solid:
  type: quasi_static
  material: {{youngs_modulus: 10 GPa, poisson_ratio: 0.25}}
  boundary:
    left: {{type: roller}}
    bottom: {{type: roller}}
{1}time: {{end: 1 s}}
output: {{interval: 1 s}}
"""
HELD = {2: "", 3: "    front: {type: roller}\n"}


def squares(count):
    """Corners of 2 count by count squares with edges of 0.1 m, those inside moved a little, and the squares."""
    x, y = np.meshgrid(np.arange(2 * count + 1), np.arange(count + 1), indexing="ij")
    moved = np.random.default_rng(1).uniform(-0.1, 0.1, (2, *x.shape))
    inside = (x > 0) & (x < 2 * count) & (y > 0) & (y < count) & (y != count // 2)
    corners = np.stack([x + inside * moved[0], y + inside * moved[1], 0 * x], axis=-1).reshape(-1, 3) * 0.1
    place = np.arange(len(corners)).reshape(x.shape)
    return corners, np.stack([place[:-1, :-1], place[1:, :-1], place[1:, 1:], place[:-1, 1:]], axis=-1).reshape(-1, 4), place


class MeshToPoints(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def scene(self, mesh, name, dimension=2, volumes="file", **how):
        """What the script prints, as a scene; and what check says of it."""
        if mesh is not None:
            mesh.write(self.folder / name, **how)
        said = subprocess.run(["/usr/bin/python3", SCRIPT, name, "rock"], cwd=self.folder, check=True, text=True,
                              capture_output=True).stdout
        (self.folder / "scene.yaml").write_text(said + REST.format(dimension, HELD[dimension]))
        check = subprocess.run([PERIFRAC, "check", "scene.yaml", "--trial", "0", "--set", f"body.volumes={volumes}"], cwd=self.folder, text=True, check=False,
                               capture_output=True)
        self.assertEqual((check.returncode, check.stderr), (0, ""), said)
        return said, check.stdout

    def points(self):
        return np.loadtxt(self.folder / "rock.csv", delimiter=",", skiprows=1)

    def test_gmsh_with_groups_and_a_line_out_of_order(self):
        corners, cells, place = squares(10)
        line = place[4:13, 5]  # along the border of both groups
        pairs = np.column_stack([line[:-1], line[1:]])[[3, 0, 7, 1, 2, 5, 4, 6]]
        pairs[::2] = pairs[::2, ::-1]
        upper = corners[cells].mean(axis=1)[:, 1] > 0.5
        tags = [np.where(upper, 2, 1), np.full(len(pairs), 3)]
        mesh = meshio.Mesh(corners, [("quad", cells), ("line", pairs)],
                           cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
                           field_data={"shale": np.array([1, 2]), "sand": np.array([2, 2]), "natural": np.array([3, 1])})
        said, check = self.scene(mesh, "rock.msh", file_format="gmsh22")
        self.assertIn("sand: {from: [0.0, 0.5], to: [2.0, 1.0]}", said)
        self.assertIn("shale: {from: [0.0, 0.0], to: [2.0, 0.5]}", said)
        self.assertIn("200 points, 8 crack points", check)
        points = self.points()
        self.assertAlmostEqual(points[:, 2].sum(), 2.0, delta=1e-9)
        self.assertGreater(np.ptp(points[:, 2]), 1e-3)
        crack = np.loadtxt(self.folder / "rock_natural.csv", delimiter=",", skiprows=1)
        np.testing.assert_allclose(np.abs(np.diff(crack, axis=0)), [[0.1, 0.0]] * 8, atol=1e-12)

    def test_vtu_of_triangles_with_regions(self):
        corners, cells, _ = squares(10)
        halves = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
        region = (corners[halves].mean(axis=1)[:, 1] > 0.5).astype(int)
        mesh = meshio.Mesh(corners, [("triangle", halves)], cell_data={"region": [region]})
        said, check = self.scene(mesh, "rock.vtu", volumes="voronoi")
        self.assertIn("region_1: {from: [0.0, 0.5]", said)
        self.assertNotIn("cracks", said)
        self.assertIn("400 points", check)

    @unittest.skipUnless(shutil.which("gmsh"), "gmsh is not installed")
    def test_even_stress_on_the_page_s_mesh(self):
        """What docs/point_clouds.md says of points that come in pairs."""
        subprocess.run(["gmsh", "-2", SCRIPT.parent / "rock.geo", "-o", "rock.msh"], cwd=self.folder, check=True,
                       capture_output=True)
        said, _ = self.scene(None, "rock.msh", volumes="voronoi")
        for line in ("sand: {from: [0.0, 0.1], to: [0.4, 0.3]}", "- {name: natural, file: rock_natural.csv}"):
            self.assertIn(line, said)
        for volumes, ratio, off in (("voronoi", 2.5, 0.028), ("file", 3, 0.016)):
            keys = (f"body.volumes={volumes}", f"body.horizon_ratio={ratio}", "cracks=[]",
                    "solid.boundary.top={type: traction, traction: [0 MPa, -1 MPa]}")
            subprocess.run([PERIFRAC, "run", "scene.yaml", "--no-report", "--output", volumes,
                            *(word for key in keys for word in ("--set", key))], cwd=self.folder, check=True,
                           capture_output=True)
            with h5py.File(self.folder / volumes / "frames/body_000001.hdf") as frame:
                stress = frame["VTKHDF/PointData/effective_stress"][()]
            worst = np.abs(stress / 1e6 - [0, 0, 0, -1]).max()
            print(f"{volumes}, horizon ratio {ratio}: {len(stress)} points, stress off by {worst:.1%}", file=sys.stderr)
            self.assertTrue(off / 1.5 < worst < 1.5 * off, worst)  # another Gmsh makes another mesh

    def test_what_export_writes(self):
        subprocess.run([PERIFRAC, "run", "--example", "layered_column", "--until", "1 s", "--no-report", "--output", "run"],
                       cwd=self.folder, check=True, capture_output=True)
        subprocess.run([PERIFRAC, "export", "run"], cwd=self.folder, check=True, capture_output=True)
        said, check = self.scene(None, "run/export/body_000001.vtu")
        self.assertIn("region_1: {from: [0.0, 30.0]", said)
        self.assertIn("200 points", check)

    def test_solid(self):
        axis = np.arange(6)
        at = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3) * 0.2
        place = np.arange(216).reshape(6, 6, 6)
        low = [place[i:i + 5, j:j + 5, k:k + 5].reshape(-1) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
        said, check = self.scene(meshio.Mesh(at, [("hexahedron", np.stack(low, axis=-1))]), "rock.vtu", 3)
        np.testing.assert_allclose(self.points()[:, 3], 0.008, rtol=1e-9)
        self.assertIn("125 points", check)


if __name__ == "__main__":
    unittest.main()

"""Weight functions of a straight crack that grows down from a notch in a rectangular plate.

Half of the plate (the crack lies on the axis x = 0) in bilinear finite elements; the nodes on the
axis are condensed out. Factored from the mouth down, the condensed stiffness gives the crack's
compliance at every length at once, and each row of the inverse factor is a weight function,
dC/dc = (2/E') m m: K_I = int m(s, c) p(s) ds for a crack of length c under the pressure p(s), s from
the mouth. Away from the tip m = (2/(pi (c - s)))^(1/2) M, M(s/c, c) = 1 + sum M_k (1 - s/c)^k is
smooth: M_k(c) are fitted, and so is K_I for unit load of the notch's walls and of the outer faces.
Plane strain, SI, per metre of thickness, pressures and stresses positive in compression.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg
from scipy.interpolate import CubicSpline

Array = np.ndarray
TERMS = 5  # of M beside 1
HALF_PLANE = 1.1215  # K_I/(p (pi c)^(1/2)) of an edge crack much shorter than all else


@dataclass
class Plate:
    width: float = 0.150
    height: float = 0.200
    notch_width: float = 0.004
    notch_depth: float = 0.010  # 0: no notch
    young: float = 700e6
    poisson: float = 0.25
    outer: str = "stress"  # left, right, bottom: `stress` constant, or `rollers` held once confined
    longest: float = 0.175  # crack tabulated [m]

    @property
    def modulus(self) -> float:
        return self.young / (1 - self.poisson**2)


def spacing(total: float, first: float, growth: float, largest: float) -> Array:
    """Coordinates 0 to total: cells growing from `first` to `largest`."""
    widths, width = [], first
    while sum(widths) < total:
        widths.append(width)
        width = min(width * growth, largest)
    widths = np.array(widths) * (total / sum(widths))
    return np.concatenate(([0.0], np.cumsum(widths)))


def element_stiffness(a: Array, b: Array, young: float, poisson: float) -> Array:
    """Of bilinear rectangles a x b, corners counter-clockwise, plane strain: one 8 x 8 each."""
    factor = young / ((1 + poisson) * (1 - 2 * poisson))
    D = factor * np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]])
    K, g = np.zeros((len(a), 8, 8)), 1 / np.sqrt(3)
    for xi, eta in ((-g, -g), (g, -g), (g, g), (-g, g)):
        dx = np.array([-(1 - eta), 1 - eta, 1 + eta, -(1 + eta)]) / (2 * a[:, None])
        dy = np.array([-(1 - xi), -(1 + xi), 1 + xi, 1 - xi]) / (2 * b[:, None])
        B = np.zeros((len(a), 3, 8))
        B[:, 0, 0::2], B[:, 1, 1::2], B[:, 2, 0::2], B[:, 2, 1::2] = dx, dy, dy, dx
        K += B.transpose(0, 2, 1) @ D @ B * (a * b / 4)[:, None, None]
    return K


class Mesh:
    """Half of the plate: x from the axis, y up from the bottom; no elements in the notch."""

    def __init__(self, plate: Plate, fine: float):
        """`fine`: twice the cell at the mouth, a fifth of the cells further down the path."""
        self.plate = plate
        half, floor = plate.width / 2, plate.height - plate.notch_depth
        if plate.notch_depth > 0:
            inner = spacing(plate.notch_width / 2, fine / 2, 1.1, 2 * fine)
            outer = spacing(half - plate.notch_width / 2, inner[-1] - inner[-2], 1.1, half / 30)
            self.x = np.concatenate((inner, plate.notch_width / 2 + outer[1:]))
            above = floor + spacing(plate.notch_depth, fine / 2, 1.15, plate.notch_depth / 8)
        else:
            self.x = spacing(half, fine / 2, 1.1, half / 30)
            above = np.array([floor])
        path = spacing(plate.longest, fine / 2, 1.07, 5 * fine)
        rest = spacing(floor - plate.longest, 5 * fine, 1.15, plate.height / 40)
        below = floor - np.concatenate((path, plate.longest + rest[1:]))
        self.y = np.concatenate((below[::-1], above[1:]))
        self.floor_row, self.path_rows = len(below) - 1, len(path)
        self.notch_column = int(np.searchsorted(self.x, plate.notch_width / 2 - 1e-12))
        self.columns, self.rows = len(self.x), len(self.y)

    def node(self, column, row):
        return row * self.columns + column

    def in_notch(self, column, row):
        """The element up and right of a node."""
        return (row >= self.floor_row) & (column < self.notch_column) & (self.plate.notch_depth > 0)

    def stiffness(self) -> scipy.sparse.csc_matrix:
        column, row = np.meshgrid(np.arange(self.columns - 1), np.arange(self.rows - 1))
        solid = ~self.in_notch(column, row)
        column, row = column[solid], row[solid]
        corner = self.node(column, row)
        nodes = corner[:, None] + np.array([0, 1, 1 + self.columns, self.columns])
        dofs = np.repeat(2 * nodes, 2, axis=1) + np.tile((0, 1), 4)
        K = element_stiffness(np.diff(self.x)[column], np.diff(self.y)[row],
                              self.plate.young, self.plate.poisson)  # fmt: skip
        size = 2 * self.columns * self.rows
        where = np.repeat(dofs, 8, axis=1).ravel(), np.tile(dofs, 8).ravel()
        return scipy.sparse.csc_matrix((K.ravel(), where), shape=(size, size))

    @staticmethod
    def shares(coordinates: Array) -> Array:
        """Length of line that each node carries."""
        widths = np.diff(coordinates)
        return (np.concatenate(([0.0], widths)) + np.concatenate((widths, [0.0]))) / 2

    def lateral(self) -> Array:
        """Nodal forces of unit pressure on the right-hand face."""
        f = np.zeros(2 * self.columns * self.rows)
        f[2 * self.node(self.columns - 1, np.arange(self.rows))] = -self.shares(self.y)
        return f

    def vertical(self) -> Array:
        """Of unit pressure on the top face, balanced by uniform pressure on the bottom."""
        f = np.zeros(2 * self.columns * self.rows)
        first = self.notch_column if self.plate.notch_depth > 0 else 0
        top = self.shares(self.x[first:])
        f[2 * self.node(np.arange(first, self.columns), self.rows - 1) + 1] = -top
        bottom = self.shares(self.x) / self.x[-1]
        f[2 * np.arange(self.columns) + 1] = bottom * top.sum()
        return f

    def notch(self) -> Array:
        """Of unit pressure on the notch's wall and floor, balanced on the bottom."""
        f = np.zeros(2 * self.columns * self.rows)
        if self.plate.notch_depth == 0:
            return f
        wall = np.arange(self.floor_row, self.rows)
        f[2 * self.node(self.notch_column, wall)] = self.shares(self.y[self.floor_row:])
        floor = self.shares(self.x[: self.notch_column + 1])
        f[2 * self.node(np.arange(self.notch_column + 1), self.floor_row) + 1] = -floor
        f[2 * np.arange(self.columns) + 1] += self.shares(self.x) / self.x[-1] * floor.sum()
        return f


@dataclass
class WeightFunctions:
    """Splines of the crack length c."""

    plate: Plate
    terms: CubicSpline  # M_1 ... M_TERMS
    unit: CubicSpline  # K_I/c^(1/2) under unit pressure in the notch, on left and right, on top
    notch_compliance: float  # growth of the notch [m^2] per pressure [Pa] without crack


def held(mesh: Mesh, outer: str) -> Array:
    """Displacements held beside those of the axis."""
    if outer == "stress":  # one node against rigid motion, it carries nothing
        return np.array([2 * mesh.node(mesh.columns - 1, 0) + 1])
    right = 2 * mesh.node(mesh.columns - 1, np.arange(mesh.rows))
    return np.concatenate((right, 2 * np.arange(mesh.columns) + 1))


def condense(mesh: Mesh, K, fixed: Array, loads: Array, axis: Array) -> tuple[Array, Array, Array]:
    """Stiffness and loads of the path's nodes on the axis, and loads . displacement, axis held."""
    used = np.asarray(K.diagonal()) > 0
    free = used.copy()
    free[fixed] = False
    free[axis] = False
    free = np.flatnonzero(free)
    solve = scipy.sparse.linalg.splu(K[free][:, free])
    path = 2 * mesh.node(0, mesh.floor_row - np.arange(mesh.path_rows))
    coupling = K[free][:, path].toarray()
    S = K[path][:, path].toarray() - coupling.T @ solve.solve(coupling)
    moved = solve.solve(loads[free])
    return S, loads[path] - coupling.T @ moved, loads[free].T @ moved


@dataclass
class Axis:
    """The path's nodes on the axis, all else condensed out."""

    s: Array  # from the mouth [m]
    stiffness: Array  # of half the plate
    tractions: Array  # on the held axis, under unit pressure in the notch, lateral, vertical
    forces: Array  # the same, nodal
    notch_compliance: float  # growth of the notch [m^2] per pressure [Pa], no crack


def axis_of(plate: Plate, fine: float) -> Axis:
    mesh = Mesh(plate, fine)
    K = mesh.stiffness()
    nodes = 2 * mesh.node(0, np.arange(mesh.floor_row + 1))
    loads = np.column_stack((mesh.notch(), mesh.lateral(), mesh.vertical()))
    S, forces, moved = condense(mesh, K, held(mesh, plate.outer), loads, nodes)
    if plate.outer == "rollers":  # confined by stress, then held: the axis keeps the forces it had
        forces[:, 1:] = condense(mesh, K, held(mesh, "stress"), loads, nodes)[1][:, 1:]
    s = mesh.y[mesh.floor_row] - mesh.y[mesh.floor_row - np.arange(mesh.path_rows)]
    return Axis(s, S, forces / mesh.shares(s)[:, None], forces, 2 * moved[0, 0])


def weight_functions(plate: Plate, fine: float = 2e-4) -> WeightFunctions:
    axis = axis_of(plate, fine)
    s, S = axis.s, axis.stiffness
    factor = scipy.linalg.cholesky(S, lower=True)
    rows = scipy.linalg.solve_triangular(factor, np.eye(len(S)), lower=True)
    step = np.diff(s)
    c = (s[1:] + s[:-1]) / 2
    m = rows[:-1] * np.sqrt(plate.modulus / step)[:, None]  # row j: node j released, tip in s_j, s_j+1
    lengths, terms = [0.0], [np.array([0.6147, 0.2502] + [0.0] * (TERMS - 2))]  # Bueckner 1970
    for j in range(14, len(c)):
        points = slice(0, j - 4)  # the nodes next to the tip see the elements
        u = s[points] / c[j]
        M = m[j, points] * np.sqrt(np.pi * (c[j] - s[points]) / 2)
        weight = np.sqrt(np.gradient(u))
        powers = (1 - u)[:, None] ** np.arange(1, TERMS + 1)
        terms.append(np.linalg.lstsq(powers * weight[:, None], (M - 1) * weight, rcond=None)[0])
        lengths.append(c[j])
    splines = CubicSpline(lengths, np.array(terms), axis=0)
    tractions = CubicSpline(s[:-1], axis.tractions[:-1], axis=0)
    unit = np.array([intensity(tractions, splines, c) for c in lengths[1:]])
    unit = np.vstack((HALF_PLANE * np.sqrt(np.pi) * tractions(0.0), unit))
    return WeightFunctions(plate, splines, CubicSpline(lengths, unit, axis=0), axis.notch_compliance)


def shape(terms: Array, u: Array) -> Array:
    """M at u = s/c; `terms`: M_k last."""
    return 1 + np.sum(terms * (1 - u)[..., None] ** np.arange(1, TERMS + 1), axis=-1)


def intensity(tractions: CubicSpline, splines: CubicSpline, c: float) -> Array:
    """K_I/c^(1/2) under tractions on the axis: s = c (1 - v^2) takes the singularity away."""
    v, weight = np.polynomial.legendre.leggauss(60)
    v, weight = (v + 1) / 2, weight / 2
    s = c * (1 - v * v)
    M = shape(splines(c), s / c)
    return 2 * np.sqrt(2 / np.pi) * (weight * M) @ tractions(s)

# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""The multigrid method for obstacle problems in matrices."""
from dataclasses import dataclass, field

import numpy as np

from . import _core, _problem
from ._mapping import array
from ._results import NotConverged


@dataclass(repr=False)
class ObstacleSolution:
    """What solve_obstacle() returns, for n dofs.

    u                 (n,): the solution
    active            numbers of the nodes (dofs of scalar problems) that touch their obstacle, ascending
    force             (n,): A u - f, what obstacles and prescribed dofs do to the rest; zero elsewhere to the tolerance
    energy            u.A u / 2 - f.u
    iterations        V-cycles on the finest level; start_iterations: those on the coarser levels, where the start came from, coarsest first
    history           norm of the correction over that of the iterate, in the norm of A, a number an iteration
    converged, note   whether the tolerance was met; what the solver has to say if not"""
    u: np.ndarray
    active: np.ndarray
    force: np.ndarray
    energy: float
    iterations: int
    start_iterations: list = field(default_factory=list)
    history: np.ndarray = None
    converged: bool = True
    note: str = ''

    def __repr__(self):
        return f'<ObstacleSolution: {len(self.u)} dofs, {len(self.active)} nodes active, {self.iterations} iterations>'


def rows_of(matrix, name):
    """(number of columns, start, columns, values), as csr_matrix has them."""
    from scipy.sparse import csr_matrix, isspmatrix
    if not (isspmatrix(matrix) or isinstance(matrix, np.ndarray)):
        raise _core.InputError(f'{name}: a {type(matrix).__name__}, expected a matrix of scipy.sparse or an array.')
    matrix = csr_matrix(matrix, dtype=np.float64, copy=True)
    matrix.sum_duplicates()
    if not np.isfinite(matrix.data).all():
        raise _core.InputError(f'{name}: there are entries that are not finite.')
    return matrix


def packed(matrix):
    return matrix.shape[1], matrix.indptr.astype(np.int64), matrix.indices.astype(np.int64), matrix.data


def symmetric(A):
    A = rows_of(A, 'A')
    if A.shape[0] != A.shape[1] or A.shape[0] == 0:
        raise _core.InputError(f'A: a matrix of shape {A.shape}, expected a square one.')
    difference = abs(A - A.T)
    if difference.nnz and difference.max() > 1e-10 * abs(A).max():
        raise _core.InputError(f'A is not symmetric: entries differ by {difference.max():.3g}.')
    # The same numbers, but for rounding, and none that is stored on one side only.
    return rows_of((A + A.T) / 2, 'A')


def nodal(P, name, n_nodes, components):
    """A prolongation by node, from one by node or by dof (the same weights for all components)."""
    from scipy.sparse import identity, kron
    P = rows_of(P, name)
    if P.shape[0] == n_nodes:
        return P
    if components > 1 and P.shape[0] == components * n_nodes and P.shape[1] % components == 0:
        by_node = P[::components, ::components].tocsr()
        difference = abs(P - kron(by_node, identity(components)))
        if difference.nnz and difference.max() > 1e-12 * abs(by_node).max():
            raise _core.InputError(f'{name}: the components of a node must be interpolated alike, each from its own.')
        return by_node
    raise _core.InputError(f'{name}: {P.shape[0]} rows, expected {n_nodes}, one a node of the level above (finest level first).')


def scalar_half_spaces(lower, upper, n):
    """Nodes, normals and bounds of lower and upper obstacles."""
    low, high = (np.full(n, missing) if given is None else np.broadcast_to(np.asarray(given, dtype=np.float64), (n,))
                 for given, missing in ((lower, -np.inf), (upper, np.inf)))
    if np.isnan(low).any() or np.isnan(high).any():
        raise _core.InputError('lower, upper: an obstacle is no number; where there is none it is -inf or inf.')
    from_below, from_above = np.isfinite(low), np.isfinite(high)
    if (from_below & from_above).any():
        raise _core.InputError(f'lower, upper: dof {np.flatnonzero(from_below & from_above)[0]} has both; a node may have one obstacle.')
    nodes = np.flatnonzero(from_below | from_above)
    return nodes, np.where(from_below, -1., 1.)[nodes, None] * np.array([1., 0., 0.]), np.where(from_below, -low, high)[nodes]


def vector_half_spaces(nodes, normals, bounds, n_nodes):
    """The same for half-spaces n_p . u_p <= g_p, nodes ascending."""
    nodes = np.arange(n_nodes) if nodes is None else array(nodes, 'nodes', (None,), np.int64)
    normals = array(normals, 'normals', (len(nodes), None), np.float64)
    bounds = np.array(np.broadcast_to(np.asarray(bounds, dtype=np.float64), (len(nodes),)))
    lengths = np.linalg.norm(normals, axis=1)
    if not (np.isfinite(lengths).all() and (lengths > 0).all()) or np.isnan(bounds).any() or (bounds == -np.inf).any():
        raise _core.InputError('normals, bounds: a normal must be finite and not zero, a bound a number (inf where there is no obstacle).')
    if len(nodes) and (nodes.min() < 0 or nodes.max() >= n_nodes or len(set(nodes.tolist())) < len(nodes)):
        raise _core.InputError(f'nodes: numbers from 0 to {n_nodes - 1}, each once, are expected.')
    order = np.argsort(nodes)
    order = order[np.isfinite(bounds[order])]
    three = np.zeros((len(nodes), 3))
    three[:, :normals.shape[1]] = normals / lengths[:, None]
    return nodes[order], three[order], (bounds / lengths)[order]


def half_spaces(lower, upper, nodes, normals, bounds, n, components):
    """Nodes, normals and bounds of whatever is given."""
    if normals is None and bounds is not None or normals is not None and (bounds is None or lower is not None or upper is not None):
        raise _core.InputError('A half-space has a normal and a bound; lower and upper are for scalar problems.')
    if normals is not None:
        return vector_half_spaces(nodes, normals, bounds, n // components)
    if components == 1:
        return scalar_half_spaces(lower, upper, n)
    if lower is not None or upper is not None:
        raise _core.InputError('lower, upper: for scalar problems; vectors have normals and bounds.')
    return np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros(0)


def prescribed(fixed, values, n):
    """Mask of prescribed dofs, and a vector with their values."""
    mask = np.zeros(n, dtype=bool)
    if fixed is not None:
        fixed = np.asarray(fixed)
        if fixed.dtype == bool and fixed.shape != (n,) or fixed.dtype != bool and fixed.size and not np.issubdtype(fixed.dtype, np.integer):
            raise _core.InputError(f'fixed: expected {n} times true or false, or numbers of dofs.')
        if fixed.dtype != bool and fixed.size and (fixed.min() < 0 or fixed.max() >= n):
            raise _core.InputError(f'fixed: numbers of dofs are from 0 to {n - 1}.')
        mask[fixed if fixed.dtype == bool else fixed.astype(np.int64)] = True
    lift = np.where(mask, array(np.zeros(n) if values is None else values, 'values', (n,), np.float64), 0.)
    if not np.isfinite(lift).all():
        raise _core.InputError('values: a prescribed value is not finite.')
    return mask, lift


def solve(settings, problem):
    """The solver with parameters of the section Solver."""
    lines = [f'set {name} = {_problem.value_text(value, name)}\n' for name, value in settings.items()]
    try:
        return _core.solve({**problem, 'solver': ''.join(lines)})
    except _core.InputError as error:
        # Two lines come before.
        raise _core.InputError(_problem.explain(str(error), ['solver', 'solver', *settings], 'solver')) from None
    except RuntimeError as error:
        if 'singular' not in str(error):
            raise
        raise _core.InputError('A is not positive definite at the dofs that are not fixed.') from None


def unbalanced_force(solution, fixed, normals, scale):
    """The largest force at free components that no obstacle explains, over `scale`; normals (k, components) of the active nodes."""
    fixed = fixed.reshape(-1, normals.shape[1])
    rest = np.where(fixed, 0., solution.force.reshape(fixed.shape))
    # An active half-space gives a force against its normal.
    normals = np.where(fixed[solution.active], 0., normals)
    along = np.minimum(np.einsum('ij,ij->i', rest[solution.active], normals), 0.) / np.einsum('ij,ij->i', normals, normals)
    rest[solution.active] -= along[:, None] * normals
    return np.abs(rest).max() / scale if scale > 0 else 0.


def solve_obstacle(A, f, prolongations=(), *, lower=None, upper=None, normals=None, bounds=None, nodes=None, components=None, fixed=None,
                   values=None, start=None, tolerance=1e-12, solver=None):
    """Minimizes u.A u / 2 - f.u over all u that keep off their obstacles, by the multigrid method of Signorini (doc/solvers.md).

    A              (n, n), symmetric, positive definite at the dofs that are not fixed: scipy.sparse, or an array
    f              (n,)
    prolongations  matrices to each level from the one below it, finest level first, one row a node (or a dof): coarse matrices are
                   Galerkin products. Without them the problem is solved by sweeps and sparse factors.
    scalar problems:  lower <= u or u <= upper, numbers or arrays (n,), -inf and inf where there is no obstacle; one of the two a dof
    vectors:       dof = components * node + component, 1 to 3 components; normals (k, components) and bounds (k,) of half-spaces
                   normal . u <= bound at `nodes` (k,) (all nodes by default). `components` is that of the normals.
    fixed, values  prescribed dofs, a mask (n,) or their numbers; values (n,), zero by default
    start          (n,): where to begin
    tolerance      stop when the correction is below this multiple of the iterate, in the norm of A
    solver         more parameters as in the section Solver of a parameter file: {"Method": "truncated newton multigrid", ...}

    Returns an ObstacleSolution. Runs on the rank that calls it. Raises InputError for what cannot be solved, NotConverged (with the
    solution so far), KeyboardInterrupt on Ctrl-C."""
    A = symmetric(A)
    n = A.shape[0]
    f = array(f, 'f', (n,), np.float64)
    components = int(components or (1 if normals is None else np.shape(normals)[-1]))
    if components not in (1, 2, 3) or n % components or (normals is not None and np.shape(normals)[-1] != components):
        raise _core.InputError(f'components: {components} of a node do not fit to {n} dofs and the normals.')
    at, normals, bounds = half_spaces(lower, upper, nodes, normals, bounds, n, components)
    mask, lift = prescribed(fixed, values, n)
    begin = np.zeros(n) if start is None else array(start, 'start', (n,), np.float64) - lift
    if not np.isfinite(f).all() or not np.isfinite(begin).all():
        raise _core.InputError('f, start: there are entries that are not finite.')
    if (A.diagonal()[~mask] <= 0.).any():
        raise _core.InputError(f'A: the diagonal is not positive at dof {np.flatnonzero(~mask & (A.diagonal() <= 0.))[0]}.')
    levels = []
    for i, P in enumerate(prolongations):
        levels.append(nodal(P, f'prolongations[{i}]', levels[-1].shape[1] if levels else n // components, components))
    # v = u - lift is zero where u is prescribed.
    lift_at = np.zeros((n // components, 3))
    lift_at[:, :components] = lift.reshape(-1, components)
    settings = {'Tolerance': tolerance, **(solver or {})}
    given = solve(settings, {'components': components, 'matrix': packed(A), 'rhs': f - A @ lift, 'start': begin, 'fixed': mask.astype(np.uint8),
                             'prolongations': [packed(P) for P in levels], 'nodes': at, 'normals': normals,
                             'bounds': bounds - np.einsum('ij,ij->i', normals, lift_at[at])})
    u = given['u'] + lift
    force = A @ u - f
    scale = given['scale']
    result = ObstacleSolution(u, given['active'], force, float(u @ (A @ u) / 2 - f @ u), given['iterations'], given['start_iterations'],
                              given['history'] / scale if scale > 0 else given['history'], given['converged'], given['note'])
    if not result.converged:
        raise NotConverged('the iteration did not converge. ' + result.note, result)
    # Where A is not positive definite an iteration may come to rest anywhere.
    scale = (abs(A) @ np.abs(u) + np.abs(f)).max()
    rest = unbalanced_force(result, mask, normals[np.searchsorted(at, result.active), :components], scale)
    if not rest <= 1e-6 + 100 * settings['Tolerance']:
        raise NotConverged(f'the forces are not in balance (relative to the largest: {rest:.2g}); is A positive definite at the dofs that are not fixed?',
                           result)
    return result

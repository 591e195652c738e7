"""Bodies that bend: their contact lies where beams and plates touch, far away from where they touched before."""
import os
import tempfile

from harness import certificate, check, near


def slender(p):
    """Bodies that bend, held at one end and laid down on a plane, or on another body, by their weight. A coarse correction that is cut off node by node loses its
    bending."""
    weight = 'Volume force=(0, 0, -1e-8)'
    bar = ('Divisions=40, 1, 1', 'Upper corner=40, 1, 1', 'Dirichlet=left: (0, 0, 0)', weight)
    plate = ('Divisions=20, 10, 1', 'Upper corner=20, 10, 1', 'Dirichlet=left: (0, 0, 0)', weight)
    plane = ('Pair bottom/Obstacle=plane: (0, 0, -0.001), (0, 0, 1)', 'Solver/Check monotonicity=true')
    below = ('Body lower/Divisions=25, 2, 1', 'Body lower/Lower corner=0, -1, -1', 'Body lower/Upper corner=41, 2, 0', 'Body upper/Lower corner=0, 0, 0', 'Body upper/Young modulus=1',
             'Body lower/Young modulus=1', 'Pair interface/Initial gap=0.001')
    two = ('Refinement/Global cycles=1',)
    three = ('Refinement/Global cycles=0', 'Refinement/Initial global levels=2')
    for text, prm, settings, bounds in (('bar', 'obstacle/paraboloid.prm', [f'Body cube/{b}' for b in bar] + [*plane, *two], (20, 22)),
                                        ('bar from zero', 'obstacle/paraboloid.prm', [f'Body cube/{b}' for b in bar] + [*plane, *three], (20,)),
                                        ('plate', 'obstacle/paraboloid.prm', [f'Body cube/{b}' for b in plate] + [*plane, *two], (25, 25)),
                                        ('bar on a block', 'cubes/cubes.prm', [f'Body upper/{b}' for b in bar] + [*below, *two], (20, 22))):
        s = p.solve(prm, *settings)
        certificate(s)
        other = p.solve(prm, *settings, 'Solver/Method=active set amg', 'Solver/Compare linear multigrid=false')
        check(len(s['cycles']) == len(other['cycles']) == len(bounds), f'{text}: {len(s["cycles"])} cycles')
        check('bar on' in text or 'monotonicity' in s['cycles'][0]['nonlinear'], f'{text}: monotonicity was not checked')
        for a, b, bound in zip(s['cycles'], other['cycles'], bounds):
            solver = a['nonlinear']
            print(f'{text}: {solver["iterations"]} iterations, start {solver.get("start_iterations", [])}')
            check(solver['iterations'] <= bound, f'{text}: {solver["iterations"]} iterations')
            check(a['active_nodes'] == b['active_nodes'], f'{text}: {a["active_nodes"]} active nodes, not {b["active_nodes"]}')
            near(a['energy'], b['energy'], 1e-9, f'{text}: energy')
            # The energy is a difference of numbers larger by the ratio of the stiffness of a cell to that of the bar, 4 (40 / 1)^3. Where the contact
            # subspace finds the minimizer in the first iteration, the sweeps after it have the whole displacement as their correction, in single
            # precision: its rounding squared, 2^-48, times that ratio is 1e-9.
            if 'monotonicity' in solver:
                rounding = 3e-9 if text == 'bar' and a is s['cycles'][0] else 1e-10
                check(solver['monotonicity']['largest_energy_rise'] <= rounding, f'{text}: energy rises by {solver["monotonicity"]["largest_energy_rise"]}')
    s = p.solve('obstacle/paraboloid.prm', *[f'Body cube/{b}' for b in bar], *plane, *two, 'Solver/Method=truncated newton multigrid')
    for c in s['cycles']:
        check(c['nonlinear']['iterations'] <= 30, f'truncated newton multigrid: {c["nonlinear"]["iterations"]} iterations')


def sheet(p):
    """A sheet that its weight lays down on a plane, one finished mesh of cubes: the active set does not come to rest, and sparse factors of something so thin are cheap."""
    settings = ('Body cube/Divisions=75, 75, 1', 'Body cube/Upper corner=75, 75, 1', 'Body cube/Dirichlet=left: (0, 0, 0)', 'Body cube/Volume force=(0, 0, -1e-8)',
                'Pair bottom/Obstacle=plane: (0, 0, -0.001), (0, 0, 1)', 'Refinement/Global cycles=0', 'Solver/Compare linear multigrid=false')
    s = p.solve('obstacle/paraboloid.prm', *settings)
    certificate(s)
    c = s['cycles'][-1]
    solver = c['nonlinear']
    print(f'{c["dofs"]} unknowns, {solver["iterations"]} iterations, {solver["subspace_minimizations"]} minimizations in the subspace, {solver.get("safety_net")}')
    check(c['dofs'] > 30000 and solver['iterations'] <= 30, f'{c["dofs"]} unknowns, {solver["iterations"]} iterations')
    check(solver['subspace_minimizations'] > 0, 'the contact subspace was not used')
    net = solver['safety_net']
    check(net['linear_solver'] == 'sparse factors' and net['failed_attempts'] == 0, f'{net}')
    # Where a cantilever of this length would hang: it lies on the plane but for its root.
    pair = s['pairs'][0]
    weight = 1e-8 * 75. * 75.
    check(.5 * weight < pair['force'][2] < weight, f'the plane carries {pair["force"][2]} of {weight}')


LENGTHS = (480., 360., 240.)
WIDTH, THICKNESS, LOAD = 40., 6., 200.


def leaf_spring(length, n_leaves):
    """Parameters: leaves of equal section on each other, clamped at one end, the longest one pulled down at the other end."""
    text = f"set Bodies = {', '.join(f'leaf {k}' for k in range(n_leaves))}\n"
    text += f"set Contact pairs = {', '.join(f'below {k}' for k in range(n_leaves - 1))}\n"
    for k in range(n_leaves):
        text += f"""subsection Body leaf {k}
  set Mesh = block
  set Lower corner = 0, 0, {-(k + 1) * THICKNESS}
  set Upper corner = {LENGTHS[k]}, {WIDTH}, {-k * THICKNESS}
  set Divisions = {round(LENGTHS[k] / length)}, 4, 1
  set Young modulus = 210e3
  set Poisson ratio = 0
  set Dirichlet = left: (0, 0, 0)
{f'  set Forces = right: (0, 0, {-LOAD})' if k == 0 else ''}
end
"""
    for k in range(n_leaves - 1):
        text += f'subsection Pair below {k}\n  set First = leaf {k}: bottom\n  set Second = leaf {k + 1}: top\nend\n'
    return text


def forces_of_beams(n_leaves):
    """Forces at the ends of all leaves but the longest one, on which the leaf above lies: cantilevers, E I = 1."""
    def flexibility(i, j):
        near_end, far_end = sorted((LENGTHS[i], LENGTHS[j]))
        return near_end ** 2 * (3 * far_end - near_end) / 6

    forces = [LOAD] + [0.] * (n_leaves - 1)
    # Leaf k - 1 is pushed down by the force k - 1 at its end, and up by the force k where leaf k ends; Gauss-Seidel from the free end.
    for _ in range(200):
        for k in range(1, n_leaves):
            pushed = forces[k - 1] * flexibility(k - 1, k)
            held_by_own_leaf = forces[k + 1] * flexibility(k + 1, k) if k + 1 < n_leaves else 0.
            forces[k] = (pushed + held_by_own_leaf) / (2 * flexibility(k, k))
    return forces[1:]


def leaf_springs(p):
    """Gaps are zero everywhere and close at the ends of leaves alone: sweeps by node find that a few nodes at a time, active-set steps go round in a circle."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'spring.prm')
        for n_leaves, cycles in ((2, 1), (3, 0)):
            with open(path, 'w') as f:
                f.write(leaf_spring(6., n_leaves))
            s = p.solve(path, f'Refinement/Global cycles={cycles}')
            certificate(s)
            counts = [c['nonlinear']['iterations'] for c in s['cycles']]
            print(f'{n_leaves} leaves: {counts} iterations, {s["cycles"][-1]["active_nodes"]} active')
            check(max(counts) <= 30, f'{n_leaves} leaves: {counts} iterations')
            for pair, force in zip(s['pairs'], forces_of_beams(n_leaves)):
                near(pair['force'][2], force, .01, f'{n_leaves} leaves, {pair["name"]}')

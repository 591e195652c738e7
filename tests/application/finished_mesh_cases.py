"""Cases of finished meshes: those without coarser ones, under which the program puts levels of its own."""
from harness import certificate, check, near

CUBES = 'cubes/cubes.prm'
# The finest meshes of two and three refinements.
FINISHED = {n: [f'Body upper/Divisions={3 * n}, {3 * n}, {3 * n}', f'Body lower/Divisions={2 * n}, {2 * n}, {2 * n}',
                'Refinement/Global cycles=0'] for n in (4, 8)}
# Contact nodes of which some components are fixed.
SIDES = ['Body upper/Dirichlet=left: (0, *, *); top: (*, *, -0.05); front: (*, 0, *)',
         'Body lower/Dirichlet=left: (0, *, *); bottom: (*, *, 0); front: (*, 0, *)']


def count(s):
    return s['cycles'][-1]['nonlinear']['iterations']


def same(a, b, text):
    near(a['cycles'][-1]['energy'], b['cycles'][-1]['energy'], 1e-9, f'{text}: energy')
    near(a['pairs'][0]['force'][2], b['pairs'][0]['force'][2], 1e-8, f'{text}: force')
    check(a['cycles'][-1]['active_nodes'] == b['cycles'][-1]['active_nodes'], f'{text}: other active nodes')


def finished_mesh(p):
    """The finest mesh of a hierarchy as a finished one: the same solution in about as many iterations."""
    n = 8 if len(p.command) == 1 else 4
    for sides, kind in (([], []), (SIDES, []), (SIDES, [f'Body {b}/Convert to tetrahedra=true' for b in ('upper', 'lower')])):
        text = f'{"partly fixed" if sides else "cubes"}{" of tetrahedra" if kind else ""}'
        # Tetrahedra are bisected, so that their finest meshes are others.
        own = [] if kind else [p.solve(CUBES, *sides, f'Refinement/Global cycles={3 if n == 8 else 2}')]
        size = FINISHED[4 if kind else n]
        s = p.solve(CUBES, *sides, *kind, *size)
        print(f'{text}: {count(s)} iterations, linear {s["cycles"][0]["linear"]["iterations"]}, with CG '
              f'{s["cycles"][0]["linear_cg"]["iterations"]}', *(f', with its own hierarchy {count(o)}' for o in own))
        certificate(s)
        # Level 0 solved nearly exactly would take fewer iterations yet.
        check(s['cycles'][0]['levels'] >= 3, f'{text}: {s["cycles"][0]["levels"]} levels')
        check(count(s) <= 18, f'{text}: {count(s)} iterations')
        check(count(s) <= 1.2 * s['cycles'][0]['linear_cg']['iterations'] + 1, f'{text}: {count(s)} iterations')
        for o in own:
            same(s, o, text)
            check(count(s) <= 1.5 * count(o), f'{text}: {count(s)} iterations, {count(o)} with its own hierarchy')
        if kind:
            same(s, p.solve(CUBES, *sides, *kind, *size, 'Solver/Coarse levels=none'), f'{text}, without coarse levels')
    small = FINISHED[4]
    a = p.solve(CUBES, *small)
    for method, bound in (('monotone multigrid', 40), ('truncated newton multigrid', 30)):
        s = p.solve(CUBES, *small, f'Solver/Method={method}')
        print(f'{method}: {count(s)} iterations')
        same(s, a, method)
        check(count(s) <= bound, f'{method}: {count(s)} iterations')
    # A body that only moves, solved to few digits: what is left of the forces is no contradiction.
    s = p.solve(CUBES, *small, 'Body upper/Convert to tetrahedra=true', 'Pair interface/Initial gap=1', 'Solver/Tolerance=1e-6')
    check(s['certificate']['contact_conditions_hold'] and s['cycles'][-1]['active_nodes'] == 0, 'moved freely: the certificate objects')
    # Other units of stress.
    for young, text in ((1e-6, 'soft'), (1e6, 'stiff')):
        s = p.solve(CUBES, *small, f'Body upper/Young modulus={7e3 * young}', f'Body lower/Young modulus={6.896e5 * young}')
        check(count(s) == count(a), f'{text}: {count(s)} iterations, else {count(a)}')
        check(s['cycles'][-1]['active_nodes'] == a['cycles'][-1]['active_nodes'], f'{text}: other active nodes')
    # Refined meshes above a finished one.
    s = p.solve(CUBES, *small, 'Refinement/Global cycles=1', 'Body upper/Convert to tetrahedra=true')
    print('refined:', [c['nonlinear']['iterations'] for c in s['cycles']])
    certificate(s)
    check(count(s) <= 20, f'refined: {count(s)} iterations')

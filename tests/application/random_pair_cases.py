"""Random pairs of blocks: shapes, divisions, offsets, stiffness ratios, Poisson's ratios, rotations, tetrahedra or hexahedra, loads and
refinement at random, 300 to 30,000 unknowns. By hand, a line for each problem and the distribution:

  SIGNORINI_RANDOM_BLOCKS=1000 SIGNORINI_RANDOM_SEED=1 run_case.py PROGRAM random_pairs RANKS
  random_pair_cases.py PROGRAM RANKS SEED... [SECTION/NAME=VALUE...]      (single problems; "example" is that of a soft block of stretched tetrahedra)
"""
import json
import math
import os
import random
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from harness import TOP, Program, check

PATCH_TEST = os.path.join(TOP, 'prm', 'patch_test', 'patch_test.prm')
LARGEST = 30000
# The seeds of the ctest case are fixed: it is the same on each machine.
N_DEFAULT, FIRST_SEED = 36, 1
# Of all problems; and of what share of them fewer.
MOST_ITERATIONS, USUAL_ITERATIONS, USUAL_SHARE = 60, 30, .99


def numbers(values):
    return ', '.join(repr(v) if isinstance(v, int) else f'{v:.6g}' for v in values)


def unknowns(bodies, cycles):
    total = 0
    for body in bodies:
        n = [d * 2 ** cycles for d in body['divisions']]
        nodes = math.prod(k + 1 for k in n)
        # A hexahedron is cut into twelve tetrahedra about its centre, its faces about theirs: eight times as many cells in a refinement.
        if body['tetrahedra']:
            faces = 3 * math.prod(n) + n[0] * n[1] + n[1] * n[2] + n[0] * n[2]
            nodes += math.prod(n) + faces
        total += 3 * nodes
    return total


def turned(vector, axis, degrees):
    """Rotation about an axis through the origin (Rodrigues)."""
    length = math.sqrt(sum(a * a for a in axis))
    n, angle = [a / length for a in axis], math.radians(degrees)
    dot = sum(a * b for a, b in zip(n, vector))
    cross = [n[1] * vector[2] - n[2] * vector[1], n[2] * vector[0] - n[0] * vector[2], n[0] * vector[1] - n[1] * vector[0]]
    return [v * math.cos(angle) + c * math.sin(angle) + k * dot * (1 - math.cos(angle)) for v, c, k in zip(vector, cross, n)]


def upper_conditions(r, height, size):
    """How the upper block is held and loaded, along the axes of the assembly: name, prescribed displacements, tractions in parts of its
    modulus. Contact alone never holds it."""
    depth = -height * 10 ** r.uniform(-3.5, -1.8)
    kind = r.choice(['pressed', 'pressed', 'sliding', 'turned', 'traction', 'traction', 'bent', 'side'])
    if kind == 'pressed':
        return kind, {'top': (0., 0., depth)}, {}
    if kind == 'sliding':
        return kind, {'left': (0., '*', '*'), 'front': ('*', 0., '*'), 'top': ('*', '*', depth)}, {}
    if kind == 'turned':
        return kind, {'top': (r.uniform(-1, 1) * depth, r.uniform(-1, 1) * depth, depth)}, {}
    if kind == 'traction':
        return kind, {'left': (0., 0., 0.)}, {'top': (0., 0., -10 ** r.uniform(-3.5, -2))}
    if kind == 'bent':
        slender = max(size[0], size[1]) / size[2]
        return kind, {'left': (0., 0., 0.)}, {'right': (r.uniform(-1, 1) * 1e-3, 0., -10 ** r.uniform(-3.5, -2) / max(1., slender ** 2))}
    return kind, {r.choice(['front', 'right']): (0., 0., depth)}, {}


def random_pair(seed):
    """Settings of patch_test.prm, and a line that describes them."""
    r = random.Random(seed)
    cycles = r.choice([0, 1, 1, 2, 2])
    while True:
        bodies = [{'size': [math.exp(r.uniform(math.log(.4), math.log(2.2))) for _ in range(3)], 'divisions': [r.randint(1, 5) for _ in range(3)],
                   'tetrahedra': r.random() < .5, 'poisson': r.choice([r.uniform(0, .49), .3, r.uniform(.4, .49)]),
                   'element': r.choice(['automatic', 'automatic', 'standard'])} for _ in range(2)]
        if 300 <= unknowns(bodies, cycles) <= LARGEST:
            break
    upper, lower = bodies
    ratio = 10 ** r.uniform(-4, 4)
    upper['young'], lower['young'] = (10 ** r.uniform(-3, 3) for _ in range(2))
    lower['young'] = upper['young'] * ratio
    # At least a third of the shorter side of both covers the other.
    corner = []
    for k in range(2):
        least = min(upper['size'][k], lower['size'][k]) / 3
        corner.append(r.uniform(least - lower['size'][k], upper['size'][k] - least))
    kind, dirichlet, tractions = upper_conditions(r, upper['size'][2], upper['size'])
    axis, angle = ([r.uniform(-1, 1) for _ in range(3)], r.uniform(0, 180)) if r.random() < .4 else ([0., 0., 1.], 0.)
    settings, turn = {}, r.choice([0., 0., r.uniform(-40, 40)])
    if angle != 0.:
        turn = 0.
        if kind == 'sliding':
            kind, dirichlet = 'pressed', {'top': (0., 0., dirichlet['top'][2])}
    if turn != 0. and kind == 'sliding':
        kind, dirichlet = 'pressed', {'top': (0., 0., dirichlet['top'][2])}

    def vector(v):
        return '(' + numbers(turned(v, axis, angle)) + ')' if '*' not in v else '(' + ', '.join(map(str, v)) + ')'

    for name, body in (('upper', upper), ('lower', lower)):
        low = [0., 0., 0.] if name == 'upper' else [*corner, -body['size'][2]]
        settings[f'Body {name}/Lower corner'] = numbers(low)
        settings[f'Body {name}/Upper corner'] = numbers([a + b for a, b in zip(low, body['size'])])
        settings[f'Body {name}/Divisions'] = numbers(body['divisions'])
        settings[f'Body {name}/Convert to tetrahedra'] = str(body['tetrahedra']).lower()
        settings[f'Body {name}/Young modulus'] = f'{body["young"]:.6g}'
        settings[f'Body {name}/Poisson ratio'] = f'{body["poisson"]:.4f}'
        settings[f'Body {name}/Element'] = body['element']
        if angle != 0.:
            settings[f'Body {name}/Rotation axis'], settings[f'Body {name}/Rotation angle'] = numbers(axis), f'{angle:.6g}'
    x, y = (max(0., c) + .5 * (min(u, c + l) - max(0., c)) for c, u, l in zip(corner, upper['size'], lower['size']))
    if turn != 0.:
        # About the normal of the contact surface, through the middle of what covers the other.
        settings['Body upper/Rotation angle'] = f'{turn:.6g}'
        settings['Body upper/Translation'] = numbers([a - b for a, b in zip((x, y, 0.), turned((x, y, 0.), [0., 0., 1.], turn))])
    settings['Body upper/Dirichlet'] = '; '.join(f'{b}: {vector(v)}' for b, v in dirichlet.items())
    if tractions:
        settings['Body upper/Tractions'] = '; '.join(f'{b}: {vector([x * upper["young"] for x in v])}' for b, v in tractions.items())
    settings['Body lower/Dirichlet'] = 'bottom: (0, 0, 0)' if kind != 'sliding' else 'left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)'
    crown = r.choice([0., 0., r.uniform(.5, 3)])
    if crown != 0.:
        # Parabolic, a part of what the prescribed displacement closes.
        centre = turned([x, y, 0.], axis, angle)
        way = max([abs(v[2]) for v in dirichlet.values() if '*' not in v[2:]] + [1e-3 * upper['size'][2]])
        square = '+'.join(f'({c}-({a:.6g}))^2' for c, a in zip('xyz', centre))
        settings['Pair interface/Initial gap'] = f'{crown * way / max(upper["size"][0], upper["size"][1]) ** 2:.6g}*({square})'
    settings['Refinement/Global cycles'] = str(cycles)
    text = ' | '.join(f'{"tet" if b["tetrahedra"] else "hex"} {"x".join(f"{s:.2f}" for s in b["size"])} /{",".join(map(str, b["divisions"]))} '
                      f'nu {b["poisson"]:.3f}' for b in bodies)
    return settings, f'{kind} ratio {ratio:.0e} {text}'


def issue_example():
    """Soft, stretched tetrahedra near incompressibility on a block that is next to rigid."""
    return {'Body upper/Upper corner': '0.5555, 1.9099, 1.5194', 'Body upper/Divisions': '3, 1, 4', 'Body upper/Convert to tetrahedra': 'true',
            'Body upper/Young modulus': '0.1084', 'Body upper/Poisson ratio': '0.4868', 'Body lower/Divisions': '2, 4, 4',
            'Body lower/Young modulus': '6.8e5', 'Refinement/Global cycles': '2'}, 'stretched tetrahedra, nu 0.4868'


def solve(p, problem, extra=(), keep=None):
    """One line of results: unknowns, iterations of each mesh, what it says."""
    settings = problem[0]
    with tempfile.TemporaryDirectory() as folder:
        out = keep or os.path.join(folder, 'out')
        arguments = [PATCH_TEST, '--output', out]
        for name, value in {**settings, 'Solver/Compare linear multigrid': 'false', 'Output/Bodies': 'false', 'Output/Contact surfaces': 'false',
                            'Output/Stress': 'false'}.items():
            arguments += ['--set', f'{name}={value}']
        for setting in extra:
            arguments += ['--set', setting]
        run = p.call(*arguments)
        try:
            with open(os.path.join(out, 'summary.json')) as f:
                s = json.load(f)
        except OSError:
            return {'error': (run.stderr or run.stdout).strip().splitlines()[-1:]}
    cycles = s['cycles']
    return {'dofs': cycles[-1]['dofs'], 'iterations': [c['nonlinear']['iterations'] for c in cycles], 'converged': s['converged'],
            'verdict': s['certificate']['contact_conditions_hold'], 'objections': s['certificate']['objections'],
            'stagnated': sum('stagnated' in c['nonlinear'] for c in cycles), 'active': cycles[-1]['active_nodes'], 'time': s['wall_time_s'],
            'nets': [c['nonlinear'].get('safety_net') for c in cycles], 'linear': [c['linear_cg']['iterations'] for c in cycles if 'linear_cg' in c]}


def solver_objections(result):
    """Without those that say that the meshes are coarse."""
    return [o for o in result['objections'] if 'refine the contact surfaces' not in o]


def describe(name, problem, result):
    if 'error' in result:
        return f'{name}: FAILED {result["error"]} {problem[1]}'
    verdict = 'yes' if result['verdict'] else 'no: ' + ' '.join(result['objections'])
    nets = [n for n in result['nets'] if n]
    linear = f' (linear {result["linear"]})' if result['linear'] else ''
    return (f'{name}: {result["dofs"]} unknowns, iterations {result["iterations"]}{linear}, {result["active"]} active, {"" if result["converged"] else "NOT "}converged'
            f'{", at rounding" if result["stagnated"] else ""}{f", safety net {nets}" if nets else ""}, {result["time"]:.2f} s, {problem[1]}, verdict {verdict}')


def random_pairs(p):
    n, first = int(os.environ.get('SIGNORINI_RANDOM_BLOCKS', N_DEFAULT)), int(os.environ.get('SIGNORINI_RANDOM_SEED', FIRST_SEED))
    problems = [('example', issue_example())] + [(seed, random_pair(seed)) for seed in range(first, first + n)]
    # Two at once, as many as small machines have cores.
    with ThreadPoolExecutor(max_workers=2 if p.command[0] != 'mpirun' else 1) as pool:
        results = []
        for (name, problem), result in zip(problems, pool.map(lambda x: solve(p, x[1]), problems)):
            print(describe(name, problem, result), flush=True)
            results.append(result)
            check('error' not in result, f'{name}: {result.get("error")}')
            if 'error' not in result:
                worst = max(result['iterations'])
                check(result['converged'], f'{name}: not converged')
                check(not solver_objections(result), f'{name}: verdict no, {result["objections"]}')
                check(worst <= MOST_ITERATIONS, f'{name}: {worst} iterations')
    worst = sorted(max(r['iterations']) for r in results if 'error' not in r)
    # Of a few dozen one may be above.
    usual = worst[max(0, len(worst) - 1 - max(1, math.floor((1 - USUAL_SHARE) * len(worst))))]
    print(f'{len(worst)} problems: median {worst[len(worst) // 2]}, 90 % within {worst[math.ceil(.9 * len(worst)) - 1]}, 99 % within {usual}, most {worst[-1]} iterations; '
          f'{sum(w > USUAL_ITERATIONS for w in worst)} above {USUAL_ITERATIONS}, {sum(w > MOST_ITERATIONS for w in worst)} above {MOST_ITERATIONS}; '
          f'verdict no for the meshes in {sum(not r["verdict"] for r in results if "error" not in r)}; safety net in {sum(any(r.get("nets", [])) for r in results)}')
    check(usual <= USUAL_ITERATIONS, f'{USUAL_SHARE:.0%} of the problems within {usual} iterations, not {USUAL_ITERATIONS}')


if __name__ == '__main__':
    program = Program(sys.argv[1], int(sys.argv[2]))
    extra_settings = [a for a in sys.argv[3:] if '=' in a]
    for seed in [a for a in sys.argv[3:] if '=' not in a]:
        one = issue_example() if seed == 'example' else random_pair(int(seed))
        print(describe(seed, one, solve(program, one, extra_settings)), flush=True)

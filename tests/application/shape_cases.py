"""Problems with known answers whose bodies are all generated: prm/shapes."""
import math
import os
import tempfile

from harness import certificate, check, read_pressure


def line_contact(p):
    """Plane strain Hertz: half width and largest pressure within a percent of the formulas for the computed force."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'results')
        s = p.solve('shapes/line-contact.prm', keep=out)
        rows = read_pressure(os.path.join(out, 'pressure.csv'))
    certificate(s, 1e-7)
    radius, modulus, depth = 10., 1000. / (1 - .3 ** 2) / 2, .2
    forces = [row['area'] * row['pressure'] for row in rows]
    # Half of the line, a slab of some depth. For p0 sqrt(1 - (x/a)^2) the mean of x^2 is (a/2)^2.
    force = 2 * sum(forces) / depth
    width = 2 * math.sqrt(sum(f * row['x'] ** 2 for f, row in zip(forces, rows)) / sum(forces))
    peak = max(row['pressure'] for row in rows)
    from_area = s['pairs'][0]['contact_area'] / depth
    expected = math.sqrt(4 * force * radius / (math.pi * modulus)), math.sqrt(force * modulus / (math.pi * radius))
    print(f'{s["cycles"][-1]["dofs"]} unknowns, {s["cycles"][-1]["nonlinear"]["iterations"]} iterations, force {force:.5g}: half width '
          f'{width / expected[0] - 1:+.2%} (from the active nodes {from_area / expected[0] - 1:+.2%}), p0 {peak / expected[1] - 1:+.2%}')
    check(abs(width / expected[0] - 1) < .01, f'half width {width}, expected {expected[0]}')
    check(abs(peak / expected[1] - 1) < .01, f'largest pressure {peak}, expected {expected[1]}')
    check(abs(s['pairs'][0]['force'][2]) > 0 and s['bodies'][0]['name'] == 'cylinder', 'bodies')


def press_fit_of_tubes(p):
    """Lame's pressure within a percent at every node."""
    s = p.solve('shapes/press-fit.prm')
    certificate(s)
    a, b, c, nu = 5., 10., 16., .3

    def compliance(young, other):
        """Radial displacement of the interface of one tube for the pressure 1, without sign, in plane strain."""
        return b * (1 + nu) / young * ((1 - 2 * nu) * b ** 2 + other ** 2) / abs(other ** 2 - b ** 2)
    pressure = .01 / (compliance(2e5, a) + compliance(1e5, c))
    pair = s['pairs'][0]
    print(f'{s["cycles"][-1]["dofs"]} unknowns, {s["cycles"][-1]["nonlinear"]["iterations"]} iterations: pressure '
          f'{pair["min_pressure"] / pressure - 1:+.2%} to {pair["max_pressure"] / pressure - 1:+.2%}')
    for key in ('min_pressure', 'max_pressure'):
        check(abs(pair[key] / pressure - 1) < .01, f'{key}: {pair[key]}, expected {pressure}')

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""A study of a press fit: how much interference does a hub stand? See README.md.

usage: press_fit_study.py [PICTURE.png]    PYTHONPATH names the folder with the package signorini (doc/python.md)

The file is a notebook as well: cells begin with "# %%" (Jupyter, VS Code, Spyder)."""

# %% The problem, for an interference: lengths in mm, stresses in MPa.
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
import signorini

BORE, INSIDE, OUTSIDE = 10., 5., 16.
STEEL, ALUMINIUM = {'Young modulus': 2e5, 'Poisson ratio': .3}, {'Young modulus': 7e4, 'Poisson ratio': .3}
YIELD = 250.


def press_fit(interference):
    """Quarters of a steel shaft and an aluminium hub, slabs of one layer in plane strain."""
    slab = {'Mesh': 'quarter of annulus', 'Height': .5,
            'Dirichlet': {'symmetry x': (0, None, None), 'symmetry y': (None, 0, None), 'start': (None, None, 0), 'end': (None, None, 0)}}
    return {'Title': f'press fit, interference {interference}',
            'Bodies': {'shaft': {**slab, **STEEL, 'Inner radius': INSIDE, 'Radius': BORE + interference, 'Round divisions': (5, 16, 1)},
                       'hub': {**slab, **ALUMINIUM, 'Inner radius': BORE, 'Radius': OUTSIDE, 'Round divisions': (6, 20, 1)}},
            'Contact pairs': {'fit': {'First': 'shaft: outer', 'Second': 'hub: inner'}},
            'Refinement': {'Global cycles': 1}}


# %% The answer by hand: Lame's tubes in plane strain.
def lame_pressure(interference):
    def compliance(material, other):
        nu = material['Poisson ratio']
        return BORE * (1 + nu) / material['Young modulus'] * ((1 - 2 * nu) * BORE ** 2 + other ** 2) / abs(other ** 2 - BORE ** 2)
    return interference / (compliance(STEEL, INSIDE) + compliance(ALUMINIUM, OUTSIDE))


# %% The study.
interferences = np.array([.005, .01, .02, .03, .04, .05])
results = [signorini.run(press_fit(delta)) for delta in interferences]
pressures = np.array([[pair.pressure[pair.area > 0].min(), pair.pressure.max()] for pair in (r.pairs['fit'] for r in results)])
stresses = np.array([[r.bodies[name].von_mises.max() for name in ('shaft', 'hub')] for r in results])
print('interference  pressure (smallest, largest)  Lame      von Mises: shaft, hub   certified')
for row in zip(interferences, *pressures.T, lame_pressure(interferences), *stresses.T, (r.certified for r in results)):
    print('%12.4f  %10.3f %17.3f  %8.3f  %12.2f %8.2f   %s' % row)
# Stresses grow in proportion: at which interference does the hub yield?
limit = np.interp(YIELD, stresses[:, 1], interferences)
print(f'the hub yields at {YIELD:g} from an interference of {limit:.4f} on')

# %% The picture: pressure and stress over the interference, and the stress in the section at the largest one.
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), constrained_layout=True)
fine = np.linspace(0, interferences[-1], 50)
left.plot(1e3 * fine, lame_pressure(fine), color='0.5', label='pressure, Lamé')
left.plot(1e3 * interferences, pressures.mean(axis=1), 'o', color='C0', label='pressure, computed')
for k, name in enumerate(('shaft', 'hub')):
    left.plot(1e3 * interferences, stresses[:, k], 's--', color=f'C{k + 1}', label=f'largest von Mises stress, {name}')
left.axhline(YIELD, color='C3', linewidth=1)
left.annotate(f'the hub yields from {1e3 * limit:.1f} µm on', (1e3 * limit, YIELD), (1, 1.03 * YIELD), color='C3')
left.set(xlabel='interference in µm', ylabel='MPa', xlim=(0, None), ylim=(0, 1.5 * stresses.max()))
left.legend(loc='upper left')

last = results[-1]
top = max(body.von_mises.max() for body in last.bodies.values())
for body in last.bodies.values():
    # The faces of cells at z = 0, as two triangles each.
    faces = [body.hexahedra[:, list(f)] for f in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (0, 3, 7, 4), (1, 2, 6, 5))]
    bottom = np.vstack([f[(body.nodes[f, 2] == 0).all(axis=1)] for f in faces])
    where = body.nodes + body.displacement
    colours = right.tripcolor(where[:, 0], where[:, 1], np.vstack([bottom[:, :3], bottom[:, [0, 2, 3]]]), body.von_mises, shading='gouraud',
                              vmin=0, vmax=top, cmap='viridis')
right.set(aspect='equal', xlabel='x in mm', ylabel='y in mm', title=f'von Mises stress at {1e3 * interferences[-1]:.0f} µm')
figure.colorbar(colours, ax=right, label='MPa')
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else 'press-fit-study.png', dpi=110)

# %% What must hold.
assert all(r.certified for r in results)
assert np.abs(pressures / lame_pressure(interferences)[:, None] - 1).max() < .005

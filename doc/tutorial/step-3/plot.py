#!/usr/bin/python3
"""Draws membrane.csv of step-3: the membrane over the stairs, and where it touches."""
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

data = np.genfromtxt(sys.argv[1] if len(sys.argv) > 1 else 'membrane.csv', delimiter=',', names=True)
touches = data['u'] - data['obstacle'] < 1e-9
figure = plt.figure(figsize=(10, 4))
space = figure.add_subplot(121, projection='3d')
space.plot_trisurf(data['x'], data['y'], data['u'], cmap='viridis', linewidth=0)
space.set_title('displacement')
plane = figure.add_subplot(122)
plane.scatter(data['x'][~touches], data['y'][~touches], s=2, color='lightgrey', label='free')
plane.scatter(data['x'][touches], data['y'][touches], s=2, color='firebrick', label='in contact')
plane.set_aspect('equal')
plane.legend(loc='upper right')
plane.set_title('nodes on the stairs')
figure.tight_layout()
figure.savefig('membrane.png', dpi=80)

#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""A stand-in for a knee (mm; x lateral, y anterior, z up): the end of a femur with two condyles, and a tibia with
two dishes and an eminence in between.

usage: knee.py FOLDER      needs gmsh (Debian package gmsh) and numpy

Both bones are images of a rounded cylinder under a smooth map. gmsh meshes the cylinder coarsely with tetrahedra and
finely with triangles; the map carries both over, so that the coarse boundary has its vertices on the fine surface.
Writes femur.msh, tibia.msh (tetrahedra; volumes "femur" and "tibia", boundaries "cap", "shaft" and "condyles" or
"plateau") and femur.ply, tibia.ply (the true shapes).
"""
import os
import subprocess
import sys
import tempfile

import numpy as np

# A cylinder of radius 30 and height 50 with half of an ellipsoid at one end, at z = 0.
GEO = '''
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 30, -Pi/2, 0, 2*Pi};
Dilate {{0, 0, 0}, {1, 1, 0.7}} { Volume{1}; }
Cylinder(2) = {0, 0, 0, 0, 0, 50, 30};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
all() = Boundary{ Volume{3}; };
cap() = Surface In BoundingBox{-99, -99, 49.9, 99, 99, 50.1};
end() = Surface In BoundingBox{-99, -99, -22, 99, 99, 0.1};
shaft() = all();
shaft() -= cap();
shaft() -= end();
Physical Volume("bone") = {3};
Physical Surface("cap") = {cap()};
Physical Surface("end") = {end()};
Physical Surface("shaft") = {shaft()};
Field[1] = MathEval;
Field[1].F = "%s";
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
'''

# Sizes on the cylinder. The fine surface is finest where the bones touch first.
COARSE = '6.'
FINE = ('0.2 + 0.9*(1 - 1/(1 + (((x+11)*(x+11) + y*y)/100)^2) - 1/(1 + (((x-11)*(x-11) + y*y)/100)^2))'
        ' + 0.02*(z + 21)')


def bump(x, y, x0, y0, a, b):
    return np.exp(-((x - x0) / a) ** 2 - ((y - y0) / b) ** 2)


def irregular(p, amplitude, seed):
    """A smooth displacement: waves of random directions, 12 to 30 mm long."""
    random = np.random.RandomState(seed)
    u = np.zeros_like(p)
    for _ in range(24):
        direction = random.normal(size=3)
        wave = 2 * np.pi / random.uniform(12., 30.) * direction / np.linalg.norm(direction)
        u += random.normal(size=3) * np.sin(p @ wave + random.uniform(0., 2 * np.pi))[:, None]
    return amplitude / np.sqrt(12.) * u


def bone(p, width, depth, shaft):
    """Narrows the cylinder toward the shaft; the end becomes width x depth."""
    x, y, z = p.T
    s = np.clip(z / 50., 0., 1.)
    s = s * s * (3 - 2 * s)
    return np.stack([x / 30. * ((1 - s) * width + s * shaft), y / 30. * ((1 - s) * depth + s * shaft), z], axis=1)


def near_end(z):
    """1 at the end, falling to 0 up the shaft."""
    t = np.clip((z + 21.) / 45., 0., 1.)
    return (1 - t) ** 2 * (1 + 2 * t)


def femur(p):
    q = bone(p, 38., 30., 15.)
    x, y, z = q.T
    w = near_end(z)
    # Two condyles of different size, the notch between them (deep behind, a groove in front).
    down = 7. * bump(x, y, -19., -3., 15., 24.) + 6. * bump(x, y, 20., -1., 14., 22.)
    up = 5. * bump(x, y, 0., -14., 10., 22.) + 2. * bump(x, y, 0., 18., 10., 14.)
    q[:, 2] = z + w * (up - down)
    q[:, 1] = y - 4. * (z / 50.) ** 2
    return q + irregular(q, .35, 1) * np.clip(1.2 * w, .25, 1.)[:, None]


def tibia(p):
    q = bone(p, 37., 26., 13.)
    x, y, z = q.T
    w = near_end(z)
    # Flatten the end; a deeper dish on one side, a shallow one on the other, the eminence in the middle.
    flat = .62 * np.minimum(z, 0.)
    dish = 3.0 * bump(x, y, -19., -1., 14., 18.) + 1.2 * bump(x, y, 20., 0., 13., 16.)
    eminence = 1.8 * bump(x, y, 0., -2., 8., 12.)
    q[:, 2] = z - flat + w * (dish - eminence)
    q += irregular(q, .3, 2) * np.clip(1.2 * w, .25, 1.)[:, None]
    # Upside down: the end looks up.
    q[:, 1:] *= -1.
    return q


def read(path):
    with open(path) as f:
        lines = f.read().split('\n')
    at = lines.index('$Nodes')
    n = int(lines[at + 1])
    data = np.array([l.split() for l in lines[at + 2:at + 2 + n]], float)
    number = {int(t): i for i, t in enumerate(data[:, 0])}
    at = lines.index('$Elements')
    cells, faces = [], []
    for l in lines[at + 2:at + 2 + int(lines[at + 1])]:
        w = [int(v) for v in l.split()]
        (cells if w[1] == 4 else faces if w[1] == 2 else []).append([w[3]] + [number[v] for v in w[3 + w[2]:]])
    return data[:, 1:], np.array(cells), np.array(faces)


def mesh(size, folder):
    """Triangles of the cylinder."""
    geo, out = os.path.join(folder, 'bone.geo'), os.path.join(folder, 'bone.msh')
    with open(geo, 'w') as f:
        f.write(GEO % size)
    subprocess.run(['gmsh', '-2', '-format', 'msh22', geo, '-o', out], check=True,
                   stdout=subprocess.DEVNULL)
    return read(out)


def quality(x, cells):
    """Mean ratios."""
    v = x[cells[:, 1:]]
    volume = np.einsum('ij,ij->i', np.cross(v[:, 1] - v[:, 0], v[:, 2] - v[:, 0]), v[:, 3] - v[:, 0]) / 6
    squares = sum(((v[:, i] - v[:, j]) ** 2).sum(1) for i in range(4) for j in range(i))
    return 12 * np.sign(volume) * (3 * abs(volume)) ** (2 / 3) / squares


VOLUME = '''
Merge "surface.msh";
Surface Loop(1) = {2, 3, 4};
Volume(1) = {1};
Physical Volume("%s") = {1};
Physical Surface("cap") = {2};
Physical Surface("%s") = {3};
Physical Surface("shaft") = {4};
Mesh.MeshSizeExtendFromBoundary = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.6;
'''


def write_mesh(path, x, faces, body, end):
    """Fills the surface with tetrahedra."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'surface.msh'), 'w') as f:
            f.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n' % len(x))
            for i, p in enumerate(x):
                f.write('%d %.9g %.9g %.9g\n' % (i + 1, *p))
            f.write('$EndNodes\n$Elements\n%d\n' % len(faces))
            for i, e in enumerate(faces):
                f.write('%d 2 2 %d %d %d %d %d\n' % (i + 1, e[0], e[0], *(v + 1 for v in e[1:])))
            f.write('$EndElements\n')
        geo, text = os.path.join(folder, 'volume.geo'), os.path.join(folder, 'volume.msh')
        with open(geo, 'w') as f:
            f.write(VOLUME % (body, end))
        for form, out in (('msh22', text), ('msh41', path)):
            subprocess.run(['gmsh', '-3', *(['-bin'] if form == 'msh41' else []),
                            '-format', form, geo, '-o', out], check=True, stdout=subprocess.DEVNULL)
        return read(text)


def write_surface(path, x, faces):
    used = np.unique(faces[:, 1:])
    number = np.zeros(len(x), int)
    number[used] = np.arange(len(used))
    triangles = np.zeros(len(faces), dtype=[('n', 'u1'), ('v', '<i4', 3)])
    triangles['n'] = 3
    triangles['v'] = number[faces[:, 1:]]
    with open(path, 'wb') as f:
        f.write(('ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n'
                 'property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n'
                 % (len(used), len(faces))).encode())
        f.write(x[used].astype('<f4').tobytes())
        f.write(triangles.tobytes())


def smallest_gap(f, t, sign):
    """The smallest vertical distance of two sets of points on one side (by nearest points), and x there."""
    best = np.inf, 0.
    for p in f[f[:, 0] * sign > 3.]:
        near = np.hypot(t[:, 0] - p[0], t[:, 1] - p[1]) < 1.
        if near.any() and p[2] - t[near, 2].max() < best[0]:
            best = p[2] - t[near, 2].max(), p[0]
    return best


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        coarse, fine = mesh(COARSE, temporary)[::2], mesh(FINE, temporary)
    end = fine[2][fine[2][:, 0] == TAGS['end']]
    # The tibia comes up to 0.2 mm, and is tilted a little so that both condyles come as near.
    f, t = femur(fine[0])[np.unique(end[:, 1:])], tibia(fine[0])[np.unique(end[:, 1:])]
    sides = [smallest_gap(f, t, sign) for sign in (-1, 1)]
    slope = (sides[1][0] - sides[0][0]) / (sides[1][1] - sides[0][1])
    height = sides[0][0] - slope * sides[0][1] - .2
    place = {'femur': lambda x: x, 'tibia': lambda x: x + np.outer(height + slope * x[:, 0], [0., 0., 1.])}
    for name, shape, surface in (('femur', femur, 'condyles'), ('tibia', tibia, 'plateau')):
        x = place[name](shape(coarse[0])).astype('<f4').astype(float)
        x, cells, _ = write_mesh(os.path.join(folder, name + '.msh'), x, coarse[1], name, surface)
        print(f'{name}: {len(cells)} tetrahedra, worst quality {quality(x, cells).min():.3f}; '
              f'{len(fine[2])} triangles')
        write_surface(os.path.join(folder, name + '.ply'), place[name](shape(fine[0])), fine[2])


# gmsh numbers physical names in the order of the file, all dimensions together.
TAGS = {'bone': 1, 'cap': 2, 'end': 3, 'shaft': 4}

if __name__ == '__main__':
    main()

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef tests_mesh_start_meshes_h
#define tests_mesh_start_meshes_h

#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/tetrahedron_bisection.h>
#include <signorini/mesh/volume_mesh.h>

#include <map>

namespace Signorini
{
  /// The tetrahedra of a mesh; faces of one cell only have the boundary id 7, volumes become materials.
  inline std::vector<Tetrahedron> tetrahedra_of(const VolumeMesh &mesh)
  {
    std::map<VolumeMesh::Face, unsigned int> names;
    for (const auto &face : find_boundary_faces(mesh))
      names[face_key(face.first)] = 7;
    std::vector<Tetrahedron> cells;
    for (const auto &cell : mesh.cells)
      {
        cells.emplace_back();
        cells.back().material = cell.volume;
        for (unsigned int f = 0; f < 4; ++f)
          {
            VolumeMesh::Face face;
            face.fill(VolumeMesh::no_vertex);
            for (unsigned int i = 0; i < 3; ++i)
              face[i] = cell.vertices[CellShape::face(4, f)[i]];
            cells.back().vertices[f] = cell.vertices[f];
            cells.back().boundary[f] =
                names.count(face_key(face)) > 0 ? names[face_key(face)] : Tetrahedron::inner;
          }
      }
    return cells;
  }

  inline VolumeMesh regular_tetrahedron()
  {
    VolumeMesh mesh;
    mesh.vertices     = {dealii::Point<3>(1, 1, 1), dealii::Point<3>(1, -1, -1), dealii::Point<3>(-1, 1, -1),
                         dealii::Point<3>(-1, -1, 1)};
    mesh.cells        = {{{{0, 1, 2, 3, 0, 0, 0, 0}}, 4, 0}};
    mesh.volume_names = {"all"};
    mend_orientation(mesh, "test");
    return mesh;
  }

  /// A unit cube of twelve tetrahedra, and others beside it.
  inline VolumeMesh cubes_of_tetrahedra(const unsigned int n = 1)
  {
    VolumeMesh cube;
    for (unsigned int layer = 0; layer <= n; ++layer)
      for (unsigned int v = 0; v < 4; ++v)
        cube.vertices.emplace_back(v & 1, v >> 1, layer);
    for (unsigned int c = 0; c < n; ++c)
      {
        cube.cells.push_back({{}, 8, 0});
        for (unsigned int v = 0; v < 8; ++v)
          cube.cells.back().vertices[v] = 4 * c + v;
      }
    cube.volume_names = {"all"};
    return split_into_tetrahedra(cube);
  }

  /// Two tetrahedra with a common vertex and no common face.
  inline VolumeMesh hanging_by_a_vertex()
  {
    using dealii::Point;
    VolumeMesh mesh;
    mesh.vertices     = {Point<3>(0, 0, 0),  Point<3>(1, 0, 0),  Point<3>(0, 1, 0), Point<3>(0, 0, 1),
                         Point<3>(-1, 0, 0), Point<3>(0, -1, 0), Point<3>(0, 0, -1)};
    mesh.cells        = {{{{0, 1, 2, 3, 0, 0, 0, 0}}, 4, 0}, {{{0, 4, 5, 6, 0, 0, 0, 0}}, 4, 0}};
    mesh.volume_names = {"all"};
    mend_orientation(mesh, "test");
    return mesh;
  }

  /// Of gmsh.
  inline VolumeMesh unstructured_tetrahedra()
  {
    return read_volume_mesh(SIGNORINI_SOURCE_DIR "/prm/hertz/half_sphere_on_cube.msh", MPI_COMM_WORLD);
  }
} // namespace Signorini

#endif

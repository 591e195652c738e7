// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  std::array<Point<3>, 8> VolumeMesh::corners(const Cell &cell) const
  {
    std::array<Point<3>, 8> x;
    for (unsigned int v = 0; v < cell.n_vertices; ++v)
      x[v] = vertices[cell.vertices[v]];
    return x;
  }



  VolumeMesh::Face face_key(VolumeMesh::Face face)
  {
    std::sort(face.begin(), face.end());
    return face;
  }



  namespace
  {
    /// A face as a cell has it; both sides of an inner face have the same key.
    struct CellFace
    {
      VolumeMesh::Face key, face;
      unsigned int     cell;
    };

    VolumeMesh::Face face_of_cell(const VolumeMesh::Cell &cell, const unsigned int f)
    {
      VolumeMesh::Face face;
      face[3] = VolumeMesh::no_vertex;
      if (cell.n_vertices == CellShape::hexahedron)
        for (unsigned int v = 0; v < 4; ++v)
          face[v] = cell.vertices[GeometryInfo<3>::face_to_cell_vertices(f, v)];
      else
        for (unsigned int v = 0; v < 3; ++v)
          face[v] = cell.vertices[CellShape::face(4, f)[v]];
      return face;
    }

    /// Of all cells; those with the same key follow each other, in the order of their cells. Faces are dealt
    /// out by their smallest vertex first: what is left to sort are a few dozen.
    std::vector<CellFace> sorted_faces(const VolumeMesh &mesh)
    {
      const auto for_all_faces = [&](const auto &visit) {
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          for (unsigned int f = 0; f < CellShape::n_faces(mesh.cells[c].n_vertices); ++f)
            visit(face_of_cell(mesh.cells[c], f), c);
      };
      std::vector<std::size_t> end(mesh.vertices.size() + 1, 0);
      for_all_faces([&](const VolumeMesh::Face &face, const unsigned int) {
        ++end[*std::min_element(face.begin(), face.end()) + 1];
      });
      std::partial_sum(end.begin(), end.end(), end.begin());
      std::vector<CellFace> faces(end.back());
      for_all_faces([&](const VolumeMesh::Face &face, const unsigned int cell) {
        const VolumeMesh::Face key = face_key(face);
        faces[end[key[0]]++]       = {key, face, cell};
      });
      for (std::size_t v = 0, begin = 0; v < mesh.vertices.size(); begin = end[v], ++v)
        std::sort(faces.begin() + begin, faces.begin() + end[v], [](const CellFace &a, const CellFace &b) {
          return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
        });
      return faces;
    }

    bool have_same_vertices(VolumeMesh::Cell a, VolumeMesh::Cell b)
    {
      for (VolumeMesh::Cell *cell : {&a, &b})
        {
          std::fill(cell->vertices.begin() + cell->n_vertices, cell->vertices.end(), VolumeMesh::no_vertex);
          std::sort(cell->vertices.begin(), cell->vertices.end());
        }
      return a.vertices == b.vertices;
    }

    /// Refuses what no mesh may have: cells that are there twice, more than two cells at a face.
    void check_sides(const VolumeMesh &mesh, const std::vector<CellFace> &faces, const std::size_t begin,
                     const std::size_t end)
    {
      std::ostringstream message;
      for (std::size_t j = begin + 1; j < end; ++j)
        for (std::size_t k = begin; k < j; ++k)
          if (have_same_vertices(mesh.cells[faces[j].cell], mesh.cells[faces[k].cell]))
            {
              message << "the cell near (" << mesh.vertices[faces[j].face[0]]
                      << ") is there twice. Take the copy out (gmsh's format 2 writes the cells of a volume "
                         "once for each of its physical groups).";
              throw InputError(message.str());
            }
      if (end - begin > 2)
        {
          message << "a face near (" << mesh.vertices[faces[begin].face[0]] << ") belongs to " << end - begin
                  << " cells. Do cells overlap?";
          throw InputError(message.str());
        }
    }
  } // namespace



  BoundaryOfCells find_boundary_faces(const VolumeMesh &mesh)
  {
    const std::vector<CellFace> faces = sorted_faces(mesh);
    BoundaryOfCells             boundary;
    for (std::size_t begin = 0, end; begin < faces.size(); begin = end)
      {
        for (end = begin + 1; end < faces.size() && faces[end].key == faces[begin].key;)
          ++end;
        check_sides(mesh, faces, begin, end);
        if (end - begin == 1)
          boundary.emplace_back(faces[begin].face, faces[begin].cell);
      }
    return boundary;
  }



  unsigned int index_of(std::vector<std::string> &names, const std::string &name)
  {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it != names.end())
      return static_cast<unsigned int>(it - names.begin());
    names.push_back(name);
    return static_cast<unsigned int>(names.size()) - 1;
  }



  void name_faces(VolumeMesh &mesh, const BoundaryOfCells &boundary, FaceNames named)
  {
    mesh.faces.clear();
    std::map<std::set<unsigned int>, unsigned int>    boundary_of;
    std::map<unsigned int, std::vector<unsigned int>> members;
    for (const auto &[face, cell] : boundary)
      {
        std::set<unsigned int> names;
        if (const auto it = named.of_face.find(face_key(face)); it != named.of_face.end())
          names = it->second;
        else
          names = {index_of(named.names, "unnamed")};
        const auto [it, is_new] =
            boundary_of.insert({names, static_cast<unsigned int>(mesh.boundary_names.size())});
        if (is_new)
          {
            std::string name;
            for (const unsigned int i : names)
              {
                name += (name.empty() ? "" : " & ") + named.names[i];
                members[i].push_back(it->second);
              }
            mesh.boundary_names.push_back(name);
          }
        mesh.faces.push_back({face, it->second});
      }
    for (const auto &[i, boundaries] : members)
      if (boundaries.size() > 1 || mesh.boundary_names[boundaries[0]] != named.names[i])
        mesh.boundary_groups.emplace_back(named.names[i], boundaries);
  }



  std::vector<unsigned int> connected_parts(const VolumeMesh &mesh)
  {
    // Union of the vertices of each cell.
    std::vector<unsigned int> root(mesh.vertices.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](unsigned int v) {
      while (root[v] != v)
        v = root[v] = root[root[v]];
      return v;
    };
    for (const VolumeMesh::Cell &cell : mesh.cells)
      for (unsigned int v = 1; v < cell.n_vertices; ++v)
        root[find(cell.vertices[v])] = find(cell.vertices[0]);
    std::map<unsigned int, unsigned int> number;
    std::vector<unsigned int>            part;
    for (const VolumeMesh::Cell &cell : mesh.cells)
      part.push_back(
          number.insert({find(cell.vertices[0]), static_cast<unsigned int>(number.size())}).first->second);
    return part;
  }



  void mend_orientation(VolumeMesh &mesh, const std::string &where)
  {
    std::size_t n_mended = 0;
    for (VolumeMesh::Cell &cell : mesh.cells)
      {
        const bool is_hexahedron = cell.n_vertices == CellShape::hexahedron;
        const auto quality       = [&]() {
          const auto x = mesh.corners(cell);
          return is_hexahedron ? scaled_jacobian(x) : tetrahedron_quality({{x[0], x[1], x[2], x[3]}});
        };
        // Rounding of the coordinates alone gives a flat cell a quality of this order.
        constexpr double flat = 1e-12;
        if (quality() > flat)
          continue;
        if (is_hexahedron)
          std::swap_ranges(cell.vertices.begin(), cell.vertices.begin() + 4, cell.vertices.begin() + 4);
        else
          std::swap(cell.vertices[0], cell.vertices[1]);
        if (!(quality() > flat))
          {
            std::ostringstream message;
            message << where << ": inverted or degenerate cell near (" << mesh.vertices[cell.vertices[0]]
                    << "). Mend the mesh.";
            throw InputError(message.str());
          }
        ++n_mended;
      }
    if (n_mended > 0)
      mesh.notes.push_back(where + ": " + std::to_string(n_mended) +
                           " cells of mirrored orientation mended.");
  }



  VolumeMesh split_into_hexahedra(const VolumeMesh &mesh)
  {
    VolumeMesh result = mesh;
    result.cells      = {};
    result.faces      = {};
    std::map<std::vector<unsigned int>, unsigned int> middles;
    const auto                                        middle = [&](std::vector<unsigned int> corners) {
      std::sort(corners.begin(), corners.end());
      const auto [it, is_new] = middles.insert({corners, static_cast<unsigned int>(result.vertices.size())});
      if (is_new)
        {
          Point<3> p;
          for (const unsigned int v : corners)
            p += mesh.vertices[v] / static_cast<double>(corners.size());
          result.vertices.push_back(p);
        }
      return it->second;
    };
    for (const VolumeMesh::Cell &cell : mesh.cells)
      if (cell.n_vertices == CellShape::hexahedron)
        result.cells.push_back(cell);
      else
        {
          const auto &v = cell.vertices;
          // At corner a the edges to b, c, d are right-handed.
          constexpr unsigned int around[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
          for (unsigned int i = 0; i < 4; ++i)
            {
              const unsigned int a = v[i], b = v[around[i][0]], c = v[around[i][1]], d = v[around[i][2]];
              result.cells.push_back({{{a, middle({a, b}), middle({a, c}), middle({a, b, c}), middle({a, d}),
                                        middle({a, b, d}), middle({a, c, d}), middle({a, b, c, d})}},
                                      8,
                                      cell.volume});
            }
        }
    for (const VolumeMesh::BoundaryFace &face : mesh.faces)
      if (face.vertices[3] != VolumeMesh::no_vertex)
        result.faces.push_back(face);
      else
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = face.vertices[i], b = face.vertices[(i + 1) % 3],
                               c = face.vertices[(i + 2) % 3];
            // Lexicographic: the centre is opposite to the corner.
            result.faces.push_back({{{a, middle({a, b}), middle({a, c}), middle({a, b, c})}}, face.name});
          }
    return result;
  }



  namespace
  {
    /// The two triangles of a quadrilateral that is run through in a circle.
    std::array<std::array<unsigned int, 3>, 2> halves(std::array<unsigned int, 4> loop)
    {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      return {{{{loop[0], loop[1], loop[2]}}, {{loop[0], loop[2], loop[3]}}}};
    }
  } // namespace



  namespace
  {
    void add_halves_of_faces(VolumeMesh &result, const VolumeMesh &mesh)
    {
      for (const VolumeMesh::BoundaryFace &face : mesh.faces)
        if (face.vertices[3] == VolumeMesh::no_vertex)
          result.faces.push_back(face);
        else
          for (const auto &[a, b, c] :
               halves({{face.vertices[0], face.vertices[1], face.vertices[3], face.vertices[2]}}))
            result.faces.push_back({{{a, b, c, VolumeMesh::no_vertex}}, face.name});
    }
  } // namespace



  VolumeMesh split_into_tetrahedra(const VolumeMesh &mesh)
  {
    VolumeMesh result = mesh;
    result.cells      = {};
    result.faces      = {};
    for (const VolumeMesh::Cell &cell : mesh.cells)
      {
        if (cell.n_vertices == CellShape::tetrahedron)
          {
            result.cells.push_back(cell);
            continue;
          }
        Point<3> middle;
        for (const unsigned int v : cell.vertices)
          middle += .125 * mesh.vertices[v];
        const unsigned int centre = static_cast<unsigned int>(result.vertices.size());
        result.vertices.push_back(middle);
        for (unsigned int f = 0; f < 6; ++f)
          {
            const auto corners = CellShape::face(8, f);
            for (const auto &[a, b, c] : halves({{cell.vertices[corners[0]], cell.vertices[corners[1]],
                                                  cell.vertices[corners[2]], cell.vertices[corners[3]]}}))
              // Seen from outside counterclockwise: the centre lies behind.
              result.cells.push_back({{{a, c, b, centre, 0, 0, 0, 0}}, 4, cell.volume});
          }
      }
    add_halves_of_faces(result, mesh);
    return result;
  }



  double scaled_jacobian(const std::array<Point<3>, 8> &corners)
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int v = 0; v < 8; ++v)
      {
        std::array<Tensor<1, 3>, 3> edges;
        double                      sign = 1., lengths = 1.;
        for (unsigned int c = 0; c < 3; ++c)
          {
            edges[c] = corners[v ^ (1u << c)] - corners[v];
            sign *= (v & (1u << c)) ? -1. : 1.;
            lengths *= edges[c].norm();
          }
        const double volume = sign * (cross_product_3d(edges[0], edges[1]) * edges[2]);
        smallest            = std::min(smallest, lengths > 0. ? volume / lengths : 0.);
      }
    return smallest;
  }
} // namespace Signorini

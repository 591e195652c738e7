// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "extruded_mesh.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/generated_mesh.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Hexahedra = std::vector<std::array<Point<3>, 8>>;

    /// Corner (i, j, k) of the inner cube of an octant of the unit ball.
    Point<3> cube_corner(const unsigned int v)
    {
      // Half the radius along the axes, less along the diagonals: keeps all angles well above zero.
      static const double scale[] = {0., .5, .43, .38};
      const Point<3>      p(v & 1, v >> 1 & 1, v >> 2);
      return Point<3>(scale[(v & 1) + (v >> 1 & 1) + (v >> 2)] * p);
    }

    Point<3> on_sphere(const unsigned int v, const double radius)
    {
      const Point<3> p(v & 1, v >> 1 & 1, v >> 2);
      return Point<3>(radius / p.norm() * p);
    }

    /// Cells of the octant x, y, z >= 0 of the ball.
    Hexahedra ball_octant(const double radius)
    {
      Hexahedra cells(4);
      for (unsigned int v = 0; v < 8; ++v)
        {
          cells[0][v] = Point<3>(radius * cube_corner(v));
          for (unsigned int axis = 0; axis < 3; ++axis)
            {
              const unsigned int corner = v | (1u << axis);
              cells[1 + axis][v] =
                  (v >> axis & 1) ? on_sphere(corner, radius) : Point<3>(radius * cube_corner(corner));
            }
        }
      return cells;
    }

    /// Cells of the octant of a shell: three patches, layers of near-cubic cells.
    Hexahedra shell_octant(const double inner, const double outer)
    {
      const double       width = .7 * (inner + outer) / 2.;
      const unsigned int layers =
          std::max(1u, static_cast<unsigned int>(std::round((outer - inner) / width)));
      Hexahedra cells;
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (unsigned int layer = 0; layer < layers; ++layer)
          {
            cells.emplace_back();
            for (unsigned int v = 0; v < 8; ++v)
              {
                const double r  = inner + (outer - inner) * (layer + (v >> axis & 1)) / layers;
                cells.back()[v] = on_sphere(v | (1u << axis), r);
              }
          }
      return cells;
    }

    /// Cells of the quarter x, y >= 0 of a cylinder below z = 0.
    Hexahedra cylinder_quarter(const double radius, const double height)
    {
      const auto disk = [&](const unsigned int v, const bool outside) {
        static const double scale[] = {0., .5, .42};
        const Point<3>      p(v & 1, v >> 1 & 1, 0.);
        return Point<3>((outside ? 1. / p.norm() : scale[(v & 1) + (v >> 1 & 1)]) * radius * p);
      };
      const unsigned int layers = std::max(1u, static_cast<unsigned int>(std::round(height / (.5 * radius))));
      Hexahedra          cells;
      for (unsigned int layer = 0; layer < layers; ++layer)
        for (int patch = -1; patch < 2; ++patch)
          {
            cells.emplace_back();
            for (unsigned int v = 0; v < 8; ++v)
              {
                Point<3> p      = patch < 0 ? disk(v, false) : disk(v | (1u << patch), v >> patch & 1);
                p[2]            = -height + height * (layer + (v >> 2)) / layers;
                cells.back()[v] = p;
              }
          }
      return cells;
    }

    /// Adds the mirror image of all cells in the plane through the origin normal to an axis.
    void mirror(Hexahedra &cells, const unsigned int axis)
    {
      const std::size_t n = cells.size();
      for (std::size_t cell = 0; cell < n; ++cell)
        {
          cells.emplace_back();
          for (unsigned int v = 0; v < 8; ++v)
            {
              cells.back()[v] = cells[cell][v ^ (1u << axis)];
              cells.back()[v][axis] *= -1.;
            }
        }
    }

    /// Turns the octant z >= 0 into z <= 0 (a half turn that swaps x and y: cells stay right-handed).
    void turn_down(Hexahedra &cells)
    {
      for (auto &cell : cells)
        for (Point<3> &p : cell)
          p = Point<3>(p[1], p[0], -p[2]);
    }

    /// Places of the vertices of a block in one direction, from 0 to 1.
    std::vector<double> block_places(const GeneratedMeshParameters &p, const unsigned int c)
    {
      static const std::array<std::array<const char *, 2>, 3> names = {
          {{{"left", "right"}}, {{"front", "back"}}, {{"bottom", "top"}}}};
      const MeshGrading &grading = p.grading;
      if (grading.boundary == names[c][0] || grading.boundary == names[c][1])
        return graded_places(p.divisions[c], grading.boundary == names[c][0] ? 0. : 1., grading.ratio);
      const double at = (grading.point[c] - p.lower_corner[c]) / (p.upper_corner[c] - p.lower_corner[c]);
      return graded_places(p.divisions[c], std::clamp(at, 0., 1.),
                           grading.boundary.empty() ? grading.ratio : 1.);
    }

    void check_grading_of_block(const MeshGrading &grading)
    {
      if (!(grading.ratio >= 1. && grading.ratio <= 1e4))
        throw InputError("Grading: the ratio of the largest and the smallest cells must be between 1 and "
                         "10000.");
      for (const char *name : {"", "left", "right", "front", "back", "bottom", "top"})
        if (grading.boundary == name)
          return;
      throw InputError("Grading: a block has no boundary \"" + grading.boundary +
                       "\"; it has left, right, front, back, bottom, top.");
    }

    Hexahedra block(const GeneratedMeshParameters &p)
    {
      check_grading_of_block(p.grading);
      std::array<std::vector<double>, 3> places;
      for (unsigned int c = 0; c < 3; ++c)
        places[c] = block_places(p, c);
      Hexahedra cells;
      for (unsigned int k = 0; k < p.divisions[2]; ++k)
        for (unsigned int j = 0; j < p.divisions[1]; ++j)
          for (unsigned int i = 0; i < p.divisions[0]; ++i)
            {
              cells.emplace_back();
              for (unsigned int v = 0; v < 8; ++v)
                {
                  const unsigned int at[] = {i + (v & 1), j + (v >> 1 & 1), k + (v >> 2)};
                  for (unsigned int c = 0; c < 3; ++c)
                    cells.back()[v][c] =
                        p.lower_corner[c] + (p.upper_corner[c] - p.lower_corner[c]) * places[c][at[c]];
                }
            }
      return cells;
    }

    /// Joins cells at coinciding corners.
    VolumeMesh join(const Hexahedra &cells, const double size)
    {
      VolumeMesh                                  mesh;
      std::map<std::array<long, 3>, unsigned int> numbers;
      for (const auto &cell : cells)
        {
          mesh.cells.push_back({{}, 8, 0});
          for (unsigned int v = 0; v < 8; ++v)
            {
              std::array<long, 3> key;
              for (unsigned int c = 0; c < 3; ++c)
                key[c] = std::lround(cell[v][c] / size * 1e7);
              const auto [it, is_new] =
                  numbers.insert({key, static_cast<unsigned int>(mesh.vertices.size())});
              if (is_new)
                mesh.vertices.push_back(cell[v]);
              mesh.cells.back().vertices[v] = it->second;
            }
        }
      mesh.volume_names.assign(1, "volume");
      return mesh;
    }

    using Classifier = std::function<std::string(const std::array<Point<3>, 4> &)>;

    bool all_of(const std::array<Point<3>, 4> &face, const std::function<double(const Point<3> &)> &distance,
                const double size)
    {
      return std::all_of(face.begin(), face.end(),
                         [&](const Point<3> &p) { return std::abs(distance(p)) < 1e-6 * size; });
    }

    void name_boundaries(VolumeMesh &mesh, const Classifier &classify)
    {
      for (const auto &[vertices, cell] : find_boundary_faces(mesh))
        {
          (void)cell;
          std::array<Point<3>, 4> points;
          for (unsigned int v = 0; v < 4; ++v)
            points[v] = mesh.vertices[vertices[v]];
          const std::string name = classify(points);
          auto              it   = std::find(mesh.boundary_names.begin(), mesh.boundary_names.end(), name);
          if (it == mesh.boundary_names.end())
            it = mesh.boundary_names.insert(it, name);
          mesh.faces.push_back({vertices, static_cast<unsigned int>(it - mesh.boundary_names.begin())});
        }
    }

    /// First of the tests that all corners of a face pass.
    Classifier first_match(std::vector<std::pair<std::string, std::function<double(const Point<3> &)>>> tests,
                           const double                                                                 size)
    {
      return [tests, size](const std::array<Point<3>, 4> &face) {
        for (const auto &[name, distance] : tests)
          if (all_of(face, distance, size))
            return name;
        return std::string("unnamed");
      };
    }

    GeneratedMesh generate_block(const GeneratedMeshParameters &p)
    {
      for (unsigned int c = 0; c < 3; ++c)
        {
          require_positive(p.upper_corner[c] - p.lower_corner[c], "Upper corner minus Lower corner");
          require_positive(p.divisions[c], "Divisions");
        }
      const double size = p.lower_corner.distance(p.upper_corner);
      // Relative to the lower corner, so that joining and naming do not suffer from an offset.
      Hexahedra cells = block(p);
      for (auto &cell : cells)
        for (Point<3> &v : cell)
          v = Point<3>(v - p.lower_corner);
      VolumeMesh     mesh = join(cells, size);
      const Point<3> up   = Point<3>(p.upper_corner - p.lower_corner);
      name_boundaries(mesh, first_match({{"left", coordinate_plane(0, 0.)},
                                         {"right", coordinate_plane(0, up[0])},
                                         {"front", coordinate_plane(1, 0.)},
                                         {"back", coordinate_plane(1, up[1])},
                                         {"bottom", coordinate_plane(2, 0.)},
                                         {"top", coordinate_plane(2, up[2])}},
                                        size));
      for (Point<3> &v : mesh.vertices)
        v += p.lower_corner;
      return {mesh, {}};
    }

    GeneratedMesh generate_cylinder(const GeneratedMeshParameters &p)
    {
      require_positive(p.radius, "Radius");
      require_positive(p.height, "Height");
      Hexahedra cells = cylinder_quarter(p.radius, p.height);
      if (!kind_has(p, "quarter"))
        {
          mirror(cells, 0);
          mirror(cells, 1);
        }
      VolumeMesh mesh = join(cells, p.radius);
      name_boundaries(
          mesh, first_match({{"top", coordinate_plane(2, 0.)},
                             {"bottom", coordinate_plane(2, -p.height)},
                             {"side", [&](const Point<3> &v) { return std::hypot(v[0], v[1]) - p.radius; }},
                             {"symmetry x", coordinate_plane(0, 0.)},
                             {"symmetry y", coordinate_plane(1, 0.)}},
                            p.radius));
      return {mesh, {{"side", CurvedBoundary::cylinder}}};
    }

    /// Balls and spherical shells.
    GeneratedMesh generate_ball(const GeneratedMeshParameters &p)
    {
      require_positive(p.radius, "Radius");
      const bool shell = kind_has(p, "shell"), half = kind_has(p, "half"), eighth = kind_has(p, "eighth");
      if (shell)
        {
          require_positive(p.inner_radius, "Inner radius");
          require_positive(p.radius - p.inner_radius, "Radius minus Inner radius");
        }
      Hexahedra cells = shell ? shell_octant(p.inner_radius, p.radius) : ball_octant(p.radius);
      if (half)
        turn_down(cells);
      if (!kind_has(p, "quarter") && !eighth)
        {
          mirror(cells, 0);
          mirror(cells, 1);
        }
      if (!half && !eighth)
        mirror(cells, 2);
      VolumeMesh        mesh  = join(cells, p.radius);
      const std::string outer = shell ? "outer" : "sphere", flat = half ? "top" : "symmetry z";
      name_boundaries(mesh,
                      first_match({{outer, [&](const Point<3> &v) { return v.norm() - p.radius; }},
                                   {"inner", [&](const Point<3> &v) { return v.norm() - p.inner_radius; }},
                                   {flat, coordinate_plane(2, 0.)},
                                   {"symmetry x", coordinate_plane(0, 0.)},
                                   {"symmetry y", coordinate_plane(1, 0.)}},
                                  p.radius));
      GeneratedMesh result{mesh, {{outer, CurvedBoundary::sphere}}};
      if (shell)
        result.curved.push_back({"inner", CurvedBoundary::sphere});
      return result;
    }

    GeneratedMesh generate_extruded(const GeneratedMeshParameters &p)
    {
      const ShapedCells shaped = extruded_cells(p);
      VolumeMesh        mesh   = join(shaped.cells, shaped.size);
      name_boundaries(mesh, first_match(shaped.boundaries, shaped.size));
      GeneratedMesh result{mesh, {}};
      for (const CurvedBoundary &curved : shaped.curved)
        result.curved.push_back(curved);
      return result;
    }
  } // namespace



  std::string generated_mesh_kinds()
  {
    return "block|ball|half ball|quarter of ball|quarter of half ball|eighth of ball|cylinder|quarter of "
           "cylinder|"
           "spherical shell|quarter of spherical shell|eighth of spherical shell|annulus|half annulus|"
           "quarter of annulus|tube|half tube|quarter of tube|half cylinder|half of half cylinder|prism";
  }



  GeneratedMesh generate_mesh(const GeneratedMeshParameters &p)
  {
    if (p.kind == "block")
      return generate_block(p);
    if (is_extruded(p.kind))
      return generate_extruded(p);
    if (p.grading.ratio != 1.)
      throw InputError("Grading: a " + p.kind + " cannot be graded; refine it where that is needed.");
    return kind_has(p, "cylinder") ? generate_cylinder(p) : generate_ball(p);
  }
} // namespace Signorini

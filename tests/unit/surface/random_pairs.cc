// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "random_pair.h"

#include <cstdlib>

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// Turns, moves and scales a surface.
  SurfaceMesh moved(SurfaceMesh mesh, const Tensor<2, 3> &rotation, const Tensor<1, 3> &shift,
                    const double scale)
  {
    for (Point<3> &p : mesh.vertices)
      p = Point<3>(scale * (rotation * p + shift));
    mesh.compute_vertex_normals();
    return mesh;
  }

  /// New numbers for vertices and triangles.
  SurfaceMesh renumbered(const SurfaceMesh &mesh, std::mt19937 &random)
  {
    std::vector<unsigned int> number(mesh.vertices.size());
    std::iota(number.begin(), number.end(), 0u);
    std::shuffle(number.begin(), number.end(), random);
    SurfaceMesh result = mesh;
    for (std::size_t v = 0; v < number.size(); ++v)
      {
        result.vertices[number[v]]       = mesh.vertices[v];
        result.vertex_normals[number[v]] = mesh.vertex_normals[v];
      }
    for (auto &t : result.triangles)
      {
        for (unsigned int &v : t)
          v = number[v];
        std::rotate(t.begin(), t.begin() + random() % 3, t.end());
      }
    std::shuffle(result.triangles.begin(), result.triangles.end(), random);
    return result;
  }

  Tensor<2, 3> random_rotation(RandomPair &pair)
  {
    Tensor<1, 3> a, b;
    for (unsigned int c = 0; c < 3; ++c)
      {
        a[c] = pair.uniform() - .5;
        b[c] = pair.uniform() - .5;
      }
    a /= a.norm();
    b -= (a * b) * a;
    b /= b.norm();
    const Tensor<1, 3> c = cross_product_3d(a, b);
    Tensor<2, 3>       rotation;
    for (unsigned int i = 0; i < 3; ++i)
      {
        rotation[i][0] = a[i];
        rotation[i][1] = b[i];
        rotation[i][2] = c[i];
      }
    return rotation;
  }

  std::string check(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar, const bool is_covered,
                    MappingReport &report)
  {
    const ContactMapping mapping(nonmortar, mortar);
    report = mapping.report();
    return violated_invariant(nonmortar, mortar, mapping, is_covered);
  }

  std::string differing(const MappingReport &a, const MappingReport &b, const double scale)
  {
    if (a.n_flips > 0 || b.n_flips > 0)
      return "";
    if (a.n_pairs != b.n_pairs || a.n_cells != b.n_cells)
      return std::to_string(b.n_pairs) + " pairs and " + std::to_string(b.n_cells) + " cells instead of " +
             std::to_string(a.n_pairs) + " and " + std::to_string(a.n_cells);
    if (std::abs(b.area_covered / (scale * scale) - a.area_covered) > 1e-9 * a.area_nonmortar)
      return "another area";
    return "";
  }
} // namespace



// SIGNORINI_RANDOM_PAIRS=10000 for the long run. A pair that fails is written to OFF files.
TEST(RandomPairs, Invariants)
{
  const char        *wanted  = std::getenv("SIGNORINI_RANDOM_PAIRS");
  const unsigned int n_pairs = wanted ? static_cast<unsigned int>(std::stoul(wanted)) : 500;
  for (unsigned int seed = 0; seed < n_pairs; ++seed)
    {
      RandomPair    pair(seed);
      MappingReport original, other;
      std::string   error = check(pair.nonmortar, pair.mortar, pair.is_covered, original);
      SurfaceMesh   non = pair.nonmortar, mor = pair.mortar;
      if (error.empty())
        {
          non   = renumbered(pair.nonmortar, pair.random);
          mor   = renumbered(pair.mortar, pair.random);
          error = check(non, mor, pair.is_covered, other);
          if (error.empty())
            error = differing(original, other, 1.);
          if (!error.empty())
            error = "renumbered: " + error;
        }
      if (error.empty())
        {
          const Tensor<2, 3> rotation = random_rotation(pair);
          const Tensor<1, 3> shift    = Point<3>(pair.uniform(), pair.uniform(), pair.uniform());
          const double       scale    = std::pow(10., 18. * pair.uniform() - 9.);
          non                         = moved(pair.nonmortar, rotation, shift, scale);
          mor                         = moved(pair.mortar, rotation, shift, scale);
          error                       = check(non, mor, pair.is_covered, other);
          if (error.empty())
            error = differing(original, other, scale);
          if (!error.empty())
            error = "moved: " + error;
        }
      if (!error.empty())
        {
          const std::string name = testing::TempDir() + "pair_" + std::to_string(seed);
          write_off(name + "_non.off", non);
          write_off(name + "_mor.off", mor);
          ADD_FAILURE() << "pair " << seed << ": " << error << "; written to " << name << "_{non,mor}.off";
        }
    }
}

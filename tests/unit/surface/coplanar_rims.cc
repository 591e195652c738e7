// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Slabs: both surfaces end in the same two planes, and so do all their normals but for rounding. All vertices
// of a rim then lie on the curtains of all edges of the other one's, whatever is between them.

#include "surfaces.h"

#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/normal_projection.h>

namespace
{
  using namespace Signorini;
  using dealii::Point;
  using dealii::Tensor;

  /// A point of a curve in a plane: the number of its two vertices, one in either plane, and the normal
  /// there.
  struct ProfilePoint
  {
    unsigned int          column;
    std::array<double, 2> x, normal;
  };

  /// A flank and the tip of a tooth of a spur gear (module 5, 30 teeth, in contact at (3, 0)), and the tip
  /// and part of the flank of one of the other gear (20 teeth); numbered by gmsh, normals of their smooth
  /// surfaces.
  const std::vector<ProfilePoint> tooth       = {{32, {{4.163, 0.38407}}, {{-0.29258, 0.95624}}},
                                                 {33, {{4.0704, 0.35551}}, {{-0.29678, 0.95495}}},
                                                 {34, {{3.97792, 0.32655}}, {{-0.30092, 0.95365}}},
                                                 {35, {{3.88557, 0.29719}}, {{-0.30499, 0.95236}}},
                                                 {36, {{3.79334, 0.26743}}, {{-0.30901, 0.95106}}},
                                                 {37, {{3.70124, 0.23729}}, {{-0.31298, 0.94976}}},
                                                 {38, {{3.60927, 0.20677}}, {{-0.31689, 0.94846}}},
                                                 {39, {{3.51742, 0.17588}}, {{-0.32076, 0.94716}}},
                                                 {40, {{3.42569, 0.14461}}, {{-0.32456, 0.94586}}},
                                                 {26, {{3.33409, 0.11297}}, {{-0.32832, 0.94457}}},
                                                 {27, {{3.24262, 0.08097}}, {{-0.33203, 0.94327}}},
                                                 {28, {{3.15128, 0.04862}}, {{-0.33568, 0.94198}}},
                                                 {29, {{3.06005, 0.01591}}, {{-0.33929, 0.94068}}},
                                                 {30, {{2.96896, -0.01714}}, {{-0.34286, 0.93939}}},
                                                 {31, {{2.87799, -0.05054}}, {{-0.3464, 0.93809}}},
                                                 {20, {{2.78715, -0.08428}}, {{-0.34989, 0.93679}}},
                                                 {21, {{2.69643, -0.11835}}, {{-0.35334, 0.9355}}},
                                                 {22, {{2.60583, -0.15276}}, {{-0.35675, 0.9342}}},
                                                 {23, {{2.51537, -0.1875}}, {{-0.36013, 0.9329}}},
                                                 {24, {{2.42502, -0.22256}}, {{-0.36346, 0.93161}}},
                                                 {25, {{2.33481, -0.25794}}, {{-0.36676, 0.93031}}},
                                                 {12, {{2.24472, -0.29365}}, {{-0.37003, 0.92902}}},
                                                 {13, {{2.15475, -0.32966}}, {{-0.37326, 0.92773}}},
                                                 {14, {{2.06491, -0.36599}}, {{-0.37646, 0.92643}}},
                                                 {15, {{1.9752, -0.40263}}, {{-0.37963, 0.92514}}},
                                                 {16, {{1.88561, -0.43957}}, {{-0.38277, 0.92384}}},
                                                 {17, {{1.79614, -0.47681}}, {{-0.38588, 0.92255}}},
                                                 {18, {{1.7068, -0.51436}}, {{-0.38896, 0.92126}}},
                                                 {19, {{1.60937, -0.5557}}, {{-0.39228, 0.91985}}},
                                                 {8, {{1.48016, -0.61117}}, {{-0.39664, 0.91797}}},
                                                 {9, {{1.3073, -0.68651}}, {{-0.4024, 0.91546}}},
                                                 {10, {{1.07565, -0.7895}}, {{-0.40998, 0.9121}}},
                                                 {11, {{0.76487, -0.93127}}, {{-0.42001, 0.90752}}},
                                                 {5, {{0.3477, -1.12808}}, {{-0.43341, 0.9012}}},
                                                 {6, {{-0.21171, -1.40429}}, {{-0.45027, 0.89289}}},
                                                 {7, {{-0.96142, -1.79403}}, {{-0.46949, 0.88294}}},
                                                 {2, {{-1.96563, -2.34495}}, {{-0.49225, 0.87046}}},
                                                 {0, {{-1.9393, -3.1159}}, {{-0.99924, -0.03895}}},
                                                 {1, {{-1.90216, -3.95532}}, {{-0.99878, -0.04944}}},
                                                 {3, {{-1.85083, -4.88312}}, {{-0.99814, -0.06104}}},
                                                 {4, {{-1.78064, -5.92021}}, {{-0.99726, -0.074}}}},
                                  other_tooth = {{2, {{-3.38832, -3.4762}}, {{0.99684, -0.07946}}},
                                                 {0, {{-3.3002, -2.0953}}, {{0.99885, -0.04789}}},
                                                 {1, {{-3.25781, -0.82656}}, {{0.03875, -0.99925}}},
                                                 {3, {{-2.12296, -0.78255}}, {{0.03875, -0.99925}}},
                                                 {4, {{-1.23581, -0.74814}}, {{0.03875, -0.99925}}},
                                                 {5, {{-0.54145, -0.72122}}, {{0.03875, -0.99925}}},
                                                 {6, {{0.00291, -0.70011}}, {{0.03875, -0.99925}}},
                                                 {7, {{0.5134, -0.63786}}, {{0.13984, -0.99017}}},
                                                 {8, {{0.88975, -0.57963}}, {{0.17339, -0.98485}}},
                                                 {9, {{1.16719, -0.52676}}, {{0.20315, -0.97915}}},
                                                 {10, {{1.37211, -0.48159}}, {{0.22359, -0.97468}}}};

  /// Of width one, with noise in the normals, its triangles in any order.
  SurfaceMesh slab(const std::vector<ProfilePoint> &profile, const double noise, std::mt19937 &random)
  {
    std::normal_distribution<double> number;
    SurfaceMesh                      mesh;
    mesh.vertices.resize(2 * profile.size());
    mesh.vertex_normals.resize(2 * profile.size());
    for (const ProfilePoint &p : profile)
      for (const unsigned int z : {0, 1})
        {
          mesh.vertices[2 * p.column + z] = Point<3>(p.x[0], p.x[1], z);
          const Tensor<1, 3> normal({p.normal[0], p.normal[1], noise * number(random)});
          mesh.vertex_normals[2 * p.column + z] = normal / normal.norm();
        }
    for (unsigned int i = 0; i + 1 < profile.size(); ++i)
      {
        const unsigned int a = 2 * profile[i].column, b = 2 * profile[i + 1].column;
        const unsigned int c = i % 2 == 0 ? b + 1 : a + 1;
        mesh.triangles.push_back({{a, b, c}});
        mesh.triangles.push_back({{c == b + 1 ? a : b, b + 1, a + 1}});
      }
    // Which edges come first depends on it.
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    return mesh;
  }
} // namespace



// The image of an edge near the tip ran on along the rim beyond its end, took all vertices there, and the
// edges that do pass them were lost.
TEST(CoplanarRims, VerticesLieWhereTheirImagesAre)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> exponent(-18., -10.);
  for (unsigned int i = 0; i < 100; ++i)
    {
      const double          noise     = std::pow(10., exponent(random));
      const SurfaceMesh     nonmortar = slab(tooth, noise, random), mortar = slab(other_tooth, noise, random);
      const ContactMapping  mapping(nonmortar, mortar);
      const SurfaceTopology topology(mortar.triangles, mortar.vertices.size());
      for (const MappingNode &node : mapping.nodes())
        if (node.nonmortar.on == SurfacePoint::On::vertex && node.mortar.on == SurfacePoint::On::edge)
          {
            const auto [a, b]      = topology.edges[node.mortar.index];
            const double       s   = node.mortar.x[0];
            const Tensor<1, 3> n   = (1. - s) * mortar.vertex_normals[a] + s * mortar.vertex_normals[b],
                               way = nonmortar.vertices[node.nonmortar.index] -
                                     (mortar.vertices[a] + s * (mortar.vertices[b] - mortar.vertices[a]));
            EXPECT_LT(cross_product_3d(way, n).norm(), 1e-6 * n.norm())
                << i << ": vertex " << node.nonmortar.index << " on edge " << a << ' ' << b << " at " << s;
          }
    }
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/mapping_quality.h>

#include "random_pair.h"

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// The part of each triangle: slabs in some direction, or any part.
  std::vector<unsigned int> distribute(const SurfaceMesh &mesh, const unsigned int n_parts, RandomPair &pair)
  {
    std::vector<unsigned int> part(mesh.triangles.size());
    const bool                anywhere = pair.number(0, 3) == 0;
    const Tensor<1, 3>        axis     = Point<3>(pair.uniform() - .5, pair.uniform() - .5, 0.);
    for (unsigned int t = 0; t < part.size(); ++t)
      {
        const double x = axis * (mesh.vertices[mesh.triangles[t][0]] - Point<3>(.5, .5, 0.));
        part[t]        = anywhere ? pair.number(0, n_parts - 1)
                                  : static_cast<unsigned int>(std::floor((x + 2.) * 4.)) % n_parts;
      }
    return part;
  }

  /// Area (as part of the nonmortar triangle) for each pair of triangles.
  using Areas = std::map<std::pair<unsigned int, unsigned int>, double>;

  Areas areas_of(const ContactMapping &mapping)
  {
    Areas areas;
    for (const OverlayTriangle &cell : mapping.overlay())
      areas[{cell.nonmortar_triangle, cell.mortar_triangle}] += cell.share();
    return areas;
  }

  /// What differs between a part and the whole.
  std::string differing(const ContactMapping &whole, const ContactMapping &part,
                        const std::function<bool(unsigned int)> &is_selected)
  {
    const Areas of_whole = areas_of(whole), of_part = areas_of(part);
    std::size_t n = 0;
    for (const auto &[triangles, area] : of_whole)
      if (is_selected(triangles.first))
        {
          ++n;
          const auto other = of_part.find(triangles);
          if (other == of_part.end() || std::abs(other->second - area) > 1e-13)
            return "triangles " + std::to_string(triangles.first) + " and " +
                   std::to_string(triangles.second) + " share " + std::to_string(area) + ", in the part " +
                   (other == of_part.end() ? "nothing" : std::to_string(other->second));
        }
    return n == of_part.size() ? "" : "more pairs in the part";
  }
} // namespace



TEST(Parts, OverlayDoesNotDependOnTheSelection)
{
  for (unsigned int seed = 0; seed < 200; ++seed)
    {
      RandomPair                pair(seed);
      const ContactMapping      whole(pair.nonmortar, pair.mortar);
      const unsigned int        n_parts = pair.number(2, 9);
      std::vector<unsigned int> part_of = distribute(pair.nonmortar, n_parts, pair);
      for (unsigned int p = 0; p < n_parts; ++p)
        {
          const auto is_selected = [&](const unsigned int t) { return part_of[t] == p; };
          EXPECT_EQ(differing(whole, ContactMapping(pair.nonmortar, pair.mortar, is_selected), is_selected),
                    "")
              << "pair " << seed;
        }
    }
}



TEST(Parts, RanksTogetherMakeTheWhole)
{
  const MPI_Comm     comm = MPI_COMM_WORLD;
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  for (unsigned int seed = 0; seed < 200; ++seed)
    {
      RandomPair                pair(seed);
      const ContactMapping      whole(pair.nonmortar, pair.mortar);
      std::vector<unsigned int> part_of =
          distribute(pair.nonmortar, dealii::Utilities::MPI::n_mpi_processes(comm), pair);
      const auto           is_selected = [&](const unsigned int t) { return part_of[t] == rank; };
      const ContactMapping part(pair.nonmortar, pair.mortar, is_selected, comm);
      EXPECT_EQ(differing(whole, part, is_selected), "") << "pair " << seed;
      const MappingReport a = whole.report(), b = sum_reports(part.report(), comm);
      EXPECT_EQ(a.unmapped, b.unmapped) << "pair " << seed;
      EXPECT_EQ(a.lost_edges, b.lost_edges) << "pair " << seed;
      EXPECT_EQ(a.n_pairs, b.n_pairs) << "pair " << seed;
      EXPECT_EQ(a.n_cells, b.n_cells) << "pair " << seed;
      EXPECT_NEAR(a.area_covered, b.area_covered, 1e-13 * a.area_nonmortar) << "pair " << seed;
      EXPECT_NEAR(a.area_mortar_covered, b.area_mortar_covered, 1e-13 * a.area_mortar) << "pair " << seed;
    }
}

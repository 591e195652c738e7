// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Faces that several pairs cover (doc/algorithm.md, chapter 3, several pairs).

#include "flat_surfaces.h"

#include <signorini/mortar/face_claims.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

namespace
{
  using namespace FlatSurfaces;

  constexpr unsigned int n = 6;

  /// One nonmortar surface under two others at different heights; another rank works on its faces in the
  /// second pair.
  class TwoPairs
  {
  public:
    TwoPairs(const std::function<double(double)> &first, const std::function<double(double)> &second)
      : heights{{first, second}}
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                         rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      for (unsigned int p = 0; p < 2; ++p)
        {
          Grid grid{n, n};
          grid.n_ranks = n_ranks;
          non[p]       = make_surface(grid);
          for (auto &face : non[p].faces)
            face.worker = (face.worker + p) % n_ranks;
          Grid other{4, 5};
          other.faces_up     = false;
          other.n_ranks      = n_ranks;
          mor[p]             = make_surface(other);
          const auto overlay = make_overlay(non[p], mor[p], static_cast<int>(rank));
          for (Point<3> &x : mor[p].mesh.vertices)
            x[2] = heights[p](x[0]);
          moments[p] = compute_face_moments(non[p], mor[p], overlay, {}, MPI_COMM_WORLD);
        }
    }

    std::size_t settle(const bool is_tied = false)
    {
      return leave_faces_to_nearest({{non[0], moments[0], is_tied}, {non[1], moments[1], false}},
                                    MPI_COMM_WORLD);
    }

    /// Covered area left of x = 1/2 and right of it, over all ranks.
    std::array<double, 2> covered(const unsigned int p) const
    {
      std::array<double, 2> sums = {{0., 0.}};
      for (const FaceMoments &m : moments[p])
        {
          double x = 0.;
          for (const unsigned int v : non[p].faces[m.face].corners)
            x += .25 * non[p].mesh.vertices[v][0];
          sums[x > .5] += m.covered;
        }
      for (double &sum : sums)
        sum = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      return sums;
    }

  private:
    std::array<std::function<double(double)>, 2> heights;
    std::array<ContactSurface, 2>                non, mor;
    std::array<std::vector<FaceMoments>, 2>      moments;
  };
} // namespace

TEST(FaceClaims, TheNearestTakesTheFace)
{
  TwoPairs pairs([](const double x) { return .1 + x; }, [](const double x) { return 1.1 - x; });
  EXPECT_EQ(pairs.settle(), n * n);
  EXPECT_NEAR(pairs.covered(0)[0], .5, 1e-12);
  EXPECT_NEAR(pairs.covered(0)[1], 0., 1e-12);
  EXPECT_NEAR(pairs.covered(1)[0], 0., 1e-12);
  EXPECT_NEAR(pairs.covered(1)[1], .5, 1e-12);
}

// Both could touch: neighbours on one surface.
TEST(FaceClaims, NobodyLosesWhatIsNear)
{
  TwoPairs pairs([](const double) { return .05; }, [](const double) { return .1; });
  EXPECT_EQ(pairs.settle(), 0u);
  EXPECT_NEAR(pairs.covered(0)[0] + pairs.covered(1)[1], 1., 1e-12);
}

TEST(FaceClaims, TiedPairsKeepTheirFaces)
{
  TwoPairs pairs([](const double) { return .5; }, [](const double x) { return x > .4 ? .1 : .5; });
  EXPECT_EQ(pairs.settle(true), n * n / 2);
  EXPECT_NEAR(pairs.covered(0)[0] + pairs.covered(0)[1], 1., 1e-12);
  EXPECT_NEAR(pairs.covered(1)[0], 0., 1e-12);
  EXPECT_NEAR(pairs.covered(1)[1], .5, 1e-12);
}

// Whoever gave two pairs that far apart is told so by what comes next.
TEST(FaceClaims, NoPairIsLeftWithNothing)
{
  TwoPairs pairs([](const double) { return .5; }, [](const double) { return .3; });
  EXPECT_EQ(pairs.settle(), 0u);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Couplings of coarse levels, with rows by owner: those of one rank that has everything.

#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/coarse_contact.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace Signorini;

  /// Any cut of all nodes into ranges, one a rank; the same on all ranks.
  NodePartition cut(const NodeIndex n, const MPI_Comm communicator, std::mt19937 &random)
  {
    const unsigned int     n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    std::vector<NodeIndex> ends    = {0, n};
    for (unsigned int r = 1; r < n_ranks; ++r)
      ends.push_back(std::uniform_int_distribution<NodeIndex>(0, n)(random));
    std::sort(ends.begin(), ends.end());
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    dealii::IndexSet   owned(n);
    owned.add_range(ends[rank], ends[rank + 1]);
    return NodePartition(owned, owned, communicator);
  }

  /// A coupling between nodes of a fine level, and the interpolation of all of its nodes.
  struct RandomLevels
  {
    explicit RandomLevels(const unsigned int seed)
      : random(seed)
    {
      for (NodeIndex node = 0; node < n_fine; ++node)
        {
          const bool is_row = number(0, 2) == 0;
          for (unsigned int k = number(1, 4); k > 0; --k)
            // Rows and columns interpolate from nodes of their own, but for a few.
            interpolation.add(2 * number(0, n_coarse / 2 - 1) + (is_row && number(0, 9) > 0), weight());
          interpolation.finish_row();
          if (is_row)
            {
              coupling.rows.push_back(node);
              coupling.weight.push_back(.1 + std::abs(weight()));
            }
        }
      for (std::size_t row = 0; row < coupling.n_rows(); ++row)
        {
          for (NodeIndex node = number(0, 20); node < n_fine; node += number(5, 40))
            if (coupling.find(node) < 0)
              coupling.entries.push_back({node, weight()});
          coupling.row_start.push_back(coupling.entries.size());
          projections.emplace_back(FixedDirections(), Vector3({weight(), weight(), 1.}));
        }
    }

    unsigned int number(const unsigned int low, const unsigned int high)
    {
      return std::uniform_int_distribution<unsigned int>(low, high)(random);
    }

    double weight()
    {
      return std::uniform_real_distribution<double>(-1., 1.)(random);
    }

    /// The coupling of the coarse level, from the rows that a rank owns.
    CoarseCoupling coarsen(const NodePartition &fine, const NodePartition &coarse) const
    {
      NodeRows owned;
      for (unsigned int i = 0; i < fine.n_owned(); ++i)
        owned.append(interpolation, fine.to_global(i));
      const auto rows  = owned_rows(coupling, fine);
      const auto mine  = select_rows(coupling, rows);
      const auto nodes = interface_nodes(mine);
      return coarsen_coupling(mine, select_values(projections, rows), nodes, import_rows(fine, owned, nodes),
                              coarse);
    }

    static constexpr NodeIndex n_fine = 300, n_coarse = 80;
    std::mt19937               random;
    InterfaceCoupling          coupling;
    std::vector<RowProjection> projections;
    NodeRows                   interpolation;
  };
} // namespace



TEST(CoarseContact, RowsAreThoseOfOneRank)
{
  for (unsigned int seed = 0; seed < 30; ++seed)
    {
      SCOPED_TRACE("levels " + std::to_string(seed));
      RandomLevels        levels(seed);
      const auto          whole  = levels.coarsen(cut(RandomLevels::n_fine, MPI_COMM_SELF, levels.random),
                                                  cut(RandomLevels::n_coarse, MPI_COMM_SELF, levels.random));
      const NodePartition fine   = cut(RandomLevels::n_fine, MPI_COMM_WORLD, levels.random),
                          coarse = cut(RandomLevels::n_coarse, MPI_COMM_WORLD, levels.random);
      const auto part            = levels.coarsen(fine, coarse);
      EXPECT_EQ(dealii::Utilities::MPI::sum(part.coupling.n_rows(), MPI_COMM_WORLD), whole.coupling.n_rows());
      EXPECT_GT(whole.coupling.n_rows(), 20u);
      for (std::size_t i = 0; i < part.coupling.n_rows(); ++i)
        {
          EXPECT_TRUE(coarse.owns(part.coupling.rows[i]));
          const std::ptrdiff_t j = whole.coupling.find(part.coupling.rows[i]);
          ASSERT_GE(j, 0);
          EXPECT_EQ(part.coupling.weight[i], whole.coupling.weight[j]);
          EXPECT_EQ((part.normals[i] - whole.normals[j]).norm(), 0.);
          ASSERT_EQ(part.coupling.end(i) - part.coupling.begin(i),
                    whole.coupling.end(j) - whole.coupling.begin(j));
          for (auto *x = part.coupling.begin(i), *y = whole.coupling.begin(j); x != part.coupling.end(i);
               ++x, ++y)
            {
              EXPECT_EQ(x->node, y->node);
              EXPECT_EQ(x->weight, y->weight);
            }
        }

      // Rows of any nodes, from their owners.
      std::vector<NodeIndex> wanted;
      for (NodeIndex node = levels.number(0, 9); node < RandomLevels::n_coarse; node += levels.number(1, 9))
        wanted.push_back(node);
      const NodeRequest request(coarse, wanted);
      const auto        rows    = import_rows(part.coupling, request);
      const auto        normals = import_row_values(part.coupling, part.normals, request);
      ASSERT_EQ(normals.size(), rows.n_rows());
      std::size_t n_rows = 0;
      for (const NodeIndex node : wanted)
        if (const std::ptrdiff_t j = whole.coupling.find(node); j >= 0)
          {
            ++n_rows;
            const std::ptrdiff_t i = rows.find(node);
            ASSERT_GE(i, 0);
            EXPECT_EQ(rows.weight[i], whole.coupling.weight[j]);
            EXPECT_EQ((normals[i] - whole.normals[j]).norm(), 0.);
            EXPECT_EQ(rows.end(i) - rows.begin(i), whole.coupling.end(j) - whole.coupling.begin(j));
          }
      EXPECT_EQ(rows.n_rows(), n_rows);
    }
}

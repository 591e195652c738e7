// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/replicated_data.h>
#include <signorini/solvers/node_phases.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// How nodes get their phases: simulated for up to 256 ranks (doc/measurements.md, many ranks).
    struct NodePhasesRule
    {
      /// With one phase far more nodes clash, and are damped: 15 to 18 iterations; with two 11 to 14, with
      /// three 11 or 12.
      unsigned int n_phases = 3;
      /// Where ranks have fewer nodes than this on the mean almost all of them are shared, and three phases
      /// are not enough: 918 nodes on 16 ranks take 14 iterations on one rank, 17 with three phases.
      NodeIndex    few_nodes      = 200;
      unsigned int n_phases_there = 6;
      /// In each but the last pass a random half of the nodes moves: neighbours that all move at once swap
      /// for ever. Without passes up to three iterations more.
      unsigned int n_passes = 6;
      /// Phases whose couplings are larger than the least by less than this part are equally good.
      double equally_good = .05;
    };
    constexpr NodePhasesRule phases_rule;

    /// Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014), the mixing function.
    std::uint64_t hash(std::uint64_t x)
    {
      x += 0x9e3779b97f4a7c15ull;
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
      return x ^ (x >> 31);
    }

    using Work = std::vector<double>;
  } // namespace



  NodePhases::NodePhases(const NodeBlockMatrix &matrix, const RelativeCouplings &couplings)
    : of_node(matrix.partition().n_local(), 0)
    , shared(matrix.n_rows(), false)
  {
    const NodePartition &partition = matrix.partition();
    if (partition.n_ranks() == 1)
      return;
    n_phases = partition.n_global() < phases_rule.few_nodes * partition.n_ranks() ? phases_rule.n_phases_there
                                                                                  : phases_rule.n_phases;
    for (const unsigned int node : partition.shared_nodes())
      shared[node] = true;
    for (unsigned int node = 0; node < of_node.size(); ++node)
      of_node[node] = hash(partition.to_global(node)) % n_phases;
    std::vector<Coupling> between_ranks;
    between_ranks.reserve(matrix.n_ghost_couplings());
    for (unsigned int ghost = 0; ghost < partition.ghosts().size(); ++ghost)
      {
        const auto [begin, end] = matrix.ghost_column(ghost);
        for (auto coupling = begin; coupling != end; ++coupling)
          between_ranks.push_back(
              {coupling->row, matrix.n_rows() + ghost, couplings.bound(*coupling, ghost)});
      }
    std::stable_sort(between_ranks.begin(), between_ranks.end(),
                     [](const Coupling &a, const Coupling &b) { return a.row < b.row; });
    for (unsigned int pass = 0; pass < phases_rule.n_passes; ++pass)
      {
        move_shared_nodes(matrix, between_ranks, pass);
        import_ghost_flags(partition, of_node);
      }
    fill_up(matrix);
  }



  void NodePhases::move_shared_nodes(const NodeBlockMatrix &matrix, const std::vector<Coupling> &couplings,
                                     const unsigned int pass)
  {
    const bool is_last = pass + 1 == phases_rule.n_passes;
    Work       work(n_phases, 0.);
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (shared[row])
        work[of_node[row]] += static_cast<double>(matrix.row_length(row));
    for (std::size_t k = 0; k < couplings.size();)
      {
        const unsigned int row = couplings[k].row;
        Work               sum(n_phases, 0.);
        for (; k < couplings.size() && couplings[k].row == row; ++k)
          sum[of_node[couplings[k].ghost]] += couplings[k].norm;
        if (!is_last && (hash(matrix.partition().to_global(row) * phases_rule.n_passes + pass) & 1u) == 0)
          continue;
        const double length = static_cast<double>(matrix.row_length(row));
        work[of_node[row]] -= length;
        const double least = *std::min_element(sum.begin(), sum.end());
        unsigned int best  = n_phases;
        for (unsigned int phase = 0; phase < n_phases; ++phase)
          if (sum[phase] <= (1. + phases_rule.equally_good) * least &&
              (best == n_phases || work[phase] < work[best]))
            best = phase;
        of_node[row] = static_cast<unsigned char>(best);
        work[best] += length;
      }
  }



  void NodePhases::fill_up(const NodeBlockMatrix &matrix)
  {
    Work   longest(n_phases, 0.);
    double total = 0.;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const double length = static_cast<double>(matrix.row_length(row));
        total += length;
        if (shared[row])
          longest[of_node[row]] += length;
      }
    Work                work = longest;
    std::vector<double> values(longest.begin(), longest.end());
    values.push_back(total);
    Utilities::MPI::max(values, matrix.partition().communicator(), values);
    std::copy_n(values.begin(), longest.size(), longest.begin());
    const double rest = values.back() - std::accumulate(longest.begin(), longest.end(), 0.);
    for (double &length : longest)
      length += std::max(0., rest) / n_phases;
    unsigned int phase = 0;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (!shared[row])
        {
          while (phase + 1 < n_phases && work[phase] >= longest[phase])
            ++phase;
          of_node[row] = static_cast<unsigned char>(phase);
          work[phase] += static_cast<double>(matrix.row_length(row));
        }
  }
} // namespace Signorini

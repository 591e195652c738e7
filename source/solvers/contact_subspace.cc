// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/galerkin_product.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/solvers/contact_subspace.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// How many nodes the ranks before each rank own, and all of them.
    std::vector<NodeIndex> first_nodes(const NodePartition &partition)
    {
      std::vector<NodeIndex> result = {0};
      for (const unsigned int n : gather_values(partition.n_owned(), partition.communicator()))
        result.push_back(result.back() + n);
      return result;
    }
  } // namespace



  ContactSubspace::Numbering::Numbering(const NodePartition &coarse, std::vector<NodeIndex> contact_begin)
    : communicator(coarse.communicator())
    , coarse_begin(first_nodes(coarse))
    , contact_begin(std::move(contact_begin))
  {
  }



  NodeIndex ContactSubspace::Numbering::of_coarse(const NodeIndex node) const
  {
    const auto next = std::upper_bound(coarse_begin.begin(), coarse_begin.end(), node);
    return node + contact_begin[next - coarse_begin.begin() - 1];
  }



  NodeIndex ContactSubspace::Numbering::of_contact(const NodeIndex index) const
  {
    const auto next = std::upper_bound(contact_begin.begin(), contact_begin.end(), index);
    return index + coarse_begin[next - contact_begin.begin()];
  }



  void ContactSubspace::Numbering::find(const NodeIndex number, std::optional<NodeIndex> &coarse_node,
                                        std::optional<NodeIndex> &contact_node) const
  {
    std::size_t rank = 0;
    while (number >= coarse_begin[rank + 1] + contact_begin[rank + 1])
      ++rank;
    if (number < coarse_begin[rank + 1] + contact_begin[rank])
      coarse_node = number - contact_begin[rank];
    else
      contact_node = number - coarse_begin[rank + 1];
  }



  IndexSet ContactSubspace::Numbering::owned() const
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    IndexSet           result(coarse_begin.back() + contact_begin.back());
    result.add_range(coarse_begin[rank] + contact_begin[rank],
                     coarse_begin[rank + 1] + contact_begin[rank + 1]);
    return result;
  }



  namespace
  {
    /// Local numbers of those of a list that this rank owns.
    std::vector<unsigned int> owned_rows_of(const std::vector<NodeIndex> &nodes,
                                            const NodePartition          &partition)
    {
      std::vector<unsigned int> rows;
      for (const NodeIndex node : nodes)
        if (partition.owns(node))
          rows.push_back(partition.to_local(node));
      return rows;
    }



    /// The level with the number of nodes that is nearest to the wanted one.
    unsigned int choose_level(const MultigridHierarchy &hierarchy, const unsigned int finest)
    {
      const auto distance = [&](const unsigned int l) {
        return std::abs(std::log(static_cast<double>(hierarchy.level(l).matrix.partition().n_global()) /
                                 ContactSubspace::Rule().n_nodes));
      };
      unsigned int best = 0;
      for (unsigned int l = 1; l < finest; ++l)
        if (distance(l) < distance(best))
          best = l;
      return best;
    }
  } // namespace



  bool ContactSubspace::exists(const MultigridHierarchy &hierarchy, const unsigned int level,
                               const ObstacleProblem &problem)
  {
    const std::size_t n_restricted = Utilities::MPI::sum(
        problem.half_spaces.size(), hierarchy.level(level).matrix.partition().communicator());
    return !hierarchy.level(level).contact_nodes.empty() &&
           (problem.semidefinite || n_restricted <= Rule().most_contact_nodes) &&
           hierarchy.level(choose_level(hierarchy, level)).matrix.partition().n_global() <= Rule().most_nodes;
  }



  ContactSubspace::ContactSubspace(const MultigridHierarchy &hierarchy, const unsigned int level,
                                   const std::vector<NodeIndex> &nodes,
                                   const std::vector<Vector>    &free_motions)
    : finest(hierarchy.level(level))
    , contact_nodes(nodes)
    , motion_functions(free_motions, owned_rows_of(nodes, finest.matrix.partition()))
  {
    const NodePartition &partition = finest.matrix.partition();
    for (const NodeIndex first : first_nodes(partition))
      contact_begin.push_back(std::lower_bound(nodes.begin(), nodes.end(), first) - nodes.begin());
    const unsigned int coarsest = choose_level(hierarchy, level);
    // A list that grows would copy them: moves of deal.II's vectors may throw.
    spaces.reserve(level - coarsest);
    for (unsigned int l = level; l > coarsest; --l)
      add_space(hierarchy, l - 1);
    NodeBlockMatrix &coarsest_matrix = spaces.back().matrix;
    const auto couplings = motion_functions.couple(coarsest_matrix, own_contact_numbers(), finest.scale);
    EmptyDirections().fill(coarsest_matrix, all_rows(coarsest_matrix), finest.scale);
    gather_matrix(couplings);
    partition.reinit(step);
    partition.reinit(product);
  }



  std::optional<NodeIndex> ContactSubspace::contact_index(const NodeIndex node) const
  {
    const auto place = std::lower_bound(contact_nodes.begin(), contact_nodes.end(), node);
    if (place == contact_nodes.end() || *place != node)
      return {};
    return place - contact_nodes.begin();
  }



  NodalTransfer ContactSubspace::make_transfer(const MultigridLevel &coarse, const NodePartition &level_above,
                                               const NodePartition &space_above,
                                               const Numbering     &numbering) const
  {
    const NodalTransfer                 &transfer = coarse.to_finer;
    NodeRows                             rows;
    std::vector<NodalTransfer::BlockRow> block_rows;
    for (unsigned int i = 0; i < space_above.n_local(); ++i)
      {
        std::optional<NodeIndex> node, contact;
        if (spaces.empty())
          {
            node    = space_above.to_global(i);
            contact = contact_index(*node);
          }
        else
          spaces.back().numbering.find(space_above.to_global(i), node, contact);
        if (contact)
          rows.add(numbering.of_contact(*contact), 1.);
        else
          {
            const unsigned int row    = level_above.to_local(*node);
            const Block *const blocks = transfer.row_blocks(row);
            if (blocks != nullptr)
              block_rows.push_back({i, {}, {}, {}});
            for (std::size_t k = transfer.row_begin(row); k < transfer.row_end(row); ++k)
              {
                const NodeIndex column =
                    numbering.of_coarse(transfer.coarse_partition().to_global(transfer.column(k)));
                rows.add(column, transfer.weight(k));
                if (blocks == nullptr)
                  continue;
                block_rows.back().columns.push_back(column);
                block_rows.back().blocks.push_back(blocks[k - transfer.row_begin(row)]);
              }
          }
        rows.finish_row();
      }
    NodalTransfer result;
    result.reinit(std::move(rows), block_rows, space_above.n_owned());
    return result;
  }



  void ContactSubspace::add_space(const MultigridHierarchy &hierarchy, const unsigned int coarse_level)
  {
    const MultigridLevel  &coarse      = hierarchy.level(coarse_level);
    const NodePartition   &level_above = hierarchy.level(coarse_level + 1).matrix.partition();
    const NodeBlockMatrix &above       = spaces.empty() ? finest.matrix : spaces.back().matrix;
    Space                  space{Numbering(coarse.matrix.partition(), contact_begin), {}, {}, {}, {}};
    space.to_finer = make_transfer(coarse, level_above, above.partition(), space.numbering);
    reinit_galerkin(space.matrix, above, space.to_finer, space.numbering.owned());
    compute_galerkin(space.matrix, above, space.to_finer);

    const NodePartition         &own = finest.matrix.partition();
    std::vector<FixedDirections> masks(coarse.fixed.begin(),
                                       coarse.fixed.begin() + coarse.matrix.partition().n_owned());
    for (const NodeIndex node : contact_nodes)
      if (own.owns(node))
        masks.push_back(finest.fixed[own.to_local(node)]);
    space.fixed = import_ghost_masks(space.matrix.partition(), masks);
    eliminate_fixed_components(space.matrix, space.fixed, all_rows(space.matrix), finest.scale);
    space.matrix.partition().reinit(space.values);
    if (!spaces.empty())
      spaces.back().matrix = NodeBlockMatrix();
    spaces.push_back(std::move(space));
  }



  std::vector<unsigned int> ContactSubspace::own_contact_numbers() const
  {
    const Space              &space = spaces.back();
    const NodePartition      &own   = finest.matrix.partition();
    std::vector<unsigned int> numbers;
    for (std::size_t k = 0; k < contact_nodes.size(); ++k)
      if (own.owns(contact_nodes[k]))
        numbers.push_back(space.matrix.partition().to_local(space.numbering.of_contact(k)));
    return numbers;
  }



  void ContactSubspace::gather_matrix(const MotionFunctions::Couplings &couplings)
  {
    const NodeBlockMatrix          &matrix    = spaces.back().matrix;
    const NodePartition            &partition = matrix.partition();
    const MPI_Comm                  comm      = partition.communicator();
    const unsigned int              n_motions = motion_functions.n_nodes();
    GatheredObstacleProblem::Blocks mine;
    const std::vector<Block> with_nodes = gather_lists(couplings.with_nodes, comm, Receivers::rank_zero);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      for (unsigned int m = 0; m < n_motions; ++m)
        {
          for (unsigned int k = 0; k < n_motions; ++k)
            mine.add(m, k, couplings.own[m * n_motions + k]);
          for (std::size_t node = 0; node < partition.n_global(); ++node)
            mine.add(m, n_motions + node, transpose(with_nodes[node * n_motions + m]));
        }
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const std::size_t number = n_motions + partition.to_global(row);
        for (unsigned int m = 0; m < n_motions; ++m)
          mine.add(number, m, couplings.with_nodes[row * n_motions + m]);
        matrix.visit_row(row, [&](const RowEntry &entry) {
          mine.add(number, n_motions + partition.to_global(entry.column), entry.block());
        });
      }
    problem.set_matrix(std::move(mine), n_motions + partition.n_global(), comm);
  }



  std::vector<NodeState> ContactSubspace::restrict_state(const Vector &v, const Vector &residual,
                                                         const ContactState &contact)
  {
    std::vector<NodeState> states;
    const auto             work = motion_functions.work(residual);
    if (Utilities::MPI::this_mpi_process(finest.matrix.partition().communicator()) == 0)
      for (const Vector3 &w : work)
        {
          states.emplace_back();
          states.back().residual = w;
        }
    const Vector *above = &residual;
    for (Space &space : spaces)
      {
        space.values = 0.;
        space.to_finer.restrict_and_add(space.values, *above);
        for (unsigned int i = 0; i < space.to_finer.coarse_partition().n_owned(); ++i)
          project_free(space.fixed[i], space.values, i);
        above = &space.values;
      }
    const Space         &space     = spaces.back();
    const NodePartition &partition = space.matrix.partition();
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        NodeState &state = states.emplace_back();
        for (unsigned int c = 0; c < dim; ++c)
          state.residual[c] = space.values.local_element(dim * i + c);
        std::optional<NodeIndex> node, index;
        space.numbering.find(partition.to_global(i), node, index);
        if (!index)
          continue;
        const unsigned int row         = finest.matrix.partition().to_local(contact_nodes[*index]);
        const int          p           = contact.at(row);
        const HalfSpaces  &half_spaces = contact.half_spaces();
        state.normal                   = half_spaces.normals[p];
        state.room                     = std::max(0., half_spaces.bounds[p] - half_spaces.normal_part(p, v));
        state.is_active                = contact.active()[p];
      }
    return states;
  }



  void ContactSubspace::run(Vector &v, Vector &residual, ContactState &contact, FreeMotionCorrection &motions)
  {
    std::vector<NodeStep> steps = problem.solve(restrict_state(v, residual, contact));
    Space                &space = spaces.back();
    const MPI_Comm        comm  = space.matrix.partition().communicator();
    std::vector<Vector3>  coefficients(motion_functions.n_nodes());
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        for (unsigned int m = 0; m < coefficients.size(); ++m)
          coefficients[m] = steps[m].step;
        steps.erase(steps.begin(), steps.begin() + coefficients.size());
      }
    coefficients = broadcast_value(coefficients, comm);
    space.values.zero_out_ghost_values();
    for (unsigned int i = 0; i < steps.size(); ++i)
      {
        for (unsigned int c = 0; c < dim; ++c)
          space.values.local_element(dim * i + c) = steps[i].step[c];
        std::optional<NodeIndex> node, index;
        space.numbering.find(space.matrix.partition().to_global(i), node, index);
        if (!index)
          continue;
        const unsigned int row = finest.matrix.partition().to_local(contact_nodes[*index]);
        contact.set_active(contact.at(row), steps[i].is_active != 0.);
      }
    for (std::size_t k = spaces.size(); k-- > 0;)
      spaces[k].to_finer.prolongate(k > 0 ? spaces[k - 1].values : step, spaces[k].values);
    step.zero_out_ghost_values();
    motion_functions.add(step, coefficients);
    motions.update(contact);
    motions.remove_idle(step, v, contact);
    finest.matrix.vmult(product, step);
    v.zero_out_ghost_values();
    residual.zero_out_ghost_values();
    step.zero_out_ghost_values();
    v += step;
    residual -= product;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/interface_correction.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  InterfaceCorrection::InterfaceCorrection(const NodeBlockMatrix        &matrix,
                                           const std::vector<NodeIndex> &contact_nodes)
    : SmoothingStage(matrix)
    , nodes(contact_nodes)
    , is_contact(matrix.partition().n_local(), false)
  {
    for (const NodeIndex node : nodes)
      if (const unsigned int local = matrix.partition().to_local(node);
          local != numbers::invalid_unsigned_int)
        {
          is_contact[local] = true;
          if (local < matrix.n_rows())
            owned.push_back(local);
        }
  }



  void InterfaceCorrection::update(const std::vector<unsigned int> &changed_rows)
  {
    for (const unsigned int row : changed_rows)
      is_current = is_current && !is_contact[row];
  }



  void InterfaceCorrection::gather_matrix()
  {
    const NodePartition &partition = matrix.partition();
    const auto           place     = [&](const unsigned int local) -> std::size_t {
      return std::lower_bound(nodes.begin(), nodes.end(), partition.to_global(local)) - nodes.begin();
    };
    GatheredObstacleProblem::Blocks mine;
    for (const unsigned int row : owned)
      matrix.visit_row(row, [&](const RowEntry &entry) {
        if (is_contact[entry.column])
          mine.add(place(row), place(entry.column), entry.block());
      });
    problem.set_matrix(std::move(mine), nodes.size(), partition.communicator());
  }



  void InterfaceCorrection::run(Vector &v, const Vector &rhs, ContactState &contact, const Direction)
  {
    const MPI_Comm comm = matrix.partition().communicator();
    if (Utilities::MPI::min(static_cast<int>(is_current), comm) == 0)
      gather_matrix();
    is_current = true;

    v.update_ghost_values();
    std::vector<NodeState> states(owned.size());
    for (std::size_t r = 0; r < owned.size(); ++r)
      {
        const unsigned int row   = owned[r];
        NodeState         &state = states[r];
        double             product[dim];
        matrix.multiply_row(product, row, v);
        for (unsigned int c = 0; c < dim; ++c)
          state.residual[c] = rhs.local_element(dim * row + c) - product[c];
        if (const int p = contact.at(row); p >= 0)
          {
            const HalfSpaces &spaces = contact.half_spaces();
            state.normal             = spaces.normals[p];
            state.room               = std::max(0., spaces.bounds[p] - spaces.normal_part(p, v));
            state.is_active          = contact.active()[p];
          }
      }
    const std::vector<NodeStep> steps = problem.solve(states);
    for (std::size_t r = 0; r < owned.size(); ++r)
      {
        for (unsigned int c = 0; c < dim; ++c)
          v.local_element(dim * owned[r] + c) += steps[r].step[c];
        if (const int p = contact.at(owned[r]); p >= 0)
          contact.set_active(p, steps[r].is_active != 0.);
      }
    v.update_ghost_values();
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/contact_state.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  ContactState::ContactState(const NodeBlockMatrix &matrix, const HalfSpaces &half_spaces)
    : spaces(half_spaces)
    , half_space_of_row(matrix.n_rows(), -1)
    , is_active(half_spaces.size(), 0)
    , communicator(matrix.partition().communicator())
  {
    for (std::size_t p = 0; p < spaces.size(); ++p)
      {
        const unsigned int row = spaces.nodes[p];
        half_space_of_row[row] = static_cast<int>(p);
        const Block   inverse  = invert(read_block(matrix.block(matrix.diagonal(row))));
        const Vector3 w        = inverse * spaces.normals[p];
        projection_direction.push_back(w / (w * spaces.normals[p]));
      }
  }



  void ContactState::set_bounds_from(const HalfSpaces &all, const Vector &v)
  {
    for (std::size_t p = 0; p < spaces.size(); ++p)
      spaces.bounds[p] = all.bounds[p] - all.normal_part(p, v);
  }



  void ContactState::project(Vector &v)
  {
    for (std::size_t p = 0; p < spaces.size(); ++p)
      project_node(v.begin() + dim * static_cast<std::size_t>(spaces.nodes[p]), static_cast<int>(p));
  }



  void ContactState::restrict_to_tangents(Vector &residual) const
  {
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (is_active[p])
        spaces.add_normal(residual, p, -spaces.normal_part(p, residual));
  }



  double ContactState::normal_product(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (is_active[p])
        sum += spaces.normal_part(p, a) * spaces.normal_part(p, b);
    return Utilities::MPI::sum(sum, communicator);
  }



  double ContactState::normal_energy(const NodeBlockMatrix &matrix, const Vector &c) const
  {
    double sum = 0.;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (is_active[p])
        {
          const Block    block = read_block(matrix.block(matrix.diagonal(spaces.nodes[p])));
          const Vector3 &n     = spaces.normals[p];
          sum += Utilities::fixed_power<2>(spaces.normal_part(p, c)) * (n * (block * n));
        }
    return Utilities::MPI::sum(sum, communicator);
  }



  void ContactState::project_correction(Vector &correction, const Vector &v) const
  {
    restrict_to_tangents(correction);
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (!is_active[p])
        {
          const std::size_t i      = dim * static_cast<std::size_t>(spaces.nodes[p]);
          double            excess = -spaces.bounds[p];
          for (unsigned int c = 0; c < dim; ++c)
            excess += spaces.normals[p][c] * (v.local_element(i + c) + correction.local_element(i + c));
          if (excess > 0.)
            for (unsigned int c = 0; c < dim; ++c)
              correction.local_element(i + c) -= excess * projection_direction[p][c];
        }
  }



  double ContactState::longest_step(const Vector &v, const Vector &c, const HalfSpaces &all) const
  {
    return Utilities::MPI::min(all.longest_step(v, c, &is_active), communicator);
  }



  unsigned int ContactState::n_active() const
  {
    return Utilities::MPI::sum(std::accumulate(is_active.begin(), is_active.end(), 0u), communicator);
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/basis_transformation.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>

namespace Signorini
{
  using namespace dealii;

  BasisTransformation::BasisTransformation(const NodalSpace &space, const NodePartition &space_partition,
                                           const DirichletData &dirichlet, const InterfaceCoupling &coupling,
                                           const InterfaceCoupling          &expansion,
                                           const std::vector<RowProjection> &projections)
    : space(space)
    , partition(space_partition)
    , dirichlet(dirichlet)
    , coupling(coupling)
    , expansion(expansion)
    , projections(projections)
  {
    for (std::size_t p = 0; p < coupling.n_rows(); ++p)
      if (partition.owns(coupling.rows[p]))
        owned_rows.emplace_back(p, partition.to_local(coupling.rows[p]));
    for (const auto &entry : coupling.entries)
      column_nodes.push_back(entry.node);
    std::sort(column_nodes.begin(), column_nodes.end());
    column_nodes.erase(std::unique(column_nodes.begin(), column_nodes.end()), column_nodes.end());
  }



  void BasisTransformation::interpolate_hanging_nodes(Vector &u) const
  {
    u.update_ghost_values();
    for (const NodeIndex node : space.owned())
      if (const auto *parents = space.hanging_nodes().get_constraint_entries(node))
        {
          const unsigned int i = partition.to_local(node);
          Vector3            value;
          for (const auto &[parent, weight] : *parents)
            for (unsigned int c = 0; c < dim; ++c)
              value[c] += weight * u.local_element(dim * partition.to_local(parent) + c);
          for (unsigned int c = 0; c < dim; ++c)
            u.local_element(dim * i + c) = value[c];
        }
    u.update_ghost_values();
  }



  namespace
  {
    /// Values at nodes that come in any order.
    std::vector<Vector3> replicate_at(const Vector &v, const NodePartition &partition,
                                      const std::vector<NodeIndex> &nodes)
    {
      std::vector<NodeIndex> sorted = nodes;
      std::sort(sorted.begin(), sorted.end());
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      const std::vector<Vector3> values = replicate_values(partition, v, sorted);
      std::vector<Vector3>       result;
      for (const NodeIndex node : nodes)
        result.push_back(values[std::lower_bound(sorted.begin(), sorted.end(), node) - sorted.begin()]);
      return result;
    }
  } // namespace



  Vector BasisTransformation::to_displacement(const Vector &v, const NodePartition &unknowns) const
  {
    v.update_ghost_values();
    Vector u;
    partition.reinit(u);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        const std::size_t r = space.relevant().index_within_set(partition.to_global(i));
        for (unsigned int c = 0; c < dim; ++c)
          u.local_element(dim * i + c) = v.local_element(dim * i + c);
        // Rounding of the sweeps: what is fixed in an oblique direction is no number that stays zero.
        if (!dirichlet.fixed[r].is_along_axes())
          project_free(dirichlet.fixed[r], u, i);
        for (unsigned int c = 0; c < dim; ++c)
          u.local_element(dim * i + c) += dirichlet.value[r][c];
      }
    for (const auto &[p, local] : owned_rows)
      {
        Vector3 shift;
        for (const auto *entry = expansion.begin(p); entry != expansion.end(p); ++entry)
          {
            const unsigned int q = unknowns.to_local(entry->node);
            for (unsigned int c = 0; c < dim; ++c)
              shift[c] += entry->weight * v.local_element(dim * q + c);
          }
        shift = projections[p].apply(shift);
        for (unsigned int c = 0; c < dim; ++c)
          u.local_element(dim * local + c) += shift[c];
      }
    if (dirichlet.rigid != nullptr)
      move_rigid_faces(u, replicate_at(v, unknowns, dirichlet.rigid->carriers()));
    interpolate_hanging_nodes(u);
    return u;
  }



  void BasisTransformation::from_displacement(Vector &v, const Vector &u) const
  {
    Vector w;
    partition.reinit(w);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        const NodeIndex   node = partition.to_global(i);
        const std::size_t r    = space.relevant().index_within_set(node);
        if (!space.hanging_nodes().is_constrained(node))
          {
            for (unsigned int c = 0; c < dim; ++c)
              w.local_element(dim * i + c) = u.local_element(dim * i + c) - dirichlet.value[r][c];
            project_free(dirichlet.fixed[r], w, i);
          }
      }
    const std::vector<Vector3> columns = import_values(partition, w, column_nodes);
    for (const auto &[p, local] : owned_rows)
      {
        Vector3 shift;
        for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
          shift += entry->weight *
                   columns[std::lower_bound(column_nodes.begin(), column_nodes.end(), entry->node) -
                           column_nodes.begin()];
        shift = projections[p].apply(shift);
        for (unsigned int c = 0; c < dim; ++c)
          w.local_element(dim * local + c) -= shift[c];
      }
    v.copy_locally_owned_data_from(w);
    if (dirichlet.rigid != nullptr)
      fit_rigid_faces(v, u);
  }



  void BasisTransformation::move_rigid_faces(Vector &u, const std::vector<Vector3> &carriers) const
  {
    for (const auto &[node, dependence] : dirichlet.rigid->nodes())
      if (partition.owns(node))
        {
          const unsigned int i     = partition.to_local(node);
          Vector3            value = dirichlet.value[space.relevant().index_within_set(node)];
          for (unsigned int k = 0; k < 2; ++k)
            value += dependence.blocks[k] * carriers[2 * dependence.face + k];
          for (unsigned int c = 0; c < dim; ++c)
            u.local_element(dim * i + c) = value[c];
        }
  }



  void BasisTransformation::fit_rigid_faces(Vector &v, const Vector &u) const
  {
    const RigidFaces &rigid = *dirichlet.rigid;
    for (unsigned int f = 0; f < rigid.faces().size(); ++f)
      {
        Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::Matrix<double, 6, 1> rhs    = Eigen::Matrix<double, 6, 1>::Zero();
        for (const auto &[node, dependence] : rigid.nodes())
          if (dependence.face == f && partition.owns(node))
            {
              Vector3 value = -dirichlet.value[space.relevant().index_within_set(node)];
              for (unsigned int c = 0; c < dim; ++c)
                value[c] += u.local_element(dim * partition.to_local(node) + c);
              for (unsigned int c = 0; c < dim; ++c)
                {
                  Eigen::Matrix<double, 6, 1> row;
                  for (unsigned int j = 0; j < 2 * dim; ++j)
                    row[j] = dependence.blocks[j / dim][c][j % dim];
                  matrix += row * row.transpose();
                  rhs += value[c] * row;
                }
            }
        std::vector<double> sums(matrix.data(), matrix.data() + 36);
        sums.insert(sums.end(), rhs.data(), rhs.data() + 6);
        for (double &sum : sums)
          sum = Utilities::MPI::sum(sum, space.communicator());
        const auto          n = static_cast<Eigen::Index>(rigid.faces()[f].free.size());
        std::vector<double> z(n, 0.);
        Eigen::Map<Eigen::VectorXd>(z.data(), n) =
            Eigen::Map<Eigen::Matrix<double, 6, 6>>(sums.data())
                .topLeftCorner(n, n)
                .ldlt()
                .solve(Eigen::Map<Eigen::VectorXd>(sums.data() + 36, n));
        for (unsigned int k = 0; k < 2; ++k)
          if (const NodeIndex node = rigid.carrier(f, k); partition.owns(node))
            for (unsigned int c = 0; c < dim; ++c)
              v.local_element(dim * partition.to_local(node) + c) = 0.;
        // The owned nodes of v are those of the space.
        rigid.add(v, partition, f, z);
      }
  }



  Vector BasisTransformation::restrict_forces(const Vector &forces, const NodePartition &unknowns) const
  {
    Vector result;
    unknowns.reinit(result);
    for (unsigned int i = 0; i < dim * partition.n_owned(); ++i)
      result.local_element(i) = forces.local_element(i);
    for (const auto &[p, local] : owned_rows)
      {
        Vector3 force;
        for (unsigned int c = 0; c < dim; ++c)
          force[c] = forces.local_element(dim * local + c);
        force = force * projections[p].block();
        for (const auto *entry = expansion.begin(p); entry != expansion.end(p); ++entry)
          for (unsigned int c = 0; c < dim; ++c)
            result.local_element(dim * unknowns.to_local(entry->node) + c) += entry->weight * force[c];
      }
    if (dirichlet.rigid != nullptr)
      gather_rigid_forces(result, forces);
    result.compress(VectorOperation::add);
    return result;
  }



  void BasisTransformation::gather_rigid_forces(Vector &result, const Vector &forces) const
  {
    const RigidFaces   &rigid = *dirichlet.rigid;
    std::vector<double> sums(2 * dim * rigid.faces().size(), 0.);
    for (const auto &[node, dependence] : rigid.nodes())
      if (partition.owns(node))
        {
          const unsigned int i = partition.to_local(node);
          for (unsigned int j = 0; j < 2 * dim; ++j)
            for (unsigned int c = 0; c < dim; ++c)
              sums[2 * dim * dependence.face + j] +=
                  dependence.blocks[j / dim][c][j % dim] * forces.local_element(dim * i + c);
          for (unsigned int c = 0; c < dim; ++c)
            result.local_element(dim * i + c) = 0.;
        }
    for (double &sum : sums)
      sum = Utilities::MPI::sum(sum, space.communicator());
    for (unsigned int f = 0; f < rigid.faces().size(); ++f)
      rigid.add(result, partition, f,
                std::vector<double>(sums.begin() + 2 * dim * f,
                                    sums.begin() + 2 * dim * f + rigid.faces()[f].free.size()));
  }



  Vector BasisTransformation::lift() const
  {
    Vector result;
    partition.reinit(result);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        const std::size_t r = space.relevant().index_within_set(partition.to_global(i));
        for (unsigned int c = 0; c < dim; ++c)
          result.local_element(dim * i + c) = dirichlet.value[r][c];
      }
    interpolate_hanging_nodes(result);
    return result;
  }



  std::vector<double> BasisTransformation::reduce_gaps(const std::vector<double> &gaps) const
  {
    const Vector               u_D     = lift();
    const std::vector<Vector3> own     = import_values(partition, u_D, coupling.rows);
    const std::vector<Vector3> columns = import_values(partition, u_D, column_nodes);
    std::vector<double>        reduced(gaps.size());
    for (std::size_t p = 0; p < coupling.n_rows(); ++p)
      {
        Vector3 relative = own[p];
        for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
          relative -= entry->weight *
                      columns[std::lower_bound(column_nodes.begin(), column_nodes.end(), entry->node) -
                              column_nodes.begin()];
        reduced[p] = (gaps[p] - projections[p].normal() * relative) / projections[p].share();
      }
    return reduced;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/interface_correction.h>

#include <deal.II/base/mpi.h>

#include <Eigen/CholmodSupport>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct InterfaceCorrectionRule
    {
      /// Steps of the active set method, which may cycle: then one shortened step is taken instead.
      unsigned int n_steps = 20;
    };

    /// What a rank tells about one of its contact nodes.
    struct NodeState
    {
      Vector3 residual, normal;
      /// Way to the plane (length); negative without a half-space.
      double room      = -1.;
      double is_active = 0.;
    };
    constexpr std::size_t n_numbers = sizeof(NodeState) / sizeof(double);
    static_assert(sizeof(NodeState) == 8 * sizeof(double), "sent as numbers");

    /// A matrix on rank 0, piece by piece.
    struct PackedMatrix
    {
      std::vector<std::size_t> rows, columns;
      std::vector<double>      values;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &rows &columns &values;
      }
    };

    void add_block(std::vector<Eigen::Triplet<double>> &entries, const std::size_t row,
                   const std::size_t column, const Block &block)
    {
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          entries.emplace_back(dim * row + c, dim * column + d, block[c][d]);
    }

    double normal_part(const Eigen::VectorXd &x, const std::size_t node, const Vector3 &n)
    {
      return n[0] * x[dim * node] + n[1] * x[dim * node + 1] + n[2] * x[dim * node + 2];
    }

    void add_normal(Eigen::VectorXd &x, const std::size_t node, const Vector3 &n, const double length)
    {
      for (unsigned int c = 0; c < dim; ++c)
        x[dim * node + c] += length * n[c];
    }
  } // namespace



  /// The obstacle problem of the contact nodes.
  struct InterfaceCorrection::Gathered
  {
    PackedMatrix                                             blocks;
    Eigen::SparseMatrix<double>                              matrix;
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> cholesky;
    bool                                                     is_analyzed = false, is_definite = false;
    /// Planes that were cut off before the factorization; valid if has_factors.
    std::vector<unsigned char> factorized;
    bool                       has_factors = false;

    Gathered()
    {
      cholesky.cholmod().print = 0;
    }

    void factorize(const std::vector<NodeState> &state, const std::vector<unsigned char> &active)
    {
      if (has_factors && factorized == active)
        return;
      factorized           = active;
      has_factors          = true;
      const auto normal_of = [&](const std::size_t node) {
        return active[node] ? state[node].normal : Vector3();
      };
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t k = 0; k < blocks.rows.size(); ++k)
        {
          const std::size_t row = blocks.rows[k], column = blocks.columns[k];
          add_block(entries, row, column,
                    restrict_to_planes(blocks.values.data() + dim * dim * k, normal_of(row),
                                       normal_of(column), row == column));
        }
      Eigen::SparseMatrix<double> truncated(matrix.rows(), matrix.cols());
      truncated.setFromTriplets(entries.begin(), entries.end());
      // The blocks that occur stay the same.
      if (!is_analyzed)
        cholesky.analyzePattern(truncated);
      is_analyzed = true;
      cholesky.factorize(truncated);
      is_definite = cholesky.info() == Eigen::Success;
    }

    /// The step to the minimizer on the planes of active nodes, from where it first goes to them if wanted;
    /// `residual` becomes that of the result.
    bool minimize(Eigen::VectorXd &step, Eigen::VectorXd &residual, const std::vector<NodeState> &state,
                  const std::vector<unsigned char> &active, const bool goes_to_planes)
    {
      factorize(state, active);
      if (!is_definite)
        return false;
      const std::size_t n = state.size();
      step                = Eigen::VectorXd::Zero(dim * n);
      for (std::size_t i = 0; i < n; ++i)
        if (goes_to_planes && active[i])
          add_normal(step, i, state[i].normal, state[i].room);
      residual.resize(dim * n);
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          residual[dim * i + c] = state[i].residual[c];
      residual -= matrix * step;
      Eigen::VectorXd tangential = residual;
      for (std::size_t i = 0; i < n; ++i)
        if (active[i])
          add_normal(tangential, i, state[i].normal, -normal_part(tangential, i, state[i].normal));
      tangential = Eigen::VectorXd(cholesky.solve(tangential));
      step += tangential;
      residual -= matrix * tangential;
      return true;
    }

    /// The step, and the active flags that belong to it.
    Eigen::VectorXd solve(const std::vector<NodeState> &state, std::vector<unsigned char> &active)
    {
      const std::size_t                n     = state.size();
      const std::vector<unsigned char> start = active;
      Eigen::VectorXd                  step, residual;
      // Sweeps by node leave a poor guess behind; the factors of the last visit are a better one.
      if (has_factors)
        for (std::size_t i = 0; i < n; ++i)
          active[i] = factorized[i] && state[i].room >= 0.;
      for (unsigned int k = 0; k < InterfaceCorrectionRule().n_steps; ++k)
        {
          if (!minimize(step, residual, state, active, true))
            break;
          bool changes = false;
          for (std::size_t i = 0; i < n; ++i)
            if (state[i].room >= 0.)
              {
                const bool now = active[i] ? normal_part(residual, i, state[i].normal) >= 0.
                                           : normal_part(step, i, state[i].normal) > state[i].room;
                changes        = changes || now != static_cast<bool>(active[i]);
                active[i]      = now;
              }
          if (!changes)
            return step;
        }
      active = start;
      if (!minimize(step, residual, state, active, false))
        return Eigen::VectorXd::Zero(dim * n);
      double length = 1.;
      for (std::size_t i = 0; i < n; ++i)
        if (state[i].room >= 0. && !active[i])
          if (const double motion = normal_part(step, i, state[i].normal); motion > 0.)
            length = std::min(length, state[i].room / motion);
      return length * step;
    }
  };



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



  InterfaceCorrection::~InterfaceCorrection() = default;



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
    PackedMatrix packed;
    for (const unsigned int row : owned)
      for (const BlockRange &range : matrix.ranges(row))
        for (std::size_t k = range.begin; k < range.end; ++k)
          if (is_contact[matrix.column(k)])
            {
              packed.rows.push_back(place(row));
              packed.columns.push_back(place(matrix.column(k)));
              packed.values.insert(packed.values.end(), matrix.block(k), matrix.block(k) + dim * dim);
            }
    const auto pieces = Utilities::MPI::gather(partition.communicator(), packed, 0);
    if (Utilities::MPI::this_mpi_process(partition.communicator()) != 0)
      return;
    if (!gathered)
      gathered = std::make_unique<Gathered>();
    PackedMatrix &all = gathered->blocks;
    all               = PackedMatrix();
    for (const PackedMatrix &piece : pieces)
      {
        all.rows.insert(all.rows.end(), piece.rows.begin(), piece.rows.end());
        all.columns.insert(all.columns.end(), piece.columns.begin(), piece.columns.end());
        all.values.insert(all.values.end(), piece.values.begin(), piece.values.end());
      }
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < all.rows.size(); ++k)
      add_block(entries, all.rows[k], all.columns[k], read_block(all.values.data() + dim * dim * k));
    const auto n = static_cast<Eigen::Index>(dim * nodes.size());
    gathered->matrix.resize(n, n);
    gathered->matrix.setFromTriplets(entries.begin(), entries.end());
    gathered->has_factors = false;
  }



  void InterfaceCorrection::run(Vector &v, const Vector &rhs, ContactState &contact, const Direction)
  {
    const MPI_Comm comm = matrix.partition().communicator();
    if (Utilities::MPI::min(static_cast<int>(is_current), comm) == 0)
      gather_matrix();
    is_current = true;

    v.update_ghost_values();
    std::vector<double> mine(n_numbers * owned.size());
    for (std::size_t r = 0; r < owned.size(); ++r)
      {
        const unsigned int row = owned[r];
        NodeState          state;
        for (unsigned int c = 0; c < dim; ++c)
          state.residual[c] = rhs.local_element(dim * row + c);
        double product[dim];
        matrix.multiply_row(product, row, v);
        for (unsigned int c = 0; c < dim; ++c)
          state.residual[c] -= product[c];
        if (const int p = contact.at(row); p >= 0)
          {
            const HalfSpaces &spaces = contact.half_spaces();
            state.normal             = spaces.normals[p];
            state.room               = std::max(0., spaces.bounds[p] - spaces.normal_part(p, v));
            state.is_active          = contact.active()[p];
          }
        std::memcpy(mine.data() + n_numbers * r, &state, sizeof(NodeState));
      }

    // The contact nodes by rank are the contact nodes in order.
    const auto          pieces = Utilities::MPI::gather(comm, mine, 0);
    std::vector<double> result;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::vector<NodeState> state;
        for (const auto &piece : pieces)
          for (std::size_t i = 0; i < piece.size(); i += n_numbers)
            {
              state.emplace_back();
              std::memcpy(&state.back(), piece.data() + i, sizeof(NodeState));
            }
        AssertDimension(state.size(), nodes.size());
        std::vector<unsigned char> active;
        for (const NodeState &node : state)
          active.push_back(node.is_active != 0.);
        const Eigen::VectorXd step = gathered->solve(state, active);
        for (std::size_t i = 0; i < state.size(); ++i)
          {
            result.insert(result.end(), step.data() + dim * i, step.data() + dim * (i + 1));
            result.push_back(active[i]);
          }
      }
    result = Utilities::MPI::broadcast(comm, result, 0);
    for (const unsigned int row : owned)
      {
        const auto i =
            std::lower_bound(nodes.begin(), nodes.end(), matrix.partition().to_global(row)) - nodes.begin();
        for (unsigned int c = 0; c < dim; ++c)
          v.local_element(dim * row + c) += result[(dim + 1) * i + c];
        if (const int p = contact.at(row); p >= 0)
          contact.set_active(p, result[(dim + 1) * i + dim] != 0.);
      }
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/algebra/input_error.h>
#include <signorini/discretization/rigid_support.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    /// The six rigid motions of a body at a point, for component c.
    Vector6 rigid_row(const FreeMotion &frame, const Point<3> &p, const Vector3 &direction)
    {
      Vector6 row;
      for (unsigned int m = 0; m < 6; ++m)
        {
          FreeMotion motion                                     = frame;
          (m < 3 ? motion.translation : motion.rotation)[m % 3] = 1.;
          row[m]                                                = motion(p) * direction;
        }
      return row;
    }

    /// The part of each relevant node (-1 for nodes of other ranks' cells), and the box of each part as
    /// centre and half diagonal.
    std::vector<int> find_parts(std::vector<FreeMotion> &frames, const Bodies &bodies,
                                const NodalSpace &space)
    {
      const unsigned int  n_parts = bodies.n_parts();
      std::vector<double> low(dim * n_parts, std::numeric_limits<double>::max()), high(low);
      std::vector<int>    part_of_node(space.relevant().n_elements(), -1);
      for (double &h : high)
        h = -h;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          {
            const unsigned int part = bodies.part_of_material(cell.material);
            for (const NodeIndex node : space.nodes(cell))
              {
                part_of_node[space.relevant().index_within_set(node)] = static_cast<int>(part);
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    low[dim * part + c]  = std::min(low[dim * part + c], space.position(node)[c]);
                    high[dim * part + c] = std::max(high[dim * part + c], space.position(node)[c]);
                  }
              }
          }
      frames.clear();
      for (unsigned int b = 0; b < n_parts; ++b)
        {
          Point<3> l, h;
          for (unsigned int c = 0; c < dim; ++c)
            {
              l[c] = Utilities::MPI::min(low[dim * b + c], space.communicator());
              h[c] = Utilities::MPI::max(high[dim * b + c], space.communicator());
            }
          frames.push_back(
              {bodies.part(b).body, l + .5 * (h - l), .5 * (h - l).norm(), Vector3(), Vector3(), b});
        }
      return part_of_node;
    }
  } // namespace



  namespace
  {
    /// What rigid faces hold: the motions of their bodies that are none of theirs. Conditions weigh as those
    /// of nodes do.
    void add_rigid_faces(std::vector<double> &sums, const RigidFaces &rigid,
                         const std::vector<FreeMotion> &frames, const NodalSpace &space, const Bodies &bodies)
    {
      if (Utilities::MPI::this_mpi_process(space.communicator()) != 0)
        return;
      for (const RigidFace &face : rigid.faces())
        for (unsigned int b = 0; b < frames.size(); ++b)
          if (frames[b].body == face.body)
            {
              if (b + 1 < frames.size() && frames[b + 1].body == face.body)
                throw InputError(
                    "Body " + bodies.body_name(face.body) +
                    "/Rigid: the body has several parts that are not connected. Make them bodies "
                    "of their own.");
              // By column: what a unit motion of the body is to the face, without its free motions.
              Matrix6 rest;
              for (unsigned int m = 0; m < 6; ++m)
                {
                  FreeMotion motion                                     = frames[b];
                  (m < 3 ? motion.translation : motion.rotation)[m % 3] = 1.;
                  RigidMotion seen{motion(face.centre), face.length / motion.length * motion.rotation};
                  for (const RigidMotion &free : face.free)
                    {
                      const double share = free * seen;
                      seen.translation -= share * free.translation;
                      seen.rotation -= share * free.rotation;
                    }
                  for (unsigned int c = 0; c < 3; ++c)
                    {
                      rest(c, m)     = seen.translation[c];
                      rest(3 + c, m) = seen.rotation[c];
                    }
                }
              Eigen::Map<Matrix6>(sums.data() + 36 * b) += rest.transpose() * rest;
            }
    }
  } // namespace



  std::vector<FreeMotion> free_motions(const Bodies &bodies, const NodalSpace &space,
                                       const DirichletData &dirichlet)
  {
    std::vector<FreeMotion> frames;
    const auto              part_of_node = find_parts(frames, bodies, space);
    std::vector<double>     sums(36 * frames.size(), 0.);
    for (const NodeIndex node : space.owned())
      {
        const std::size_t i = space.relevant().index_within_set(node);
        if (part_of_node[i] < 0)
          continue;
        const unsigned int b = static_cast<unsigned int>(part_of_node[i]);
        if (dirichlet.rigid != nullptr && dirichlet.rigid->find(node) != nullptr)
          continue;
        for (const Vector3 &direction : dirichlet.fixed[i].basis())
          {
            const Vector6 row = rigid_row(frames[b], space.position(node), direction);
            Eigen::Map<Matrix6>(sums.data() + 36 * b) += row * row.transpose();
          }
      }
    if (dirichlet.rigid != nullptr)
      add_rigid_faces(sums, *dirichlet.rigid, frames, space, bodies);
    for (double &s : sums)
      s = Utilities::MPI::sum(s, space.communicator());

    std::vector<FreeMotion> result;
    for (unsigned int b = 0; b < frames.size(); ++b)
      {
        const SymmetricEigen eigen = symmetric_eigen(Eigen::Map<Matrix6>(sums.data() + 36 * b));
        const double         scale = std::max(eigen.values[5], std::numeric_limits<double>::min());
        for (unsigned int m = 0; m < 6; ++m)
          if (eigen.values[m] <= 1e-10 * scale)
            {
              FreeMotion motion = frames[b];
              for (unsigned int c = 0; c < dim; ++c)
                {
                  motion.translation[c] = eigen.vectors(c, m);
                  motion.rotation[c]    = eigen.vectors(3 + c, m);
                }
              result.push_back(motion);
            }
      }
    return result;
  }



  NodePlaces node_places(const Bodies &bodies, const NodalSpace &space)
  {
    std::vector<FreeMotion> frames;
    const auto              part_of_node = find_parts(frames, bodies, space);
    NodePlaces              result;
    for (const NodeIndex node : space.owned())
      {
        result.positions.push_back(space.position(node));
        result.parts.push_back(part_of_node[space.relevant().index_within_set(node)]);
      }
    return result;
  }



  std::vector<Vector> motion_fields(const std::vector<FreeMotion> &motions, const NodePlaces &places,
                                    const NodePartition &partition)
  {
    std::vector<Vector> fields(motions.size());
    for (std::size_t m = 0; m < motions.size(); ++m)
      {
        partition.reinit(fields[m]);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          if (places.parts[i] == static_cast<int>(motions[m].part))
            {
              const Vector3 u = motions[m](places.positions[i]);
              for (unsigned int c = 0; c < dim; ++c)
                fields[m].local_element(dim * i + c) = u[c];
            }
        fields[m].update_ghost_values();
      }
    return fields;
  }



  std::vector<Vector> motion_fields(const std::vector<FreeMotion> &motions, const Bodies &bodies,
                                    const NodalSpace &space, const NodePartition &partition)
  {
    return motion_fields(motions, node_places(bodies, space), partition);
  }



  namespace
  {
    /// min |A x - b|, x >= 0 (Lawson & Hanson 1974, chapter 23).
    Eigen::VectorXd solve_nonnegative(const Eigen::MatrixXd &a, const Eigen::VectorXd &b)
    {
      const Eigen::Index        n         = a.cols();
      const double              tolerance = 1e-12 * a.cwiseAbs().maxCoeff() * b.norm();
      Eigen::VectorXd           x         = Eigen::VectorXd::Zero(n);
      std::vector<Eigen::Index> set;
      for (Eigen::Index step = 0; step < 10 * (n + 10); ++step)
        {
          const Eigen::VectorXd gradient = a.transpose() * (b - a * x);
          Eigen::Index          best     = -1;
          for (Eigen::Index i = 0; i < n; ++i)
            if (std::find(set.begin(), set.end(), i) == set.end() && gradient[i] > tolerance &&
                (best < 0 || gradient[i] > gradient[best]))
              best = i;
          if (best < 0)
            break;
          set.push_back(best);
          while (!set.empty())
            {
              Eigen::MatrixXd part(a.rows(), set.size());
              for (std::size_t i = 0; i < set.size(); ++i)
                part.col(i) = a.col(set[i]);
              const Eigen::VectorXd y     = least_squares(part, b);
              double                limit = 1.;
              for (std::size_t i = 0; i < set.size(); ++i)
                if (y[i] <= 0.)
                  limit = std::min(limit, x[set[i]] / (x[set[i]] - y[i]));
              std::vector<Eigen::Index> kept;
              for (std::size_t i = 0; i < set.size(); ++i)
                {
                  double &value = x[set[i]];
                  value += limit * (y[i] - value);
                  if (value > 0. && (y[i] > 0. || limit < 1.) && value > 1e-14 * x.maxCoeff())
                    kept.push_back(set[i]);
                  else
                    value = 0.;
                }
              const bool done = limit == 1. && kept.size() == set.size();
              set             = kept;
              if (done)
                break;
            }
        }
      return x;
    }
  } // namespace



  RigidBalance balance_rigid_motions(const std::vector<double> &motions, const std::vector<double> &gaps,
                                     const std::vector<double> &loads)
  {
    const auto n = static_cast<Eigen::Index>(loads.size()), m = static_cast<Eigen::Index>(gaps.size());
    const Eigen::Map<const Eigen::MatrixXd> transposed(motions.data(), n, m);
    const Eigen::Map<const Eigen::VectorXd> f(loads.data(), n);
    RigidBalance                            result;
    result.flight.assign(loads.size(), 0.);
    result.settling.assign(loads.size(), 0.);
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(m);
    if (m > 0 && f.norm() > 0.)
      lambda = solve_nonnegative(transposed, f);
    const Eigen::VectorXd rest = m > 0 ? Eigen::VectorXd(f - transposed * lambda) : Eigen::VectorXd(f);
    result.is_held             = rest.norm() <= 1e-7 * f.norm();
    if (!result.is_held)
      {
        Eigen::Map<Eigen::VectorXd>(result.flight.data(), n) = rest / rest.norm();
        return result;
      }
    std::vector<Eigen::Index> holding;
    for (Eigen::Index p = 0; p < m; ++p)
      if (lambda[p] > 0.)
        holding.push_back(p);
    Eigen::MatrixXd rows(holding.size(), n);
    Eigen::VectorXd bounds(holding.size());
    for (std::size_t i = 0; i < holding.size(); ++i)
      {
        rows.row(i) = transposed.col(holding[i]).transpose();
        bounds[i]   = gaps[holding[i]];
      }
    if (!holding.empty())
      Eigen::Map<Eigen::VectorXd>(result.settling.data(), n) = least_squares(rows, bounds);
    return result;
  }



  std::vector<double> nearest_admissible(const std::vector<double> &rows, const std::vector<double> &bounds,
                                         const std::vector<double> &target)
  {
    const auto n = static_cast<Eigen::Index>(target.size()), m = static_cast<Eigen::Index>(bounds.size());
    const Eigen::Map<const Eigen::VectorXd> aim(target.data(), n);
    const double                            distance = aim.norm();
    if (m == 0 || distance == 0.)
      return target;
    // With y = (x - target) / distance: min |y|, -G y >= (G target - bounds) / distance, and |y| <= 1 since
    // the origin is admissible: the last entry of the rest is at least 1/2.
    Eigen::MatrixXd columns(n + 1, m);
    columns.topRows(n)            = -Eigen::Map<const Eigen::MatrixXd>(rows.data(), n, m);
    const Eigen::VectorXd towards = Eigen::Map<const Eigen::MatrixXd>(rows.data(), n, m).transpose() * aim;
    columns.row(n) = (towards - Eigen::Map<const Eigen::VectorXd>(bounds.data(), m)).transpose() / distance;
    const Eigen::VectorXd unit   = Eigen::VectorXd::Unit(n + 1, n);
    const Eigen::VectorXd rest   = unit - columns * solve_nonnegative(columns, unit);
    std::vector<double>   result = target;
    for (Eigen::Index i = 0; i < n; ++i)
      result[i] -= distance * rest[i] / rest[n];
    return result;
  }



  namespace
  {
    /// Splits the span of the columns of a matrix: what some functions (rows) vanish on, which is taken out
    /// of it, is returned.
    Eigen::MatrixXd take_kernel(Eigen::MatrixXd &columns, const Eigen::MatrixXd &functions)
    {
      const Eigen::Index n = columns.cols();
      if (n == 0)
        return columns;
      const Eigen::MatrixXd values   = functions * columns;
      const SymmetricEigen  eigen    = symmetric_eigen(values.transpose() * values);
      Eigen::Index          n_kernel = 0;
      while (n_kernel < n && eigen.values[n_kernel] <= 1e-12)
        ++n_kernel;
      const Eigen::MatrixXd turned = columns * eigen.vectors;
      columns                      = turned.rightCols(n - n_kernel);
      return turned.leftCols(n_kernel);
    }
  } // namespace



  std::vector<std::vector<double>> separate_motions(const std::vector<FreeMotion>          &motions,
                                                    const std::vector<std::vector<double>> &basis)
  {
    const auto             n = static_cast<Eigen::Index>(motions.size());
    Eigen::MatrixXd        rest(n, basis.size()), rotations(dim, n);
    std::set<unsigned int> parts;
    for (std::size_t k = 0; k < basis.size(); ++k)
      rest.col(k) = Eigen::Map<const Eigen::VectorXd>(basis[k].data(), n);
    for (Eigen::Index m = 0; m < n; ++m)
      {
        parts.insert(motions[m].part);
        for (unsigned int c = 0; c < dim; ++c)
          rotations(c, m) = motions[m].rotation[c];
      }
    std::vector<std::vector<double>> result;
    const auto                       append = [&](const Eigen::MatrixXd &columns) {
      for (Eigen::Index k = 0; k < columns.cols(); ++k)
        result.emplace_back(columns.col(k).data(), columns.col(k).data() + n);
    };
    for (const unsigned int part : parts)
      {
        Eigen::MatrixXd others = Eigen::MatrixXd::Identity(n, n);
        for (Eigen::Index m = 0; m < n; ++m)
          if (motions[m].part == part)
            others(m, m) = 0.;
        Eigen::MatrixXd own = take_kernel(rest, others);
        append(take_kernel(own, rotations));
        append(own);
      }
    append(rest);
    return result;
  }
} // namespace Signorini

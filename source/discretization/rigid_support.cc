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

    /// The part of each relevant node, -1 for nodes of other ranks' cells.
    std::vector<int> find_parts(const Bodies &bodies, const NodalSpace &space)
    {
      std::vector<int> part_of_node(space.relevant().n_elements(), -1);
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          for (const NodeIndex node : space.nodes(cell))
            part_of_node[space.relevant().index_within_set(node)] =
                static_cast<int>(bodies.part_of_material(cell.material));
      return part_of_node;
    }

    std::vector<unsigned int> groups_of_parts(const std::vector<TiedParts> &groups, const Bodies &bodies)
    {
      std::vector<unsigned int> group_of_part(bodies.n_parts());
      for (unsigned int g = 0; g < groups.size(); ++g)
        for (const unsigned int part : groups[g])
          group_of_part[part] = g;
      return group_of_part;
    }

    /// Collective. No motion of each group yet, but its box as centre and half diagonal.
    std::vector<FreeMotion> make_frames(const std::vector<TiedParts> &groups, const Bodies &bodies,
                                        const NodalSpace &space)
    {
      const std::vector<unsigned int> group_of_part = groups_of_parts(groups, bodies);
      std::vector<double>             low(dim * groups.size(), std::numeric_limits<double>::max()), high(low);
      for (double &h : high)
        h = -h;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          for (const NodeIndex node : space.nodes(cell))
            for (unsigned int c = 0; c < dim; ++c)
              {
                const std::size_t i = dim * group_of_part[bodies.part_of_material(cell.material)] + c;
                low[i]              = std::min(low[i], space.position(node)[c]);
                high[i]             = std::max(high[i], space.position(node)[c]);
              }
      std::vector<FreeMotion> frames;
      for (unsigned int g = 0; g < groups.size(); ++g)
        {
          Point<3> l, h;
          for (unsigned int c = 0; c < dim; ++c)
            {
              l[c] = Utilities::MPI::min(low[dim * g + c], space.communicator());
              h[c] = Utilities::MPI::max(high[dim * g + c], space.communicator());
            }
          std::vector<unsigned int> own;
          for (const unsigned int part : groups[g])
            own.push_back(bodies.part(part).body);
          frames.push_back(
              {groups[g], std::move(own), l + .5 * (h - l), .5 * (h - l).norm(), Vector3(), Vector3()});
        }
      return frames;
    }
  } // namespace



  namespace
  {
    /// Errors: InputError if there are several.
    unsigned int only_part(const Bodies &bodies, const unsigned int body)
    {
      int result = -1;
      for (unsigned int part = 0; part < bodies.n_parts(); ++part)
        if (bodies.part(part).body == body)
          {
            if (result >= 0)
              throw InputError("Body " + bodies.body_name(body) +
                               "/Rigid: the body has several parts that are not connected. Make them bodies "
                               "of their own.");
            result = static_cast<int>(part);
          }
      return static_cast<unsigned int>(result);
    }

    /// What rigid faces hold: the motions of their bodies that are none of theirs. Conditions weigh as those
    /// of nodes do.
    void add_rigid_faces(std::vector<double> &sums, const RigidFaces &rigid,
                         const std::vector<FreeMotion> &frames, const NodalSpace &space, const Bodies &bodies)
    {
      if (Utilities::MPI::this_mpi_process(space.communicator()) != 0)
        return;
      for (const RigidFace &face : rigid.faces())
        for (unsigned int b = 0, part = only_part(bodies, face.body); b < frames.size(); ++b)
          if (frames[b].moves(static_cast<int>(part)))
            {
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



  std::vector<TiedParts> separate_parts(const Bodies &bodies)
  {
    std::vector<TiedParts> result;
    for (unsigned int part = 0; part < bodies.n_parts(); ++part)
      result.push_back({part});
    return result;
  }



  std::vector<FreeMotion> free_motions(const Bodies &bodies, const NodalSpace &space,
                                       const DirichletData &dirichlet, const std::vector<TiedParts> &groups)
  {
    const std::vector<FreeMotion>   frames        = make_frames(groups, bodies, space);
    const std::vector<unsigned int> group_of_part = groups_of_parts(groups, bodies);
    const std::vector<int>          part_of_node  = find_parts(bodies, space);
    std::vector<double>             sums(36 * frames.size(), 0.);
    for (const NodeIndex node : space.owned())
      {
        const std::size_t i = space.relevant().index_within_set(node);
        if (part_of_node[i] < 0)
          continue;
        const unsigned int b = group_of_part[part_of_node[i]];
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
    const std::vector<int> part_of_node = find_parts(bodies, space);
    NodePlaces             result;
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
          if (motions[m].moves(places.parts[i]))
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
        parts.insert(motions[m].first_part());
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
          if (motions[m].first_part() == part)
            others(m, m) = 0.;
        Eigen::MatrixXd own = take_kernel(rest, others);
        append(take_kernel(own, rotations));
        append(own);
      }
    append(rest);
    return result;
  }
} // namespace Signorini

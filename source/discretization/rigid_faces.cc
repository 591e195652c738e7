// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/rigid_faces.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    struct RigidFaceRule
    {
      /// Of the largest eigenvalue of the conditions on the six motions of a face: below, a motion is free.
      double free = 1e-10;
      /// Of the displacements that conditions prescribe: what they may contradict each other by.
      double contradiction = 1e-8;
    };

    Vector6 to_numbers(const RigidMotion &motion)
    {
      Vector6 q;
      for (unsigned int c = 0; c < dim; ++c)
        {
          q[c]       = motion.translation[c];
          q[dim + c] = motion.rotation[c];
        }
      return q;
    }

    RigidMotion from_numbers(const Vector6 &q)
    {
      RigidMotion motion;
      for (unsigned int c = 0; c < dim; ++c)
        {
          motion.translation[c] = q[c];
          motion.rotation[c]    = q[dim + c];
        }
      return motion;
    }

    /// A place as it can be sent.
    struct PackedNode
    {
      NodeIndex             node;
      std::array<double, 3> position;
    };

    /// The nodes of a face that are not hanging, by number, on all ranks.
    std::map<NodeIndex, Point<3>> nodes_of_face(const NodalSpace                   &space,
                                                const std::set<types::boundary_id> &ids)
    {
      std::map<NodeIndex, Point<3>> mine;
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (ids.count(face.id) > 0)
          {
            const NodalSpace::Cell &cell = space.cells()[face.cell];
            for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
              if (const NodeIndex node = space.nodes(cell)[v];
                  space.owned().is_element(node) && !space.hanging_nodes().is_constrained(node))
                mine[node] = space.position(node);
          }
      if (Utilities::MPI::n_mpi_processes(space.communicator()) == 1)
        return mine;
      std::vector<PackedNode> packed;
      for (const auto &[node, x] : mine)
        packed.push_back({node, {{x[0], x[1], x[2]}}});
      std::map<NodeIndex, Point<3>> all;
      for (const PackedNode &one : gather_lists(packed, space.communicator(), Receivers::all))
        all[one.node] = Point<3>(one.position[0], one.position[1], one.position[2]);
      return all;
    }

    /// Conditions on the six numbers of a motion, summed up: rows r with r·q = value.
    struct Conditions
    {
      Matrix6 matrix = Matrix6::Zero();
      Vector6 rhs    = Vector6::Zero();
      double  square = 0.;

      void add(const Vector6 &row, const double value)
      {
        matrix += row * row.transpose();
        rhs += value * row;
        square += value * value;
      }

      /// Over all ranks.
      void sum(const MPI_Comm communicator)
      {
        std::vector<double> numbers(matrix.data(), matrix.data() + 36);
        numbers.insert(numbers.end(), rhs.data(), rhs.data() + 6);
        numbers.push_back(square);
        Utilities::MPI::sum(std::vector<double>(numbers), communicator, numbers);
        matrix = Eigen::Map<Matrix6>(numbers.data());
        rhs    = Eigen::Map<Vector6>(numbers.data() + 36);
        square = numbers[42];
      }
    };

    /// Splits the motions into free ones and the least one that does what the conditions want.
    void solve(RigidFace &face, const Conditions &conditions, const std::string &where)
    {
      constexpr RigidFaceRule rule;
      const SymmetricEigen    eigen   = symmetric_eigen(conditions.matrix);
      const double            largest = eigen.values[5];
      Matrix6                 free    = Matrix6::Identity();
      Vector6                 lift    = Vector6::Zero();
      for (unsigned int m = 0; m < 6; ++m)
        if (largest > 0. && eigen.values[m] > rule.free * largest)
          {
            const Vector6 v = eigen.vectors.col(m);
            free -= v * v.transpose();
            lift += (v.dot(conditions.rhs) / eigen.values[m]) * v;
          }
      const double left = conditions.square - lift.dot(conditions.rhs);
      if (left > rule.contradiction * conditions.square)
        throw InputError(where + ": the displacements that are prescribed at its nodes are no rigid motion.");
      face.lift = from_numbers(lift);
      // A basis that does not depend on how eigenvectors of one eigenvalue are chosen.
      face.free.clear();
      for (Eigen::Index best; free.colwise().norm().maxCoeff(&best) > .1;)
        {
          const Vector6 v = free.col(best).normalized();
          face.free.push_back(from_numbers(v));
          free -= v * (v.transpose() * free).eval();
        }
    }

    /// Collective. Turns with the body, as the middle of a box would not.
    Point<3> centre_of_area(const NodalSpace &space, const std::set<types::boundary_id> &ids)
    {
      std::vector<double> sums(dim + 1, 0.);
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (space.cells()[face.cell].is_owned && ids.count(face.id) > 0)
          {
            const Element     element(space, space.cells()[face.cell]);
            const ElementFace shape(element, face.face);
            for (unsigned int q = 0; q < shape.n_points(); ++q)
              {
                const double area = shape.point(q).area.norm();
                for (unsigned int c = 0; c < dim; ++c)
                  sums[c] += area * shape.point(q).position[c];
                sums[dim] += area;
              }
          }
      Utilities::MPI::sum(std::vector<double>(sums), space.communicator(), sums);
      return Point<3>(sums[0], sums[1], sums[2]) / sums[dim];
    }

    /// Collective. A face with its centre, its size and what acts on it.
    RigidFace make_face(const unsigned int index, const RigidFaceCondition &condition,
                        const NodalSpace &space, const std::map<NodeIndex, Point<3>> &nodes,
                        const double time)
    {
      RigidFace face{index, condition.body, Point<3>(), 0., {}, {}, {}, {}};
      Point<3>  low = nodes.begin()->second, high = low;
      for (const auto &[node, x] : nodes)
        for (unsigned int c = 0; c < dim; ++c)
          {
            low[c]  = std::min(low[c], x[c]);
            high[c] = std::max(high[c], x[c]);
          }
      face.length = .5 * low.distance(high);
      face.centre = condition.about ? *condition.about : centre_of_area(space, condition.ids);
      if (condition.force)
        face.force = condition.force(face.centre, time);
      if (condition.moment)
        face.moment = condition.moment(face.centre, time);
      return face;
    }

    /// Collective. What is prescribed at the nodes of a face.
    Conditions conditions_of_nodes(const RigidFace &face, const std::map<NodeIndex, Point<3>> &nodes,
                                   const NodalSpace &space, const DirichletData &data)
    {
      Conditions conditions;
      for (const auto &[node, x] : nodes)
        if (space.owned().is_element(node))
          {
            const std::size_t i = space.relevant().index_within_set(node);
            for (const Vector3 &direction : data.fixed[i].basis())
              conditions.add(
                  to_numbers({direction, cross_product_3d(x - face.centre, direction) / face.length}),
                  data.value[i] * direction);
          }
      conditions.sum(space.communicator());
      return conditions;
    }

    /// What is prescribed to a face as a whole weighs as much as all of its nodes.
    void add_conditions_of_face(Conditions &conditions, const RigidFace &face,
                                const RigidFaceCondition &condition, const double weight, const double time)
    {
      const bool is_guided = condition.direction.norm_square() > 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          Vector6 translation = Vector6::Zero(), rotation = Vector6::Zero();
          translation[c]    = weight;
          rotation[dim + c] = weight;
          if (condition.displacement[c])
            conditions.add(translation, weight * condition.displacement[c](face.centre, time));
          if (condition.rotation[c])
            conditions.add(rotation, weight * face.length * condition.rotation[c](face.centre, time));
          if (!is_guided)
            continue;
          Vector3 across;
          across[c] = 1.;
          across -= (across * condition.direction) * condition.direction / condition.direction.norm_square();
          conditions.add(weight * to_numbers({across, Vector3()}), 0.);
          conditions.add(rotation, 0.);
        }
    }
  } // namespace



  std::vector<RigidFace> find_rigid_faces(const NodalSpace &space, const Loads &loads,
                                          const DirichletData &data)
  {
    std::vector<RigidFace> result;
    for (unsigned int f = 0; f < loads.rigid_faces.size(); ++f)
      {
        const RigidFaceCondition &condition  = loads.rigid_faces[f];
        const auto                nodes      = nodes_of_face(space, condition.ids);
        RigidFace                 face       = make_face(f, condition, space, nodes, loads.time);
        Conditions                conditions = conditions_of_nodes(face, nodes, space, data);
        add_conditions_of_face(conditions, face, condition, static_cast<double>(nodes.size()), loads.time);
        solve(face, conditions, condition.where);
        result.push_back(std::move(face));
      }
    return result;
  }



  RigidFaces::RigidFaces(std::vector<RigidFace> faces, const NodalSpace &space, const Loads &loads)
    : the_faces(std::move(faces))
  {
    for (unsigned int f = 0; f < the_faces.size(); ++f)
      {
        const RigidFace &face  = the_faces[f];
        const auto       nodes = nodes_of_face(space, loads.rigid_faces[face.index].ids);
        // The two ends of the face: the choice depends on the numbering of no ranks.
        const auto before = [](const auto &a, const auto &b) {
          return std::tie(a.second[0], a.second[1], a.second[2]) <
                 std::tie(b.second[0], b.second[1], b.second[2]);
        };
        const auto [first, last] = std::minmax_element(nodes.begin(), nodes.end(), before);
        carrier_nodes.push_back(first->first);
        carrier_nodes.push_back(last->first);
        for (const auto &[node, x] : nodes)
          {
            Dependence dependence{f, x, {}};
            for (unsigned int j = 0; j < face.free.size(); ++j)
              {
                const Vector3 u = face.displacement(face.free[j], x);
                for (unsigned int c = 0; c < dim; ++c)
                  dependence.blocks[j / dim][c][j % dim] = u[c];
              }
            if (!dependences.insert({node, dependence}).second)
              throw InputError(loads.rigid_faces[face.index].where +
                               ": it has nodes in common with another rigid face.");
          }
      }
  }



  RigidFaces::RigidFaces(std::vector<RigidFace> faces, std::vector<NodeIndex> carriers)
    : the_faces(std::move(faces))
    , carrier_nodes(std::move(carriers))
  {
    AssertDimension(carrier_nodes.size(), 2 * the_faces.size());
  }



  int RigidFaces::find_carrier(const NodeIndex node) const
  {
    const auto it = std::find(carrier_nodes.begin(), carrier_nodes.end(), node);
    return it == carrier_nodes.end() ? -1 : static_cast<int>(it - carrier_nodes.begin());
  }



  const RigidFaces::Dependence *RigidFaces::find(const NodeIndex node) const
  {
    const auto it = dependences.find(node);
    return it == dependences.end() ? nullptr : &it->second;
  }



  FixedDirections RigidFaces::fixed_of_carrier(const int number) const
  {
    const std::size_t n_free = the_faces[number / 2].free.size();
    FixedMask         mask   = 0;
    for (unsigned int c = 0; c < dim; ++c)
      if (dim * (number % 2) + c >= n_free)
        mask = static_cast<FixedMask>(mask | 1u << c);
    return mask;
  }



  void RigidFaces::add(Vector &v, const NodePartition &partition, const unsigned int face,
                       const std::vector<double> &numbers) const
  {
    for (unsigned int j = 0; j < numbers.size(); ++j)
      if (const NodeIndex node = carrier(face, j / dim); partition.owns(node))
        v.local_element(dim * partition.to_local(node) + j % dim) += numbers[j];
  }



  void add_rigid_faces(DirichletData &data, const NodalSpace &space, const Loads &loads,
                       const std::vector<RigidFace> &faces)
  {
    auto rigid = std::make_shared<const RigidFaces>(faces, space, loads);
    for (const auto &[node, dependence] : rigid->nodes())
      if (space.relevant().is_element(node))
        {
          const std::size_t i       = space.relevant().index_within_set(node);
          const int         carrier = rigid->find_carrier(node);
          const RigidFace  &face    = rigid->faces()[dependence.face];
          data.fixed[i]             = carrier < 0 ? all_fixed : rigid->fixed_of_carrier(carrier);
          data.value[i]             = face.displacement(face.lift, dependence.position);
          data.condition[i]         = {{-1, -1, -1}};
          data.held.erase(i);
        }
    data.rigid = std::move(rigid);
  }
} // namespace Signorini

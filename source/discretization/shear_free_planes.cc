// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/element.h>
#include <signorini/discretization/shear_free_planes.h>

#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct ShearFreeRule
    {
      /// Sine of the angle up to which two directions are one: far above the rounding of meshes with five
      /// digits, far below the angle between the faces of a curved boundary.
      double same = 1e-3;
      /// The vote of a face that may have shear, against those of all that have none.
      double against = -1e3;
      /// Of an axis of coordinates, what must be left to be the next direction: one of those that are
      /// left has 1/sqrt(3) at least.
      double left = .5;
    };

    bool is_one(const Vector3 &a, const Vector3 &b)
    {
      return (a - b).norm() <= ShearFreeRule().same;
    }

    /// Of the directions of a node, those between which a component of the shear acts.
    constexpr std::array<std::array<unsigned int, 2>, 3> shears = {{{{0, 1}}, {{1, 2}}, {{2, 0}}}};
  } // namespace



  ShearFreePlanes::ShearFreePlanes(const NodalSpace &space, const Loads &loads,
                                   const std::vector<FixedDirections> &fixed)
    : space(space)
    , fixed(fixed)
    , partition(space.owned(), space.relevant(), space.communicator())
  {
    for (Vector &v : votes)
      partition.reinit(v);
    std::set<types::boundary_id> loaded;
    for (const Traction &traction : loads.tractions)
      loaded.insert(traction.ids.begin(), traction.ids.end());
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (space.cells()[face.cell].is_owned)
        {
          const ElementFace    shape(Element(space, space.cells()[face.cell]), face.face);
          const FaceConditions conditions(space, loads, face, shape);
          if (is_one(conditions.held.project_free(conditions.normal), Vector3()))
            add(face, conditions, loaded.count(face.id) > 0);
        }
    for (Vector &v : votes)
      {
        v.compress(VectorOperation::add);
        v.update_ghost_values();
      }
  }



  std::array<Vector3, 3> ShearFreePlanes::directions(const NodeIndex node) const
  {
    FixedDirections held = fixed[space.relevant().index_within_set(node)];
    if (space.hanging_nodes().is_constrained(node))
      {
        held = all_fixed;
        for (const auto &parent : *space.hanging_nodes().get_constraint_entries(node))
          held = held.common(fixed[space.relevant().index_within_set(parent.first)]);
      }
    std::vector<Vector3> basis = held.is_along_axes() ? std::vector<Vector3>() : held.basis();
    for (unsigned int c = 0; c < dim && basis.size() < dim; ++c)
      {
        Vector3 rest;
        rest[c] = 1.;
        for (const Vector3 &b : basis)
          rest -= (b * rest) * b;
        if (const double length = rest.norm(); length >= ShearFreeRule().left)
          basis.push_back(rest / length);
      }
    return {{basis[0], basis[1], basis[2]}};
  }



  void ShearFreePlanes::add(const NodalSpace::BoundaryFace &face, const FaceConditions &conditions,
                            const bool is_loaded)
  {
    const NodalSpace::Cell &cell = space.cells()[face.cell];
    for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
      {
        const NodeIndex    node  = space.nodes(cell)[v];
        const auto         basis = directions(node);
        const unsigned int i     = dim * partition.to_local(node);
        for (unsigned int s = 0; s < shears.size(); ++s)
          for (const unsigned int turned : {0, 1})
            {
              const Vector3 &across = basis[shears[s][turned]], &along = basis[shears[s][1 - turned]];
              if (is_one(across, conditions.normal) || is_one(across, -conditions.normal))
                votes[turned].local_element(i + s) +=
                    !is_loaded && is_one(conditions.held.project_free(along), along)
                        ? 1.
                        : ShearFreeRule().against;
            }
      }
  }



  Block ShearFreePlanes::without_shear(const NodeIndex node, const Block &stress) const
  {
    const unsigned int i      = dim * partition.to_local(node);
    Block              result = stress;
    for (unsigned int s = 0; s < shears.size(); ++s)
      if (votes[0].local_element(i + s) > 0. || votes[1].local_element(i + s) > 0.)
        {
          const auto     basis = directions(node);
          const Vector3 &a = basis[shears[s][0]], &b = basis[shears[s][1]];
          const double   shear = a * (stress * b);
          result -= shear * (outer_product(a, b) + outer_product(b, a));
        }
    return result;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/element.h>
#include <signorini/discretization/shear_free_planes.h>

#include <algorithm>
#include <cmath>
#include <map>

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
      /// Cosine of the angle up to which faces that are not in one plane are those of a curved boundary.
      double curved = .94;
      /// Of an axis of coordinates, what must be left to be the next direction: one of those that are
      /// left has 1/sqrt(3) at least.
      double left = .5;
      /// Of the square of a tensor, what must be left of it beside others: planes that meet have up to five
      /// different components of shear.
      double independent = 1e-6;
    };

    bool is_one(const Vector3 &a, const Vector3 &b)
    {
      return (a - b).norm() <= ShearFreeRule().same;
    }

    /// The axis of coordinates that a unit vector is to the digits of a mesh, else itself.
    Vector3 axis_or_itself(const Vector3 &v)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          Vector3 axis;
          axis[c] = v[c] < 0. ? -1. : 1.;
          if (is_one(axis, v))
            return axis;
        }
      return v;
    }

    /// An orthonormal basis of what is free; axes of coordinates where these span it.
    std::vector<Vector3> free_basis(const FixedDirections &held)
    {
      std::vector<Vector3> basis   = held.basis();
      const std::size_t    n_fixed = basis.size();
      for (unsigned int c = 0; c < dim && basis.size() < dim; ++c)
        {
          Vector3 rest;
          rest[c] = 1.;
          for (const Vector3 &b : basis)
            rest -= (b * rest) * b;
          if (const double length = rest.norm(); length >= ShearFreeRule().left)
            basis.push_back(rest / length);
        }
      basis.erase(basis.begin(), basis.begin() + static_cast<std::ptrdiff_t>(n_fixed));
      return basis;
    }

    double product(const Block &a, const Block &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        sum += a[i] * b[i];
      return sum;
    }

    bool is_before(const Vector3 &a, const Vector3 &b)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (a[c] != b[c])
          return a[c] < b[c];
      return false;
    }

    FixedDirections span_of_both(const FixedDirections &one, const FixedDirections &other)
    {
      std::vector<Vector3>       directions = one.basis();
      const std::vector<Vector3> more       = other.basis();
      directions.insert(directions.end(), more.begin(), more.end());
      return FixedDirections::span(directions);
    }

    /// One for each plane, of those of all faces around a node: none where the faces are those of a curved
    /// boundary.
    template <typename Plane>
    std::vector<Plane> joined(std::vector<Plane> of_faces)
    {
      // The same on any number of ranks.
      std::stable_sort(of_faces.begin(), of_faces.end(),
                       [](const Plane &a, const Plane &b) { return is_before(a.normal, b.normal); });
      std::vector<Plane> result;
      for (const Plane &one : of_faces)
        {
          const auto same = std::find_if(result.begin(), result.end(), [&](const Plane &other) {
            return is_one(one.normal, other.normal);
          });
          if (same == result.end())
            result.push_back(one);
          else
            same->held = span_of_both(same->held, one.held);
        }
      const auto is_curved = [&](const Plane &one) {
        return std::any_of(result.begin(), result.end(), [&](const Plane &other) {
          return one.normal * other.normal > ShearFreeRule().curved && !is_one(one.normal, other.normal);
        });
      };
      std::vector<Plane> plane;
      std::copy_if(result.begin(), result.end(), std::back_inserter(plane),
                   [&](const Plane &one) { return !is_curved(one); });
      return plane;
    }
  } // namespace



  ShearFreePlanes::ShearFreePlanes(const NodalSpace &space, const Loads &loads,
                                   const std::vector<FixedDirections> &fixed)
    : space(space)
    , fixed(fixed)
  {
    const NodePartition                     partition(space.owned(), space.relevant(), space.communicator());
    std::map<NodeIndex, std::vector<Plane>> owned;
    for (const auto &[rank, list] : send_lists(votes(loads, partition), space.communicator()))
      for (const Vote &vote : list)
        owned[vote.node].push_back(vote.plane);
    for (auto &[node, of_faces] : owned)
      of_faces = joined(of_faces);
    std::vector<NodeIndex> relevant;
    for (const NodeIndex node : space.relevant())
      relevant.push_back(node);
    planes = NodeRequest(partition, std::move(relevant))
                 .fetch_lists<Plane>([&](std::vector<Plane> &list, const unsigned int local) {
                   if (const auto found = owned.find(partition.to_global(local)); found != owned.end())
                     list.insert(list.end(), found->second.begin(), found->second.end());
                 });
  }



  FixedDirections ShearFreePlanes::fixed_at(const NodeIndex node) const
  {
    if (!space.hanging_nodes().is_constrained(node))
      return fixed[space.relevant().index_within_set(node)];
    FixedDirections held = all_fixed;
    for (const auto &parent : *space.hanging_nodes().get_constraint_entries(node))
      held = held.common(fixed[space.relevant().index_within_set(parent.first)]);
    return held;
  }



  ListsByRank<ShearFreePlanes::Vote> ShearFreePlanes::votes(const Loads         &loads,
                                                            const NodePartition &partition) const
  {
    std::set<types::boundary_id> loaded;
    for (const Traction &traction : loads.tractions)
      loaded.insert(traction.ids.begin(), traction.ids.end());
    ListsByRank<Vote> result;
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      {
        const NodalSpace::Cell &cell = space.cells()[face.cell];
        if (!cell.is_owned)
          continue;
        const ElementFace    shape(Element(space, cell), face.face);
        const FaceConditions conditions(space, loads, face, shape);
        if (!is_one(conditions.held.project_free(conditions.normal), Vector3()))
          continue;
        const Plane plane{axis_or_itself(conditions.normal),
                          loaded.count(face.id) > 0 ? FixedDirections(all_fixed) : conditions.held};
        for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
          {
            const NodeIndex node = space.nodes(cell)[v];
            // The nodes of a curved boundary are held along means of the normals of its faces.
            if (is_one(fixed_at(node).project_free(plane.normal), Vector3()))
              result[partition.owner(node)].push_back({node, plane});
          }
      }
    return result;
  }



  Block ShearFreePlanes::without_shear(const NodeIndex node, const Block &stress) const
  {
    const auto         i      = space.relevant().index_within_set(node);
    Block              result = stress;
    std::vector<Block> taken;
    for (std::size_t k = planes.start[i]; k < planes.start[i + 1]; ++k)
      for (const Vector3 &along : free_basis(planes.items[k].held))
        {
          const Vector3 &n     = planes.items[k].normal;
          const Block    whole = outer_product(n, along) + outer_product(along, n);
          Block          rest  = whole;
          for (const Block &other : taken)
            rest -= product(rest, other) / product(other, other) * other;
          const double square = product(rest, rest);
          if (square <= ShearFreeRule().independent * product(whole, whole))
            continue;
          result -= product(result, rest) / square * rest;
          taken.push_back(rest);
        }
    return result;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "nodal_contact_forces.h"

#include <signorini/algebra/collectives.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/discretization/elasticity.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// What is left of the forces on one body, and of their moments about its centre of nodes.
    class BodyBalance
    {
    public:
      /// A nodal force before those that balance it are taken off, and the displacement there.
      void add_scale(const Point<3> &x, const Vector3 &force, const Vector3 &u)
      {
        scale += force.norm();
        displacement = std::max(displacement, u.norm());
        n_nodes += 1.;
        centre += Vector3(x);
        square += x.square();
      }

      void add_rest(const Point<3> &x, const Vector3 &f)
      {
        force += f;
        moment += cross_product_3d(Vector3(x), f);
      }

      /// Over all ranks. Returns the sum of the norms of the nodal forces.
      double sum(const MPI_Comm comm)
      {
        force        = Signorini::sum(force, comm);
        moment       = Signorini::sum(moment, comm);
        centre       = Signorini::sum(centre, comm);
        scale        = Utilities::MPI::sum(scale, comm);
        n_nodes      = Utilities::MPI::sum(n_nodes, comm);
        square       = Utilities::MPI::sum(square, comm);
        displacement = Utilities::MPI::max(displacement, comm);
        if (n_nodes > 0.)
          centre /= n_nodes;
        return scale;
      }

      double relative_force(const double scale) const
      {
        return scale > 0. ? force.norm() / scale : 0.;
      }

      double relative_moment(const double scale) const
      {
        return scale * size() > 0. ? (moment - cross_product_3d(centre, force)).norm() / (scale * size())
                                   : 0.;
      }

      /// Equilibrium::Rest.
      Equilibrium::Rest rest(const double young) const
      {
        return {relative_force(1.), scale, young, displacement, size()};
      }

    private:
      /// Root mean square of the distances from the centre.
      double size() const
      {
        return n_nodes > 0. ? std::sqrt(std::max(0., square / n_nodes - centre.norm_square())) : 0.;
      }

      Vector3 force, moment, centre;
      double  scale = 0., n_nodes = 0., square = 0., displacement = 0.;
    };

    /// Puts the contact forces on the other side of the equilibrium.
    void subtract_contact_forces(Vector &residual, const Discretization &d, const ContactStress &stress)
    {
      for_contact_forces(d, stress, [&](const unsigned int i, const Vector3 &force) {
        for (unsigned int c = 0; c < dim; ++c)
          residual.local_element(dim * i + c) -= force[c];
      });
    }

    /// Splits what is left at the owned nodes into the reactions of the conditions (their sums) and the rest.
    class RestOfForces
    {
    public:
      RestOfForces(const Discretization &d, const Vector &residual, const std::size_t n_conditions)
        : reactions(n_conditions)
        , rest(d.partition().n_owned())
        , n_held(n_conditions, 0)
      {
        const RigidFaces *const rigid = d.dirichlet().rigid.get();
        if (rigid != nullptr)
          rigid_sums.resize(rigid->faces().size());
        for (unsigned int i = 0; i < rest.size(); ++i)
          {
            const NodeIndex node = d.partition().to_global(i);
            if (d.nodal().hanging_nodes().is_constrained(node))
              continue;
            Vector3 force;
            for (unsigned int c = 0; c < dim; ++c)
              force[c] = residual.local_element(dim * i + c);
            if (const auto *const dependence = rigid != nullptr ? rigid->find(node) : nullptr)
              {
                rigid_sums[dependence->face].add(force, dependence->position -
                                                            rigid->faces()[dependence->face].centre);
                continue;
              }
            rest[i] = d.dirichlet().split_reaction(d.nodal().relevant().index_within_set(node), force,
                                                   [&](const std::size_t condition, const Vector3 &part) {
                                                     reactions[condition] += part;
                                                     ++n_held[condition];
                                                   });
            square += rest[i].norm_square();
          }
      }

      /// Of all ranks: what the rigid faces do to their bodies, and what of it is no load of theirs.
      void balance_rigid_faces(const RigidFaces &rigid, const MPI_Comm communicator)
      {
        for (std::size_t f = 0; f < rigid_sums.size(); ++f)
          {
            ForceAndMoment &sum    = rigid_sums[f];
            sum.force              = Signorini::sum(sum.force, communicator);
            sum.moment             = Signorini::sum(sum.moment, communicator);
            const RigidFace  &face = rigid.faces()[f];
            const RigidMotion work{sum.force, sum.moment / face.length};
            for (std::size_t j = 0; j < face.free.size(); ++j)
              rigid_square += Utilities::fixed_power<2>(face.free[j] * work - face.load_on(face.free[j]));
          }
      }

      struct ForceAndMoment
      {
        void add(const Vector3 &nodal_force, const Vector3 &arm)
        {
          force += nodal_force;
          moment += cross_product_3d(arm, nodal_force);
        }

        Vector3 force, moment;
      };

      std::vector<Vector3> reactions, rest;
      /// By condition, directions of nodes of this rank.
      std::vector<std::size_t> n_held;
      double                   square = 0., rigid_square = 0.;
      /// By rigid face.
      std::vector<ForceAndMoment> rigid_sums;
    };
  } // namespace



  namespace
  {
    /// Largest Young's modulus of each body.
    std::vector<double> largest_moduli(const Bodies &bodies)
    {
      std::vector<double> result(bodies.n_bodies(), 0.);
      for (types::material_id id = 0; id < bodies.n_materials(); ++id)
        {
          double &of_body = result[bodies.body_of_material(id)];
          of_body         = std::max(of_body, bodies.material(id).young);
        }
      return result;
    }

    /// Those of strains without stress, which may balance themselves altogether.
    Vector eigenstrain_forces(const ContactModel &model, const Discretization &d)
    {
      Loads strains;
      strains.volume_forces.resize(model.bodies().n_bodies());
      strains.time         = model.loads().time;
      strains.eigenstrains = model.loads().eigenstrains;
      strains.pretensions  = model.loads().pretensions;
      Vector nothing;
      d.partition().reinit(nothing);
      nothing.update_ghost_values();
      return physical_residual(model.bodies(), d.nodal(), d.partition(), strains, nothing);
    }
  } // namespace



  Equilibrium evaluate_equilibrium(const ContactModel &model, const Discretization &d,
                                   const ContactSolution &solution)
  {
    const MPI_Comm comm = model.communicator();
    Vector         residual =
        physical_residual(model.bodies(), d.nodal(), d.partition(), model.loads(), solution.displacement);
    Equilibrium result;
    result.largest_nodal_force = residual.l2_norm();
    const Vector initial       = model.loads().has_eigenstrains() ? eigenstrain_forces(model, d) : Vector();
    if (model.loads().has_eigenstrains())
      result.largest_nodal_force = std::max(result.largest_nodal_force, initial.l2_norm());
    const std::vector<unsigned int> body_of_node = bodies_of_nodes(d, model.bodies());
    std::vector<BodyBalance>        balance(model.bodies().n_bodies());
    const auto                      position = [&](const unsigned int i) -> const Point<3>                      &{
      return d.nodal().position(d.partition().to_global(i));
    };
    for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
      if (body_of_node[i] != numbers::invalid_unsigned_int)
        {
          Vector3 force = nodal_value(residual, i);
          if (model.loads().has_eigenstrains() && nodal_value(initial, i).norm() > force.norm())
            force = nodal_value(initial, i);
          balance[body_of_node[i]].add_scale(position(i), force, nodal_value(solution.displacement, i));
        }
    subtract_contact_forces(residual, d, solution.stress);
    RestOfForces forces(d, residual, model.loads().dirichlet.size());
    if (d.dirichlet().rigid != nullptr)
      forces.balance_rigid_faces(*d.dirichlet().rigid, comm);
    for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
      if (body_of_node[i] != numbers::invalid_unsigned_int &&
          !d.nodal().hanging_nodes().is_constrained(d.partition().to_global(i)))
        balance[body_of_node[i]].add_rest(position(i), forces.rest[i]);
    double largest = 0.;
    for (BodyBalance &b : balance)
      largest = std::max(largest, b.sum(comm));
    const std::vector<double> young = largest_moduli(model.bodies());
    for (unsigned int b = 0; b < balance.size(); ++b)
      result.of_bodies.push_back(balance[b].rest(young[b]));
    for (const BodyBalance &b : balance)
      {
        result.force_balance  = std::max(result.force_balance, b.relative_force(largest));
        result.moment_balance = std::max(result.moment_balance, b.relative_moment(largest));
      }
    const double square = Utilities::MPI::sum(forces.square, comm) + forces.rigid_square;
    result.residual = result.largest_nodal_force > 0. ? std::sqrt(square) / result.largest_nodal_force : 0.;
    for (std::size_t i = 0; i < forces.reactions.size(); ++i)
      {
        const DirichletCondition &condition = model.loads().dirichlet[i];
        result.reactions.push_back(
            {model.bodies().body_name(condition.body), condition.boundary, sum(forces.reactions[i], comm)});
        result.is_told.push_back(!condition.is_between_sets ||
                                 Utilities::MPI::sum(forces.n_held[i], comm) > 0);
      }
    for (std::size_t f = 0; f < forces.rigid_sums.size(); ++f)
      {
        const RigidFaceCondition &face = model.loads().rigid_faces[f];
        result.reactions.push_back(
            {model.bodies().body_name(face.body), face.boundary, forces.rigid_sums[f].force});
        result.is_told.push_back(true);
      }
    return result;
  }



  std::vector<BoundaryResult> Equilibrium::told_reactions() const
  {
    std::vector<BoundaryResult> result;
    for (std::size_t i = 0; i < reactions.size(); ++i)
      if (is_told[i])
        result.push_back(reactions[i]);
    return result;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "node_conditions.h"

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/element.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;
  namespace
  {
    std::string parameter_of(const LoadDefinition::SurfaceForce &force)
    {
      return force.traction ? "Tractions" : (force.pressure ? "Pressures" : "Forces");
    }
  } // namespace



  void Loads::add(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition)
  {
    const std::string section = "Body " + bodies.body_name(body) + "/";
    for (const LoadDefinition::Displacement &condition : definition.displacements)
      {
        const unsigned int           node_set = bodies.has_boundary(body, condition.boundary)
                                                    ? StartNodes::none
                                                    : bodies.node_set(body, condition.boundary);
        std::set<types::boundary_id> ids;
        if (node_set == StartNodes::none)
          ids = bodies.boundary_ids(body, condition.boundary, section + "Dirichlet");
        else if (condition.frame.needs_normal())
          throw InputError(section + "Dirichlet: \"" + condition.boundary +
                           "\" is a set of nodes, which has no normals. Name a boundary or a direction.");
        if (condition.frame.needs_normal() && (condition.components[1] || condition.components[2]))
          throw InputError(
              section + "Dirichlet, boundary \"" + condition.boundary +
              "\": along a normal there is one component; tangents have no meaning of their own.");
        dirichlet.push_back({body,
                             condition.boundary,
                             ids,
                             condition.components,
                             condition.frame,
                             {},
                             node_set,
                             StartNodes::none,
                             condition.is_between_sets});
        if (condition.frame.needs_normal())
          dirichlet.back().shapes = bodies.true_shapes(body, ids, false);
      }
    for (const LoadDefinition::RigidBoundary &rigid : definition.rigid_boundaries)
      rigid_faces.push_back({section + "Rigid, boundary \"" + rigid.boundary + "\"", body, rigid.boundary,
                             bodies.boundary_ids(body, rigid.boundary, section + "Rigid"), rigid.force,
                             rigid.moment, rigid.about, rigid.displacement, rigid.rotation, rigid.direction});
    for (const LoadDefinition::NodalForce &force : definition.nodal_forces)
      nodal_forces[bodies.start_vertex(body, force.vertex)].push_back(force.force);
    for (const LoadDefinition::SurfaceForce &force : definition.surface_forces)
      tractions.push_back({bodies.boundary_ids(body, force.boundary, section + parameter_of(force)),
                           force.traction, force.pressure, force.total_force});
    volume_forces.resize(std::max<std::size_t>(volume_forces.size(), body + 1));
    volume_forces[body] = definition.volume_force;
    add_initial_strains(bodies, body, definition);
    add_pretensions(bodies, body, definition);
  }



  SurfaceForces::SurfaceForces(const Loads &loads, const NodalSpace &space)
    : loads(loads)
    , areas(loads.tractions.size(), 0.)
  {
    for (std::size_t t = 0; t < loads.tractions.size(); ++t)
      for (const types::boundary_id id : loads.tractions[t].ids)
        by_boundary[id].push_back(t);
    if (std::none_of(loads.tractions.begin(), loads.tractions.end(),
                     [](const Traction &t) { return static_cast<bool>(t.total_force); }))
      return;
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (space.cells()[face.cell].is_owned && !on(face.id).empty())
        {
          const Element     element(space, space.cells()[face.cell]);
          const ElementFace shape(element, face.face);
          double            area = 0.;
          for (unsigned int q = 0; q < shape.n_points(); ++q)
            area += shape.point(q).area.norm();
          for (const std::size_t t : on(face.id))
            areas[t] += area;
        }
    for (double &area : areas)
      area = Utilities::MPI::sum(area, space.communicator());
  }



  const std::vector<std::size_t> &SurfaceForces::on(const types::boundary_id id) const
  {
    static const std::vector<std::size_t> none;
    const auto                            it = by_boundary.find(id);
    return it == by_boundary.end() ? none : it->second;
  }



  Vector3 SurfaceForces::force(const std::size_t traction, const Point<3> &position,
                               const Vector3 &area) const
  {
    const Traction &t = loads.tractions[traction];
    Vector3         result;
    if (t.traction)
      result = area.norm() * t.traction(position, loads.time);
    if (t.pressure)
      result -= t.pressure(position, loads.time) * area;
    if (t.total_force)
      result += area.norm() / areas[traction] * t.total_force(Point<3>(), loads.time);
    return result;
  }



  namespace
  {
    /// A rank sees all faces at its own nodes, but not all at its ghost nodes: the owners tell.
    void import_conditions(DirichletData &data, const NodalSpace &space)
    {
      const NodePartition partition(space.owned(), space.relevant(), space.communicator());
      const auto          relevant = [&](const unsigned int i) {
        return space.relevant().index_within_set(partition.to_global(i));
      };
      Vector conditions;
      partition.reinit(conditions);
      std::vector<FixedDirections> own(partition.n_owned());
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        {
          own[i] = data.fixed[relevant(i)];
          for (unsigned int c = 0; c < dim; ++c)
            conditions.local_element(dim * i + c) = data.condition[relevant(i)][c];
        }
      conditions.update_ghost_values();
      const std::vector<FixedDirections> all = import_ghost_masks(partition, own);
      for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
        {
          data.fixed[relevant(i)] = all[i];
          for (unsigned int c = 0; c < dim; ++c)
            data.condition[relevant(i)][c] = static_cast<int>(conditions.local_element(dim * i + c));
        }
    }

    /// The displacements of held nodes, ghosts too.
    void set_held_values(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      if (Utilities::MPI::max(data.held.empty() ? 0 : 1, space.communicator()) == 0)
        return;
      const NodePartition partition(space.owned(), space.relevant(), space.communicator());
      Vector              values;
      partition.reinit(values);
      for (const auto &[i, node] : data.held)
        {
          const NodeIndex number = space.relevant().nth_index_in_set(i);
          for (const HeldNode::Hold &hold : node.holds)
            data.value[i] += loads.dirichlet[hold.condition].components[hold.component](
                                 space.position(number), loads.time) *
                             hold.dual;
          for (unsigned int c = 0; c < dim; ++c)
            values.local_element(dim * partition.to_local(number) + c) = data.value[i][c];
        }
      values.update_ghost_values();
      for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          data.value[space.relevant().index_within_set(partition.to_global(i))][c] +=
              values.local_element(dim * i + c);
    }

    void set_values(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      for (std::size_t i = 0; i < data.value.size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          if (data.condition[i][c] >= 0)
            data.value[i][c] = loads.dirichlet[data.condition[i][c]].components[c](
                space.position(space.relevant().nth_index_in_set(i)), loads.time);
      set_held_values(data, space, loads);
    }
  } // namespace



  DirichletData evaluate_dirichlet(const NodalSpace &space, const Loads &loads, const bool with_values,
                                   const std::vector<RigidFace> &rigid)
  {
    const std::size_t n = space.relevant().n_elements();
    DirichletData     data;
    data.fixed.assign(n, {});
    data.value.assign(n, Vector3());
    data.condition.assign(n, {{-1, -1, -1}});
    const NodeConditions conditions(space, loads);
    for (const auto &[i, latest] : conditions.plain())
      {
        FixedMask mask = 0;
        for (unsigned int c = 0; c < dim; ++c)
          if (latest[c] >= 0)
            mask = static_cast<FixedMask>(mask | 1u << c);
        data.condition[i] = latest;
        data.fixed[i]     = mask;
      }
    data.held = conditions.held();
    for (const auto &[i, node] : data.held)
      {
        std::vector<Vector3> directions;
        for (const HeldNode::Hold &hold : node.holds)
          directions.push_back(hold.direction);
        data.fixed[i] = FixedDirections::span(directions);
      }
    if (Utilities::MPI::n_mpi_processes(space.communicator()) > 1)
      import_conditions(data, space);
    if (with_values || (!loads.rigid_faces.empty() && rigid.empty()))
      set_values(data, space, loads);
    if (!loads.rigid_faces.empty())
      add_rigid_faces(data, space, loads, rigid.empty() ? find_rigid_faces(space, loads, data) : rigid);
    return data;
  }



  std::vector<FixedDirections> fixed_of_owned(const NodalSpace &space, const DirichletData &dirichlet)
  {
    std::vector<FixedDirections> masks;
    for (const NodeIndex node : space.owned())
      masks.push_back(space.hanging_nodes().is_constrained(node)
                          ? all_fixed
                          : dirichlet.fixed[space.relevant().index_within_set(node)]);
    return masks;
  }
} // namespace Signorini

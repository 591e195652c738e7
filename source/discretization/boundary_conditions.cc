// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <Eigen/Eigenvalues>

namespace Signorini
{
  using namespace dealii;

  void LoadParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Dirichlet", dirichlet,
                      "Prescribed displacements, \"boundary: (ux, uy, uz); boundary: ...\". Each entry is an "
                      "expression in x, y, z (length), or * for a free component: a symmetry plane x = 0 is "
                      "\"symmetry x: (0, *, *)\". Where conditions overlap, the later one counts.");
    prm.add_parameter("Tractions", tractions,
                      "Forces per area, \"boundary: (tx, ty, tz); ...\", expressions in x, y, z.");
    prm.add_parameter("Pressures", pressures,
                      "Pressures against the outward normal (force per area), \"boundary: p; ...\".");
    prm.add_parameter("Volume force", volume_force, "Force per volume, \"(fx, fy, fz)\"; empty for none.");
  }



  LoadDefinition LoadParameters::definition(const std::string &section) const
  {
    LoadDefinition result;
    for (const auto &[name, text] : split_named_entries(dirichlet, section + "Dirichlet"))
      {
        const std::string            where = section + "Dirichlet, boundary \"" + name + "\"";
        LoadDefinition::Displacement condition{name, {}};
        const auto                   entries = split_vector(text, where);
        for (unsigned int c = 0; c < dim; ++c)
          if (entries[c] != "*")
            condition.components[c] = Expression(entries[c], where);
        result.displacements.push_back(condition);
      }
    for (const auto &[name, text] : split_named_entries(tractions, section + "Tractions"))
      result.surface_forces.push_back(
          {name, parse_vector_field(text, section + "Tractions, boundary \"" + name + "\""), {}});
    for (const auto &[name, text] : split_named_entries(pressures, section + "Pressures"))
      result.surface_forces.push_back(
          {name, {}, Expression(text, section + "Pressures, boundary \"" + name + "\"")});
    if (!Utilities::trim(volume_force).empty())
      result.volume_force = parse_vector_field(volume_force, section + "Volume force");
    return result;
  }



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
        dirichlet.push_back({body, condition.boundary, ids, condition.components, node_set});
      }
    for (const LoadDefinition::NodalForce &force : definition.nodal_forces)
      nodal_forces[bodies.start_vertex(body, force.vertex)] += force.force;
    for (const LoadDefinition::SurfaceForce &force : definition.surface_forces)
      tractions.push_back(
          {bodies.boundary_ids(body, force.boundary, section + (force.traction ? "Tractions" : "Pressures")),
           force.traction, force.pressure});
    volume_forces.resize(std::max<std::size_t>(volume_forces.size(), body + 1));
    volume_forces[body] = definition.volume_force;
  }



  namespace
  {
    /// Entries of the conditions as they appear on the faces this rank can see.
    void collect_from_faces(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      std::map<types::boundary_id, std::vector<int>> conditions_of;
      for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
        for (const types::boundary_id id : loads.dirichlet[i].ids)
          conditions_of[id].push_back(i);

      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        {
          const auto it = conditions_of.find(face.id);
          if (it == conditions_of.end())
            continue;
          const NodalSpace::Cell &cell = space.cells()[face.cell];
          for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
            {
              const NodeIndex node = space.nodes(cell)[v];
              if (space.hanging_nodes().is_constrained(node))
                continue;
              const std::size_t i = space.relevant().index_within_set(node);
              for (const int condition : it->second)
                for (unsigned int c = 0; c < dim; ++c)
                  if (loads.dirichlet[condition].components[c])
                    {
                      data.mask[i] |= 1u << c;
                      data.condition[i][c] = std::max(data.condition[i][c], condition);
                    }
            }
        }
    }

    /// Entries of the conditions on sets of nodes, at the nodes of this rank.
    void collect_from_sets(DirichletData &data, const NodalSpace &space, const Loads &loads)
    {
      for (int condition = 0; condition < static_cast<int>(loads.dirichlet.size()); ++condition)
        if (loads.dirichlet[condition].node_set != StartNodes::none)
          for (const NodeIndex node : space.node_sets()[loads.dirichlet[condition].node_set])
            {
              const std::size_t i = space.relevant().index_within_set(node);
              for (unsigned int c = 0; c < dim; ++c)
                if (loads.dirichlet[condition].components[c])
                  {
                    data.mask[i] |= 1u << c;
                    data.condition[i][c] = std::max(data.condition[i][c], condition);
                  }
            }
    }
  } // namespace



  Vector3 Traction::force(const Point<3> &position, const Vector3 &area) const
  {
    Vector3 result;
    if (traction)
      result = area.norm() * traction(position);
    if (pressure)
      result -= pressure(position) * area;
    return result;
  }



  DirichletData evaluate_dirichlet(const NodalSpace &space, const Loads &loads, const bool with_values)
  {
    const std::size_t n = space.relevant().n_elements();
    DirichletData     data;
    data.mask.assign(n, 0);
    data.value.assign(n, Vector3());
    data.condition.assign(n, {{-1, -1, -1}});
    collect_from_faces(data, space, loads);
    collect_from_sets(data, space, loads);

    // A rank sees all faces at its own nodes, but not all at its ghost nodes: ask the owners.
    if (Utilities::MPI::n_mpi_processes(space.communicator()) > 1)
      {
        const NodePartition partition(space.owned(), space.relevant(), space.communicator());
        Vector              conditions;
        partition.reinit(conditions);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            conditions.local_element(dim * i + c) =
                data.condition[space.relevant().index_within_set(partition.to_global(i))][c];
        conditions.update_ghost_values();
        for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
          {
            const std::size_t r = space.relevant().index_within_set(partition.to_global(i));
            data.mask[r]        = 0;
            for (unsigned int c = 0; c < dim; ++c)
              {
                data.condition[r][c] = static_cast<int>(conditions.local_element(dim * i + c));
                if (data.condition[r][c] >= 0)
                  data.mask[r] |= 1u << c;
              }
          }
      }

    if (with_values)
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          if (data.condition[i][c] >= 0)
            data.value[i][c] = loads.dirichlet[data.condition[i][c]].components[c](
                space.position(space.relevant().nth_index_in_set(i)));
    return data;
  }
} // namespace Signorini

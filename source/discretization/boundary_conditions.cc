// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>

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



  void Loads::add(const Bodies &bodies, const unsigned int body, const LoadParameters &parameters)
  {
    const std::string section = "Body " + bodies.body_name(body) + "/";
    for (const auto &[name, text] : split_named_entries(parameters.dirichlet, section + "Dirichlet"))
      {
        const std::string  where = section + "Dirichlet, boundary \"" + name + "\"";
        DirichletCondition condition{body, name, bodies.boundary_ids(body, name, section + "Dirichlet"), {}};
        const auto         entries = split_vector(text, where);
        for (unsigned int c = 0; c < dim; ++c)
          if (entries[c] != "*")
            condition.components[c] = Expression(entries[c], where);
        dirichlet.push_back(condition);
      }
    for (const auto &[name, text] : split_named_entries(parameters.tractions, section + "Tractions"))
      {
        const std::string where   = section + "Tractions, boundary \"" + name + "\"";
        const auto        entries = split_vector(text, where);
        Traction          traction{bodies.boundary_ids(body, name, section + "Tractions"), false, {}};
        for (unsigned int c = 0; c < dim; ++c)
          traction.values[c] = Expression(entries[c], where);
        tractions.push_back(traction);
      }
    for (const auto &[name, text] : split_named_entries(parameters.pressures, section + "Pressures"))
      {
        Traction traction{bodies.boundary_ids(body, name, section + "Pressures"), true, {}};
        traction.values[0] = Expression(text, section + "Pressures, boundary \"" + name + "\"");
        tractions.push_back(traction);
      }
    volume_forces.resize(std::max<std::size_t>(volume_forces.size(), body + 1));
    if (!Utilities::trim(parameters.volume_force).empty())
      {
        const auto entries = split_vector(parameters.volume_force, section + "Volume force");
        for (unsigned int c = 0; c < dim; ++c)
          volume_forces[body][c] = Expression(entries[c], section + "Volume force");
      }
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
  } // namespace



  Vector3 Traction::force(const Point<3> &position, const Vector3 &area) const
  {
    if (is_pressure)
      return -values[0](position) * area;
    Vector3 result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = values[c](position) * area.norm();
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
            data.value[i][c] = (*loads.dirichlet[data.condition[i][c]].components[c])(
                space.position(space.relevant().nth_index_in_set(i)));
    return data;
  }
} // namespace Signorini

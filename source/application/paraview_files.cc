// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "paraview_files.h"

#include <signorini/algebra/node_request.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  std::string file_name(const std::string &pair)
  {
    return Utilities::replace_in_string(pair, " ", "-");
  }



  std::vector<std::string> body_files(const Bodies &bodies)
  {
    std::vector<std::string> files;
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      {
        const std::string name  = "body-" + file_name(bodies.body_name(b));
        std::string       other = name;
        for (unsigned int i = 2; std::find(files.begin(), files.end(), other) != files.end(); ++i)
          other = name + "-" + std::to_string(i);
        files.push_back(other);
      }
    return files;
  }



  std::vector<ParaviewBlock> paraview_blocks(const Bodies &bodies, const Discretization &d,
                                             const OutputParameters &output)
  {
    std::vector<ParaviewBlock> blocks;
    if (output.bodies)
      {
        const auto files = body_files(bodies);
        for (unsigned int b = 0; b < files.size(); ++b)
          blocks.push_back({"body " + bodies.body_name(b), files[b]});
      }
    if (output.surfaces)
      for (const ContactPair &pair : d.pairs)
        {
          const std::string file = "contact-" + file_name(pair.name);
          blocks.push_back({"contact " + pair.name + ", nonmortar side (" + pair.nonmortar.name + ")", file});
          if (!pair.obstacle)
            blocks.push_back(
                {"contact " + pair.name + ", mortar side (" + pair.mortar.name + ")", file + "-mortar"});
        }
    return blocks;
  }



  namespace
  {
    OutputField whole_numbers(const std::string &name, std::vector<double> values)
    {
      return {name, 1, std::move(values), true};
    }
  } // namespace



  std::vector<OutputField> node_numbers(const Bodies &bodies, const NodalSpace &space)
  {
    std::vector<double> here, in_file;
    for (const NodeIndex node : space.relevant())
      here.push_back(static_cast<double>(node));
    std::vector<OutputField> fields = {whole_numbers("node", std::move(here))};
    if (!bodies.has_node_numbers())
      return fields;
    for (const unsigned int vertex : space.start_vertices())
      in_file.push_back(static_cast<double>(bodies.node_number(vertex)));
    fields.push_back(whole_numbers("mesh_node", std::move(in_file)));
    return fields;
  }



  std::vector<OutputField> node_numbers(const Bodies &bodies, const Discretization &d,
                                        const ContactSurface &surface)
  {
    std::vector<OutputField> fields = {
        whole_numbers("node", std::vector<double>(surface.vertex_node.begin(), surface.vertex_node.end()))};
    if (!bodies.has_node_numbers())
      return fields;
    const unsigned int  rank = Utilities::MPI::this_mpi_process(d.nodal().communicator());
    std::set<NodeIndex> wanted;
    for (const ContactSurface::Face &face : surface.faces)
      if (face.worker == rank)
        for (unsigned int v = 0; v < face.n_corners; ++v)
          wanted.insert(surface.vertex_node[face.corners[v]]);
    const NodeRequest   request(d.partition(), {wanted.begin(), wanted.end()});
    const auto          found = request.fetch([&](const unsigned int local) {
      const NodeIndex node = d.partition().to_global(local);
      return bodies.node_number(d.nodal().start_vertices()[d.nodal().relevant().index_within_set(node)]);
    });
    std::vector<double> in_file(surface.vertex_node.size(), VolumeMesh::no_number);
    for (std::size_t v = 0; v < in_file.size(); ++v)
      {
        const auto &nodes = request.nodes();
        const auto  it    = std::lower_bound(nodes.begin(), nodes.end(), surface.vertex_node[v]);
        if (it != nodes.end() && *it == surface.vertex_node[v])
          in_file[v] = static_cast<double>(found[it - nodes.begin()]);
      }
    fields.push_back(whole_numbers("mesh_node", std::move(in_file)));
    return fields;
  }



  std::vector<OutputField> cell_fields(const Bodies &bodies, const NodalSpace &space,
                                       const std::vector<double> &indicator)
  {
    std::vector<double> body, level, error;
    for (std::size_t c = 0; c < space.cells().size(); ++c)
      {
        body.push_back(bodies.body_of_material(space.cells()[c].material));
        level.push_back(space.cells()[c].level);
        if (!indicator.empty())
          error.push_back(std::sqrt(std::max(0., indicator[c])));
      }
    std::vector<OutputField> fields = {whole_numbers("body", std::move(body)),
                                       whole_numbers("level", std::move(level))};
    if (!indicator.empty())
      fields.push_back({"indicator", 1, std::move(error)});
    return fields;
  }
} // namespace Signorini

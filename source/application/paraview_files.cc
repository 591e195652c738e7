// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "paraview_files.h"

#include <signorini/algebra/node_request.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::string without_spaces(const std::string &name)
    {
      return Utilities::replace_in_string(name, " ", "-");
    }

    /// The name, or the first one with a number behind it that is not used.
    std::string unused(const std::string &name, const std::function<bool(const std::string &)> &is_used)
    {
      std::string other = name;
      for (unsigned int i = 2; is_used(other); ++i)
        other = name + "-" + std::to_string(i);
      return other;
    }
  } // namespace



  std::vector<std::string> body_files(const Bodies &bodies)
  {
    std::vector<std::string> files;
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      files.push_back(
          unused("body-" + without_spaces(bodies.body_name(b)), [&files](const std::string &name) {
            return std::find(files.begin(), files.end(), name) != files.end();
          }));
    return files;
  }



  std::vector<PairFiles> pair_files(const std::vector<ContactPair> &pairs)
  {
    std::vector<PairFiles> files;
    std::set<std::string>  used;
    const auto             sides = [](const std::string &name) {
      return std::array<std::string, 2>{{"contact-" + name, "contact-" + name + "-mortar"}};
    };
    for (const ContactPair &pair : pairs)
      {
        const std::string name   = unused(without_spaces(pair.name), [&](const std::string &other) {
          return used.count(sides(other)[0]) + used.count(sides(other)[1]) > 0;
        });
        const auto [non, mortar] = sides(name);
        used.insert({non, mortar});
        files.push_back({non, mortar, "mapping-" + name});
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
      {
        const auto files = pair_files(d.pairs);
        for (unsigned int p = 0; p < files.size(); ++p)
          {
            const ContactPair &pair = d.pairs[p];
            blocks.push_back({"contact " + pair.name + ", nonmortar side (" + pair.nonmortar.name + ")",
                              files[p].nonmortar});
            if (!pair.obstacle)
              blocks.push_back(
                  {"contact " + pair.name + ", mortar side (" + pair.mortar.name + ")", files[p].mortar});
          }
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

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "read_input.h"

#include <signorini/application/journal.h>
#include <signorini/application/parameters.h>
#include <signorini/application/problem_description.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/mapping_quality.h>

#include <ostream>
#include <stdexcept>

using namespace Signorini;

namespace
{
  void check_problem(const std::string &file)
  {
    const ParameterFile parameters(file, {});
    parameters.nested();
    parameters.load_steps();
    ContactModel model(MPI_COMM_WORLD, parameters.problem(MPI_COMM_WORLD));
    Journal      journal(false, 0);
    model.note_movement(journal);
    model.refine_globally(parameters.initial_levels());
    const auto   space = std::make_shared<const ConstrainedSpace>(model);
    std::ostream nowhere(nullptr);
    describe(nowhere, model, *discretize(model, space, {}, 0, journal));
  }

  void map_surface(const std::string &file)
  {
    const SurfaceMesh surface = read_surface(file);
    SurfaceMesh       square;
    square.vertices = {{0., 0., .2}, {1., 0., .2}, {1., 1., .2}, {0., 1., .2}};
    square.triangles.push_back({{0, 2, 1}});
    square.triangles.push_back({{0, 3, 2}});
    square.compute_vertex_normals();
    for (const SurfaceMesh *other : {static_cast<const SurfaceMesh *>(&square), &surface})
      {
        const ContactMapping mapping(surface, *other);
        assess_mapping(mapping, surface, *other);
      }
  }
} // namespace



void
read_input(const std::string &kind, const std::string &file)
{
  if (kind == "parameters" || kind == "deck")
    check_problem(file);
  else if (kind == "mesh")
    read_volume_mesh(file, MPI_COMM_WORLD);
  else if (kind == "surface")
    map_surface(file);
  else
    throw std::logic_error("there is no kind of files \"" + kind + "\".");
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mesh_placed_body_h
#define signorini_source_mesh_placed_body_h

#include <signorini/mesh/bodies.h>

namespace Signorini
{
  /// The mesh of one body in its place.
  struct Bodies::Placed
  {
    VolumeMesh                mesh;
    std::vector<unsigned int> material_of_volume, material_of_cell;
    /// Vertices of the start mesh that could not be moved to their shapes.
    std::vector<unsigned int>  late;
    dealii::types::boundary_id first_boundary;
    /// Manifolds that are not the shapes' own.
    std::vector<std::pair<dealii::types::boundary_id, std::shared_ptr<const dealii::Manifold<3>>>> manifolds;
  };

  /// The boundaries of some places.
  template <typename Places>
  std::set<dealii::types::boundary_id> boundaries_of(const Places &places)
  {
    std::set<dealii::types::boundary_id> ids;
    for (const auto &place : places)
      ids.insert(place.first);
    return ids;
  }

  /// Names for a message.
  inline std::string listed(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return text;
  }
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_interpolated_field_h
#define signorini_source_application_interpolated_field_h

#include <signorini/mesh/volume_mesh.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// Finds the cells of a mesh that points lie in, for functions that are given by their values at its
  /// vertices.
  class MeshInterpolation
  {
  public:
    /// Vertices of a cell and the values of their shape functions at a point.
    struct Weights
    {
      std::array<unsigned int, 8> vertices = {};
      std::array<double, 8>       values   = {};
      unsigned int                n        = 0;
    };

    /// Keeps vertices and cells of the mesh.
    explicit MeshInterpolation(const VolumeMesh &mesh);

    /// Of the cell that contains a point, or of one next to it; not empty.
    Weights weights(const dealii::Point<3> &p) const;

  private:
    using Bin = std::array<int, 3>;

    Bin                              bin_at(const dealii::Point<3> &p) const;
    const std::vector<unsigned int> &cells_in(const Bin &bin) const
    {
      return bins[(static_cast<std::size_t>(bin[2]) * n_bins[1] + bin[1]) * n_bins[0] + bin[0]];
    }

    VolumeMesh                             mesh;
    dealii::Point<3>                       low, high;
    std::array<int, 3>                     n_bins;
    std::vector<std::vector<unsigned int>> bins;
  };
} // namespace Signorini

#endif

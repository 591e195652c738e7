// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_python_result_arrays_h
#define signorini_python_result_arrays_h

#include <signorini/application/write_results.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Signorini
{
  /// Fields of all nodes or vertices of something, on all ranks.
  using FieldArrays = std::vector<OutputField>;

  /// A body as plain lists, the same on all ranks.
  struct BodyArrays
  {
    /// Of the body.
    std::string name;
    /// Three coordinates a node (length).
    std::vector<double> nodes;
    /// Eight and four nodes a cell, in the order of VTK.
    std::vector<std::int64_t> hexahedra, tetrahedra;
    /// As body_fields() has them.
    FieldArrays fields;
  };

  /// A contact surface as plain lists, the same on all ranks.
  struct SurfaceArrays
  {
    /// "body: boundary".
    std::string name;
    /// Three coordinates a vertex (length).
    std::vector<double> vertices;
    /// Four vertices a face (ContactSurface::Face), three a triangle.
    std::vector<std::int64_t> faces, triangles;
    /// As nonmortar_fields() or mortar_fields() has them; of the nonmortar side also "area".
    FieldArrays fields;
  };

  /// A contact pair.
  struct PairArrays
  {
    /// Of the pair.
    std::string name;
    /// The mortar side has no name and no vertices where the partner is an obstacle.
    SurfaceArrays nonmortar, mortar;
  };

  /// Fields at one load step.
  struct StepArrays
  {
    /// The pseudo-time.
    double time = 0.;
    /// By body, by pair.
    std::vector<FieldArrays> bodies, nonmortar, mortar;
  };

  /// What belongs to the mesh of a discretization: which nodes and cells make up a body, on all ranks.
  class MeshArrays
  {
  public:
    /// Collective. The model is that of the discretization.
    MeshArrays(const ContactModel &model, const Discretization &discretization);

    /// Collective. Bodies with nodes and cells, and fields of a solution.
    std::vector<BodyArrays> bodies(const ContactModel &model, const Discretization &discretization,
                                   const ContactSolution &solution) const;

    /// Collective. By body the fields of a solution at its nodes.
    std::vector<FieldArrays> body_values(const ContactModel &model, const Discretization &discretization,
                                         const ContactSolution &solution) const;

  private:
    std::vector<std::string> names;
    /// Of all nodes; by body its nodes, ascending, and its cells in numbers of its own.
    std::vector<dealii::Point<3>>          positions;
    std::vector<std::vector<std::size_t>>  nodes;
    std::vector<std::vector<std::int64_t>> hexahedra, tetrahedra;
  };

  /// Collective. Surfaces of all pairs with their fields.
  std::vector<PairArrays> pair_arrays(const Discretization &discretization, const ContactSolution &solution);

  /// Collective. Fields alone, by pair, of the nonmortar side (or the mortar side: empty with an obstacle).
  FieldArrays pair_values(const Discretization &discretization, const ContactSolution &solution,
                          const unsigned int pair, const bool of_mortar);
} // namespace Signorini

#endif

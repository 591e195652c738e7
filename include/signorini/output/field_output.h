// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_field_output_h
#define signorini_output_field_output_h

#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/surface/overlay.h>

#include <functional>
#include <string>
#include <vector>

namespace Signorini
{
  /// Values at nodes or vertices: n_components numbers each, in the order of the list they belong to.
  struct OutputField
  {
    /// As ParaView shows it, and 1 or 3.
    std::string  name;
    unsigned int n_components;
    /// Fields of three components become vectors for ParaView, others single scalars.
    std::vector<double> values;
  };

  /// Collective. Writes the owned cells as NAME.NUMBER.vtu with NAME.pvtu and NAME.pvd (on rank 0).
  /// Fields are indexed like NodalSpace::relevant(); cell_value gives the cell field "body".
  /// @param most_files of which neighbouring ranks share one where there are more ranks; 0 for one a rank
  void write_bodies(const std::string &folder, const std::string &name, const NodalSpace &space,
                    const std::vector<OutputField>                                         &fields,
                    const std::function<double(const dealii::types::material_id material)> &body,
                    const unsigned int                                                      most_files);

  /// Collective. Writes the faces of a contact surface that this rank owns, in the same way. Fields are
  /// indexed by vertex.
  void write_surface(const std::string &folder, const std::string &name, const ContactSurface &surface,
                     const std::vector<OutputField> &fields, const MPI_Comm communicator,
                     const unsigned int most_files);

  /// Writes the overlay of two surfaces as one .vtu stream: its triangles on the nonmortar side with the
  /// number of both triangles and, at the corners, the way to the image ("image") and its part along the
  /// normal ("gap").
  void write_overlay(std::ostream &out, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                     const std::vector<OverlayTriangle> &overlay);

  /// Collective. Volume weighted nodal averages of the stress: fields "stress" (xx, yy, zz, xy, yz, zx),
  /// "von Mises" and "principal stress" (3, largest first), in the unit of E.
  /// displacement: values at the relevant nodes, three each. Cells with mean dilatation have its stress.
  std::vector<OutputField> nodal_stress(const NodalSpace &space, const std::vector<double> &displacement,
                                        const Bodies &bodies, const Loads &loads);
} // namespace Signorini

#endif

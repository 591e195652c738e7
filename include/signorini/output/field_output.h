// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_field_output_h
#define signorini_output_field_output_h

#include <signorini/discretization/nodal_stress.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/output/vtu_file.h>
#include <signorini/surface/overlay.h>

#include <functional>
#include <string>
#include <vector>

namespace Signorini
{
  /// How the files of bodies are divided.
  struct BodyFiles
  {
    /// By body: the name of the .pvtu file for it alone, without that ending.
    std::vector<std::string> names;
    /// The number of the body that cells with a material belong to.
    std::function<unsigned int(const dealii::types::material_id material)> body;
  };

  /// Collective. Writes the owned cells as NAME.NUMBER.vtu, the files of one body after those of the other,
  /// with NAME.pvtu and NAME.pvd for all and one .pvtu for each body (on rank 0). Cells of a body share
  /// points. Errors: InputError for a disk that is full.
  /// @param fields indexed like NodalSpace::relevant() and NodalSpace::cells()
  void write_bodies(const std::string &folder, const std::string &name, const NodalSpace &space,
                    const VtuFields &fields, const BodyFiles &bodies, const FileFormat &format);

  /// Collective. Writes the faces of a contact surface that this rank works on, in the same way. Fields are
  /// indexed by vertex.
  void write_surface(const std::string &folder, const std::string &name, const ContactSurface &surface,
                     const std::vector<OutputField> &fields, const MPI_Comm communicator,
                     const FileFormat &format);

  /// Writes the overlay of two surfaces as one .vtu stream: its triangles on the nonmortar side with the
  /// number of both triangles and, at the corners, the way to the image ("image") and its part along the
  /// normal ("gap").
  /// @param nonmortar_number,mortar_number what number a triangle gets; its own if left out
  void write_overlay(std::ostream &out, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                     const std::vector<OverlayTriangle>                    &overlay,
                     const std::function<unsigned int(const unsigned int)> &nonmortar_number = {},
                     const std::function<unsigned int(const unsigned int)> &mortar_number    = {});

  /// What is written of a stress at the relevant nodes: "stress" (xx, yy, zz, xy, yz, zx), "von_Mises" and
  /// "principal_stress" (3, largest first), in the unit of E.
  std::vector<OutputField> stress_fields(const std::vector<StressComponents> &stress);
} // namespace Signorini

#endif

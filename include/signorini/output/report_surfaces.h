// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_report_surfaces_h
#define signorini_output_report_surfaces_h

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/output/field_output.h>
#include <signorini/output/report_mesh.h>
#include <signorini/output/report_page.h>

#include <iosfwd>
#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  /// A surface of a contact pair as the report shows it.
  struct ReportSide
  {
    /// Number of the pair; whether it is the mortar surface; "body: boundary"; number of the body.
    unsigned int pair      = 0;
    bool         is_mortar = false;
    std::string  name;
    unsigned int body = 0;
    /// What this rank has of it; it must outlive the use of this object. Ids of its boundaries.
    const ContactSurface                *surface = nullptr;
    std::set<dealii::types::boundary_id> ids;
    /// By vertex of the surface, right at the corners of the faces that this rank works on.
    std::vector<OutputField> fields;
  };

  /// A solution that is drawn: its number in the page, and its pseudo-time.
  struct ReportState
  {
    /// See above.
    unsigned int number = 0;
    double       time   = 1.;
  };

  /// The surfaces of bodies and pairs of one mesh, on rank 0, thinned where they are too fine for a page
  /// (ReportRule). The same on any number of ranks.
  class ReportSurfaces
  {
  public:
    /// Collective.
    /// @param sides without fields
    /// @param n_states how many solutions write_state() is going to be called for
    ReportSurfaces(const NodalSpace &space, const Bodies &bodies, const std::vector<ReportSide> &sides,
                   const unsigned int n_states, const ReportRule &rule = ReportRule());

    /// On rank 0. Points and triangles, and the element "scene" that says what they are.
    void write_geometry(ReportBlocks &blocks) const;

    /// Collective. The fields of one solution, and the element "state-NUMBER" that says what they are.
    /// @param blocks null on other ranks than 0
    /// @param body_fields displacement and von Mises stress at the relevant nodes of the space
    /// @param sides with fields
    void write_state(ReportBlocks *const blocks, const ReportState &state, const NodalSpace &space,
                     const std::vector<OutputField> &body_fields, const std::vector<ReportSide> &sides) const;

  private:
    /// A surface on rank 0.
    struct Drawn
    {
      ReportMesh mesh;
      /// By vertex: place in `nodes` (of a body), number in the surface (of a side).
      std::vector<unsigned int> source;
      /// Triangles before it was thinned.
      std::size_t n_triangles = 0;
    };

    void write_scene(std::ostream &out) const;
    void draw_sides(const std::vector<ContactSurface> &whole_sides, const std::size_t n_triangles);
    void draw_bodies(const NodalSpace &space, const Bodies &bodies,
                     const std::vector<ContactSurface> &whole_sides, const std::size_t n_triangles);

    /// What the page says of the sides, without surfaces.
    std::vector<ReportSide>  sides;
    std::vector<std::string> body_names;
    std::vector<Drawn>       drawn_bodies, drawn_sides;
    /// Of all bodies, sorted; on all ranks.
    std::vector<NodeIndex> nodes;
  };
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "imported_field.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_checks.h>
#include <signorini/application/pair_fields.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/pair_conflicts.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/output/final_words.h>
#include <signorini/surface/mapping_quality.h>

#include <algorithm>
#include <iomanip>
#include <tuple>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Limits of what is solved with a note. Pure numbers.
    struct ContactRule
    {
      /// Covered area whose multipliers other pairs take away, as a share of the covered area. A strip of one
      /// face between two neighbours on one surface is less on all but the coarsest meshes.
      double lost_share = .25;
      /// Initial overlap as a share of the extent of a body along the normal: what is no interference fit,
      /// and what is taken for one unless it is asked for. Fits of shafts are a thousandth; linear elasticity
      /// ends at a tenth.
      double overlap = .5, small_overlap = .01;
      /// Initial overlap as a share of the heights of both surfaces over their facets: surfaces that touch
      /// overlap by that, for facets do not know more of them. A pin in a bore of its own radius: .002.
      double touching = .01;
      /// What prescribed displacements add to the overlap of two surfaces, as a share of the largest of them:
      /// more than different meshes make of the same field.
      double held_overlap = .02;
      /// Every row of S couples all of its columns with each other. Their blocks, as a multiple of those of
      /// the bodies' own matrix, from where on a pair is refused, unless they are few: 15 million take a
      /// gigabyte. On matching meshes the multiple is 0.1 or less.
      double dense_blocks = 3., few_dense_blocks = 1.5e7;
    };

    /// Covered areas of a pair that carry no multiplier, by who is to blame.
    struct LostContact
    {
      double covered = 0., by_conditions = 0., by_other_pairs = 0.;
    };

    /// Calls a function with (moments, reason) for all covered faces of this rank of which no node has a
    /// multiplier.
    template <typename Function>
    void for_lost_faces(const ContactPair &pair, const PairCoupling &coupling, const Function &function)
    {
      for (const PairCoupling::LostFace &lost : coupling.lost_faces)
        {
          const auto m =
              std::lower_bound(pair.moments.begin(), pair.moments.end(), lost.face,
                               [](const FaceMoments &a, const unsigned int face) { return a.face < face; });
          function(*m, lost.reason);
        }
    }

    /// Collective.
    LostContact lost_contact(const ContactPair &pair, const PairCoupling &coupling, const MPI_Comm comm)
    {
      LostContact result;
      for_lost_faces(pair, coupling, [&](const FaceMoments &m, const DroppedNode::Reason reason) {
        if (reason != DroppedNode::other_pair)
          result.by_conditions += m.covered;
        else
          result.by_other_pairs += m.covered;
      });
      result.covered        = coupling.covered_area;
      result.by_conditions  = Utilities::MPI::sum(result.by_conditions, comm);
      result.by_other_pairs = Utilities::MPI::sum(result.by_other_pairs, comm);
      return result;
    }

    /// Collective. Of what a pair covers and is not far from, the area of nodes that have no row in it
    /// because of other pairs: they have none at all, or act on another mortar body.
    double area_of_others(const ContactPair &pair, const PairCoupling &coupling, const MPI_Comm comm)
    {
      std::set<NodeIndex> nodes;
      for (const DroppedNode &dropped : coupling.dropped)
        if (dropped.reason == DroppedNode::other_pair)
          nodes.insert(dropped.node);
      const ContactSurface      &surface = pair.nonmortar.surface;
      std::vector<unsigned char> is_lost(surface.vertex_node.size(), 0);
      for (std::size_t v = 0; v < is_lost.size(); ++v)
        is_lost[v] = nodes.count(surface.vertex_node[v]) > 0;
      pair.halo->update(is_lost);
      double area = 0.;
      for (const FaceMoments &m : pair.moments)
        if (pair.halo->owns_face(m.face) && m.covered > 0. && !is_far(m))
          for (unsigned int a = 0; a < surface.faces[m.face].n_corners; ++a)
            if (is_lost[surface.faces[m.face].corners[a]])
              for (unsigned int b = 0; b < surface.faces[m.face].n_corners; ++b)
                area += m.mass[4 * a + b];
      return Utilities::MPI::sum(area, comm);
    }

  } // namespace



  LossOfChoice loss_of_choice(const ContactPair &pair, const PairCoupling &coupling, const MPI_Comm comm)
  {
    const LostContact lost = lost_contact(pair, coupling, comm);
    LossOfChoice      result;
    if (lost.by_other_pairs > ContactRule().lost_share * lost.covered)
      result.refused = lost.by_other_pairs / lost.covered;
    const double of_others = area_of_others(pair, coupling, comm);
    const double by_conditions =
        lost.by_conditions > ContactRule().lost_share * lost.covered ? lost.by_conditions : 0.;
    if (!(of_others + by_conditions > 1e-12 * lost.covered) && result.refused == 0.)
      return result;
    result.share = std::max(result.refused, (of_others + by_conditions) / lost.covered);
    result.reason =
        percent_text(result.share, 3) + " of \"" + pair.nonmortar.name +
        "\" could carry no contact stress (" +
        (of_others > by_conditions || by_conditions == 0. ? "it is the nonmortar side of another pair, too"
                                                          : "its displacements are prescribed") +
        ")";
    return result;
  }



  namespace
  {
    /// Collective. The other pairs that need nodes of a pair's nonmortar side.
    std::string rivals_of(const std::vector<ContactPair> &pairs, const unsigned int pair, const MPI_Comm comm)
    {
      const auto of_all_ranks = [comm](const std::set<NodeIndex> &nodes) {
        const auto list =
            gather_lists(std::vector<NodeIndex>(nodes.begin(), nodes.end()), comm, Receivers::all);
        return std::set<NodeIndex>(list.begin(), list.end());
      };
      const std::set<NodeIndex> own =
          of_all_ranks(touched_nonmortar_nodes(pairs[pair].nonmortar.surface, pairs[pair].moments));
      std::string text;
      for (unsigned int q = 0; q < pairs.size(); ++q)
        {
          std::set<NodeIndex> nodes = touched_mortar_nodes(pairs[q].mortar.surface, pairs[q].moments);
          if (q != pair)
            nodes.merge(touched_nonmortar_nodes(pairs[q].nonmortar.surface, pairs[q].moments));
          nodes = of_all_ranks(nodes);
          if (std::any_of(own.begin(), own.end(),
                          [&](const NodeIndex node) { return nodes.count(node) > 0; }))
            text += (text.empty() ? "" : ", ") +
                    (q == pair ? std::string("its other side") : "pair \"" + pairs[q].name + "\"");
        }
      return text;
    }

    /// Whether the conditions leave a vertex of a contact surface no way to go.
    bool is_held(const ContactSurface &surface, const unsigned int v)
    {
      return surface.hanging[v].empty() &&
             (surface.vertex_fixed[v].all() ||
              project_free(surface.vertex_fixed[v], surface.mesh.vertex_normals[v]).norm() < .5);
    }

    /// This rank's faces of a pair of which both sides are held.
    std::vector<const FaceMoments *> held_faces(const ContactPair &pair, const PairCoupling &coupling)
    {
      const ContactSurface            &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      std::vector<const FaceMoments *> faces;
      for_lost_faces(pair, coupling, [&](const FaceMoments &m, const DroppedNode::Reason reason) {
        const auto &corners = non.faces[m.face].corners;
        if ((reason == DroppedNode::fixed || reason == DroppedNode::normal_fixed) &&
            std::all_of(corners.begin(), corners.end(),
                        [&](const unsigned int v) { return is_held(non, v); }) &&
            std::all_of(m.coupling.begin(), m.coupling.end(),
                        [&](const auto &entry) { return is_held(mor, entry.first); }))
          faces.push_back(&m);
      });
      return faces;
    }

    /// By how much prescribed displacements make the sides of a held face overlap, in the mean, and the
    /// largest of these displacements (lengths).
    struct HeldOverlap
    {
      double depth = 0., displacement = 0.;
    };

    HeldOverlap overlap_of(const FaceMoments &m, const ContactPair &pair, const ImportedField &prescribed)
    {
      const ContactSurface       &non     = pair.nonmortar.surface;
      const ContactSurface::Face &face    = non.faces[m.face];
      const auto                 &corners = face.corners;
      const auto                 &x       = non.mesh.vertices;
      HeldOverlap                 result;
      // The projected normals of held vertices say nothing: those of the face.
      Vector3 normal = cross_product_3d(x[corners[1]] - x[corners[0]], x[corners[2]] - x[corners[0]]), moved;
      normal /= normal.norm();
      for (unsigned int a = 0; a < face.n_corners; ++a)
        {
          for (unsigned int b = 0; b < 4; ++b)
            moved -= m.mass[4 * a + b] * prescribed(non.vertex_node[corners[b]]);
          for (const auto &[q, weights] : m.coupling)
            {
              const Vector3 &u = prescribed(pair.mortar.surface.vertex_node[q]);
              moved += weights[a] * u;
              result.displacement = std::max(result.displacement, u.norm());
            }
          result.displacement = std::max(result.displacement, prescribed(non.vertex_node[corners[a]]).norm());
        }
      double gap = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        gap += pair.prescribed_gap ? m.gap[a][0] : m.gap[a] * normal;
      // An overlap that is there at the beginning is not the conditions' fault.
      result.depth = -(std::max(gap, 0.) + moved * normal) / m.covered;
      return result;
    }

    void refuse_held_overlap(const CoupledPairs &coupled, const unsigned int p)
    {
      const ContactPair                     &pair  = coupled.pairs[p];
      const std::vector<const FaceMoments *> faces = held_faces(pair, coupled.couplings[p]);
      const MPI_Comm                         comm  = coupled.model.communicator();
      if (Utilities::MPI::sum(faces.size(), comm) == 0 || pair.is_tied)
        return;
      const ContactSurface  &non = pair.nonmortar.surface;
      std::vector<NodeIndex> nodes;
      for (const FaceMoments *m : faces)
        {
          for (const unsigned int v : non.faces[m->face].corners)
            nodes.push_back(non.vertex_node[v]);
          for (const auto &entry : m->coupling)
            nodes.push_back(pair.mortar.surface.vertex_node[entry.first]);
        }
      const ConstrainedSpace &space = coupled.constrained;
      const ImportedField     prescribed(space.partition,
                                         prescribed_displacement(space.nodal(), space.partition, space.dirichlet),
                                         std::move(nodes));
      struct Deepest
      {
        double       depth = 0., displacement = 0.;
        unsigned int face = numbers::invalid_unsigned_int;
      };
      Deepest here;
      for (const FaceMoments *m : faces)
        {
          const HeldOverlap overlap = overlap_of(*m, pair, prescribed);
          here.displacement         = std::max(here.displacement, overlap.displacement);
          if (overlap.depth > here.depth)
            {
              here.depth = overlap.depth;
              here.face  = m->face;
            }
        }
      Deepest worst;
      for (const Deepest &one : gather_lists(std::vector<Deepest>{here}, comm, Receivers::all))
        {
          worst.displacement = std::max(worst.displacement, one.displacement);
          if (one.depth > worst.depth || (one.depth == worst.depth && one.face < worst.face))
            {
              worst.depth = one.depth;
              worst.face  = one.face;
            }
        }
      if (worst.depth <= ContactRule().held_overlap * worst.displacement)
        return;
      const unsigned int where = non.faces[worst.face].corners[0];
      std::ostringstream text;
      text << "Pair " << pair.name << ": the displacements that are prescribed on \"" << pair.nonmortar.name
           << "\" and \"" << (pair.obstacle ? "the obstacle" : pair.mortar.name) << "\" make them overlap by "
           << worst.depth << " near (" << non.mesh.vertices[where]
           << "), and nothing can resist. Prescribe displacements elsewhere than on the contact surfaces "
              "(Body "
           << coupled.model.bodies().body_name(pair.nonmortar.body) << "/Dirichlet).";
      throw InputError(text.str());
    }
  } // namespace



  void refuse_lost_contact(const CoupledPairs &coupled)
  {
    for (unsigned int p = 0; p < coupled.pairs.size(); ++p)
      {
        const ContactPair &pair    = coupled.pairs[p];
        const MPI_Comm     comm    = coupled.model.communicator();
        const LostContact  lost    = lost_contact(pair, coupled.couplings[p], comm);
        const bool         is_void = coupled.couplings[p].n_rows_of_all == 0;
        const std::string  choice  = pair.obstacle ? "" : " or choose the other side as \"Nonmortar\",";
        if (is_void && !(lost.by_conditions > 0.) && !(lost.by_other_pairs > 0.))
          throw InputError("Pair " + pair.name + ": no node of \"" + pair.nonmortar.name +
                           "\" can carry a contact stress, because \"" + pair.mortar.name +
                           "\" covers next to nothing of the faces around it: they are too wide for what "
                           "they touch. Refine body " +
                           coupled.model.bodies().body_name(pair.nonmortar.body) +
                           " there (\"Initial levels\", \"Refinement/Regions\")," + choice +
                           " or remove the pair.");
        if (lost.by_other_pairs > ContactRule().lost_share * lost.covered ||
            (is_void && lost.by_other_pairs > lost.by_conditions))
          throw InputError(
              "Pair " + pair.name + ": " + percent_text(lost.by_other_pairs / lost.covered, 3) + " of \"" +
              pair.nonmortar.name + "\" can carry no contact stress, because the nodes belong to " +
              rivals_of(coupled.pairs, p, comm) +
              ", too. If two pairs are the same, remove one; else choose \"Nonmortar\" so that the common "
              "surface is the other (mortar) side in all of its pairs, take the common part out of one of "
              "them "
              "(\"First region\", \"Second region\"), or refine a body of one layer of cells, all nodes of "
              "which lie on its edges (\"Initial levels\").");
        if (is_void)
          throw InputError(
              "Pair " + pair.name + ": no node of \"" + pair.nonmortar.name +
              "\" can carry a contact stress, because their displacements are prescribed (Body " +
              coupled.model.bodies().body_name(pair.nonmortar.body) +
              "/Dirichlet or Rigid). Leave the surface free there," + choice + " or remove the pair.");
        refuse_held_overlap(coupled, p);
      }
  }



  void refuse_dense_coupling(const CoupledPairs &coupled)
  {
    // 27 blocks a node of a regular mesh.
    const double own = 27. * static_cast<double>(coupled.constrained.nodal().n_conforming_nodes());
    for (unsigned int p = 0; p < coupled.pairs.size(); ++p)
      {
        const ContactPair       &pair     = coupled.pairs[p];
        const InterfaceCoupling &coupling = coupled.couplings[p].coupling;
        double                   blocks = 0., columns = 0.;
        for (std::size_t row = 0; row < coupling.n_rows(); ++row)
          {
            const double n = static_cast<double>(coupling.end(row) - coupling.begin(row));
            blocks += n * n;
            columns = std::max(columns, n);
          }
        blocks  = Utilities::MPI::sum(blocks, coupled.model.communicator());
        columns = Utilities::MPI::max(columns, coupled.model.communicator());
        if (blocks <= ContactRule().few_dense_blocks || blocks <= ContactRule().dense_blocks * own)
          continue;
        std::ostringstream text;
        text << "Pair " << pair.name << ": the nonmortar surface \"" << pair.nonmortar.name
             << "\" is much coarser than the mortar surface \"" << pair.mortar.name << "\" (one node faces "
             << columns << " nodes): the matrix would need " << std::setprecision(2) << 72. * blocks / 1e9
             << " GB for the contact alone. Refine \"" << pair.nonmortar.name
             << "\" there (Refinement/Regions), or make the finer surface the nonmortar side "
                "(Pair/Nonmortar).";
        throw InputError(text.str());
      }
  }



  namespace
  {
    /// The extent of a body along a direction (length).
    double width_of(const unsigned int body, const Bodies &bodies, const NodalSpace &space,
                    const Vector3 &direction)
    {
      double low = std::numeric_limits<double>::max(), high = -low;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned && bodies.body_of_material(cell.material) == body)
          for (const NodeIndex node : space.nodes(cell))
            {
              const double x = direction * space.position(node);
              low            = std::min(low, x);
              high           = std::max(high, x);
            }
      const MPI_Comm comm = space.communicator();
      return Utilities::MPI::max(high, comm) - Utilities::MPI::min(low, comm);
    }
  } // namespace



  namespace
  {
    /// How far the true surface is from the middle of a triangle (length); zero where its shape is exact.
    double height_over_facet(const ContactSurface &surface, const std::size_t triangle)
    {
      if (!surface.true_shape.has_offsets() || !(surface.true_shape.doubt(surface.mesh, triangle) > 0.))
        return 0.;
      return surface.offset(triangle, {{1. / 3., 1. / 3., 1. / 3.}}).norm();
    }

    /// Collective. Calls f(vertex or point of the nonmortar surface, its normal, gap, heights of the surfaces
    /// over their facets) where surfaces face each other: at the corners of the overlay cells of this rank.
    template <typename F>
    void for_each_gap(const ContactPair &pair, const F &f)
    {
      const ContactSurface &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      const double          size = non.extent();
      if (pair.obstacle)
        {
          const std::vector<bool> faces = faces_of_pair(pair);
          for (std::size_t t = 0; t < non.mesh.triangles.size(); ++t)
            if (faces[non.triangle_face[t]])
              for (const unsigned int v : non.mesh.triangles[t])
                if (double gap;
                    pair.obstacle->gap(gap, non.mesh.vertices[v], non.mesh.vertex_normals[v], size))
                  f(non.mesh.vertices[v], non.mesh.vertex_normals[v], gap, 0.);
        }
      if (!pair.mapping)
        return;
      const SurfaceValues on_nonmortar(non, sharp_vertices(pair)), on_mortar(mor);
      for (const OverlayTriangle &cell : covered_overlay(pair))
        for (unsigned int c = 0; c < 3; ++c)
          {
            std::array<double, 3> corner = {{0., 0., 0.}};
            corner[c]                    = 1.;
            const Point<3> x             = on_nonmortar.point(cell.nonmortar_triangle, cell.nonmortar[c]);
            const Point<3> image         = on_mortar.point(cell.mortar_triangle, cell.mortar[c]);
            const Vector3  n             = on_nonmortar.normal(cell.nonmortar_triangle, cell.nonmortar[c]);
            const Vector3  other         = facet_normal(mor, cell.mortar_triangle);
            if (pair.prescribed_gap)
              f(x, n, pair.prescribed_gap(x), 0.);
            else if (may_touch(n, other))
              f(x, n, initial_gap(non, mor, cell, corner, x, image) * n,
                height_over_facet(non, cell.nonmortar_triangle) +
                    height_over_facet(mor, cell.mortar_triangle));
          }
    }
  } // namespace



  SmallestGap smallest_initial_gap(const ContactPair &pair, const MPI_Comm comm)
  {
    SmallestGap result;
    bool        overlaps = false;
    double      farthest = 0.;
    for_each_gap(pair, [&](const Point<3> &x, const Vector3 &n, const double gap, const double heights) {
      const double doubt = ContactRule().touching * heights;
      overlaps           = overlaps || -gap > doubt;
      farthest           = std::max(farthest, x.norm());
      if (gap < result.value)
        result = {gap, x, n, doubt, false, 0.};
    });
    const auto all =
        gather_values(std::make_tuple(result.value, result.place, result.normal, result.doubt), comm);
    // The same on all ranks, also where several of them have it.
    std::tie(result.value, result.place, result.normal, result.doubt) =
        *std::min_element(all.begin(), all.end(), [](const auto &one, const auto &two) {
          return std::get<0>(one) < std::get<0>(two);
        });
    result.overlaps = Utilities::MPI::max(static_cast<int>(overlaps), comm) != 0;
    result.rounding = 16. * std::numeric_limits<double>::epsilon() * Utilities::MPI::max(farthest, comm);
    return result;
  }



  void refuse_large_overlap(const CoupledPairs &coupled, const unsigned int p)
  {
    const ContactPair    &pair   = coupled.pairs[p];
    const PairDefinition &wanted = coupled.model.pairs()[p].definition;
    const Bodies         &bodies = coupled.model.bodies();
    const NodalSpace     &space  = coupled.constrained.nodal();
    // Weighted gaps may be far below all gaps where the surfaces bend within a face: what counts is the gap
    // itself.
    const SmallestGap gap = smallest_initial_gap(pair, space.communicator());
    if (!(gap.value < 0.))
      return;
    const double share = wanted.penetration == InitialPenetration::automatic ? ContactRule().small_overlap
                                                                             : ContactRule().overlap;
    for (const unsigned int body : {pair.nonmortar.body, pair.mortar.body})
      {
        if (body == numbers::invalid_unsigned_int)
          continue;
        const double width = width_of(body, bodies, space, gap.normal);
        if (-gap.value <= share * width)
          continue;
        std::ostringstream text;
        text << "Pair " << pair.name << ": \"" << pair.nonmortar.name << "\" and \"" << pair.mortar.name
             << "\" overlap by " << -gap.value << " at the beginning, most at (" << gap.place
             << "), and body " << bodies.body_name(body) << " is only " << width
             << " wide there. Check the units and the place of the bodies (Body/Mesh, Translation, "
                "Rotation), the "
                "boundaries of the pair (First, Second)"
             << (pair.obstacle ? ", the obstacle" : "")
             << (pair.prescribed_gap ? ", and \"Initial gap\"." : ".");
        if (pair.mapping)
          if (const std::string errors =
                  describe_errors(sum_reports(pair.mapping->report(), space.communicator()));
              !errors.empty())
            text << " The contact mapping has errors (" << errors
                 << "), and this may be one of them: then give only the faces that may touch as boundaries "
                    "of the pair.";
        if (-gap.value <= ContactRule().overlap * width)
          text << " If an interference fit is meant, write \"Initial penetration = resolve\".";
        throw InputError(text.str());
      }
  }
} // namespace Signorini

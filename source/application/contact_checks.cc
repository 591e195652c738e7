// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "replicated_field.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_checks.h>
#include <signorini/mortar/geometric_penetration.h>

#include <Eigen/Dense>

#include <iomanip>

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
      /// Initial overlap as a share of the narrowest extent of a body. Linear elasticity ends at a tenth.
      double overlap = .5;
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

    bool is_condition(const DroppedNode::Reason reason)
    {
      return reason == DroppedNode::fixed || reason == DroppedNode::normal_fixed;
    }

    /// Calls a function with (moments, reason) for all covered faces of which no node has a multiplier.
    template <typename Function>
    void for_lost_faces(const ContactPair &pair, const PairCoupling &coupling, const Function &function)
    {
      std::map<NodeIndex, DroppedNode::Reason> reasons;
      for (const DroppedNode &node : coupling.dropped)
        reasons[node.node] = node.reason;
      const auto           &rows    = coupling.coupling.rows;
      const ContactSurface &surface = pair.nonmortar.surface;
      for (const FaceMoments &m : pair.moments)
        if (m.covered > 0.)
          {
            std::set<NodeIndex> nodes;
            for (const unsigned int v : surface.faces[m.face].corners)
              if (surface.hanging[v].empty())
                nodes.insert(surface.vertex_node[v]);
              else
                for (const auto &parent : surface.hanging[v])
                  nodes.insert(surface.vertex_node[parent.first]);
            if (std::any_of(nodes.begin(), nodes.end(), [&](const NodeIndex node) {
                  return std::binary_search(rows.begin(), rows.end(), node);
                }))
              continue;
            DroppedNode::Reason reason = DroppedNode::fixed;
            for (const NodeIndex node : nodes)
              if (const auto it = reasons.find(node); it != reasons.end() && !is_condition(it->second))
                reason = it->second;
            function(m, reason);
          }
    }

    LostContact lost_contact(const ContactPair &pair, const PairCoupling &coupling)
    {
      LostContact result;
      result.covered = coupling.covered_area;
      for_lost_faces(pair, coupling, [&](const FaceMoments &m, const DroppedNode::Reason reason) {
        (reason == DroppedNode::other_pair ? result.by_other_pairs : result.by_conditions) += m.covered;
      });
      return result;
    }

    std::string percent(const double share)
    {
      std::ostringstream text;
      text << std::setprecision(3) << 100. * share << " %";
      return text.str();
    }
  } // namespace



  std::string reason_to_turn(const ContactPair &pair, const PairCoupling &coupling)
  {
    const LostContact lost = lost_contact(pair, coupling);
    if (!(lost.by_other_pairs > 1e-12 * lost.covered) &&
        !(lost.by_conditions > ContactRule().lost_share * lost.covered))
      return "";
    return percent((lost.by_other_pairs + lost.by_conditions) / lost.covered) + " of \"" +
           pair.nonmortar.name + "\" could carry no contact stress (" +
           (lost.by_other_pairs > lost.by_conditions ? "it is the nonmortar side of another pair, too"
                                                     : "its displacements are prescribed") +
           ")";
  }



  namespace
  {
    /// The other pairs that need nodes of a pair's nonmortar side.
    std::string rivals_of(const std::vector<ContactPair> &pairs, const unsigned int pair)
    {
      const std::set<NodeIndex> own =
          touched_nonmortar_nodes(pairs[pair].nonmortar.surface, pairs[pair].moments);
      std::string text;
      for (unsigned int q = 0; q < pairs.size(); ++q)
        {
          std::set<NodeIndex> nodes = touched_mortar_nodes(pairs[q].mortar.surface, pairs[q].moments);
          if (q != pair)
            nodes.merge(touched_nonmortar_nodes(pairs[q].nonmortar.surface, pairs[q].moments));
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

    /// The faces of a pair of which both sides are held.
    std::vector<const FaceMoments *> held_faces(const ContactPair &pair, const PairCoupling &coupling)
    {
      const ContactSurface            &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      std::vector<const FaceMoments *> faces;
      for_lost_faces(pair, coupling, [&](const FaceMoments &m, const DroppedNode::Reason reason) {
        const auto &corners = non.faces[m.face].corners;
        if (is_condition(reason) &&
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

    HeldOverlap overlap_of(const FaceMoments &m, const ContactPair &pair, const ReplicatedField &prescribed)
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
      if (faces.empty() || pair.is_tied)
        return;
      const ContactSurface  &non = pair.nonmortar.surface;
      std::vector<NodeIndex> nodes(non.vertex_node);
      nodes.insert(nodes.end(), pair.mortar.surface.vertex_node.begin(),
                   pair.mortar.surface.vertex_node.end());
      const ConstrainedSpace &space = coupled.constrained;
      const ReplicatedField   prescribed(
            space.partition, prescribed_displacement(space.nodal(), space.partition, space.dirichlet),
            std::move(nodes));
      HeldOverlap  worst;
      unsigned int where = 0;
      for (const FaceMoments *m : faces)
        {
          const HeldOverlap overlap = overlap_of(*m, pair, prescribed);
          worst.displacement        = std::max(worst.displacement, overlap.displacement);
          if (overlap.depth > worst.depth)
            {
              worst.depth = overlap.depth;
              where       = non.faces[m->face].corners[0];
            }
        }
      if (worst.depth <= ContactRule().held_overlap * worst.displacement)
        return;
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
        const LostContact  lost    = lost_contact(pair, coupled.couplings[p]);
        const bool         is_void = coupled.couplings[p].coupling.n_rows() == 0;
        const std::string  choice  = pair.obstacle ? "" : " or choose the other side as \"Nonmortar\",";
        if (lost.by_other_pairs > ContactRule().lost_share * lost.covered ||
            (is_void && lost.by_other_pairs > lost.by_conditions))
          throw InputError(
              "Pair " + pair.name + ": " + percent(lost.by_other_pairs / lost.covered) + " of \"" +
              pair.nonmortar.name + "\" can carry no contact stress, because the nodes belong to " +
              rivals_of(coupled.pairs, p) +
              ", too. If two pairs are the same, remove one; else choose \"Nonmortar\" so that the common "
              "surface is the other (mortar) side in all of its pairs, or take the common part out of one of "
              "them (\"First region\", \"Second region\").");
        if (is_void)
          throw InputError(
              "Pair " + pair.name + ": no node of \"" + pair.nonmortar.name +
              "\" can carry a contact stress, because their displacements are prescribed (Body " +
              coupled.model.bodies().body_name(pair.nonmortar.body) +
              "/Dirichlet). Leave the surface free there," + choice + " or remove the pair.");
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
    double width_of(const unsigned int body, const Bodies &bodies, const NodalSpace &space)
    {
      const MPI_Comm comm = space.communicator();
      // The extents along the principal axes of the nodes.
      std::set<NodeIndex> nodes;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned && bodies.body_of_material(cell.material) == body)
          nodes.insert(space.nodes(cell).begin(), space.nodes(cell).end());
      const double    n        = Utilities::MPI::sum(static_cast<double>(nodes.size()), comm);
      Eigen::Vector3d centre   = Eigen::Vector3d::Zero();
      const auto      position = [&](const NodeIndex node) {
        const Point<3> &x = space.position(node);
        return Eigen::Vector3d(x[0], x[1], x[2]);
      };
      for (const NodeIndex node : nodes)
        centre += position(node) / n;
      for (unsigned int c = 0; c < dim; ++c)
        centre[c] = Utilities::MPI::sum(centre[c], comm);
      Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
      for (const NodeIndex node : nodes)
        second += (position(node) - centre) * (position(node) - centre).transpose();
      for (unsigned int i = 0; i < 9; ++i)
        second.data()[i] = Utilities::MPI::sum(second.data()[i], comm);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(second);
      double                                               width = std::numeric_limits<double>::max();
      for (unsigned int i = 0; i < 3; ++i)
        {
          double low = std::numeric_limits<double>::max(), high = -low;
          for (const NodeIndex node : nodes)
            {
              const double x = eigen.eigenvectors().col(i).dot(position(node) - centre);
              low            = std::min(low, x);
              high           = std::max(high, x);
            }
          width = std::min(width, Utilities::MPI::max(high, comm) - Utilities::MPI::min(low, comm));
        }
      return width;
    }

    // Weighted gaps may be far below all gaps where the surfaces bend within a face: what counts is the gap
    // itself.
    double initial_overlap(const ContactPair &pair, const MPI_Comm comm)
    {
      const ContactSurface      &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      const std::vector<Vector3> at_rest(non.mesh.vertices.size()), mortar_at_rest(mor.mesh.vertices.size());
      const auto                 penetration =
          pair.obstacle ? sample_rigid_penetration(non, *pair.obstacle, at_rest, comm)
                                        : sample_geometric_penetration({non, mor, pair.mapping->overlay()}, at_rest,
                                                                       mortar_at_rest, pair.prescribed_gap, comm);
      return -penetration.min_initial_gap;
    }
  } // namespace



  void refuse_large_overlap(const CoupledPairs &coupled, const ContactPair &pair, const double overlap)
  {
    const Bodies     &bodies = coupled.model.bodies();
    const NodalSpace &space  = coupled.constrained.nodal();
    for (const unsigned int body : {pair.nonmortar.body, pair.mortar.body})
      if (body != numbers::invalid_unsigned_int)
        if (const double limit = ContactRule().overlap * width_of(body, bodies, space);
            overlap > limit && initial_overlap(pair, space.communicator()) > limit)
          {
            std::ostringstream text;
            text << "Pair " << pair.name << ": \"" << pair.nonmortar.name << "\" and \"" << pair.mortar.name
                 << "\" overlap by " << overlap << " at the beginning, and body " << bodies.body_name(body)
                 << " is only " << limit / ContactRule().overlap
                 << " wide. Check the units and the place of the bodies (Body/Mesh, "
                 << "Translation, Rotation), the boundaries of the pair (First, Second)"
                 << (pair.obstacle ? ", the obstacle" : "")
                 << (pair.prescribed_gap ? ", and \"Initial gap\"." : ".");
            throw InputError(text.str());
          }
  }
} // namespace Signorini

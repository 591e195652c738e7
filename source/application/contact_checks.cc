// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Pairs that cannot do what they are there for: contact that conditions or other pairs take away, overlaps as
// large as a body, nodes that are not on their shapes.

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/application/contact_problem.h>
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
      const auto &rows = coupling.coupling.rows;
      for (const FaceMoments &m : pair.moments)
        if (m.covered > 0.)
          {
            std::set<NodeIndex> nodes;
            for (const unsigned int v : pair.nonmortar.faces[m.face].corners)
              if (pair.nonmortar.hanging[v].empty())
                nodes.insert(pair.nonmortar.vertex_node[v]);
              else
                for (const auto &parent : pair.nonmortar.hanging[v])
                  nodes.insert(pair.nonmortar.vertex_node[parent.first]);
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



  bool ContactProblem::swap_sides(CycleResult &cycle)
  {
    Discretization           &d = discretization;
    std::vector<unsigned int> turned;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const PairDefinition &definition = pair_definitions[p];
        if (definition.has_obstacle || definition.parameters.nonmortar != "auto" || definition.is_swapped)
          continue;
        const LostContact lost = lost_contact(d.pairs[p], d.couplings[p]);
        if (lost.by_other_pairs > 1e-12 * lost.covered ||
            lost.by_conditions > ContactRule().lost_share * lost.covered)
          {
            turned.push_back(p);
            note("pair " + d.pairs[p].name + ": its sides are swapped, because " +
                 percent((lost.by_other_pairs + lost.by_conditions) / lost.covered) + " of \"" +
                 d.pairs[p].nonmortar_name + "\" could carry no contact stress (" +
                 (lost.by_other_pairs > lost.by_conditions ? "it is the nonmortar side of another pair, too"
                                                           : "its displacements are prescribed") +
                 ").");
          }
      }
    for (const unsigned int p : turned)
      {
        pair_definitions[p].is_swapped = true;
        d.pairs[p]                     = make_pair(pair_definitions[p], cycle);
      }
    return !turned.empty();
  }



  void ContactProblem::refuse_lost_contact() const
  {
    const Discretization &d = discretization;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair &pair    = d.pairs[p];
        const LostContact  lost    = lost_contact(pair, d.couplings[p]);
        const bool         is_void = d.couplings[p].coupling.n_rows() == 0;
        const std::string  choice  = pair.obstacle ? "" : " or choose the other side as \"Nonmortar\",";
        if (lost.by_other_pairs > ContactRule().lost_share * lost.covered ||
            (is_void && lost.by_other_pairs > lost.by_conditions))
          throw InputError(
              "Pair " + pair.name + ": " + percent(lost.by_other_pairs / lost.covered) + " of \"" +
              pair.nonmortar_name + "\" can carry no contact stress, because the nodes belong to " +
              rivals_of(p) +
              ", too. If two pairs are the same, remove one; else choose \"Nonmortar\" so that the common "
              "surface is the other (mortar) side in all of its pairs, or take the common part out of one of "
              "them (\"First region\", \"Second region\").");
        if (is_void)
          throw InputError(
              "Pair " + pair.name + ": no node of \"" + pair.nonmortar_name +
              "\" can carry a contact stress, because their displacements are prescribed (Body " +
              bodies.body_name(pair.nonmortar_body) + "/Dirichlet). Leave the surface free there," + choice +
              " or remove the pair.");
        refuse_held_overlap(p);
      }
  }



  std::string ContactProblem::rivals_of(const unsigned int pair) const
  {
    const Discretization     &d   = discretization;
    const std::set<NodeIndex> own = touched_nonmortar_nodes(d.pairs[pair].nonmortar, d.pairs[pair].moments);
    std::string               text;
    for (unsigned int q = 0; q < d.pairs.size(); ++q)
      {
        std::set<NodeIndex> nodes = touched_mortar_nodes(d.pairs[q].mortar, d.pairs[q].moments);
        if (q != pair)
          nodes.merge(touched_nonmortar_nodes(d.pairs[q].nonmortar, d.pairs[q].moments));
        if (std::any_of(own.begin(), own.end(), [&](const NodeIndex node) { return nodes.count(node) > 0; }))
          text += (text.empty() ? "" : ", ") +
                  (q == pair ? std::string("its other side") : "pair \"" + d.pairs[q].name + "\"");
      }
    return text;
  }



  void ContactProblem::refuse_dense_coupling() const
  {
    const Discretization &d = discretization;
    // 27 blocks a node of a regular mesh.
    const double own = 27. * static_cast<double>(d.space->n_conforming_nodes());
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const InterfaceCoupling &coupling = d.couplings[p].coupling;
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
        text << "Pair " << d.pairs[p].name << ": the nonmortar surface \"" << d.pairs[p].nonmortar_name
             << "\" is much coarser than the mortar surface \"" << d.pairs[p].mortar_name
             << "\" (one node faces " << columns << " nodes): the matrix would need " << std::setprecision(2)
             << 72. * blocks / 1e9 << " GB for the contact alone. Refine \"" << d.pairs[p].nonmortar_name
             << "\" there (Refinement/Regions), or make the finer surface the nonmortar side "
                "(Pair/Nonmortar).";
        throw InputError(text.str());
      }
  }



  void ContactProblem::refuse_held_overlap(const unsigned int p) const
  {
    const Discretization &d       = discretization;
    const ContactPair    &pair    = d.pairs[p];
    const auto            is_held = [](const ContactSurface &surface, const unsigned int v) {
      return surface.hanging[v].empty() &&
             (surface.vertex_fixed[v] == all_fixed ||
              project_free(surface.vertex_fixed[v], surface.mesh.vertex_normals[v]).norm() < .5);
    };
    // Faces of which both sides are held.
    std::vector<const FaceMoments *> faces;
    for_lost_faces(pair, d.couplings[p], [&](const FaceMoments &m, const DroppedNode::Reason reason) {
      const auto &corners = pair.nonmortar.faces[m.face].corners;
      if (is_condition(reason) &&
          std::all_of(corners.begin(), corners.end(),
                      [&](const unsigned int v) { return is_held(pair.nonmortar, v); }) &&
          std::all_of(m.coupling.begin(), m.coupling.end(),
                      [&](const auto &entry) { return is_held(pair.mortar, entry.first); }))
        faces.push_back(&m);
    });
    if (faces.empty() || pair_definitions[p].parameters.contact == "tied")
      return;
    std::vector<NodeIndex> nodes(pair.nonmortar.vertex_node);
    nodes.insert(nodes.end(), pair.mortar.vertex_node.begin(), pair.mortar.vertex_node.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    Vector prescribed;
    d.partition->reinit(prescribed);
    for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        prescribed.local_element(dim * i + c) =
            d.dirichlet.value[d.space->relevant().index_within_set(d.partition->to_global(i))][c];
    const std::vector<Vector3> values = replicate_values(*d.partition, prescribed, nodes);
    const auto                 value  = [&](const NodeIndex node) -> const Vector3                  &{
      return values[std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()];
    };
    double       overlap = 0., largest = 0.;
    unsigned int where = 0;
    for (const FaceMoments *m : faces)
      {
        const auto &corners = pair.nonmortar.faces[m->face].corners;
        Vector3     normal, moved;
        double      gap = 0.;
        for (unsigned int a = 0; a < pair.nonmortar.faces[m->face].n_corners; ++a)
          {
            // The projected normals of held vertices say nothing: those of the face.
            const auto &x = pair.nonmortar.mesh.vertices;
            normal += cross_product_3d(x[corners[1]] - x[corners[0]], x[corners[2]] - x[corners[0]]);
            for (unsigned int b = 0; b < 4; ++b)
              moved -= m->mass[4 * a + b] * value(pair.nonmortar.vertex_node[corners[b]]);
            for (const auto &[q, weights] : m->coupling)
              {
                const Vector3 &u = value(pair.mortar.vertex_node[q]);
                moved += weights[a] * u;
                largest = std::max(largest, u.norm());
              }
            largest = std::max(largest, value(pair.nonmortar.vertex_node[corners[a]]).norm());
          }
        normal /= normal.norm();
        for (unsigned int a = 0; a < 4; ++a)
          gap += pair.prescribed_gap ? m->gap[a][0] : m->gap[a] * normal;
        // An overlap that is there at the beginning is not the conditions' fault.
        if (const double depth = -(std::max(gap, 0.) + moved * normal) / m->covered; depth > overlap)
          {
            overlap = depth;
            where   = corners[0];
          }
      }
    if (overlap <= ContactRule().held_overlap * largest)
      return;
    std::ostringstream text;
    text << "Pair " << pair.name << ": the displacements that are prescribed on \"" << pair.nonmortar_name
         << "\" and \"" << (pair.obstacle ? "the obstacle" : pair.mortar_name) << "\" make them overlap by "
         << overlap << " near (" << pair.nonmortar.mesh.vertices[where]
         << "), and nothing can resist. Prescribe displacements elsewhere than on the contact surfaces (Body "
         << bodies.body_name(pair.nonmortar_body) << "/Dirichlet).";
    throw InputError(text.str());
  }



  double ContactProblem::width_of(const unsigned int body) const
  {
    // The extents along the principal axes of the nodes.
    const NodalSpace   &space = *discretization.space;
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
  double ContactProblem::initial_overlap(const ContactPair &pair) const
  {
    const std::vector<Vector3> at_rest(pair.nonmortar.mesh.vertices.size()),
        mortar_at_rest(pair.mortar.mesh.vertices.size());
    const auto penetration =
        pair.obstacle ? sample_rigid_penetration(pair.nonmortar, *pair.obstacle, at_rest, comm)
                      : sample_geometric_penetration({pair.nonmortar, pair.mortar, pair.mapping->overlay()},
                                                     at_rest, mortar_at_rest, pair.prescribed_gap, comm);
    return -penetration.min_initial_gap;
  }



  void ContactProblem::refuse_large_overlap(const unsigned int p, const double overlap) const
  {
    const ContactPair &pair = discretization.pairs[p];
    for (const unsigned int body : {pair.nonmortar_body, pair.mortar_body})
      if (body != numbers::invalid_unsigned_int)
        if (const double width = width_of(body);
            overlap > ContactRule().overlap * width && initial_overlap(pair) > ContactRule().overlap * width)
          {
            std::ostringstream text;
            text << "Pair " << pair.name << ": \"" << pair.nonmortar_name << "\" and \"" << pair.mortar_name
                 << "\" overlap by " << overlap << " at the beginning, and body " << bodies.body_name(body)
                 << " is only " << width << " wide. Check the units and the place of the bodies (Body/Mesh, "
                 << "Translation, Rotation), the boundaries of the pair (First, Second)"
                 << (pair.obstacle ? ", the obstacle" : "")
                 << (pair.prescribed_gap ? ", and \"Initial gap\"." : ".");
            throw InputError(text.str());
          }
  }



  void ContactProblem::note_movement()
  {
    const MovementReport &m = bodies.movement();
    for (const auto &[id, entry] : m.late)
      {
        std::string pairs;
        for (const PairDefinition &definition : pair_definitions)
          for (unsigned int i = 0; i < definition.n_sides(); ++i)
            if (bodies.boundary_ids(definition.body[i], definition.boundary[i]).count(id) > 0)
              pairs += (pairs.empty() ? "" : ", ") + definition.parameters.name;
        std::ostringstream text;
        text << std::setprecision(3) << (pairs.empty() ? "" : "warning: ") << bodies.boundary_name(id) << ": "
             << entry.first << " of the nodes that moved to its shape are not there yet, to keep cells from "
             << "degenerating (at most " << entry.second << " away; worst quality " << m.quality_before
             << " before moving, " << m.quality_after << " after).";
        if (!pairs.empty())
          text << " The gap of pair " << pairs
               << " is measured from the shape all the same, but the stiffness of the dented cells is not "
                  "that of "
               << "the body: use a better or finer start mesh at this boundary, or \"Snap boundary "
                  "vertices\".";
        note(text.str());
      }
  }
} // namespace Signorini

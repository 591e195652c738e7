// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/replicated_data.h>
#include <signorini/algebra/sent_lists.h>
#include <signorini/application/contact_model.h>
#include <signorini/application/unseen_penetration.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/output/final_words.h>
#include <signorini/surface/boundary_depth.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure number.
    struct UnseenRule
    {
      /// The share of a triangle that a mapping covers if it looks there: where edges meet edges it may cover
      /// slivers.
      double covered = .1;
    };

    /// A corner of a face, or a hanging vertex on its edge, after deformation.
    struct DeformedVertex
    {
      NodeIndex node = invalid_node;
      Point<3>  place;
    };

    /// A face of the boundary of a part, as it travels.
    struct DeformedFace
    {
      /// What follows the last vertex has no node.
      std::array<DeformedVertex, 8> vertices;
      unsigned int                  part = 0, n_vertices = 0;

      Point<3> centre() const
      {
        Point<3> sum;
        for (unsigned int i = 0; i < n_vertices; ++i)
          sum += vertices[i].place;
        return sum / static_cast<double>(n_vertices);
      }

      double width() const
      {
        const Point<3> middle = centre();
        double         result = 0.;
        for (unsigned int i = 0; i < n_vertices; ++i)
          result = std::max(result, 2. * middle.distance(vertices[i].place));
        return result;
      }
    };

    /// What a rank has of the boundary of a part.
    struct PartBox
    {
      unsigned int part = 0, rank = 0;
      BoxTree::Box box;
    };

    bool overlap(const BoxTree::Box &a, const BoxTree::Box &b)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (a.high[c] < b.low[c] || b.high[c] < a.low[c])
          return false;
      return true;
    }

    BoxTree::Box grown(BoxTree::Box box, const double by)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          box.low[c] -= by;
          box.high[c] += by;
        }
      return box;
    }

    BoxTree::Box box_of(const DeformedFace &face)
    {
      BoxTree::Box box = {face.vertices[0].place, face.vertices[0].place};
      for (unsigned int i = 1; i < face.n_vertices; ++i)
        box.include(face.vertices[i].place);
      return box;
    }

    /// A node that is looked at by a pair, and the part that this sees, or a node in another part.
    struct NodeAndPart
    {
      NodeIndex    node;
      unsigned int part;

      bool operator<(const NodeAndPart &other) const
      {
        return std::tie(node, part) < std::tie(other.node, other.part);
      }
    };

    struct FoundNode
    {
      NodeAndPart  where;
      unsigned int own_part;
      double       depth;
      Point<3>     place;
    };

    class Search
    {
    public:
      Search(const ContactModel &model, const Discretization &d, const Vector &displacement)
        : bodies(model.bodies())
        , d(d)
        , comm(d.nodal().communicator())
      {
        collect_faces(displacement);
      }

      std::vector<UnseenPenetration> find() const
      {
        ListsByRank<FoundNode> found;
        for (const FoundNode &node : nodes_in_other_parts())
          found[d.partition().owner(node.where.node)].push_back(node);
        const std::set<NodeAndPart>    seen = nodes_of_pairs();
        std::vector<UnseenPenetration> mine;
        for (const auto &[rank, nodes] : send_lists(found, comm))
          for (const FoundNode &node : nodes)
            if (seen.count(node.where) == 0 && !may_overlap(node.own_part, node.where.part))
              mine.push_back({node.own_part, node.where.part, node.depth, node.place, false});
        return deepest(std::move(mine));
      }

    private:
      void collect_faces(const Vector &displacement)
      {
        const NodalSpace      &space = d.nodal();
        std::vector<NodeIndex> nodes;
        for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
          {
            const NodalSpace::Cell &cell = space.cells()[face.cell];
            if (!cell.is_owned)
              continue;
            DeformedFace deformed;
            deformed.part      = bodies.part_of_material(cell.material);
            const auto corners = CellShape::face(cell.n_vertices, face.face);
            for (unsigned int i = 0; i < corners.size(); ++i)
              for (const NodeIndex node : {space.nodes(cell)[corners[i]], face.hanging[i]})
                if (node != invalid_node)
                  {
                    deformed.vertices[deformed.n_vertices++].node = node;
                    nodes.push_back(node);
                  }
            faces.push_back(deformed);
          }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        reaches.assign(bodies.n_parts(), 0.);
        widest                            = reaches;
        const std::vector<Vector3> values = import_values(d.partition(), displacement, nodes);
        for (DeformedFace &face : faces)
          {
            double &reach = reaches[face.part];
            for (unsigned int i = 0; i < face.n_vertices; ++i)
              {
                DeformedVertex &vertex = face.vertices[i];
                const Vector3  &u =
                    values[std::lower_bound(nodes.begin(), nodes.end(), vertex.node) - nodes.begin()];
                vertex.place = space.position(vertex.node) + u;
                reach        = std::max(reach, 2. * u.norm());
              }
            widest[face.part] = std::max(widest[face.part], face.width());
          }
        Utilities::MPI::max(widest, comm, widest);
        Utilities::MPI::max(reaches, comm, reaches);
        for (unsigned int part = 0; part < reaches.size(); ++part)
          reaches[part] += widest[part];
      }

      /// How deep two bodies may come into each other by what both do (length).
      double reach(const unsigned int part, const unsigned int other) const
      {
        return reaches[part] + reaches[other];
      }

      std::vector<PartBox> own_boxes() const
      {
        std::map<unsigned int, BoxTree::Box> boxes;
        for (const DeformedFace &face : faces)
          for (unsigned int i = 0; i < face.n_vertices; ++i)
            boxes.insert({face.part, box_of(face)}).first->second.include(face.vertices[i].place);
        std::vector<PartBox> result;
        for (const auto &[part, box] : boxes)
          result.push_back({part, Utilities::MPI::this_mpi_process(comm), box});
        return result;
      }

      /// Of all ranks, those near what this rank has of other parts.
      std::vector<DeformedFace> faces_nearby() const
      {
        const std::vector<PartBox> own = own_boxes();
        ListsByRank<PartBox>       boxes;
        for (const PartBox &one : gather_lists(own, comm, Receivers::all))
          {
            if (std::any_of(own.begin(), own.end(), [&](const PartBox &mine) {
                  return mine.part != one.part &&
                         overlap(mine.box, grown(one.box, reach(mine.part, one.part)));
                }))
              boxes[one.rank].push_back(one);
          }
        ListsByRank<DeformedFace> lists;
        for (const auto &entry : boxes)
          for (const DeformedFace &face : faces)
            if (std::any_of(entry.second.begin(), entry.second.end(), [&](const PartBox &one) {
                  return one.part != face.part &&
                         overlap(grown(one.box, reach(face.part, one.part) + widest[face.part]),
                                 box_of(face));
                }))
              lists[entry.first].push_back(face);
        std::vector<DeformedFace> result;
        for (const auto &[rank, list] : send_lists(lists, comm))
          result.insert(result.end(), list.begin(), list.end());
        return result;
      }

      std::vector<FoundNode> nodes_in_other_parts() const
      {
        std::map<unsigned int, std::vector<DeformedFace>> by_part;
        for (const DeformedFace &face : faces_nearby())
          by_part[face.part].push_back(face);
        std::vector<FoundNode> result;
        for (const auto &[part, boundary] : by_part)
          {
            BoxTree::Box box = box_of(boundary[0]);
            for (const DeformedFace &face : boundary)
              for (unsigned int i = 0; i < face.n_vertices; ++i)
                box.include(face.vertices[i].place);
            const BoundaryDepth depth(triangulate(boundary), faces_of_triangles(boundary));
            std::set<NodeIndex> done;
            for (const DeformedFace &face : faces)
              for (unsigned int i = 0; i < face.n_vertices; ++i)
                {
                  const DeformedVertex &vertex = face.vertices[i];
                  const double          far    = reach(part, face.part);
                  if (face.part == part || !overlap(grown(box, far), {vertex.place, vertex.place}) ||
                      !done.insert(vertex.node).second)
                    continue;
                  if (const double inside = depth(vertex.place, far); inside > 0.)
                    result.push_back(
                        {{vertex.node, part}, face.part, inside, d.nodal().position(vertex.node)});
                }
          }
        return result;
      }

      /// Fans around the centres of faces that are no triangles: on neighbours they fit.
      static SurfaceMesh triangulate(const std::vector<DeformedFace> &boundary)
      {
        SurfaceMesh                       mesh;
        std::map<NodeIndex, unsigned int> numbers;
        for (const DeformedFace &face : boundary)
          {
            std::array<unsigned int, 8> corners;
            for (unsigned int i = 0; i < face.n_vertices; ++i)
              {
                const auto [entry, is_new] =
                    numbers.insert({face.vertices[i].node, static_cast<unsigned int>(mesh.vertices.size())});
                if (is_new)
                  mesh.vertices.push_back(face.vertices[i].place);
                corners[i] = entry->second;
              }
            if (face.n_vertices == 3)
              mesh.triangles.push_back({{corners[0], corners[1], corners[2]}});
            else
              {
                const auto middle = static_cast<unsigned int>(mesh.vertices.size());
                mesh.vertices.push_back(face.centre());
                for (unsigned int i = 0; i < face.n_vertices; ++i)
                  mesh.triangles.push_back({{corners[i], corners[(i + 1) % face.n_vertices], middle}});
              }
          }
        return mesh;
      }

      static std::vector<unsigned int> faces_of_triangles(const std::vector<DeformedFace> &boundary)
      {
        std::vector<unsigned int> result;
        for (unsigned int f = 0; f < boundary.size(); ++f)
          result.insert(result.end(), boundary[f].n_vertices == 3 ? 1 : boundary[f].n_vertices, f);
        return result;
      }

      unsigned int part_of(const ContactSurface &surface, const unsigned int triangle) const
      {
        return bodies.part_of_material(surface.faces[surface.triangle_face[triangle]].material);
      }

      /// Those that this rank owns at triangles that a mapping covers, with the part on the other side. What
      /// several ranks cover of a mortar triangle counts together.
      std::set<NodeAndPart> nodes_of_pairs() const
      {
        Coverage coverage;
        for (const ContactPair &pair : d.pairs)
          if (pair.mapping)
            {
              const ContactSurface &nonmortar = pair.nonmortar.surface, &mortar = pair.mortar.surface;
              for (const OverlayTriangle &cell : pair.mapping->overlay())
                {
                  if (!pair.prescribed_gap && !may_touch(facet_normal(nonmortar, cell.nonmortar_triangle),
                                                         facet_normal(mortar, cell.mortar_triangle)))
                    continue;
                  add(coverage, nonmortar, cell.nonmortar_triangle, part_of(mortar, cell.mortar_triangle),
                      share(cell.nonmortar));
                  add(coverage, mortar, cell.mortar_triangle, part_of(nonmortar, cell.nonmortar_triangle),
                      share(cell.mortar));
                }
            }
        ListsByRank<CoveredShare> lists;
        for (const auto &[key, covered] : coverage)
          for (const NodeIndex node : std::get<0>(key))
            lists[d.partition().owner(node)].push_back({std::get<0>(key), std::get<1>(key), covered});
        Coverage sums;
        for (const auto &[rank, list] : send_lists(lists, comm))
          {
            // A triangle comes once for each of its nodes that this rank owns.
            Coverage of_rank;
            for (const CoveredShare &one : list)
              of_rank[{one.triangle, one.part}] = one.share;
            for (const auto &[key, covered] : of_rank)
              sums[key] += covered;
          }
        std::set<NodeAndPart> result;
        for (const auto &[key, covered] : sums)
          if (covered > UnseenRule().covered)
            for (const NodeIndex node : std::get<0>(key))
              result.insert({node, std::get<1>(key)});
        return result;
      }

      /// By the sorted nodes of a triangle and the part that it sees.
      using Triangle = std::array<NodeIndex, 3>;
      using Coverage = std::map<std::pair<Triangle, unsigned int>, double>;

      struct CoveredShare
      {
        Triangle     triangle;
        unsigned int part;
        double       share;
      };

      static void add(Coverage &coverage, const ContactSurface &surface, const unsigned int triangle,
                      const unsigned int part, const double covered)
      {
        Triangle nodes;
        for (unsigned int i = 0; i < 3; ++i)
          nodes[i] = surface.vertex_node[surface.mesh.triangles[triangle][i]];
        std::sort(nodes.begin(), nodes.end());
        coverage[{nodes, part}] += covered;
      }

      /// Of a polygon in barycentric coordinates, in its triangle.
      static double share(const std::array<std::array<double, 3>, 3> &corners)
      {
        const auto &[a, b, c] = corners;
        return std::abs((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
      }

      /// Whether a pair glues two parts together, or has a gap that is not that of their places: they may lie
      /// in each other.
      bool may_overlap(const unsigned int part, const unsigned int other) const
      {
        return have_pair(part, other, [](const ContactPair &pair) {
          return pair.is_tied || static_cast<bool>(pair.prescribed_gap);
        });
      }

      /// Whether a pair of some kind couples two parts of bodies, of which each may have several.
      template <typename Kind>
      bool have_pair(const unsigned int part, const unsigned int other, const Kind &kind) const
      {
        const unsigned int a = bodies.part(part).body, b = bodies.part(other).body;
        return std::any_of(d.pairs.begin(), d.pairs.end(), [&](const ContactPair &pair) {
          return kind(pair) && std::minmax(pair.nonmortar.body, pair.mortar.body) == std::minmax(a, b);
        });
      }

      std::vector<UnseenPenetration> deepest(std::vector<UnseenPenetration> mine) const
      {
        const auto keep = [](std::vector<UnseenPenetration> &list) {
          const auto parts = [](const UnseenPenetration &one) { return std::minmax(one.part, one.other); };
          std::sort(list.begin(), list.end(), [&](const UnseenPenetration &a, const UnseenPenetration &b) {
            const auto pa = std::minmax(a.part, a.other), pb = std::minmax(b.part, b.other);
            return std::tie(pa.first, pa.second, b.depth, a.place[0], a.place[1], a.place[2]) <
                   std::tie(pb.first, pb.second, a.depth, b.place[0], b.place[1], b.place[2]);
          });
          list.erase(std::unique(list.begin(), list.end(),
                                 [&](const UnseenPenetration &a, const UnseenPenetration &b) {
                                   return parts(a) == parts(b);
                                 }),
                     list.end());
        };
        keep(mine);
        std::vector<UnseenPenetration> all = gather_lists(std::move(mine), comm, Receivers::all);
        keep(all);
        for (UnseenPenetration &one : all)
          one.has_pair = have_pair(one.part, one.other, [](const ContactPair &) { return true; });
        return all;
      }

      const Bodies             &bodies;
      const Discretization     &d;
      const MPI_Comm            comm;
      std::vector<DeformedFace> faces;
      /// By part: how far its nodes move and its faces are wide, at most; how wide these are (lengths).
      std::vector<double> reaches, widest;
    };
  } // namespace



  std::vector<UnseenPenetration> find_unseen_penetrations(const ContactModel   &model,
                                                          const Discretization &discretization,
                                                          const Vector         &displacement)
  {
    if (model.bodies().n_parts() < 2)
      return {};
    return Search(model, discretization, displacement).find();
  }



  std::string describe_unseen(const ContactModel &model, const UnseenPenetration &one)
  {
    std::ostringstream text;
    text << std::setprecision(3) << model.bodies().part_name(one.part) << " lies " << one.depth << " deep in "
         << model.bodies().part_name(one.other) << " at " << place_text(one.place)
         << (one.has_pair ? ", where their pair does not look: are there faces that do not belong to it, or "
                            "edges that meet edges? Give these faces to it or to another pair; "
                            "where an edge meets a face, choose the other side as \"Nonmortar\"."
                          : ", and no contact pair keeps them apart.");
    return text.str();
  }
} // namespace Signorini

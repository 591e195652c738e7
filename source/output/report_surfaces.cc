// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/output/json_writer.h>
#include <signorini/output/report_surfaces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

    bool is_root(const MPI_Comm communicator)
    {
      return Utilities::MPI::this_mpi_process(communicator) == 0;
    }

    /// A boundary face of a body as it travels.
    struct PackedFace
    {
      std::uint64_t      coarse_cell, path;
      unsigned int       face, body, n_corners;
      types::boundary_id id;
      NodeIndex          nodes[4];
      double             points[4][3];

      bool operator<(const PackedFace &other) const
      {
        return std::tie(coarse_cell, path, face) < std::tie(other.coarse_cell, other.path, other.face);
      }
    };

    /// On rank 0, in an order that knows no ranks.
    std::vector<PackedFace> gather_faces(const NodalSpace &space, const Bodies &bodies)
    {
      std::vector<PackedFace> mine;
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (const NodalSpace::Cell &cell = space.cells()[face.cell]; cell.is_owned)
          {
            const auto nodes   = space.nodes(cell);
            const auto corners = CellShape::face(cell.n_vertices, face.face);
            PackedFace packed  = {};
            packed.coarse_cell = cell.coarse_cell;
            packed.path        = cell.path;
            packed.face        = face.face;
            packed.body        = bodies.body_of_material(cell.material);
            packed.n_corners   = static_cast<unsigned int>(corners.size());
            packed.id          = face.id;
            for (unsigned int v = 0; v < corners.size(); ++v)
              {
                packed.nodes[v]   = nodes[corners[v]];
                const Point<3> &p = space.position(packed.nodes[v]);
                std::copy_n(&p[0], 3, packed.points[v]);
              }
            mine.push_back(packed);
          }
      std::vector<PackedFace> all = gather_lists(std::move(mine), space.communicator(), Receivers::rank_zero);
      std::sort(all.begin(), all.end());
      return all;
    }

    /// Which faces of bodies belong to contact surfaces, which may be parts of boundaries.
    class ContactFaces
    {
    public:
      ContactFaces(const std::vector<ReportSide> &sides, const std::vector<ContactSurface> &surfaces)
      {
        for (std::size_t s = 0; s < sides.size(); ++s)
          members.emplace_back(sides[s].ids, std::unordered_set<NodeIndex>(surfaces[s].vertex_node.begin(),
                                                                           surfaces[s].vertex_node.end()));
      }

      bool contain(const PackedFace &face) const
      {
        return std::any_of(members.begin(), members.end(), [&](const auto &member) {
          return member.first.count(face.id) > 0 &&
                 std::all_of(face.nodes, face.nodes + face.n_corners,
                             [&](const NodeIndex node) { return member.second.count(node) > 0; });
        });
      }

    private:
      std::vector<std::pair<std::set<types::boundary_id>, std::unordered_set<NodeIndex>>> members;
    };

    /// The triangles of a contact surface; two triangles of one face are halves of it.
    ReportMesh mesh_of(const ContactSurface &surface)
    {
      ReportMesh mesh;
      mesh.vertices    = surface.mesh.vertices;
      const auto &face = surface.triangle_face;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          auto       t         = surface.mesh.triangles[i];
          const auto is_mate   = [&](const std::size_t j) { return j < face.size() && face[j] == face[i]; };
          const bool is_first  = is_mate(i + 1) && !is_mate(i - 1) && !is_mate(i + 2),
                     is_second = is_mate(i - 1) && !is_mate(i + 1) && !is_mate(i - 2);
          if (is_first || is_second)
            {
              // The corner that the other triangle has not comes second.
              const auto &other = surface.mesh.triangles[is_first ? i + 1 : i - 1];
              while (std::find(other.begin(), other.end(), t[1]) != other.end())
                std::rotate(t.begin(), t.begin() + 1, t.end());
            }
          mesh.triangles.push_back(t);
          mesh.kinds.push_back(is_first || is_second ? ReportMesh::half : 0);
        }
      mesh.sort_by_kind();
      return mesh;
    }

    /// How many of n triangles a surface gets; what is small stays as it is.
    std::size_t share_of(const std::size_t part, const std::size_t whole, const std::size_t n)
    {
      constexpr std::size_t few = 100;
      if (whole <= n)
        return part;
      return std::max(static_cast<std::size_t>(static_cast<double>(part) / whole * n), std::min(part, few));
    }

    void write_drawn(JsonWriter &json, const ReportMesh &mesh, const std::size_t n_triangles)
    {
      json.number("vertices", mesh.vertices.size());
      json.number("triangles", mesh.triangles.size());
      json.number("triangles_before", n_triangles);
      json.begin('[', "kinds");
      for (unsigned int kind = 0; kind < 4; ++kind)
        json.number("", std::count(mesh.kinds.begin(), mesh.kinds.end(), kind));
      json.end(']');
    }

    void write_mesh(ReportBlocks &blocks, const std::string &id, const ReportMesh &mesh)
    {
      std::vector<float>        points;
      std::vector<unsigned int> corners;
      for (const Point<3> &p : mesh.vertices)
        for (unsigned int c = 0; c < 3; ++c)
          points.push_back(static_cast<float>(p[c]));
      for (const auto &t : mesh.triangles)
        corners.insert(corners.end(), t.begin(), t.end());
      blocks.array(id + "-points", points);
      blocks.array(id + "-triangles", corners);
    }

    /// Values at nodes (sorted, on all ranks), on rank 0 in their order.
    std::vector<double> gather_values(const NodalSpace &space, const OutputField &field,
                                      const std::vector<NodeIndex> &nodes)
    {
      // Ranks own one range after the other.
      std::vector<double> mine;
      for (const NodeIndex node : nodes)
        if (space.owned().is_element(node))
          {
            const std::size_t i = space.relevant().index_within_set(node);
            for (unsigned int c = 0; c < field.n_components; ++c)
              mine.push_back(field.values[field.n_components * i + c]);
          }
      return gather_lists(std::move(mine), space.communicator(), Receivers::rank_zero);
    }

    /// A value that a rank knows at a vertex of a contact surface. Those at corners of faces are better than
    /// those at hanging vertices on their edges.
    struct VertexValue
    {
      unsigned int vertex, is_on_edge, rank;
      double       values[3];

      bool operator<(const VertexValue &other) const
      {
        return std::tie(vertex, is_on_edge, rank) < std::tie(other.vertex, other.is_on_edge, other.rank);
      }
    };

    /// Values at the vertices of a surface, on rank 0; `nothing` where no rank has one.
    std::vector<double> gather_values(const ContactSurface &surface, const OutputField &field,
                                      const MPI_Comm comm)
    {
      const unsigned int       rank = Utilities::MPI::this_mpi_process(comm), n = field.n_components;
      std::vector<VertexValue> mine;
      const auto               add = [&](const unsigned int vertex, const unsigned int is_on_edge) {
        VertexValue value = {surface.number_of_vertex(vertex), is_on_edge, rank, {}};
        std::copy_n(field.values.begin() + n * vertex, n, value.values);
        mine.push_back(value);
      };
      for (const ContactSurface::Face &face : surface.faces)
        if (face.worker == rank)
          for (unsigned int v = 0; v < face.n_corners; ++v)
            add(face.corners[v], 0);
      for (std::size_t i = 0; i < surface.triangle_face.size(); ++i)
        if (surface.faces[surface.triangle_face[i]].worker == rank)
          for (const unsigned int vertex : surface.mesh.triangles[i])
            add(vertex, 1);
      std::sort(mine.begin(), mine.end());
      mine.erase(std::unique(mine.begin(), mine.end(),
                             [](const auto &a, const auto &b) { return a.vertex == b.vertex; }),
                 mine.end());
      std::vector<VertexValue> all = gather_lists(std::move(mine), comm, Receivers::rank_zero);
      std::sort(all.rbegin(), all.rend());
      std::vector<double> result(is_root(comm) ? n * surface.n_vertices_of_whole() : 0, nothing);
      for (const VertexValue &value : all)
        std::copy_n(value.values, n, result.begin() + n * value.vertex);
      return result;
    }

    std::vector<double> select(const std::vector<double> &values, const unsigned int n_components,
                               const std::vector<unsigned int> &places)
    {
      std::vector<double> result;
      result.reserve(n_components * places.size());
      for (const unsigned int place : places)
        for (unsigned int c = 0; c < n_components; ++c)
          result.push_back(values[n_components * place + c]);
      return result;
    }

    /// Writes a field and, as an entry of the open object, its range.
    void write_field(ReportBlocks &blocks, JsonWriter &json, const std::string &id, const std::string &name,
                     const std::vector<double> &values)
    {
      std::string key = name;
      std::replace(key.begin(), key.end(), ' ', '_');
      const auto [low, high] = blocks.rounded_array(id + "-" + key, values);
      json.begin('[', key);
      json.number("", low);
      json.number("", high);
      json.end(']');
    }
  } // namespace



  ReportSurfaces::ReportSurfaces(const NodalSpace &space, const Bodies &bodies,
                                 const std::vector<ReportSide> &sides, const unsigned int n_states,
                                 const ReportRule &rule)
    : sides(sides)
  {
    const std::size_t n_triangles = rule.n_triangles(n_states);
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      body_names.push_back(bodies.body_name(b));
    std::vector<ContactSurface> whole_sides;
    for (const ReportSide &side : sides)
      whole_sides.push_back(join_pieces(*side.surface, space.communicator(), Receivers::rank_zero));
    draw_sides(whole_sides, n_triangles / 4);
    draw_bodies(space, bodies, whole_sides, n_triangles);
    for (ReportSide &side : this->sides)
      side.surface = nullptr;
  }



  void ReportSurfaces::draw_sides(const std::vector<ContactSurface> &whole_sides,
                                  const std::size_t                  n_triangles)
  {
    std::size_t n = 0;
    for (const ContactSurface &side : whole_sides)
      n += side.mesh.triangles.size();
    for (const ContactSurface &side : whole_sides)
      {
        Drawn drawn{mesh_of(side), {}, side.mesh.triangles.size()};
        drawn.source = thin(drawn.mesh, share_of(drawn.n_triangles, n, n_triangles));
        if (drawn.source.empty())
          {
            drawn.source.resize(drawn.mesh.vertices.size());
            std::iota(drawn.source.begin(), drawn.source.end(), 0);
          }
        drawn_sides.push_back(std::move(drawn));
      }
  }



  namespace
  {
    /// The boundary of a body before it is thinned: by vertex its node, and whether it belongs to a contact
    /// surface.
    class BodySurface
    {
    public:
      void add(const PackedFace &face, const bool is_in_contact)
      {
        std::array<unsigned int, 4> corners = {};
        for (unsigned int v = 0; v < face.n_corners; ++v)
          {
            const auto [entry, is_new] =
                number.emplace(face.nodes[v], static_cast<unsigned int>(nodes.size()));
            corners[v] = entry->second;
            if (is_new)
              {
                mesh.vertices.emplace_back(face.points[v][0], face.points[v][1], face.points[v][2]);
                nodes.push_back(face.nodes[v]);
                pinned.push_back(false);
              }
            pinned[corners[v]] = pinned[corners[v]] || is_in_contact;
          }
        mesh.add_face(corners, face.n_corners, is_in_contact);
      }

      void thin(const std::size_t n_triangles)
      {
        std::vector<NodeIndex> left;
        const auto             kept = Signorini::thin(mesh, n_triangles, pinned);
        for (const unsigned int v : kept)
          left.push_back(nodes[v]);
        if (!kept.empty())
          nodes.swap(left);
        mesh.sort_by_kind();
      }

      ReportMesh             mesh;
      std::vector<NodeIndex> nodes;

    private:
      std::vector<bool>                           pinned;
      std::unordered_map<NodeIndex, unsigned int> number;
    };
  } // namespace



  void ReportSurfaces::draw_bodies(const NodalSpace &space, const Bodies &bodies,
                                   const std::vector<ContactSurface> &whole_sides,
                                   const std::size_t                  n_triangles)
  {
    const ContactFaces       contact(sides, whole_sides);
    std::vector<BodySurface> surfaces(bodies.n_bodies());
    for (const PackedFace &face : gather_faces(space, bodies))
      surfaces[face.body].add(face, contact.contain(face));
    std::size_t n = 0;
    for (const BodySurface &surface : surfaces)
      n += surface.mesh.triangles.size();
    for (BodySurface &surface : surfaces)
      {
        const std::size_t n_before = surface.mesh.triangles.size();
        surface.thin(share_of(n_before, n, n_triangles));
        drawn_bodies.push_back({std::move(surface.mesh), {}, n_before});
        nodes.insert(nodes.end(), surface.nodes.begin(), surface.nodes.end());
      }
    std::sort(nodes.begin(), nodes.end());
    for (std::size_t b = 0; b < surfaces.size(); ++b)
      for (const NodeIndex node : surfaces[b].nodes)
        drawn_bodies[b].source.push_back(
            static_cast<unsigned int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()));
    nodes = broadcast_value(nodes, space.communicator());
  }



  void ReportSurfaces::write_scene(std::ostream &out) const
  {
    JsonWriter json(out);
    json.begin('{');
    json.begin('[', "bodies");
    for (std::size_t b = 0; b < drawn_bodies.size(); ++b)
      {
        json.begin('{');
        json.text("name", body_names[b]);
        write_drawn(json, drawn_bodies[b].mesh, drawn_bodies[b].n_triangles);
        json.end('}');
      }
    json.end(']');
    json.begin('[', "sides");
    for (std::size_t s = 0; s < sides.size(); ++s)
      {
        json.begin('{');
        json.number("pair", sides[s].pair);
        json.boolean("is_mortar", sides[s].is_mortar);
        json.text("name", sides[s].name);
        json.number("body", sides[s].body);
        write_drawn(json, drawn_sides[s].mesh, drawn_sides[s].n_triangles);
        json.end('}');
      }
    json.end(']');
    json.end('}');
    out << '\n';
  }



  void ReportSurfaces::write_geometry(ReportBlocks &blocks) const
  {
    blocks.json("scene", [&](std::ostream &out) { write_scene(out); });
    for (std::size_t b = 0; b < drawn_bodies.size(); ++b)
      write_mesh(blocks, "body-" + std::to_string(b), drawn_bodies[b].mesh);
    for (std::size_t s = 0; s < sides.size(); ++s)
      write_mesh(blocks, "side-" + std::to_string(s), drawn_sides[s].mesh);
  }



  void ReportSurfaces::write_state(ReportBlocks *const blocks, const ReportState &state,
                                   const NodalSpace &space, const std::vector<OutputField> &body_fields,
                                   const std::vector<ReportSide> &present) const
  {
    const std::string  id = "state-" + std::to_string(state.number);
    std::ostringstream text;
    JsonWriter         json(text);
    const auto         write = [&](const std::string &place, const OutputField &field,
                           const std::vector<double> &values, const Drawn &drawn) {
      if (blocks != nullptr)
        write_field(*blocks, json, id + place, field.name, select(values, field.n_components, drawn.source));
    };
    std::vector<std::vector<double>> of_bodies;
    for (const OutputField &field : body_fields)
      of_bodies.push_back(gather_values(space, field, nodes));
    json.begin('{');
    json.number("time", state.time);
    json.begin('[', "bodies");
    for (std::size_t b = 0; b < drawn_bodies.size(); ++b)
      {
        json.begin('{');
        for (std::size_t f = 0; f < body_fields.size(); ++f)
          write("-body-" + std::to_string(b), body_fields[f], of_bodies[f], drawn_bodies[b]);
        json.end('}');
      }
    json.end(']');
    json.begin('[', "sides");
    for (std::size_t s = 0; s < present.size(); ++s)
      {
        json.begin('{');
        for (const OutputField &field : present[s].fields)
          write("-side-" + std::to_string(s), field,
                gather_values(*present[s].surface, field, space.communicator()), drawn_sides[s]);
        json.end('}');
      }
    json.end(']');
    json.end('}');
    if (blocks != nullptr)
      blocks->json(id, [&](std::ostream &out) { out << text.str() << '\n'; });
  }
} // namespace Signorini

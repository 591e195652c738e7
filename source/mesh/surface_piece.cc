// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_piece.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  unsigned int ContactSurface::face_of_number(const unsigned int number) const
  {
    if (!origin)
      return number;
    const auto it = std::lower_bound(origin->faces.begin(), origin->faces.end(), number);
    Assert(it != origin->faces.end() && *it == number, ExcInternalError());
    return static_cast<unsigned int>(it - origin->faces.begin());
  }



  double ContactSurface::extent() const
  {
    if (origin)
      return origin->extent;
    if (mesh.vertices.empty())
      return 0.;
    Point<3> low = mesh.vertices[0], high = low;
    for (const Point<3> &x : mesh.vertices)
      for (unsigned int c = 0; c < dim; ++c)
        {
          low[c]  = std::min(low[c], x[c]);
          high[c] = std::max(high[c], x[c]);
        }
    return low.distance(high);
  }



  void ContactSurface::take_row_normals()
  {
    for (const auto &[v, normal] : normals_of_rows)
      mesh.vertex_normals[v] = normal;
    normals_of_rows.clear();
  }



  std::size_t ContactSurface::memory_consumption() const
  {
    std::size_t bytes = list_bytes(mesh.vertices) + list_bytes(mesh.triangles) +
                        list_bytes(mesh.vertex_normals) + list_bytes(faces) + list_bytes(triangle_face) +
                        list_bytes(crease_sides) + list_bytes(vertex_node) + list_bytes(vertex_fixed) +
                        list_bytes(hanging) + has_partner_normal.size() / 8 + true_shape.memory_consumption();
    for (const auto &parents : hanging)
      bytes += list_bytes(parents);
    if (origin)
      bytes += list_bytes(origin->faces) + list_bytes(origin->triangles) + list_bytes(origin->vertices);
    return bytes;
  }



  namespace
  {
    std::vector<bool> triangles_of(const ContactSurface &surface, const Renumbering &faces)
    {
      std::vector<bool> result;
      for (const unsigned int face : surface.triangle_face)
        result.push_back(faces[face] != Renumbering::none);
      return result;
    }

    /// Adds the vertices of triangles, and the parents of all that hang.
    std::vector<bool> complete(std::vector<bool> vertices, const ContactSurface &surface,
                               const std::vector<bool> &triangles)
    {
      for (std::size_t t = 0; t < triangles.size(); ++t)
        if (triangles[t])
          for (const unsigned int v : surface.mesh.triangles[t])
            vertices[v] = true;
      std::vector<bool> result = vertices;
      for (std::size_t v = 0; v < vertices.size(); ++v)
        if (vertices[v])
          for (const auto &parent : surface.hanging[v])
            result[parent.first] = true;
      return result;
    }
  } // namespace



  SurfacePiece::SurfacePiece(const ContactSurface &whole, const std::vector<bool> &some_faces,
                             std::vector<bool> vertices)
    : faces(some_faces)
    , part{Renumbering(complete(std::move(vertices), whole, triangles_of(whole, faces))),
           Renumbering(triangles_of(whole, faces))}
  {
  }



  std::vector<bool> vertices_of_worker(const ContactSurface &surface, const unsigned int rank)
  {
    std::vector<bool> result(surface.mesh.vertices.size(), false);
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
      if (surface.faces[surface.triangle_face[t]].worker == rank)
        for (const unsigned int v : surface.mesh.triangles[t])
          result[v] = true;
    return result;
  }



  ContactSurface cut_out(const ContactSurface &whole, const SurfacePiece &piece)
  {
    const auto &[vertices, triangles] = piece.part;
    ContactSurface result;
    result.mesh.vertices       = vertices.select(whole.mesh.vertices);
    result.mesh.triangles      = triangles.select(whole.mesh.triangles);
    result.mesh.vertex_normals = vertices.select(whole.mesh.vertex_normals);
    result.faces               = piece.faces.select(whole.faces);
    result.triangle_face       = triangles.select(whole.triangle_face);
    result.vertex_node         = vertices.select(whole.vertex_node);
    result.vertex_fixed        = vertices.select(whole.vertex_fixed);
    result.hanging             = vertices.select(whole.hanging);
    if (!whole.crease_sides.empty())
      result.crease_sides = triangles.select(whole.crease_sides);
    if (!whole.has_partner_normal.empty())
      result.has_partner_normal = vertices.select(whole.has_partner_normal);
    for (const auto &[v, normal] : whole.normals_of_rows)
      if (const unsigned int kept = vertices[v]; kept != Renumbering::none)
        result.normals_of_rows[kept] = normal;
    result.true_shape = TrueShape(whole.true_shape, triangles);
    for (auto &triangle : result.mesh.triangles)
      for (unsigned int &v : triangle)
        v = vertices[v];
    for (ContactSurface::Face &face : result.faces)
      for (unsigned int &v : face.corners)
        v = vertices[v];
    for (unsigned int &face : result.triangle_face)
      face = piece.faces[face];
    for (auto &parents : result.hanging)
      for (auto &parent : parents)
        parent.first = vertices[parent.first];
    result.origin = {piece.faces.kept(), triangles.kept(), vertices.kept(), whole.mesh.vertices.size(),
                     whole.extent()};
    return result;
  }



  namespace
  {
    /// Faces, triangles and vertices as they travel, with their numbers in the whole.
    struct SentFace
    {
      unsigned int         number;
      ContactSurface::Face face;
    };

    struct SentTriangle
    {
      unsigned int                number, face;
      std::array<unsigned int, 3> vertices;
    };

    struct SentVertex
    {
      unsigned int number;
      NodeIndex    node;
      Point<3>     place;
    };

    std::vector<SentFace> own_faces(const ContactSurface &piece, const unsigned int rank)
    {
      std::vector<SentFace> result;
      for (unsigned int f = 0; f < piece.faces.size(); ++f)
        if (piece.faces[f].worker == rank)
          {
            result.push_back({piece.number_of_face(f), piece.faces[f]});
            for (unsigned int &v : result.back().face.corners)
              v = piece.number_of_vertex(v);
          }
      return result;
    }

    std::vector<SentTriangle> own_triangles(const ContactSurface &piece, const unsigned int rank)
    {
      std::vector<SentTriangle> result;
      for (unsigned int t = 0; t < piece.mesh.triangles.size(); ++t)
        if (const unsigned int face = piece.triangle_face[t]; piece.faces[face].worker == rank)
          {
            result.push_back(
                {piece.number_of_triangle(t), piece.number_of_face(face), piece.mesh.triangles[t]});
            for (unsigned int &v : result.back().vertices)
              v = piece.number_of_vertex(v);
          }
      return result;
    }

    std::vector<SentVertex> own_vertices(const ContactSurface &piece, const unsigned int rank)
    {
      std::vector<bool> is_sent = vertices_of_worker(piece, rank);
      for (std::size_t v = 0; v < is_sent.size(); ++v)
        if (is_sent[v])
          for (const auto &parent : piece.hanging[v])
            is_sent[parent.first] = true;
      std::vector<SentVertex> result;
      for (unsigned int v = 0; v < is_sent.size(); ++v)
        if (is_sent[v])
          result.push_back({piece.number_of_vertex(v), piece.vertex_node[v], piece.mesh.vertices[v]});
      return result;
    }

    template <typename T>
    std::vector<T> gather_by_number(std::vector<T> mine, const MPI_Comm communicator,
                                    const Receivers receivers)
    {
      std::vector<T> all = gather_lists(std::move(mine), communicator, receivers);
      std::sort(all.begin(), all.end(), [](const T &a, const T &b) { return a.number < b.number; });
      return all;
    }
  } // namespace



  ContactSurface join_pieces(const ContactSurface &piece, const MPI_Comm communicator,
                             const Receivers receivers)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    ContactSurface     result;
    for (const SentFace &sent : gather_by_number(own_faces(piece, rank), communicator, receivers))
      result.faces.push_back(sent.face);
    for (const SentTriangle &sent : gather_by_number(own_triangles(piece, rank), communicator, receivers))
      {
        result.mesh.triangles.push_back(sent.vertices);
        result.triangle_face.push_back(sent.face);
      }
    const auto vertices = gather_by_number(own_vertices(piece, rank), communicator, receivers);
    if (!vertices.empty())
      {
        result.mesh.vertices.resize(piece.n_vertices_of_whole());
        result.vertex_node.resize(piece.n_vertices_of_whole(), invalid_node);
      }
    for (const SentVertex &sent : vertices)
      {
        result.mesh.vertices[sent.number] = sent.place;
        result.vertex_node[sent.number]   = sent.node;
      }
    return result;
  }
} // namespace Signorini

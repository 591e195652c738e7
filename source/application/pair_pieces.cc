// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/pair_pieces.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Collective. The vertices of the nonmortar triangles and edges where the mapping has errors.
    std::vector<ContactPair::WrongPlace> wrong_places(const ContactPair &pair, const MPI_Comm communicator)
    {
      const MappingReport                  report   = sum_reports(pair.mapping->report(), communicator);
      const SurfaceTopology               &topology = pair.mapping->nonmortar_topology();
      const SurfaceMesh                   &mesh     = pair.nonmortar.surface.mesh;
      std::vector<ContactPair::WrongPlace> places;
      for (const unsigned int t : report.wrong_triangles)
        places.push_back({places.size(),
                          {topology.triangles[t].begin(), topology.triangles[t].end()},
                          triangle_area(mesh, t)});
      for (const unsigned int e : report.torn_edges)
        {
          const auto &[a, b] = topology.edges[e];
          places.push_back({places.size(), {a, b}, .5 * mesh.vertices[a].distance_square(mesh.vertices[b])});
        }
      return places;
    }

    /// Collective.
    std::vector<ContactPair::LostEdge> lost_edges(const ContactPair &pair, const MPI_Comm communicator)
    {
      const auto                        &x = pair.mortar.surface.mesh.vertices;
      std::vector<ContactPair::LostEdge> edges;
      for (const unsigned int e : sum_reports(pair.mapping->report(), communicator).lost_edges)
        {
          const auto &[a, b] = pair.mapping->mortar_topology().edges[e];
          edges.push_back({x[a] + .5 * (x[b] - x[a]), x[a].distance(x[b])});
        }
      return edges;
    }

    void keep_places(std::vector<ContactPair::WrongPlace> &places, const Renumbering &vertices)
    {
      for (ContactPair::WrongPlace &place : places)
        {
          for (unsigned int &v : place.vertices)
            v = vertices[v];
          place.vertices.erase(std::remove(place.vertices.begin(), place.vertices.end(), Renumbering::none),
                               place.vertices.end());
        }
      places.erase(std::remove_if(places.begin(), places.end(),
                                  [](const auto &place) { return place.vertices.empty(); }),
                   places.end());
    }

    /// Widths, means and rings of faces want all triangles around the vertices of the own ones.
    SurfacePiece nonmortar_piece(const ContactPair &pair, const unsigned int rank)
    {
      const ContactSurface &surface  = pair.nonmortar.surface;
      std::vector<bool>     vertices = vertices_of_worker(surface, rank), faces(surface.faces.size(), false);
      const std::vector<bool> near   = vertices;
      for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
        for (const unsigned int v : surface.mesh.triangles[t])
          if (near[v])
            faces[surface.triangle_face[t]] = true;
      for (std::size_t f = 0; f < faces.size(); ++f)
        faces[f] = faces[f] || surface.faces[f].owner == rank;
      for (const unsigned int f : pair.halo->ghost_faces())
        faces[f] = true;
      for (const unsigned int v : pair.halo->functions())
        vertices[v] = true;
      return SurfacePiece(surface, faces, std::move(vertices));
    }

    SurfacePiece mortar_piece(const ContactPair &pair, const unsigned int rank)
    {
      const ContactSurface &surface = pair.mortar.surface;
      std::vector<bool>     vertices(surface.mesh.vertices.size(), false), faces;
      for (const ContactSurface::Face &face : surface.faces)
        faces.push_back(face.owner == rank || face.worker == rank);
      for (const auto &triangles : pair.mapping->polygon_triangles)
        faces[surface.triangle_face[triangles.second]] = true;
      for (const FaceMoments &m : pair.moments)
        for (const auto &entry : m.coupling)
          vertices[entry.first] = true;
      return SurfacePiece(surface, faces, std::move(vertices));
    }

    void renumber_nonmortar(ContactPair &pair, PairCoupling &coupling, const SurfacePiece &piece)
    {
      for (FaceMoments &m : pair.moments)
        m.face = piece.faces[m.face];
      for (unsigned int &v : coupling.vertices)
        v = piece.part.vertices[v];
      for (PairCoupling::LostFace &lost : coupling.lost_faces)
        lost.face = piece.faces[lost.face];
      keep_places(pair.wrong_places, piece.part.vertices);
      pair.halo              = std::make_shared<const SurfaceHalo>(*pair.halo, piece);
      pair.nonmortar.surface = cut_out(pair.nonmortar.surface, piece);
    }
  } // namespace



  void keep_piece(ContactPair &pair, PairCoupling &coupling, const MPI_Comm communicator)
  {
    if (pair.mapping)
      {
        pair.wrong_places = wrong_places(pair, communicator);
        pair.lost_edges   = lost_edges(pair, communicator);
      }
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    const unsigned int rank      = Utilities::MPI::this_mpi_process(communicator);
    const SurfacePiece nonmortar = nonmortar_piece(pair, rank);
    if (pair.mapping)
      {
        const SurfacePiece mortar = mortar_piece(pair, rank);
        for (FaceMoments &m : pair.moments)
          for (auto &entry : m.coupling)
            entry.first = mortar.part.vertices[entry.first];
        pair.mapping = std::make_shared<const ContactMapping>(*pair.mapping, nonmortar.part, mortar.part);
        pair.mortar.surface = cut_out(pair.mortar.surface, mortar);
      }
    renumber_nonmortar(pair, coupling, nonmortar);
  }



  std::size_t memory_consumption(const ContactPair &pair, const PairCoupling &coupling)
  {
    std::size_t bytes = pair.nonmortar.surface.memory_consumption() +
                        pair.mortar.surface.memory_consumption() + pair.halo->memory_consumption() +
                        list_bytes(pair.moments) + list_bytes(pair.wrong_places) +
                        list_bytes(pair.lost_edges) + coupling.memory_consumption();
    for (const FaceMoments &m : pair.moments)
      bytes += list_bytes(m.coupling);
    return bytes + (pair.mapping ? pair.mapping->memory_consumption() : 0);
  }
} // namespace Signorini

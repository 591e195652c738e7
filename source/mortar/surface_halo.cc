// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/surface_halo.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int nobody = numbers::invalid_unsigned_int;

    /// The rank that works on the first face of each vertex.
    std::vector<unsigned int> owners_of_vertices(const ContactSurface &surface)
    {
      std::vector<unsigned int> owner(surface.vertex_node.size(), nobody);
      for (const ContactSurface::Face &face : surface.faces)
        for (const unsigned int v : face.corners)
          if (owner[v] == nobody)
            owner[v] = face.worker;
      return owner;
    }

    void pack(std::vector<double> &data, const FaceMoments &m)
    {
      data.insert(data.end(), {static_cast<double>(m.face), m.covered, m.area, m.lie.along, m.lie.away});
      data.insert(data.end(), m.full.begin(), m.full.end());
      data.insert(data.end(), m.mass.begin(), m.mass.end());
      for (const auto *const vectors : {&m.gap, &m.facing})
        for (const Vector3 &g : *vectors)
          data.insert(data.end(), {g[0], g[1], g[2]});
      data.push_back(static_cast<double>(m.coupling.size()));
      for (const auto &[vertex, values] : m.coupling)
        {
          data.push_back(vertex);
          data.insert(data.end(), values.begin(), values.end());
        }
    }

    const double *unpack(FaceMoments &m, const double *data)
    {
      const auto next = [&data]() { return *data++; };
      m.face          = static_cast<unsigned int>(next());
      m.covered       = next();
      m.area          = next();
      m.lie.along     = next();
      m.lie.away      = next();
      std::generate(m.full.begin(), m.full.end(), next);
      std::generate(m.mass.begin(), m.mass.end(), next);
      for (auto *const vectors : {&m.gap, &m.facing})
        for (Vector3 &g : *vectors)
          for (unsigned int c = 0; c < dim; ++c)
            g[c] = next();
      m.coupling.resize(static_cast<std::size_t>(next()));
      for (auto &[vertex, values] : m.coupling)
        {
          vertex = static_cast<unsigned int>(next());
          std::generate(values.begin(), values.end(), next);
        }
      return data;
    }
  } // namespace



  SurfaceHalo::SurfaceHalo(const ContactSurface &surface, const MPI_Comm communicator)
    : comm(communicator)
    , rank(Utilities::MPI::this_mpi_process(communicator))
    , owner(owners_of_vertices(surface))
  {
    for (const ContactSurface::Face &face : surface.faces)
      is_own_face.push_back(face.worker == rank);
    const std::size_t n = owner.size();
    std::vector<bool> is_function(n, false), is_needed(n, false);
    for (unsigned int v = 0; v < n; ++v)
      {
        const auto &parents = surface.hanging[v];
        is_function[v]      = is_function[v] || owns(v);
        if (std::any_of(parents.begin(), parents.end(),
                        [&](const auto &parent) { return owns(parent.first); }))
          {
            is_function[v] = true;
            for (const auto &parent : parents)
              is_function[parent.first] = true;
          }
      }
    ListsByRank<unsigned int> ghost_faces, ghost_vertices;
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      {
        const ContactSurface::Face &face = surface.faces[f];
        if (!owns_face(f) && std::none_of(face.corners.begin(), face.corners.end(),
                                          [&](const unsigned int v) { return is_function[v]; }))
          continue;
        if (!owns_face(f))
          ghost_faces[face.worker].push_back(f);
        for (const unsigned int v : face.corners)
          {
            is_needed[v] = true;
            for (const auto &parent : surface.hanging[v])
              is_needed[parent.first] = true;
          }
      }
    for (unsigned int v = 0; v < n; ++v)
      {
        if (is_function[v])
          function_vertices.push_back(v);
        if (is_needed[v] && !owns(v) && owner[v] != nobody)
          ghost_vertices[owner[v]].push_back(v);
      }
    faces    = std::make_unique<const ItemExchange>(std::move(ghost_faces), comm);
    vertices = std::make_unique<const ItemExchange>(std::move(ghost_vertices), comm);
  }



  SurfaceHalo::SurfaceHalo(const SurfaceHalo &whole, const SurfacePiece &piece)
    : comm(whole.comm)
    , rank(whole.rank)
    , is_own_face(piece.faces.select(whole.is_own_face))
    , owner(piece.part.vertices.select(whole.owner))
  {
    for (const unsigned int v : whole.function_vertices)
      function_vertices.push_back(piece.part.vertices[v]);
    vertices = std::make_unique<const ItemExchange>(
        *whole.vertices, [&](const unsigned int v) { return piece.part.vertices[v]; });
  }



  std::size_t SurfaceHalo::memory_consumption() const
  {
    return is_own_face.capacity() / 8 + list_bytes(owner) + list_bytes(function_vertices) +
           (faces ? faces->memory_consumption() : 0) + vertices->memory_consumption();
  }



  std::vector<unsigned int> SurfaceHalo::ghost_faces() const
  {
    std::vector<unsigned int> result;
    for (const auto &entry : faces->wanted_items())
      result.insert(result.end(), entry.second.begin(), entry.second.end());
    return result;
  }



  std::vector<FaceMoments> SurfaceHalo::add_ghosts(std::vector<FaceMoments> moments) const
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return moments;
    Assert(faces != nullptr, ExcMessage("a piece has no ghosts to ask for"));
    const auto          by_face = [](const FaceMoments &a, const FaceMoments &b) { return a.face < b.face; };
    ListsByRank<double> parcels;
    for (const auto &[receiver, list] : faces->asked_items())
      for (const unsigned int f : list)
        {
          FaceMoments wanted;
          wanted.face = f;
          pack(parcels[receiver], *std::lower_bound(moments.begin(), moments.end(), wanted, by_face));
        }
    for (const auto &[sender, data] : answer_lists(parcels, ranks_of(faces->wanted_items()), comm))
      for (const double *next = data.data(); next != data.data() + data.size();)
        {
          moments.emplace_back();
          next = unpack(moments.back(), next);
        }
    std::sort(moments.begin(), moments.end(), by_face);
    return moments;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Sides of elements of decks as faces of the cells that the elements became, and their names.

#include <signorini/mesh/deck_elements.h>
#include <signorini/mesh/mesh_input.h>

#include <algorithm>
#include <unordered_set>

namespace Signorini
{
  namespace
  {
    VolumeMesh::Face triangle(const unsigned int a, const unsigned int b, const unsigned int c)
    {
      return face_key({{a, b, c, VolumeMesh::no_vertex}});
    }

    /// A polygon of three or four corners; quadrilaterals that are cut go along the diagonal from the
    /// smallest vertex.
    void add_polygon(std::vector<VolumeMesh::Face> &faces, std::vector<unsigned int> loop, const bool is_cut)
    {
      if (loop.size() == 3)
        faces.push_back(triangle(loop[0], loop[1], loop[2]));
      else if (!is_cut)
        faces.push_back(face_key({{loop[0], loop[1], loop[2], loop[3]}}));
      else
        {
          std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
          faces.push_back(triangle(loop[0], loop[1], loop[2]));
          faces.push_back(triangle(loop[0], loop[2], loop[3]));
        }
    }
  } // namespace



  std::vector<VolumeMesh::Face> DeckCells::pieces(const Corners &nodes, const unsigned int n_corners,
                                                  const bool is_cut) const
  {
    std::vector<VolumeMesh::Face> faces;
    Corners                       v;
    for (const unsigned int node : nodes)
      {
        v.push_back(vertex(node));
        if (v.back() == VolumeMesh::no_vertex)
          return {};
      }
    if (nodes.size() == n_corners)
      {
        add_polygon(faces, v, is_cut);
        return faces;
      }
    unsigned int centre = VolumeMesh::no_vertex;
    if (n_corners == 4)
      {
        Corners key(nodes.begin(), nodes.begin() + 4);
        std::sort(key.begin(), key.end());
        const auto it = centre_of_face.find(key);
        if (it == centre_of_face.end())
          return {};
        centre = it->second;
      }
    else
      faces.push_back(triangle(v[3], v[4], v[5]));
    for (unsigned int i = 0; i < n_corners; ++i)
      {
        const unsigned int next = v[n_corners + i], last = v[n_corners + (i + n_corners - 1) % n_corners];
        if (n_corners == 3)
          faces.push_back(triangle(v[i], next, last));
        else
          add_polygon(faces, {v[i], next, centre, last}, is_cut);
      }
    return faces;
  }



  std::vector<VolumeMesh::Face> DeckCells::side(const unsigned int element, const unsigned int side) const
  {
    const DeckElement &e = deck.elements()[element];
    return pieces(ring(e, side), static_cast<unsigned int>(e.type->sides()[side].size()),
                  kept_as.at(element));
  }



  std::vector<VolumeMesh::Face> DeckCells::face(const DeckElement &element) const
  {
    // Whole and cut: only one of both exists.
    std::vector<VolumeMesh::Face> faces = pieces(ring(element, 0), element.type->n_corners, false),
                                  cut   = pieces(ring(element, 0), element.type->n_corners, true);
    faces.insert(faces.end(), cut.begin(), cut.end());
    return faces;
  }



  std::set<VolumeMesh::Face> faces_within(const std::vector<unsigned int> &nodes, const DeckCells &cells,
                                          const BoundaryOfCells &boundary)
  {
    std::vector<bool> is_in(cells.mesh.vertices.size(), false);
    for (const unsigned int v : vertices_within(nodes, cells))
      is_in[v] = true;
    std::set<VolumeMesh::Face> faces;
    for (const auto &[face, cell] : boundary)
      if (std::all_of(face.begin(), face.end(),
                      [&](const unsigned int v) { return v == VolumeMesh::no_vertex || is_in[v]; }))
        faces.insert(face_key(face));
    return faces;
  }



  std::vector<unsigned int> vertices_within(const std::vector<unsigned int> &nodes, const DeckCells &cells)
  {
    std::vector<unsigned int> vertices;
    for (const unsigned int node : nodes)
      if (const unsigned int v = cells.vertex(node); v != VolumeMesh::no_vertex)
        vertices.push_back(v);
    // Centres of faces have four nodes at least.
    if (vertices.size() >= 4)
      {
        const std::unordered_set<unsigned int> set(nodes.begin(), nodes.end());
        for (const unsigned int v : cells.centres())
          if (const auto &support = cells.support(v);
              std::all_of(support.begin(), support.end(),
                          [&](const unsigned int node) { return set.count(node) > 0; }))
            vertices.push_back(v);
      }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }



  std::set<VolumeMesh::Face> faces_of_surface(const Deck &deck, const DeckSurface &surface,
                                              const DeckCells &cells, const BoundaryOfCells &boundary)
  {
    std::set<VolumeMesh::Face> faces;
    const auto                 add = [&](const std::vector<VolumeMesh::Face> &pieces) {
      faces.insert(pieces.begin(), pieces.end());
    };
    for (const DeckSurface::Faces &entry : surface.faces)
      for (const unsigned int e : entry.elements)
        {
          const DeckElement &element = deck.elements()[e];
          if (element.type->shape == DeckElementType::face)
            add(cells.face(element));
          if (!element.type->is_solid() || !cells.has(e))
            continue;
          const auto n_sides = static_cast<unsigned int>(element.type->sides().size());
          if (entry.side.empty())
            for (unsigned int s = 0; s < n_sides; ++s)
              add(cells.side(e, s));
          else
            add(cells.side(e, deck_side(deck, entry.side, 'S', element, entry.place)));
        }
    if (surface.is_of_nodes)
      {
        const auto within = faces_within(surface.nodes, cells, boundary);
        faces.insert(within.begin(), within.end());
      }
    return faces;
  }



  unsigned int deck_side(const Deck &deck, const std::string &text, const char letter,
                         const DeckElement &element, const DeckPlace &place)
  {
    const std::size_t n = element.type->sides().size();
    if (text.size() == 2 && text[0] == letter && text[1] > '0' && text[1] <= static_cast<char>('0' + n))
      return static_cast<unsigned int>(text[1] - '1');
    deck.text().fail(place, "\"" + text + "\" is no side of element " + std::to_string(element.label) +
                                "; sides are " + letter + "1 to " + letter + std::to_string(n) + ".");
  }



  void name_faces(VolumeMesh &mesh, const BoundaryOfCells &boundary, const NamedFaces &named)
  {
    FaceNames names;
    for (unsigned int i = 0; i < named.size(); ++i)
      {
        names.names.push_back(named[i].first);
        for (const VolumeMesh::Face &face : named[i].second)
          names.of_face[face].insert(i);
      }
    name_faces(mesh, boundary, std::move(names));
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_deck_elements_h
#define signorini_mesh_deck_elements_h

#include <signorini/mesh/deck.h>
#include <signorini/mesh/volume_mesh.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// A kind of elements, as far as the mesh is concerned.
  struct DeckElementType
  {
    /// The shape of its corners.
    enum Shape
    {
      tetrahedron,
      wedge,
      hexahedron,
      /// Shells, plane elements: they name faces of solid ones.
      face,
      /// Trusses, beams: passed over.
      line
    };

    /// Its shape.
    Shape shape;
    /// The numbers of its nodes, and of those that are corners.
    unsigned int n_nodes, n_corners;

    /// Whether there are nodes in the middle of edges.
    bool is_quadratic() const
    {
      return n_nodes > n_corners;
    }

    /// Whether it fills a volume.
    bool is_solid() const
    {
      return shape < face;
    }

    /// Corners of the sides S1, S2, ...; those of a face element are its own.
    const std::vector<std::vector<unsigned int>> &sides() const;

    /// The node in the middle of the edge between two corners.
    unsigned int middle(const unsigned int a, const unsigned int b) const;
  };

  /// Null for kinds that are not known. @param name in capitals, e.g. C3D20R
  const DeckElementType *find_deck_element_type(const std::string &name);

  /// The connected parts of the solid elements: a number for each element, Deck::none for others. Elements
  /// that share a node are connected.
  std::vector<unsigned int> connected_deck_elements(const Deck &deck);

  /// Cells of some solid elements of a deck. Quadratic elements are cut into eight linear ones through their
  /// mid nodes; face and cell centres of C3D20 (and face centres of C3D15) come from their shape functions.
  /// Connected parts of hexahedra stay hexahedra, others become tetrahedra: quadrilaterals are cut along the
  /// diagonal from their smallest node, hexahedra around their centre, wedges into three (Dompierre et al.,
  /// How to subdivide pyramids, prisms, and hexahedra into tetrahedra, 1999).
  class DeckCells
  {
  public:
    /// @param elements indices; @param volumes for each of them the index of its volume name
    /// @param part of connected_deck_elements()
    DeckCells(const Deck &deck, const std::vector<unsigned int> &elements,
              const std::vector<unsigned int> &volumes, const std::vector<unsigned int> &part);

    /// Vertices and cells; no faces. May be taken out.
    VolumeMesh mesh;

    /// The element of each cell.
    const std::vector<unsigned int> &element_of_cell() const
    {
      return cell_element;
    }

    /// The vertex at a node of the deck, or VolumeMesh::no_vertex.
    unsigned int vertex(const unsigned int node) const;

    /// The nodes of the deck that a vertex belongs to: itself, or those of the face or cell whose centre it
    /// is.
    const std::vector<unsigned int> &support(const unsigned int vertex) const
    {
      return vertex_support[vertex];
    }

    /// The vertices that are centres of faces and cells.
    const std::vector<unsigned int> &centres() const
    {
      return centre_vertices;
    }

    /// Whether it has an element.
    bool has(const unsigned int element) const
    {
      return kept_as.count(element) > 0;
    }

    /// The pieces (as keys of faces) of side 0, 1, ... of an element.
    std::vector<VolumeMesh::Face> side(const unsigned int element, const unsigned int side) const;

    /// The pieces of a face with such corners, where it is the face of an element; else empty.
    /// @param element a face element: corners, then mid nodes
    std::vector<VolumeMesh::Face> face(const DeckElement &element) const;

  private:
    using Corners = std::vector<unsigned int>;

    void add_element(const unsigned int element, const unsigned int volume, const bool to_tetrahedra);
    void add_cell(const Corners &corners, const bool to_tetrahedra);
    void add_tetrahedron(const unsigned int a, const unsigned int b, const unsigned int c,
                         const unsigned int d);
    void cut_wedge(const Corners &wedge);
    void cut_hexahedron(const Corners &hexahedron);
    void add_quadratic_tetrahedron(const Corners &n, const bool to_tetrahedra);
    void add_quadratic_wedge(const DeckElement &element, const Corners &n, const bool to_tetrahedra);
    void add_quadratic_hexahedron(const DeckElement &element, const Corners &n, const bool to_tetrahedra);
    unsigned int add_vertex(const dealii::Point<3> &position, const std::vector<unsigned int> &support);
    unsigned int vertex_at(const unsigned int node);
    unsigned int face_centre(const DeckElement &element, const unsigned int side);
    /// Corners and mid nodes around a side as nodes of the deck.
    static Corners ring(const DeckElement &element, const unsigned int side);
    /// @param nodes of the deck: corners, then mid nodes
    std::vector<VolumeMesh::Face> pieces(const Corners &nodes, const unsigned int n_corners,
                                         const bool is_cut) const;

    const Deck                                       &deck;
    std::vector<unsigned int>                         cell_element;
    std::unordered_map<unsigned int, unsigned int>    vertex_of_node;
    std::vector<unsigned int>                         centre_vertices;
    std::vector<std::vector<unsigned int>>            vertex_support;
    std::map<std::vector<unsigned int>, unsigned int> centre_of_face;
    /// By element: whether it became tetrahedra.
    std::map<unsigned int, bool> kept_as;
    unsigned int                 present_element = 0, present_volume = 0;
  };

  /// Names and the keys of their faces; faces may have several names.
  using NamedFaces = std::vector<std::pair<std::string, std::set<VolumeMesh::Face>>>;

  /// The number (from 0) of the side of an element that is written as a letter and a number, e.g. S1. Errors:
  /// InputError.
  unsigned int deck_side(const Deck &deck, const std::string &text, const char letter,
                         const DeckElement &element, const DeckPlace &place);

  /// The keys of the faces of a surface that belong to some cells. Surfaces by nodes: boundary faces all of
  /// whose nodes belong to it. Errors: InputError for sides that elements do not have.
  std::set<VolumeMesh::Face> faces_of_surface(const Deck &deck, const DeckSurface &surface,
                                              const DeckCells &cells, const BoundaryOfCells &boundary);

  /// Boundary faces all of whose nodes belong to a set.
  std::set<VolumeMesh::Face> faces_within(const std::vector<unsigned int> &nodes, const DeckCells &cells,
                                          const BoundaryOfCells &boundary);

  /// Vertices of the cells that belong to a set of nodes; centres of faces and cells if all their nodes do.
  std::vector<unsigned int> vertices_within(const std::vector<unsigned int> &nodes, const DeckCells &cells);

  /// name_faces() with what decks say.
  void name_faces(VolumeMesh &mesh, const BoundaryOfCells &boundary, const NamedFaces &named);
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/deck_elements.h>
#include <signorini/mesh/quadratic_tetrahedron.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Shape = DeckElementType::Shape;
    using Lists = std::vector<std::vector<unsigned int>>;

    constexpr DeckElementType tetrahedron4  = {Shape::tetrahedron, 4, 4},
                              tetrahedron10 = {Shape::tetrahedron, 10, 4}, wedge6 = {Shape::wedge, 6, 6},
                              wedge15 = {Shape::wedge, 15, 6}, hexahedron8 = {Shape::hexahedron, 8, 8},
                              hexahedron20 = {Shape::hexahedron, 20, 8}, face3 = {Shape::face, 3, 3},
                              face4 = {Shape::face, 4, 4}, face6 = {Shape::face, 6, 3},
                              face8 = {Shape::face, 8, 4}, line2 = {Shape::line, 2, 2},
                              line3 = {Shape::line, 3, 2};

    /// Edges with a node in their middle, in the order of these.
    const Lists &edges_of(const Shape shape, const unsigned int n_corners)
    {
      static const Lists tetrahedron = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
      static const Lists wedge = {{0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}, {0, 3}, {1, 4}, {2, 5}};
      static const Lists hexahedron    = {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}, {5, 6},
                                          {6, 7}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
      static const Lists triangle      = {{0, 1}, {1, 2}, {0, 2}},
                         quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
      switch (shape)
        {
          case Shape::tetrahedron:
            return tetrahedron;
          case Shape::wedge:
            return wedge;
          case Shape::hexahedron:
            return hexahedron;
          default:
            return n_corners == 3 ? triangle : quadrilateral;
        }
    }

    bool begins_with(const std::string &text, const char *const begin)
    {
      return text.rfind(begin, 0) == 0;
    }

    /// Shells, membranes, plane and surface elements: the number in the name is that of the nodes.
    const DeckElementType *find_face_type(const std::string &name)
    {
      for (const char *const family : {"CPS", "CPE", "CAX", "CPEG", "M3D", "SFM3D", "S", "STRI", "DS", "R3D"})
        {
          const std::string rest = begins_with(name, family) ? name.substr(std::string(family).size()) : "";
          if (rest.empty() || rest.find_first_not_of("0123456789RIHT") != std::string::npos)
            continue;
          if (rest == "65")
            return &face6;
          switch (rest[0])
            {
              case '3':
                return &face3;
              case '4':
                return &face4;
              case '6':
                return &face6;
              case '8':
                return &face8;
              default:
                break;
            }
        }
      return nullptr;
    }

    unsigned int find_root(std::vector<unsigned int> &root, unsigned int v)
    {
      while (root[v] != v)
        v = root[v] = root[root[v]];
      return v;
    }
  } // namespace



  const std::vector<std::vector<unsigned int>> &DeckElementType::sides() const
  {
    static const Lists tetrahedra = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    static const Lists wedges     = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
    static const Lists hexahedra  = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                     {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
    static const Lists triangle = {{0, 1, 2}}, quadrilateral = {{0, 1, 2, 3}}, none;
    switch (shape)
      {
        case tetrahedron:
          return tetrahedra;
        case wedge:
          return wedges;
        case hexahedron:
          return hexahedra;
        case face:
          return n_corners == 3 ? triangle : quadrilateral;
        default:
          return none;
      }
  }



  unsigned int DeckElementType::middle(const unsigned int a, const unsigned int b) const
  {
    const Lists &edges = edges_of(shape, n_corners);
    for (unsigned int e = 0; e < edges.size(); ++e)
      if (edges[e][0] == std::min(a, b) && edges[e][1] == std::max(a, b))
        return n_corners + e;
    return Deck::none;
  }



  const DeckElementType *find_deck_element_type(const std::string &name)
  {
    // Variants (reduced integration, incompatible modes, hybrid, modified) have the same nodes.
    for (const auto &[begin, type] :
         {std::pair<const char *, const DeckElementType *>{"C3D10", &tetrahedron10},
          {"C3D15", &wedge15},
          {"C3D20", &hexahedron20},
          {"C3D4", &tetrahedron4},
          {"C3D6", &wedge6},
          {"C3D8", &hexahedron8}})
      if (begins_with(name, begin) &&
          name.find_first_not_of("RIHMT", std::string(begin).size()) == std::string::npos)
        return type;
    if (name == "T3D2" || name == "T2D2" || name == "B31" || name == "B31R")
      return &line2;
    if (name == "T3D3" || name == "T2D3" || name == "B32" || name == "B32R")
      return &line3;
    return find_face_type(name);
  }



  std::vector<unsigned int> connected_deck_elements(const Deck &deck)
  {
    std::vector<unsigned int> root(deck.positions().size());
    std::iota(root.begin(), root.end(), 0u);
    for (const DeckElement &element : deck.elements())
      if (element.type->is_solid())
        for (const unsigned int node : element.nodes)
          root[find_root(root, node)] = find_root(root, element.nodes[0]);
    std::map<unsigned int, unsigned int> number;
    std::vector<unsigned int>            part;
    for (const DeckElement &element : deck.elements())
      part.push_back(
          element.type->is_solid()
              ? number.insert({find_root(root, element.nodes[0]), static_cast<unsigned int>(number.size())})
                    .first->second
              : Deck::none);
    return part;
  }



  DeckCells::DeckCells(const Deck &deck, const std::vector<unsigned int> &elements,
                       const std::vector<unsigned int> &volumes, const std::vector<unsigned int> &part)
    : deck(deck)
  {
    // Parts of hexahedra alone stay as they are.
    std::set<unsigned int> to_tetrahedra;
    for (const unsigned int e : elements)
      if (deck.elements()[e].type->shape != DeckElementType::hexahedron)
        to_tetrahedra.insert(part[e]);
    for (std::size_t i = 0; i < elements.size(); ++i)
      add_element(elements[i], volumes[i], to_tetrahedra.count(part[elements[i]]) > 0);
  }



  unsigned int DeckCells::vertex(const unsigned int node) const
  {
    const auto it = vertex_of_node.find(node);
    return it == vertex_of_node.end() ? VolumeMesh::no_vertex : it->second;
  }



  unsigned int DeckCells::add_vertex(const Point<3> &position, const std::vector<unsigned int> &support)
  {
    mesh.vertices.push_back(position);
    mesh.node_numbers.push_back(support.size() == 1 ? deck.node_labels()[support[0]] : VolumeMesh::no_number);
    vertex_support.push_back(support);
    if (support.size() > 1)
      centre_vertices.push_back(static_cast<unsigned int>(mesh.vertices.size() - 1));
    return static_cast<unsigned int>(mesh.vertices.size() - 1);
  }



  unsigned int DeckCells::vertex_at(const unsigned int node)
  {
    const auto [it, is_new] = vertex_of_node.insert({node, VolumeMesh::no_vertex});
    if (is_new)
      it->second = add_vertex(deck.positions()[node], {node});
    return it->second;
  }



  void DeckCells::add_element(const unsigned int e, const unsigned int volume, const bool to_tetrahedra)
  {
    const DeckElement &element = deck.elements()[e];
    present_element            = e;
    present_volume             = volume;
    kept_as[e]                 = to_tetrahedra;
    Corners n;
    for (const unsigned int node : element.nodes)
      n.push_back(vertex_at(node));
    if (!element.type->is_quadratic())
      add_cell(n, to_tetrahedra);
    else if (element.type->shape == DeckElementType::tetrahedron)
      add_quadratic_tetrahedron(n, to_tetrahedra);
    else if (element.type->shape == DeckElementType::wedge)
      add_quadratic_wedge(element, n, to_tetrahedra);
    else
      add_quadratic_hexahedron(element, n, to_tetrahedra);
  }



  void DeckCells::add_cell(const Corners &n, const bool to_tetrahedra)
  {
    if (n.size() == 4)
      add_tetrahedron(n[0], n[1], n[2], n[3]);
    else if (n.size() == 6)
      cut_wedge(n);
    else if (to_tetrahedra)
      cut_hexahedron(n);
    else
      {
        // Abaqus runs around the bottom, then the top.
        mesh.cells.push_back({{{n[0], n[1], n[3], n[2], n[4], n[5], n[7], n[6]}}, 8, present_volume});
        cell_element.push_back(present_element);
      }
  }



  void DeckCells::add_tetrahedron(const unsigned int a, const unsigned int b, const unsigned int c,
                                  const unsigned int d)
  {
    mesh.cells.push_back({{{a, b, c, d, 0, 0, 0, 0}}, 4, present_volume});
    cell_element.push_back(present_element);
  }



  namespace
  {
    /// The triangles of a quadrilateral that is run through in a circle, cut from its smallest vertex.
    std::array<std::array<unsigned int, 3>, 2> halves_of_loop(std::vector<unsigned int> loop)
    {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      return {{{{loop[0], loop[1], loop[2]}}, {{loop[0], loop[2], loop[3]}}}};
    }
  } // namespace



  void DeckCells::cut_wedge(const Corners &w)
  {
    // The wedge turned such that its smallest vertex comes first.
    static constexpr unsigned int turned[6][6] = {{0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {2, 0, 1, 5, 3, 4},
                                                  {3, 5, 4, 0, 2, 1}, {4, 3, 5, 1, 0, 2}, {5, 4, 3, 2, 1, 0}};
    const auto                    smallest     = std::min_element(w.begin(), w.end()) - w.begin();
    Corners                       v;
    for (const unsigned int i : turned[smallest])
      v.push_back(w[i]);
    // The quadrilateral that does not contain it.
    if (std::min(v[1], v[5]) < std::min(v[2], v[4]))
      {
        add_tetrahedron(v[0], v[1], v[2], v[5]);
        add_tetrahedron(v[0], v[1], v[5], v[4]);
      }
    else
      {
        add_tetrahedron(v[0], v[1], v[2], v[4]);
        add_tetrahedron(v[0], v[4], v[2], v[5]);
      }
    add_tetrahedron(v[0], v[4], v[5], v[3]);
  }



  void DeckCells::cut_hexahedron(const Corners &n)
  {
    Point<3>               middle;
    std::set<unsigned int> nodes;
    for (const unsigned int v : n)
      {
        middle += .125 * mesh.vertices[v];
        nodes.insert(vertex_support[v].begin(), vertex_support[v].end());
      }
    const unsigned int centre = add_vertex(middle, {nodes.begin(), nodes.end()});
    for (const auto &side : hexahedron8.sides())
      for (const auto &[a, b, c] : halves_of_loop({n[side[0]], n[side[1]], n[side[2]], n[side[3]]}))
        // Sides are run through clockwise, seen from outside: the centre lies in front.
        add_tetrahedron(a, b, c, centre);
  }



  void DeckCells::add_quadratic_tetrahedron(const Corners &n, const bool)
  {
    std::array<unsigned int, 10> nodes;
    std::copy_n(n.begin(), nodes.size(), nodes.begin());
    for (const auto &piece : cut_quadratic_tetrahedron(mesh.vertices, nodes))
      add_tetrahedron(piece[0], piece[1], piece[2], piece[3]);
  }



  DeckCells::Corners DeckCells::ring(const DeckElement &element, const unsigned int side)
  {
    const auto &corners = element.type->sides()[side];
    Corners     result;
    for (const unsigned int c : corners)
      result.push_back(element.nodes[c]);
    for (std::size_t i = 0; i < corners.size() && element.type->is_quadratic(); ++i)
      result.push_back(element.nodes[element.type->middle(corners[i], corners[(i + 1) % corners.size()])]);
    return result;
  }



  unsigned int DeckCells::face_centre(const DeckElement &element, const unsigned int side)
  {
    Corners       nodes  = ring(element, side);
    const Corners around = nodes;
    std::sort(nodes.begin(), nodes.begin() + 4);
    nodes.resize(4);
    const auto [it, is_new] = centre_of_face.insert({nodes, 0});
    if (is_new)
      {
        // The serendipity functions of eight nodes at their centre.
        Point<3> x;
        for (unsigned int i = 0; i < 8; ++i)
          x += (i < 4 ? -.25 : .5) * deck.positions()[around[i]];
        it->second = add_vertex(x, around);
      }
    return it->second;
  }



  void DeckCells::add_quadratic_wedge(const DeckElement &element, const Corners &n, const bool to_tetrahedra)
  {
    // Centres of the three quadrilaterals, between the mid nodes of the edges along the axis.
    const unsigned int c01 = face_centre(element, 2), c12 = face_centre(element, 3),
                       c02                    = face_centre(element, 4);
    const Corners                 layers[3]   = {{n[0], n[1], n[2], n[6], n[7], n[8]},
                                                 {n[12], n[13], n[14], c01, c12, c02},
                                                 {n[3], n[4], n[5], n[9], n[10], n[11]}};
    static constexpr unsigned int parts[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    for (unsigned int l = 0; l < 2; ++l)
      for (const auto &[a, b, c] : parts)
        add_cell(
            {layers[l][a], layers[l][b], layers[l][c], layers[l + 1][a], layers[l + 1][b], layers[l + 1][c]},
            to_tetrahedra);
  }



  void DeckCells::add_quadratic_hexahedron(const DeckElement &element, const Corners &n,
                                           const bool to_tetrahedra)
  {
    // The serendipity functions of twenty nodes at their centre.
    Point<3> x;
    for (unsigned int i = 0; i < 20; ++i)
      x += (i < 8 ? -.25 : .25) * mesh.vertices[n[i]];
    unsigned int centres[6];
    for (unsigned int side = 0; side < 6; ++side)
      centres[side] = face_centre(element, side);
    // A grid of 3 x 3 x 3: layers of corners and mid nodes.
    const unsigned int grid[3][3][3] = {
        {{n[0], n[8], n[1]}, {n[11], centres[0], n[9]}, {n[3], n[10], n[2]}},
        {{n[16], centres[2], n[17]},
         {centres[5], add_vertex(x, element.nodes), centres[3]},
         {n[19], centres[4], n[18]}},
        {{n[4], n[12], n[5]}, {n[15], centres[1], n[13]}, {n[7], n[14], n[6]}}};
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int j = 0; j < 2; ++j)
        for (unsigned int i = 0; i < 2; ++i)
          add_cell({grid[k][j][i], grid[k][j][i + 1], grid[k][j + 1][i + 1], grid[k][j + 1][i],
                    grid[k + 1][j][i], grid[k + 1][j][i + 1], grid[k + 1][j + 1][i + 1],
                    grid[k + 1][j + 1][i]},
                   to_tetrahedra);
  }
} // namespace Signorini

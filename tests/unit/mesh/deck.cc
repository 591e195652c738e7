// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Decks as files have them, and their elements as cells.

#include "expect_in.h"
#include "mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck_elements.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/tetrahedral_forest.h>

#include <gtest/gtest.h>

#include <numeric>

using namespace Signorini;
using dealii::Point;

namespace
{
  std::string error_of(const std::string &text)
  {
    const TemporaryFile file(text, ".inp");
    try
      {
        const Deck deck(file.path);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "none";
  }

  std::string nodes_text(const std::vector<Point<3>> &points)
  {
    std::ostringstream text;
    text.precision(16);
    text << "*NODE\n";
    for (std::size_t i = 0; i < points.size(); ++i)
      text << i + 1 << ", " << points[i][0] << ", " << points[i][1] << ", " << points[i][2] << "\n";
    return text.str();
  }

  /// An element with numbers from 1, in lines of ten.
  std::string element_text(const std::string &type, const unsigned int n)
  {
    std::string text = "*ELEMENT, TYPE=" + type + ", ELSET=E\n1";
    for (unsigned int i = 1; i <= n; ++i)
      text += (i % 10 == 0 ? ",\n" : ", ") + std::to_string(i);
    return text + "\n";
  }

  /// Corners, and the middles of their edges moved out by a bulge.
  std::vector<Point<3>> quadratic(std::vector<Point<3>> points, const DeckElementType &type,
                                  const double bulge)
  {
    const auto n = static_cast<unsigned int>(points.size());
    points.resize(type.n_nodes);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = a + 1; b < n; ++b)
        if (const unsigned int m = type.middle(a, b); m != Deck::none)
          points[m] = Point<3>((1. + bulge) * .5 * (points[a] + dealii::Tensor<1, 3>(points[b])));
    return points;
  }

  double volume(const VolumeMesh &mesh)
  {
    double sum = 0.;
    for (const VolumeMesh::Cell &cell : mesh.cells)
      {
        const auto x = mesh.corners(cell);
        if (cell.n_vertices == 4)
          sum += cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) / 6.;
        else
          // Bricks only.
          sum += cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[4] - x[0]);
      }
    return sum;
  }

  const std::vector<Point<3>> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
} // namespace



TEST(Deck, ReadsWhatPeopleWrite)
{
  const TemporaryFile more("3, 0.D0, 1.0d0, 0\r\n4, , , 1.,\r\n", ".txt");
  const TemporaryFile file(
      "** made by hand\r\n*Node , nset = \"All nodes\"\r\n1,0,0,0\r\n 2 , 1. ,0.,\r\n"
      "*include, input=" +
          more.path +
          "\n*Nset,nset=A,\n internal\n1,2,\n*NSET, NSET=range, GENERATE\n2,4,2\n"
          "*nset, nset=both\nlater, RANGE\n*nset, nset=Later\n1\n*nset, nset=later\n3\n"
          "*ELEMENT,TYPE=C3D4,elset=E\n1,1,2,\n3,4\n*material, name=\"my steel\"\n*elastic\n1,.3\n",
      ".inp");
  const Deck deck(file.path);
  ASSERT_EQ(deck.positions().size(), 4u);
  EXPECT_EQ(deck.positions()[3], Point<3>(0, 0, 1));
  EXPECT_EQ(deck.positions()[2], Point<3>(0, 1, 0));
  ASSERT_NE(deck.find_node_set("BOTH"), nullptr);
  EXPECT_EQ(deck.find_node_set("both")->members, (std::vector<unsigned int>{0, 1, 2, 3}));
  EXPECT_EQ(deck.find_node_set("a")->members, (std::vector<unsigned int>{0, 1}));
  EXPECT_EQ(deck.find_node_set("ALL NODES")->members.size(), 4u);
  EXPECT_EQ(deck.find_node_set("LATER")->members, (std::vector<unsigned int>{0, 2}));
  ASSERT_EQ(deck.elements().size(), 1u);
  EXPECT_EQ(deck.elements()[0].nodes, (std::vector<unsigned int>{0, 1, 2, 3}));
  ASSERT_EQ(deck.others().size(), 2u);
  EXPECT_EQ(deck.others()[0].keyword->get("NAME"), "my steel");
  EXPECT_EQ(deck.others()[1].keyword->name, "ELASTIC");
}



TEST(Deck, PutsPartsWhereTheirInstancesAre)
{
  const TemporaryFile file(
      "*PART, NAME=P\n" + nodes_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) + element_text("C3D4", 4) +
          "*NSET, NSET=S\n2\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=one, PART=p\n*END "
          "INSTANCE\n*INSTANCE, NAME=two, PART=P\n1., 0., 0.\n1., 0., 0., 1., 0., 1., 90.\n"
          "*END INSTANCE\n*NODE\n1, 7., 7., 7.\n*NSET, NSET=RP\n1\n*NSET, NSET=I, INSTANCE=two\n"
          "1\n*NSET, NSET=J\none.2, two.S\n*END ASSEMBLY\n",
      ".inp");
  const Deck deck(file.path);
  ASSERT_EQ(deck.positions().size(), 9u);
  // Moved by (1, 0, 0), then turned about the axis through (1, 0, 0) along z: x becomes y.
  EXPECT_LT(deck.positions()[5].distance(Point<3>(1, 1, 0)), 1e-15);
  EXPECT_EQ(deck.find_node_set("one.S")->members, (std::vector<unsigned int>{1}));
  EXPECT_EQ(deck.find_node_set("TWO.s")->members, (std::vector<unsigned int>{5}));
  EXPECT_EQ(deck.find_node_set("S"), nullptr);
  EXPECT_EQ(deck.find_node_set("RP")->members, (std::vector<unsigned int>{8}));
  EXPECT_EQ(deck.find_node_set("I")->members, (std::vector<unsigned int>{4}));
  EXPECT_EQ(deck.find_node_set("J")->members, (std::vector<unsigned int>{1, 5}));
  EXPECT_EQ(deck.instance_of_element(1), "two");
}



TEST(Deck, SaysWhereMistakesAre)
{
  const std::string good = nodes_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) + element_text("C3D4", 4);
  EXPECT_EQ(error_of(good), "none");
  for (const auto &[text, words] : std::vector<std::pair<std::string, std::string>>{
           {good + "*NSET, NSET=A\nB\n", "line 9: there is no set \"B\""},
           {good + "*NSET, NSET=A\nB\n*NSET, NSET=B\nA\n", "contains itself"},
           {good + "*SURFACE, NAME=S\nQ, S1\n", "line 9: there is no ELSET \"Q\""},
           {good + "*SURFACE, NAME=S\n7, S1\n", "there is no element 7"},
           {good + "*INSTANCE, NAME=I, PART=Q\n", "no END INSTANCE"},
           {good + "*INSTANCE, NAME=I, PART=Q\n*END INSTANCE\n", "there is no PART \"Q\""},
           {good + "*INCLUDE, INPUT=no.txt\n", "line 8: the included file"},
           {good + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3\n", "too few nodes"},
           {good + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 9\n", "node 9, which is missing"},
           {good + "*ELEMENT, TYPE=SPRINGA\n2, 1, 2\n", "line 8: elements of type \"SPRINGA\""},
           {good + "*NODE\n5, x, 0, 0\n", "line 9: \"x\" should be a number"},
           {"1, 2, 3\n", "line 1"}})
    expect_in(error_of(text), words);
}



// Numbers and ranges of damaged files: at once, whatever they are.
TEST(Deck, RangesMayBeLongerThanWhatThereIs)
{
  const std::string nodes   = "*NODE\n1, 0, 0, 0\n5, 1, 0, 0\n7, 0, 1, 0\n2000000000, 0, 0, 1\n";
  const auto        members = [&](const std::string &range) {
    const TemporaryFile file(nodes + "*NSET, NSET=A, GENERATE\n" + range + "\n", ".inp");
    return Deck(file.path).node_sets()[0].members;
  };
  EXPECT_EQ(members("1, 2147483647"), (std::vector<unsigned int>{0, 1, 2, 3}));
  EXPECT_EQ(members("1, 2147483647, 2"), (std::vector<unsigned int>{0, 1, 2}));
  EXPECT_EQ(members("3, 2000000000, 4"), (std::vector<unsigned int>{2}));
  EXPECT_EQ(members("1, 7, 2"), (std::vector<unsigned int>{0, 1, 2}));
  expect_in(error_of(nodes + "*NSET, NSET=A\n1, 99999999999999999999999\n"), "line 7: the number 999");
  expect_in(error_of(nodes + "*NSET, NSET=A, GENERATE\n1, 9223372036854775807, 1\n"), "at most 2147483647");
}



TEST(Deck, CombinesAllSurfacesOfALine)
{
  const std::string text = nodes_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) +
                           element_text("C3D4", 4) +
                           "*SURFACE, NAME=A\nE, S1\n*SURFACE, NAME=B\nE, S2\n*SURFACE, NAME=C\nE, S3\n"
                           "*SURFACE, NAME=ALL, COMBINE=UNION\nA, B\nC\n";
  const TemporaryFile file(text, ".inp");
  EXPECT_EQ(Deck(file.path).surfaces().back().faces.size(), 3u);
}



TEST(Deck, PassesOverTheMarkOfItsCoding)
{
  const std::string   text = nodes_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const TemporaryFile file("\xEF\xBB\xBF" + text, ".inp");
  EXPECT_NO_THROW(Deck deck(file.path));
}



// Few lines that mean much: surfaces that are twice the one before, and sets in sets in sets.
TEST(Deck, GrowsNoFasterThanItsFile)
{
  const std::string one = nodes_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) + element_text("C3D4", 4) +
                          "*SURFACE, NAME=S0\nE, S1\nE, S2\n";
  std::string doubled = one, itself = one + "*SURFACE, NAME=S0, COMBINE=UNION\n", chain = one;
  for (unsigned int i = 1; i < 60; ++i)
    {
      const std::string before = "S" + std::to_string(i - 1);
      doubled += "*SURFACE, NAME=S" + std::to_string(i) + ", COMBINE=UNION\n" + before + "\n" + before + "\n";
      itself += "S0\n";
    }
  for (const std::string &text : {doubled, itself})
    {
      const TemporaryFile file(text, ".inp");
      EXPECT_EQ(Deck(file.path).surfaces().back().faces.size(), 2u);
    }
  for (unsigned int i = 0; i < 100000; ++i)
    chain += "*NSET, NSET=N" + std::to_string(i) + "\nN" + std::to_string(i + 1) + "\n";
  expect_in(error_of(chain + "*NSET, NSET=N100000\n1\n"), "1001 that contain each other");
}



// Devices do not end, and names may be too long for the system.
TEST(Deck, IncludesFilesAlone)
{
  for (const std::string &name : {std::string("/dev/zero"), std::string("/"), std::string(5000, 'x')})
    {
      expect_in(error_of("*INCLUDE, INPUT=" + name + "\n"), "line 1: the included file");
      expect_in(error_of("*NODE, INPUT=" + name + "\n"), "line 1: the file");
    }
}



TEST(DeckElements, QuadraticElementsAreCutIntoEight)
{
  const std::vector<Point<3>> tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              wedge = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  struct Kind
  {
    const char           *type;
    std::vector<Point<3>> points;
    std::size_t           n_cells, n_vertices;
    double                volume;
    unsigned int          n_per_cell;
  };
  for (const Kind &kind : {Kind{"C3D10", tetrahedron, 8, 10, 1. / 6., 4}, Kind{"C3D15", wedge, 24, 18, .5, 4},
                           Kind{"C3D20R", corners, 8, 27, 1., 8}, Kind{"C3D6", wedge, 3, 6, .5, 4},
                           Kind{"C3D8I", corners, 1, 8, 1., 8}})
    {
      const DeckElementType &type   = *find_deck_element_type(kind.type);
      const auto             points = type.is_quadratic() ? quadratic(kind.points, type, 0.) : kind.points;
      const TemporaryFile    file(nodes_text(points) + element_text(kind.type, type.n_nodes), ".inp");
      const VolumeMesh       mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
      EXPECT_EQ(mesh.cells.size(), kind.n_cells) << kind.type;
      EXPECT_EQ(mesh.vertices.size(), kind.n_vertices) << kind.type;
      EXPECT_EQ(mesh.cells[0].n_vertices, kind.n_per_cell) << kind.type;
      EXPECT_NEAR(volume(mesh), kind.volume, 1e-15) << kind.type;
      EXPECT_TRUE(mesh.notes.empty()) << kind.type << ": " << mesh.notes[0];
    }
}



TEST(DeckElements, CurvedSidesStayCurved)
{
  // A brick whose top is the quadratic surface z = 1 + x (1 - x) / 5: the centre of the top lies on it.
  const DeckElementType &type   = *find_deck_element_type("C3D20");
  std::vector<Point<3>>  points = quadratic(corners, type, 0.);
  for (Point<3> &p : points)
    p[2] *= 1. + p[0] * (1. - p[0]) / 5.;
  const TemporaryFile file(nodes_text(points) + element_text("C3D20", 20) + "*SURFACE, NAME=TOP\nE, S2\n",
                           ".inp");
  const VolumeMesh    mesh     = read_volume_mesh(file.path, MPI_COMM_WORLD);
  std::size_t         n_on_top = 0;
  for (const auto &face : mesh.faces)
    if (mesh.boundary_names[face.name] == "TOP")
      for (const unsigned int v : face.vertices)
        {
          const Point<3> &x = mesh.vertices[v];
          EXPECT_NEAR(x[2], 1. + x[0] * (1. - x[0]) / 5., 1e-15);
          ++n_on_top;
        }
  EXPECT_EQ(n_on_top, 16u);
}



TEST(DeckElements, WedgesOfAnyNumberingFitTheirNeighbours)
{
  // Two wedges that make a cube, with all numberings of the nodes of their common side: always conforming.
  const unsigned int        wedges[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  std::vector<unsigned int> order(8);
  std::iota(order.begin(), order.end(), 0u);
  unsigned int n = 0;
  do
    {
      if (++n % 97 != 1)
        continue;
      std::vector<Point<3>> points(8);
      for (unsigned int i = 0; i < 8; ++i)
        points[order[i]] = corners[i];
      std::string text = nodes_text(points) + "*ELEMENT, TYPE=C3D6\n";
      for (unsigned int w = 0; w < 2; ++w)
        {
          text += std::to_string(w + 1);
          for (const unsigned int v : wedges[w])
            text += ", " + std::to_string(order[v] + 1);
          text += "\n";
        }
      const TemporaryFile file(text, ".inp");
      const VolumeMesh    mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
      EXPECT_EQ(mesh.cells.size(), 6u);
      EXPECT_NEAR(volume(mesh), 1., 1e-15);
      EXPECT_EQ(mesh.faces.size(), 12u);
    }
  while (std::next_permutation(order.begin(), order.end()));
}



TEST(DeckElements, SurfacesAndSetsOverlap)
{
  const TemporaryFile file(
      nodes_text(corners) + element_text("C3D8", 8) +
          "*SURFACE, NAME=TOP\nE, S2\n*SURFACE, NAME=HULL\nE\n*NSET, NSET=HIGH\n5,6,7,8\n"
          "*NSET, NSET=EDGE\n1,2\n*ELEMENT, TYPE=S4, ELSET=FRONT\n2, 1, 2, 6, 5\n",
      ".inp");
  const VolumeMesh mesh    = read_volume_mesh(file.path, MPI_COMM_WORLD);
  const auto       n_faces = [&](const std::string &name) {
    std::set<unsigned int> members;
    for (const auto &[group, list] : mesh.boundary_groups)
      if (group == name)
        members.insert(list.begin(), list.end());
    for (unsigned int i = 0; i < mesh.boundary_names.size() && members.empty(); ++i)
      if (mesh.boundary_names[i] == name)
        members.insert(i);
    std::size_t n = 0;
    for (const auto &face : mesh.faces)
      n += members.count(face.name);
    return n;
  };
  EXPECT_EQ(n_faces("TOP"), 1u);
  EXPECT_EQ(n_faces("HIGH"), 1u);
  EXPECT_EQ(n_faces("HULL"), 6u);
  EXPECT_EQ(n_faces("FRONT"), 1u);
  EXPECT_EQ(n_faces("EDGE"), 0u);
  ASSERT_EQ(mesh.node_sets.size(), 2u);
  EXPECT_EQ(mesh.node_sets[1].second.size(), 2u);
}

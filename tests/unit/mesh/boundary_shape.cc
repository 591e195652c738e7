// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/generated_mesh.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/mesh/node_movement.h>
#include <signorini/mesh/surface_extraction.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::ArrayView;
using dealii::Point;
using dealii::Tensor;

namespace
{
  BoundaryShapePointer shape(const std::string &text, const Placement &placement = {})
  {
    return make_boundary_shape(text, placement, ".", "test");
  }

  /// A sphere of radius 1 as an .off file: the faces of a cube, n x n squares each, cut into triangles.
  std::string sphere_file(const unsigned int n)
  {
    std::vector<Point<3>>                       points;
    std::vector<std::array<unsigned int, 3>>    triangles;
    std::map<std::array<long, 3>, unsigned int> number;
    for (unsigned int f = 0; f < 6; ++f)
      {
        const auto vertex = [&](const unsigned int i, const unsigned int j) {
          const double s          = std::tan(dealii::numbers::PI / 4. * (2. * i / n - 1.)),
                       t          = std::tan(dealii::numbers::PI / 4. * (2. * j / n - 1.));
          const unsigned int axis = f / 2;
          Point<3>           p;
          p[axis]           = f % 2 ? 1. : -1.;
          p[(axis + 1) % 3] = f % 2 ? s : t;
          p[(axis + 2) % 3] = f % 2 ? t : s;
          p /= p.norm();
          const auto [it, is_new] =
              number.insert({{{std::lround(1e9 * p[0]), std::lround(1e9 * p[1]), std::lround(1e9 * p[2])}},
                             static_cast<unsigned int>(points.size())});
          if (is_new)
            points.push_back(p);
          return it->second;
        };
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            {
              triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
              triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
            }
      }
    std::ostringstream out;
    out << std::setprecision(17) << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
    for (const auto &p : points)
      out << p << '\n';
    for (const auto &t : triangles)
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return out.str();
  }

  BodyParameters block(const bool tetrahedra)
  {
    BodyParameters p;
    p.name                  = "body";
    p.mesh                  = "block";
    p.lower_corner          = Point<3>(-1, -1, -1);
    p.divisions             = {2, 2, 2};
    p.convert_to_tetrahedra = tetrahedra;
    return p;
  }

  /// A tube along z from radius 1 to 2, of height 1, as hexahedra: 16 around, one through the wall, two on
  /// each other. All of its boundary has one name.
  std::string tube_file()
  {
    constexpr unsigned int   n = 16;
    std::vector<Point<3>>    points;
    std::vector<std::string> elements;
    const auto               number = [](const unsigned int i, const unsigned int j, const unsigned int k) {
      return std::to_string(1 + (k * 2 + j) * n + i % n) + " ";
    };
    for (unsigned int k = 0; k < 3; ++k)
      for (const double r : {1., 2.})
        for (unsigned int i = 0; i < n; ++i)
          points.emplace_back(r * std::cos(2. * dealii::numbers::PI * i / n),
                              r * std::sin(2. * dealii::numbers::PI * i / n), .5 * k);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int k = 0; k < 2; ++k)
          {
            std::string hexahedron = "5 2 1 1 ";
            for (const unsigned int l : {k, k + 1})
              hexahedron += number(i, 0, l) + number(i, 1, l) + number(i + 1, 1, l) + number(i + 1, 0, l);
            elements.push_back(hexahedron);
            for (const unsigned int j : {0u, 1u})
              elements.push_back("3 2 2 2 " + number(i, j, k) + number(i + 1, j, k) +
                                 number(i + 1, j, k + 1) + number(i, j, k + 1));
          }
        for (const unsigned int k : {0u, 2u})
          elements.push_back("3 2 2 2 " + number(i, 0, k) + number(i, 1, k) + number(i + 1, 1, k) +
                             number(i + 1, 0, k));
      }
    return gmsh_text(points, elements, "2\n3 1 \"tube\"\n2 2 \"skin\"\n");
  }

  void refine(Bodies &bodies)
  {
    const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
    bodies.refine(space, std::vector<bool>(space.cells().size(), true));
  }

  /// Largest of a function over the nodes of a boundary.
  template <typename Function>
  double largest_on(const Bodies &bodies, const NodalSpace &space, const std::string &name, const Function &f)
  {
    const auto ids     = bodies.boundary_ids(0, name);
    double     largest = 0.;
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (const auto &cell = space.cells()[face.cell]; ids.count(face.id) > 0)
        for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
          largest = std::max(largest, std::abs(f(space.position(space.nodes(cell)[v]))));
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }
} // namespace



// Faces are seen counterclockwise from outside, on both kinds of cells.
TEST(CellShape, FacesLookOutward)
{
  const std::array<Point<3>, 4> tetrahedron = {
      {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)}};
  for (const unsigned int n : {4u, 8u})
    for (unsigned int f = 0; f < CellShape::n_faces(n); ++f)
      {
        std::vector<Point<3>> x;
        for (const unsigned int v : CellShape::face(n, f))
          x.push_back(n == 4 ? tetrahedron[v] : Point<3>(v & 1, v >> 1 & 1, v >> 2));
        const Point<3>     centre = n == 4 ? Point<3>(.25, .25, .25) : Point<3>(.5, .5, .5);
        const Tensor<1, 3> normal = cross_product_3d(x[1] - x[0], x[2] - x[1]);
        EXPECT_GT(normal * (x[0] - centre), 0.) << n << " vertices, face " << f;
        if (n == 8)
          {
            EXPECT_GT(normal * cross_product_3d(x[2] - x[1], x[3] - x[2]), 0.);
          }
      }
}



TEST(BoundaryShape, AnalyticShapes)
{
  const Point<3> p(3., 1., 2.);
  EXPECT_NEAR((shape("sphere: (1, 0, 0), 0.5")->project(p) - Point<3>(1, 0, 0)).norm(), .5, 1e-15);
  const Point<3> c = shape("cylinder: (1, 0, 5), (0, 0, 2), 0.5")->project(p);
  EXPECT_NEAR(std::hypot(c[0] - 1., c[1]), .5, 1e-15);
  EXPECT_NEAR(c[2], 2., 1e-15);
  const Point<3> t = shape("torus: (0, 0, 1), (0, 0, 1), 3, 0.5")->project(p);
  EXPECT_NEAR(std::hypot(std::hypot(t[0], t[1]) - 3., t[2] - 1.), .5, 1e-14);
  EXPECT_NEAR(shape("plane: (0, 0, 1), (0, 1, 1)")->project(p)[1] +
                  shape("plane: (0, 0, 1), (0, 1, 1)")->project(p)[2],
              1., 1e-14);
  // Where two of them meet.
  const Point<3> edge =
      project_onto({shape("sphere: (0, 0, 0), 2"), shape("plane: (0, 0, 1), (0, 0, 1)")}, p);
  EXPECT_NEAR(edge.norm(), 2., 1e-12);
  EXPECT_NEAR(edge[2], 1., 1e-12);
  // Placed like the body: turned by 90 degrees about z, then moved.
  Placement placement;
  placement.rotation    = Tensor<2, 3>({{0., -1., 0.}, {1., 0., 0.}, {0., 0., 1.}});
  placement.translation = Tensor<1, 3>({10., 0., 0.});
  EXPECT_NEAR((shape("sphere: (1, 0, 0), 0.5", placement)->project(p) - Point<3>(10, 1, 0)).norm(), .5,
              1e-14);
  for (const std::string bad : {"ball: (0, 0, 0), 1", "sphere: (0, 0, 0)", "sphere: (0, 0, 0), -1", "sphere",
                                "plane: (0, 0, 0), (0, 0, 0)", "file: /nonexistent.stl", "sphere: (0, 0), 1"})
    EXPECT_THROW(shape(bad), InputError) << bad;
}



// Points of a cone come from points on its normals, from inside and outside; beyond the apex there is
// nothing.
TEST(BoundaryShape, Cone)
{
  const double       angle = 25. * dealii::numbers::PI / 180., c = std::cos(angle), s = std::sin(angle);
  const Point<3>     apex(1., 2., 3.);
  const Tensor<1, 3> axis({0., .6, .8}), one({1., 0., 0.}), two({0., .8, -.6});
  const double       h    = 2.;
  const auto         text = [](const Point<3> &p, const double radius) {
    std::ostringstream stream;
    stream.precision(17);
    stream << "cone: (" << p[0] << ", " << p[1] << ", " << p[2] << "), (0, 3, 4), " << radius << ", 25";
    return stream.str();
  };
  // By its apex, and by the radius somewhere else.
  for (const auto &cone : {shape(text(apex, 0.)), shape(text(apex + h * axis, h * s / c))})
    {
      EXPECT_TRUE(cone->is_exact());
      for (unsigned int i = 0; i < 50; ++i)
        {
          const Tensor<1, 3> out = std::cos(.7 * i) * one + std::sin(.7 * i) * two;
          const Tensor<1, 3> n   = c * out - s * axis;
          const double       way = .1 + .05 * i;
          const Point<3>     x   = apex + way * (c * axis + s * out);
          for (const double off : {-.4 * way * s / c, 0., .3, 5.})
            {
              EXPECT_LT(cone->project(x + off * n).distance(x), 1e-13) << i << ", " << off;
              EXPECT_LT((cone->normal(x + off * n, n) - n).norm(), 1e-13);
              EXPECT_LT((cone->normal(x + off * n, -2. * n) + n).norm(), 1e-13);
            }
        }
      EXPECT_LT(cone->project(apex - .5 * axis + .1 * one).distance(apex), 1e-15);
    }
  // Where it meets a plane across its axis.
  const Point<3> edge =
      project_onto({shape("cone: (0, 0, 0), (0, 0, 1), 0, 45"), shape("plane: (0, 0, 2), (0, 0, 1)")},
                   Point<3>(1.9, .1, 2.1));
  EXPECT_NEAR(std::hypot(edge[0], edge[1]), 2., 1e-12);
  EXPECT_NEAR(edge[2], 2., 1e-12);
  // Placed like the body: turned by 90 degrees about x, so that it opens along -y, then moved.
  Placement placement;
  placement.rotation    = Tensor<2, 3>({{1., 0., 0.}, {0., 0., -1.}, {0., 1., 0.}});
  placement.translation = Tensor<1, 3>({10., 0., 0.});
  const Point<3> x = shape("cone: (0, 0, 0), (0, 0, 1), 1, 45", placement)->project(Point<3>(13., -2.2, 0.));
  EXPECT_NEAR(x[0] - 10., 1. - x[1], 1e-14);
  EXPECT_EQ(x[2], 0.);
  for (const std::string bad : {"cone: (0, 0, 0), (0, 0, 1), 1", "cone: (0, 0, 0), (0, 0, 1), -1, 20",
                                "cone: (0, 0, 0), (0, 0, 1), 1, 0", "cone: (0, 0, 0), (0, 0, 1), 1, 90",
                                "cone: (0, 0, 0), (0, 0, 0), 1, 20"})
    EXPECT_THROW(shape(bad), InputError) << bad;
}



// The facets of a sphere are off by h^2 / 8; projections of points on a normal come back to its foot.
TEST(BoundaryShape, TriangulatedSphere)
{
  const TemporaryFile file(sphere_file(40), ".off");
  const auto          sphere = shape("file: " + file.path);
  EXPECT_EQ(sphere->note(), "");
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double       z = -.995 + .00995 * i, a = 2.4 * i, r = std::sqrt(1. - z * z);
      const Tensor<1, 3> n({r * std::cos(a), r * std::sin(a), z});
      const Point<3>     near = sphere->project(Point<3>(.97 * n)), far = sphere->project(Point<3>(1.05 * n));
      EXPECT_NEAR(near.norm(), 1., 1e-3);
      EXPECT_LT(near.distance(Point<3>(n)), 2e-3);
      // The normals at the vertices are those of the facets around: off by less than 1 % here, over 0.08.
      EXPECT_LT(near.distance(far), 8e-4);
      EXPECT_LT(sphere->project(near).distance(near), 1e-12);
    }
}



// A block inside of a sphere: its top follows the sphere, its edges with the sides stay straight.
TEST(BoundaryShape, MeshesFollowOnBothKindsOfCells)
{
  const auto distance = [](const Point<3> &p) { return (p - Point<3>(0., 0., -2.)).norm() - std::sqrt(11.); };
  for (const bool tetrahedra : {false, true})
    {
      BodyParameters p = block(tetrahedra);
      // Through the corners of the top.
      p.shapes =
          "top: sphere: (0, 0, -2), sqrt(11); left: plane: (-1, 0, 0), (1, 0, 0); right: plane: (1, 0, 0), "
          "(1, 0, 0); front: plane: (0, -1, 0), (0, 1, 0); back: plane: (0, 1, 0), (0, 1, 0)";
      p.snap = true;
      Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      EXPECT_EQ(bodies.movement().n_damped, 0u);
      for (unsigned int i = 0; i < 3; ++i)
        refine(bodies);
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      EXPECT_LT(largest_on(bodies, space, "top", distance), 1e-10);
      EXPECT_LT(largest_on(bodies, space, "left", [](const Point<3> &x) { return x[0] + 1.; }), 1e-12);
    }
  // With sharp edges the middles of the edges of the top stay where they are.
  for (const bool tetrahedra : {false, true})
    {
      BodyParameters p = block(tetrahedra);
      p.shapes         = "top: sphere: (0, 0, -2), sqrt(11)";
      p.sharp_edges    = "top + left; top + right; top + front; top + back";
      p.snap           = true;
      Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      refine(bodies);
      refine(bodies);
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      EXPECT_LT(largest_on(bodies, space, "top",
                           [&](const Point<3> &x) {
                             const bool on_edge = std::max(std::abs(x[0]), std::abs(x[1])) > 1. - 1e-12;
                             return on_edge ? x[2] - 1. : distance(x);
                           }),
                1e-10);
    }
}



// The rim of a half ball is round, unless it is sharp; on both kinds of cells, without shapes of the
// parameters.
TEST(BoundaryShape, SharpEdgesOfGeneratedMeshes)
{
  for (const bool tetrahedra : {false, true})
    for (const bool is_sharp : {false, true})
      {
        BodyParameters p;
        p.name                  = "body";
        p.mesh                  = "half ball";
        p.convert_to_tetrahedra = tetrahedra;
        if (is_sharp)
          p.sharp_edges = "sphere + top";
        Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
        refine(bodies);
        const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
        const double     off_sphere =
            largest_on(bodies, space, "sphere", [](const Point<3> &x) { return x.norm() - 1.; });
        const double off_inside = largest_on(
            bodies, space, "sphere", [](const Point<3> &x) { return x[2] < -1e-10 ? x.norm() - 1. : 0.; });
        EXPECT_LT(off_inside, 1e-12) << tetrahedra << is_sharp;
        if (is_sharp)
          {
            // The chords of an eighth of the circle at least.
            EXPECT_GT(off_sphere, .01) << tetrahedra;
          }
        else
          {
            EXPECT_LT(off_sphere, 1e-12) << tetrahedra;
          }
      }
}



// A bore, the outside and the flat ends in one boundary: new points of rims lie on both sides of them, and
// the true surface over the facets beside them is that of their own side.
TEST(BoundaryShape, RimsOfOneBoundary)
{
  const TemporaryFile file(tube_file());
  for (const bool tetrahedra : {false, true})
    {
      BodyParameters p;
      p.name                  = "body";
      p.mesh                  = file.path;
      p.convert_to_tetrahedra = tetrahedra;
      Bodies     bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const auto ids = bodies.boundary_ids(0, "skin");
      bodies.follow_start_mesh(0, ids, false);
      SurfaceShapes shapes;
      shapes.by_boundary = bodies.true_shapes(0, ids, false);
      for (unsigned int level = 0; level < 4; ++level)
        {
          if (level > 0)
            refine(bodies);
          const NodalSpace     space(MPI_COMM_WORLD, bodies.mesh());
          const ContactSurface surface = extract_contact_surface(
              space, ids, [](const NodeIndex) { return FixedDirections(); }, {}, shapes);
          double off_vertices = 0., off_between = 0., off_normals = 0.;
          for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
            {
              std::array<Point<3>, 3> x;
              for (unsigned int i = 0; i < 3; ++i)
                x[i] = surface.mesh.vertices[surface.mesh.triangles[t][i]];
              const Tensor<1, 3> n       = cross_product_3d(x[1] - x[0], x[2] - x[0]);
              const bool         is_flat = std::abs(n[2]) > .5 * n.norm();
              const double       radius  = n * Tensor<1, 3>({x[0][0], x[0][1], 0.}) < 0. ? 1. : 2.;
              const auto         off     = [&](const Point<3> &y) {
                return is_flat ? std::abs(std::abs(y[2] - .5) - .5)
                                           : std::abs(std::hypot(y[0], y[1]) - radius);
              };
              for (unsigned int i = 0; i < 3; ++i)
                {
                  off_vertices            = std::max(off_vertices, off(x[i]));
                  std::array<double, 3> w = {{.5, .5, .5}};
                  w[i]                    = 0.;
                  const Point<3> middle((Tensor<1, 3>(x[(i + 1) % 3]) + x[(i + 2) % 3]) / 2.);
                  off_between = std::max(off_between, off(middle + surface.offset(t, w)));
                }
            }
          for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
            if (const Point<3> &x = surface.mesh.vertices[v]; std::abs(std::abs(x[2] - .5) - .5) > 1e-9)
              off_normals = std::max(off_normals, std::abs(surface.mesh.vertex_normals[v][2]));
          EXPECT_LT(off_vertices, 1e-13) << tetrahedra << level;
          // A cubic on each facet; chords of the start mesh are off by 0.04.
          EXPECT_LT(off_between, 2e-4) << tetrahedra << level;
          EXPECT_LT(off_normals, 1e-10) << tetrahedra << level;
        }
    }
}



// A node that would turn a cell over stops before, and says so.
TEST(NodeMovement, NoCellInverts)
{
  std::vector<Point<3>> x      = {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
  const unsigned int    cell[] = {0, 1, 2, 3};
  std::vector<ArrayView<const unsigned int>> cells = {ArrayView<const unsigned int>(cell, 4)};
  std::vector<unsigned int>                  late;
  const std::vector<bool>                    is_fixed(4, true);
  MovementReport report = move_nodes(x, {{3, Point<3>(0, 0, -.5)}}, cells, is_fixed, late);
  EXPECT_EQ(late, std::vector<unsigned int>{3});
  EXPECT_EQ(report.n_damped, 1u);
  EXPECT_GT(x[3][2], 0.);
  EXPECT_GE(report.quality_after, report.quality_before / 3.);
  late.clear();
  report = move_nodes(x, {{3, Point<3>(.1, .1, .9)}}, cells, is_fixed, late);
  EXPECT_TRUE(late.empty());
  EXPECT_EQ(x[3], Point<3>(.1, .1, .9));
}



// Three vertices of the top of a block go down by the height of a cell: they arrive only if the nodes inside
// do more than follow, which two of them did not.
TEST(NodeMovement, NodesInsideGiveWay)
{
  GeneratedMeshParameters parameters;
  parameters.kind         = "block";
  parameters.upper_corner = Point<3>(4., 4., 4.);
  parameters.divisions    = {{4, 4, 4}};
  VolumeMesh        mesh  = split_into_tetrahedra(generate_mesh(parameters).mesh);
  std::vector<bool> is_fixed(mesh.vertices.size(), false);
  for (const auto &face : mesh.faces)
    for (const unsigned int v : face.vertices)
      if (v != VolumeMesh::no_vertex)
        is_fixed[v] = true;
  std::vector<std::pair<unsigned int, Point<3>>> targets;
  for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
    if (const Point<3> x = mesh.vertices[v];
        x[2] > 3.9 && std::abs(x[0] - 2.) < 1.1 && std::abs(x[1] - 2.) < .1)
      targets.emplace_back(v, x - Tensor<1, 3>({0., 0., 1.}));
  ASSERT_EQ(targets.size(), 3u);
  std::vector<ArrayView<const unsigned int>> cells;
  for (const auto &cell : mesh.cells)
    cells.emplace_back(cell.vertices.data(), cell.n_vertices);
  const std::vector<Point<3>> before = mesh.vertices;
  std::vector<unsigned int>   late;
  const MovementReport        report = move_nodes(mesh.vertices, targets, cells, is_fixed, late);
  EXPECT_TRUE(late.empty());
  EXPECT_EQ(report.n_damped, 0u);
  for (const auto &[v, target] : targets)
    EXPECT_EQ(mesh.vertices[v], target);
  EXPECT_GE(report.quality_after, report.quality_before / 3.);
  for (unsigned int v = 0; v < before.size(); ++v)
    if (is_fixed[v] &&
        std::none_of(targets.begin(), targets.end(), [&](const auto &t) { return t.first == v; }))
      {
        EXPECT_EQ(mesh.vertices[v], before[v]);
      }
}



namespace
{
  /// A patch that ends beside the plane y = 0.
  class EndingPatch : public BoundaryShape
  {
  public:
    Point<3> project(const Point<3> &p) const override
    {
      return {p[0], std::max(p[1], 1e-4), 1.};
    }

    Tensor<1, 3> normal(const Point<3> &, const Tensor<1, 3> &facing) const override
    {
      return facing / facing.norm();
    }

    bool is_exact() const override
    {
      return false;
    }
  };
} // namespace



// Alternating projections do not end there. A node on a plane of symmetry stays on it, whatever comes first.
TEST(BoundaryShape, PlanesBesidePatchesThatEnd)
{
  const auto     patch = std::make_shared<const EndingPatch>();
  const auto     plane = make_plane_shape(Point<3>(), Point<3>(0., 1., 0.));
  const Point<3> p(.3, .01, .9);
  for (const auto &shapes :
       {std::vector<BoundaryShapePointer>{patch, plane}, std::vector<BoundaryShapePointer>{plane, patch}})
    EXPECT_EQ(project_onto(shapes, p), Point<3>(.3, 0., 1.));
}

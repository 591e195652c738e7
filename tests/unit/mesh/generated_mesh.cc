// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/discretization/element.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/coarser_meshes.h>
#include <signorini/mesh/generated_mesh.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>

#include <gtest/gtest.h>

using namespace dealii;
using namespace Signorini;

namespace
{
  struct Shape
  {
    const char *kind;
    double      volume;
    /// Boundary and its area.
    std::vector<std::pair<const char *, double>> areas;
  };

  BodyParameters body(const std::string &kind)
  {
    BodyParameters p;
    p.name         = "body";
    p.mesh         = kind;
    p.radius       = 2.;
    p.inner_radius = 1.;
    p.height       = 3.;
    p.upper_corner = Point<3>(1, 2, 3);
    p.divisions    = {1, 2, 2};
    p.corners      = "(0, 0); (2, 0); (1, 2)";
    return p;
  }

  double volume(const NodalSpace &space)
  {
    double sum = 0.;
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        sum += Element(space, cell).volume();
    return Utilities::MPI::sum(sum, space.communicator());
  }

  double area(const Bodies &bodies, const std::string &boundary)
  {
    const auto ids = bodies.boundary_ids(0, boundary);
    double     sum = 0.;
    for (const auto &cell : bodies.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
            sum +=
                .5 *
                cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1)).norm();
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  class GeneratedMeshes : public testing::TestWithParam<Shape>
  {
  };
} // namespace



TEST_P(GeneratedMeshes, HaveVolumesAndAreasThatConverge)
{
  const Shape shape = GetParam();
  Bodies      bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body(shape.kind)}, "."));
  double      last = 0.;
  for (unsigned int level = 0; level < 3; ++level)
    {
      if (level > 0)
        bodies.triangulation().refine_global(1);
      for (const auto &cell : bodies.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            std::array<Point<3>, 8> corners;
            double                  shortest = 1e300, longest = 0.;
            for (unsigned int v = 0; v < 8; ++v)
              corners[v] = cell->vertex(v);
            for (unsigned int l = 0; l < 12; ++l)
              {
                const double length = corners[GeometryInfo<3>::line_to_cell_vertices(l, 0)].distance(
                    corners[GeometryInfo<3>::line_to_cell_vertices(l, 1)]);
                shortest = std::min(shortest, length);
                longest  = std::max(longest, length);
              }
            EXPECT_GT(scaled_jacobian(corners), .2) << shape.kind;
            EXPECT_LT(longest, 4. * shortest) << shape.kind;
          }
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      const double     error = std::abs(volume(space) / shape.volume - 1.);
      if (level > 0)
        {
          // Chords: second order.
          EXPECT_LE(error, std::max(.35 * last, 1e-12)) << shape.kind;
        }
      last = error;
    }
  EXPECT_LT(last, .02);
  for (const auto &[boundary, exact] : shape.areas)
    EXPECT_NEAR(area(bodies, boundary) / exact, 1., .02) << shape.kind << ", " << boundary;
  EXPECT_THROW(bodies.boundary_ids(0, "lid"), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    All, GeneratedMeshes,
    testing::Values(
        Shape{"block",
              6.,
              {{"left", 6.}, {"right", 6.}, {"front", 3.}, {"back", 3.}, {"bottom", 2.}, {"top", 2.}}},
        Shape{"ball", 32. / 3. * M_PI, {{"sphere", 16. * M_PI}}},
        Shape{"half ball", 16. / 3. * M_PI, {{"sphere", 8. * M_PI}, {"top", 4. * M_PI}}},
        Shape{"quarter of ball",
              8. / 3. * M_PI,
              {{"sphere", 4. * M_PI}, {"symmetry x", 2. * M_PI}, {"symmetry y", 2. * M_PI}}},
        Shape{"quarter of half ball",
              4. / 3. * M_PI,
              {{"sphere", 2. * M_PI}, {"top", M_PI}, {"symmetry x", M_PI}, {"symmetry y", M_PI}}},
        Shape{"eighth of ball", 4. / 3. * M_PI, {{"sphere", 2. * M_PI}, {"symmetry z", M_PI}}},
        Shape{"cylinder", 12. * M_PI, {{"side", 12. * M_PI}, {"top", 4. * M_PI}, {"bottom", 4. * M_PI}}},
        Shape{"quarter of cylinder",
              3. * M_PI,
              {{"side", 3. * M_PI}, {"top", M_PI}, {"symmetry x", 6.}, {"symmetry y", 6.}}},
        Shape{"tube",
              9. * M_PI,
              {{"outer", 12. * M_PI}, {"inner", 6. * M_PI}, {"start", 3. * M_PI}, {"end", 3. * M_PI}}},
        Shape{"half tube", 4.5 * M_PI, {{"outer", 6. * M_PI}, {"start", 1.5 * M_PI}, {"symmetry y", 6.}}},
        Shape{"quarter of tube",
              2.25 * M_PI,
              {{"outer", 3. * M_PI}, {"inner", 1.5 * M_PI}, {"symmetry x", 3.}, {"symmetry y", 3.}}},
        Shape{"half cylinder",
              6. * M_PI,
              {{"outer", 6. * M_PI}, {"flat", 12.}, {"start", 2. * M_PI}, {"end", 2. * M_PI}}},
        Shape{"half of half cylinder",
              3. * M_PI,
              {{"outer", 3. * M_PI}, {"flat", 6.}, {"end", M_PI}, {"symmetry x", 6.}}},
        Shape{"prism",
              6.,
              {{"side 1", 6.}, {"side 2", 3. * std::sqrt(5.)}, {"side 3", 3. * std::sqrt(5.)}, {"end", 2.}}},
        Shape{"spherical shell", 28. / 3. * M_PI, {{"outer", 16. * M_PI}, {"inner", 4. * M_PI}}},
        Shape{"eighth of spherical shell", 7. / 6. * M_PI, {{"outer", 2. * M_PI}, {"inner", .5 * M_PI}}}));



TEST(GeneratedMesh, RefusesSizesThatMakeNoSense)
{
  BodyParameters p = body("ball");
  p.radius         = 0.;
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, ".")), InputError);
  p           = body("block");
  p.divisions = {1, 0, 1};
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, ".")), InputError);
  p              = body("spherical shell");
  p.inner_radius = 3.;
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, ".")), InputError);
}



namespace
{
  void refine_near_pole(Bodies &bodies)
  {
    bodies.triangulation().refine_global(1);
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (const auto &cell : bodies.triangulation().active_cell_iterators())
          if (cell->is_locally_owned() && cell->center().distance(Point<3>(0., 0., -2.)) < 1.2 / (i + 1))
            cell->set_refine_flag();
        bodies.triangulation().execute_coarsening_and_refinement();
      }
  }
} // namespace



// The same cells as deal.II's own sequence, on every level.
TEST(CoarseningSequence, HasTheMeshesOfDealII)
{
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body("half ball")}, "."));
  refine_near_pole(bodies);
  CoarseningSequence                                                sequence(bodies.triangulation());
  std::vector<std::unique_ptr<CoarseningSequence::DistributedMesh>> ours;
  while (sequence.coarsen())
    ours.push_back(sequence.mesh());
  std::reverse(ours.begin(), ours.end());
  const auto expected =
      MGTransferGlobalCoarseningTools::create_geometric_coarsening_sequence(bodies.triangulation());
  ASSERT_EQ(ours.size() + 1, expected.size());
  for (std::size_t l = 0; l < ours.size(); ++l)
    {
      EXPECT_EQ(ours[l]->n_global_active_cells(), expected[l]->n_global_active_cells()) << "level " << l;
      const auto centres = [](const Triangulation<3> &mesh) {
        std::vector<std::pair<std::string, double>> mine;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            mine.emplace_back(cell->id().to_string(), cell->center().norm());
        std::vector<std::pair<std::string, double>> all;
        for (const auto &part : gather_values(mine, MPI_COMM_WORLD))
          all.insert(all.end(), part.begin(), part.end());
        std::sort(all.begin(), all.end());
        return all;
      };
      const auto a = centres(*ours[l]), b = centres(*expected[l]);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          EXPECT_EQ(a[i].first, b[i].first);
          EXPECT_NEAR(a[i].second, b[i].second, 1e-12);
        }
    }
}



// Levels that come up again after a refinement are those of before; the others are as if built anew.
TEST(CoarserSpaces, KnowsTheLevelsOfTheLastMesh)
{
  Bodies        bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body("half ball")}, "."));
  CoarserSpaces remembering;
  const auto    space_of = [&] { return std::make_shared<const NodalSpace>(MPI_COMM_WORLD, bodies.mesh()); };
  refine_near_pole(bodies);
  const auto before = remembering.update(bodies, space_of());
  const auto finest = space_of();
  bodies.refine(*finest, std::vector<bool>(finest->cells().size(), true));
  const auto after = remembering.update(bodies, space_of());
  const auto anew  = CoarserSpaces().update(bodies, space_of());
  ASSERT_EQ(after.size(), before.size() + 1);
  ASSERT_EQ(after.size(), anew.size());
  for (std::size_t l = 0; l < before.size(); ++l)
    EXPECT_EQ(after[l], before[l]) << "level " << l;
  for (std::size_t l = 0; l < after.size(); ++l)
    {
      // The order of cells and nodes may differ.
      using Corners      = std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<Point<3>>>;
      const auto corners = [](const NodalSpace &space) {
        Corners result;
        for (const NodalSpace::Cell &cell : space.cells())
          for (const NodeIndex node : space.nodes(cell))
            result[{cell.coarse_cell, cell.path}].push_back(space.position(node));
        return result;
      };
      const Corners a = corners(*after[l]), b = corners(*anew[l]);
      ASSERT_EQ(a.size(), b.size()) << "level " << l;
      for (const auto &[cell, points] : a)
        {
          ASSERT_EQ(b.count(cell), 1u);
          for (std::size_t v = 0; v < points.size(); ++v)
            EXPECT_LT(points[v].distance(b.at(cell)[v]), 1e-12);
        }
    }
}



// Node positions follow the sphere and survive refinement and repartitioning.
TEST(NodalSpace, NodesLieOnTheSphere)
{
  Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body("half ball")}, "."));
  refine_near_pole(bodies);
  const NodalSpace                   space(MPI_COMM_WORLD, bodies.mesh());
  const std::set<types::boundary_id> sphere    = bodies.boundary_ids(0, "sphere");
  unsigned int                       n_hanging = 0;
  for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
    if (const NodalSpace::Cell &cell = space.cells()[face.cell]; cell.is_owned && sphere.count(face.id) > 0)
      for (const unsigned int v : CellShape::face(8, face.face))
        {
          const NodeIndex node = space.nodes(cell)[v];
          if (space.hanging_nodes().is_constrained(node))
            {
              // Without cracks: at the mean of the parents.
              Point<3> mean;
              for (const auto &[parent, weight] : *space.hanging_nodes().get_constraint_entries(node))
                mean += weight * space.position(parent);
              EXPECT_LT(mean.distance(space.position(node)), 1e-14);
              ++n_hanging;
            }
          else
            {
              EXPECT_NEAR(space.position(node).norm(), 2., 1e-14);
            }
        }
  EXPECT_GT(Utilities::MPI::sum(n_hanging, MPI_COMM_WORLD), 0u);
}



namespace
{
  /// Volume of the largest cell / volume of the smallest.
  double ratio_of_volumes(const NodalSpace &space)
  {
    double least = 1e300, largest = 0.;
    for (const NodalSpace::Cell &cell : space.cells())
      {
        const double v = Element(space, cell).volume();
        least          = std::min(least, v);
        largest        = std::max(largest, v);
      }
    return Utilities::MPI::max(largest, MPI_COMM_WORLD) / Utilities::MPI::min(least, MPI_COMM_WORLD);
  }
} // namespace



TEST(GeneratedMesh, AnnuliAreSlabsOfOneLayer)
{
  const std::vector<std::pair<const char *, double>> kinds = {
      {"annulus", 2. * M_PI}, {"half annulus", M_PI}, {"quarter of annulus", .5 * M_PI}};
  for (const auto &[kind, angle] : kinds)
    {
      BodyParameters p  = body(kind);
      p.round_divisions = {4, 24, 0};
      const Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      EXPECT_EQ(bodies.triangulation().n_global_active_cells(), 96u) << kind;
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      EXPECT_NEAR(volume(space) / (4.5 * angle), 1., .02) << kind;
      EXPECT_NEAR(area(bodies, "start") / (1.5 * angle), 1., .02) << kind;
    }
}



TEST(GeneratedMesh, NewVerticesLieOnTheTrueGeometry)
{
  for (const char *kind : {"tube", "half tube", "half cylinder", "half of half cylinder"})
    {
      BodyParameters p = body(kind);
      p.rotation_axis  = Tensor<1, 3>({1., 0., 0.});
      p.rotation_angle = 90.;
      p.translation    = Tensor<1, 3>({0., 5., 1.});
      Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      bodies.triangulation().refine_global(2);
      for (const std::string name : {"outer", "inner"})
        {
          if (name == "inner" && p.mesh.find("tube") == std::string::npos)
            continue;
          const auto ids = bodies.boundary_ids(0, name);
          for (const auto &cell : bodies.triangulation().active_cell_iterators())
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
                {
                  for (unsigned int v = 0; v < 4; ++v)
                    EXPECT_NEAR(std::hypot(face->vertex(v)[0], face->vertex(v)[2] - 1.),
                                name == "outer" ? 2. : 1., 1e-12)
                        << kind;
                }
        }
    }
}



TEST(GeneratedMesh, SeveralBoundariesAsOne)
{
  const Bodies                 block(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body("block")}, "."));
  std::set<types::boundary_id> both = block.boundary_ids(0, "left");
  both.merge(block.boundary_ids(0, "top"));
  both.merge(block.boundary_ids(0, "+x"));
  EXPECT_EQ(both.size(), 3u);
  EXPECT_EQ(block.boundary_ids(0, "left +  top + +x"), both);
  for (const char *wrong : {"left + lid", "left + ", " + left", "left +"})
    EXPECT_THROW(block.boundary_ids(0, wrong), InputError) << wrong;
}



TEST(GeneratedMesh, DirectionsNameBoundariesWhereTheBodyIs)
{
  BodyParameters p = body("half cylinder");
  p.rotation_axis  = Tensor<1, 3>({1., 0., 0.});
  p.rotation_angle = 90.;
  const Bodies lying(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  EXPECT_EQ(lying.boundary_ids(0, "+z"), lying.boundary_ids(0, "flat"));
  EXPECT_EQ(lying.boundary_ids(0, "+y"), lying.boundary_ids(0, "start"));
  EXPECT_EQ(lying.boundary_ids(0, "-y"), lying.boundary_ids(0, "end"));
  for (const char *none : {"-z", "+x", "x", "+w", "+"})
    EXPECT_THROW(lying.boundary_ids(0, none), InputError) << none;
  p                = body("block");
  p.rotation_axis  = Tensor<1, 3>({0., 0., 1.});
  p.rotation_angle = 90.;
  const Bodies block(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  EXPECT_EQ(block.boundary_ids(0, "+y"), block.boundary_ids(0, "right"));
  EXPECT_EQ(block.boundary_ids(0, "-x"), block.boundary_ids(0, "back"));
}



TEST(GeneratedMesh, GradingHasTheRatioAndKeepsTheShape)
{
  const std::vector<std::pair<const char *, const char *>> kinds = {{"block", "(0, 0, 3)"},
                                                                    {"block", "top"},
                                                                    {"tube", "outer"},
                                                                    {"quarter of tube", "(1, 0, 0)"},
                                                                    {"half cylinder", "(0, -2, 0)"},
                                                                    {"half of half cylinder", "outer"},
                                                                    {"prism", "(0, 0, 0)"}};
  for (const auto &[kind, towards] : kinds)
    {
      BodyParameters p  = body(kind);
      p.divisions       = {8, 8, 8};
      p.round_divisions = {8, 16, 2};
      const Bodies     ungraded(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const NodalSpace even(MPI_COMM_WORLD, ungraded.mesh());
      p.grading = std::string(towards) + ", 10";
      const Bodies     graded(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const NodalSpace space(MPI_COMM_WORLD, graded.mesh());
      EXPECT_NEAR(volume(space) / volume(even), 1., .02) << kind;
      EXPECT_GT(ratio_of_volumes(space), 2. * ratio_of_volumes(even)) << kind << ", " << towards;
    }
}



TEST(GeneratedMesh, RefusesWhatItCannotMake)
{
  const auto refused = [](const char *kind, const auto &change) {
    BodyParameters p = body(kind);
    change(p);
    EXPECT_THROW(define_bodies(MPI_COMM_WORLD, {p}, "."), InputError) << kind;
  };
  refused("tube", [](BodyParameters &p) { p.inner_radius = 2.; });
  refused("tube", [](BodyParameters &p) { p.round_divisions = {1, 2, 1}; });
  refused("tube", [](BodyParameters &p) { p.grading = "top, 2"; });
  refused("tube", [](BodyParameters &p) { p.grading = "inner, 0.5"; });
  refused("ball", [](BodyParameters &p) { p.grading = "sphere, 2"; });
  refused("block", [](BodyParameters &p) { p.grading = "inner, 2"; });
  refused("block", [](BodyParameters &p) { p.grading = "top"; });
  refused("half cylinder", [](BodyParameters &p) { p.round_divisions = {1, 3, 1}; });
  refused("prism", [](BodyParameters &p) { p.corners = "(0, 0); (1, 0)"; });
  refused("prism", [](BodyParameters &p) { p.corners = "(0, 0); (1, 2); (2, 0)"; });
  refused("prism", [](BodyParameters &p) { p.corners = "(0, 0); (2, 0); (2, 2); (1.9, 0.1)"; });
  refused("prism", [](BodyParameters &p) { p.corners = "0, 0"; });
  refused("block", [](BodyParameters &p) { p.divisions = {1000, 1000, 1000}; });
}



TEST(GeneratedMesh, GradedPlacesHaveTheRatio)
{
  for (const double centre : {0., 1., .3})
    {
      const auto x        = graded_places(200, centre, 10.);
      double     shortest = 1., longest = 0.;
      for (unsigned int i = 0; i < 200; ++i)
        {
          shortest = std::min(shortest, x[i + 1] - x[i]);
          longest  = std::max(longest, x[i + 1] - x[i]);
        }
      EXPECT_NEAR(longest / shortest, 10., .3);
      EXPECT_EQ(x.front(), 0.);
      EXPECT_EQ(x.back(), 1.);
    }
  const auto even = graded_places(4, .5, 1.);
  for (unsigned int i = 0; i <= 4; ++i)
    EXPECT_NEAR(even[i], .25 * i, 1e-15);
}

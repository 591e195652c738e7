// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/exact_error.h>
#include <signorini/discretization/hexahedron.h>
#include <signorini/discretization/load_definition.h>
#include <signorini/discretization/nodal_stress.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/nodal_space.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

// The mean of the normal stresses is the bulk modulus times the change of volume of the cells around a node.
TEST(NodalStress, OfTheMeanDilatation)
{
  BodyParameters p;
  p.name    = "ball";
  p.mesh    = "ball";
  p.young   = 3.;
  p.poisson = .45;
  for (const bool mean : {false, true})
    {
      p.element = mean ? ElementChoice::mean_dilatation : ElementChoice::standard;
      const Bodies     bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      const auto       field = [](const Point<3> &x) {
        return Vector3({std::sin(3. * x[1] + x[2]), x[0] * x[1], std::cos(5. * x[0]) - x[2] * x[2]});
      };
      std::vector<double> u, volume(space.n_nodes(), 0.), change(space.n_nodes(), 0.);
      for (const NodeIndex node : space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.push_back(field(space.position(node))[c]);
      for (const NodalSpace::Cell &cell : space.cells())
        for (unsigned int q = 0; q < 8; ++q)
          {
            // The volume is a cubic polynomial of the displacement.
            double element[3];
            for (const int side : {-1, 0, 1})
              {
                Hexahedron::Corners x;
                for (unsigned int v = 0; v < 8; ++v)
                  {
                    const Point<3> &corner = space.position(space.nodes(cell)[v]);
                    x[v]                   = corner + 1e-4 * side * field(corner);
                  }
                element[side + 1] = Hexahedron::volume_element(x, q).first;
              }
            for (const NodeIndex node : space.nodes(cell))
              {
                volume[node] += element[1];
                change[node] += (element[2] - element[0]) / 2e-4;
              }
          }
      const Loads loads;
      const auto  stress =
          NodalStress({bodies, loads, space, evaluate_dirichlet(space, loads, false).fixed, u}).values();
      double worst = 0., largest = 0.;
      for (const NodeIndex node : space.owned())
        {
          const auto  &s        = stress[space.relevant().index_within_set(node)];
          const double expected = p.young / (3. * (1. - 2. * p.poisson)) * change[node] / volume[node];
          worst                 = std::max(worst, std::abs((s[0] + s[1] + s[2]) / 3. - expected));
          largest               = std::max(largest, std::abs(expected));
        }
      if (mean)
        {
          EXPECT_LE(worst, 1e-6 * largest);
        }
      else if (largest > 0.)
        {
          EXPECT_GT(worst, 1e-3 * largest);
        }
    }
}



namespace
{
  /// A block with a displacement at its nodes.
  struct DisplacedBlock
  {
    Bodies              bodies;
    Loads               loads;
    NodalSpace          space;
    DirichletData       dirichlet;
    std::vector<double> u;

    DisplacedBlock(const std::vector<unsigned int> &divisions, const bool tetrahedra,
                   const VectorField &field)
      : DisplacedBlock(parameters(divisions, tetrahedra), {}, field)
    {
    }

    /// @param refined what is refined once, by the middle of the cell; may be empty
    DisplacedBlock(const BodyParameters &block, const LoadParameters &held, const VectorField &field,
                   const std::function<bool(const Point<3> &)> &refined = {})
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {block}, "."))
      , loads(loads_on(bodies, held))
      , space(MPI_COMM_WORLD, refine(bodies, refined).mesh())
      , dirichlet(evaluate_dirichlet(space, loads, false))
    {
      for (const NodeIndex node : space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.push_back(field(space.position(node))[c]);
    }

    static BodyParameters parameters(const std::vector<unsigned int> &divisions, const bool tetrahedra)
    {
      BodyParameters p;
      p.name                  = "block";
      p.mesh                  = "block";
      p.divisions             = divisions;
      p.young                 = 2.;
      p.poisson               = .3;
      p.convert_to_tetrahedra = tetrahedra;
      return p;
    }

    static Loads loads_on(const Bodies &bodies, const LoadParameters &held)
    {
      Loads loads;
      loads.add(bodies, 0, held.definition(""));
      return loads;
    }

    static const Bodies &refine(Bodies &bodies, const std::function<bool(const Point<3> &)> &refined)
    {
      if (refined)
        for (const auto &cell : bodies.triangulation().active_cell_iterators())
          if (cell->is_locally_owned() && refined(cell->center()))
            cell->set_refine_flag();
      if (refined)
        bodies.triangulation().execute_coarsening_and_refinement();
      return bodies;
    }

    StressedBodies stressed() const
    {
      return {bodies, loads, space, dirichlet.fixed, u};
    }

    /// At the owned nodes, by position.
    std::vector<std::pair<Point<3>, StressComponents>> nodal() const
    {
      std::vector<std::pair<Point<3>, StressComponents>> result;
      const auto                                         stress = NodalStress(stressed()).values();
      for (const NodeIndex node : space.owned())
        result.emplace_back(space.position(node), stress[space.relevant().index_within_set(node)]);
      return result;
    }
  };
} // namespace



// The stress of a linear displacement is the same everywhere.
TEST(NodalStress, OfALinearDisplacement)
{
  for (const bool tetrahedra : {false, true})
    {
      const DisplacedBlock block({3, 2, 4}, tetrahedra, [](const Point<3> &x) {
        return Vector3({.1 * x[0] + .2 * x[1], .05 * x[2], -.3 * x[2] + .1 * x[0]});
      });
      // lambda tr(eps) I + 2 mu eps.
      const Material        &m        = block.bodies.material(0);
      const StressComponents expected = {{-.2 * m.lambda() + .2 * m.mu(), -.2 * m.lambda(),
                                          -.2 * m.lambda() - .6 * m.mu(), .2 * m.mu(), .05 * m.mu(),
                                          .1 * m.mu()}};
      for (const StressComponents &s : NodalStress(block.stressed()).values())
        for (unsigned int c = 0; c < 6; ++c)
          EXPECT_NEAR(s[c], expected[c], 1e-13);
      EXPECT_LE(NodalStress(block.stressed()).errors()[0].relative(), 1e-13);
    }
}



// One layer of hexahedra that is bent: at its surfaces the stress is that of the surfaces, not that of the
// middle, which is none.
TEST(NodalStress, OfABentLayer)
{
  const DisplacedBlock block({6, 1, 1}, false, [](const Point<3> &x) {
    return Vector3({x[0] * (x[2] - .5), 0., -.5 * x[0] * x[0]});
  });
  const Material      &m      = block.bodies.material(0);
  const auto           stress = NodalStress(block.stressed()).values();
  for (const NodeIndex node : block.space.relevant())
    EXPECT_NEAR(stress[block.space.relevant().index_within_set(node)][0],
                (m.lambda() + 2. * m.mu()) * (block.space.position(node)[2] - .5), 1e-13);
}



// The estimate against the distance of the stress of the cells from that of the function that was
// interpolated.
TEST(NodalStress, EstimateAgainstTheErrorOfAnInterpolation)
{
  for (const bool tetrahedra : {false, true})
    {
      const auto field = [](const Point<3> &x) {
        return Vector3({std::sin(2. * x[1] + x[2]), .3 * x[0] * x[0], std::cos(3. * x[0])});
      };
      const DisplacedBlock block({12, 12, 12}, tetrahedra, field);
      const NodePartition  partition(block.space.owned(), block.space.relevant(), MPI_COMM_WORLD);
      Vector               u;
      partition.reinit(u);
      for (const NodeIndex node : block.space.relevant())
        for (unsigned int c = 0; c < dim; ++c)
          u.local_element(dim * partition.to_local(node) + c) = field(block.space.position(node))[c];
      const ExactError exact =
          compute_exact_error(block.bodies, block.loads, block.space, partition, u, {0, field});
      const StressError estimate = NodalStress(block.stressed()).errors()[0];
      EXPECT_NEAR(estimate.error / exact.energy, 1., .06) << (tetrahedra ? "tetrahedra" : "hexahedra");
      EXPECT_NEAR(estimate.relative(), exact.energy / exact.energy_norm, .06 * estimate.relative());
    }
}



namespace
{
  /// [0,1]^3, of which three sides are planes of symmetry; a displacement with these symmetries.
  const char *const eighth = "left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)";

  Vector3 symmetric_field(const Point<3> &x)
  {
    return Vector3({x[0] * (1. + .3 * std::cos(2. * x[1]) - .5 * x[2] * x[2]),
                    std::sin(x[1]) * (x[0] * x[0] - .4 * std::cos(x[2])),
                    x[2] * x[2] * x[2] * (.2 + x[0] * x[0]) - .3 * x[2] * std::cos(3. * x[1])});
  }

  /// The shear on the side x = 0, and what is left of it there.
  double largest_shear(const DisplacedBlock &block, const std::vector<unsigned int> &components)
  {
    double largest = 0.;
    for (const auto &[x, s] : block.nodal())
      if (x[0] == 0.)
        for (const unsigned int c : components)
          largest = std::max(largest, std::abs(s[c]));
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }
} // namespace



// What is cut off by symmetry planes has the stress and the estimate of the whole, with hanging nodes too.
TEST(NodalStress, OfAnEighthIsThatOfTheWhole)
{
  LoadParameters held;
  held.dirichlet               = eighth;
  BodyParameters whole         = DisplacedBlock::parameters({6, 6, 6}, false);
  whole.lower_corner           = Point<3>(-1., -1., -1.);
  const auto           refined = [](const Point<3> &x) { return std::abs(x[0]) < .4 && std::abs(x[1]) < .7; };
  const DisplacedBlock part(DisplacedBlock::parameters({3, 3, 3}, false), held, symmetric_field, refined);
  const DisplacedBlock all(whole, {}, symmetric_field, refined);
  EXPECT_LT(part.space.n_conforming_nodes(), part.space.n_nodes());
  const auto expected = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, all.nodal());
  for (const auto &[x, s] : part.nodal())
    {
      double distance = 1.;
      for (const auto &nodes : expected)
        for (const auto &[y, t] : nodes)
          if (x.distance(y) < 1e-9)
            {
              distance = 0.;
              for (unsigned int c = 0; c < 6; ++c)
                distance = std::max(distance, std::abs(s[c] - t[c]));
            }
      EXPECT_LE(distance, 1e-13) << x;
    }
  const StressError of_part = NodalStress(part.stressed()).errors()[0],
                    of_all  = NodalStress(all.stressed()).errors()[0];
  EXPECT_NEAR(std::sqrt(8.) * of_part.error / of_all.error, 1., 1e-12);
  EXPECT_NEAR(of_part.relative() / of_all.relative(), 1., 1e-12);
}



// A turned block: one of its planes lies across no axis of coordinates.
TEST(NodalStress, OfATurnedQuarter)
{
  BodyParameters turned          = DisplacedBlock::parameters({3, 3, 3}, false);
  turned.rotation_axis           = Vector3({0., 0., 1.});
  turned.rotation_angle          = 25.;
  const double cosine            = std::cos(25. * dealii::numbers::PI / 180.),
               sine              = std::sin(25. * dealii::numbers::PI / 180.);
  const VectorField turned_field = [&](const Point<3> &x) {
    const Vector3 u =
        symmetric_field(Point<3>(cosine * x[0] + sine * x[1], -sine * x[0] + cosine * x[1], x[2]));
    return Vector3({cosine * u[0] - sine * u[1], sine * u[0] + cosine * u[1], u[2]});
  };
  LoadParameters held, turned_held;
  held.dirichlet        = "left: (0, *, *); bottom: (*, *, 0)";
  turned_held.dirichlet = "left: (normal: 0); bottom: (*, *, 0)";
  const DisplacedBlock straight(DisplacedBlock::parameters({3, 3, 3}, false), held, symmetric_field);
  const DisplacedBlock block(turned, turned_held, turned_field);
  const DisplacedBlock unknown(DisplacedBlock::parameters({3, 3, 3}, false), {}, symmetric_field);
  const auto error = [](const DisplacedBlock &b) { return NodalStress(b.stressed()).errors()[0].error; };
  EXPECT_NEAR(error(block) / error(straight), 1., 1e-12);
  EXPECT_GT(std::abs(error(unknown) / error(straight) - 1.), 1e-4);
}



namespace
{
  /// A body and its displacement turned about an axis through the origin; its sides are held along their
  /// normals.
  DisplacedBlock turned_block(BodyParameters parameters, const std::string &sides, const Vector3 &axis,
                              const double degrees)
  {
    const Vector3 a           = axis / axis.norm();
    parameters.rotation_axis  = axis;
    parameters.rotation_angle = degrees;
    const auto turn           = [a](const Vector3 &v, const double angle) {
      return std::cos(angle) * v + std::sin(angle) * cross_product_3d(a, v) +
             (1. - std::cos(angle)) * (a * v) * a;
    };
    const double      angle = degrees * dealii::numbers::PI / 180.;
    const VectorField field = [=](const Point<3> &x) {
      return turn(symmetric_field(Point<3>(turn(Vector3(x), -angle))), angle);
    };
    LoadParameters held;
    held.dirichlet = sides;
    return DisplacedBlock(parameters, held, field);
  }

  /// By owned node, in the order of the mesh.
  std::vector<double> von_mises_of(const DisplacedBlock &block)
  {
    std::vector<double> result;
    for (const auto &[x, s] : block.nodal())
      result.push_back(von_mises(s));
    return result;
  }
} // namespace



// Planes of symmetry that meet, orthogonal or not, say the same in any frame.
TEST(NodalStress, WherePlanesMeetInAnyFrame)
{
  BodyParameters block  = DisplacedBlock::parameters({3, 3, 3}, false);
  BodyParameters prism  = block;
  prism.mesh            = "prism";
  prism.corners         = "(0, 0); (1, 0); (0.5, 0.8660254037844386)";
  prism.round_divisions = {3, 2, 3};
  const std::vector<std::pair<BodyParameters, std::string>> problems = {
      {block, "left: (normal: 0); front: (normal: 0)"},
      {block, "left: (normal: 0); front: (normal: 0); bottom: (normal: 0)"},
      {prism, "side 1: (normal: 0); side 3: (normal: 0); start: (normal: 0)"}};
  for (const auto &[body, sides] : problems)
    {
      const std::vector<double> straight = von_mises_of(turned_block(body, sides, Vector3({0., 0., 1.}), 0.));
      for (const auto &[axis, angle] : {std::pair<Vector3, double>{Vector3({0., 0., 1.}), 25.},
                                        std::pair<Vector3, double>{Vector3({0., 0., 1.}), -30.},
                                        std::pair<Vector3, double>{Vector3({1., -2., 3.}), 40.}})
        {
          const std::vector<double> turned = von_mises_of(turned_block(body, sides, axis, angle));
          ASSERT_EQ(turned.size(), straight.size());
          for (std::size_t i = 0; i < turned.size(); ++i)
            EXPECT_NEAR(turned[i], straight[i], 1e-12) << sides << ", " << angle << " degrees, node " << i;
        }
    }
}

// Where two planes meet that are not orthogonal no direction across their line is another one.
TEST(NodalStress, WhereObliquePlanesMeet)
{
  BodyParameters prism  = DisplacedBlock::parameters({3, 3, 3}, false);
  prism.round_divisions = {3, 2, 3};
  prism.mesh            = "prism";
  prism.corners         = "(0, 0); (1, 0); (0.5, 0.8660254037844386)";
  const DisplacedBlock block =
      turned_block(prism, "side 1: (normal: 0); side 3: (normal: 0)", Vector3({0., 0., 1.}), 0.);
  unsigned int n = 0;
  for (const auto &[x, s] : block.nodal())
    if (std::hypot(x[0], x[1]) < 1e-10)
      {
        ++n;
        EXPECT_NEAR(s[0], s[1], 1e-14);
        for (unsigned int c = 3; c < 6; ++c)
          EXPECT_NEAR(s[c], 0., 1e-14);
      }
  EXPECT_GT(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 0u);
}



// Where a side is held across its normal, or loaded, there may be shear.
TEST(NodalStress, ShearOfASideThatIsHeldOrLoaded)
{
  const BodyParameters parameters = DisplacedBlock::parameters({3, 3, 3}, false);
  const auto           shear      = [&](const std::string &conditions, const std::string &tractions,
                         const std::vector<unsigned int> &components) {
    LoadParameters p;
    p.dirichlet = conditions;
    p.tractions = tractions;
    return largest_shear(DisplacedBlock(parameters, p, symmetric_field), components);
  };
  const double xy = shear("", "", {3}), zx = shear("", "", {5});
  EXPECT_GT(xy, .01);
  EXPECT_GT(zx, .01);
  EXPECT_EQ(shear("left: (0, *, *)", "", {3, 5}), 0.);
  EXPECT_EQ(shear("left: (*, 0, *)", "", {3}), xy);
  EXPECT_EQ(shear("left: (0, 0, *)", "", {3}), xy);
  EXPECT_EQ(shear("left: (0, 0, *)", "", {5}), 0.);
  EXPECT_EQ(shear("left: (0, *, *)", "left: (0, 1, 0)", {3}), xy);
  // Where a clamped side begins the plane of symmetry is still one.
  EXPECT_EQ(shear("left: (0, *, *); bottom: (0, 0, 0)", "", {3, 5}), 0.);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/mesh/body_parameters.h>

#include "../mesh/mesh_file.h"

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

namespace
{
  /// A ball of distorted hexahedra, nearly incompressible.
  struct Ball
  {
    Bodies        bodies;
    NodalSpace    space;
    NodePartition partition;

    explicit Ball(const ElementChoice element)
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {parameters(element)}, "."))
      , space(refined(bodies), bodies.mesh(), true)
      , partition(space.owned(), space.relevant(), MPI_COMM_WORLD)
    {
    }

    static BodyParameters parameters(const ElementChoice element, const double poisson = .49)
    {
      BodyParameters p;
      p.name    = "ball";
      p.mesh    = "ball";
      p.young   = 3.;
      p.poisson = poisson;
      p.element = element;
      return p;
    }

    static MPI_Comm refined(Bodies &bodies)
    {
      bodies.triangulation().refine_global(1);
      return MPI_COMM_WORLD;
    }

    template <typename Field>
    Vector nodal(const Field &field) const
    {
      Vector u;
      partition.reinit(u);
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        {
          const Vector3 value = field(space.position(partition.to_global(i)));
          for (unsigned int c = 0; c < dim; ++c)
            u.local_element(3 * i + c) = value[c];
        }
      u.update_ghost_values();
      return u;
    }
  };

  Vector3 linear(const Point<3> &x)
  {
    return Point<3>(.1 * x[0] - .2 * x[1], .3 * x[2], .4 * x[0] + .5 * x[2]);
  }

  Vector3 wild(const Point<3> &x)
  {
    return Point<3>(std::sin(3. * x[1] + x[2]), x[0] * x[1], std::cos(5. * x[0]) - x[2] * x[2]);
  }

  bool has_mean_dilatation(const BodyParameters &p)
  {
    const Bodies bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
    const auto   ids = bodies.material_ids(0);
    return std::any_of(ids.begin(), ids.end(),
                       [&](const auto id) { return bodies.material(id).mean_dilatation; });
  }
} // namespace



TEST(MeanDilatation, WhereItIs)
{
  EXPECT_FALSE(has_mean_dilatation(Ball::parameters(ElementChoice::automatic, .3)));
  EXPECT_FALSE(has_mean_dilatation(Ball::parameters(ElementChoice::automatic, .4)));
  EXPECT_TRUE(has_mean_dilatation(Ball::parameters(ElementChoice::automatic, .41)));
  EXPECT_FALSE(has_mean_dilatation(Ball::parameters(ElementChoice::standard, .49)));
  EXPECT_TRUE(has_mean_dilatation(Ball::parameters(ElementChoice::mean_dilatation, .3)));

  BodyParameters p        = Ball::parameters(ElementChoice::automatic);
  p.convert_to_tetrahedra = true;
  const Bodies tetrahedra(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  EXPECT_FALSE(tetrahedra.material(0).mean_dilatation);
  ASSERT_EQ(tetrahedra.notes().size(), 1u);
  EXPECT_NE(tetrahedra.notes()[0].find("too stiff"), std::string::npos);
  p.poisson = .45;
  EXPECT_TRUE(Bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, ".")).notes().empty());
  p.element = ElementChoice::mean_dilatation;
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, ".")), InputError);
}



TEST(MeanDilatation, MaterialByMaterial)
{
  std::vector<Point<3>> points;
  for (unsigned int i = 0; i < 12; ++i)
    points.emplace_back(i % 2, i / 2 % 2, i / 4);
  // Rubber on steel.
  const TemporaryFile file(gmsh_text(points, {"5 2 1 1 1 2 4 3 5 6 8 7", "5 2 2 2 5 6 8 7 9 10 12 11"},
                                     "2\n3 1 \"steel\"\n3 2 \"rubber\"\n"));
  BodyParameters      p;
  p.name             = "body";
  p.mesh             = file.path;
  p.poisson          = .3;
  p.volume_materials = "rubber: 1, 0.49";
  const Bodies     bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {p}, "."));
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  unsigned int     n = 0;
  for (const NodalSpace::Cell &cell : space.cells())
    if (cell.is_owned)
      {
        const bool above = Element(space, cell).centre()[2] > 1.;
        EXPECT_EQ(bodies.material(cell.material).mean_dilatation, above);
        ++n;
      }
  EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 2u);
}



// The energy by the stiffness and by stress and strain in the cells: with one set of strains.
TEST(MeanDilatation, StressesBelongToTheStiffness)
{
  double energies[2];
  for (const bool mean : {false, true})
    {
      const Ball   ball(mean ? ElementChoice::mean_dilatation : ElementChoice::standard);
      const Vector u      = ball.nodal(wild);
      double       energy = 0.;
      for (const NodalSpace::Cell &cell : ball.space.cells())
        if (cell.is_owned)
          {
            std::array<Vector3, CellShape::max_vertices> values;
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              for (unsigned int c = 0; c < dim; ++c)
                values[v][c] = u.local_element(3 * ball.partition.to_local(ball.space.nodes(cell)[v]) + c);
            const CellDisplacement displacement(Element(ball.space, cell),
                                                ball.bodies.material(cell.material), values);
            for (unsigned int q = 0; q < displacement.element.n_points(); ++q)
              {
                const Point<3> p = displacement.element.reference_point(q);
                energy += .5 * displacement.element.volume_element(q).first *
                          scalar_product(displacement.stress(p), displacement.gradient(p));
              }
          }
      energy                 = dealii::Utilities::MPI::sum(energy, MPI_COMM_WORLD);
      const double by_matrix = strain_energy(ball.bodies, ball.space, ball.partition, u);
      EXPECT_NEAR(energy / by_matrix, 1., 1e-12);
      energies[mean] = by_matrix;
    }
  EXPECT_LT(energies[1], .95 * energies[0]);
}



// The stress of a linear displacement is constant, however distorted the cells: no forces and no jumps
// inside.
TEST(MeanDilatation, PatchTest)
{
  const Ball     ball(ElementChoice::automatic);
  const Vector   u = ball.nodal(linear);
  Loads          loads;
  LoadParameters parameters;
  parameters.dirichlet = "sphere: (x, y, z)";
  loads.add(ball.bodies, 0, parameters.definition(""));
  const Vector forces  = physical_residual(ball.bodies, ball.space, ball.partition, loads, u);
  const double largest = forces.linfty_norm();
  for (unsigned int i = 0; i < ball.partition.n_owned(); ++i)
    if (ball.space.position(ball.partition.to_global(i)).norm() < .99)
      {
        for (unsigned int c = 0; c < dim; ++c)
          EXPECT_LT(std::abs(forces.local_element(3 * i + c)), 1e-13 * largest);
      }
  EXPECT_GT(largest, 0.);

  const auto total = [&](const Vector &v) {
    const auto indicator = residual_indicator(ball.bodies, ball.space, ball.partition, loads, v, {});
    double     sum       = 0.;
    for (std::size_t c = 0; c < indicator.size(); ++c)
      if (ball.space.cells()[c].is_owned)
        sum += indicator[c];
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  };
  EXPECT_LT(total(u), 1e-20 * total(ball.nodal(wild)));
}

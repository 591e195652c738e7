// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/error_indicator.h>
#include <signorini/mesh/body_parameters.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

namespace
{
  /// A bar of ten cells along x, of either kind.
  struct Bar
  {
    Bodies     bodies;
    NodalSpace space;

    explicit Bar(const bool tetrahedra = false)
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {parameters(tetrahedra)}, "."))
      , space(MPI_COMM_WORLD, bodies.mesh(), true)
    {
    }

    static BodyParameters parameters(const bool tetrahedra)
    {
      BodyParameters p;
      p.name                  = "bar";
      p.mesh                  = "block";
      p.upper_corner          = Point<3>(10, 1, 1);
      p.divisions             = {10, 1, 1};
      p.young                 = 2.;
      p.poisson               = 0.;
      p.convert_to_tetrahedra = tetrahedra;
      return p;
    }

    /// Which of the ten places a cell has.
    unsigned int place(const NodalSpace::Cell &cell) const
    {
      double x = 0.;
      for (const NodeIndex node : space.nodes(cell))
        x += space.position(node)[0] / cell.n_vertices;
      return static_cast<unsigned int>(x);
    }

    /// Places of marked cells over all ranks.
    std::vector<unsigned int> places(const std::vector<bool> &marked) const
    {
      std::vector<unsigned int> result(10, 0);
      for (std::size_t c = 0; c < marked.size(); ++c)
        if (marked[c] && space.cells()[c].is_owned)
          ++result[place(space.cells()[c])];
      dealii::Utilities::MPI::sum(result, MPI_COMM_WORLD, result);
      return result;
    }

    /// Indicators 1, 2, ..., 10 along the bar (sum 55).
    std::vector<double> rising() const
    {
      std::vector<double> indicator;
      for (const auto &cell : space.cells())
        indicator.push_back(1. + place(cell));
      return indicator;
    }
  };

  using Counts = std::vector<unsigned int>;
} // namespace



TEST(Marking, TheFewestCellsWithAShareOfTheError)
{
  const Bar bar;
  // 10 + 9 = 19 < 0.5 * 55 <= 10 + 9 + 8 + 7 = 34, 27 < 27.5.
  EXPECT_EQ(bar.places(mark_share_of_error(bar.space, bar.rising(), .5)),
            (Counts{0, 0, 0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(bar.places(mark_share_of_error(bar.space, bar.rising(), .18)),
            (Counts{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(bar.places(mark_share_of_error(bar.space, bar.rising(), 1.)), Counts(10, 1));
  // Equal ones go together, zeros never.
  EXPECT_EQ(
      bar.places(mark_share_of_error(bar.space, std::vector<double>(bar.space.cells().size(), 3e-20), .1)),
      Counts(10, 1));
  EXPECT_EQ(bar.places(mark_share_of_error(bar.space, std::vector<double>(bar.space.cells().size(), 0.), .5)),
            Counts(10, 0));
}



TEST(Marking, AShareOfTheCells)
{
  const Bar bar;
  EXPECT_EQ(bar.places(mark_share_of_cells(bar.space, bar.rising(), .3)),
            (Counts{0, 0, 0, 0, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(bar.places(mark_share_of_cells(bar.space, bar.rising(), .1)),
            (Counts{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
}



// A bar that is stretched with a kink in the middle: by hand, per cell and term. E = 2, nu = 0, mu = 1,
// stress 2 and 4.
TEST(ResidualIndicator, JumpsLoadsAndTractions)
{
  for (const bool tetrahedra : {false, true})
    {
      const Bar           bar(tetrahedra);
      const NodePartition partition(bar.space.owned(), bar.space.relevant(), MPI_COMM_WORLD);
      Vector              u;
      partition.reinit(u);
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        {
          const double x         = bar.space.position(partition.to_global(i))[0];
          u.local_element(3 * i) = x < 5. ? x : 5. + 2. * (x - 5.);
        }
      u.update_ghost_values();
      LoadParameters parameters;
      parameters.dirichlet = "left: (0, *, *)";
      parameters.tractions = "right: (4, 0, 0)";
      Loads loads;
      loads.add(bar.bodies, 0, parameters.definition(""));
      const auto total = [&](const Loads &l, const std::map<unsigned int, FaceTraction> &contact) {
        const auto indicator = residual_indicator(bar.bodies, bar.space, partition, l, u, contact);
        double     sum       = 0.;
        for (std::size_t c = 0; c < indicator.size(); ++c)
          if (bar.space.cells()[c].is_owned)
            sum += indicator[c];
        return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      };
      // The jump of 2 on the area 1 of the kink: h / (mu + mu) 4, h the longest edge (the diagonal of
      // triangles). The traction on the right is met.
      const double h = tetrahedra ? std::sqrt(2.) : 1.;
      EXPECT_NEAR(total(loads, {}), 2. * h, 1e-12) << tetrahedra;
      // Without the traction: h / (2 mu) 16 more.
      Loads other;
      parameters.tractions = "";
      other.add(bar.bodies, 0, parameters.definition(""));
      EXPECT_NEAR(total(other, {}), 2. * h + 8. * h, 1e-11) << tetrahedra;
      // The same traction as contact.
      std::map<unsigned int, FaceTraction> contact;
      for (unsigned int f = 0; f < bar.space.boundary_faces().size(); ++f)
        if (const auto &face = bar.space.boundary_faces()[f];
            bar.bodies.boundary_ids(0, "right").count(face.id) > 0)
          {
            const double area = tetrahedra ? .5 : 1., share = tetrahedra ? 3. : 4.;
            for (unsigned int a = 0; a < share; ++a)
              contact[f].moments[a][0] = 4. * area / share;
            contact[f].square = 16. * area;
          }
      EXPECT_NEAR(total(other, contact), 2. * h, 1e-11) << tetrahedra;
      // A force per volume: h^2 / (2 mu) 9 times the volume, h the diameter of a cell.
      parameters.tractions    = "right: (4, 0, 0)";
      parameters.volume_force = "(0, 3, 0)";
      Loads volume;
      volume.add(bar.bodies, 0, parameters.definition(""));
      // The diagonal of the cube; in a tetrahedron with a face and the centre the longest edge is the face's
      // diagonal.
      EXPECT_NEAR(total(volume, {}), 2. * h + .5 * (tetrahedra ? 2. : 3.) * 9. * 10., 1e-10) << tetrahedra;
    }
}

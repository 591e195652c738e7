// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// What a rank keeps of a contact pair: right pieces of the whole, of the size of its share.

#include <signorini/application/certificate.h>
#include <signorini/application/journal.h>
#include <signorini/application/pair_pieces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;
using dealii::Utilities::MPI::n_mpi_processes;
using dealii::Utilities::MPI::this_mpi_process;

namespace
{
  BodyDefinition plate(const std::string &name, const double bottom, const unsigned int n)
  {
    dealii::Triangulation<3> mesh;
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {n, n, 2}, Point<3>(0, 0, bottom),
                                                      Point<3>(1, 1, bottom + .1), true);
    BodyDefinition body = make_body(
        name, mesh, {{0, "left"}, {1, "right"}, {2, "front"}, {3, "back"}, {4, "bottom"}, {5, "top"}});
    body.material = {1000., .3};
    return body;
  }

  /// Two plates whose meshes do not match, with n^2 faces on the nonmortar side.
  ProblemDefinition plates(const unsigned int n)
  {
    const ScalarField zero = [](const Point<3> &) { return 0.; },
                      down = [](const Point<3> &) { return -.001; };
    ProblemDefinition problem;
    problem.bodies.resize(2);
    problem.bodies[0].body                = plate("upper", 0., n);
    problem.bodies[0].loads.displacements = {{"top", {{zero, zero, down}}}};
    problem.bodies[1].body                = plate("lower", -.1, n - 1);
    problem.bodies[1].loads.displacements = {{"bottom", {{zero, zero, zero}}}};
    PairDefinition pair;
    pair.name      = "interface";
    pair.first     = {"upper", "bottom", {}};
    pair.second    = {"lower", "top", {}};
    pair.nonmortar = NonmortarChoice::first;
    problem.pairs.push_back(pair);
    return problem;
  }

  /// The pairs of a problem on the ranks of a communicator.
  struct Paired
  {
    Paired(const ProblemDefinition &problem, const MPI_Comm communicator)
      : model(communicator, problem)
      , discretization(discretize(model, std::make_shared<const ConstrainedSpace>(model), {}, 0, journal))
    {
    }

    const ContactPair &pair() const
    {
      return discretization->pairs[0];
    }

    std::size_t bytes() const
    {
      return memory_consumption(pair(), discretization->couplings[0]);
    }

    Journal                               journal;
    ContactModel                          model;
    std::unique_ptr<const Discretization> discretization;
  };

  void expect_piece(const ContactSurface &piece, const ContactSurface &whole)
  {
    for (unsigned int f = 0; f < piece.faces.size(); ++f)
      for (unsigned int a = 0; a < 4; ++a)
        EXPECT_EQ(piece.number_of_vertex(piece.faces[f].corners[a]),
                  whole.faces[piece.number_of_face(f)].corners[a]);
    for (unsigned int t = 0; t < piece.mesh.triangles.size(); ++t)
      for (unsigned int a = 0; a < 3; ++a)
        EXPECT_EQ(piece.number_of_vertex(piece.mesh.triangles[t][a]),
                  whole.mesh.triangles[piece.number_of_triangle(t)][a]);
    for (unsigned int v = 0; v < piece.mesh.vertices.size(); ++v)
      {
        const unsigned int w = piece.number_of_vertex(v);
        EXPECT_EQ(piece.mesh.vertices[v], whole.mesh.vertices[w]);
        EXPECT_EQ(piece.mesh.vertex_normals[v], whole.mesh.vertex_normals[w]);
      }
    EXPECT_EQ(piece.extent(), whole.extent());
  }

  std::size_t count(const ContactSurface &surface, unsigned int ContactSurface::Face::*const rank_of,
                    const unsigned int rank)
  {
    return std::count_if(surface.faces.begin(), surface.faces.end(),
                         [&](const ContactSurface::Face &face) { return face.*rank_of == rank; });
  }
} // namespace



TEST(PairPieces, HaveTheShareOfTheRank)
{
  const MPI_Comm     comm = MPI_COMM_WORLD;
  const unsigned int rank = this_mpi_process(comm), n_ranks = n_mpi_processes(comm);
  for (const unsigned int n : {24u, 48u})
    {
      const Paired          alone(plates(n), MPI_COMM_SELF), shared(plates(n), comm);
      const ContactSurface &whole_non = alone.pair().nonmortar.surface,
                           &whole_mor = alone.pair().mortar.surface, &non = shared.pair().nonmortar.surface,
                           &mor = shared.pair().mortar.surface;
      ASSERT_EQ(whole_non.faces.size(), n * n);
      expect_piece(non, whole_non);
      expect_piece(mor, whole_mor);
      if (n_ranks == 1)
        continue;
      // The own faces, those of the own cells, and the border of a piece of any shape.
      const auto        owner = &ContactSurface::Face::owner, worker = &ContactSurface::Face::worker;
      const std::size_t n_worked = count(non, worker, rank), n_owned = count(non, owner, rank),
                        n_owned_mortar = count(mor, owner, rank),
                        n_border       = static_cast<std::size_t>(12. * std::sqrt(n_worked)) + 12;
      EXPECT_LE(non.faces.size(), n_worked + n_owned + n_border);
      EXPECT_LE(mor.faces.size(), n_worked + n_owned_mortar + n_border);
      const double per_face = static_cast<double>(alone.bytes()) /
                              static_cast<double>(whole_non.faces.size() + whole_mor.faces.size());
      EXPECT_LE(static_cast<double>(shared.bytes()),
                1.2 * per_face * static_cast<double>(non.faces.size() + mor.faces.size()));
      EXPECT_EQ(dealii::Utilities::MPI::sum(n_worked, comm), n * n);
    }
}

// Lost edges count near what the nodes in contact couple, however long they are.
TEST(LostEdges, AreSeenNearTheContact)
{
  const Paired               paired(plates(8), MPI_COMM_WORLD);
  const PairCoupling        &coupling = paired.discretization->couplings[0];
  const ContactPair         &whole    = paired.discretization->pairs[0];
  std::vector<unsigned char> active;
  const Point<3>             place(.5, .5, 0.);
  for (const Point<3> &x : coupling.positions)
    active.push_back(x.distance(place) < 1e-6);
  EXPECT_EQ(dealii::Utilities::MPI::sum(std::count(active.begin(), active.end(), 1), MPI_COMM_WORLD), 1);
  const auto sees = [&](const double x, const double length) {
    ContactPair pair;
    pair.mortar     = whole.mortar;
    pair.lost_edges = {{Point<3>(x, .5, 0.), length}};
    const bool here = lost_edge_near(pair, coupling, active) == 0;
    return dealii::Utilities::MPI::max(static_cast<int>(here), MPI_COMM_WORLD) == 1;
  };
  // Faces of 1/8 and 1/7.
  EXPECT_TRUE(sees(.5, .14));
  EXPECT_TRUE(sees(.8, .14));
  EXPECT_FALSE(sees(.95, .14));
  EXPECT_FALSE(sees(1.5, 1.));
  EXPECT_TRUE(sees(1.2, 1.));
}

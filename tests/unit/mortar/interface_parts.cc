// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// An interface that is shared by the ranks: every row as it is with all faces on one rank.

#include "flat_surfaces.h"
#include "received_bytes.h"
#include "replicated_coupling.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/mesh/surface_piece.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/face_shares.h>
#include <signorini/mortar/pair_conflicts.h>

#include <gtest/gtest.h>

namespace
{
  using namespace FlatSurfaces;
  using dealii::Utilities::MPI::n_mpi_processes;
  using dealii::Utilities::MPI::this_mpi_process;

  /// Two random surfaces, partly covered, with hanging, fixed and excluded nodes: the same on all ranks.
  struct RandomInterface
  {
    explicit RandomInterface(const unsigned int seed)
      : random(seed)
      , non(make_surface(grid(1., true)))
      , mor(make_surface(grid(uniform(.4, 1.1), false)))
    {
      const auto shape = [a = uniform(-.2, .2), b = uniform(1., 5.)](const Point<3> &x) {
        return a * std::sin(b * x[0]) * std::cos(2. * x[1]);
      };
      for (ContactSurface *const surface : {&non, &mor})
        for (Point<3> &x : surface->mesh.vertices)
          x[2] += shape(x);
      const double border = uniform(-.5, 1.);
      for (unsigned int v = 0; v < non.vertex_fixed.size(); ++v)
        if (non.mesh.vertices[v][0] < border)
          non.vertex_fixed[v] = static_cast<FixedMask>(number(0, 7));
        else if (number(0, 20) == 0)
          excluded.insert(non.vertex_node[v]);
      overlay = make_overlay(non, mor);
    }

    double uniform(const double low, const double high)
    {
      return std::uniform_real_distribution<double>(low, high)(random);
    }

    unsigned int number(const unsigned int low, const unsigned int high)
    {
      return std::uniform_int_distribution<unsigned int>(low, high)(random);
    }

    Grid grid(const double extent, const bool is_nonmortar)
    {
      Grid g{number(2, 9), number(2, 9), 0., extent, 0., uniform(.5, 1.), {}, uniform(0., .3)};
      for (unsigned int i = number(0, 6); i > 0; --i)
        g.refined.insert({number(0, g.nx - 1), number(0, g.ny - 1)});
      g.first_node = is_nonmortar ? 0 : 1000;
      g.faces_up   = is_nonmortar;
      return g;
    }

    std::mt19937                 random;
    ContactSurface               non, mor;
    std::set<NodeIndex>          excluded;
    std::vector<OverlayTriangle> overlay;
  };

  /// Shares of equal work, or any.
  void share(RandomInterface &interface, const unsigned int n_ranks)
  {
    if (interface.number(0, 2) > 0)
      share_faces(interface.non, interface.mor, n_ranks);
    else
      for (ContactSurface::Face &face : interface.non.faces)
        face.worker = interface.number(0, n_ranks - 1);
  }

  std::vector<OverlayTriangle> own_part(const RandomInterface &interface, const unsigned int rank)
  {
    std::vector<OverlayTriangle> part;
    for (const OverlayTriangle &cell : interface.overlay)
      if (interface.non.faces[interface.non.triangle_face[cell.nonmortar_triangle]].worker == rank)
        part.push_back(cell);
    return part;
  }

  /// Bit by bit.
  void expect_row(const PairCoupling &a, const std::size_t i, const PairCoupling &b, const std::size_t j)
  {
    EXPECT_EQ(a.coupling.weight[i], b.coupling.weight[j]);
    EXPECT_EQ(a.gaps[i], b.gaps[j]);
    EXPECT_EQ(a.areas[i], b.areas[j]);
    EXPECT_EQ(a.shares[i], b.shares[j]);
    EXPECT_EQ(a.vertices[i], b.vertices[j]);
    EXPECT_EQ((a.normals[i] - b.normals[j]).norm() + a.positions[i].distance(b.positions[j]), 0.);
    ASSERT_EQ(a.coupling.end(i) - a.coupling.begin(i), b.coupling.end(j) - b.coupling.begin(j));
    for (auto *x = a.coupling.begin(i), *y = b.coupling.begin(j); x != a.coupling.end(i); ++x, ++y)
      {
        EXPECT_EQ(x->node, y->node);
        EXPECT_EQ(x->weight, y->weight);
      }
  }

  /// The own and ghost faces of a surface alone, with what belongs to them.
  struct OwnPiece
  {
    OwnPiece(const ContactSurface &whole, const SurfaceHalo &whole_halo,
             const std::vector<FaceMoments> &some_moments, const PairCoupling &whole_coupling)
      : piece(make_piece(whole, whole_halo, some_moments))
      , surface(cut_out(whole, piece))
      , halo(whole_halo, piece)
      , moments(some_moments)
      , coupling(whole_coupling)
    {
      for (FaceMoments &m : moments)
        m.face = piece.faces[m.face];
      for (unsigned int &v : coupling.vertices)
        v = piece.part.vertices[v];
    }

    static SurfacePiece make_piece(const ContactSurface &whole, const SurfaceHalo &halo,
                                   const std::vector<FaceMoments> &moments)
    {
      std::vector<bool> faces(whole.faces.size(), false), vertices(whole.mesh.vertices.size(), false);
      for (const FaceMoments &m : moments)
        faces[m.face] = true;
      for (const unsigned int v : halo.functions())
        vertices[v] = true;
      return SurfacePiece(whole, faces, std::move(vertices));
    }

    const SurfacePiece       piece;
    const ContactSurface     surface;
    const SurfaceHalo        halo;
    std::vector<FaceMoments> moments;
    PairCoupling             coupling;
  };

  void expect_joined(const ContactSurface &piece, const ContactSurface &whole, const MPI_Comm comm)
  {
    const ContactSurface joined = join_pieces(piece, comm, Receivers::all);
    EXPECT_EQ(joined.mesh.triangles, whole.mesh.triangles);
    EXPECT_EQ(joined.triangle_face, whole.triangle_face);
    EXPECT_EQ(joined.mesh.vertices, whole.mesh.vertices);
    EXPECT_EQ(joined.vertex_node, whole.vertex_node);
    ASSERT_EQ(joined.faces.size(), whole.faces.size());
    for (unsigned int f = 0; f < whole.faces.size(); ++f)
      {
        EXPECT_EQ(joined.faces[f].corners, whole.faces[f].corners);
        EXPECT_EQ(joined.faces[f].worker, whole.faces[f].worker);
      }
  }
} // namespace



TEST(InterfaceParts, RowsAreThoseOfTheWhole)
{
  const MPI_Comm     comm = MPI_COMM_WORLD;
  const unsigned int rank = this_mpi_process(comm), n_ranks = n_mpi_processes(comm);
  std::size_t        n_dropped = 0, n_lost = 0;
  for (unsigned int seed = 0; seed < 200; ++seed)
    {
      SCOPED_TRACE("interface " + std::to_string(seed));
      RandomInterface interface(seed);
      DroppingRule    rule{interface.uniform(0., .6), interface.uniform(1., 6.)};
      // The oracle knows none.
      rule.drops_sharp_edges = false;
      const auto moments =
          compute_face_moments(interface.non, interface.mor, interface.overlay, {}, MPI_COMM_SELF);
      const auto whole =
          ReplicatedCoupling::couple(interface.non, interface.mor, moments, interface.excluded, false, rule);
      share(interface, n_ranks);
      const SurfaceHalo halo(interface.non, comm);
      const auto        own =
          compute_face_moments(interface.non, interface.mor, own_part(interface, rank), {}, comm);
      const auto ghosted = halo.add_ghosts(own);
      const auto part    = couple(SharedPair{interface.non, interface.mor, halo}, ghosted,
                                  {interface.excluded, {}, {}}, false, rule);

      EXPECT_EQ(part.n_rows_of_all, whole.coupling.n_rows());
      EXPECT_EQ(dealii::Utilities::MPI::sum(part.coupling.n_rows(), comm), whole.coupling.n_rows());
      for (std::size_t i = 0; i < part.coupling.n_rows(); ++i)
        {
          const std::ptrdiff_t j = whole.coupling.find(part.coupling.rows[i]);
          ASSERT_GE(j, 0);
          expect_row(part, i, whole, static_cast<std::size_t>(j));
        }
      EXPECT_EQ(dealii::Utilities::MPI::sum(part.dropped.size(), comm), whole.dropped.size());
      for (const DroppedNode &node : part.dropped)
        EXPECT_TRUE(std::any_of(whole.dropped.begin(), whole.dropped.end(), [&](const DroppedNode &other) {
          return other.node == node.node && other.reason == node.reason && other.share == node.share;
        }));
      for (const auto &[a, b] :
           {std::make_pair(part.area, whole.area), std::make_pair(part.covered_area, whole.covered_area),
            std::make_pair(part.lost_area, whole.lost_area)})
        EXPECT_NEAR(a, b, 1e-13 * whole.area);
      double lost = 0.;
      for (const auto &face : part.lost_faces)
        lost += moments[face.face].covered;
      EXPECT_GE(dealii::Utilities::MPI::sum(lost, comm), whole.lost_area * (1. - 1e-12));
      n_dropped += whole.dropped.size();
      n_lost += whole.lost_area > 0.;

      std::vector<double> pressure;
      for (const Point<3> &x : whole.positions)
        pressure.push_back(1. + x[0] * x[1]);
      std::vector<double> of_part;
      for (const Point<3> &x : part.positions)
        of_part.push_back(1. + x[0] * x[1]);
      const auto      recovered = recover_pressure(interface.non, halo, ghosted, part, of_part);
      RandomInterface alone(seed);
      const auto      expected =
          recover_pressure(alone.non, SurfaceHalo(alone.non, MPI_COMM_SELF), moments, whole, pressure);
      for (unsigned int f = 0; f < interface.non.faces.size(); ++f)
        {
          if (!halo.owns_face(f))
            continue;
          for (const unsigned int v : interface.non.faces[f].corners)
            EXPECT_EQ(recovered[v], expected[v]);
        }
      const OwnPiece piece(interface.non, halo, ghosted, part);
      expect_joined(piece.surface, interface.non, comm);
      const auto of_piece =
          recover_pressure(piece.surface, piece.halo, piece.moments, piece.coupling, of_part);
      for (unsigned int f = 0; f < piece.surface.faces.size(); ++f)
        {
          if (!piece.halo.owns_face(f))
            continue;
          for (const unsigned int v : piece.surface.faces[f].corners)
            EXPECT_EQ(of_piece[v], expected[piece.surface.number_of_vertex(v)]);
        }
    }
  EXPECT_GT(n_dropped, 200u);
  EXPECT_GT(n_lost, 10u);
}



namespace
{
  /// One random surface under two others, each pair with its own overlay, and a third one that follows it.
  struct RandomPairs
  {
    explicit RandomPairs(const unsigned int seed)
      : interface(seed)
    {
      Grid g{interface.number(2, 9), interface.number(2, 9), interface.uniform(.2, .9), 1.3, 0., 1., {}, .2};
      g.refined    = {{0, 0}, {interface.number(0, g.nx - 1), interface.number(0, g.ny - 1)}};
      g.first_node = 3000;
      g.faces_up   = false;
      other        = make_surface(g);
      g.first_node = 4000;
      follower     = make_surface(g);
      overlays     = {interface.overlay, make_overlay(interface.non, other),
                      make_overlay(follower, interface.non)};
      body         = interface.number(0, 1);
      is_tied      = interface.number(0, 5) == 0;
    }

    /// The joined rows of the nodes of this rank.
    JoinedCouplings join(const MPI_Comm comm) const
    {
      const unsigned int          rank = this_mpi_process(comm), n_ranks = n_mpi_processes(comm);
      const SurfaceHalo           halo(interface.non, comm), halo_of_follower(follower, comm);
      const SurfaceHalo *const    halos[3]      = {&halo, &halo, &halo_of_follower};
      const ContactSurface *const nonmortars[3] = {&interface.non, &interface.non, &follower};
      const ContactSurface *const mortars[3]    = {&interface.mor, &other, &interface.non};
      std::vector<FaceMoments>    moments[3];
      std::vector<PairToCouple>   pairs;
      for (unsigned int p = 0; p < 3; ++p)
        {
          const ContactSurface        &non = *nonmortars[p];
          std::vector<OverlayTriangle> own;
          for (const OverlayTriangle &cell : overlays[p])
            if (non.faces[non.triangle_face[cell.nonmortar_triangle]].worker == rank)
              own.push_back(cell);
          moments[p] = halos[p]->add_ghosts(compute_face_moments(non, *mortars[p], own, {}, comm));
        }
      for (unsigned int p = 0; p < 2; ++p)
        pairs.push_back(
            {{interface.non, *mortars[p], halo}, moments[p], false, p == 1 && is_tied, 2, p * body, {}});
      pairs.push_back({{follower, interface.non, halo_of_follower}, moments[2], false, false, 3, 2, {}});
      dealii::IndexSet owned(5000);
      owned.add_range(rank * 5000 / n_ranks, (rank + 1) * 5000 / n_ranks);
      return join_couplings(couple_pairs(pairs, comm), {}, NodePartition(owned, owned, comm));
    }

    RandomInterface                           interface;
    ContactSurface                            other, follower;
    std::vector<std::vector<OverlayTriangle>> overlays;
    unsigned int                              body;
    bool                                      is_tied;
  };
} // namespace

// Nodes of two pairs: decided on some rank, the same on any number of them; so are the links of chains.
TEST(InterfaceParts, SharedRowsAreThoseOfTheWhole)
{
  const MPI_Comm comm   = MPI_COMM_WORLD;
  std::size_t    n_rows = 0, n_added = 0;
  for (unsigned int seed = 0; seed < 100; ++seed)
    {
      SCOPED_TRACE("interface " + std::to_string(seed));
      RandomPairs           pairs(seed);
      const JoinedCouplings whole = pairs.join(MPI_COMM_SELF);
      share(pairs.interface, n_mpi_processes(comm));
      const JoinedCouplings part = pairs.join(comm);
      EXPECT_EQ(dealii::Utilities::MPI::sum(part.coupling.n_rows(), comm), whole.coupling.n_rows());
      for (std::size_t i = 0; i < part.coupling.n_rows(); ++i)
        {
          const std::ptrdiff_t j = whole.coupling.find(part.coupling.rows[i]);
          ASSERT_GE(j, 0);
          EXPECT_EQ(part.pairs[i], whole.pairs[j]);
          EXPECT_EQ(part.gaps[i], whole.gaps[j]);
          EXPECT_EQ(part.coupling.weight[i], whole.coupling.weight[j]);
          EXPECT_EQ((part.normals[i] - whole.normals[j]).norm(), 0.);
          ASSERT_EQ(part.coupling.end(i) - part.coupling.begin(i),
                    whole.coupling.end(j) - whole.coupling.begin(j));
          double sum = 0.;
          for (auto *x = part.coupling.begin(i), *y = whole.coupling.begin(j); x != part.coupling.end(i);
               ++x, ++y)
            {
              EXPECT_EQ(x->node, y->node);
              EXPECT_EQ(x->weight, y->weight);
              sum += x->weight;
            }
          EXPECT_NEAR(sum, 1., 1e-11);
        }
      n_rows += whole.coupling.n_rows();
      ASSERT_EQ(static_cast<bool>(part.chained), static_cast<bool>(whole.chained));
      if (!whole.chained)
        continue;
      for (std::size_t i = 0; i < part.chained->n_rows(); ++i)
        {
          const std::ptrdiff_t j = whole.chained->find(part.chained->rows[i]);
          ASSERT_GE(j, 0);
          ASSERT_EQ(part.chained->end(i) - part.chained->begin(i),
                    whole.chained->end(j) - whole.chained->begin(j));
          for (auto *x = part.chained->begin(i), *y = whole.chained->begin(j); x != part.chained->end(i);
               ++x, ++y)
            EXPECT_TRUE(x->node == y->node && x->weight == y->weight);
        }
      n_added += whole.chained->entries.size() - whole.coupling.entries.size();
    }
  EXPECT_GT(n_rows, 2000u);
  EXPECT_GT(n_added, 1000u);
}



// Both sides together, in one order for any number of ranks.
TEST(InterfaceParts, SharesAreEven)
{
  for (const unsigned int n_ranks : {2, 3, 8, 16})
    {
      auto non = make_surface({24, 24}),
           mor = make_surface({40, 40, .3, 2., .2, 1.5, {}, 0., 0., 10000, false});
      for (Point<3> &x : mor.mesh.vertices)
        x[2] += .5;
      const auto overlay = make_overlay(non, mor);
      share_faces(non, mor, n_ranks);
      std::vector<double> work(n_ranks, 0.), faces(n_ranks, 0.);
      for (const ContactSurface::Face &face : non.faces)
        faces.at(face.worker) += 1.;
      for (const OverlayTriangle &cell : overlay)
        work[non.faces[non.triangle_face[cell.nonmortar_triangle]].worker] += 1.;
      EXPECT_GT(*std::min_element(faces.begin(), faces.end()), 0.);
      const double mean = static_cast<double>(overlay.size()) / n_ranks;
      EXPECT_LT(*std::max_element(work.begin(), work.end()), 1.3 * mean) << n_ranks;
    }
}



// What a rank gets for its rows is what lies around its part of the interface: the border of one of P square
// pieces of n faces crosses 4 sqrt(n / P) of them. Finished rows go to the owners of their nodes, n / P each.
TEST(InterfaceParts, ReceivedBytesFollowTheBorder)
{
  const unsigned int n_all = n_mpi_processes(MPI_COMM_WORLD), n = 48;
  for (unsigned int n_ranks = 1; n_ranks <= n_all; n_ranks *= 2)
    {
      MPI_Comm   comm;
      const bool takes_part = this_mpi_process(MPI_COMM_WORLD) < n_ranks;
      MPI_Comm_split(MPI_COMM_WORLD, takes_part ? 0 : 1, 0, &comm);
      if (takes_part)
        {
          auto non = make_surface({n, n}),
               mor = make_surface({n - 1, n - 1, 0., 1., 0., 1., {}, 0., 0., 10000, false});
          share_faces(non, mor, n_ranks);
          const auto moments = compute_face_moments(
              non, mor, make_overlay(non, mor, static_cast<int>(this_mpi_process(comm))), {}, comm);
          std::size_t bytes_of_faces = 0;
          for (const FaceMoments &m : moments)
            bytes_of_faces += sizeof(double) * (36 + 5 * m.coupling.size());
          bytes_of_faces = dealii::Utilities::MPI::sum(bytes_of_faces, comm);

          const std::size_t before = received_bytes();
          const SurfaceHalo halo(non, comm);
          const auto        part     = couple({non, mor, halo}, halo.add_ghosts(moments), {}, false);
          const std::size_t for_rows = received_bytes() - before;
          const double      per_face = static_cast<double>(bytes_of_faces) / (n * n);
          const double      n_border = n_ranks == 1 ? 0. : 4. * n / std::sqrt(n_ranks);
          const double      largest  = static_cast<double>(dealii::Utilities::MPI::max(for_rows, comm));
          // Messages that only say that there is nothing, and sums.
          constexpr double few = 4096.;
          EXPECT_LE(largest, 2. * n_border * per_face + few) << n_ranks << " ranks";

          dealii::IndexSet owned(20000);
          const NodeIndex  rank = this_mpi_process(comm), n_nodes = (n + 1) * (n + 1);
          owned.add_range(rank == 0 ? 0 : rank * n_nodes / n_ranks,
                          rank + 1 == n_ranks ? 20000 : (rank + 1) * n_nodes / n_ranks);
          const NodePartition partition(owned, owned, comm);
          const std::size_t   joining = received_bytes();
          const auto          joined  = join_couplings({part}, {}, partition);
          const double        rows    = static_cast<double>(received_bytes() - joining);
          double              content = 0.;
          for (std::size_t row = 0; row < joined.coupling.n_rows(); ++row)
            content +=
                200. + 16. * static_cast<double>(joined.coupling.end(row) - joined.coupling.begin(row));
          EXPECT_LE(rows, (n_ranks == 1 ? 0. : 2. * content) + few);
          EXPECT_LE(static_cast<double>(joined.coupling.n_rows()),
                    2. * static_cast<double>(n_nodes) / n_ranks);
        }
      MPI_Comm_free(&comm);
    }
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/body_evaluation.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/nodal_stress.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/surface_values.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The largest of a positive quantity, and where.
    struct Largest
    {
      double   value = -1.;
      Point<3> place;

      void add(const double v, const Point<3> &x)
      {
        // Equal values: the same place on any number of ranks.
        const auto before = [&] {
          for (unsigned int c = 0; c < dim; ++c)
            if (x[c] != place[c])
              return x[c] < place[c];
          return false;
        };
        if (v > value || (v == value && before()))
          {
            value = v;
            place = x;
          }
      }

      /// Over all ranks.
      void gather(const MPI_Comm comm)
      {
        Largest all;
        for (const auto &[v, x] : gather_values(std::make_pair(value, place), comm))
          all.add(v, x);
        *this = all;
      }
    };
  } // namespace



  namespace
  {
    /// Those of rigid faces, by body.
    std::vector<Resultant> loads_of_rigid_faces(const Discretization &d, const unsigned int n_bodies)
    {
      std::vector<Resultant> result(n_bodies);
      if (d.dirichlet().rigid != nullptr)
        for (const RigidFace &face : d.dirichlet().rigid->faces())
          {
            result[face.body].force += face.force;
            result[face.body].moment += face.moment + cross_product_3d(Vector3(face.centre), face.force);
          }
      return result;
    }
  } // namespace



  std::vector<Resultant> load_resultants(const ContactModel &model, const Discretization &d,
                                         const Loads &loads)
  {
    const MPI_Comm comm = model.communicator();
    Vector         nothing;
    d.partition().reinit(nothing);
    nothing.update_ghost_values();
    // Strains without stress balance themselves: what is left of their forces is rounding.
    Loads forces_only = loads;
    forces_only.eigenstrains.clear();
    forces_only.pretensions.clear();
    // A u - f without u.
    const Vector forces = physical_residual(model.bodies(), d.nodal(), d.partition(), forces_only, nothing);
    const std::vector<unsigned int> body = bodies_of_nodes(d, model.bodies());
    std::vector<Resultant>          result(model.bodies().n_bodies());
    for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
      {
        const NodeIndex node = d.partition().to_global(i);
        if (body[i] == numbers::invalid_unsigned_int || d.nodal().hanging_nodes().is_constrained(node))
          continue;
        const Vector3 force = -nodal_value(forces, i);
        result[body[i]].force += force;
        result[body[i]].moment += cross_product_3d(Vector3(d.nodal().position(node)), force);
      }
    for (Resultant &r : result)
      r = {sum(r.force, comm), sum(r.moment, comm)};
    return result;
  }



  std::vector<Resultant> all_loads(const ContactModel &model, const Discretization &d)
  {
    std::vector<Resultant> result = load_resultants(model, d, model.loads());
    const auto             rigid  = loads_of_rigid_faces(d, model.bodies().n_bodies());
    for (unsigned int b = 0; b < result.size(); ++b)
      {
        result[b].force += rigid[b].force;
        result[b].moment += rigid[b].moment;
      }
    return result;
  }



  std::vector<Distortion> largest_distortions(const ContactModel &model, const Discretization &d,
                                              const Vector &displacement)
  {
    const Bodies           &bodies = model.bodies();
    std::vector<Distortion> result(bodies.n_bodies());
    for (const NodalSpace::Cell &cell : d.nodal().cells())
      if (cell.is_owned)
        {
          std::array<Vector3, CellShape::max_vertices> u;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            u[v] = nodal_value(displacement, d.partition().to_local(d.nodal().nodes(cell)[v]));
          const Element  element(d.nodal(), cell);
          const Point<3> middle =
              cell.n_vertices == CellShape::hexahedron ? Point<3>(.5, .5, .5) : Point<3>(.25, .25, .25);
          const Block g = CellDisplacement(element, bodies.material(cell.material), u).gradient(middle);
          SymmetricTensor<2, dim> strain;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              strain[i][j] = .5 * (g[i][j] + g[j][i]);
          const Vector3 axis({g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]});
          Distortion   &largest = result[bodies.body_of_material(cell.material)];
          largest.rotation      = std::max(largest.rotation, .5 * axis.norm());
          for (const double e : eigenvalues(strain))
            largest.strain = std::max(largest.strain, std::abs(e));
        }
    for (Distortion &one : result)
      one = {Utilities::MPI::max(one.rotation, model.communicator()),
             Utilities::MPI::max(one.strain, model.communicator())};
    return result;
  }



  namespace
  {
    void add_forces(std::vector<BodyResult> &bodies, const ContactModel &model, const Discretization &d,
                    const Results &results)
    {
      const auto loads = all_loads(model, d);
      // What a rigid face does to its body is its load, and what its conditions add.
      const auto rigid = loads_of_rigid_faces(d, model.bodies().n_bodies());
      for (unsigned int b = 0; b < bodies.size(); ++b)
        {
          bodies[b].load        = loads[b].force;
          bodies[b].load_moment = loads[b].moment;
          bodies[b].reaction    = -rigid[b].force;
          for (const BoundaryResult &boundary : results.boundaries)
            if (boundary.body == bodies[b].name)
              bodies[b].reaction += boundary.reaction;
        }
      for (unsigned int p = 0; p < d.pairs.size() && p < results.pairs.size(); ++p)
        {
          bodies[d.pairs[p].nonmortar.body].contact += results.pairs[p].force;
          if (!d.pairs[p].obstacle)
            bodies[d.pairs[p].mortar.body].contact += results.pairs[p].force_on_mortar;
        }
    }
  } // namespace



  std::vector<BodyResult> evaluate_bodies(const ContactModel &model, const Discretization &d,
                                          const Vector &displacement, const Results &results)
  {
    const Bodies             &bodies = model.bodies();
    const std::vector<double> values = relevant_values(d, displacement);
    const StressedBodies      stressed{bodies, model.loads(), d.nodal(), d.dirichlet().fixed, values};
    const NodalStress         nodal(stressed);
    const auto                stress = nodal.values();
    const auto                errors = nodal.errors();
    std::vector<BodyResult>   result(bodies.n_bodies());
    std::vector<Largest>      movement(result.size()), von_mises(result.size());
    for (const NodalSpace::Cell &cell : d.nodal().cells())
      if (cell.is_owned)
        for (const NodeIndex node : d.nodal().nodes(cell))
          {
            const unsigned int b = bodies.body_of_material(cell.material);
            movement[b].add(nodal_value(displacement, d.partition().to_local(node)).norm(),
                            d.nodal().position(node));
            von_mises[b].add(Signorini::von_mises(stress[d.nodal().relevant().index_within_set(node)]),
                             d.nodal().position(node));
          }
    const auto distortions = largest_distortions(model, d, displacement);
    for (unsigned int b = 0; b < result.size(); ++b)
      {
        movement[b].gather(model.communicator());
        von_mises[b].gather(model.communicator());
        result[b].name                 = bodies.body_name(b);
        result[b].largest_displacement = movement[b].value;
        result[b].displacement_at      = movement[b].place;
        result[b].largest_von_mises    = von_mises[b].value;
        result[b].von_mises_at         = von_mises[b].place;
        result[b].largest_rotation     = distortions[b].rotation;
        result[b].largest_strain       = distortions[b].strain;
        result[b].stress_error         = errors[b].relative();
      }
    add_forces(result, model, d, results);
    return result;
  }



  namespace
  {
    /// A nonmortar vertex and its displacement relative to its image.
    struct VertexJump
    {
      unsigned int vertex;
      Vector3      value;
      /// Of the other side at the image, outward: linear on its triangles, and of the facet. Zero where it is
      /// not known.
      Vector3 normal, facet_normal;
    };

    std::vector<VertexJump> jumps_on_obstacle(const ContactPair &pair, const std::vector<Vector3> &moved)
    {
      const ContactSurface   &non  = pair.nonmortar.surface;
      const double            size = non.extent();
      std::vector<VertexJump> result;
      for (unsigned int v = 0; v < moved.size(); ++v)
        if (pair.halo->owns(v))
          {
            Vector3 normal;
            double  distance;
            if (!pair.obstacle->contact_normal(normal, distance, non.mesh.vertices[v],
                                               non.mesh.vertex_normals[v], size))
              normal = Vector3();
            result.push_back({v, moved[v], -normal, -normal});
          }
      return result;
    }

    /// Where the mapping of this rank reaches them; a vertex may be there several times.
    std::vector<VertexJump> relative_displacements(const ContactPair          &pair,
                                                   const std::vector<Vector3> &nonmortar,
                                                   const std::vector<Vector3> &mortar)
    {
      if (pair.obstacle)
        return jumps_on_obstacle(pair, nonmortar);
      std::vector<VertexJump> result;
      if (!pair.mapping)
        return result;
      const ContactSurface &other = pair.mortar.surface;
      const SurfaceValues   on_mortar(other, vertices_on_sharp_edges(other, all_faces));
      for (const OverlayTriangle &cell : covered_overlay(pair))
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < 3; ++i)
            if (cell.nonmortar[c][i] == 1.)
              {
                const unsigned int v = pair.nonmortar.surface.mesh.triangles[cell.nonmortar_triangle][i];
                const unsigned int t = cell.mortar_triangle;
                const Point<3>     x = on_mortar.point(t, cell.mortar[c]);
                result.push_back({v, nonmortar[v] - on_mortar.value(mortar, t, x),
                                  on_mortar.normal(t, cell.mortar[c]), facet_normal(other, t)});
              }
      return result;
    }

    /// How many of the faces around its vertex each slip crosses: its length over their extent along it.
    /// Slabs of one layer are far longer in the direction in which nothing slides.
    std::vector<double> slips_in_faces(const ContactSurface &surface, const std::vector<Vector3> &slip)
    {
      const auto         &x = surface.mesh.vertices;
      std::vector<double> extent(slip.size(), 0.), result(slip.size(), 0.);
      for (const ContactSurface::Face &face : surface.faces)
        for (const unsigned int v : face.corners)
          for (const unsigned int other : face.corners)
            extent[v] = std::max(extent[v], std::abs(slip[v] * (x[other] - x[v])));
      for (std::size_t v = 0; v < slip.size(); ++v)
        if (extent[v] > 0.)
          result[v] = slip[v].norm_square() / extent[v];
      return result;
    }
  } // namespace



  namespace
  {
    /// When surfaces that end up apart have slid along each other, rather than been lifted off.
    struct SlidApartRule
    {
      /// How far they come apart somewhere, relative to their slip, from where on they are lifted: all that
      /// touched before is far away then. A hair between tweezers whose arms make 2 degrees with its way out:
      /// .035; a ball on its way out of a socket, whose walls it slides along: 1.
      double lifted = .5;
    };

    /// Collective. Where slip counts, by vertex: where the surfaces touch; if they do nowhere, where they
    /// could have, but not if they are lifted off each other.
    /// @param jumps relative displacements at vertices
    std::vector<unsigned char> where_slip_counts(const Discretization &d, const ContactSolution &solution,
                                                 const unsigned int p, const std::vector<VertexJump> &jumps)
    {
      const MPI_Comm             comm     = d.nodal().communicator();
      const ContactPair         &pair     = d.pairs[p];
      const PairCoupling        &coupling = d.couplings[p];
      const ContactStress        stress   = stress_of_pair(d, solution.stress, p);
      std::vector<unsigned char> result   = spread_rows(coupling, *pair.halo, stress.active);
      const bool                 touches =
          std::any_of(stress.active.begin(), stress.active.end(), [](const auto one) { return one != 0; });
      if (pair.is_tied || Utilities::MPI::max(static_cast<int>(touches), comm) > 0)
        return result;
      const auto is_row =
          spread_rows(coupling, *pair.halo, std::vector<unsigned char>(coupling.vertices.size(), 1));
      const auto opening = spread_rows(coupling, *pair.halo, stress.opening);
      double     lifted = 0., slid = 0.;
      for (const auto &[v, jump, normal, facet] : jumps)
        if (is_row[v] != 0)
          {
            const Vector3 &n    = pair.nonmortar.surface.mesh.vertex_normals[v];
            const double   slip = (jump - (jump * n) * n).norm();
            lifted              = std::max(lifted, -(jump * n));
            slid                = std::max(slid, slip);
            // What is farther away than it has slid does not meet slopes below 45 degrees.
            result[v] = opening[v] < slip;
          }
      if (Utilities::MPI::max(lifted, comm) >= SlidApartRule().lifted * Utilities::MPI::max(slid, comm))
        std::fill(result.begin(), result.end(), 0);
      return result;
    }
  } // namespace



  namespace
  {
    /// Where surfaces are pressed by their slip alone. Pure numbers.
    struct PressingSlipRule
    {
      /// Angle (radians) between the normals of both sides: below it is what meshes make of one surface.
      double turn = .1;
      /// What the normals of the other side leave out of the approach, as a part of that.
      double of_approach = .5;
    };

    /// Whether a node approaches the other side along its own normal, but not along that of the other side,
    /// as where one slides along the other and the nodes on its rounded end have the normals that they have
    /// there.
    bool is_pressed_by_slip(const VertexJump &jump, const Vector3 &own)
    {
      const auto is = [&](const Vector3 &other) {
        const Vector3 turn = own + other;
        return other.norm() > 0. && turn.norm() > PressingSlipRule().turn &&
               jump.value * turn > PressingSlipRule().of_approach * std::abs(jump.value * own);
      };
      // Across a crease of the other side only one of its normals is what is touched.
      return is(jump.normal) && is(jump.facet_normal);
    }

    /// Collective. By vertex at faces that this rank knows: the unit normal of the other side in the mean
    /// over what its multiplier acts on, zero for nothing.
    std::vector<Vector3> normals_met(const ContactPair &pair)
    {
      const ContactSurface &surface = pair.nonmortar.surface;
      std::vector<Vector3>  result(surface.mesh.vertices.size());
      for (const FaceMoments &m : pair.moments)
        for (unsigned int a = 0; a < surface.faces[m.face].n_corners; ++a)
          if (!surface.faces[m.face].leaves(a))
            result[surface.faces[m.face].corners[a]] += m.facing[a];
      pair.halo->update(result);
      for (Vector3 &normal : result)
        normal = normal.norm() > 0. ? normal / normal.norm() : normal;
      return result;
    }

    /// Collective. The part of the force of a pair that nodes carry of which that holds.
    double pressed_by_slip(const Discretization &d, const ContactSolution &solution, const unsigned int p,
                           const std::vector<VertexJump> &jumps)
    {
      const ContactSurface &non    = d.pairs[p].nonmortar.surface;
      const MPI_Comm        comm   = d.nodal().communicator();
      const auto            of_all = [comm](const std::set<NodeIndex> &nodes) {
        return gather_lists(std::vector<NodeIndex>(nodes.begin(), nodes.end()), comm, Receivers::all);
      };
      std::set<NodeIndex> mine, others;
      for (const VertexJump &jump : jumps)
        if (is_pressed_by_slip(jump, non.mesh.vertex_normals[jump.vertex]))
          mine.insert(non.vertex_node[jump.vertex]);
      const std::vector<NodeIndex> list = of_all(mine);
      std::set<NodeIndex>          pressed(list.begin(), list.end());
      if (pressed.empty())
        return 0.;
      // What any facet of the other side explains, or what it is on the whole where the node acts.
      const std::vector<Vector3> means = normals_met(d.pairs[p]);
      for (const VertexJump &jump : jumps)
        if (const NodeIndex node = non.vertex_node[jump.vertex]; pressed.count(node) > 0)
          {
            const Vector3   &own = non.mesh.vertex_normals[jump.vertex], &mean = means[jump.vertex];
            const VertexJump whole = {jump.vertex, jump.value, mean, mean};
            if (!is_pressed_by_slip(jump, own) || (mean.norm() > 0. && !is_pressed_by_slip(whole, own)))
              others.insert(node);
          }
      for (const NodeIndex node : of_all(others))
        pressed.erase(node);
      const ContactStress      stress = stress_of_pair(d, solution.stress, p);
      const InterfaceCoupling &rows   = d.couplings[p].coupling;
      double                   force = 0., whole = 0.;
      for (std::size_t row = 0; row < rows.n_rows(); ++row)
        if (stress.active[row] != 0)
          {
            const double one = stress.pressure[row] * rows.weight[row];
            whole += one;
            force += pressed.count(rows.rows[row]) > 0 ? one : 0.;
          }
      whole = Utilities::MPI::sum(whole, comm);
      return whole > 0. ? Utilities::MPI::sum(force, comm) / whole : 0.;
    }
  } // namespace



  Slip largest_slip(const Discretization &d, const ContactSolution &solution, const unsigned int p)
  {
    const ContactPair    &pair   = d.pairs[p];
    const ContactSurface &non    = pair.nonmortar.surface;
    const auto            moved  = vertex_values(non, d.partition(), solution.displacement);
    const auto            mortar = pair.obstacle
                                       ? std::vector<Vector3>()
                                       : vertex_values(pair.mortar.surface, d.partition(), solution.displacement);
    const auto            jumps  = relative_displacements(pair, moved, mortar);
    const auto            counts = where_slip_counts(d, solution, p, jumps);
    std::vector<Vector3>  slip(non.mesh.vertices.size());
    Slip                  result;
    for (const auto &[v, jump, normal, facet] : jumps)
      if (counts[v] != 0)
        {
          const Vector3 &n = non.mesh.vertex_normals[v];
          slip[v]          = jump - (jump * n) * n;
          result.length    = std::max(result.length, slip[v].norm());
        }
    for (const double in_faces : slips_in_faces(non, slip))
      result.in_faces = std::max(result.in_faces, in_faces);
    const MPI_Comm comm = d.nodal().communicator();
    return {Utilities::MPI::max(result.length, comm), Utilities::MPI::max(result.in_faces, comm),
            pressed_by_slip(d, solution, p, jumps)};
  }
} // namespace Signorini

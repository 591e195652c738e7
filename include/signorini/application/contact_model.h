// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_model_h
#define signorini_application_contact_model_h

#include <signorini/application/problem_definition.h>
#include <signorini/mesh/true_shape.h>

#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  class Journal;

  /// A pair whose boundaries have been found on the bodies.
  struct PairModel
  {
    /// One of its surfaces.
    struct Side
    {
      /// Number of the body; name of the boundary and its numbers on the mesh.
      unsigned int                         body;
      std::string                          boundary;
      std::set<dealii::types::boundary_id> ids;
      /// Positive where it may touch; empty for everywhere.
      ScalarField region;
      /// What gap and normals are measured on.
      SurfaceShapes shapes;
    };

    /// As it was asked for.
    PairDefinition definition;
    /// One with an obstacle, else two.
    std::vector<Side> sides;

    /// Whether its surfaces are glued together.
    bool is_tied() const
    {
      return definition.contact == ContactKind::tied;
    }
  };

  /// How a motion moves a connected part of a body.
  struct PartMotion
  {
    /// Bodies::part().
    unsigned int part = 0;
    /// The displacement at x is at_origin + rotation × x.
    Vector3 at_origin, rotation;
  };

  /// A node that is held in one direction, because nothing else holds a motion (choose_point_holds()).
  struct PointHold
  {
    /// Of which body; NodalSpace::start_vertices(); x, y or z; where.
    unsigned int     body = 0, start_vertex = StartNodes::none, component = 0;
    dealii::Point<3> position;
    /// The displacement in which it is held (length): that of the elastic body at rest in the mean.
    double value = 0.;
    /// What it holds, by part of bodies.
    std::vector<PartMotion> moves;
    /// The same in words, and whether that moves bodies without turning them.
    std::string motion;
    bool        is_translation = false;
    /// The displacement of that motion there, relative to its mean size on the contact surfaces.
    double arm = 0.;
    /// The largest moment that it may carry, relative to that of the contact force with the size of the
    /// surfaces as its arm (of translations: force, relative to the contact force): more than facets make of
    /// loads that do not move the body.
    double largest_share = 0.;
    /// Index into Loads::dirichlet, of a model that has it.
    std::size_t condition = 0;
  };

  /// A problem on its bodies: loads and pairs, which stay, and the meshes, which are refined.
  class ContactModel
  {
  public:
    /// Collective. Errors: InputError for definitions that make no sense, with the name of the parameter as
    /// in a parameter file.
    ContactModel(const MPI_Comm communicator, ProblemDefinition problem);

    /// All ranks that have a part of the meshes.
    MPI_Comm communicator() const
    {
      return the_bodies.communicator();
    }

    /// The present meshes, with materials and boundary shapes.
    const Bodies &bodies() const
    {
      return the_bodies;
    }

    /// Conditions and forces, by body.
    const Loads &loads() const
    {
      return the_loads;
    }

    /// In the order of the definition.
    const std::vector<PairModel> &pairs() const
    {
      return the_pairs;
    }

    /// Conditions and forces are those of this pseudo-time from now on.
    void set_time(const double time)
    {
      the_loads.time = time;
    }

    /// Holds one more point, from the next ConstrainedSpace on.
    void hold(PointHold hold);

    /// Holds the i-th of these points at another displacement (PointHold::value).
    void set_hold_value(const std::size_t i, const double value);

    /// By body a number that is the same for all that chains of pairs link to each other.
    std::vector<std::size_t> linked_bodies() const;

    /// All of them.
    const std::vector<PointHold> &point_holds() const
    {
      return holds;
    }

    /// Bolts, whose strains are found while the problem is solved (solve_with_pretension()).
    std::vector<Pretension> &pretensions()
    {
      return the_loads.pretensions;
    }

    /// Collective. As Bodies::refine(). Spaces and discretizations of the mesh before stay as they are.
    bool refine(const NodalSpace &space, const std::vector<bool> &marked)
    {
      return the_bodies.refine(space, marked);
    }

    /// Collective. Halves all cells of each body so many times.
    void refine_globally(const std::vector<unsigned int> &times);

    /// The connected parts of bodies with faces on a side of a pair.
    std::set<unsigned int> parts_of(const PairModel::Side &side) const;

    /// Notes what boundary shapes did to the mesh in the last refinement.
    void note_movement(Journal &journal) const;

  private:
    PairModel find_pair(const PairDefinition &definition);

    Bodies                 the_bodies;
    Loads                  the_loads;
    std::vector<PairModel> the_pairs;
    std::vector<PointHold> holds;
  };
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_loose_motions_h
#define signorini_application_loose_motions_h

#include <signorini/application/discretization.h>
#include <signorini/solvers/obstacle_problem.h>

namespace Signorini
{
  class Journal;

  // What contact leaves loose: rigid motions of a solution that nothing determines, or only facets do.

  /// When a motion counts as loose.
  struct LooseMotionRule
  {
    /// The mean square of the normal parts of a motion at active nodes, relative to that of the motion that
    /// moves these most. Rounding: 1e-24 on a plate on balls (more far from the origin, and held then: the
    /// iteration would not end there either). So little that no solution shows how far bodies move: 6e-14 of
    /// a disc of tetrahedra that turns in a ring. What facets of round surfaces give.
    double not_opposed = 1e-22, next_to_nothing = 1e-10, hardly_opposed = 1e-4;
    /// The mean square of a combination of motions at contact nodes, each of which counts as one there, up to
    /// which bodies move as one: 2e-7 of rings with an interference of 4e-4 of their radius.
    double common = 1e-3;
    /// How far from the active nodes, in widths of a face, the surfaces may touch in truth. A coarse shaft in
    /// a V-block turns by 3 degrees until two rows of nodes are active, half a face to either side of where
    /// it would touch.
    double offset = 1.;
    /// Distance of unit normals within a face from which on they are those of two sides of an edge.
    double sharp = .6;
    /// The mean square of normal parts relative to that of the motion, both at active nodes, up to which it
    /// slides there: 0.04 in that V-block. A block that tilts about an edge does not.
    double slides = .1;
    /// How far surfaces may slide along a motion that facets oppose, in widths of a face: on a radius of
    /// ten faces that is a hundredth of a radian. Solutions that drift slide by 1e2 to 1e6 of them.
    double slip = .1;
    /// The work of loads on a motion along obstacles, relative to that of all loads with the mean size of
    /// motions at the contact nodes as their way, which may come from the mesh (as of rotations in sockets:
    /// FreedomRule::work_of_facets).
    double work_of_mesh = .05;
    /// The coefficient of a motion of a part with which it takes part in another one.
    double moves = 1e-3;
    /// The normal part of a motion at a node, relative to the motion, that does not oppose it: rounding of
    /// eigenvectors (2e-12 on a plate on balls, whose facets make 1e-5).
    double rounding = 1e-9;
  };

  /// Motions that slide along active contacts, as coefficients of the free motions.
  struct LooseMotions
  {
    /// No active contact opposes them by more than next to nothing.
    std::vector<std::vector<double>> undetermined;
    /// Facets of round surfaces do.
    std::vector<std::vector<double>> hardly_held;
    /// Of these, what is opposed as little beside what the motion itself moves there.
    std::vector<std::vector<double>> slides_on_facets;
    /// What is opposed by more than rounding in the span of those that are undetermined.
    std::vector<std::vector<double>> next_to_undetermined;
  };

  /// Collective. Those of a solution.
  /// @param fields of motions_of_unknowns(); at least one
  LooseMotions find_loose_motions(const std::vector<FreeMotion> &motions, const std::vector<Vector> &fields,
                                  const HalfSpaces &half_spaces, const std::vector<unsigned char> &active);

  /// Those of some motions that move a part which others move: what is held in a point for one of them turns
  /// about it with the rest.
  std::vector<std::vector<double>> of_same_parts(const std::vector<FreeMotion>          &motions,
                                                 const std::vector<std::vector<double>> &candidates,
                                                 const std::vector<std::vector<double>> &moving);

  /// Collective. What has to be held if a solution slides along what facets oppose by more than a tenth of a
  /// face: that, as far as the surfaces oppose it hardly wherever they touch, and what is undetermined there
  /// of the same parts; else none. The same if bodies that touch only each other may move as one, whatever
  /// they slide.
  /// @param loose of the solution
  /// @param v the solution; its values at contact nodes are relative displacements
  /// @param width of a face (length)
  std::vector<std::vector<double>> find_drift(const std::vector<FreeMotion> &motions,
                                              const std::vector<Vector>     &fields,
                                              const HalfSpaces &half_spaces, const LooseMotions &loose,
                                              const Vector &v, const double width);

  /// Collective. By half-space of a discretization the unit normal that a rigid obstacle has there, against
  /// its outward one; that of the body where there is no obstacle; zero where none is seen.
  std::vector<Vector3> normals_of_partners(const Discretization &discretization);

  /// A solution, and how bodies may move; all must outlive this.
  struct FreeSolution
  {
    /// The free motions, and fields of motions_of_unknowns().
    const std::vector<FreeMotion> &motions;
    const std::vector<Vector>     &fields;
    /// Of the problem, and which are active.
    const HalfSpaces                 &half_spaces;
    const std::vector<unsigned char> &active;
    /// Its unknowns.
    const Vector &v;
  };

  /// Collective. Errors: InputError if loads do work on a motion that leads along all rigid obstacles
  /// everywhere, more than a mesh makes of loads that do none: no frictionless obstacle holds it, though the
  /// normals of the body may.
  /// @param partners normals_of_partners()
  void refuse_loads_along_obstacles(const FreeSolution &solution, const std::vector<Vector3> &partners,
                                    const Vector &loads, const ContactModel &model);

  /// Collective. Such motions that only the normals of the body oppose, if a solution slides along them by
  /// more than a tenth of a face; else none. (A ball between a floor and a wall slides along both until nodes
  /// on either side of where it should touch are active.)
  /// @param partners normals_of_partners()
  std::vector<std::vector<double>> find_sliding(const FreeSolution         &solution,
                                                const std::vector<Vector3> &partners, const double width);

  /// The faces around the contact nodes of half-spaces.
  struct FacesAtContact
  {
    /// In the mean (length).
    double width;
    /// By half-space, what normals change by within the faces around it: differences to the unit normals of
    /// the nodes there, none across sharp edges.
    std::vector<std::vector<Vector3>> turns;

    /// The largest of them at a half-space (1).
    double turn(const std::size_t p) const
    {
      double largest = 0.;
      for (const Vector3 &one : turns[p])
        largest = std::max(largest, one.norm());
      return largest;
    }

    /// By how much the normal part of a displacement of its node changes, at most.
    double change_of_normal_part(const std::size_t p, const Vector3 &displacement) const
    {
      double largest = 0.;
      for (const Vector3 &one : turns[p])
        largest = std::max(largest, std::abs(one * displacement));
      return largest;
    }
  };

  /// Collective. Motions of single parts along which a solution slides by more than a tenth of a face, and
  /// that nothing would oppose if the surfaces touched a little way from the active nodes: how the nodes lie
  /// there stops them.
  std::vector<std::vector<double>> find_motions_of_the_mesh(const FreeSolution   &solution,
                                                            const FacesAtContact &faces);

  /// Warns of motions that only facets oppose.
  void warn_of_facets(const ContactModel &model, const std::vector<FreeMotion> &motions,
                      const std::vector<std::vector<double>> &hardly_held, Journal &journal);

  /// Collective. Of all solutions the one with the smallest displacement (sum of squares over the nodes):
  /// moves a solution along what nothing determines, as far as contact allows.
  /// @param v the solution, u its displacement
  /// @param motions coefficients of the fields; not empty
  /// @param fields of motions_of_unknowns(); `displacements` are the same motions as motion_fields()
  void minimize_displacement(Vector &v, const Vector &u, const std::vector<std::vector<double>> &motions,
                             const std::vector<Vector> &fields, const std::vector<Vector> &displacements,
                             const HalfSpaces &half_spaces);
} // namespace Signorini

#endif

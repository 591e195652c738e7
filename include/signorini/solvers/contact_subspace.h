// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_contact_subspace_h
#define signorini_solvers_contact_subspace_h

#include <signorini/solvers/free_motion_correction.h>
#include <signorini/solvers/gathered_obstacle_problem.h>
#include <signorini/solvers/motion_functions.h>
#include <signorini/solvers/multigrid_hierarchy.h>

namespace Signorini
{
  /// Minimizes over contact nodes and the functions of a coarse level at once, in all half-spaces. Rigid
  /// motions of bodies that only contact holds have no stiffness but that of the nodes that touch, and
  /// slender bodies bend over long ways: coarse corrections that do not see the half-spaces run into the next
  /// node, are shortened, and one node more is active after each iteration. Here the body moves, bends and is
  /// indented at the same time.
  ///
  /// The space is that of the coarse functions, set to zero at the contact nodes, and of all motions of
  /// those: nested products of transfers, in which contact nodes are nodes of every level; and of the rigid
  /// motions of bodies that only contact holds. Its matrix does not depend on the active set.
  class ContactSubspace
  {
  public:
    /// Which coarse level, and when.
    struct Rule
    {
      /// Nodes of the level with the number nearest to this one, as a ratio. On a lug that is pulled by a
      /// force (doc/measurements.md).
      double n_nodes = 170.;
      /// More cannot be factorized at the cost of an iteration (a mesh without coarser ones).
      unsigned int most_nodes = 5000;
      /// Contact nodes of a problem whose bodies are held otherwise: the matrix is factorized on rank 0. A
      /// sheet on a plane, finished meshes, active-set steps with V-cycles: 10,100 of them, a minimizer in
      /// 0.02 to 9 s, 77 iterations in place of 123 in 1.2 to 1.7 times the time; 40,200 of them, 128 in
      /// place of 131, 2.6 times.
      std::size_t most_contact_nodes = 20000;
      /// Used where the coarse correction, projected or shortened, lowers the energy by less than this part
      /// of what the whole one would have. Where contact lacks, 1e-7 to .03 is left; on nested starts of the
      /// lug .99 and more, and .19 to .7 in the first iterations on fine finished meshes, where the coarse
      /// functions are too stiff for the contact zone: .3 and .6 save one iteration in one of nine cases.
      double least_decrease = .1;
    };

    /// Collective. Whether a level of a hierarchy has contact nodes, not too many for the problem, and a
    /// level below it that is small enough.
    static bool exists(const MultigridHierarchy &hierarchy, const unsigned int level,
                       const ObstacleProblem &problem);

    /// Collective. Of a level of the hierarchy, with the levels below it.
    /// @param nodes nodes of the level that half-spaces restrict, sorted, those of all ranks
    /// @param free_motions rigid motions that nothing but contact holds: orthonormal, A m = 0; must outlive
    ///   the object
    ContactSubspace(const MultigridHierarchy &hierarchy, const unsigned int level,
                    const std::vector<NodeIndex> &nodes, const std::vector<Vector> &free_motions);

    /// Collective. Adds the minimizer to v, without motions that are idle then, and updates
    /// residual = rhs - A v.
    /// @param contact half-spaces of v
    void run(Vector &v, Vector &residual, ContactState &contact, FreeMotionCorrection &motions);

  private:
    /// The nodes of a coarse space: of each rank its nodes of a level, then its contact nodes.
    class Numbering
    {
    public:
      /// Collective.
      /// @param contact_begin how many contact nodes the ranks before each rank own, and all of them
      Numbering(const NodePartition &coarse, std::vector<NodeIndex> contact_begin);

      /// The number of a node of the level, of a contact node.
      NodeIndex of_coarse(const NodeIndex node) const;
      NodeIndex of_contact(const NodeIndex index) const;

      /// Sets one of the two, the node of the level or the contact node that a number stands for.
      void find(const NodeIndex number, std::optional<NodeIndex> &coarse_node,
                std::optional<NodeIndex> &contact_node) const;

      /// Of this rank.
      dealii::IndexSet owned() const;

    private:
      MPI_Comm communicator;
      /// How many nodes of the level, and how many contact nodes, the ranks before each rank own, and all.
      std::vector<NodeIndex> coarse_begin, contact_begin;
    };

    /// A space below the finest level, with its transfer to the space above.
    struct Space
    {
      Numbering                    numbering;
      NodalTransfer                to_finer;
      NodeBlockMatrix              matrix;
      std::vector<FixedDirections> fixed;
      Vector                       values;
    };

    /// Index of a node of the finest level among the contact nodes, or nothing.
    std::optional<NodeIndex> contact_index(const NodeIndex node) const;

    void          add_space(const MultigridHierarchy &hierarchy, const unsigned int coarse_level);
    NodalTransfer make_transfer(const MultigridLevel &coarse, const NodePartition &level_above,
                                const NodePartition &space_above, const Numbering &numbering) const;
    /// Collective. Local numbers in the coarsest space of the contact nodes that this rank owns.
    std::vector<unsigned int> own_contact_numbers() const;
    /// Collective. On rank 0 the nodes of motions come in front of its own.
    void gather_matrix(const MotionFunctions::Couplings &couplings);

    /// rhs - A v at the nodes of motions and the owned nodes of the coarsest space, and what holds them.
    std::vector<NodeState> restrict_state(const Vector &v, const Vector &residual,
                                          const ContactState &contact);

    const MultigridLevel  &finest;
    std::vector<NodeIndex> contact_nodes;
    /// How many of them the ranks before each rank own, and all of them.
    std::vector<NodeIndex> contact_begin;
    MotionFunctions        motion_functions;
    /// Finest first.
    std::vector<Space>      spaces;
    GatheredObstacleProblem problem;
    Vector                  step, product;
  };
} // namespace Signorini

#endif

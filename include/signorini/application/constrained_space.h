// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_constrained_space_h
#define signorini_application_constrained_space_h

#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/application/contact_model.h>
#include <signorini/discretization/rigid_support.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Rigid motions of connected parts of bodies that neither conditions nor ties exclude.
  struct FreeParts
  {
    /// Six at most for each part, or parts tied together, linearly independent; the same on all ranks.
    std::vector<FreeMotion> motions;
    /// Whether there is a part that only a tie holds: its decoupled linear problem has no unique solution.
    bool has_tied_part = false;
  };

  /// Collective. Parts that are tied together are held together, and move as one.
  FreeParts find_free_parts(const ContactModel &model, const NodalSpace &space,
                            const DirichletData &dirichlet);

  /// The nodal space of one mesh with its Dirichlet conditions, and what these leave free. Constant.
  struct ConstrainedSpace
  {
    /// Collective. Inner faces are what estimate_error() needs.
    explicit ConstrainedSpace(const ContactModel &model, const bool with_inner_faces = false);

    /// Collective. The same space with the conditions of the present time of the model
    /// (ContactModel::set_time()); the directions that they hold are the same at all times.
    ConstrainedSpace(const ConstrainedSpace &other, const ContactModel &model);

    /// Collective. The same space after the model has got conditions in more directions
    /// (ContactModel::hold()).
    static std::shared_ptr<const ConstrainedSpace> with_more_conditions(const ConstrainedSpace &other,
                                                                        const ContactModel     &model);

    /// Collective. The nodal interpolant of a displacement on the mesh that this one was refined from. Ghosts
    /// are up to date.
    /// @param rows of interpolation_rows() between the two spaces
    Vector interpolate(const Vector &displacement, const ConstrainedSpace &coarser,
                       const NodeRows &rows) const;

    /// The space itself.
    const NodalSpace &nodal() const
    {
      return *space;
    }

    /// Shared with the coarser levels of later meshes (CoarserSpaces).
    const std::shared_ptr<const NodalSpace> space;
    /// The nodes of the space that a rank sees: the layout of displacements (three components a node).
    const NodePartition partition;
    /// Prescribed components and displacements (length) at the relevant nodes.
    const DirichletData dirichlet;
    /// What the conditions do not hold.
    const FreeParts free_parts;

  private:
    ConstrainedSpace(std::shared_ptr<const NodalSpace> space, const ContactModel &model);
  };

  /// The prescribed displacements (zero at free components) at the owned nodes of a partition of the space.
  Vector prescribed_displacement(const NodalSpace &space, const NodePartition &partition,
                                 const DirichletData &dirichlet);
} // namespace Signorini

#endif

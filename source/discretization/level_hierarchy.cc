// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/discretization/coarse_contact.h>
#include <signorini/discretization/level_hierarchy.h>
#include <signorini/discretization/transformed_rows.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct SmallWeightsRule
    {
      /// Part of the largest weight of a row below which weights are dropped. 0 to 0.3 take as many
      /// iterations (hertz.prm, stiffness ratios of 1e-6 to 1e6, ν = 0.49, the knee), 0.5 and 1 one more with
      /// ν = 0.49.
      double small = .1;
    };
  } // namespace



  void drop_small_weights(InterfaceCoupling &coupling)
  {
    InterfaceCoupling kept = coupling;
    kept.entries.clear();
    kept.row_start.assign(1, 0);
    for (std::size_t p = 0; p < coupling.n_rows(); ++p)
      {
        const auto *const largest =
            std::max_element(coupling.begin(p), coupling.end(p), [](const auto &a, const auto &b) {
              return std::abs(a.weight) < std::abs(b.weight);
            });
        double      dropped = 0.;
        std::size_t place   = 0;
        for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
          if (std::abs(entry->weight) < SmallWeightsRule().small * std::abs(largest->weight))
            dropped += entry->weight;
          else
            {
              if (entry == largest)
                place = kept.entries.size();
              kept.entries.push_back(*entry);
            }
        if (largest != coupling.end(p))
          kept.entries[place].weight += dropped;
        kept.row_start.push_back(kept.entries.size());
      }
    coupling = std::move(kept);
  }



  namespace
  {
    /// Fixed axes of coordinates are fixed on the coarser mesh too, but directions of rollers on a curved
    /// boundary are others there.
    std::vector<FixedDirections> only_oblique(std::vector<FixedDirections> fixed)
    {
      for (FixedDirections &f : fixed)
        if (f.is_along_axes())
          f = FixedDirections();
      return fixed;
    }



    /// v = T⁻¹ u, zero in fixed components, in place.
    void make_relative(Vector &u, const NodePartition &partition, const std::vector<FixedDirections> &fixed,
                       const InterfaceCoupling &coupling, const std::vector<RowProjection> &projections)
    {
      const std::vector<NodeIndex> nodes  = interface_nodes(coupling);
      const std::vector<Vector3>   values = import_values(partition, u, nodes);
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        {
          Vector3 value;
          for (unsigned int c = 0; c < dim; ++c)
            value[c] = u.local_element(dim * i + c);
          if (const std::ptrdiff_t p = coupling.find(partition.to_global(i)); p >= 0)
            {
              for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
                value -= entry->weight *
                         values[std::lower_bound(nodes.begin(), nodes.end(), entry->node) - nodes.begin()];
              value = projections[p].apply(value);
            }
          value = project_free(fixed[i], value);
          for (unsigned int c = 0; c < dim; ++c)
            u.local_element(dim * i + c) = value[c];
        }
    }



    /// The contact nodes that a rank owns, with the directions of their half-spaces; no bounds.
    HalfSpaces contact_nodes(const InterfaceCoupling &coupling, const std::vector<RowProjection> &projections,
                             const NodePartition &partition)
    {
      HalfSpaces result;
      for (std::size_t p = 0; p < coupling.n_rows(); ++p)
        if (partition.owns(coupling.rows[p]) && projections[p].direction().norm_square() > 0.)
          {
            result.nodes.push_back(partition.to_local(coupling.rows[p]));
            result.normals.push_back(projections[p].direction());
            result.shares.push_back(projections[p].share());
          }
      return result;
    }
  } // namespace



  std::vector<Vector> rigid_motions(const std::vector<Point<3>> &positions, const NodePartition &partition,
                                    const std::vector<FixedDirections> &fixed,
                                    const InterfaceCoupling            &coupling,
                                    const std::vector<RowProjection>   &projections)
  {
    Point<3> centre;
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      centre += Vector3(positions[i]);
    for (unsigned int c = 0; c < dim; ++c)
      centre[c] = Utilities::MPI::sum(centre[c], partition.communicator()) /
                  static_cast<double>(partition.n_global());
    std::vector<Vector> motions(2 * dim);
    for (unsigned int m = 0; m < 2 * dim; ++m)
      {
        FreeMotion motion{{}, {}, centre, 1., Vector3(), Vector3()};
        (m < dim ? motion.translation : motion.rotation)[m % dim] = 1.;
        partition.reinit(motions[m]);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          {
            const Vector3 u = motion(positions[i]);
            for (unsigned int c = 0; c < dim; ++c)
              motions[m].local_element(dim * i + c) = u[c];
          }
        make_relative(motions[m], partition, fixed, coupling, projections);
      }
    return motions;
  }



  namespace
  {
    /// The levels below the finest mesh, with couplings, projections and half-spaces of their own.
    class LevelsOfMeshes : public LevelSource
    {
    public:
      /// @param partition of the finest level
      LevelsOfMeshes(const LevelSpaces &spaces, const InterfaceCoupling &coupling,
                     const std::vector<RowProjection> &projections, const HierarchyOptions &options,
                     const NodePartition &partition)
        : spaces(spaces)
        , options(options)
        , level(spaces.n_levels() - 1)
      {
        const auto rows  = owned_rows(coupling, partition);
        fine             = select_rows(coupling, rows);
        fine_projections = select_values(projections, rows);
        tied             = options.tied.empty() ? std::vector<unsigned char>(rows.size(), 0)
                                                : select_values(options.tied, rows);
      }

      /// Collective. Contact nodes of the level that was described last.
      LevelInterface interface(const MPI_Comm communicator) const
      {
        return {sorted_nodes(gather_lists(interface_nodes(fine), communicator, Receivers::all)),
                options.has_stiff_nonmortar};
      }

      /// The levels get half-spaces that are injected from those of the finest one.
      void inject(const HalfSpaces &finest, const NodePartition &partition)
      {
        half_spaces     = half_spaces_of_rows(finest, partition, fine.rows);
        has_half_spaces = true;
      }

      std::optional<CoarserLevel> next(const NodePartition &finer) override;
      LevelZero                   level_zero(const NodePartition &coarsest) override;

    private:
      const LevelSpaces      &spaces;
      const HierarchyOptions &options;
      /// What the rows of P̂ of the local nodes of a level refer to.
      struct RowSurroundings;

      RowSurroundings surroundings(const NodePartition &finer, const NodeRows &rows,
                                   const InterfaceCoupling          &coarse,
                                   const std::vector<RowProjection> &projections,
                                   const NodePartition              &coarser) const;

      /// That was described last; of the contact nodes that this rank owns its coupling S, A of its rows,
      /// which of them are tied (on the finest level), and half-spaces.
      unsigned int               level;
      InterfaceCoupling          fine;
      std::vector<RowProjection> fine_projections;
      std::vector<unsigned char> tied;
      RowHalfSpaces              half_spaces;
      bool                       has_half_spaces = false;
    };



    /// The unknowns of rigid faces of a body in a motion of it.
    void set_rigid_faces(Vector &v, const NodePartition &partition, const RigidFaces &rigid,
                         const FreeMotion &motion)
    {
      for (unsigned int f = 0; f < rigid.faces().size(); ++f)
        if (std::count(motion.bodies.begin(), motion.bodies.end(), rigid.faces()[f].body) > 0)
          rigid.set_motion(v, partition, f, motion, motion.rotation / motion.length);
    }



    struct LevelsOfMeshes::RowSurroundings
    {
      /// Rows of the local nodes of the finer level.
      InterfaceCoupling          fine;
      std::vector<RowProjection> fine_projections;
      std::vector<unsigned char> tied;
      /// Nodes of their rows and columns, with their rows of P.
      std::vector<NodeIndex> nodes;
      NodeRows               node_rows;
      /// Rows of the coarse nodes that all of these rows of P lead to.
      InterfaceCoupling          coarse;
      std::vector<RowProjection> coarse_projections;
    };



    /// @param rows of P, of the local nodes
    LevelsOfMeshes::RowSurroundings LevelsOfMeshes::surroundings(
        const NodePartition &finer, const NodeRows &rows, const InterfaceCoupling &coarse,
        const std::vector<RowProjection> &projections, const NodePartition &coarser) const
    {
      RowSurroundings        result;
      std::vector<NodeIndex> local(fine.rows);
      local.insert(local.end(), finer.ghosts().begin(), finer.ghosts().end());
      const NodeRequest request(finer, sorted_nodes(std::move(local)));
      result.fine             = import_rows(fine, request);
      result.fine_projections = import_row_values(fine, fine_projections, request);
      if (level + 1 == spaces.n_levels())
        result.tied = import_row_values(fine, tied, request);
      result.nodes     = interface_nodes(result.fine);
      result.node_rows = import_rows(finer, spaces.interpolation(level), result.nodes);

      std::vector<NodeIndex> columns(coarse.rows);
      for (const NodeRows *const list : {&rows, static_cast<const NodeRows *>(&result.node_rows)})
        std::copy_if(list->columns.begin(), list->columns.end(), std::back_inserter(columns),
                     [&](const NodeIndex node) { return !coarser.owns(node); });
      const NodeRequest coarse_request(coarser, sorted_nodes(std::move(columns)));
      result.coarse             = import_rows(coarse, coarse_request);
      result.coarse_projections = import_row_values(coarse, projections, coarse_request);
      return result;
    }



    std::optional<CoarserLevel> LevelsOfMeshes::next(const NodePartition &finer)
    {
      if (level == 0)
        return {};
      CoarserLevel result;
      result.owned = spaces.owned(level - 1);
      result.fixed = spaces.fixed(level - 1);
      const NodePartition partition(result.owned, IndexSet(result.owned.size()), finer.communicator());
      const std::vector<NodeIndex> nodes     = interface_nodes(fine);
      const NodeRows               node_rows = import_rows(finer, spaces.interpolation(level), nodes);
      CoarseCoupling coarse = coarsen_coupling(fine, fine_projections, nodes, node_rows, partition);
      // Coarse obstacles bound the relative displacements themselves, not just a basis. (Those for a start
      // may be rough.)
      if (!options.coarse_obstacles)
        drop_small_weights(coarse.coupling);
      std::vector<RowProjection> projections = coarse_projections(coarse, result.fixed, partition);

      NodeRows              rows = import_ghost_rows(finer, spaces.interpolation(level));
      const RowSurroundings here = surroundings(finer, rows, coarse.coupling, projections, partition);
      ContactOfLevels       contact{here.fine,
                              here.fine_projections,
                              here.nodes,
                              here.node_rows,
                              here.coarse,
                              here.coarse_projections,
                              options.coarse_obstacles,
                              here.tied,
                              {},
                              {}};
      if (!spaces.is_nested(level - 1))
        {
          contact.fixed      = import_ghost_masks(finer, spaces.fixed(level));
          contact.node_fixed = import_masks(finer, spaces.fixed(level), here.nodes);
          has_half_spaces    = false;
        }
      else if (spaces.has_rollers())
        {
          contact.fixed      = only_oblique(import_ghost_masks(finer, spaces.fixed(level)));
          contact.node_fixed = only_oblique(import_masks(finer, spaces.fixed(level), here.nodes));
        }
      contact.fine_rigid    = spaces.rigid(level);
      contact.coarse_rigid  = spaces.rigid(level - 1);
      const auto block_rows = transformed_rows(finer, rows, contact);
      result.transfer.reinit(std::move(rows), block_rows, finer.n_owned());
      if (options.coarse_obstacles)
        result.contact = contact_nodes(coarse.coupling, projections, partition);
      // Background levels have no nodes in common with a mesh, of which they could take bounds.
      if (has_half_spaces)
        {
          half_spaces        = inject_half_spaces(half_spaces, fine, nodes, node_rows,
                                                  {coarse.coupling, projections}, partition);
          result.half_spaces = own_half_spaces(half_spaces, coarse.coupling.rows, partition);
        }
      fine             = std::move(coarse.coupling);
      fine_projections = std::move(projections);
      tied.clear();
      --level;
      result.interface = interface(finer.communicator());
      if (level <= spaces.n_background_levels() && spaces.n_background_levels() > 0)
        result.correction = {2, true};
      return result;
    }



    LevelZero LevelsOfMeshes::level_zero(const NodePartition &coarsest)
    {
      LevelZero result;
      result.method             = options.level_zero;
      result.is_nearly_singular = spaces.n_background_levels() > 0;
      result.n_steps            = options.level_zero_steps;
      // A hierarchy of one level: its copy has the same contact nodes.
      if (options.coarse_obstacles)
        result.contact = contact_nodes(fine, fine_projections, coarsest);
      if (!options.free_motions.empty())
        {
          result.free_motions = motion_fields(options.free_motions, spaces.coarsest_places(), coarsest);
          for (std::size_t m = 0; m < result.free_motions.size(); ++m)
            {
              Vector &motion = result.free_motions[m];
              make_relative(motion, coarsest, spaces.fixed(0), fine, fine_projections);
              if (spaces.rigid(0) != nullptr)
                set_rigid_faces(motion, coarsest, *spaces.rigid(0), options.free_motions[m]);
            }
          orthonormalize(result.free_motions);
        }
      if (result.uses_amg(coarsest.n_global()))
        result.near_kernel = rigid_motions(spaces.coarsest_places().positions, coarsest, spaces.fixed(0),
                                           fine, fine_projections);
      return result;
    }
  } // namespace



  MultigridHierarchy build_hierarchy(LinearSystem &&system, const LevelSpaces &spaces,
                                     const InterfaceCoupling          &coupling,
                                     const std::vector<RowProjection> &projections,
                                     const HierarchyOptions           &options)
  {
    LevelsOfMeshes levels(spaces, coupling, projections, options, system.matrix.partition());
    HierarchyParts parts;
    parts.matrix    = std::move(system.matrix);
    parts.fixed     = std::move(system.fixed);
    parts.interface = levels.interface(parts.matrix.partition().communicator());
    parts.levels    = &levels;
    parts.problem   = options.problem;
    parts.start     = options.start;
    if (options.problem != nullptr && options.start == nullptr)
      levels.inject(options.problem->half_spaces, parts.matrix.partition());
    return MultigridHierarchy(std::move(parts));
  }
} // namespace Signorini

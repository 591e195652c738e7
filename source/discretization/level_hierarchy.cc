// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/vector_span.h>
#include <signorini/discretization/coarse_contact.h>
#include <signorini/discretization/level_hierarchy.h>
#include <signorini/discretization/transformed_rows.h>

namespace Signorini
{
  using namespace dealii;

  InterfaceCoupling coarsen_coupling(const InterfaceCoupling &fine, const std::vector<NodeIndex> &nodes,
                                     const NodeRows &rows)
  {
    const auto row_of = [&](const NodeIndex node) {
      return std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
    };
    std::map<NodeIndex, std::map<NodeIndex, double>> sums;
    std::map<NodeIndex, double>                      weights;
    for (std::size_t p = 0; p < fine.n_rows(); ++p)
      {
        std::map<NodeIndex, double> mapped;
        for (const auto *entry = fine.begin(p); entry != fine.end(p); ++entry)
          {
            const std::size_t q = row_of(entry->node);
            for (std::size_t k = rows.start[q]; k < rows.start[q + 1]; ++k)
              mapped[rows.columns[k]] += entry->weight * rows.weights[k];
          }
        const std::size_t i = row_of(fine.rows[p]);
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          {
            const double w = rows.weights[k] * fine.weight[p];
            weights[rows.columns[k]] += w;
            for (const auto &[column, value] : mapped)
              sums[rows.columns[k]][column] += w * value;
          }
      }
    InterfaceCoupling coarse;
    for (const auto &[node, weight] : weights)
      {
        coarse.rows.push_back(node);
        coarse.weight.push_back(weight);
        // Only a choice of the basis: columns that are rows themselves are left out, so that S² = 0.
        for (const auto &[column, value] : sums[node])
          if (weights.count(column) == 0)
            coarse.entries.push_back({column, value / weight});
        coarse.row_start.push_back(coarse.entries.size());
      }
    return coarse;
  }



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
    std::vector<NodeIndex> interface_nodes(const InterfaceCoupling &coupling)
    {
      std::vector<NodeIndex> nodes(coupling.rows);
      for (const auto &entry : coupling.entries)
        nodes.push_back(entry.node);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      return nodes;
    }



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
      const std::vector<Vector3>   values = replicate_values(partition, u, nodes);
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
        FreeMotion motion{0, centre, 1., Vector3(), Vector3(), 0};
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
      LevelsOfMeshes(const LevelSpaces &spaces, const InterfaceCoupling &coupling,
                     const std::vector<RowProjection> &projections, const HierarchyOptions &options)
        : spaces(spaces)
        , options(options)
        , level(spaces.n_levels() - 1)
        , fine(coupling)
        , fine_projections(projections)
      {
      }

      /// Contact nodes of the level that was described last.
      LevelInterface interface() const
      {
        return {interface_nodes(fine), options.has_stiff_nonmortar};
      }

      /// The levels get half-spaces that are injected from those of the finest one.
      void inject(const HalfSpaces &finest, const NodePartition &partition)
      {
        half_spaces = replicate_half_spaces(finest, partition, fine.rows);
      }

      std::optional<CoarserLevel> next(const NodePartition &finer) override;
      LevelZero                   level_zero(const NodePartition &coarsest) override;

    private:
      const LevelSpaces      &spaces;
      const HierarchyOptions &options;
      /// That was described last, its coupling S, A of its rows, and half-spaces.
      unsigned int               level;
      InterfaceCoupling          fine;
      std::vector<RowProjection> fine_projections;
      RowHalfSpaces              half_spaces;
    };



    /// The unknowns of rigid faces of a body in a motion of it.
    void set_rigid_faces(Vector &v, const NodePartition &partition, const RigidFaces &rigid,
                         const FreeMotion &motion)
    {
      for (unsigned int f = 0; f < rigid.faces().size(); ++f)
        if (rigid.faces()[f].body == motion.body)
          rigid.set_motion(v, partition, f, motion, motion.rotation / motion.length);
    }



    std::optional<CoarserLevel> LevelsOfMeshes::next(const NodePartition &finer)
    {
      if (level == 0)
        return {};
      const std::vector<NodeIndex> nodes     = interface_nodes(fine);
      NodeRows                     rows      = import_ghost_rows(finer, spaces.interpolation(level));
      const NodeRows               node_rows = replicate_rows(finer, spaces.interpolation(level), nodes);
      InterfaceCoupling            coarse    = coarsen_coupling(fine, nodes, node_rows);
      // Coarse obstacles bound the relative displacements themselves, not just a basis. (Those for a start
      // may be rough.)
      if (!options.coarse_obstacles)
        drop_small_weights(coarse);
      CoarserLevel result;
      result.owned = spaces.owned(level - 1);
      result.fixed = spaces.fixed(level - 1);
      const NodePartition        partition(result.owned, IndexSet(result.owned.size()), finer.communicator());
      std::vector<RowProjection> projections =
          coarsen_projections(fine_projections, fine, nodes, node_rows, coarse,
                              replicate_masks(partition, result.fixed, coarse.rows));
      const std::vector<unsigned char> none_tied;
      ContactOfLevels                  contact{fine,
                              fine_projections,
                              nodes,
                              node_rows,
                              coarse,
                              projections,
                              options.coarse_obstacles,
                              level + 1 == spaces.n_levels() ? options.tied : none_tied,
                              {},
                              {}};
      if (!spaces.is_nested(level - 1))
        {
          contact.fixed      = import_ghost_masks(finer, spaces.fixed(level));
          contact.node_fixed = replicate_masks(finer, spaces.fixed(level), nodes);
          half_spaces        = RowHalfSpaces();
        }
      else if (spaces.has_rollers())
        {
          contact.fixed      = only_oblique(import_ghost_masks(finer, spaces.fixed(level)));
          contact.node_fixed = only_oblique(replicate_masks(finer, spaces.fixed(level), nodes));
        }
      contact.fine_rigid    = spaces.rigid(level);
      contact.coarse_rigid  = spaces.rigid(level - 1);
      const auto block_rows = transformed_rows(finer, rows, contact);
      result.transfer.reinit(std::move(rows), block_rows, finer.n_owned());
      if (options.coarse_obstacles)
        result.contact = contact_nodes(coarse, projections, partition);
      // Background levels have no nodes in common with a mesh, of which they could take bounds.
      if (!half_spaces.normals.empty())
        {
          half_spaces        = inject_half_spaces(half_spaces, fine, nodes, node_rows, coarse, projections);
          result.half_spaces = own_half_spaces(half_spaces, coarse.rows, partition);
        }
      fine             = std::move(coarse);
      fine_projections = std::move(projections);
      --level;
      result.interface = interface();
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
    LevelsOfMeshes levels(spaces, coupling, projections, options);
    HierarchyParts parts;
    parts.matrix    = std::move(system.matrix);
    parts.fixed     = std::move(system.fixed);
    parts.interface = levels.interface();
    parts.levels    = &levels;
    parts.problem   = options.problem;
    parts.start     = options.start;
    if (options.problem != nullptr && options.start == nullptr)
      levels.inject(options.problem->half_spaces, parts.matrix.partition());
    return MultigridHierarchy(std::move(parts));
  }
} // namespace Signorini

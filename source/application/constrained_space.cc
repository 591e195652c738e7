// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/constrained_space.h>

#include <map>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// All parts of the bodies, those together that ties make move as one.
    std::vector<TiedParts> groups_of_ties(const ContactModel &model)
    {
      std::vector<unsigned int> group(model.bodies().n_parts());
      std::iota(group.begin(), group.end(), 0);
      for (const PairModel &pair : model.pairs())
        if (pair.is_tied())
          {
            const unsigned int to = group[*model.parts_of(pair.sides[0]).begin()];
            for (const PairModel::Side &side : pair.sides)
              for (const unsigned int part : model.parts_of(side))
                {
                  const unsigned int from = group[part];
                  std::replace(group.begin(), group.end(), from, to);
                }
          }
      std::map<unsigned int, TiedParts> parts;
      for (unsigned int part = 0; part < group.size(); ++part)
        parts[group[part]].push_back(part);
      std::vector<TiedParts> result;
      for (const auto &[number, tied] : parts)
        result.push_back(tied);
      return result;
    }
  } // namespace



  FreeParts find_free_parts(const ContactModel &model, const NodalSpace &space,
                            const DirichletData &dirichlet)
  {
    const std::vector<TiedParts> groups = groups_of_ties(model);
    FreeParts                    result;
    result.motions = free_motions(model.bodies(), space, dirichlet, groups);
    if (groups.size() < model.bodies().n_parts())
      for (const FreeMotion &motion :
           free_motions(model.bodies(), space, dirichlet, separate_parts(model.bodies())))
        result.has_tied_part =
            result.has_tied_part || std::any_of(groups.begin(), groups.end(), [&](const TiedParts &group) {
              return group.size() > 1 && std::binary_search(group.begin(), group.end(), motion.first_part());
            });
    return result;
  }



  ConstrainedSpace::ConstrainedSpace(std::shared_ptr<const NodalSpace> nodal, const ContactModel &model)
    : space(std::move(nodal))
    , partition(space->owned(), space->relevant(), model.communicator())
    , dirichlet(evaluate_dirichlet(*space, model.loads(), true))
    , free_parts(find_free_parts(model, *space, dirichlet))
  {
  }



  ConstrainedSpace::ConstrainedSpace(const ContactModel &model, const bool with_inner_faces)
    : ConstrainedSpace(
          std::make_shared<const NodalSpace>(model.communicator(), model.bodies().mesh(), with_inner_faces),
          model)
  {
  }



  std::shared_ptr<const ConstrainedSpace>
  ConstrainedSpace::with_more_conditions(const ConstrainedSpace &other, const ContactModel &model)
  {
    return std::shared_ptr<const ConstrainedSpace>(new ConstrainedSpace(other.space, model));
  }



  ConstrainedSpace::ConstrainedSpace(const ConstrainedSpace &other, const ContactModel &model)
    : space(other.space)
    , partition(other.partition)
    , dirichlet(evaluate_dirichlet(*space, model.loads(), true))
    , free_parts(other.free_parts)
  {
  }



  namespace
  {
    /// The owned values of a field, and those of the nodes that rows of interpolation need.
    NodePartition replicate_sources(Vector &values, const Vector &field, const NodalSpace &space,
                                    const NodeRows &rows)
    {
      std::vector<NodeIndex> columns;
      for (const NodeIndex column : rows.columns)
        if (!space.owned().is_element(column))
          columns.push_back(column);
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      IndexSet needed = space.owned();
      needed.add_indices(columns.begin(), columns.end());
      NodePartition sources(space.owned(), needed, space.communicator());
      sources.reinit(values);
      for (unsigned int i = 0; i < dim * sources.n_owned(); ++i)
        values.local_element(i) = field.local_element(i);
      values.update_ghost_values();
      return sources;
    }
  } // namespace



  Vector ConstrainedSpace::interpolate(const Vector &displacement, const ConstrainedSpace &coarser,
                                       const NodeRows &rows) const
  {
    Vector              values, result;
    const NodePartition sources = replicate_sources(values, displacement, *coarser.space, rows);
    partition.reinit(result);
    const auto add = [&](const NodeIndex to, const double weight, const Vector &from, const unsigned int i) {
      for (unsigned int c = 0; c < dim; ++c)
        result.local_element(dim * to + c) += weight * from.local_element(dim * i + c);
    };
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        add(i, rows.weights[k], values, sources.to_local(rows.columns[k]));
    result.update_ghost_values();
    for (const auto &line : space->hanging_nodes().get_lines())
      if (partition.owns(line.index))
        for (const auto &[parent, weight] : line.entries)
          add(partition.to_local(line.index), weight, result, partition.to_local(parent));
    result.update_ghost_values();
    return result;
  }



  Vector prescribed_displacement(const NodalSpace &space, const NodePartition &partition,
                                 const DirichletData &dirichlet)
  {
    Vector result;
    partition.reinit(result);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result.local_element(dim * i + c) =
            dirichlet.value[space.relevant().index_within_set(partition.to_global(i))][c];
    return result;
  }
} // namespace Signorini

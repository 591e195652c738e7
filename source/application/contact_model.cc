// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_model.h>
#include <signorini/application/journal.h>

#include <iomanip>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Takes them out: meshes are large.
    std::vector<BodyDefinition> take_bodies(ProblemDefinition &problem)
    {
      if (problem.bodies.empty())
        throw InputError("Bodies: there is none.");
      std::vector<BodyDefinition> bodies;
      for (BodyProblem &body : problem.bodies)
        bodies.push_back(std::move(body.body));
      return bodies;
    }

    void check(const PairDefinition &pair)
    {
      const std::string section = "Pair " + pair.name + "/";
      if (pair.obstacle)
        {
          if (!pair.second.body.empty())
            throw InputError(section + "Obstacle: a pair has either a second surface or an obstacle.");
          if (pair.second.region || pair.nonmortar == NonmortarChoice::second)
            throw InputError(section + "Obstacle: there is no second surface that \"Second region\" or "
                                       "\"Nonmortar = second\" could mean.");
          if (pair.prescribed_gap)
            throw InputError(section + "Initial gap: the obstacle gives the gap; write it as \"Obstacle = "
                                       "function: ...\" to prescribe it.");
          if (pair.contact == ContactKind::tied)
            throw InputError(section + "Contact: a body cannot be tied to an obstacle; prescribe its "
                                       "displacement instead.");
        }
      else if (pair.gap == GapKind::nodal && !pair.prescribed_gap)
        throw InputError(section + "Gap: nodal gaps need an obstacle or a prescribed initial gap.");
    }
  } // namespace



  ContactModel::ContactModel(const MPI_Comm communicator, ProblemDefinition problem)
    : the_bodies(communicator, take_bodies(problem))
  {
    for (unsigned int b = 0; b < problem.bodies.size(); ++b)
      the_loads.add(the_bodies, b, problem.bodies[b].loads);
    for (const PairDefinition &pair : problem.pairs)
      {
        check(pair);
        the_pairs.push_back(find_pair(pair));
      }
  }



  PairModel ContactModel::find_pair(const PairDefinition &definition)
  {
    PairModel       pair{definition, {}};
    const PairSide *sides[2] = {&definition.first, &definition.second};
    const char     *names[2] = {"First", "Second"};
    for (unsigned int i = 0; i < (definition.obstacle ? 1 : 2); ++i)
      {
        const std::string where = "Pair " + definition.name + "/" + names[i];
        PairModel::Side   side;
        side.body     = the_bodies.body_index(sides[i]->body, where);
        side.boundary = sides[i]->boundary;
        side.ids      = the_bodies.boundary_ids(side.body, side.boundary, where);
        side.region   = sides[i]->region;
        if (definition.surface != SurfaceKind::faceted && !pair.is_tied())
          the_bodies.follow_start_mesh(side.body, side.ids, definition.surface == SurfaceKind::smooth);
        side.shapes = {
            the_bodies.true_shapes(side.body, side.ids, definition.surface != SurfaceKind::automatic),
            definition.surface != SurfaceKind::faceted};
        pair.sides.push_back(std::move(side));
      }
    return pair;
  }



  void ContactModel::hold(PointHold hold)
  {
    DirichletCondition condition;
    condition.body         = hold.body;
    condition.boundary     = "held point";
    condition.start_vertex = hold.start_vertex;
    hold.condition         = the_loads.dirichlet.size();
    the_loads.dirichlet.push_back(condition);
    holds.push_back(std::move(hold));
    set_hold_value(holds.size() - 1, holds.back().value);
  }



  void ContactModel::set_hold_value(const std::size_t i, const double value)
  {
    holds[i].value                                                         = value;
    the_loads.dirichlet[holds[i].condition].components[holds[i].component] = [value](const Point<3> &) {
      return value;
    };
  }



  std::vector<std::size_t> ContactModel::linked_bodies() const
  {
    DisjointSets linked(the_bodies.n_bodies());
    for (const PairModel &pair : pairs())
      for (const PairModel::Side &side : pair.sides)
        linked.unite(side.body, pair.sides[0].body);
    std::vector<std::size_t> result;
    for (unsigned int b = 0; b < the_bodies.n_bodies(); ++b)
      result.push_back(linked.find(b));
    return result;
  }



  void ContactModel::refine_globally(const std::vector<unsigned int> &times)
  {
    AssertDimension(times.size(), the_bodies.n_bodies());
    for (unsigned int i = 0; i < *std::max_element(times.begin(), times.end()); ++i)
      {
        const NodalSpace  space(communicator(), the_bodies.mesh());
        std::vector<bool> marked;
        for (const NodalSpace::Cell &cell : space.cells())
          marked.push_back(i < times[the_bodies.body_of_material(cell.material)]);
        refine(space, marked);
      }
  }



  std::set<unsigned int> ContactModel::parts_of(const PairModel::Side &side) const
  {
    std::set<unsigned int> result;
    for (const types::boundary_id id : side.ids)
      for (unsigned int part = 0; part < the_bodies.n_parts(); ++part)
        if (the_bodies.part(part).boundaries.count(id) > 0)
          result.insert(part);
    return result;
  }



  void ContactModel::note_movement(Journal &journal) const
  {
    const MovementReport &m = the_bodies.movement();
    for (const auto &[id, entry] : m.late)
      {
        std::string pairs;
        for (const PairModel &pair : the_pairs)
          for (const PairModel::Side &side : pair.sides)
            if (side.ids.count(id) > 0)
              pairs += (pairs.empty() ? "" : ", ") + pair.definition.name;
        std::ostringstream text;
        text << std::setprecision(3) << (pairs.empty() ? "" : "warning: ") << the_bodies.boundary_name(id)
             << ": " << entry.first
             << " of the nodes that moved to its shape are not there yet, to keep cells from "
             << "degenerating (at most " << entry.second << " away; worst quality " << m.quality_before
             << " before moving, " << m.quality_after << " after).";
        if (!pairs.empty())
          text << " The gap of pair " << pairs
               << " is measured from the shape all the same, but the stiffness of the dented cells is not "
                  "that of "
               << "the body: use a better or finer start mesh at this boundary, or \"Snap boundary "
                  "vertices\".";
        journal.note(text.str());
      }
  }
} // namespace Signorini

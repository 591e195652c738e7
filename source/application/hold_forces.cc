// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/point_holds.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct IdleRule
    {
      /// Contact forces below this share of the largest one of all bodies that are linked by pairs count as
      /// that: nothing loads the balls of a bearing opposite to its load, and what is held there carries what
      /// rounding leaves (4.8e-10 beside 890). Of all bodies this share is rounding.
      double idle = 1e-6, nothing = 1e-11;
    };

    /// Sums of the contact forces on each body.
    std::vector<double> contact_forces(const ContactModel &model, const Discretization &d,
                                       const ContactSolution &solution)
    {
      std::vector<double> result(model.bodies().n_bodies(), 0.);
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        {
          const double load = evaluate_pair(d, solution, p).load;
          for (const PairModel::Side &side : model.pairs()[p].sides)
            result[side.body] += load;
        }
      return result;
    }

    /// By body, up to which force nothing presses it against another one. Bodies that no pairs link to it,
    /// other problems in the same file, count as far as rounding goes.
    std::vector<double> idle_forces(const ContactModel &model, const std::vector<double> &forces)
    {
      constexpr IdleRule             rule;
      const std::vector<std::size_t> linked = model.linked_bodies();
      std::vector<double>            of_sets(forces.size(), 0.), result;
      for (unsigned int b = 0; b < forces.size(); ++b)
        of_sets[linked[b]] = std::max(of_sets[linked[b]], forces[b]);
      const double largest = *std::max_element(forces.begin(), forces.end());
      for (unsigned int b = 0; b < forces.size(); ++b)
        result.push_back(std::max(rule.idle * of_sets[linked[b]], rule.nothing * largest));
      return result;
    }

    /// What a point carries: its force; its moment, relative to contact force and size of the surfaces;
    /// whether nothing presses its body.
    struct HoldForce
    {
      double force, share;
      bool   is_idle;
    };

    /// Collective. By point hold.
    std::vector<HoldForce> forces_of_holds(const ContactModel &model, const Discretization &d,
                                           const ContactSolution &solution)
    {
      const Equilibrium         equilibrium = evaluate_equilibrium(model, d, solution);
      const std::vector<double> forces      = contact_forces(model, d, solution),
                                idle        = idle_forces(model, forces);
      std::vector<HoldForce> result;
      for (const PointHold &hold : model.point_holds())
        {
          const double reaction = equilibrium.reactions[hold.condition].reaction.norm();
          const double scale    = std::max({forces[hold.body], reaction, idle[hold.body]});
          result.push_back({reaction, reaction * hold.arm / scale, forces[hold.body] <= idle[hold.body]});
        }
      return result;
    }
  } // namespace



  namespace
  {
    /// What the points carry that a body is held in.
    struct HeldBody
    {
      std::vector<const PointHold *> points;
      /// The largest force; the largest moment, relative to contact force and size of the surfaces.
      double reaction = 0., share = 0.;

      /// For a note.
      std::string describe(const std::string &body) const
      {
        std::ostringstream text;
        text << std::setprecision(2);
        if (points.size() == 1 && points[0]->is_translation)
          text << points[0]->motion << ": frictionless contact does not hold it, so the point "
               << place(*points[0]) << " is held in " << component(*points[0]) << " and carries a force of "
               << reaction << ", " << share
               << " of the contact force: an error of the mesh, or a force of the loads.";
        else if (points.size() == 1)
          text << points[0]->motion << ": frictionless contact does not hold it, so the point "
               << place(*points[0]) << " is held in " << component(*points[0]) << " and carries a force of "
               << reaction << ", whose moment is " << share
               << " of contact force times size of the surfaces: an error of the facets, or a moment of the "
                  "loads.";
        else
          {
            text << body << ": frictionless contact does not hold " << points.size()
                 << " of its motions, so points are held: ";
            for (const PointHold *const point : points)
              text << (point == points[0] ? "" : ", ") << place(*point) << " in " << component(*point);
            text << ". They carry forces of at most " << reaction
                 << "; these, or their moments over the size of the surfaces, are at most " << share
                 << " of the contact force: errors of the mesh, or of the loads.";
          }
        return text.str();
      }

    private:
      static char component(const PointHold &point)
      {
        return "xyz"[point.component];
      }

      static std::string place(const PointHold &point)
      {
        std::ostringstream text;
        text << std::setprecision(6);
        for (unsigned int c = 0; c < dim; ++c)
          text << (c == 0 ? "(" : " ")
               << (std::abs(point.position[c]) > 1e-12 * point.position.norm() ? point.position[c] : 0.);
        return text.str() + ")";
      }
    };
  } // namespace



  double strain_of_point_holds(const ContactModel &model, const Discretization &d,
                               const ContactSolution &solution)
  {
    if (model.point_holds().empty())
      return 0.;
    if (solution.displacement.size() == 0)
      return std::numeric_limits<double>::infinity();
    const std::vector<HoldForce> forces = forces_of_holds(model, d, solution);
    double                       result = 0.;
    for (std::size_t i = 0; i < forces.size(); ++i)
      result = std::max(result, forces[i].share / model.point_holds()[i].largest_share);
    return result;
  }



  std::vector<std::string> check_point_holds(const ContactModel &model, const Discretization &d,
                                             const ContactSolution &solution)
  {
    if (model.point_holds().empty())
      return {};
    const std::vector<HoldForce> forces = forces_of_holds(model, d, solution);
    // By body.
    std::map<unsigned int, HeldBody> held;
    std::set<std::string>            idle;
    for (std::size_t i = 0; i < forces.size(); ++i)
      {
        const PointHold &hold                  = model.point_holds()[i];
        const auto &[reaction, share, is_idle] = forces[i];
        if (share > hold.largest_share)
          {
            std::ostringstream text;
            text << std::setprecision(2) << "The loads move " << hold.motion
                 << ", which frictionless contact does not hold. A point that was held instead carries a "
                    "moment of "
                 << share
                 << " times contact force and size of the surfaces. Prescribe a displacement, or change the "
                    "loads.";
            throw InputError(text.str());
          }
        if (is_idle)
          {
            idle.insert("body " + model.bodies().body_name(hold.body));
            continue;
          }
        HeldBody &body = held[hold.body];
        body.points.push_back(&hold);
        body.reaction = std::max(body.reaction, reaction);
        body.share    = std::max(body.share, share);
      }
    std::vector<std::string> remarks;
    for (const auto &[body, what] : held)
      remarks.push_back(what.describe("body " + model.bodies().body_name(body)));
    if (!idle.empty())
      remarks.push_back("nothing presses " + Patterns::Tools::to_string(idle) +
                        " against another body: points that are held there carry nothing.");
    return remarks;
  }
} // namespace Signorini

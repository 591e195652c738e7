// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/final_words.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Forces below this share of what they are the sum of are what rounding and the tolerance left.
    constexpr double rounding = 1e-10;

    /// "(x, y, z)"; what is rounding against the scale is 0.
    std::string text(const Vector3 &v, const double scale)
    {
      std::ostringstream out;
      out << std::setprecision(5) << '(';
      for (unsigned int c = 0; c < dim; ++c)
        out << (c > 0 ? ", " : "") << (std::abs(v[c]) > rounding * scale ? v[c] : 0.);
      out << ')';
      return out.str();
    }

    std::string degrees(const double angle)
    {
      std::ostringstream out;
      out << std::setprecision(2) << angle * 180. / numbers::PI << " degrees";
      return out.str();
    }

    void print_body(std::ostream &out, const BodyResult &body)
    {
      const double scale = std::max({body.load.norm(), body.reaction.norm(), body.contact.norm()});
      out << "body " << body.name << ": largest displacement " << body.largest_displacement << " at "
          << place_text(body.displacement_at) << ", largest von Mises stress " << body.largest_von_mises
          << " at " << place_text(body.von_mises_at) << "\n  forces: loads " << text(body.load, scale)
          << ", reactions " << text(body.reaction, scale) << ", contact " << text(body.contact, scale)
          << '\n';
    }

    /// The largest recovered pressure, which scatters less than multipliers, where that is another one.
    std::string smoothed_text(const PairResult &pair)
    {
      constexpr double told = .02;
      if (std::abs(pair.max_recovered_pressure - pair.max_pressure) <= told * pair.max_pressure)
        return "";
      std::ostringstream text;
      text << std::setprecision(5) << "; smoothed " << pair.max_recovered_pressure;
      return text.str();
    }

    std::string scatter_text(const PairResult &pair)
    {
      if (!pair.scatter_is_told())
        return "";
      std::ostringstream text;
      text << std::setprecision(2)
           << "\n  pressures of nodes scatter: half of the load is on nodes that differ by "
           << 100. * pair.pressure_scatter << " % or more from the smoothed pressure";
      return text.str();
    }

    std::string narrow_text(const PairResult &pair)
    {
      if (!pair.is_narrow())
        return "";
      std::ostringstream text;
      text << std::setprecision(3) << "\n  contact is narrower than a face for " << 100. * pair.narrow_share
           << " % of the force: the largest pressure is that of the mesh, refine the contact surfaces to see "
              "that of the bodies";
      return text.str();
    }

    /// Ties alone do, but for rounding.
    bool pulls(const PairResult &pair)
    {
      constexpr double told = 1e-3;
      return pair.min_pressure < -told * std::abs(pair.max_pressure);
    }

    void print_pair(std::ostream &out, const PairResult &pair)
    {
      out << "pair " << pair.name << ": ";
      if (!(pair.contact_area > 0.))
        {
          if (pair.missed_penetration > 0.)
            out << "no contact force, but the surfaces penetrate by " << pair.missed_penetration << '\n';
          else
            out << "the surfaces are separated, there is no contact force\n";
          return;
        }
      const double force = pair.force.norm();
      out << "force " << (force > rounding * pair.load ? force : 0.) << " on " << pair.nonmortar << ", "
          << text(pair.force, pair.load);
      if (pair.pressures_cancel())
        out << "; pressures cancel in it, their integral is " << pair.load;
      out << "\n  contact area " << pair.contact_area;
      if (pulls(pair))
        out << ", pressure from " << pair.min_pressure << " to " << pair.max_pressure << ": the tie pulls";
      else
        out << ", largest pressure " << pair.max_pressure << " at " << place_text(pair.max_pressure_at)
            << smoothed_text(pair);
      out << scatter_text(pair) << narrow_text(pair);
      out << '\n';
    }

    void print_pretension(std::ostream &out, const PretensionResult &bolt)
    {
      out << "pretension " << bolt.body << ": " << bolt.name << ": section force " << bolt.force
          << " (wanted " << bolt.wanted;
      if (bolt.locked_after)
        out << " at t = " << *bolt.locked_after << ", locked since";
      out << "), shortening " << bolt.shortening << " = strain " << bolt.strain << " times length "
          << bolt.length << "; solved " << bolt.iterations.size() << " times, iterations";
      for (std::size_t i = 0; i < bolt.iterations.size(); ++i)
        out << (i > 0 ? ", " : " ") << bolt.iterations[i];
      out << '\n';
    }

    /// Errors of the contact mapping, which most runs do not have. Those that do not matter are said in one
    /// line: a bearing may have them in all of its pairs.
    void print_mapping_errors(std::ostream &out, const Results &results)
    {
      std::vector<const MappingResult *> harmless;
      for (const MappingResult &mapping : results.mappings)
        if (const std::string errors = describe_errors(mapping.report); errors.empty())
          continue;
        else if (!mapping.errors_matter)
          harmless.push_back(&mapping);
        else
          out << "WARNING: pair " << mapping.pair << ": the contact mapping has errors (" << errors
              << "): pressures and forces near those places are wrong\n";
      if (harmless.empty())
        return;
      out << "WARNING: pair" << (harmless.size() > 1 ? "s " : " ");
      for (std::size_t i = 0; i < harmless.size(); ++i)
        out << (i > 0 ? ", " : "") << harmless[i]->pair;
      out << ": the contact mapping has errors ("
          << (harmless.size() > 1 ? "of each pair: mappings/errors in summary.json"
                                  : describe_errors(harmless[0]->report))
          << "): none is near where the bodies touch, so that nothing above depends on them\n";
    }

    void print_smallness(std::ostream &out, const Results &results)
    {
      double rotation = 0., slip = 0.;
      for (const BodyResult &body : results.bodies)
        rotation = std::max(rotation, body.largest_rotation);
      for (const PairResult &pair : results.pairs)
        slip = std::max(slip, pair.slip_in_faces);
      const auto large = large_displacements(results);
      out << "displacements are small: " << (large.empty() ? "yes" : "NO") << " (largest rotation "
          << degrees(rotation) << ", largest slip " << std::setprecision(2) << slip << " of a face)\n";
      for (const std::string &line : large)
        out << "  " << line << '\n';
    }

    void print_fineness(std::ostream &out, const Results &results)
    {
      const auto worst = std::max_element(
          results.bodies.begin(), results.bodies.end(),
          [](const BodyResult &a, const BodyResult &b) { return a.stress_error < b.stress_error; });
      if (worst == results.bodies.end())
        return;
      const auto coarse = coarse_meshes(results);
      // Far below what the mesh is made for, it is rounding.
      constexpr double smallest = 1e-4;
      out << "meshes are fine: " << (coarse.empty() ? "yes" : "NO") << " (estimated error of stresses "
          << percent_text(std::max(worst->stress_error, smallest))
          << (results.bodies.size() > 1 ? " or less, most in body " + worst->name : "") << ")\n";
      for (const std::string &line : coarse)
        out << "  " << line << '\n';
    }
  } // namespace



  std::string place_text(const Point<3> &place)
  {
    return text(Vector3(place), Vector3(place).norm());
  }



  std::string percent_text(const double part, const int digits)
  {
    std::ostringstream text;
    text << std::setprecision(digits) << 100. * part << " %";
    return text.str();
  }



  std::vector<std::string> large_displacements(const Results &results)
  {
    const SmallnessRule      rule;
    std::vector<std::string> lines;
    for (const BodyResult &body : results.bodies)
      {
        std::ostringstream line;
        line << std::setprecision(2);
        if (body.largest_rotation > rule.rotation)
          line << "body " << body.name << " rotates by " << degrees(body.largest_rotation)
               << " somewhere: as kinematics are linear, strains are wrong there by about "
               << .5 * body.largest_rotation * body.largest_rotation << ".";
        else if (body.largest_strain > rule.strain)
          line << "body " << body.name << " has strains of " << body.largest_strain
               << ": the theory is one of small ones.";
        if (!line.str().empty())
          lines.push_back(line.str());
      }
    for (const PairResult &pair : results.pairs)
      if (pair.slip_in_faces > rule.slip_in_faces)
        {
          std::ostringstream line;
          line << std::setprecision(2) << "pair " << pair.name << ": the surfaces "
               << (pair.contact_area > 0. ? "slide by " : "end up apart after they have slid by ")
               << pair.slip << ", " << pair.slip_in_faces
               << " widths of the faces there, and the gap is that of the points that face each other at the "
                  "beginning.";
          lines.push_back(line.str());
        }
      else if (pair.pressed_by_slip > rule.pressed_by_slip)
        {
          std::ostringstream line;
          line << "pair " << pair.name << ": " << percent_text(pair.pressed_by_slip, 3)
               << " of the force is on nodes that slide into the other side by the normals that they have at "
                  "the beginning, and pass by it by those of the other side: the surfaces slide by "
               << std::setprecision(2) << pair.slip
               << ", far for their curvature, and where they end up others may touch, or none.";
          lines.push_back(line.str());
        }
    return lines;
  }



  std::vector<std::string> coarse_meshes(const Results &results)
  {
    std::vector<std::string> lines;
    for (const BodyResult &body : results.bodies)
      if (!(body.stress_error <= FinenessRule().stress_error))
        {
          std::ostringstream line;
          line << "the mesh of body " << body.name << " is coarse for it: estimated error of its stresses "
               << percent_text(body.stress_error)
               << ", and under given forces it moves less than it would, by about "
               << percent_text(body.missing_compliance())
               << ". With a single layer of cells it is up to twice that. One more cycle of refinement, more "
                  "cells through what bends, or hexahedra instead of tetrahedra.";
          lines.push_back(line.str());
        }
    return lines;
  }



  void print_final_words(std::ostream &out, const Results &results)
  {
    const auto flags  = out.flags();
    const auto digits = out.precision(5);
    for (const BodyResult &body : results.bodies)
      print_body(out, body);
    for (const PairResult &pair : results.pairs)
      print_pair(out, pair);
    for (const PretensionResult &bolt : results.pretensions)
      print_pretension(out, bolt);
    print_smallness(out, results);
    print_fineness(out, results);
    print_mapping_errors(out, results);
    if (results.certificate.objections.empty())
      out << "contact conditions hold: yes\n";
    for (const std::string &objection : results.certificate.objections)
      out << "contact conditions hold: NO: " << objection << '\n';
    out.flags(flags);
    out.precision(digits);
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/load_definition.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>
#include <set>

namespace Signorini
{
  using namespace dealii;

  void LoadParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
        "Dirichlet", dirichlet,
        "Prescribed displacements, \"boundary: (ux, uy, uz); boundary: ...\". Each entry is an "
        "expression in x, y, z (length), or * for a free component: a symmetry plane x = 0 is "
        "\"symmetry x: (0, *, *)\". Rollers in other directions: \"boundary: (normal: 0)\" along "
        "the outward normal, \"boundary: (along (1, 1, 0): 0)\" along a direction, \"boundary: "
        "(radial: 0, tangential: 0, axial: *) about (0, 0, 0), (0, 0, 1)\" about an axis, given "
        "by a point and a direction. Where conditions overlap, the later one counts.");
    prm.add_parameter("Tractions", tractions,
                      "Forces per area, \"boundary: (tx, ty, tz); ...\", expressions in x, y, z.");
    prm.add_parameter("Pressures", pressures,
                      "Pressures against the outward normal (force per area), \"boundary: p; ...\".");
    prm.add_parameter("Forces", forces,
                      "Total forces, spread evenly over the area of a boundary, \"boundary: (Fx, Fy, Fz); "
                      "...\".");
    prm.add_parameter(
        "Rigid", rigid,
        "Boundaries that move as rigid bodies, as if glued to a stamp: \"boundary: force (Fx, Fy, Fz), "
        "moment (Mx, "
        "My, Mz), about (x, y, z), displacement (ux, uy, uz), rotation (rx, ry, rz), along (dx, dy, dz); "
        "...\", "
        "of which each may be left out. Force and moment act at the point behind about (the centre of its "
        "area); displacement and rotation (radian) of it have * for free components; with along it moves "
        "in "
        "that direction only and does not turn. Conditions at its edges (symmetry planes) hold it, too, but "
        "for tilts about these "
        "edges: rotation (0, 0, 0) excludes them.");
    prm.add_parameter("Volume force", volume_force, "Force per volume, \"(fx, fy, fz)\"; empty for none.");
    prm.add_parameter(
        "Temperature", temperature,
        "Difference to the temperature at which the body is free of stress, an expression in x, "
        "y, z, t.");
    prm.add_parameter("Thermal expansion", expansion,
                      "Coefficient of linear expansion (per degree of the temperature): 1.2e-5 for steel.");
    prm.add_parameter(
        "Initial strain", initial_strain,
        "Strain that the body has where it is free of stress, beside that of its temperature: "
        "\"(exx, eyy, ezz, exy, eyz, ezx)\", expressions; exy is half of the engineering shear.");
    prm.add_parameter(
        "Volume temperatures", volume_temperatures,
        "Temperatures of single physical volumes instead of that of the body, \"name: T; ...\".");
    prm.add_parameter("Volume thermal expansions", volume_expansions,
                      "Coefficients of expansion of single physical volumes, \"name: alpha; ...\".");
    prm.add_parameter("Volume initial strains", volume_initial_strains,
                      "Initial strains of single physical volumes, \"name: (exx, ...); ...\".");
    prm.add_parameter(
        "Pretension", pretension,
        "Bolts: \"volume: axis (x, y, z), force F; ...\". The strain of the volume (the shank between its "
        "ends) along the axis is found such that its section carries the force F (an expression in t). "
        "Without such a volume in the mesh \"name: axis (x, y, z), force F, region f(x,y,z)\" takes the "
        "cells at whose centres f is positive. With \", locked after t\" the strain that gives the force "
        "under "
        "the loads at the pseudo-time t is kept from there on: a bolt is tightened, and then the joint is "
        "loaded (by what depends on t, like max(0, 2*t-1), which is 0 up to t = 0.5 and 1 in the end).");
  }



  namespace
  {
    /// The entries of a condition by name: "(radial: 0, axial: *)", or of one "(along (1, 1, 0): 0)".
    std::map<std::string, ScalarField> named_components(const std::string &text, const std::string &where)
    {
      std::map<std::string, ScalarField> result;
      for (const std::string &entry : split_list(text.substr(1, text.size() - 2), ',', where))
        {
          const auto pieces = split_list(entry, ':', where);
          if (pieces.size() != 2 || pieces[0].empty() || pieces[1].empty())
            throw InputError(where + ": \"" + entry + "\" should read \"direction: displacement\".");
          if (!result.insert({pieces[0], pieces[1] == "*" ? ScalarField() : Expression(pieces[1], where)})
                   .second)
            throw InputError(where + ": \"" + pieces[0] + "\" is there twice.");
        }
      return result;
    }

    void set_along(LoadDefinition::Displacement &condition, const std::string &direction,
                   const std::string &where)
    {
      const Vector3 v = parse_point(direction, where);
      if (!(v.norm() > 0.))
        throw InputError(where + ": the direction \"" + direction + "\" must not be zero.");
      condition.frame = ConditionFrame::rotated(v);
    }

    /// The axis behind "about".
    ConditionFrame parse_axis(const std::string &text, const std::string &where)
    {
      const auto pieces = split_list(text, ',', where);
      if (pieces.size() != 2)
        throw InputError(where + ": \"" + text +
                         "\" should be a point and a direction, like (0, 0, 0), (0, 0, 1).");
      const Vector3 axis = parse_point(pieces[1], where);
      if (!(axis.norm() > 0.))
        throw InputError(where + ": the axis \"" + pieces[1] + "\" must not be zero.");
      return ConditionFrame::cylindrical(parse_point(pieces[0], where), axis);
    }

    /// "(normal: 0)", "(along (1, 1, 0): 0)", "(radial: 0, tangential: *, axial: 0) about point, axis".
    void parse_named(LoadDefinition::Displacement &condition, const std::string &text,
                     const std::string &where)
    {
      // The parenthesis that closes the components.
      std::size_t end   = 0;
      int         depth = 0;
      do
        depth += text[end] == '(' ? 1 : (text[end] == ')' ? -1 : 0);
      while (++end < text.size() && depth > 0);
      const auto        components = named_components(text.substr(0, end), where);
      const std::string tail       = Utilities::trim(text.substr(end));
      const bool        has_axis   = tail.compare(0, 6, "about ") == 0 || tail.compare(0, 6, "about(") == 0;
      if (!tail.empty() && !has_axis)
        throw InputError(where + ": \"" + tail + "\" should be \"about point, axis\".");
      if (has_axis)
        {
          static const std::array<std::string, 3> names = {{"radial", "tangential", "axial"}};
          condition.frame                               = parse_axis(tail.substr(5), where);
          for (const auto &[name, value] : components)
            {
              const auto c = std::find(names.begin(), names.end(), name);
              if (c == names.end())
                throw InputError(where + ": \"" + name +
                                 "\" should be radial, tangential or axial where there is an axis.");
              condition.components[c - names.begin()] = value;
            }
          return;
        }
      const auto &[name, value] = *components.begin();
      if (components.size() != 1 || (name != "normal" && name.compare(0, 5, "along") != 0))
        throw InputError(where + ": \"" + text +
                         "\" should be (normal: u), (along (dx, dy, dz): u) or, with an axis, (radial: u, "
                         "tangential: v, axial: w) about point, axis.");
      if (name == "normal")
        condition.frame = ConditionFrame::normal();
      else
        set_along(condition, name.substr(5), where);
      condition.components[0] = value;
    }

    LoadDefinition::Displacement parse_displacement(const std::string &boundary, const std::string &text,
                                                    const std::string &where)
    {
      LoadDefinition::Displacement condition{boundary, {}};
      if (!text.empty() && text.front() == '(' && text.find(':') != std::string::npos)
        {
          parse_named(condition, text, where);
          return condition;
        }
      const auto entries = split_vector(text, where);
      for (unsigned int c = 0; c < dim; ++c)
        if (entries[c] != "*")
          condition.components[c] = Expression(entries[c], where);
      return condition;
    }
  } // namespace



  namespace
  {
    std::array<ScalarField, 3> parse_components(const std::string &text, const std::string &where)
    {
      std::array<ScalarField, 3> result;
      const auto                 entries = split_vector(text, where);
      for (unsigned int c = 0; c < dim; ++c)
        if (entries[c] != "*")
          result[c] = Expression(entries[c], where);
      return result;
    }

    LoadDefinition::RigidBoundary parse_rigid(const std::string &boundary, const std::string &text,
                                              const std::string &where)
    {
      LoadDefinition::RigidBoundary result{boundary, {}, {}};
      std::set<std::string>         seen;
      for (const std::string &piece : split_list(text, ',', where))
        {
          const std::size_t bracket = piece.find('(');
          const std::string word    = Utilities::trim(piece.substr(0, bracket)),
                            value   = bracket == std::string::npos ? "" : piece.substr(bracket);
          if (!seen.insert(word).second)
            throw InputError(where + ": \"" + word + "\" is there twice.");
          if (word == "force")
            result.force = parse_vector_field(value, where);
          else if (word == "moment")
            result.moment = parse_vector_field(value, where);
          else if (word == "about")
            result.about = parse_point(value, where);
          else if (word == "displacement")
            result.displacement = parse_components(value, where);
          else if (word == "rotation")
            result.rotation = parse_components(value, where);
          else if (word == "along")
            {
              result.direction = parse_point(value, where);
              if (!(result.direction.norm() > 0.))
                throw InputError(where + ": the direction \"" + value + "\" must not be zero.");
            }
          else
            throw InputError(where + ": \"" + piece +
                             "\" should begin with force, moment, about, displacement, rotation or along.");
        }
      return result;
    }
  } // namespace



  LoadDefinition LoadParameters::definition(const std::string &section) const
  {
    LoadDefinition result;
    for (const auto &[name, text] : split_named_entries(dirichlet, section + "Dirichlet"))
      result.displacements.push_back(
          parse_displacement(name, text, section + "Dirichlet, boundary \"" + name + "\""));
    for (const auto &[name, text] : split_named_entries(tractions, section + "Tractions"))
      result.surface_forces.push_back(
          {name, parse_vector_field(text, section + "Tractions, boundary \"" + name + "\""), {}, {}});
    for (const auto &[name, text] : split_named_entries(pressures, section + "Pressures"))
      result.surface_forces.push_back(
          {name, {}, Expression(text, section + "Pressures, boundary \"" + name + "\""), {}});
    for (const auto &[name, text] : split_named_entries(forces, section + "Forces"))
      result.surface_forces.push_back(
          {name, {}, {}, parse_vector_field(text, section + "Forces, boundary \"" + name + "\"")});
    for (const auto &[name, text] : split_named_entries(rigid, section + "Rigid"))
      result.rigid_boundaries.push_back(
          parse_rigid(name, text, section + "Rigid, boundary \"" + name + "\""));
    if (!Utilities::trim(volume_force).empty())
      result.volume_force = parse_vector_field(volume_force, section + "Volume force");
    parse_initial_strains(result, section);
    parse_pretensions(result, section);
    return result;
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/parameter_choice.h>
#include <signorini/application/parameters.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  void PairParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("First", first,
                      "One surface of the pair, \"body: boundary\", or \"body: boundary + boundary\".");
    prm.add_parameter("Second", second,
                      "The other surface, \"body: boundary\"; empty if there is an obstacle.");
    prm.add_parameter("Obstacle", obstacle,
                      "A rigid, fixed partner of the first surface instead of a second one: \"plane: point, "
                      "normal\", \"sphere: centre, radius\", \"cylinder: point, axis, radius\", "
                      "\"paraboloid: apex, axis, radius of curvature\" or \"function: f(x,y,z)\", positive "
                      "outside of the obstacle. Points and directions as (x, y, z); normal and axis point to "
                      "the body; \"hollow sphere\" and \"hollow cylinder\" have it inside.");
    add_choice(
        prm, "Contact", contact, {{ContactKind::unilateral, "unilateral"}, {ContactKind::tied, "tied"}},
        "unilateral: frictionless contact. tied: the surfaces are glued together where they are (gaps do "
        "not count), for bodies whose meshes do not match.");
    add_choice(prm, "Gap", gap, {{GapKind::weighted, "weighted"}, {GapKind::nodal, "nodal"}},
               "weighted: integrals of the gap with the dual functions, consistent with the weak "
               "condition. nodal: the gap at the nodes along their normals (with an obstacle, or a "
               "prescribed initial gap).");
    prm.add_parameter(
        "Initial gap", initial_gap,
        "geometry, or an expression in x, y, z (length) evaluated on the nonmortar surface, for "
        "crowned surfaces that are meshed flat.");
    add_treatment(prm);
  }



  void PairParameters::add_treatment(ParameterHandler &prm)
  {
    add_choice(
        prm, "Nonmortar", nonmortar,
        {{NonmortarChoice::automatic, "auto"},
         {NonmortarChoice::first, "first"},
         {NonmortarChoice::second, "second"}},
        "Which surface carries the contact pressure. auto picks the softer body (by the materials of the "
        "cells "
        "at the surface, then the finer mesh): with the stiffer one the solver needs many times more "
        "iterations; it takes the other one where this one could carry no contact stress (nodes of another "
        "pair, prescribed displacements).");
    add_choice(
        prm, "Surface", surface,
        {{SurfaceKind::automatic, "automatic"},
         {SurfaceKind::smooth, "smooth"},
         {SurfaceKind::faceted, "faceted"}},
        "What the gap and the normals are measured on. automatic: the boundary shapes, where there are any; "
        "else curved patches over the faces of the start mesh where it shows itself that it stands for a "
        "smooth surface, and its facets elsewhere. smooth: curved patches wherever there is no boundary "
        "shape. faceted: the facets of the mesh. Flat parts and creases stay as they are.");
    add_choice(prm, "Initial penetration", penetration,
               {{InitialPenetration::automatic, "automatic"},
                {InitialPenetration::resolve, "resolve"},
                {InitialPenetration::refuse, "refuse"}},
               "What to do where the surfaces overlap at the start. resolve: an interference fit, the bodies "
               "push each other away. refuse: do not compute, unless they just touch: overlap by less than "
               "their facets leave open. automatic: resolve what is at most a percent of the extents of both "
               "bodies along the normal, refuse what is more.");
    prm.add_parameter("First region", first_region,
                      "Expression in x, y, z that is positive where the first surface may touch (a face "
                      "belongs to it if a corner or its centre does); "
                      "empty for everywhere.");
    prm.add_parameter("Second region", second_region, "The same for the second surface.");
  }



  namespace
  {
    /// From "body: boundary".
    PairSide parse_side(const std::string &text, const std::string &where)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
        throw InputError(where + ": \"" + text + "\" should read \"body: boundary\".");
      return {Utilities::trim(text.substr(0, colon)), Utilities::trim(text.substr(colon + 1)), {}};
    }

    void set_region(PairSide &side, const std::string &text, const std::string &where)
    {
      refuse_time(text, where);
      if (!Utilities::trim(text).empty())
        side.region = Expression(text, where);
    }
  } // namespace



  PairDefinition PairParameters::definition() const
  {
    const std::string section = "Pair " + name + "/";
    PairDefinition    pair;
    for (const auto &[text, parameter] :
         {std::pair(obstacle, "Obstacle"), std::pair(initial_gap, "Initial gap")})
      refuse_time(text, section + parameter);
    pair.name  = name;
    pair.first = parse_side(first, section + "First");
    if (!Utilities::trim(obstacle).empty())
      {
        pair.obstacle = RigidObstacle::parse(obstacle, section + "Obstacle");
        // It makes no sense, nor does a region of it, which is said where the pair is looked for.
        pair.second.body = Utilities::trim(second);
      }
    else
      pair.second = parse_side(second, section + "Second");
    if (Utilities::trim(initial_gap) != "geometry")
      pair.prescribed_gap = Expression(initial_gap, section + "Initial gap");
    pair.contact = contact;
    pair.gap     = gap;
    treat(pair);
    return pair;
  }



  void PairParameters::treat(PairDefinition &pair) const
  {
    const std::string section = "Pair " + name + "/";
    set_region(pair.first, first_region, section + "First region");
    set_region(pair.second, second_region, section + "Second region");
    pair.nonmortar   = nonmortar;
    pair.surface     = surface;
    pair.penetration = penetration;
  }
} // namespace Signorini

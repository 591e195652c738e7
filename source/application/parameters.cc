// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/parameters.h>

#include <deal.II/base/utilities.h>

#include <filesystem>

namespace Signorini
{
  using namespace dealii;

  void PairParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("First", first, "One surface of the pair, \"body: boundary\".");
    prm.add_parameter("Second", second,
                      "The other surface, \"body: boundary\"; empty if there is an obstacle.");
    prm.add_parameter("Obstacle", obstacle,
                      "A rigid, fixed partner of the first surface instead of a second one: \"plane: point, "
                      "normal\", \"sphere: centre, radius\", \"cylinder: point, axis, radius\", "
                      "\"paraboloid: apex, axis, radius of curvature\" or \"function: f(x,y,z)\", positive "
                      "outside of the obstacle. Points and directions as (x, y, z); normal and axis point to "
                      "the body; \"hollow sphere\" and \"hollow cylinder\" have it inside.");
    prm.add_parameter(
        "Contact", contact,
        "unilateral: frictionless contact. tied: the surfaces are glued together where they are (gaps do "
        "not count), for bodies whose meshes do not match.",
        Patterns::Selection("unilateral|tied"));
    prm.add_parameter("Gap", gap,
                      "weighted: integrals of the gap with the dual functions, consistent with the weak "
                      "condition. nodal: the gap at the nodes along their normals (with an obstacle, or a "
                      "prescribed initial gap).",
                      Patterns::Selection("weighted|nodal"));
    prm.add_parameter(
        "Nonmortar", nonmortar,
        "Which surface carries the contact pressure. auto picks the softer body (then the finer "
        "mesh): with the stiffer one the solver needs many times more iterations; it takes the other one "
        "where "
        "this one could carry no contact stress (nodes of another pair, prescribed displacements).",
        Patterns::Selection("auto|first|second"));
    prm.add_parameter(
        "Initial gap", initial_gap,
        "geometry, or an expression in x, y, z (length) evaluated on the nonmortar surface, for "
        "crowned surfaces that are meshed flat.");
    prm.add_parameter(
        "Surface", surface,
        "What the gap and the normals are measured on. automatic: the boundary shapes, where there are any; "
        "else curved patches over the faces of the start mesh where it shows itself that it stands for a "
        "smooth "
        "surface, and its facets elsewhere. smooth: curved patches wherever there is no boundary shape. "
        "faceted: the facets of the mesh. Flat parts and creases stay as they are.",
        Patterns::Selection("automatic|smooth|faceted"));
    prm.add_parameter(
        "Initial penetration", penetration,
        "What to do where the surfaces overlap at the start: resolve it as an interference fit, or "
        "refuse to compute.",
        Patterns::Selection("resolve|refuse"));
    prm.add_parameter("First region", first_region,
                      "Expression in x, y, z that is positive where the first surface may touch (a face "
                      "belongs to it if a corner or its centre does); "
                      "empty for everywhere.");
    prm.add_parameter("Second region", second_region, "The same for the second surface.");
  }



  namespace
  {
    struct TopLevel
    {
      std::string title, bodies, pairs;

      void add_parameters(ParameterHandler &prm)
      {
        prm.add_parameter("Title", title, "Text that appears in the results.");
        prm.add_parameter("Bodies", bodies,
                          "Names of the bodies, separated by commas. Each has a subsection \"Body NAME\".");
        prm.add_parameter(
            "Contact pairs", pairs,
            "Names of the contact pairs, separated by commas. Each has a subsection \"Pair NAME\".");
      }
    };

    std::vector<std::string> names(const std::string &list, const std::string &where)
    {
      std::vector<std::string> result;
      for (const std::string &name : Utilities::split_string_list(list, ','))
        {
          if (name.empty())
            continue;
          if (std::find(result.begin(), result.end(), name) != result.end())
            throw InputError(where + ": the name \"" + name + "\" appears twice.");
          result.push_back(name);
        }
      return result;
    }

    /// The text of a deal.II exception without its banner.
    std::string plain_text(const std::exception &e)
    {
      std::string text;
      if (const auto *exception = dynamic_cast<const ExceptionBase *>(&e))
        {
          std::ostringstream info;
          exception->print_info(info);
          text = info.str();
        }
      else
        text = e.what();
      std::string line;
      for (const char c : text)
        if (c != '\n')
          line += c;
        else if (!line.empty() && line.back() != ' ')
          line += ' ';
      std::string result;
      for (const char c : line)
        if (c != ' ' || (!result.empty() && result.back() != ' '))
          result += c;
      return Utilities::trim(result);
    }

    /// Applies "Section/Name=value".
    void apply_override(ParameterHandler &prm, const std::string &text, const bool skip_unknown)
    {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw InputError("--set \"" + text + "\": expected \"Section/Name=value\".");
      std::vector<std::string> path = Utilities::split_string_list(text.substr(0, equals), '/');
      const std::string        name = path.back();
      path.pop_back();
      if (skip_unknown && !(path.empty() && (name == "Bodies" || name == "Contact pairs")))
        return;
      for (const std::string &section : path)
        prm.enter_subsection(section);
      try
        {
          prm.set(name, Utilities::trim(text.substr(equals + 1)));
        }
      catch (const std::exception &e)
        {
          throw InputError("--set \"" + text + "\": " + plain_text(e));
        }
      for (std::size_t i = 0; i < path.size(); ++i)
        prm.leave_subsection();
    }

    void parse(ParameterHandler &prm, const std::string &file, const bool skip_undefined)
    {
      std::ifstream in(file);
      if (!in)
        throw InputError("The parameter file \"" + file + "\" cannot be opened.");
      try
        {
          prm.parse_input(in, file, "", skip_undefined);
        }
      catch (const std::exception &e)
        {
          throw InputError(plain_text(e));
        }
    }
  } // namespace



  void ProblemParameters::declare(ParameterHandler &prm)
  {
    loads.resize(bodies.size());
    probes.resize(bodies.size());
    exact_displacements.resize(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        prm.enter_subsection("Body " + bodies[b].name);
        bodies[b].add_parameters(prm);
        loads[b].add_parameters(prm);
        prm.add_parameter(
            "Probes", probes[b],
            "Points whose displacement is reported, \"name: (x, y, z); ...\" (length, undeformed).");
        prm.add_parameter(
            "Exact displacement", exact_displacements[b],
            "A known solution \"(u, v, w)\" in x, y, z; the distance from it is reported for every "
            "cycle (L2 and energy norms).");
        prm.leave_subsection();
      }
    for (PairParameters &pair : pairs)
      {
        prm.enter_subsection("Pair " + pair.name);
        pair.add_parameters(prm);
        prm.leave_subsection();
      }
    prm.enter_subsection("Refinement");
    refinement.add_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Solver");
    solver.add_parameters(prm);
    prm.add_parameter(
        "Compare linear multigrid", compare_linear,
        "Solve the decoupled linear problem, loaded with the computed contact stresses, by the same V-cycles "
        "from the same start, alone and with conjugate gradients, and report their iterations and times "
        "beside "
        "those of contact.");
    prm.leave_subsection();
    prm.enter_subsection("Output");
    prm.add_parameter("Folder", output_folder,
                      "Where the results go; --output on the command line overrides it.");
    prm.add_parameter("Verbosity", verbosity,
                      "0: errors only, 1: a line per cycle, 2: also a line per iteration.",
                      Patterns::Integer(0, 2));
    prm.add_parameter("Bodies", write_bodies, "Write the bodies for ParaView (.pvtu).");
    prm.add_parameter("Contact surfaces", write_surfaces, "Write the contact surfaces for ParaView (.pvtu).");
    prm.add_parameter("Mapping graph", write_mapping,
                      "Write the overlay of each pair, the faces of the plane graph cut into triangles, for "
                      "ParaView (.vtu, one per rank).");
    prm.add_parameter("Stress", write_stress, "Nodal averaged stress, von Mises and principal stresses.");
    prm.add_parameter(
        "Measure sweeps", measure_sweeps,
        "Time Gauss-Seidel sweeps and a plain read of memory on the finest level (costs some ten sweeps).");
    prm.leave_subsection();
  }



  void ProblemParameters::read(const std::string &file_name, const std::vector<std::string> &overrides)
  {
    file        = file_name;
    base_folder = std::filesystem::path(file_name).parent_path().string();

    // The names of bodies and pairs decide which subsections exist, so they are read first.
    TopLevel         top;
    ParameterHandler first_pass;
    top.add_parameters(first_pass);
    parse(first_pass, file, true);
    for (const std::string &text : overrides)
      apply_override(first_pass, text, true);

    for (const std::string &name : names(top.bodies, "Bodies"))
      {
        bodies.emplace_back();
        bodies.back().name = name;
      }
    if (bodies.empty())
      throw InputError("Bodies: name at least one body, e.g. \"set Bodies = ball, block\".");
    for (const std::string &name : names(top.pairs, "Contact pairs"))
      {
        pairs.emplace_back();
        pairs.back().name = name;
      }

    ParameterHandler prm;
    top.add_parameters(prm);
    declare(prm);
    parse(prm, file, false);
    for (const std::string &text : overrides)
      apply_override(prm, text, false);
    title = top.title;
  }



  void ProblemParameters::print(std::ostream &out, const bool with_documentation)
  {
    TopLevel top;
    top.title       = title;
    const auto join = [](const auto &list) {
      std::string text;
      for (const auto &item : list)
        text += (text.empty() ? "" : ", ") + item.name;
      return text;
    };
    top.bodies = join(bodies);
    top.pairs  = join(pairs);
    ParameterHandler prm;
    top.add_parameters(prm);
    declare(prm);
    prm.print_parameters(out, with_documentation
                                  ? ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder
                                  : ParameterHandler::ShortPRM | ParameterHandler::KeepDeclarationOrder);
  }
} // namespace Signorini

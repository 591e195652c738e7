// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "parameter_names.h"

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/parameter_choice.h>
#include <signorini/application/parameters.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/size_limit.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::vector<std::string> names(const std::string &list, const std::string &where)
    {
      std::vector<std::string> result;
      for (const std::string &name : Utilities::split_string_list(list, ','))
        {
          if (name.empty())
            continue;
          // They are parts of file names, of "Section/Name" and of "body: boundary".
          if (const std::size_t bad = name.find_first_of("/\\:;\"\t");
              bad != std::string::npos || name[0] == '.')
            throw InputError(where + ": the name \"" + name + "\" must not " +
                             (bad != std::string::npos ? "contain \"" + name.substr(bad, 1) + "\"."
                                                       : std::string("begin with a dot.")));
          if (std::find(result.begin(), result.end(), name) != result.end())
            throw InputError(where + ": the name \"" + name + "\" appears twice.");
          result.push_back(name);
        }
      return result;
    }

    /// What deal.II says of its patterns, in words.
    std::string explain_patterns(std::string text)
    {
      static const std::pair<std::regex, std::string> phrases[] = {
          {std::regex(R"(<?\[List of <\[Double[^\]]*\]> of length (\d+)\.\.\.\1 \(inclusive\)\]>?)"),
           "[$1 numbers separated by commas]"},
          {std::regex(
               R"(<?\[List of <\[Integer range (\d+)\.\.\.(\d+)[^\]]*\]> of length (\d+)\.\.\.\3 \(inclusive\)\]>?)"),
           "[$3 integers from $1 to $2 separated by commas]"}};
      for (const auto &[pattern, words] : phrases)
        text = std::regex_replace(text, pattern, words);
      return text;
    }

    /// A message with the beginning and the end of what it quotes: a person has to read it, and regular
    /// expressions go deep into long texts.
    std::string shortened(const std::string &text)
    {
      constexpr std::size_t longest = 2000, begin = 1200, end = 600;
      return text.size() <= longest ? text : text.substr(0, begin) + " ... " + text.substr(text.size() - end);
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
      return explain_patterns(shortened(Utilities::trim(result)));
    }

    std::string join(const std::vector<std::string> &list, const std::string &separator)
    {
      std::string text;
      for (const std::string &item : list)
        text += (text.empty() ? "" : separator) + item;
      return text;
    }

    /// Applies "Section/Name=value".
    void apply_override(ParameterHandler &prm, const std::string &text, const bool skip_unknown)
    {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw InputError("--set \"" + text + "\": expected \"Section/Name=value\".");
      std::vector<std::string> path = Utilities::split_string_list(text.substr(0, equals), '/');
      if (path.empty() || std::find(path.begin(), path.end(), "") != path.end())
        throw InputError("--set \"" + text + "\": expected \"Section/Name=value\".");
      const std::string name = path.back();
      path.pop_back();
      if (skip_unknown && !(path.empty() && (name == "Bodies" || name == "Contact pairs")))
        return;
      if (const std::string objection = ParameterNames(prm).objection(join(path, "/"), name);
          !objection.empty())
        throw InputError("--set \"" + text + "\": " + objection);
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

    std::string read_text(const std::string &file)
    {
      std::ifstream in(file);
      if (!in)
        throw InputError("The parameter file \"" + file + "\" cannot be opened.");
      std::ostringstream text;
      text << in.rdbuf();
      if (text.str().find('\0') != std::string::npos)
        throw InputError("The parameter file \"" + file +
                         "\" has zero bytes, as texts in UTF-16 have: save it in UTF-8.");
      return text.str();
    }

    void parse(ParameterHandler &prm, const std::string &text, const std::string &name,
               const bool skip_undefined)
    {
      std::istringstream in(text);
      try
        {
          prm.parse_input(in, name, "", skip_undefined);
        }
      catch (const std::exception &e)
        {
          const std::string message = plain_text(e);
          std::smatch       found;
          if (std::regex_search(message, found,
                                std::regex("Line <([0-9]+)>.*(No entry with name|such subsection)")))
            if (const std::string objection =
                    ParameterNames(prm).objection_to_line(text, std::stoul(found[1].str()));
                !objection.empty())
              throw InputError(name + ", line " + found[1].str() + ": " + objection);
          throw InputError(message);
        }
    }
  } // namespace



  void ParameterFile::TopLevel::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Title", title, "Text that appears in the results.");
    prm.add_parameter("Bodies", bodies,
                      "Names of the bodies, separated by commas. Each has a subsection \"Body NAME\".");
    prm.add_parameter(
        "Contact pairs", pairs,
        "Names of the contact pairs, separated by commas. Each has a subsection \"Pair NAME\".");
    prm.add_parameter(
        "Load steps", load_steps,
        "A number of equal steps to t = 1, or a list of ascending times like 0.2, 0.5, 1; empty for "
        "one load. Expressions of conditions, forces and pressures may use t, which is 1 without "
        "steps. Meshes are those of the last load.");
  }



  void ParameterFile::BodySection::add_parameters(ParameterHandler &prm)
  {
    body.add_parameters(prm);
    loads.add_parameters(prm);
    prm.add_parameter(
        "Probes", probes,
        "Points whose displacement is reported, \"name: (x, y, z); ...\" (length, undeformed).");
    prm.add_parameter("Initial levels", initial_levels,
                      "How often the cells of this body are halved before the first cycle; empty for "
                      "Refinement/Initial global levels.");
    prm.add_parameter("Exact displacement", exact_displacement,
                      "A known solution \"(u, v, w)\" in x, y, z; the distance from it is reported for every "
                      "cycle (L2 and energy norms).");
  }



  void ParameterFile::declare(const std::vector<std::string> &body_names,
                              const std::vector<std::string> &pair_names)
  {
    const auto section = [this](const std::string &name, auto &&...parameters) {
      prm.enter_subsection(name);
      (parameters.add_parameters(prm), ...);
      prm.leave_subsection();
    };
    bodies.resize(body_names.size());
    pairs.resize(pair_names.size());
    top_level.bodies = join(body_names, ", ");
    top_level.pairs  = join(pair_names, ", ");
    top_level.add_parameters(prm);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        bodies[b].body.name = body_names[b];
        section("Body " + body_names[b], bodies[b]);
      }
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        pairs[p].name = pair_names[p];
        section("Pair " + pair_names[p], pairs[p]);
      }
    section("Refinement", refinement);
    prm.enter_subsection("Solver");
    solver.add_parameters(prm);
    add_choice(
        prm, "Coarse levels", coarse_levels,
        {{CoarseLevels::automatic, "automatic"},
         {CoarseLevels::background, "background"},
         {CoarseLevels::none, "none"}},
        "Levels below the coarsest mesh, for one finished mesh without coarser ones. background: octrees "
        "of coarse functions around each body, as fine as the mesh is. none: the coarsest mesh is level "
        "0. automatic: background where the coarsest mesh has more than 500 nodes, unless Level 0 is "
        "given.");
    prm.add_parameter(
        "Compare linear multigrid", compare_linear,
        "Solve the decoupled linear problem, loaded with the computed contact stresses, by the same V-cycles "
        "from the same start, alone and with conjugate gradients, and report their iterations and times "
        "beside those of contact.");
    prm.leave_subsection();
    section("Output", the_output);
  }



  ParameterFile::ParameterFile(const std::string &file_name, const std::vector<std::string> &overrides)
    : file(file_name)
    , base_folder(std::filesystem::path(file_name).parent_path().string())
  {
    if (is_deck(file_name))
      {
        read_deck(overrides);
        return;
      }
    read(read_text(file_name), overrides);
  }



  ParameterFile::ParameterFile(const ParameterText &lines, const std::vector<std::string> &overrides)
    : file(lines.name)
    , base_folder(lines.folder)
  {
    read(lines.text, overrides);
  }



  void ParameterFile::read(const std::string &text, const std::vector<std::string> &overrides)
  {
    TopLevel         top;
    ParameterHandler first_pass;
    top.add_parameters(first_pass);
    parse(first_pass, text, file, true);
    for (const std::string &change : overrides)
      apply_override(first_pass, change, true);
    const std::vector<std::string> body_names = names(top.bodies, "Bodies");
    if (body_names.empty())
      throw InputError("Bodies: name at least one body, e.g. \"set Bodies = ball, block\".");
    declare(body_names, names(top.pairs, "Contact pairs"));
    parse(prm, text, file, false);
    for (const std::string &change : overrides)
      apply_override(prm, change, false);
  }



  void ParameterFile::read_deck(const std::vector<std::string> &overrides)
  {
    declare({}, {});
    prm.enter_subsection("Deck");
    prm.add_parameter("Strict", deck_strict,
                      "Refuse what is otherwise taken in another way than the deck says, with a note.");
    prm.add_parameter("Ignore", deck_ignore,
                      "Keywords, separated by commas, that are passed over although they change the result.");
    prm.leave_subsection();
    const auto apply = [&](const bool to_pairs) {
      for (const std::string &text : overrides)
        if ((text.compare(0, 5, "Pair ") == 0) == to_pairs)
          apply_override(prm, text, false);
    };
    apply(false);
    DeckOptions options;
    options.strict = deck_strict;
    for (const std::string &name : Utilities::split_string_list(deck_ignore, ','))
      if (!name.empty())
        options.ignore.insert(deck_upper(name));
    const DeckModel model(file, options);
    deck_problem    = std::make_unique<DeckProblem>(make_deck_problem(model));
    top_level.title = model.title();
    declare_pairs_of_deck();
    apply(true);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      pairs[p].treat(deck_problem->problem.pairs[p]);
  }



  void ParameterFile::declare_pairs_of_deck()
  {
    pairs.resize(deck_problem->problem.pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const PairDefinition &pair = deck_problem->problem.pairs[p];
        pairs[p].name              = pair.name;
        pairs[p].nonmortar         = pair.nonmortar;
        pairs[p].surface           = pair.surface;
        pairs[p].penetration       = pair.penetration;
        prm.enter_subsection("Pair " + pair.name);
        pairs[p].add_treatment(prm);
        prm.leave_subsection();
      }
  }



  ParameterFile::ParameterFile(const std::vector<std::string> &body_names,
                               const std::vector<std::string> &pair_names)
  {
    declare(body_names, pair_names);
  }



  std::vector<unsigned int> ParameterFile::initial_levels() const
  {
    // Bodies of a deck have no sections.
    std::vector<unsigned int> result(deck_problem ? deck_problem->problem.bodies.size() : 0,
                                     refinement.initial_global);
    for (const BodySection &section : bodies)
      {
        const std::string where = "Body " + section.body.name + "/Initial levels";
        const std::string text  = Utilities::trim(section.initial_levels);
        if (text.find_first_not_of("0123456789") != std::string::npos || text.size() > 2 ||
            (!text.empty() && std::stoi(text) > 20))
          throw InputError(where + ": \"" + text + "\" should be a number of levels between 0 and 20.");
        result.push_back(text.empty() ? refinement.initial_global
                                      : static_cast<unsigned int>(std::stoi(text)));
      }
    return result;
  }



  void ParameterFile::check_size(const ProblemDefinition &problem, const MPI_Comm communicator) const
  {
    const std::vector<unsigned int> levels = initial_levels();
    const double                    later  = refinement.global_cycles + refinement.final_global_cycles;
    // Hexahedra count six times as much as tetrahedra.
    double cells = 0., weighted = 0.;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        const BodyDefinition &body = problem.bodies[b].body;
        const double n = static_cast<double>(body.mesh.cells.size()) * std::pow(8., levels[b] + later);
        cells += n;
        weighted += n * (body.mesh.cells[0].n_vertices == 8 ? 3. : SizeRule().unknowns_per_cell);
      }
    refuse_too_many_cells(cells, "The bodies",
                          "Take fewer levels and cycles (Body/Initial levels, Refinement/Initial global "
                          "levels, Global cycles, Final global cycles), or a coarser mesh.",
                          communicator, cells > 0. ? weighted / cells : 0.);
  }



  ProblemDefinition ParameterFile::problem(const MPI_Comm communicator) const
  {
    ProblemDefinition result;
    if (deck_problem)
      {
        result = deck_problem->problem;
        for (const PairDefinition &pair : result.pairs)
          check_method(pair, solver.method);
        return result;
      }
    for (const BodySection &section : bodies)
      result.bodies.push_back({section.body.definition(communicator, base_folder),
                               section.loads.definition("Body " + section.body.name + "/")});
    check_size(result, communicator);
    for (const PairParameters &pair : pairs)
      {
        result.pairs.push_back(pair.definition());
        check_method(result.pairs.back(), solver.method);
      }
    return result;
  }



  NestedParameters ParameterFile::nested() const
  {
    NestedParameters result;
    if (refinement.wanted_stress_error > 0. && refinement.adaptive_cycles == 0)
      throw InputError("Refinement/Wanted stress error ends adaptive cycles, and there are none: give "
                       "\"Adaptive cycles\", the most that there may be.");
    result.refinement                 = refinement;
    result.refinement.initial_of_body = initial_levels();
    std::string           names       = top_level.bodies;
    std::set<std::string> known;
    for (const BodySection &section : bodies)
      known.insert(section.body.name);
    for (std::size_t b = 0; deck_problem && b < deck_problem->problem.bodies.size(); ++b)
      {
        const std::string &name = deck_problem->problem.bodies[b].body.name;
        known.insert(name);
        names += (b == 0 ? "" : ", ") + name;
      }
    for (const RefinementRegion &region : refinement.regions)
      if (!region.body.empty() && known.count(region.body) == 0)
        throw InputError("Refinement/Regions: there is no body \"" + region.body + "\"; the bodies are " +
                         names + ".");
    result.solve = {solver, compare_linear, the_output.measure_sweeps, coarse_levels};
    if (deck_problem)
      result.exact_displacements.resize(deck_problem->problem.bodies.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const std::string section = "Body " + bodies[b].body.name + "/";
        for (const auto &[name, text] : split_named_entries(bodies[b].probes, section + "Probes"))
          result.probes.push_back({name, b, parse_point(text, section + "Probes, \"" + name + "\"")});
        result.exact_displacements.emplace_back();
        if (const std::string &text = bodies[b].exact_displacement; !text.empty())
          result.exact_displacements.back() = parse_vector_field(text, section + "Exact displacement");
      }
    return result;
  }



  std::vector<double> ParameterFile::load_steps() const
  {
    const std::vector<double> times = parse_load_steps(top_level.load_steps, "Load steps");
    return times.empty() && deck_problem && deck_problem->n_steps > 1
               ? parse_load_steps(std::to_string(deck_problem->n_steps), "Load steps")
               : times;
  }



  void ParameterFile::print(std::ostream &out, const bool with_documentation) const
  {
    prm.print_parameters(out, with_documentation
                                  ? ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder
                                  : ParameterHandler::ShortPRM | ParameterHandler::KeepDeclarationOrder);
  }
} // namespace Signorini

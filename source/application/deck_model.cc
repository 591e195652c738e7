// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Keywords of decks: which are known, and what makes the model.

#include "deck_model_reader.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck_elements.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  DeckModel::DeckModel(const std::string &file, const DeckOptions &options)
    : the_deck(file)
    , the_options(options)
    , element_material(the_deck.elements().size(), Deck::none)
    , remark_list(the_deck.remarks())
  {
    DeckModelReader(*this).read();
  }



  void DeckModel::refuse(const DeckPlace &place, const std::string &keyword, const std::string &text) const
  {
    if (the_options.ignore.count(keyword) > 0)
      return;
    std::string others, all = keyword;
    for (const std::string &name : DeckModelReader::refused_in(the_deck))
      if (name != keyword && the_options.ignore.count(name) == 0)
        {
          others += (others.empty() ? "" : ", ") + name;
          all += "," + name;
        }
    the_deck.text().fail(place,
                         keyword + ": " + text + " To compute without it: --ignore \"" + keyword + "\"." +
                             (others.empty()
                                  ? ""
                                  : " The file also has " + others +
                                        ", refused as well; without all of them: --ignore \"" + all + "\"."));
  }



  void DeckModel::differ(const DeckPlace &place, const std::string &text)
  {
    if (the_options.strict)
      the_deck.text().fail(place, text + " This is refused because of --strict.");
    remark_list.push_back(the_deck.text().where(place) + ": " + text);
  }



  DeckModelReader::DeckModelReader(DeckModel &model)
    : model(model)
    , deck(model.deck())
  {
  }



  const std::map<std::string, DeckModelReader::Handler> &DeckModelReader::handlers()
  {
    using R                                           = DeckModelReader;
    static const std::map<std::string, Handler> table = {{"HEADING", &R::read_heading},
                                                         {"RIGID BODY", &R::read_rigid_body},
                                                         {"KINEMATIC COUPLING", &R::read_kinematic_coupling},
                                                         {"COUPLING", &R::read_coupling},
                                                         {"KINEMATIC", &R::read_kinematic},
                                                         {"EQUATION", &R::read_equation},
                                                         {"PRE-TENSION SECTION", &R::read_pretension},
                                                         {"MATERIAL", &R::read_material},
                                                         {"ELASTIC", &R::read_elastic},
                                                         {"DENSITY", &R::read_density},
                                                         {"EXPANSION", &R::read_expansion},
                                                         {"SOLID SECTION", &R::read_section},
                                                         {"TRANSFORM", &R::read_transform},
                                                         {"AMPLITUDE", &R::read_amplitude},
                                                         {"SURFACE INTERACTION", &R::read_interaction},
                                                         {"SURFACE BEHAVIOR", &R::read_behaviour},
                                                         {"FRICTION", &R::read_friction},
                                                         {"CONTACT PAIR", &R::read_contact_pair},
                                                         {"TIE", &R::read_tie},
                                                         {"INITIAL CONDITIONS", &R::read_initial_conditions},
                                                         {"STEP", &R::read_step},
                                                         {"STATIC", &R::read_static},
                                                         {"END STEP", &R::read_end_step},
                                                         {"BOUNDARY", &R::read_boundary},
                                                         {"CLOAD", &R::read_nodal_force},
                                                         {"DLOAD", &R::read_element_load},
                                                         {"DSLOAD", &R::read_surface_load},
                                                         {"TEMPERATURE", &R::read_temperature}};
    return table;
  }



  const std::map<std::string, std::string> &DeckModelReader::refused()
  {
    static const std::string procedure                    = "only STATIC steps are computed.",
                             plastic                      = "materials are linearly elastic.",
                             structural                   = "only solid elements are computed.";
    static const std::map<std::string, std::string> table = {
        {"PLASTIC", plastic},
        {"CYCLIC HARDENING", plastic},
        {"HYPERELASTIC", plastic},
        {"HYPERFOAM", plastic},
        {"CREEP", plastic},
        {"VISCOELASTIC", plastic},
        {"DEFORMATION PLASTICITY", plastic},
        {"CONCRETE", plastic},
        {"DRUCKER PRAGER", plastic},
        {"MOHR COULOMB", plastic},
        {"USER MATERIAL", plastic},
        {"DEPVAR", plastic},
        {"RATE DEPENDENT", plastic},
        {"SHELL SECTION", structural},
        {"BEAM SECTION", structural},
        {"MEMBRANE SECTION", structural},
        {"BEAM GENERAL SECTION", structural},
        {"SHELL GENERAL SECTION", structural},
        {"SPRING", structural},
        {"DASHPOT", structural},
        {"MASS", structural},
        {"GAP", structural},
        {"CONNECTOR SECTION", structural},
        {"DYNAMIC", procedure},
        {"FREQUENCY", procedure},
        {"BUCKLE", procedure},
        {"HEAT TRANSFER", procedure},
        {"COUPLED TEMPERATURE-DISPLACEMENT", procedure},
        {"UNCOUPLED TEMPERATURE-DISPLACEMENT", procedure},
        {"VISCO", procedure},
        {"MODAL DYNAMIC", procedure},
        {"STEADY STATE DYNAMICS", procedure},
        {"COMPLEX FREQUENCY", procedure},
        {"MPC", "constraints between nodes are not taken."},
        {"DISTRIBUTING COUPLING", "couplings of nodes are not taken."},
        {"DISTRIBUTING", "couplings of nodes are not taken."},
        {"CYCLIC SYMMETRY MODEL", "cyclic symmetry is not computed."},
        {"CONTACT", "general contact is not taken: name the surfaces with CONTACT PAIR."},
        {"CLEARANCE", "gaps are those of the nodes."},
        {"CONTACT INTERFERENCE", "overlaps are those of the nodes."},
        {"CHANGE FRICTION", "contact is frictionless."},
        {"CHANGE CONTACT TYPE", "contact is the same in all steps."},
        {"MODEL CHANGE", "bodies and contact are the same in all steps."},
        {"GAP CONDUCTANCE", "heat is not computed."},
        {"INERTIA RELIEF", "bodies have to be held."},
        {"RESTART", "a run begins at its first step."}};
    return table;
  }



  const std::set<std::string> &DeckModelReader::lasting()
  {
    static const std::set<std::string> names = {"BOUNDARY", "CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE"};
    return names;
  }



  const std::set<std::string> &DeckModelReader::passed_over()
  {
    static const std::set<std::string> names = {"PREPRINT",
                                                "OUTPUT",
                                                "NODE OUTPUT",
                                                "ELEMENT OUTPUT",
                                                "CONTACT OUTPUT",
                                                "ENERGY OUTPUT",
                                                "ENERGY PRINT",
                                                "NODE FILE",
                                                "EL FILE",
                                                "NODE PRINT",
                                                "EL PRINT",
                                                "CONTACT FILE",
                                                "CONTACT PRINT",
                                                "FACE PRINT",
                                                "SECTION PRINT",
                                                "FILE FORMAT",
                                                "FILE OUTPUT",
                                                "MONITOR",
                                                "CONTROLS",
                                                "SOLUTION TECHNIQUE",
                                                "TIME POINTS",
                                                "PRINT",
                                                "CONTACT CONTROLS",
                                                "CONTACT STABILIZATION",
                                                "ORIENTATION",
                                                "DAMPING",
                                                "CONDUCTIVITY",
                                                "SPECIFIC HEAT",
                                                "PHYSICAL CONSTANTS",
                                                "SECTION CONTROLS",
                                                "HOURGLASS STIFFNESS",
                                                "NO ANALYSIS",
                                                "CONSTRAINT CONTROLS",
                                                "DIAGNOSTICS",
                                                "FILTER",
                                                "NODE RESPONSE",
                                                "SOLVER CONTROLS",
                                                "USER ELEMENT OUTPUT",
                                                "INTEGRATED OUTPUT",
                                                "INTEGRATED OUTPUT SECTION",
                                                "SURFACE FLAW",
                                                "PARAMETER OUTPUT",
                                                "RESPONSE"};
    return names;
  }



  void DeckModelReader::read()
  {
    for (const Deck::Other &other : deck.others())
      handle(*other.keyword, other.instance);
    finish();
  }



  void DeckModelReader::handle(const Keyword &keyword, const unsigned int instance)
  {
    const std::string &name = keyword.name;
    if (name == "RESTART" && !keyword.has("READ"))
      over.push_back(name);
    else if (model.options().ignore.count(name) > 0)
      model.remark_list.push_back(deck.text().where(keyword.place) + ": " + name +
                                  " is passed over, as --ignore says.");
    else if (const auto handler = handlers().find(name); handler != handlers().end())
      {
        if (lasting().count(name) > 0)
          history.push_back({handler->second, &keyword, instance, step, period});
        total_time = state.time + period;
        (this->*handler->second)(keyword, instance);
      }
    else if (passed_over().count(name) > 0)
      over.push_back(name);
    else if (const auto advice = refused().find(name); advice != refused().end())
      model.refuse(keyword.place, name, advice->second);
    else
      model.refuse(keyword.place, name, "this keyword is not known.");
  }



  std::set<std::string> DeckModelReader::refused_in(const Deck &deck)
  {
    std::set<std::string> result;
    for (const Deck::Other &other : deck.others())
      {
        const Keyword &keyword  = *other.keyword;
        const bool     is_known = keyword.name == "RESTART" || passed_over().count(keyword.name) > 0 ||
                              handlers().count(keyword.name) > 0;
        if (keyword.name == "FRICTION" ? has_friction(keyword, deck) : !is_known)
          result.insert(keyword.name);
      }
    return result;
  }



  void DeckModelReader::finish()
  {
    if (is_in_step)
      fail(deck.others().back().keyword->place, "the last STEP has no END STEP. Is the file cut off?");
    if (model.step_list.empty())
      throw InputError(deck.text().files()[0] + ": there is no STEP: nothing is asked to be computed.");
    for (const auto &[pair, name] : contact)
      {
        model.pair_list.push_back(pair);
        const auto it = interactions.find(deck_upper(name));
        if (!name.empty() && it == interactions.end())
          fail(pair.place, "there is no SURFACE INTERACTION \"" + name + "\".");
        model.pair_list.back().is_tied = pair.is_tied || (it != interactions.end() && it->second.is_tied);
      }
    if (std::any_of(deck.elements().begin(), deck.elements().end(), [](const DeckElement &element) {
          return element.type->is_solid() && element.type->is_quadratic();
        }))
      model.remark_list.push_back(
          deck.text().files()[0] +
          ": quadratic elements are cut into eight linear ones, which are stiffer where thin parts bend; "
          "--set \"Refinement/Initial global levels=1\" shows how much.");
    join_equations();
    std::string names;
    for (const std::string &name : std::set<std::string>(over.begin(), over.end()))
      names += (names.empty() ? "" : ", ") + name;
    if (!names.empty())
      model.remark_list.push_back(deck.text().files()[0] + ": passed over: " + names + ".");
  }



  void DeckModelReader::fail(const DeckPlace &place, const std::string &text) const
  {
    deck.text().fail(place, text);
  }



  double DeckModelReader::number(const Words &words, const std::size_t i, const DeckLine &line) const
  {
    if (i >= words.size() || words[i].empty())
      fail(line.place, "a number is missing in \"" + line.text + "\".");
    return deck.text().number(words[i], line.place);
  }



  Vector3 DeckModelReader::direction(const Words &words, const std::size_t i, const DeckLine &line) const
  {
    Vector3 v;
    for (unsigned int c = 0; c < dim; ++c)
      if (i + c < words.size() && !words[i + c].empty())
        v[c] = deck.text().number(words[i + c], line.place);
    return v;
  }



  void DeckModelReader::read_heading(const Keyword &keyword, const unsigned int)
  {
    if (!keyword.lines.empty() && model.heading.empty())
      model.heading = keyword.lines[0].text;
  }



  void DeckModelReader::read_material(const Keyword &keyword, const unsigned int)
  {
    model.material_list.push_back({keyword.get("NAME"), keyword.place, {}, {}, {}});
  }



  DeckMaterial &DeckModelReader::material(const Keyword &keyword)
  {
    if (model.material_list.empty())
      fail(keyword.place, keyword.name + " belongs below a MATERIAL.");
    return model.material_list.back();
  }



  void DeckModelReader::read_elastic(const Keyword &keyword, const unsigned int)
  {
    const std::string type = deck_upper(keyword.get("TYPE"));
    if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
      model.refuse(keyword.place, "ELASTIC", "materials are isotropic, TYPE=" + type + " is not.");
    if (keyword.lines.empty())
      fail(keyword.place, "ELASTIC needs Young's modulus and Poisson's ratio.");
    const DeckLine &line      = keyword.lines[0];
    const Words     words     = deck_words(line.text);
    material(keyword).elastic = IsotropicMaterial{number(words, 0, line), number(words, 1, line)};
    if (keyword.lines.size() > 1)
      model.differ(keyword.place, "ELASTIC depends on temperature; the first row is taken.");
  }



  void DeckModelReader::read_density(const Keyword &keyword, const unsigned int)
  {
    if (keyword.lines.empty())
      fail(keyword.place, "DENSITY needs a number.");
    material(keyword).density = number(deck_words(keyword.lines[0].text), 0, keyword.lines[0]);
  }



  void DeckModelReader::read_expansion(const Keyword &keyword, const unsigned int)
  {
    const std::string type = deck_upper(keyword.get("TYPE"));
    if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
      model.refuse(keyword.place, "EXPANSION", "expansion is isotropic, TYPE=" + type + " is not.");
    if (keyword.lines.empty())
      fail(keyword.place, "EXPANSION needs a number.");
    material(keyword).expansion = number(deck_words(keyword.lines[0].text), 0, keyword.lines[0]);
    // With one coefficient the temperature ZERO, from which it counts, has no influence.
    if (keyword.lines.size() > 1)
      model.differ(keyword.place, "EXPANSION depends on temperature; the first row is taken.");
  }



  void DeckModelReader::read_section(const Keyword &keyword, const unsigned int instance)
  {
    // Parts come before the materials in files of Abaqus.
    unsigned int m     = 0;
    bool         found = false;
    for (const Deck::Other &other : deck.others())
      if (other.keyword->name == "MATERIAL" && !found)
        {
          found = deck_upper(other.keyword->get("NAME")) == deck_upper(keyword.get("MATERIAL"));
          m += found ? 0 : 1;
        }
    if (!found)
      fail(keyword.place, "there is no MATERIAL \"" + keyword.get("MATERIAL") + "\".");
    for (const unsigned int e : deck.elements_of(keyword.get("ELSET"), keyword.place, instance))
      model.element_material[e] = m;
  }



  void DeckModelReader::read_transform(const Keyword &keyword, const unsigned int instance)
  {
    if (keyword.lines.empty())
      fail(keyword.place, "TRANSFORM needs six numbers.");
    const DeckLine &line = keyword.lines[0];
    const Words     w    = deck_words(line.text);
    DeckFrame       frame;
    frame.place          = keyword.place;
    frame.is_cylindrical = deck_upper(keyword.get("TYPE")) == "C";
    if (deck_upper(keyword.get("TYPE")) == "S")
      fail(keyword.place, "spherical axes are not supported.");
    const Vector3 a = direction(w, 0, line), b = direction(w, 3, line);
    frame.first  = Point<3>(a);
    frame.second = Point<3>(b);
    if (!frame.is_cylindrical)
      {
        const Vector3 normal = cross_product_3d(a, b);
        if (!(normal.norm() > 0.))
          fail(line.place, "the two directions of a TRANSFORM must not be parallel.");
        frame.axes[0] = a / a.norm();
        frame.axes[2] = normal / normal.norm();
        frame.axes[1] = cross_product_3d(frame.axes[2], frame.axes[0]);
      }
    else if (!(frame.first.distance(frame.second) > 0.))
      fail(line.place, "the two points of the axis of a TRANSFORM must differ.");
    for (const unsigned int node : deck.nodes_of(keyword.get("NSET"), keyword.place, instance))
      model.node_frame[node] = static_cast<unsigned int>(model.frame_list.size());
    model.frame_list.push_back(frame);
  }
} // namespace Signorini

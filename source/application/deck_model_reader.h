// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_deck_model_reader_h
#define signorini_source_application_deck_model_reader_h

#include <signorini/application/deck_model.h>

namespace Signorini
{
  /// Goes through the keywords of a deck.
  class DeckModelReader
  {
  public:
    explicit DeckModelReader(DeckModel &model);

    void read();

    /// Names of keywords that are refused whatever they say, FRICTION among them.
    static std::set<std::string> refused_in(const Deck &deck);

  private:
    using Keyword = DeckKeyword;
    using Words   = std::vector<std::string>;
    using Handler = void (DeckModelReader::*)(const Keyword &, const unsigned int instance);

    /// Values of an AMPLITUDE over time.
    struct Amplitude
    {
      std::vector<std::pair<double, double>> points;
      bool                                   is_total = false;
    };

    /// A load or condition as it was read, to be read again at the end of later steps.
    struct HistoryEntry
    {
      Handler        handler;
      const Keyword *keyword;
      unsigned int   instance, step;
      double         period;
    };

    /// What a SURFACE INTERACTION means.
    struct Interaction
    {
      bool is_tied = false;
    };

    static const std::map<std::string, Handler>     &handlers();
    static const std::map<std::string, std::string> &refused();
    static const std::set<std::string>              &passed_over();
    /// Loads and conditions: they last in later steps.
    static const std::set<std::string> &lasting();

    /// Whether contact with it would have friction.
    static bool has_friction(const Keyword &keyword, const Deck &deck);

    void handle(const Keyword &keyword, const unsigned int instance);
    /// Notes the keywords that were passed over.
    void finish();

    // Model.
    void read_heading(const Keyword &keyword, const unsigned int);
    void read_material(const Keyword &keyword, const unsigned int);
    void read_elastic(const Keyword &keyword, const unsigned int);
    void read_density(const Keyword &keyword, const unsigned int);
    void read_expansion(const Keyword &keyword, const unsigned int);
    void read_section(const Keyword &keyword, const unsigned int instance);
    void read_transform(const Keyword &keyword, const unsigned int instance);
    void read_amplitude(const Keyword &keyword, const unsigned int);
    void read_interaction(const Keyword &keyword, const unsigned int);
    void read_behaviour(const Keyword &keyword, const unsigned int);
    void read_friction(const Keyword &keyword, const unsigned int);
    void read_contact_pair(const Keyword &keyword, const unsigned int instance);
    void read_tie(const Keyword &keyword, const unsigned int instance);
    void read_initial_conditions(const Keyword &keyword, const unsigned int instance);

    void read_pretension(const Keyword &keyword, const unsigned int instance);

    // Nodes that move together.
    void read_rigid_body(const Keyword &keyword, const unsigned int instance);
    void read_kinematic_coupling(const Keyword &keyword, const unsigned int instance);
    void read_coupling(const Keyword &keyword, const unsigned int instance);
    void read_kinematic(const Keyword &keyword, const unsigned int);
    void read_equation(const Keyword &keyword, const unsigned int instance);
    /// Nodes that equations make move alike become rigid bodies that do not turn.
    void         join_equations();
    bool         is_reference(const unsigned int node) const;
    unsigned int only_node(const Keyword &keyword, const std::string &option,
                           const unsigned int instance) const;

    // History.
    void read_step(const Keyword &keyword, const unsigned int);
    void read_static(const Keyword &keyword, const unsigned int);
    void read_end_step(const Keyword &keyword, const unsigned int);
    void read_boundary(const Keyword &keyword, const unsigned int instance);
    void read_nodal_force(const Keyword &keyword, const unsigned int instance);
    void read_element_load(const Keyword &keyword, const unsigned int instance);
    void read_surface_load(const Keyword &keyword, const unsigned int instance);
    void read_temperature(const Keyword &keyword, const unsigned int instance);

    DeckMaterial &material(const Keyword &keyword);
    /// Directions and values of a line of BOUNDARY; nothing for rotations.
    void add_boundary(const Keyword &keyword, const DeckLine &line, const unsigned int instance);
    /// FIXED: what stays as it is.
    void lock(const DeckLine &line, const unsigned int instance);
    void add_volume_load(const Keyword &keyword, const DeckLine &line, const Words &words,
                         const unsigned int instance);
    /// Adds in the same step, replaces that of an earlier one.
    void set_load(DeckLoad &load, const double value) const;
    bool is_new(const Keyword &keyword) const;
    /// Of the AMPLITUDE of a keyword at the end of its step, or at total_time; 1 without.
    double factor(const Keyword &keyword) const;
    bool   follows_total_time(const Keyword &keyword) const;
    /// Loads of earlier steps that last and whose AMPLITUDE goes over the total time have another value at
    /// the end of this one: all loads and conditions are read again for that time.
    void              follow_total_time();
    double            number(const Words &words, const std::size_t i, const DeckLine &line) const;
    [[noreturn]] void fail(const DeckPlace &place, const std::string &text) const;
    Vector3           direction(const Words &words, const std::size_t i, const DeckLine &line) const;

    DeckModel   &model;
    const Deck  &deck;
    DeckState    state;
    bool         is_in_step = false;
    unsigned int step       = 0;
    double       period     = 1.;
    /// For which amplitudes over the total time are evaluated.
    double                                        total_time = 1.;
    std::vector<HistoryEntry>                     history;
    std::map<std::string, Amplitude>              amplitudes;
    std::map<std::string, Interaction>            interactions;
    std::string                                   interaction;
    std::vector<std::pair<DeckPair, std::string>> contact;
    /// Keywords that were passed over, in the order of the file.
    std::vector<std::string> over;
    /// By direction: pairs of nodes that move alike.
    std::array<std::vector<std::pair<unsigned int, unsigned int>>, 3> alike;
    DeckPlace                                                         first_equation;
    /// Of the COUPLING whose kind is not known yet.
    DeckRigid coupling;
  };
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_deck_problem_h
#define signorini_application_deck_problem_h

#include <signorini/application/deck_model.h>
#include <signorini/application/problem_definition.h>
#include <signorini/output/frd_output.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// Whether a file is a deck, by its name: *.inp.
  bool is_deck(const std::string &file);

  /// A deck as a contact problem. Bodies are the connected parts of its solid elements. They are named by
  /// their instance, or by the smallest set that has all of their elements.
  struct DeckProblem
  {
    /// Of vertices that are no node of the deck.
    static constexpr long no_label = -1;

    /// What results in the deck's own terms need of a body.
    struct BodyLabels
    {
      /// The elements of the deck.
      std::vector<FrdElement> elements;
      /// The number of the deck's node at each vertex of the start mesh, or no_label.
      std::vector<long> node_of_vertex;
    };

    /// The contact problem.
    ProblemDefinition problem;
    /// By body.
    std::vector<BodyLabels> labels;
    /// Of all nodes of the deck.
    long largest_node_label = 0;
    /// What was taken differently, what was passed over.
    std::vector<std::string> remarks;
    /// The load steps; step k (from 0) ends at t = (k + 1) / n_steps.
    unsigned int n_steps = 1;
    /// Whether the deck asks for geometrical nonlinearity.
    bool nonlinear_geometry = false;
  };

  /// The problem of its steps, where they hold the same directions, or else of the last one. The same on all
  /// ranks. Errors: InputError with file and line.
  DeckProblem make_deck_problem(const DeckModel &model);
} // namespace Signorini

#endif

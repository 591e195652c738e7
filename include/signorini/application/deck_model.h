// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_deck_model_h
#define signorini_application_deck_model_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/deck.h>
#include <signorini/mesh/material.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// How strictly a deck is taken.
  struct DeckOptions
  {
    /// Refuse what is otherwise taken differently, with a remark.
    bool strict = false;
    /// Keywords that are passed over although they change the result, in capitals.
    std::set<std::string> ignore;
  };

  /// What MATERIAL and the keywords below it say.
  struct DeckMaterial
  {
    /// As it is written.
    std::string name;
    /// Where its keyword is.
    DeckPlace place;
    /// None where it has no ELASTIC.
    std::optional<IsotropicMaterial> elastic;
    /// Mass per volume; expansion per degree.
    std::optional<double> density, expansion;
  };

  /// Axes of a TRANSFORM: those of a rotated frame, or those of a cylinder (radial, tangential, axial).
  struct DeckFrame
  {
    /// Whether the axes are those of a cylinder.
    bool is_cylindrical = false;
    /// Rows: the axes. Without meaning for a cylinder.
    std::array<Vector3, 3> axes;
    /// Two points of the axis of a cylinder (length).
    dealii::Point<3> first, second;
    DeckPlace        place;
  };

  /// Prescribed displacements of some nodes.
  struct DeckBoundary
  {
    /// The set as it is written; empty for single nodes.
    std::string               set;
    std::vector<unsigned int> nodes;
    /// By direction (length).
    std::array<std::optional<double>, 3> values;
    DeckPlace                            place;
  };

  /// A value that later steps may replace.
  struct DeckLoad
  {
    /// In the units of what is loaded.
    double value = 0.;
    /// The step that gave it.
    unsigned int step = 0;
  };

  /// Loads on a surface or on elements.
  struct DeckSurfaceLoad
  {
    /// On which one.
    const DeckSurface *surface = nullptr;
    /// P or TRVEC: with the surface what a later step replaces.
    std::string kind;
    /// Against the outward normal.
    double pressure = 0.;
    /// Force per area.
    Vector3      traction;
    unsigned int step = 0;
    DeckPlace    place;
  };

  /// Acceleration or force per volume of some elements.
  struct DeckVolumeLoad
  {
    /// Indices into Deck::elements().
    std::vector<unsigned int> elements;
    /// GRAV, BX, BY or BZ: with the elements what a later step replaces.
    std::string kind;
    /// Whether to be multiplied by the density.
    bool         is_acceleration = true;
    Vector3      value;
    unsigned int step = 0;
    DeckPlace    place;
  };

  /// All that acts at the end of a step.
  struct DeckState
  {
    /// Where two overlap, the later one counts.
    std::vector<DeckBoundary> boundaries;
    /// Whose displacement in direction 1 stays as it is, with the step that says so: those of pretension
    /// sections.
    std::map<unsigned int, unsigned int> locked_nodes;
    /// By node and direction: force; directions 3 to 5 of reference nodes are moments.
    std::map<std::pair<unsigned int, unsigned int>, DeckLoad> forces;
    /// By reference node and axis: rotation (radian).
    std::map<std::pair<unsigned int, unsigned int>, double> rotations;
    /// By element and side: pressure.
    std::map<std::pair<unsigned int, unsigned int>, DeckLoad> pressures;
    std::vector<DeckSurfaceLoad>                              surface_loads;
    std::vector<DeckVolumeLoad>                               volume_loads;
    /// By node.
    std::map<unsigned int, DeckLoad> temperatures;
    /// Since the begin of the first step.
    double time = 0.;
    /// Whether the step asks for geometrical nonlinearity.
    bool nonlinear_geometry = false;
  };

  /// Two surfaces that may touch, or are glued together.
  struct DeckPair
  {
    /// That of the interaction, or of the tie.
    std::string name;
    /// The two surfaces.
    const DeckSurface *slave = nullptr, *master = nullptr;
    /// Whether they are glued together.
    bool is_tied = false;
    /// Nodes of the slave surface that are moved onto the other one at first: those with smaller gaps
    /// (length), or these.
    std::optional<double>     adjust;
    std::vector<unsigned int> adjusted_nodes;
    DeckPlace                 place;
  };

  /// Nodes that move as a rigid body with a reference node.
  struct DeckRigid
  {
    /// No reference node.
    static constexpr unsigned int none = Deck::none;

    /// The keyword that makes it.
    std::string keyword;
    /// The nodes, or else the surface.
    std::vector<unsigned int> nodes;
    const DeckSurface        *surface = nullptr;
    /// The node whose displacements, forces, and (directions 4 to 6) rotations and moments are those of the
    /// body; the node whose directions 1 to 3 are its rotations.
    unsigned int reference = none, rotation = none;
    /// Whether it does not turn.
    bool      translates_only = false;
    DeckPlace place;
  };

  /// A section through a bolt whose force is that of a node.
  struct DeckPretension
  {
    /// Sides of elements inside of the bolt.
    const DeckSurface *surface = nullptr;
    unsigned int       node    = Deck::none;
    /// Zero for the normal of the surface.
    Vector3   axis;
    DeckPlace place;
  };

  /// What a deck says beside its mesh, as plain data. What differs from the deck is in the remarks. Errors:
  /// InputError with file and line for keywords that would change the result and cannot be taken.
  class DeckModel
  {
  public:
    /// Reads the file.
    DeckModel(const std::string &file, const DeckOptions &options);

    /// Its mesh.
    const Deck &deck() const
    {
      return the_deck;
    }

    /// As they were given.
    const DeckOptions &options() const
    {
      return the_options;
    }

    /// In the order of the file.
    const std::vector<DeckMaterial> &materials() const
    {
      return material_list;
    }

    /// By element the index of its material, or Deck::none.
    const std::vector<unsigned int> &material_of_element() const
    {
      return element_material;
    }

    /// CONTACT PAIR and TIE.
    const std::vector<DeckPair> &pairs() const
    {
      return pair_list;
    }

    /// RIGID BODY, couplings, equations.
    const std::vector<DeckRigid> &rigid() const
    {
      return rigid_list;
    }

    /// PRE-TENSION SECTION.
    const std::vector<DeckPretension> &pretensions() const
    {
      return pretension_list;
    }

    /// At the end of each step.
    const std::vector<DeckState> &steps() const
    {
      return step_list;
    }

    /// By node, where TRANSFORM gives it axes of its own.
    const std::map<unsigned int, unsigned int> &frame_of_node() const
    {
      return node_frame;
    }

    /// Of TRANSFORM.
    const std::vector<DeckFrame> &frames() const
    {
      return frame_list;
    }

    /// Initial temperatures by node.
    const std::map<unsigned int, double> &initial_temperatures() const
    {
      return initial_temperature;
    }

    /// What was taken differently, what was passed over.
    const std::vector<std::string> &remarks() const
    {
      return remark_list;
    }

    /// The first line of HEADING.
    const std::string &title() const
    {
      return heading;
    }

    /// Errors: InputError that says how to pass over a keyword, unless the options do.
    void refuse(const DeckPlace &place, const std::string &keyword, const std::string &text) const;

    /// Adds a remark; InputError if the options are strict.
    void differ(const DeckPlace &place, const std::string &text);

  private:
    friend class DeckModelReader;

    const Deck                           the_deck;
    const DeckOptions                    the_options;
    std::vector<DeckMaterial>            material_list;
    std::vector<unsigned int>            element_material;
    std::vector<DeckPair>                pair_list;
    std::vector<DeckRigid>               rigid_list;
    std::vector<DeckPretension>          pretension_list;
    std::vector<DeckState>               step_list;
    std::map<unsigned int, unsigned int> node_frame;
    std::vector<DeckFrame>               frame_list;
    std::map<unsigned int, double>       initial_temperature;
    std::vector<std::string>             remark_list;
    std::string                          heading;
  };
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_deck_h
#define signorini_mesh_deck_h

#include <signorini/mesh/deck_text.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  struct DeckElementType;

  /// An element: nodes are indices into Deck::positions(), in the order of the file.
  struct DeckElement
  {
    /// The number in the file.
    long label;
    /// Its kind.
    const DeckElementType *type;
    /// Indices into Deck::positions(), in the order of the file.
    std::vector<unsigned int> nodes;
    /// Where it is written.
    DeckPlace place;
  };

  /// A named set of nodes or elements, as ascending indices.
  struct DeckSet
  {
    /// As it was written first; with "INSTANCE." in front for those of an instance.
    std::string               name;
    std::vector<unsigned int> members;
  };

  /// Faces of elements, or nodes.
  struct DeckSurface
  {
    /// Elements and what of them belongs to it: S1, S2, ...; empty for all their faces that belong to no
    /// other element; SPOS or SNEG for shells.
    struct Faces
    {
      /// Indices into Deck::elements().
      std::vector<unsigned int> elements;
      /// What of them, as it is written.
      std::string side;
      /// Where that is written.
      DeckPlace place;
    };

    /// As it is written.
    std::string name;
    /// Where its keyword is.
    DeckPlace place;
    /// Its faces, if it is made of faces.
    std::vector<Faces> faces;
    /// Its nodes, if it is made of nodes.
    std::vector<unsigned int> nodes;
    /// Whether it is made of nodes.
    bool is_of_nodes = false;
  };

  /// The nodes, elements, sets and surfaces of an Abaqus or CalculiX input file as one flat model: parts are
  /// where their instances put them. Numbers of nodes and elements are those of the file; with several
  /// instances each counts on from the one before. Names are compared without regard to case; what belongs to
  /// an instance is reached as INSTANCE.NAME, and as NAME where that is unique. Errors: InputError with file
  /// and line.
  class Deck
  {
  public:
    /// No instance, no part.
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// A keyword that does not make the mesh, and the instance that it belongs to, or none.
    struct Other
    {
      /// The keyword.
      const DeckKeyword *keyword;
      /// The instance, or none.
      unsigned int instance;
    };

    /// Reads the file and those that it includes.
    explicit Deck(const std::string &file);

    Deck(const Deck &) = delete;

    /// The keywords that it was made of, for messages.
    const DeckText &text() const
    {
      return source;
    }

    /// Of the nodes (length).
    const std::vector<dealii::Point<3>> &positions() const
    {
      return points;
    }

    /// Numbers of the nodes, as in the file.
    const std::vector<long> &node_labels() const
    {
      return labels;
    }

    /// In the order of the file.
    const std::vector<DeckElement> &elements() const
    {
      return element_list;
    }

    /// In the order of the file.
    const std::vector<DeckSet> &node_sets() const
    {
      return node_set_list;
    }

    /// In the order of the file.
    const std::vector<DeckSet> &element_sets() const
    {
      return element_set_list;
    }

    /// In the order of the file.
    const std::vector<DeckSurface> &surfaces() const
    {
      return surface_list;
    }

    /// What does not make the mesh, in the order of the file; that of a part once for each of its instances.
    const std::vector<Other> &others() const
    {
      return other_list;
    }

    /// Remarks: numbers in sets that belong to nothing.
    const std::vector<std::string> &remarks() const
    {
      return remark_list;
    }

    /// The name of the instance that an element belongs to; empty without parts.
    const std::string &instance_of_element(const unsigned int element) const;

    /// The nodes that a word of a data line means: a number or a set. Errors: InputError.
    std::vector<unsigned int> nodes_of(const std::string &word, const DeckPlace &place,
                                       const unsigned int instance = none) const;

    /// The elements that a word of a data line means: a number or a set. Errors: InputError.
    std::vector<unsigned int> elements_of(const std::string &word, const DeckPlace &place,
                                          const unsigned int instance = none) const;

    /// Errors: InputError for surfaces that do not exist.
    const DeckSurface &surface(const std::string &name, const DeckPlace &place,
                               const unsigned int instance = none) const;

    /// A set by its name, or null.
    const DeckSet *find_node_set(const std::string &name, const unsigned int instance = none) const;

    /// A set by its name, or null.
    const DeckSet *find_element_set(const std::string &name, const unsigned int instance = none) const;

  private:
    /// The instance of numbers that count over all.
    static constexpr unsigned int all_instances = none - 1;

    struct Instance
    {
      std::string          name;
      long                 node_offset = 0, element_offset = 0;
      dealii::Tensor<1, 3> translation;
      dealii::Tensor<2, 3> rotation;
      dealii::Point<3>     pivot;
      bool                 is_moved      = false;
      unsigned int         first_element = 0, end_element = 0;
    };

    /// What a data line of a set says.
    struct Entry
    {
      long         first, last, step;
      std::string  set;
      unsigned int instance;
      DeckPlace    place;
    };

    /// A set before the sets in it are known.
    struct RawSet
    {
      std::string        name;
      std::vector<Entry> entries;
      unsigned int       instance;
      int                state = 0;
      /// Of a set of nodes: sets of elements whose nodes belong to it.
      std::vector<Entry> of_elements = {};
    };

    struct RawSets
    {
      std::vector<RawSet>                 list;
      std::map<std::string, unsigned int> index;
      /// Sets that wait for one in them.
      unsigned int n_open = 0;
    };

    void         read_keywords();
    void         read_keyword(const DeckKeyword &keyword, const unsigned int instance);
    void         read_instance(const std::size_t begin, const std::size_t end);
    void         set_placement(Instance &instance, const DeckKeyword &keyword) const;
    void         add_part(const std::string &name, const DeckPlace &place, const unsigned int instance);
    void         read_nodes(const DeckKeyword &keyword, const unsigned int instance);
    void         read_elements(const DeckKeyword &keyword, const unsigned int instance);
    void         read_set(RawSets &sets, const DeckKeyword &keyword, const std::string &option,
                          const unsigned int instance);
    void         read_surface(const DeckKeyword &keyword, const unsigned int instance);
    unsigned int instance_of_option(const DeckKeyword &keyword, const unsigned int instance) const;
    Entry        entry_of(const std::string &word, const DeckPlace &place, const unsigned int instance) const;
    RawSet      &raw_set(RawSets &sets, const std::string &name, const unsigned int instance);
    /// The key of a name that is used in an instance, or empty.
    template <typename Index>
    std::string  key_of(const Index &index, const std::string &name, const unsigned int instance) const;
    std::string  full_name(const std::string &name, const unsigned int instance) const;
    void         resolve_sets();
    void         resolve(RawSets &sets, const unsigned int s, std::vector<DeckSet> &result,
                         const std::unordered_map<long, unsigned int> &number, const bool of_nodes);
    void         resolve_surfaces();
    unsigned int member_with(const long label, const unsigned int instance,
                             const std::unordered_map<long, unsigned int> &number, const bool of_nodes) const;
    long         offset(const unsigned int instance, const bool of_nodes) const;

    const DeckText                         source;
    std::vector<dealii::Point<3>>          points;
    std::vector<long>                      labels;
    std::vector<DeckElement>               element_list;
    std::unordered_map<long, unsigned int> node_index, element_index;
    std::vector<Instance>                  instances;
    std::map<std::string, unsigned int>    instance_index;
    /// Keywords of the parts by name: first and end.
    std::map<std::string, std::pair<std::size_t, std::size_t>> parts;
    RawSets                                                    raw_node_sets, raw_element_sets;
    std::vector<DeckSet>                                       node_set_list, element_set_list;
    std::vector<DeckSurface>                                   surface_list;
    /// Of each keyword the surface that it makes or adds to.
    std::vector<std::pair<unsigned int, Other>> surface_keywords;
    std::vector<Other>                          element_keywords;
    std::map<std::string, unsigned int>         surface_index;
    std::vector<Other>                          other_list;
    std::vector<std::string>                    remark_list;
    long                                        largest_node = 0, largest_element = 0;
    /// Of nodes that belong to the assembly itself.
    long assembly_offset = 0;
  };
} // namespace Signorini

#endif

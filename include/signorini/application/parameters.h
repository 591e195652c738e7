// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_parameters_h
#define signorini_application_parameters_h

#include <signorini/application/deck_problem.h>
#include <signorini/application/load_steps.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/output/vtu_file.h>

#include <deal.II/base/parameter_handler.h>

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace Signorini
{
  /// The subsection of a contact pair: the front end of PairDefinition.
  struct PairParameters
  {
    /// That of the subsection.
    std::string name;
    /// "body: boundary"; expressions that are positive where the surface may touch, or empty.
    std::string first, second, first_region, second_region;
    /// As RigidObstacle::parse() has it, or empty.
    std::string obstacle;
    /// "geometry" or an expression.
    std::string initial_gap = "geometry";
    /// As in PairDefinition.
    ContactKind        contact     = ContactKind::unilateral;
    GapKind            gap         = GapKind::weighted;
    NonmortarChoice    nonmortar   = NonmortarChoice::automatic;
    SurfaceKind        surface     = SurfaceKind::automatic;
    InitialPenetration penetration = InitialPenetration::automatic;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Of these, those that say how a pair is treated which something else defines.
    void add_treatment(dealii::ParameterHandler &prm);

    /// Errors: InputError for texts that cannot be understood.
    PairDefinition definition() const;

    /// Sets what add_treatment() declares. Errors: as above.
    void treat(PairDefinition &pair) const;
  };

  /// What is written, and what is said meanwhile.
  struct OutputParameters
  {
    /// Relative to where the program runs.
    std::string folder = "output";
    /// See Journal.
    unsigned int verbosity = 1;
    /// Files of bodies, of contact surfaces, with stresses in them, of the mapping; times of sweeps.
    bool bodies = true, surfaces = true, stress = true, mapping = false, measure_sweeps = true;
    /// Whether fields and positions keep all of their digits in the files for ParaView.
    bool double_precision = false;
    /// Files in which all ranks together write a field; 0 for one a rank.
    unsigned int most_files = 64;
    /// The page report.html; what lengths, forces and stresses are measured in, as it shall say.
    bool        report = true;
    std::string length_unit, force_unit, stress_unit;
    /// When the state is saved, and how long the run may take.
    CheckpointParameters checkpoints;

    /// Of the files for ParaView.
    FileFormat format() const
    {
      return {double_precision, most_files};
    }

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// What stands in a parameter file, from a program.
  struct ParameterText
  {
    /// The lines, and what messages call them in place of the name of a file.
    std::string text, name;
    /// Where the files are that they name.
    std::string folder;
  };

  /// A parameter file: the front end of ProblemDefinition and NestedParameters.
  class ParameterFile
  {
  public:
    /// Reads a file. overrides: "Section/Name=value". Errors: InputError with one clear message. A deck
    /// (is_deck()) is the problem itself: parameters are then those of the overrides.
    ParameterFile(const std::string &file, const std::vector<std::string> &overrides);

    /// The same without a file. Errors: InputError with one clear message.
    ParameterFile(const ParameterText &lines, const std::vector<std::string> &overrides);

    /// The defaults of a problem with such bodies and pairs.
    ParameterFile(const std::vector<std::string> &body_names, const std::vector<std::string> &pair_names);

    ParameterFile(const ParameterFile &) = delete;

    /// The deck, or null.
    const DeckProblem *deck() const
    {
      return deck_problem.get();
    }

    /// The name of the file or of the text, or empty.
    const std::string &path() const
    {
      return file;
    }

    /// Of the problem, as the file has it.
    const std::string &title() const
    {
      return top_level.title;
    }

    /// What is to be written.
    const OutputParameters &output() const
    {
      return the_output;
    }

    /// How often the cells of each body are halved before the first solve. Errors: InputError for texts that
    /// are no such number.
    std::vector<unsigned int> initial_levels() const;

    /// Collective. Reads the meshes. Errors: InputError for texts and meshes that cannot be understood.
    ProblemDefinition problem(const MPI_Comm communicator) const;

    /// Errors: InputError for texts that cannot be understood.
    NestedParameters nested() const;

    /// Times of the load steps; empty for one load. Errors: those of parse_load_steps().
    std::vector<double> load_steps() const;

    /// Prints all parameters, commented if `with_documentation`.
    void print(std::ostream &out, const bool with_documentation) const;

  private:
    struct TopLevel
    {
      std::string title, bodies, pairs, load_steps;

      void add_parameters(dealii::ParameterHandler &prm);
    };

    struct BodySection
    {
      BodyParameters body;
      LoadParameters loads;
      /// "name: (x, y, z); ...".
      std::string probes;
      /// A number, or empty for that of all bodies.
      std::string initial_levels;
      /// "(u, v, w)", or empty.
      std::string exact_displacement;

      void add_parameters(dealii::ParameterHandler &prm);
    };

    /// Collective. Errors: InputError for more cells than fit into the memory.
    void check_size(const ProblemDefinition &problem, const MPI_Comm communicator) const;

    /// The names of bodies and pairs decide which subsections exist.
    void declare(const std::vector<std::string> &body_names, const std::vector<std::string> &pair_names);

    /// Parameters from lines of a file.
    void read(const std::string &text, const std::vector<std::string> &overrides);
    void read_deck(const std::vector<std::string> &overrides);
    void declare_pairs_of_deck();

    std::string                  file, base_folder;
    std::unique_ptr<DeckProblem> deck_problem;
    /// How a deck is taken.
    bool                        deck_strict = false;
    std::string                 deck_ignore;
    TopLevel                    top_level;
    std::vector<BodySection>    bodies;
    std::vector<PairParameters> pairs;
    RefinementParameters        refinement;
    SolverParameters            solver;
    bool                        compare_linear = false;
    CoarseLevels                coarse_levels  = CoarseLevels::automatic;
    OutputParameters            the_output;
    /// Fills the members above, and remembers what was written.
    dealii::ParameterHandler prm;
  };
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_parameters_h
#define signorini_application_parameters_h

#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/refinement.h>
#include <signorini/solvers/obstacle_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Signorini
{
  /// A contact pair as a user writes it.
  struct PairParameters
  {
    std::string name;
    /// "body: boundary".
    std::string first, second;
    /// A rigid obstacle in place of the second surface (RigidObstacle), or empty.
    std::string obstacle;
    std::string contact     = "unilateral";
    std::string nonmortar   = "auto";
    std::string initial_gap = "geometry";
    std::string gap         = "weighted";
    std::string penetration = "resolve";
    std::string surface     = "automatic";
    /// Expressions that are positive where a surface may touch; empty for everywhere.
    std::string first_region, second_region;

    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Everything in a parameter file.
  struct ProblemParameters
  {
    std::string title;

    std::vector<BodyParameters> bodies;
    std::vector<LoadParameters> loads;
    /// Per body "name: (x, y, z); ...".
    std::vector<std::string> probes;
    /// Per body a known displacement (x, y, z) to compare with, or empty.
    std::vector<std::string>    exact_displacements;
    std::vector<PairParameters> pairs;
    RefinementParameters        refinement;
    SolverParameters            solver;
    bool                        compare_linear = false;

    std::string  output_folder = "output";
    unsigned int verbosity     = 2;
    bool         write_bodies = true, write_surfaces = true, write_stress = true, measure_sweeps = true;
    bool         write_mapping = false;

    /// The parameter file and the folder that file names inside it are relative to.
    std::string file, base_folder;

    /// Reads a file. overrides: "Section/Name=value". Errors: InputError with one clear message.
    void read(const std::string &file, const std::vector<std::string> &overrides);

    /// Prints all parameters, commented if `with_documentation`.
    void print(std::ostream &out, const bool with_documentation);

  private:
    void declare(dealii::ParameterHandler &prm);
  };
} // namespace Signorini

#endif

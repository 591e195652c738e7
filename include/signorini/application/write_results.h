// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_write_results_h
#define signorini_application_write_results_h

#include <signorini/application/parameters.h>
#include <signorini/output/field_output.h>
#include <signorini/output/output_folder.h>

#include <memory>

namespace Signorini
{
  class ReportSteps;

  /// "signorini 0.1.0 (deal.II 9.4.1, ...)".
  std::string version_text();

  /// Collective. What bodies.pvtu has at the relevant nodes of the space, in their order: displacement, and
  /// stress_fields() if they are wanted.
  std::vector<OutputField> body_fields(const ContactModel &model, const Discretization &discretization,
                                       const ContactSolution &solution, const bool with_stress);

  /// Collective. What contact-PAIR.pvtu has at the vertices of the nonmortar surface of a pair; right at the
  /// corners of the faces that this rank works on.
  std::vector<OutputField> nonmortar_fields(const Discretization  &discretization,
                                            const ContactSolution &solution, const unsigned int pair);

  /// Collective. The same for contact-PAIR-mortar.pvtu and the mortar surface; the pair has no obstacle.
  std::vector<OutputField> mortar_fields(const Discretization  &discretization,
                                         const ContactSolution &solution, const unsigned int pair);

  /// Collective. Writes bodies, contact surfaces and mappings for ParaView into a folder, as far as `output`
  /// wants them.
  void write_fields(const ContactModel &model, const Discretization &discretization,
                    const ContactSolution &solution, const OutputParameters &output,
                    const OutputFolder &folder, const std::string &suffix = "");

  /// Writes the fields of load steps as they come, and a list of them that ParaView opens as one.
  class StepWriter
  {
  public:
    /// The arguments must outlive the object.
    StepWriter(const ContactModel &model, const OutputParameters &output, const OutputFolder &folder,
               const std::vector<double> &times);

    /// Collective. Those of a step, by number.
    void operator()(const unsigned int step, const Discretization &discretization,
                    const ContactSolution &solution);

  private:
    const ContactModel        &model;
    const OutputParameters    &output;
    const OutputFolder        &folder;
    const std::vector<double> &times;
    /// Shared by the copies that std::function makes; null where there is no report.
    std::shared_ptr<ReportSteps> report;
  };

  /// Collective. Adds to the results what the iteration does not know: what happens to the bodies, the
  /// mappings, version, title and name of the file, ranks, memory.
  void complete_results(NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                        const bool mesh_only);

  /// Collective. Completes the results and writes everything of a solved problem (or its meshes and mapping
  /// only) into a folder, and prints the certificate.
  void write_results(NestedSolution &nested, const ContactModel &model, const ParameterFile &file,
                     const OutputFolder &folder, const bool mesh_only);
} // namespace Signorini

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/parameter_choice.h>
#include <signorini/application/parameters.h>

namespace Signorini
{
  using namespace dealii;

  void OutputParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Folder", folder, "Where the results go; --output on the command line overrides it.");
    prm.add_parameter("Verbosity", verbosity,
                      "0: errors only, 1: a line per cycle and the results in words, 2: also a line per "
                      "iteration, the table of all cycles and the whole certificate.",
                      Patterns::Integer(0, 2));
    prm.add_parameter("Bodies", bodies, "Write the bodies for ParaView (.pvtu).");
    prm.add_parameter("Contact surfaces", surfaces, "Write the contact surfaces for ParaView (.pvtu).");
    prm.add_parameter("Mapping graph", mapping,
                      "Write the overlay of each pair, the faces of the plane graph cut into triangles, for "
                      "ParaView (.vtu, one per rank).");
    prm.add_parameter("Stress", stress, "Nodal averaged stress, von Mises and principal stresses.");
    add_choice(prm, "Precision", double_precision, {{false, "single"}, {true, "double"}},
               "Of fields and positions in the files for ParaView. double: 16 digits, for programs that "
               "compute with them; the files are about twice as large.");
    prm.add_parameter(
        "Measure sweeps", measure_sweeps,
        "Time Gauss-Seidel sweeps and a plain read of memory on the finest level (costs some ten sweeps).");
    prm.add_parameter("Most files", most_files,
                      "Files (.vtu) into which bodies and contact surfaces are divided: where there are more "
                      "ranks, neighbours write one together. 0: one file a rank.",
                      Patterns::Integer(0, 1000000));
    prm.add_parameter("Report", report,
                      "Write report.html, a page for a browser with verdict, numbers and turnable pictures.");
    prm.add_parameter("Length unit", length_unit,
                      "What lengths of the input are measured in, for the report only, e.g. mm: it stands "
                      "behind its numbers, nothing is converted.");
    prm.add_parameter("Force unit", force_unit, "The same for forces, e.g. N.");
    prm.add_parameter("Stress unit", stress_unit, "The same for moduli, stresses and pressures, e.g. MPa.");
    add_choice(
        prm, "Checkpoint", checkpoints.times,
        {{CheckpointTimes::automatic, "automatic"},
         {CheckpointTimes::always, "always"},
         {CheckpointTimes::never, "never"}},
        "Save the state beside the output folder after cycles and load steps; --resume goes on from it, "
        "on any number of ranks. automatic: after those that make it cost less than 2 % of the time.");
    prm.declare_entry(
        "Wall time limit", "", Patterns::Anything(),
        "Seconds, minutes:seconds or hours:minutes:seconds that the process may take: a run that "
        "would take longer ends before the next cycle or load step, with a checkpoint and exit "
        "code 4. Empty for no limit.");
    prm.add_action("Wall time limit", [this](const std::string &text) {
      checkpoints.wall_time_limit = parse_duration(text, "Output/Wall time limit");
    });
  }
} // namespace Signorini

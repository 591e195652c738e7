// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_paraview_files_h
#define signorini_application_paraview_files_h

#include <signorini/application/contact_solve.h>
#include <signorini/application/parameters.h>
#include <signorini/output/vtu_file.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// What ParaView shows as one block of a collection.
  struct ParaviewBlock
  {
    /// In words; the .pvtu file without suffix of the step and ending.
    std::string name, file;
  };

  /// Names of the files of a pair, without suffix of the step and ending.
  struct PairFiles
  {
    std::string nonmortar, mortar, mapping;
  };

  /// By body: the name of its file, each another one.
  std::vector<std::string> body_files(const Bodies &bodies);

  /// By pair: the names of its files, each another one.
  std::vector<PairFiles> pair_files(const std::vector<ContactPair> &pairs);

  /// All bodies and contact surfaces that are written.
  std::vector<ParaviewBlock> paraview_blocks(const Bodies &bodies, const Discretization &discretization,
                                             const OutputParameters &output);

  /// Numbers of the relevant nodes in this run, and in the mesh file if there is one.
  std::vector<OutputField> node_numbers(const Bodies &bodies, const NodalSpace &space);

  /// Collective. The same by vertex of a contact surface; right at the corners of the faces that this rank
  /// works on.
  std::vector<OutputField> node_numbers(const Bodies &bodies, const Discretization &discretization,
                                        const ContactSurface &surface);

  /// By cell: number of the body, level, and the indicator of the error if there is one.
  /// @param indicator squares (energy)
  std::vector<OutputField> cell_fields(const Bodies &bodies, const NodalSpace &space,
                                       const std::vector<double> &indicator);
} // namespace Signorini

#endif

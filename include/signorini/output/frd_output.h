// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_frd_output_h
#define signorini_output_frd_output_h

#include <deal.II/base/point.h>

#include <ostream>
#include <string>
#include <vector>

namespace Signorini
{
  /// An element as an input file of CalculiX has it: 4, 6, 8, 10, 15 or 20 nodes.
  struct FrdElement
  {
    /// Its number.
    long label;
    /// Numbers of its nodes, in the order of the input file.
    std::vector<long> nodes;
  };

  /// A mesh for CalculiX' and FreeCAD's viewers.
  struct FrdMesh
  {
    /// Of the nodes: numbers and positions (length).
    std::vector<long>             labels;
    std::vector<dealii::Point<3>> positions;
    std::vector<FrdElement>       elements;
  };

  /// Values at some of its nodes.
  struct FrdField
  {
    /// As the viewers know it: DISP (3 components), STRESS (6: xx, yy, zz, xy, yz, zx), CONTACT (6: opening,
    /// two slips, pressure, two shears).
    std::string name;
    /// Numbers of the nodes, and values, component after component for each.
    std::vector<long>   labels;
    std::vector<double> values;
  };

  /// Writes a result file of CalculiX (.frd, as text, cgx 2.20: "Result Format").
  /// @param time of the step
  void write_frd(std::ostream &out, const FrdMesh &mesh, const std::vector<FrdField> &fields,
                 const double time);
} // namespace Signorini

#endif

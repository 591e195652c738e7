// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/cell_shape.h>

namespace Signorini
{
  namespace
  {
    struct LockingRule
    {
      /// Hexahedra with a Poisson ratio above this get mean dilatation. Two shells
      /// (tests/application/shells.prm), 11,718 unknowns, errors in L2 with displacements alone: 0.62,
      /// 0.85, 1.28, 4.4 and 30 % at the ratios 0.3, 0.4, 0.45, 0.49 and 0.499; with mean dilatation 0.46 to
      /// 0.48 % at all of them, with as many iterations or fewer. The gain grows without bound above 0.4 and
      /// is small below, where the plain element is what everybody has and knows.
      double hexahedra = .4;
      /// Tetrahedra above this get a note, which has the figures.
      double tetrahedra = .45;
    };

    constexpr LockingRule locking_rule;
  } // namespace



  void Bodies::choose_elements(const BodyDefinition &definition, const Placed &placed)
  {
    const bool tetrahedra = placed.mesh.cells[0].n_vertices == CellShape::tetrahedron;
    if (tetrahedra && definition.element == ElementChoice::mean_dilatation)
      throw InputError(
          "Body " + definition.name +
          "/Element: mean dilatation is for hexahedra; in a linear tetrahedron the change of volume "
          "is constant anyway. Choose automatic, or Convert to hexahedra.");
    double largest = 0.;
    for (const VolumeMesh::Cell &cell : placed.mesh.cells)
      {
        Material &material = materials[placed.material_of_volume[cell.volume]];
        largest            = std::max(largest, material.poisson);
        material.mean_dilatation =
            !tetrahedra &&
            (definition.element == ElementChoice::mean_dilatation ||
             (definition.element == ElementChoice::automatic && material.poisson > locking_rule.hexahedra));
      }
    if (tetrahedra && largest > locking_rule.tetrahedra)
      {
        std::ostringstream text;
        text << "body " << definition.name << ": linear tetrahedra are too stiff where Poisson's ratio (here "
             << largest
             << ") is near 0.5. A shell under pressure on a mesh of gmsh (2,040 unknowns): displacements are "
                "4.5 % "
                "off at 0.3, 10 % at 0.45, 25 % at 0.49, 65 % at 0.499, contact pressures more. With "
                "\"Convert to "
                "hexahedra\" they are 1.7 % off at all of these.";
        remarks.push_back(text.str());
      }
  }
} // namespace Signorini

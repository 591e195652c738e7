// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_material_h
#define signorini_mesh_material_h

#include <string>

namespace Signorini
{
  /// Isotropic linear elasticity: the one place that turns Young's modulus E (force per area) and Poisson's
  /// ratio ν into what others need.
  struct IsotropicMaterial
  {
    /// E and ν.
    double young = 1., poisson = .3;

    /// Lamé's first constant (force per area).
    double lambda() const
    {
      return young * poisson / ((1. + poisson) * (1. - 2. * poisson));
    }

    /// The shear modulus (force per area).
    double mu() const
    {
      return .5 * young / (1. + poisson);
    }

    /// Pressure over change of volume (force per area).
    double bulk_modulus() const
    {
      return young / (3. * (1. - 2. * poisson));
    }

    /// (1 - ν²)/E: what a body adds to the approach in Hertz' contact.
    double contact_compliance() const
    {
      return (1. - poisson * poisson) / young;
    }
  };

  /// Errors: InputError that begins with `where` unless E > 0 and -1 < ν < 0.5; `of_what` follows the name of
  /// the parameter.
  void check_material(const IsotropicMaterial &material, const std::string &where,
                      const std::string &of_what = "");

  /// The material of some cells of a body.
  struct Material : IsotropicMaterial
  {
    /// Number of the body.
    unsigned int body = 0;
    /// Whether hexahedra have the mean change of volume of the cell everywhere in it (B-bar).
    bool mean_dilatation = false;
    /// The part of the body (Bodies::part()).
    unsigned int part = 0;
    /// The volume of the mesh of the body (Bodies::material_ids()).
    unsigned int volume = 0;
  };
} // namespace Signorini

#endif

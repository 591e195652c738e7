// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/material.h>

#include <cmath>
#include <sstream>

namespace Signorini
{
  void check_material(const IsotropicMaterial &material, const std::string &where, const std::string &of_what)
  {
    const auto refuse = [&](const char *name, const double value, const char *rule) {
      std::ostringstream text;
      text << where << name << of_what << ": " << value << " is not allowed; it must " << rule;
      throw InputError(text.str());
    };
    if (!(material.young > 0.) || !std::isfinite(material.young))
      refuse("Young modulus", material.young, "be positive.");
    // Energies are squares of lengths times it.
    if (!(material.young > 1e-60 && material.young < 1e60))
      refuse("Young modulus", material.young, "lie between 1e-60 and 1e60: choose another unit.");
    if (!(material.poisson > -1. && material.poisson < .5))
      refuse("Poisson ratio", material.poisson, "lie between -1 and 0.5 (0.5 would be incompressible).");
  }
} // namespace Signorini

// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Strains without stress: of temperatures, initial ones, and those of pretension.

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/utilities.h>

#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct EigenstrainRule
    {
      /// Larger entries are no small strains: 12 instead of 12e-6 as a coefficient of expansion.
      double largest = .5;
    };

    bool is_given(const std::string &text)
    {
      return !Utilities::trim(text).empty();
    }

    /// "(exx, eyy, ezz, exy, eyz, ezx)".
    StrainField parse_strain(const std::string &text, const std::string &where)
    {
      const std::string trimmed = Utilities::trim(text);
      const bool        framed  = trimmed.size() > 2 && trimmed.front() == '(' && trimmed.back() == ')';
      const auto        entries = split_list(framed ? trimmed.substr(1, trimmed.size() - 2) : "", ',', where);
      if (entries.size() != 6)
        throw InputError(where + ": \"" + trimmed +
                         "\" should have six entries in parentheses: (exx, eyy, ezz, exy, eyz, ezx).");
      std::array<Expression, 6> components;
      for (unsigned int c = 0; c < 6; ++c)
        components[c] = Expression(entries[c], where);
      return [components](const Point<3> &p, const double time) {
        Block strain;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const unsigned int next = (c + 1) % 3;
            strain[c][c]            = components[c](p, time);
            strain[c][next] = strain[next][c] = components[3 + c](p, time);
          }
        return strain;
      };
    }

    LoadDefinition::Pretension parse_pretension(const std::string &name, const std::string &text,
                                                const std::string &where)
    {
      LoadDefinition::Pretension result{name, {}, {}};
      std::set<std::string>      seen;
      for (const std::string &piece : split_list(text, ',', where))
        {
          const std::size_t end   = piece.find_first_of(" (");
          const std::string word  = piece.substr(0, end),
                            value = end == std::string::npos ? "" : Utilities::trim(piece.substr(end));
          if (!seen.insert(word).second)
            throw InputError(where + ": \"" + word + "\" is there twice.");
          if (word == "axis")
            result.axis = parse_point(value, where);
          else if (word == "force")
            result.force = Expression(value, where);
          else if (word == "region")
            {
              refuse_time(value, where);
              result.region = Expression(value, where);
            }
          else if (word == "locked" && value.compare(0, 6, "after ") == 0)
            result.locked_after = parse_number(Utilities::trim(value.substr(6)), where);
          else
            throw InputError(where + ": \"" + piece +
                             "\" should begin with axis, force, region or locked after.");
        }
      if (seen.count("axis") == 0 || seen.count("force") == 0)
        throw InputError(where + ": \"" + text + "\" should read \"axis (x, y, z), force F\".");
      return result;
    }
  } // namespace



  void LoadParameters::parse_initial_strains(LoadDefinition &result, const std::string &section) const
  {
    LoadDefinition::InitialStrain body;
    if (is_given(temperature))
      body.temperature = Expression(temperature, section + "Temperature");
    if (is_given(expansion))
      body.expansion = parse_number(expansion, section + "Thermal expansion");
    if (is_given(initial_strain))
      body.strain = parse_strain(initial_strain, section + "Initial strain");
    if (body.temperature || body.expansion || body.strain)
      result.initial_strains.push_back(body);
    const auto of_volume = [&](const std::string &name) -> LoadDefinition::InitialStrain & {
      result.initial_strains.push_back({name});
      return result.initial_strains.back();
    };
    for (const auto &[name, text] : split_named_entries(volume_temperatures, section + "Volume temperatures"))
      of_volume(name).temperature = Expression(text, section + "Volume temperatures, \"" + name + "\"");
    for (const auto &[name, text] :
         split_named_entries(volume_expansions, section + "Volume thermal expansions"))
      of_volume(name).expansion = parse_number(text, section + "Volume thermal expansions, \"" + name + "\"");
    for (const auto &[name, text] :
         split_named_entries(volume_initial_strains, section + "Volume initial strains"))
      of_volume(name).strain = parse_strain(text, section + "Volume initial strains, \"" + name + "\"");
    const auto &all = result.initial_strains;
    if (std::any_of(all.begin(), all.end(), [](const auto &entry) { return bool(entry.temperature); }) &&
        std::none_of(all.begin(), all.end(), [](const auto &entry) { return entry.expansion.has_value(); }))
      throw InputError(section + "Temperature: it does nothing without a Thermal expansion.");
  }



  void LoadParameters::parse_pretensions(LoadDefinition &result, const std::string &section) const
  {
    for (const auto &[name, text] : split_named_entries(pretension, section + "Pretension"))
      result.pretensions.push_back(parse_pretension(name, text, section + "Pretension, \"" + name + "\""));
  }



  void Loads::add_initial_strains(const Bodies &bodies, const unsigned int body,
                                  const LoadDefinition &definition)
  {
    const std::string section = "Body " + bodies.body_name(body) + "/";
    if (!definition.initial_strains.empty())
      eigenstrains.resize(bodies.n_materials());
    for (const LoadDefinition::InitialStrain &initial : definition.initial_strains)
      {
        const std::string where = section + (initial.temperature ? "Volume temperatures"
                                             : initial.expansion ? "Volume thermal expansions"
                                                                 : "Volume initial strains");
        if (initial.expansion && !std::isfinite(*initial.expansion))
          throw InputError(where + ": the coefficient is not a finite number.");
        for (const types::material_id id : bodies.material_ids(body, initial.volume, where))
          {
            Eigenstrain &strain = eigenstrains[id];
            if (initial.temperature)
              strain.temperature = initial.temperature;
            if (initial.expansion)
              strain.expansion = *initial.expansion;
            if (initial.strain)
              strain.strain = initial.strain;
          }
      }
  }



  void Loads::add_pretensions(const Bodies &bodies, const unsigned int body, const LoadDefinition &definition)
  {
    for (const LoadDefinition::Pretension &bolt : definition.pretensions)
      {
        const std::string where = "Body " + bodies.body_name(body) + "/Pretension, \"" + bolt.name + "\"";
        if (!(bolt.axis.norm() > 0.) || !std::isfinite(bolt.axis.norm()))
          throw InputError(where + ": the axis must not be zero.");
        if (!bolt.force)
          throw InputError(where + ": there is no force.");
        if (!(bolt.locked_after > 0.))
          throw InputError(where + ": the time after which it is locked should be positive.");
        const bool has_region = static_cast<bool>(bolt.region);
        pretensions.push_back({where, body, bolt.name,
                               bodies.material_ids(body, has_region ? "" : bolt.name, where), bolt.region,
                               bolt.axis / bolt.axis.norm(), bolt.force, bolt.locked_after});
      }
  }



  bool is_in(const Pretension &pretension, const NodalSpace &space, const NodalSpace::Cell &cell)
  {
    return pretension.materials.count(cell.material) > 0 &&
           (!pretension.region || pretension.region(Element(space, cell).centre()) > 0.);
  }



  CellEigenstrain Loads::eigenstrain(const NodalSpace &space, const NodalSpace::Cell &cell) const
  {
    CellEigenstrain    result;
    const Eigenstrain *own = cell.material < eigenstrains.size() ? &eigenstrains[cell.material] : nullptr;
    const bool         is_heated = own != nullptr && own->temperature && own->expansion != 0.;
    if (own != nullptr && (is_heated || own->strain))
      {
        result.is_zero = false;
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          {
            Block          &strain = result.at_vertices[v];
            const Point<3> &place  = space.position(space.nodes(cell)[v]);
            if (own->strain)
              strain = symmetrize(own->strain(place, time));
            for (unsigned int c = 0; c < dim && is_heated; ++c)
              strain[c][c] += own->expansion * own->temperature(place, time);
            for (unsigned int c = 0; c < dim * dim; ++c)
              if (!(std::abs(strain[c / dim][c % dim]) < EigenstrainRule().largest))
                {
                  std::ostringstream text;
                  text << "Thermal expansion, Initial strain: at (" << place << ") the strain is "
                       << strain[c / dim][c % dim]
                       << ", which is no small one. Look at the units of temperature and expansion.";
                  throw InputError(text.str());
                }
          }
      }
    for (const Pretension &bolt : pretensions)
      if (bolt.strain != 0. && is_in(bolt, space, cell))
        {
          result.is_zero = false;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            result.at_vertices[v] -= bolt.strain * outer_product(bolt.axis, bolt.axis);
        }
    return result;
  }
} // namespace Signorini

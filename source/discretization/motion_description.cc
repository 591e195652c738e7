// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/motion_description.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Of a direction, of the size of a body: axes that facets show are no more exact.
    constexpr double not_shown = 1e-4;

    std::string print_vector(const Vector3 &v, const double zero)
    {
      std::ostringstream text;
      text.precision(3);
      for (unsigned int c = 0; c < dim; ++c)
        text << (c > 0 ? ", " : "(") << (std::abs(v[c]) > zero ? v[c] : 0.);
      return text.str() + ")";
    }

    std::string print_direction(const Vector3 &v)
    {
      return print_vector(v / v.norm(), not_shown);
    }
  } // namespace



  std::string name_of_moving(const FreeMotion &motion, const Bodies &bodies)
  {
    constexpr std::size_t most = 3;
    std::string           name = bodies.part_name(motion.first_part());
    for (std::size_t i = 1; i < std::min(motion.parts.size(), most + 1); ++i)
      name += (i == 1 ? " (tied to " : ", ") + bodies.part_name(motion.parts[i]);
    if (motion.parts.size() > most + 1)
      name += " and " + std::to_string(motion.parts.size() - most - 1) + " more";
    return name + (motion.parts.size() > 1 ? ")" : "");
  }



  namespace
  {
    /// What a motion does to one part: translation + rotation x (x - centre) / length.
    FreeMotion motion_of_part(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                              const unsigned int part)
    {
      FreeMotion result{{part}, {}, Point<3>(), 0., Vector3(), Vector3()};
      for (std::size_t m = 0; m < motions.size(); ++m)
        if (motions[m].first_part() == part)
          {
            result.parts = motions[m].parts;
            result.translation += coefficients[m] * motions[m].translation;
            result.rotation += coefficients[m] * motions[m].rotation;
            result.centre = motions[m].centre;
            result.length = motions[m].length;
          }
      return result;
    }

    /// What is left of a translation or a rotation beside one this much larger is rounding.
    constexpr double negligible = 1e-3;

    /// A part that turns by no more than this share of its translation is said to move: the axis lies twenty
    /// of its sizes away.
    constexpr double little_turn = .05;

    /// The translation along the axis of the rotation.
    Vector3 along_axis(const FreeMotion &motion)
    {
      return (motion.rotation * motion.translation) / motion.rotation.norm_square() * motion.rotation;
    }
  } // namespace



  bool is_rotation(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients)
  {
    std::set<unsigned int> parts;
    for (const FreeMotion &motion : motions)
      parts.insert(motion.first_part());
    double largest = 0.;
    for (const unsigned int part : parts)
      largest = std::max(largest, motion_of_part(motions, coefficients, part).rotation.norm());
    return std::all_of(parts.begin(), parts.end(), [&](const unsigned int part) {
      const FreeMotion motion = motion_of_part(motions, coefficients, part);
      if (motion.rotation.norm() <= negligible * largest)
        return motion.translation.norm() <= negligible * largest;
      return along_axis(motion).norm() <= negligible * motion.rotation.norm();
    });
  }



  bool is_translation(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients)
  {
    double turned = 0., moved = 0.;
    for (const FreeMotion &one : motions)
      {
        const FreeMotion motion = motion_of_part(motions, coefficients, one.first_part());
        turned                  = std::max(turned, motion.rotation.norm());
        moved                   = std::max(moved, motion.translation.norm());
      }
    return turned <= negligible * moved;
  }



  namespace
  {
    /// What the part that moves most does.
    struct PartMotion
    {
      FreeMotion motion;
      bool       is_translation;
      /// No other part moves.
      bool is_alone;

      /// Whether it turns the part about an axis without moving it along.
      bool is_pure_rotation() const
      {
        return !is_translation && along_axis(motion).norm() <= negligible * motion.rotation.norm();
      }

      /// Whether it moves the part much more than it turns it.
      bool is_mostly_translation() const
      {
        return motion.rotation.norm() <= little_turn * motion.translation.norm();
      }

      /// On the axis of a rotation.
      Point<3> point() const
      {
        return motion.centre + motion.length / motion.rotation.norm_square() *
                                   cross_product_3d(motion.rotation, motion.translation);
      }
    };

    PartMotion largest_part(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                            const Bodies &bodies)
    {
      std::vector<double> size(bodies.n_parts(), 0.);
      for (std::size_t m = 0; m < motions.size(); ++m)
        size[motions[m].first_part()] += coefficients[m] * coefficients[m];
      const auto       largest = std::max_element(size.begin(), size.end());
      const double     all     = std::accumulate(size.begin(), size.end(), 0.);
      const FreeMotion motion =
          motion_of_part(motions, coefficients, static_cast<unsigned int>(largest - size.begin()));
      return {motion, motion.rotation.norm() <= negligible * motion.translation.norm(),
              all - *largest <= negligible * negligible * all};
    }

    /// The same motion the other way where that is the usual one to say: the largest component of its
    /// direction, or the first of those, is positive.
    PartMotion oriented(PartMotion part)
    {
      Vector3 &direction = part.is_mostly_translation() ? part.motion.translation : part.motion.rotation;
      double   largest   = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        if (std::abs(direction[c]) > (1. + negligible) * std::abs(largest))
          largest = direction[c];
      if (largest < 0.)
        {
          part.motion.translation *= -1.;
          part.motion.rotation *= -1.;
        }
      return part;
    }

    std::string print_axis_point(const PartMotion &part)
    {
      return print_vector(part.point(), not_shown * part.motion.length);
    }

    std::string describe(const PartMotion &part)
    {
      const Vector3 &rotation = part.motion.rotation;
      if (part.is_mostly_translation())
        return "translation " + print_direction(part.motion.translation) +
               (part.is_translation ? "" : ", turning a little about " + print_direction(rotation));
      const std::string turning =
          "rotation about the axis through " + print_axis_point(part) + " along " + print_direction(rotation);
      return part.is_pure_rotation()
                 ? turning
                 : "translation " + print_direction(along_axis(part.motion)) + " with " + turning;
    }

    /// Of one kind and one part, which can be said together.
    std::string describe_together(const std::vector<PartMotion> &group)
    {
      if (!group[0].is_translation)
        return "rotation about any axis through " + print_axis_point(group[0]);
      if (group.size() == dim)
        return "translation in any direction";
      PartMotion normal         = group[0];
      normal.motion.translation = cross_product_3d(group[0].motion.translation, group[1].motion.translation);
      return "translation in any direction normal to " + print_direction(oriented(normal).motion.translation);
    }

    bool can_be_said_together(const std::vector<PartMotion> &group)
    {
      if (group[0].is_translation)
        return group.size() > 1;
      return group.size() == dim && std::all_of(group.begin(), group.end(), [&](const PartMotion &part) {
               return part.point().distance(group[0].point()) <= negligible * part.motion.length;
             });
    }
  } // namespace



  std::string describe_motion(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                              const Bodies &bodies)
  {
    const PartMotion part = oriented(largest_part(motions, coefficients, bodies));
    return name_of_moving(part.motion, bodies) + ", " + describe(part);
  }



  namespace
  {
    /// Whether a part moves as another one does, as if both were one rigid body.
    bool moves_along(const FreeMotion &part, const FreeMotion &other)
    {
      const Vector3 turn  = part.rotation / part.length - other.rotation / other.length;
      const Vector3 shift = part(other.centre) - other.translation;
      return std::max(shift.norm(), other.length * turn.norm()) <=
             little_turn * std::max(other.translation.norm(), other.rotation.norm());
    }

    /// "a", "a and b", "a, b and c".
    std::string list(const std::vector<std::string> &names)
    {
      constexpr std::size_t most = 8;
      const std::size_t     n    = std::min(names.size(), most);
      std::string           text;
      for (std::size_t i = 0; i < n; ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
      return text + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
    }
  } // namespace



  std::string describe_flight(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                              const Bodies &bodies)
  {
    const PartMotion       largest = largest_part(motions, coefficients, bodies);
    const double           size = std::max(largest.motion.translation.norm(), largest.motion.rotation.norm());
    std::set<unsigned int> parts;
    for (const FreeMotion &motion : motions)
      parts.insert(motion.first_part());
    std::vector<std::string> along, too;
    for (const unsigned int part : parts)
      {
        const FreeMotion one = motion_of_part(motions, coefficients, part);
        if (moves_along(one, largest.motion))
          along.push_back(name_of_moving(one, bodies));
        else if (std::max(one.translation.norm(), one.rotation.norm()) > little_turn * size)
          too.push_back(name_of_moving(one, bodies));
      }
    return list(along) + ", " + describe(largest) +
           (too.empty() ? "" : " (" + list(too) + (too.size() > 1 ? " move, too)" : " moves, too)"));
  }



  FlightLoad load_of_flight(const std::vector<FreeMotion> &motions, const std::vector<double> &coefficients,
                            const double work, const Bodies &bodies)
  {
    const PartMotion largest = largest_part(motions, coefficients, bodies);
    const double     turn = largest.motion.rotation.norm(), shift = largest.motion.translation.norm();
    if (largest.is_mostly_translation())
      return {work / shift, 0.};
    return {0., work / turn * largest.motion.length};
  }



  std::vector<std::string> describe_motions(const std::vector<FreeMotion>          &motions,
                                            const std::vector<std::vector<double>> &basis,
                                            const Bodies                           &bodies)
  {
    std::vector<std::string> result;
    // Of a part, translations and rotations.
    std::map<std::pair<unsigned int, bool>, std::vector<PartMotion>> groups;
    for (const std::vector<double> &coefficients : basis)
      if (const PartMotion part = oriented(largest_part(motions, coefficients, bodies));
          part.is_alone && (part.is_translation || part.is_pure_rotation()))
        groups[{part.motion.first_part(), part.is_translation}].push_back(part);
      else
        result.push_back(describe_motion(motions, coefficients, bodies));
    for (const auto &[key, group] : groups)
      {
        const std::string name = name_of_moving(group[0].motion, bodies) + ", ";
        if (can_be_said_together(group))
          result.push_back(name + describe_together(group));
        else
          for (const PartMotion &part : group)
            result.push_back(name + describe(part));
      }
    return result;
  }
} // namespace Signorini

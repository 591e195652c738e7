// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/common_polygon.h>

namespace Signorini
{
  namespace
  {
    bool before(const CommonPolygon::Position &a, const CommonPolygon::Position &b)
    {
      return a.feature != b.feature ? a.feature < b.feature : a.along < b.along;
    }

    double turn(const std::array<double, 2> &a, const std::array<double, 2> &b,
                const std::array<double, 2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    bool lies_on_both(const CommonPolygon::Corner &corner)
    {
      return corner.nonmortar.feature >= 0 && corner.mortar.feature >= 0;
    }
  } // namespace



  void CommonPolygon::collect(const std::vector<Corner> &corners)
  {
    on_nonmortar.clear();
    on_mortar.clear();
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        if (corners[i].nonmortar.feature >= 0)
          on_nonmortar.push_back(i);
        if (corners[i].mortar.feature >= 0)
          on_mortar.push_back(i);
      }
    std::sort(on_nonmortar.begin(), on_nonmortar.end(), [&](const unsigned int a, const unsigned int b) {
      return before(corners[a].nonmortar, corners[b].nonmortar);
    });
    std::sort(on_mortar.begin(), on_mortar.end(), [&](const unsigned int a, const unsigned int b) {
      return before(corners[a].mortar, corners[b].mortar);
    });
  }



  // The border of the polygon runs along the one triangle, then along the other, and changes where a corner
  // lies on both. Corners on both come in the order in which the border of the mortar triangle meets them;
  // whatever else lies between two of them on either border belongs there.
  void CommonPolygon::follow_both(const std::vector<Corner> &corners)
  {
    const auto is_both = [&](const unsigned int i) { return lies_on_both(corners[i]); };
    const auto first   = std::find_if(on_mortar.begin(), on_mortar.end(), is_both);
    std::rotate(on_mortar.begin(), first, on_mortar.end());
    for (const unsigned int i : on_mortar)
      {
        sorted.push_back(corners[i]);
        if (!is_both(i))
          continue;
        auto it = std::find(on_nonmortar.begin(), on_nonmortar.end(), i);
        for (;;)
          {
            if (++it == on_nonmortar.end())
              it = on_nonmortar.begin();
            if (is_both(*it))
              break;
            sorted.push_back(corners[*it]);
          }
      }
  }



  bool CommonPolygon::sort(std::vector<Corner> &corners)
  {
    collect(corners);
    sorted.clear();
    if (std::any_of(corners.begin(), corners.end(), lies_on_both))
      follow_both(corners);
    else
      {
        if (!on_nonmortar.empty() && !on_mortar.empty())
          return false;
        for (const unsigned int i : on_mortar.empty() ? on_nonmortar : on_mortar)
          sorted.push_back(corners[i]);
      }
    std::swap(corners, sorted);
    return true;
  }



  namespace
  {
    using Corners   = std::vector<std::array<double, 2>>;
    using Triangles = std::vector<std::array<unsigned int, 3>>;

    /// A fan from the first corner that sees all others: any corner of a convex polygon.
    /// @param sign of the area
    bool cut_as_fan(Triangles &triangles, const Corners &x, const double sign)
    {
      const auto n = static_cast<unsigned int>(x.size());
      for (unsigned int apex = 0; apex < n; ++apex)
        {
          bool sees_all = true;
          for (unsigned int i = 1; i + 1 < n && sees_all; ++i)
            sees_all = sign * turn(x[apex], x[(apex + i) % n], x[(apex + i + 1) % n]) >= -1e-15;
          if (sees_all)
            {
              for (unsigned int i = 1; i + 1 < n; ++i)
                triangles.push_back({{apex, (apex + i) % n, (apex + i + 1) % n}});
              return true;
            }
        }
      return false;
    }



    /// Area of the ear at a corner of what is left, times two; negative if it contains another corner.
    double ear_size(const Corners &x, const std::vector<unsigned int> &rest, const std::size_t i,
                    const double sign)
    {
      const std::size_t m = rest.size();
      const auto       &a = x[rest[(i + m - 1) % m]], &b = x[rest[i]], &c = x[rest[(i + 1) % m]];
      double            size = sign * turn(a, b, c);
      for (std::size_t j = 0; j < m && size > 0.; ++j)
        if (j != i && j != (i + 1) % m && j != (i + m - 1) % m)
          {
            const auto &p = x[rest[j]];
            if (sign * turn(a, b, p) > 0. && sign * turn(b, c, p) > 0. && sign * turn(c, a, p) > 0.)
              size = -size;
          }
      return size;
    }



    std::size_t largest_ear(const Corners &x, const std::vector<unsigned int> &rest, const double sign)
    {
      std::size_t best    = 0;
      double      largest = -std::numeric_limits<double>::max();
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (const double size = ear_size(x, rest, i, sign); size > largest)
          {
            largest = size;
            best    = i;
          }
      return best;
    }
  } // namespace



  void triangulate_polygon(std::vector<std::array<unsigned int, 3>> &triangles,
                           const std::vector<std::array<double, 2>> &x)
  {
    const auto n = static_cast<unsigned int>(x.size());
    if (n < 3)
      return;
    double area = 0.;
    for (unsigned int i = 1; i + 1 < n; ++i)
      area += turn(x[0], x[i], x[i + 1]);
    const double sign = area < 0. ? -1. : 1.;

    if (cut_as_fan(triangles, x, sign))
      return;

    // Else cut off ears, the one with the largest area first; a triangle that contains a corner is no ear.
    std::vector<unsigned int> rest(n);
    std::iota(rest.begin(), rest.end(), 0u);
    while (rest.size() > 3)
      {
        const std::size_t m = rest.size(), best = largest_ear(x, rest, sign);
        triangles.push_back({{rest[(best + m - 1) % m], rest[best], rest[(best + 1) % m]}});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
      }
    triangles.push_back({{rest[0], rest[1], rest[2]}});
  }
} // namespace Signorini

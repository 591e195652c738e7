// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// dune-grid-glue's ContactMerge on two OFF files: prints seconds and the covered part of the first surface.

#include "off_file.h"

#include <dune/common/parallel/mpihelper.hh>
#include <dune/geometry/type.hh>
#include <dune/grid-glue/merging/contactmerge.hh>

#include <chrono>

namespace
{
  /// build() is protected there.
  struct Merge : Dune::GridGlue::ContactMerge<3, double>
  {
    using Base = Dune::GridGlue::ContactMerge<3, double>;
    using Base::Base;
    using Base::build;
  };
} // namespace



int
main(int argc, char **argv)
{
  Dune::MPIHelper::instance(argc, argv);
  const OffFile non(argv[1]), mor(argv[2]);
  // Penetrating surfaces need an allowance.
  const double overlap = argc > 3 ? std::atof(argv[3]) : 0.;

  const auto convert = [](const OffFile &file, std::vector<Dune::FieldVector<double, 3>> &x,
                          std::vector<unsigned int> &t, std::vector<Dune::GeometryType> &types) {
    for (const auto &p : file.points)
      x.push_back({p[0], p[1], p[2]});
    for (const auto &triangle : file.triangles)
      t.insert(t.end(), triangle.begin(), triangle.end());
    types.assign(file.triangles.size(), Dune::GeometryTypes::simplex(2));
  };
  std::vector<Dune::FieldVector<double, 3>> x1, x2;
  std::vector<unsigned int>                 t1, t2;
  std::vector<Dune::GeometryType>           types1, types2;
  convert(non, x1, t1, types1);
  convert(mor, x2, t2, types2);

  Merge      merge(overlap);
  const auto start = std::chrono::steady_clock::now();
  merge.build(x1, t1, types1, x2, t2, types2);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  double     covered = 0.;
  const auto list    = merge.intersectionList();
  for (unsigned int i = 0; i < list->size(); ++i)
    {
      const auto a = list->template corner<0>(i, 0), b = list->template corner<0>(i, 1),
                 c = list->template corner<0>(i, 2);
      covered += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) *
                 non.area(list->template parent<0>(i));
    }
  std::cout.precision(15);
  std::cout << seconds << ' ' << covered / non.area() << ' ' << list->size() << std::endl;
  return 0;
}

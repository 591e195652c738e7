// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The contact mapping on two wavy surfaces of n triangles each, and of n and n/100.

#include <signorini/surface/contact_mapping.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace
{
  using namespace Signorini;

  SurfaceMesh wave(const unsigned int n_triangles, const double size, const double height, const bool up,
                   const unsigned int seed)
  {
    const unsigned int n = std::max(1u, static_cast<unsigned int>(std::sqrt(n_triangles / 2.)));
    std::mt19937       random(seed);
    std::uniform_real_distribution<double> noise(-.2, .2);
    SurfaceMesh                            mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const bool   inner = i > 0 && i < n && j > 0 && j < n;
          const double x     = .5 + size * ((i + (inner ? noise(random) : 0.)) / n - .5),
                       y     = .5 + size * ((j + (inner ? noise(random) : 0.)) / n - .5);
          mesh.vertices.emplace_back(x, y, height + .08 * std::sin(12.566 * x) * std::cos(9.425 * y));
        }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = j * (n + 1) + i;
          mesh.triangles.push_back({{a, a + 1, a + n + 2}});
          mesh.triangles.push_back({{a, a + n + 2, a + n + 1}});
        }
    if (!up)
      for (auto &t : mesh.triangles)
        std::swap(t[1], t[2]);
    mesh.compute_vertex_normals();
    return mesh;
  }

  void map(benchmark::State &state, const unsigned int ratio)
  {
    const auto        n   = static_cast<unsigned int>(state.range(0));
    const SurfaceMesh non = wave(n, 1., 0., true, 1), mor = wave(n / ratio, .9, .02, false, 2);
    std::size_t       cells = 0;
    for (auto _ : state)
      {
        const ContactMapping mapping(non, mor);
        cells += mapping.report().n_cells;
      }
    state.SetComplexityN(n);
    state.counters["cells/s"] = benchmark::Counter(static_cast<double>(cells), benchmark::Counter::kIsRate);
  }

  // What one of `n_parts` slabs costs: what every rank still does for the whole shows.
  void map_part(benchmark::State &state)
  {
    const auto        n_parts = static_cast<double>(state.range(0));
    const SurfaceMesh non = wave(1000000, 1., 0., true, 1), mor = wave(1000000, .9, .02, false, 2);
    for (auto _ : state)
      {
        const ContactMapping mapping(non, mor, [&](const unsigned int t) {
          return std::abs(non.vertices[non.triangles[t][0]][0] - .5) < .5 / n_parts;
        });
        benchmark::DoNotOptimize(mapping.n_polygons());
      }
  }
} // namespace

BENCHMARK(map_part)->RangeMultiplier(4)->Range(1, 64)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(map, same_size, 1)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);
BENCHMARK_CAPTURE(map, one_to_hundred, 100)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);
BENCHMARK_MAIN();

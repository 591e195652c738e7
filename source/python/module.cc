// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The module signorini._core: what the package signorini (Python, beside this file) is made of. Arrays and
// texts only; names, shapes and checks for people are in the package.

#include "matrix_problem.h"
#include "mpi_session.h"
#include "problem_run.h"
#include "surface_overlay.h"

#include <signorini/algebra/input_error.h>

#include <pybind11/iostream.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>

namespace
{
  namespace py = pybind11;
  using namespace Signorini;

  template <typename T>
  using Input   = py::array_t<T, py::array::c_style | py::array::forcecast>;
  using Numbers = Input<double>;
  using Indices = Input<std::int64_t>;

  /// An array that takes over a list. The first length is that of the list divided by the others.
  template <typename T>
  py::array_t<T> to_array(std::vector<T> &&list, std::vector<py::ssize_t> lengths = {})
  {
    auto *const       kept = new std::vector<T>(std::move(list));
    const py::capsule owner(kept, [](void *const pointer) { delete static_cast<std::vector<T> *>(pointer); });
    py::ssize_t       rest = 1;
    for (const py::ssize_t length : lengths)
      rest *= length;
    lengths.insert(lengths.begin(), static_cast<py::ssize_t>(kept->size()) / rest);
    return py::array_t<T>(std::move(lengths), kept->data(), owner);
  }

  template <typename T>
  std::vector<T> to_list(const Input<T> &array)
  {
    return std::vector<T>(array.data(), array.data() + array.size());
  }

  /// While one lives no other thread computes here: MPI, meshers and std::cout are one for all.
  class Turn
  {
  public:
    /// Waits without Python's lock.
    Turn()
    {
      const py::gil_scoped_release unlocked;
      mutex().lock();
    }

    ~Turn()
    {
      mutex().unlock();
    }

    Turn(const Turn &) = delete;

  private:
    static std::recursive_mutex &mutex()
    {
      static std::recursive_mutex one_at_a_time;
      return one_at_a_time;
    }
  };

  /// Lets Python look after signals (Ctrl-C) amid a computation without its lock.
  void check_signals()
  {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
  }



  py::dict to_dict(FieldArrays &&fields)
  {
    py::dict result;
    for (OutputField &field : fields)
      {
        const std::vector<py::ssize_t> rest(field.n_components > 1 ? 1 : 0, field.n_components);
        result[py::str(field.name)] = to_array(std::move(field.values), rest);
      }
    return result;
  }

  py::dict to_dict(BodyArrays &&body)
  {
    py::dict result;
    result["name"]       = body.name;
    result["nodes"]      = to_array(std::move(body.nodes), {3});
    result["hexahedra"]  = to_array(std::move(body.hexahedra), {8});
    result["tetrahedra"] = to_array(std::move(body.tetrahedra), {4});
    result["fields"]     = to_dict(std::move(body.fields));
    return result;
  }

  py::dict to_dict(SurfaceArrays &&surface)
  {
    py::dict result;
    result["name"]      = surface.name;
    result["vertices"]  = to_array(std::move(surface.vertices), {3});
    result["faces"]     = to_array(std::move(surface.faces), {4});
    result["triangles"] = to_array(std::move(surface.triangles), {3});
    result["fields"]    = to_dict(std::move(surface.fields));
    return result;
  }

  py::dict to_dict(PairArrays &&pair)
  {
    py::dict result;
    result["name"]      = pair.name;
    result["nonmortar"] = to_dict(std::move(pair.nonmortar));
    result["mortar"]    = to_dict(std::move(pair.mortar));
    return result;
  }

  template <typename T>
  py::list to_dicts(std::vector<T> &&items);

  py::dict to_dict(StepArrays &&step)
  {
    py::dict result;
    result["time"]      = step.time;
    result["bodies"]    = to_dicts(std::move(step.bodies));
    result["nonmortar"] = to_dicts(std::move(step.nonmortar));
    result["mortar"]    = to_dicts(std::move(step.mortar));
    return result;
  }

  template <typename T>
  py::list to_dicts(std::vector<T> &&items)
  {
    py::list result;
    for (T &item : items)
      result.append(to_dict(std::move(item)));
    return result;
  }

  py::dict to_dict(RunOutcome &&outcome)
  {
    py::dict result;
    result["converged"]  = outcome.converged;
    result["objections"] = outcome.objections;
    result["folder"]     = outcome.folder;
    result["summary"]    = outcome.summary;
    result["pressure"]   = outcome.pressure;
    result["curve"]      = outcome.curve;
    result["parameters"] = outcome.parameters;
    result["bodies"]     = to_dicts(std::move(outcome.bodies));
    result["pairs"]      = to_dicts(std::move(outcome.pairs));
    result["steps"]      = to_dicts(std::move(outcome.steps));
    return result;
  }

  /// Lines of the program go to sys.stdout.
  py::dict run(const RunRequest &request, const bool on_all_ranks)
  {
    const MPI_Comm communicator = MpiSession::communicator(on_all_ranks);
    RunOutcome     outcome;
    {
      const Turn                        turn;
      const py::scoped_ostream_redirect redirection;
      const py::gil_scoped_release      unlocked;
      outcome = run_problem(request, communicator, check_signals);
    }
    return to_dict(std::move(outcome));
  }



  SurfaceMesh to_surface(const Numbers &vertices, const Indices &triangles, const Numbers &normals)
  {
    SurfaceMesh surface;
    const auto  x = vertices.unchecked<2>(), n = normals.unchecked<2>();
    const auto  corners = triangles.unchecked<2>();
    for (py::ssize_t v = 0; v < x.shape(0); ++v)
      surface.vertices.emplace_back(x(v, 0), x(v, 1), x(v, 2));
    for (py::ssize_t v = 0; v < n.shape(0); ++v)
      surface.vertex_normals.push_back(dealii::Point<3>(n(v, 0), n(v, 1), n(v, 2)));
    for (py::ssize_t t = 0; t < corners.shape(0); ++t)
      {
        surface.triangles.emplace_back();
        for (py::ssize_t c = 0; c < 3; ++c)
          // Negative numbers become too large ones, which are refused.
          surface.triangles.back()[c] =
              static_cast<unsigned int>(std::min<std::uint64_t>(corners(t, c), SurfaceTopology::none));
      }
    return surface;
  }

  std::unique_ptr<SurfaceOverlay> make_overlay(const std::array<Numbers, 2> &vertices,
                                               const std::array<Indices, 2> &triangles,
                                               const std::array<Numbers, 2> &normals)
  {
    MpiSession::start();
    SurfaceMesh nonmortar = to_surface(vertices[0], triangles[0], normals[0]),
                mortar    = to_surface(vertices[1], triangles[1], normals[1]);
    const Turn                   turn;
    const py::gil_scoped_release unlocked;
    return std::make_unique<SurfaceOverlay>(std::move(nonmortar), std::move(mortar));
  }

  /// The overlay triangles and the polygons that they fill.
  py::dict overlay_arrays(const SurfaceOverlay &overlay)
  {
    std::vector<std::int64_t> parents, polygon_parents;
    std::vector<double>       nonmortar, mortar;
    for (const OverlayTriangle &cell : overlay.cells)
      {
        parents.push_back(cell.nonmortar_triangle);
        parents.push_back(cell.mortar_triangle);
        for (unsigned int c = 0; c < 3; ++c)
          {
            nonmortar.insert(nonmortar.end(), cell.nonmortar[c].begin(), cell.nonmortar[c].end());
            mortar.insert(mortar.end(), cell.mortar[c].begin(), cell.mortar[c].end());
          }
      }
    const ContactMapping &mapping = overlay.mapping();
    for (std::size_t p = 0; p < mapping.n_polygons(); ++p)
      {
        polygon_parents.push_back(mapping.polygon_triangles[p].first);
        polygon_parents.push_back(mapping.polygon_triangles[p].second);
      }
    py::dict result;
    result["parents"]         = to_array(std::move(parents), {2});
    result["nonmortar"]       = to_array(std::move(nonmortar), {3, 3});
    result["mortar"]          = to_array(std::move(mortar), {3, 3});
    result["areas"]           = to_array(std::vector<double>(overlay.areas));
    result["polygon_parents"] = to_array(std::move(polygon_parents), {2});
    result["polygon_start"] =
        to_array(std::vector<std::int64_t>(mapping.polygon_start.begin(), mapping.polygon_start.end()));
    result["polygon_nonmortar"] = to_array(overlay.polygon_coordinates(false), {3});
    result["polygon_mortar"]    = to_array(overlay.polygon_coordinates(true), {3});
    return result;
  }

  py::tuple to_tuple(SurfaceOverlay::Matrix &&matrix)
  {
    return py::make_tuple(to_array(std::move(matrix.rows)), to_array(std::move(matrix.columns)),
                          to_array(std::move(matrix.values)));
  }

  py::list unmapped(const SurfaceOverlay &overlay)
  {
    py::list result;
    for (const auto &[vertex, reason] : overlay.mapping().report().unmapped)
      result.append(py::make_tuple(vertex, reason_name(reason)));
    return result;
  }



  CompressedRows to_rows(const py::tuple &csr)
  {
    return {csr[0].cast<std::size_t>(), to_list(csr[1].cast<Indices>()), to_list(csr[2].cast<Indices>()),
            to_list(csr[3].cast<Numbers>())};
  }

  MatrixProblem to_problem(const py::dict &given)
  {
    MatrixProblem problem;
    problem.n_components = given["components"].cast<unsigned int>();
    problem.matrix       = to_rows(given["matrix"]);
    problem.rhs          = to_list(given["rhs"].cast<Numbers>());
    problem.start        = to_list(given["start"].cast<Numbers>());
    problem.fixed        = to_list(given["fixed"].cast<Input<unsigned char>>());
    for (const py::handle csr : given["prolongations"])
      problem.prolongations.push_back(to_rows(csr.cast<py::tuple>()));
    problem.nodes   = to_list(given["nodes"].cast<Indices>());
    problem.normals = to_list(given["normals"].cast<Numbers>());
    problem.bounds  = to_list(given["bounds"].cast<Numbers>());
    problem.solver  = given["solver"].cast<std::string>();
    return problem;
  }

  py::dict solve_problem_in_matrices(const py::dict &given)
  {
    MpiSession::start();
    const MatrixProblem problem = to_problem(given);
    MatrixSolution      solution;
    {
      const Turn                   turn;
      const py::gil_scoped_release unlocked;
      solution = solve(problem, check_signals);
    }
    const ConvergenceReport &report = solution.report;
    py::dict                 result;
    result["u"]                = to_array(std::move(solution.displacement));
    result["active"]           = to_array(std::move(solution.active));
    result["converged"]        = report.converged;
    result["iterations"]       = report.iterations;
    result["start_iterations"] = report.start_iterations;
    result["history"]          = to_array(std::vector<double>(report.history));
    result["scale"]            = report.scale;
    result["note"]             = report.note;
    return result;
  }



  void add_overlay(py::module_ &module)
  {
    py::class_<SurfaceOverlay>(module, "Overlay")
        .def(py::init(&make_overlay), py::arg("vertices"), py::arg("triangles"), py::arg("normals"))
        .def("arrays", &overlay_arrays)
        .def_readonly("report", &SurfaceOverlay::report)
        .def_readonly("errors", &SurfaceOverlay::errors)
        .def("unmapped", &unmapped)
        .def("coupling",
             [](const SurfaceOverlay &overlay, const bool is_dual) {
               auto [D, M] = overlay.coupling(is_dual);
               return py::make_tuple(to_tuple(std::move(D)), to_tuple(std::move(M)));
             })
        .def("images", [](const SurfaceOverlay &overlay, const Indices &triangles, const Numbers &weights,
                          const bool from_mortar) {
          auto [at, coordinates] = overlay.images(to_list(triangles), to_list(weights), from_mortar);
          return py::make_tuple(to_array(std::move(at)), to_array(std::move(coordinates), {3}));
        });
  }
} // namespace



PYBIND11_MODULE(_core, module)
{
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  module.def(
      "run",
      [](const std::string &file, const std::array<std::string, 3> &text,
         const std::vector<std::string> &overrides, const std::string &output, const bool keeps_steps,
         const bool on_all_ranks) {
        RunRequest request;
        request.file        = file;
        request.text.text   = text[0];
        request.text.name   = text[1];
        request.text.folder = text[2];
        request.overrides   = overrides;
        request.output      = output;
        request.keeps_steps = keeps_steps;
        return run(request, on_all_ranks);
      },
      py::arg("file"), py::arg("text"), py::arg("overrides"), py::arg("output"), py::arg("keeps_steps"),
      py::arg("on_all_ranks"));
  add_overlay(module);
  module.def("solve", &solve_problem_in_matrices);
  module.def("rank", [] { return dealii::Utilities::MPI::this_mpi_process(MpiSession::communicator(true)); });
  module.def("n_ranks",
             [] { return dealii::Utilities::MPI::n_mpi_processes(MpiSession::communicator(true)); });
  module.def("version", &version_text);
  module.def("finish", &MpiSession::finish);
}

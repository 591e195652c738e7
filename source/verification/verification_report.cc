// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/json_writer.h>
#include <signorini/verification/verification_report.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <iomanip>

namespace Signorini
{
  namespace
  {
    std::string in_digits(const double value, const int digits)
    {
      std::ostringstream text;
      text << std::scientific << std::setprecision(digits - 1) << value;
      return text.str();
    }

    std::string order_text(const double order)
    {
      std::ostringstream text;
      text << std::fixed << std::setprecision(2) << order;
      return text.str();
    }

    /// The bar of a mesh, or infinity.
    double most_on(const VerifiedQuantity &quantity, const std::size_t mesh)
    {
      return quantity.most.empty() ? std::numeric_limits<double>::infinity()
                                   : quantity.most[std::min(mesh, quantity.most.size() - 1)];
    }

    bool has_order(const VerifiedQuantity &quantity)
    {
      return quantity.least_order != VerifiedQuantity::any_order;
    }

    /// What is wrong with a quantity. Comparisons are such that no number (NaN) passes.
    void judge(VerifiedProblem &result, const std::size_t q)
    {
      const VerifiedQuantity   &quantity = result.problem.quantities[q];
      const std::vector<double> errors = result.errors(q), orders = observed_orders(errors);
      for (std::size_t mesh = 0; mesh < errors.size(); ++mesh)
        if (!std::isfinite(errors[mesh]) || !(errors[mesh] <= most_on(quantity, mesh)))
          result.failures.push_back(
              quantity.name + " on mesh " + std::to_string(mesh + 1) + ": error " +
              in_digits(errors[mesh], 3) +
              (quantity.most.empty()
                   ? ", which is no number"
                   : ", at most " + in_digits(most_on(quantity, mesh), 2) + " is expected"));
      if (has_order(quantity) && !orders.empty() && !(orders.back() >= quantity.least_order))
        result.failures.push_back(quantity.name + ": order " + order_text(orders.back()) + ", at least " +
                                  order_text(quantity.least_order) + " is expected");
    }

    /// On one rank every exception is a failure of the problem; ranks could be left behind by it.
    void solve_meshes(VerifiedProblem &result, const unsigned int n_meshes, const MPI_Comm communicator,
                      const std::function<void(const unsigned int)> &show)
    {
      const bool alone = dealii::Utilities::MPI::n_mpi_processes(communicator) == 1;
      try
        {
          for (unsigned int mesh = 0; mesh < n_meshes; ++mesh)
            {
              if (show)
                show(mesh);
              result.runs.push_back(result.problem.run(communicator, mesh));
            }
        }
      catch (const std::exception &e)
        {
          if (!alone)
            throw;
          result.failures.push_back("mesh " + std::to_string(result.runs.size() + 1) +
                                    " was not solved: " + e.what());
        }
    }
  } // namespace



  std::vector<double> VerifiedProblem::errors(const std::size_t quantity) const
  {
    std::vector<double> list;
    for (const VerificationRun &run : runs)
      list.push_back(run.errors[quantity]);
    return list;
  }



  std::vector<double> observed_orders(const std::vector<double> &errors)
  {
    std::vector<double> orders;
    for (std::size_t i = 0; i + 1 < errors.size(); ++i)
      orders.push_back(std::log2(errors[i] / errors[i + 1]));
    return orders;
  }



  VerifiedProblem verify(const VerificationProblem &problem, const unsigned int n_meshes,
                         const MPI_Comm communicator, const std::function<void(const unsigned int)> &show)
  {
    VerifiedProblem     result{problem, {}, {}, 0.};
    const dealii::Timer time;
    solve_meshes(result, n_meshes, communicator, show);
    for (std::size_t mesh = 0; mesh < result.runs.size(); ++mesh)
      {
        AssertThrow(result.runs[mesh].errors.size() == problem.quantities.size(),
                    dealii::ExcMessage("A verification problem needs one error for each of its quantities."));
        for (const std::string &text : result.runs[mesh].objections)
          result.failures.push_back("mesh " + std::to_string(mesh + 1) + ": " + text);
      }
    for (std::size_t q = 0; q < problem.quantities.size(); ++q)
      judge(result, q);
    result.seconds = time.wall_time();
    return result;
  }



  std::string verdict_line(const VerifiedProblem &result)
  {
    std::ostringstream line;
    line << (result.passes() ? "pass  " : "FAIL  ") << std::left << std::setw(24) << result.problem.name;
    for (std::size_t q = 0; q < result.problem.quantities.size() && !result.runs.empty(); ++q)
      {
        const VerifiedQuantity   &quantity = result.problem.quantities[q];
        const std::vector<double> errors = result.errors(q), orders = observed_orders(errors);
        line << (q == 0 ? "" : ", ") << quantity.name << ' ' << in_digits(errors.back(), 2);
        if (has_order(quantity) && !orders.empty())
          line << " (order " << order_text(orders.back()) << ')';
      }
    return line.str();
  }



  namespace
  {
    /// A row of the table: a word, an entry for each mesh, a remark.
    void print_row(std::ostream &out, const std::string &name, const std::vector<std::string> &entries,
                   const std::string &remark)
    {
      out << "      " << std::left << std::setw(18) << name << std::right;
      for (const std::string &entry : entries)
        out << std::setw(11) << entry;
      out << (remark.empty() ? "" : "   ") << remark << '\n';
    }

    std::string bars(const VerifiedQuantity &quantity, const std::vector<double> &orders,
                     const std::size_t n_meshes)
    {
      std::string text;
      if (has_order(quantity) && !orders.empty())
        {
          text = "order";
          for (const double order : orders)
            text += " " + order_text(order);
          text += ", at least " + order_text(quantity.least_order);
        }
      if (quantity.most.empty())
        return text;
      text += text.empty() ? "at most" : "; at most";
      const std::size_t different = std::min(quantity.most.size(), n_meshes);
      for (std::size_t mesh = 0; mesh < different; ++mesh)
        text += " " + in_digits(quantity.most[mesh], 2);
      return text;
    }
  } // namespace



  void print_details(std::ostream &out, const VerifiedProblem &result)
  {
    const VerificationProblem &problem = result.problem;
    out << "      " << problem.what << "\n      reference: " << problem.reference << "\n      meshes: ";
    for (std::size_t mesh = 0; mesh < std::max<std::size_t>(1, result.runs.size()); ++mesh)
      out << (mesh == 0 ? "" : "; ") << problem.meshes[mesh];
    out << '\n';
    std::vector<std::string> unknowns, iterations;
    for (const VerificationRun &run : result.runs)
      {
        unknowns.push_back(std::to_string(run.unknowns));
        iterations.push_back(std::to_string(run.iterations));
      }
    if (!result.runs.empty() && result.runs.back().unknowns > 0)
      {
        print_row(out, "unknowns", unknowns, "");
        print_row(out, "iterations", iterations, "");
      }
    for (std::size_t q = 0; q < problem.quantities.size() && !result.runs.empty(); ++q)
      {
        const std::vector<double> errors = result.errors(q);
        std::vector<std::string>  entries;
        for (const double error : errors)
          entries.push_back(in_digits(error, 2));
        print_row(out, problem.quantities[q].name, entries,
                  bars(problem.quantities[q], observed_orders(errors), errors.size()));
      }
    for (const std::string &text : result.failures)
      out << "      FAIL: " << text << '\n';
  }



  namespace
  {
    void list(JsonWriter &json, const std::string &key, const std::vector<double> &values)
    {
      json.begin('[', key);
      for (const double value : values)
        json.number("", value);
      json.end(']');
    }

    void list(JsonWriter &json, const std::string &key, const std::vector<std::string> &texts)
    {
      json.begin('[', key);
      for (const std::string &text : texts)
        json.text("", text);
      json.end(']');
    }

    void write_quantity(JsonWriter &json, const VerifiedProblem &result, const std::size_t q)
    {
      const VerifiedQuantity   &quantity = result.problem.quantities[q];
      const std::vector<double> errors = result.errors(q), orders = observed_orders(errors);
      std::vector<double>       most;
      for (std::size_t mesh = 0; mesh < errors.size(); ++mesh)
        most.push_back(most_on(quantity, mesh));
      VerifiedProblem judged{result.problem, result.runs, {}, 0.};
      judge(judged, q);
      json.begin('{');
      json.text("name", quantity.name);
      json.text("what", quantity.what);
      list(json, "errors", errors);
      list(json, "orders", orders);
      // null where there is no bar.
      list(json, "most", most);
      json.number("least_order", quantity.least_order);
      json.boolean("passes", judged.passes() && !result.runs.empty());
      json.end('}');
    }

    void write_mesh(JsonWriter &json, const VerifiedProblem &result, const std::size_t mesh)
    {
      const VerificationRun &run = result.runs[mesh];
      json.begin('{');
      json.text("what", result.problem.meshes[mesh]);
      json.number("unknowns", static_cast<double>(run.unknowns));
      json.number("iterations", run.iterations);
      list(json, "objections", run.objections);
      json.end('}');
    }

    void write_problem(JsonWriter &json, const VerifiedProblem &result)
    {
      json.begin('{');
      json.text("name", result.problem.name);
      json.text("what", result.problem.what);
      json.text("reference", result.problem.reference);
      json.boolean("passes", result.passes());
      list(json, "failures", result.failures);
      json.number("seconds", result.seconds);
      json.begin('[', "meshes");
      for (std::size_t mesh = 0; mesh < result.runs.size(); ++mesh)
        write_mesh(json, result, mesh);
      json.end(']');
      json.begin('[', "quantities");
      for (std::size_t q = 0; q < result.problem.quantities.size(); ++q)
        write_quantity(json, result, q);
      json.end(']');
      json.end('}');
    }
  } // namespace



  void write_json(std::ostream &out, const std::vector<VerifiedProblem> &problems,
                  const VerificationSettings &settings)
  {
    const auto n_passed = std::count_if(problems.begin(), problems.end(),
                                        [](const VerifiedProblem &problem) { return problem.passes(); });
    JsonWriter json(out);
    json.begin('{');
    json.text("version", settings.version);
    json.number("ranks", settings.ranks);
    json.boolean("quick", settings.quick);
    json.number("passed", static_cast<double>(n_passed));
    json.number("failed", static_cast<double>(problems.size()) - static_cast<double>(n_passed));
    json.boolean("passes", n_passed == static_cast<std::ptrdiff_t>(problems.size()));
    json.begin('[', "problems");
    for (const VerifiedProblem &problem : problems)
      write_problem(json, problem);
    json.end(']');
    json.end('}');
    out << '\n';
  }
} // namespace Signorini

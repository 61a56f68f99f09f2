#include <chrono>
#include <filesystem>

#include "conversions.hpp"
#include "python_class.hpp"
#include "shoal/analysis/experiments/named_files.hpp"
#include "shoal/analysis/experiments/pipeline.hpp"
#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/analysis/experiments/sweep/open_sweep.hpp"
#include "shoal/analysis/experiments/sweep/progress_text.hpp"
#include "shoal/analysis/reporting/export.hpp"
#include "shoal/analysis/reporting/study_report.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::python {
namespace {

namespace fs = std::filesystem;

/// A study by name, by path, or as a dict.
analysis::TrialList planned(const py::object& study, std::int64_t replications) {
  const bool whole = py::isinstance<py::dict>(study);
  return analysis::planned_study(
             whole ? to_setting(study) : scenarios::read_toml(analysis::study_file(py::str(study))),
             replications)
      .list;
}

py::dict counts(const analysis::SweepProgress& progress) {
  py::dict counted;
  counted["planned"] = progress.planned;
  counted["stored"] = progress.stored;
  counted["done"] = progress.done;
  counted["failed"] = progress.failed;
  counted["elapsed_s"] = progress.elapsed_s;
  counted["first_failure"] = progress.first_failure;
  return counted;
}

/// The program beside the library that runs, for solvers that need processes of their own; "" if
/// there is none, or if it would not know what this process was given.
std::string program_beside() {
  if (has_own_code()) return "";
  const fs::path prefix = scenarios::library_path().parent_path().parent_path().parent_path();
  const fs::path program = prefix / "bin" / "shoal";
  return fs::exists(program) ? program.string() : "";
}

py::dict sweep(const py::object& study, const std::string& folder, int jobs,
               std::int64_t replications, bool rerun_changed, bool retry_failed,
               const py::object& progress) {
  const analysis::TrialList list = planned(study, replications);
  analysis::SweepSettings settings{.jobs = jobs,
                                   .rerun_changed = rerun_changed,
                                   .retry_failed = retry_failed,
                                   .worker_program = program_beside(),
                                   .progress = {}};
  settings.progress = [&](const analysis::SweepProgress& now) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // Ctrl-C
    if (!progress.is_none()) progress(counts(now));
  };
  analysis::SweepProgress done;
  {
    const NoNewMembers while_it_runs;
    const py::gil_scoped_release free;
    done = analysis::sweep(list, folder, settings);
  }
  return counts(done);
}

/// An open sweep whose trials run elsewhere.
class Sweep {
 public:
  Sweep(const py::object& study, const std::string& folder, std::int64_t replications,
        bool rerun_changed, bool retry_failed, int jobs)
      : list_(planned(study, replications)),
        folder_(folder),
        open_(list_, folder,
              {.jobs = jobs,
               .rerun_changed = rerun_changed,
               .retry_failed = retry_failed,
               .worker_program = "",
               .progress = {}}),
        scenarios_(list_) {}

  std::size_t size() const { return open_.tasks().size(); }

  std::string request(std::size_t index) {
    const analysis::SweepTask& task = open_.tasks().at(index);
    return analysis::trial_request(scenarios_.of(*task.trial).scenario, open_.series());
  }

  /// False if the trial failed.
  bool store(std::size_t index, const std::string& answer) {
    analysis::TrialOutcome outcome = analysis::parsed_answer(answer);
    const bool done = outcome.failure.empty();
    open_.store(open_.tasks().at(index), std::move(outcome));
    return done;
  }

  py::dict progress() const { return counts(now()); }
  std::string progress_text() const { return analysis::progress_text(now()); }
  std::vector<std::string> summary() const { return analysis::summary_lines(now(), folder_); }

  void end() { open_.end(elapsed_s()); }

 private:
  analysis::SweepProgress now() const {
    analysis::SweepProgress progress = open_.progress();
    progress.elapsed_s = elapsed_s();
    return progress;
  }

  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  analysis::TrialList list_;
  fs::path folder_;
  analysis::OpenSweep open_;
  analysis::CellScenarios scenarios_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

void append_claim(py::list& rows, const analysis::JudgedStatement& statement,
                  const analysis::JudgedClaim& part, const std::string& name, std::size_t column) {
  const analysis::JudgedColumn& judged = *part.columns[column];
  for (const analysis::Contrast& contrast : judged.result.contrasts) {
    py::dict row;
    row["statement"] = statement.number;
    row["section"] = statement.section;
    row["claim"] = part.claim.says;
    row["column"] = name;
    row["statement_verdict"] = statement.verdict_text(column);
    row["verdict"] = name_of(judged.result.verdict());
    row["contrast"] = contrast.title;
    row["contrast_verdict"] = name_of(judged.result.verdict_of(contrast));
    row["claimed"] = contrast.claimed;
    row["n"] = contrast.n;
    row["trials"] = contrast.trials;
    row["never_reached"] = contrast.never_reached;
    row["estimate"] = contrast.estimate;
    row["low"] = contrast.interval ? std::optional(contrast.interval->low) : std::nullopt;
    row["high"] = contrast.interval ? std::optional(contrast.interval->high) : std::nullopt;
    row["p_holds"] = contrast.p_holds;
    row["p_fails"] = contrast.p_fails;
    row["corrected_p"] = judged.corrected_p;
    rows.append(row);
  }
}

py::list claims(analysis::SweptStudy& study) {
  py::list rows;
  const analysis::Judgement& judgement = study.claims();
  for (const analysis::JudgedStatement& statement : judgement.statements) {
    for (const analysis::JudgedClaim& part : statement.parts) {
      for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
        if (part.columns[c]) append_claim(rows, statement, part, judgement.columns[c], c);
      }
    }
  }
  return rows;
}

py::object cell_value(const analysis::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return py::str(*text);
  if (const auto* estimate = std::get_if<analysis::Estimate>(&cell)) {
    return py::float_(estimate->value);
  }
  return py::none();
}

py::list table_rows(const analysis::Table& table) {
  py::list rows;
  for (const auto& row : table.rows) {
    py::list values;
    for (const analysis::Cell& cell : row) values.append(cell_value(cell));
    rows.append(values);
  }
  return rows;
}

py::list table_columns(const analysis::Table& table) {
  py::list columns;
  for (const analysis::Column& column : table.columns) {
    columns.append(py::make_tuple(column.group, column.header, column.unit));
  }
  return columns;
}

}  // namespace

void add_studies(py::module_& module) {
  module.def("sweep", &sweep, py::arg("study"), py::arg("folder"), py::arg("jobs"),
             py::arg("replications"), py::arg("rerun_changed"), py::arg("retry_failed"),
             py::arg("progress"));
  py::class_<Sweep>(module, "OpenSweep")
      .def(py::init<const py::object&, const std::string&, std::int64_t, bool, bool, int>(),
           py::arg("study"), py::arg("folder"), py::arg("replications"), py::arg("rerun_changed"),
           py::arg("retry_failed"), py::arg("jobs"))
      .def("__len__", &Sweep::size)
      .def("request", &Sweep::request, py::arg("index"))
      .def("store", &Sweep::store, py::arg("index"), py::arg("answer"))
      .def("progress", &Sweep::progress)
      .def("progress_text", &Sweep::progress_text)
      .def("summary", &Sweep::summary)
      .def("end", &Sweep::end);
  module.def(
      "answer",
      [](const std::string& request) {
        const NoNewMembers while_it_runs;
        const py::gil_scoped_release free;
        return analysis::trial_answer(request);
      },
      py::arg("request"));
  module.def(
      "trials_csv", [](const std::string& folder) { return analysis::StudyExport(folder).csv(); },
      py::arg("folder"));
  py::class_<analysis::SweptStudy>(module, "SweptStudy")
      .def(py::init([](const std::string& folder) { return analysis::SweptStudy(folder); }),
           py::arg("folder"))
      .def("tables", &analysis::SweptStudy::tables)
      .def("claims", &claims)
      .def("write_tables", [](analysis::SweptStudy& study) { study.write_tables(); })
      .def("write_report", &analysis::write_study_report);
  module.def(
      "export_netcdf",
      [](const std::string& folder, const std::string& file) {
        analysis::StudyExport(folder).write_netcdf(file);
      },
      py::arg("folder"), py::arg("file"));

  py::class_<analysis::Table>(module, "Table", "A table of the house: text, CSV, Markdown, LaTeX.")
      .def_readonly("name", &analysis::Table::name)
      .def_readonly("caption", &analysis::Table::caption)
      .def_property_readonly("columns", &table_columns, "(group, header, unit) of each.")
      .def_property_readonly("rows", &table_rows, "Values: texts, numbers, or None.")
      .def(
          "print",
          [](const analysis::Table& table, const std::string& format) {
            return analysis::table_format(format)->print(table);
          },
          py::arg("format") = "text", "In a format, as shoal list table_formats names them.")
      .def("__str__", &analysis::as_text)
      .def("_repr_html_", &analysis::as_html);
}

}  // namespace shoal::python

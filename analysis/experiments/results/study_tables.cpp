#include "shoal/analysis/experiments/results/study_tables.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <set>

#include "shoal/analysis/experiments/claims/claim_text.hpp"
#include "shoal/analysis/experiments/results/attribution_table.hpp"
#include "shoal/analysis/experiments/results/cell_table.hpp"
#include "shoal/analysis/experiments/results/difference_table.hpp"
#include "shoal/analysis/experiments/results/sensitivity_table.hpp"
#include "shoal/analysis/experiments/study/needed_series.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/analysis/tables/table_format.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& usual_measures() {
  static const std::vector<std::string> measures{"energy_mean_wh", "thrust_time_ratio_mean",
                                                 "quality_settled_m", "time_to_quality_20m_s"};
  return measures;
}

std::vector<std::string> needed_measures(const Study& study) {
  std::set<std::string> names(usual_measures().begin(), usual_measures().end());
  for (const TableRequest& table : study.tables) {
    names.insert(table.measures.begin(), table.measures.end());
  }
  for (const ComparisonRequest& comparison : study.comparisons) {
    names.insert(comparison.measures.begin(), comparison.measures.end());
  }
  for (const SensitivityRequest& sensitivity : study.sensitivities) {
    names.insert(sensitivity.measures.begin(), sensitivity.measures.end());
  }
  for (const AttributionRequest& attribution : study.attributions) {
    names.insert(attribution.measures.begin(), attribution.measures.end());
  }
  for (const TestedStatement* asked : tested_on_the_study(study.claims)) {
    if (asked->measure.empty()) continue;
    names.insert(asked->measure);
    if (!asked->minus.empty()) names.insert(asked->minus);
  }
  return {names.begin(), names.end()};
}

/// By the ending of their files, the formats that tables are written in.
using FormatsOfFiles = std::map<std::string, std::unique_ptr<TableFormat>>;

FormatsOfFiles formats_of_files() {
  FormatsOfFiles formats;
  for (const std::string& name : Registry<TableFormat>::instance().names()) {
    auto format = table_format(name);
    const std::string ending = format->file_ending();
    if (!ending.empty()) formats.emplace(ending, std::move(format));
  }
  return formats;
}

/// The tables that `make` makes. Numbers that a statistic cannot take are no reason to lose the
/// other tables: then, a table that says so. What the study does not have is still an error.
template <class Request, class Make>
std::vector<Table> or_why_not(const Request& request, const Make& make) {
  try {
    return make();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return {{request.name,
             request.caption,
             {{.header = "not computed"}},
             {{std::string(error.what())}},
             {}}};
  }
}

TableRequest usual_table(const TrialGroup& group) {
  TableRequest request;
  request.name = group.name().empty() ? "results" : group.name();
  request.groups = {group.name()};
  request.measures = usual_measures();
  // One row of all that a design drew: cells that are met once have no scatter.
  if (group.sampled()) request.pool = group.columns();
  return request;
}

}  // namespace

StudyResults read_results(const TrialList& list, const fs::path& folder) {
  const Store store(folder, Store::Access::read);
  return {list, store, needed_measures(list.study()), needed_series(list.study())};
}

std::size_t require_answerable(const TrialList& list) {
  const StudyResults none(list, needed_measures(list.study()), needed_series(list.study()));
  require_answerable_claims(none);
  return study_tables(none).size() + (list.study().claims.empty() ? 0 : 1);
}

std::vector<Table> study_tables(const StudyResults& results) {
  const Study& study = results.list().study();
  std::vector<Table> tables;
  const auto take = [&](std::vector<Table> some) {
    std::ranges::move(some, std::back_inserter(tables));
  };
  for (const TableRequest& request : study.tables) {
    take(or_why_not(request, [&] { return std::vector{cell_table(request, results)}; }));
  }
  for (const ComparisonRequest& request : study.comparisons) {
    take(or_why_not(request, [&] { return std::vector{difference_table(request, results)}; }));
  }
  for (const SensitivityRequest& request : study.sensitivities) {
    take(or_why_not(request, [&] { return sensitivity_tables(request, results); }));
  }
  for (const AttributionRequest& request : study.attributions) {
    take(or_why_not(request, [&] { return std::vector{attribution_table(request, results)}; }));
  }
  if (!tables.empty()) return tables;
  for (const TrialGroup& group : results.list().groups()) {
    tables.push_back(cell_table(usual_table(group), results));
  }
  return tables;
}

std::vector<std::string> file_endings_of_tables() {
  std::vector<std::string> endings;
  for (const auto& [ending, format] : formats_of_files()) endings.push_back(ending);
  return endings;
}

std::size_t write_tables(std::vector<Table> tables, const Judgement& claims,
                         const fs::path& folder) {
  if (!claims.statements.empty()) tables.push_back(claims_table(claims));
  const fs::path place = folder / "tables";
  const FormatsOfFiles formats = formats_of_files();
  require_writable(place);
  std::set<fs::path> written;
  for (const Table& table : tables) {
    for (const auto& [ending, format] : formats) {
      const fs::path file = place / (table.name + ending);
      write_whole_file(file, format->print(table));
      written.insert(file);
    }
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(place)) {
    const bool a_table = formats.contains(entry.path().extension().string());
    if (a_table && !written.contains(entry.path())) fs::remove(entry.path());
  }
  return tables.size();
}

}  // namespace shoal::analysis

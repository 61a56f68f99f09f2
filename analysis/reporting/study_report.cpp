#include "shoal/analysis/reporting/study_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "shoal/analysis/experiments/claims/claim_text.hpp"
#include "shoal/analysis/experiments/store/manifest.hpp"
#include "shoal/analysis/reporting/packed.hpp"
#include "shoal/analysis/reporting/page.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json text_of(const std::optional<Verdict>& verdict) {
  return verdict ? Json(name_of(*verdict)) : Json("-");
}

/// A claim with what stands below it, column by column.
Json part(const JudgedClaim& judged, const Judgement& judgement) {
  Json verdicts = Json::array(), lines = Json::array();
  for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
    verdicts.push_back(text_of(judged.verdict(c)));
    lines.push_back(claim_lines(judged, c, judgement));
  }
  return {{"says", judged.claim.says}, {"verdicts", verdicts}, {"lines", lines}};
}

Json claims(const Judgement& judgement) {
  Json statements = Json::array();
  for (const JudgedStatement& statement : judgement.statements) {
    Json verdicts = Json::array(), parts = Json::array();
    for (std::size_t c = 0; c < judgement.columns.size(); ++c) {
      verdicts.push_back(statement.verdict_text(c));
    }
    for (const JudgedClaim& judged : statement.parts) parts.push_back(part(judged, judgement));
    statements.push_back({{"number", statement.number},
                          {"section", statement.section},
                          {"says", statement.says},
                          {"not_tested", statement.not_tested},
                          {"verdicts", verdicts},
                          {"parts", parts}});
  }
  return {{"columns", judgement.columns},
          {"counts", count_lines(judgement)},
          {"note", verdict_note(judgement)},
          {"statements", statements}};
}

std::string words(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const auto* estimate = std::get_if<Estimate>(&cell);
  return estimate ? shortest(estimate->value) : "";
}

/// One row of a chart: every trial behind an estimate, its mean and interval.
Json points_of(const std::string& label, const Estimate& estimate) {
  Json shown{{"label", label}, {"value", estimate.value}, {"each", estimate.each}};
  if (const auto* by = std::get_if<PlusMinus>(&estimate.uncertainty)) {
    shown["low"] = estimate.value - by->by;
    shown["high"] = estimate.value + by->by;
  } else if (const auto* ends = std::get_if<Between>(&estimate.uncertainty)) {
    shown["low"] = ends->low;
    shown["high"] = ends->high;
  }
  return shown;
}

/// Of a table, a chart for each column that knows the trials behind its numbers; where measures run
/// down the table, one for each of them.
Json charts(const Table& table) {
  const auto known = [](const Cell& cell) -> const Estimate* {
    const auto* estimate = std::get_if<Estimate>(&cell);
    return estimate && !estimate->each.empty() ? estimate : nullptr;
  };
  Json charts = Json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    std::vector<std::pair<std::string, Json>> of_column;  // title, rows
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const std::vector<Cell>& row = table.rows[r];
      if (!known(row[c])) continue;
      std::string label, title = column.header;
      for (std::size_t l = 0; l < row.size() && !known(row[l]); ++l) {
        const std::string text = words(row[l]);
        if (table.columns[l].header == "measure") {
          title += ", " + text;
        } else if (!text.empty()) {
          label += (label.empty() ? "" : ", ") + text;
        }
      }
      if (of_column.empty() || of_column.back().first != title) {
        of_column.emplace_back(title, Json::array());
      }
      of_column.back().second.push_back(points_of(label, *known(row[c])));
      of_column.back().second.back()["cell"] = {r, c};
    }
    const std::string group = column.group.empty() ? "" : column.group + ": ";
    for (const auto& [title, rows] : of_column) {
      charts.push_back({{"title", group + title}, {"unit", column.unit}, {"rows", rows}});
    }
  }
  return charts;
}

/// Which trials are missing from the numbers, and why.
Json failures(const StudyResults& results) {
  Json failed = Json::array();
  for (std::size_t i = 0; i < results.list().trials(); ++i) {
    if (results.state(i) != StudyResults::State::failed) continue;
    failed.push_back(
        {{"trial", results.list().title(results.list().trial(i))}, {"reason", results.failure(i)}});
  }
  return failed;
}

/// Names of the tables that stand in a folder, in all their forms.
Json written_tables(const fs::path& folder) {
  Json names = Json::array();
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".tex") names.push_back(entry.path().stem().string());
  }
  return names;
}

/// The SVG pictures of a folder, by name, as images that stand in the page.
Json pictures(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".svg") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  Json images = Json::array();
  for (const fs::path& file : files) {
    const std::optional<std::string> svg = read_whole_file(file);
    if (!svg) throw SystemError("cannot read " + file.string());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(svg->data());
    images.push_back(
        {{"name", file.stem().string()},
         {"image", "data:image/svg+xml;base64," + packed_bytes(std::span(bytes, svg->size()))}});
  }
  return images;
}

}  // namespace

void write_study_report(SweptStudy& study) {
  const fs::path& folder = study.folder();
  const StudyResults& results = study.results();
  using enum StudyResults::State;
  const std::string title = results.list().study().title;
  Json data{{"title", title.empty() ? fs::absolute(folder).filename().string() : title},
            {"done", results.count(done)},
            {"failed", results.count(failed)},
            {"missing", results.count(missing)},
            {"program", results.program()},
            {"failures", failures(results)},
            {"figures", pictures(folder / "figures")},
            {"study", read_whole_file(folder / "study.toml").value()},
            {"manifest", stored_manifest(folder)}};
  data["tables"] = Json::array();
  for (const Table& table : study.tables()) {
    data["tables"].push_back(
        {{"name", table.name}, {"html", as_html(table)}, {"points", charts(table)}});
  }
  data["files"] = written_tables(folder / "tables");
  data["claims"] = claims(study.claims());
  write_whole_file(folder / "report.html", whole_page("study.html", data));
}

}  // namespace shoal::analysis

#include "shoal/analysis/reporting/page.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "shoal/core/error.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

std::string part(const fs::path& file) {
  std::optional<std::string> text = read_whole_file(file);
  if (!text) throw SystemError("cannot read " + file.string() + ", a part of the report");
  return *std::move(text);
}

/// What `before` and `after` enclose on a line, or "" if it is no such line.
std::string named_by(std::string_view line, std::string_view before, std::string_view after) {
  if (!line.starts_with(before) || !line.ends_with(after)) return "";
  return std::string(line.substr(before.size(), line.size() - before.size() - after.size()));
}

/// JSON that no browser takes for the end of the script it stands in.
std::string script_text(const nlohmann::ordered_json& data) {
  // Names may hold bytes that are no UTF-8.
  const std::string json =
      data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string whole_page(const std::string& name, const nlohmann::ordered_json& data) {
  const fs::path folder = scenarios::library_path() / "report";
  std::istringstream page(part(folder / name));
  std::string whole;
  for (std::string line; std::getline(page, line);) {
    if (line == R"(<script type="application/json" id="data"></script>)") {
      whole += R"(<script type="application/json" id="data">)" + script_text(data) + "</script>\n";
    } else if (const auto style = named_by(line, R"(<link rel="stylesheet" href=")", R"(">)");
               !style.empty()) {
      whole += "<style>\n" + part(folder / style) + "</style>\n";
    } else if (const auto script = named_by(line, R"(<script src=")", R"("></script>)");
               !script.empty()) {
      whole += "<script>\n" + part(folder / script) + "</script>\n";
    } else if (const auto licence = named_by(line, "<!-- licence ", " -->"); !licence.empty()) {
      whole += "<!--\n" + part(folder / licence) + "-->\n";
    } else {
      whole += line + "\n";
    }
  }
  return whole;
}

}  // namespace shoal::analysis

#include "shoal/core/csv_table.hpp"

#include <algorithm>
#include <optional>

#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal {
namespace {

std::string content_of(const FilePath& file) {
  const std::string name = file.path.string();
  if (std::filesystem::is_directory(file.path)) {
    throw InputError(file.origin, name + " is a directory; name a CSV file");
  }
  std::optional<std::string> content = read_whole_file(file.path);
  if (!content)
    throw InputError(file.origin, "cannot open " + name + "; is there such a CSV file?");
  if (content->starts_with("\xEF\xBB\xBF")) content->erase(0, 3);
  return *content;
}

void require_utf8(std::string_view line, const Origin& origin) {
  const std::optional<std::size_t> at = first_not_utf8(line);
  if (!at) return;
  throw InputError(origin, "byte " + std::to_string(*at + 1) +
                               " of this line is not UTF-8; save the file as UTF-8 (from Latin-1: "
                               "iconv -f latin1 -t utf8)");
}

/// The fields of one line, without surrounding blanks; quotes as in RFC 4180.
std::vector<std::string> fields_of(std::string_view line, const Origin& origin) {
  std::vector<std::string> fields;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    std::string field;
    const bool quoted = line.starts_with('"');
    while (quoted) {
      const auto end = line.find('"', 1);
      if (end == std::string_view::npos) {
        throw InputError(origin, "a quoted field does not end; close it with \"");
      }
      field += line.substr(1, end - 1);
      line.remove_prefix(end);
      if (!line.substr(1).starts_with('"')) break;
      field += '"';
      line.remove_prefix(1);
    }
    if (quoted) line.remove_prefix(1);
    const auto comma = line.find(',');
    const std::string_view rest = trimmed(line.substr(0, comma));
    if (quoted && !rest.empty()) {
      throw InputError(origin, "\"" + std::string(rest) + "\" follows a quoted field; put a comma");
    }
    fields.push_back(quoted ? std::move(field) : std::string(rest));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

bool CsvTable::is_comment(std::string_view line, const Origin& here) const {
  if (!line.starts_with('#')) return false;
  const bool like_a_row = !header_.empty() && line.size() > 1 && line[1] != ' ' && line[1] != '#' &&
                          split(line, ',').size() == header_.size();
  if (like_a_row) {
    throw InputError(here, "this may be a row with the name " +
                               std::string(line.substr(0, line.find(','))) +
                               ", or a comment; quote the name, or put a blank after #");
  }
  return true;
}

CsvTable::CsvTable(const FilePath& file, const CsvColumns& columns) : file_(file.path.string()) {
  const std::string content = content_of(file);
  int line_number = 0;
  for (const std::string_view raw : split(content, '\n')) {
    ++line_number;
    const std::string_view line = trimmed(raw);
    const Origin here{file_, line_number};
    require_utf8(line, here);
    if (line.empty() || is_comment(line, here)) continue;
    std::vector<std::string> fields = fields_of(line, here);
    if (header_.empty()) {
      take_header(fields, line_number, columns);
      continue;
    }
    if (fields.size() != header_.size()) {
      throw InputError(here, "this row has " + std::to_string(fields.size()) + " field" +
                                 (fields.size() == 1 ? "" : "s") + "; it needs " +
                                 std::to_string(header_.size()) + ": " + listed(header_));
    }
    lines_.push_back(line_number);
    std::ranges::move(fields, std::back_inserter(fields_));
  }
  if (header_.empty()) {
    throw InputError({file_, 0}, "the file is empty; its first line names the columns " +
                                     listed(columns.required));
  }
  if (lines_.empty()) throw InputError({file_, 0}, "the file has no rows below its header");
}

void CsvTable::take_header(const std::vector<std::string>& fields, int line,
                           const CsvColumns& columns) {
  const Origin here{file_, line};
  std::vector<std::string> known = columns.required;
  known.insert(known.end(), columns.optional.begin(), columns.optional.end());
  for (const std::string& field : fields) {
    const bool is_known = std::ranges::find(known, field) != known.end();
    if (!is_known && !columns.pass_over_others) {
      throw InputError(
          here, "there is no column \"" + field + "\" in such a file" + suggestion(field, known));
    }
    if (is_known && has(field)) {
      throw InputError(here, "the column \"" + field + "\" stands here twice");
    }
    header_.push_back(field);
  }
  for (const std::string& column : columns.required) {
    if (!has(column)) {
      throw InputError(here, "the column \"" + column + "\" is missing; the first line names " +
                                 listed(columns.required));
    }
  }
}

bool CsvTable::has(const std::string& column) const {
  return std::ranges::find(header_, column) != header_.end();
}

std::size_t CsvTable::column_index(const std::string& column) const {
  const auto found = std::ranges::find(header_, column);
  if (found == header_.end()) {
    throw InputError({file_, 0}, "the file has no column \"" + column + '"');
  }
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const std::string& field = fields_[row * header_.size() + column_index(column)];
  if (field.empty()) throw InputError(origin(row), column + " is empty");
  return field;
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::string& field = text(row, column);
  if (const auto number = parsed_number(field)) return *number;
  throw InputError(origin(row), column + " is \"" + field + "\"; it takes a finite number");
}

std::vector<std::string> CsvTable::texts(const std::string& column) const {
  std::vector<std::string> all;
  for (std::size_t row = 0; row < rows(); ++row) all.push_back(text(row, column));
  return all;
}

std::vector<double> CsvTable::numbers(const std::string& column) const {
  std::vector<double> all;
  for (std::size_t row = 0; row < rows(); ++row) all.push_back(number(row, column));
  return all;
}

}  // namespace shoal

#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shoal/analysis/tables/number.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// What a column holds; the last four are the uncertainties in their order.
enum class ColumnKind { text, number, plus_minus, deviation, between };

/// Characters before and from the point on, which all numbers at one place of a column are given.
struct Extent {
  std::size_t before = 0, after = 0;
};

struct LaidColumn {
  ColumnKind kind = ColumnKind::text;
  bool at_point = true;           ///< numbers are aligned at the point, or else at their end
  std::array<Extent, 3> extents;  ///< of the value and of the numbers of its uncertainty
  bool counts = false;            ///< some estimate knows its n, or trials failed
  bool best = false;              ///< some estimate is the best
  bool not_run = false;           ///< some trials have not run
  bool reached = false;           ///< some estimate is of events
  bool each = false;              ///< the values behind some estimate are known
  bool remarks = false;           ///< of some cell more is to say

  bool numeric() const { return kind != ColumnKind::text; }
};

struct LaidCell {
  std::vector<Number> numbers;  ///< none for a text and what is missing
  std::string mark;             ///< letters that notes explain, or nothing
  bool best = false;
  std::string reached = {};  ///< `(18 of 20)` of the time to an event, or nothing
};

/// A header over the columns [first, first + count).
struct Span {
  std::string header, unit;
  std::size_t first = 0, count = 0;
};

struct Note {
  std::string mark;  ///< "" for a note about all
  std::string text;
};

/// What every form of a table shares: its kinds of columns, printed numbers, marks and notes.
struct Layout {
  /// Throws std::invalid_argument as print() says.
  explicit Layout(const Table& table);

  std::vector<LaidColumn> columns;
  std::vector<std::vector<LaidCell>> rows;
  std::vector<Span> spans;  ///< none where no column is of a group
  std::vector<Note> notes;

  /// What a number takes by itself.
  static Extent extent_of(const Number& number, bool at_point);
};

/// Of a cell that may have some; none of texts.
const std::vector<std::string>& remarks_of(const Cell& cell);

/// `energy (Wh)`.
std::string with_unit(const std::string& header, const std::string& unit);

/// `77.5 ± 5.6`, of a cell that has numbers; a best value stands between `before` and `after`.
std::string estimate_text(const LaidCell& cell, ColumnKind kind, std::string_view before,
                          std::string_view after);

/// A mark in HTML, which Markdown takes, too.
std::string superscript(const std::string& mark);

/// Line breaks as blanks.
std::string on_one_line(std::string text);

}  // namespace shoal::analysis

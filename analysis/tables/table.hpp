#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace shoal::analysis {

/// How many digits a number shows. Numbers with decimals are aligned at the point, also where they
/// differ in them; the others as whole texts.
struct Digits {
  enum class Count { decimals, significant };
  Count count = Count::significant;
  int number = 3;

  /// Digits after the point; of -1, tens are the last to show. Numbers that would need more than
  /// six decimals, or three zeros that say nothing, are written with a power of ten.
  static Digits decimals(int number) { return {Count::decimals, number}; }
  /// As printf's `%g`: trailing zeros are dropped.
  static Digits significant(int number) { return {Count::significant, number}; }
};

/// Two significant digits of an uncertainty, which are those its estimate deserves. Of an
/// uncertainty of zero nothing follows: six significant digits. Throws std::invalid_argument for
/// one that is negative or not finite.
Digits decimals_for(double uncertainty);

struct PlusMinus {
  double by = 0.0;  ///< `77.5 +- 5.6`
};
struct Deviation {
  double sd = 0.0;  ///< `77.5 (5.6)`
};
struct Between {
  double low = 0.0, high = 0.0;  ///< `77.5 [71.9, 83.1]`: an interval, quartiles, a range
};
using Uncertainty = std::variant<std::monostate, PlusMinus, Deviation, Between>;

/// A number, and what is known about it.
struct Estimate {
  double value = 0.0;
  Uncertainty uncertainty = {};
  Digits digits = {};
  int n = 0;        ///< values behind it; 0 where it is no statistic
  int failed = 0;   ///< trials that should have given a value, and did not
  int not_run = 0;  ///< those that have not run yet
  bool best = false;
  std::optional<int> reached = {};        ///< of n, those that saw the event whose time it is
  std::vector<std::string> remarks = {};  ///< what a note says of this number; full sentences
  std::vector<double> each = {};          ///< the values behind it, where figures are to show them
};

/// Printed as a dash.
struct Missing {
  int failed = 0, not_run = 0;  ///< trials, none of which gave a value
  std::vector<std::string> remarks = {};
};

using Cell = std::variant<Missing, std::string, Estimate>;

/// A column holds texts or estimates of one kind of uncertainty, and either may be missing.
struct Column {
  std::string header;
  std::string unit = {};   ///< "" for none: `energy (Wh)`
  std::string group = {};  ///< a header over all neighbouring columns that name it
  std::string group_unit = {};
  std::string name = {};  ///< what CSV calls it: `energy_mean_wh`; default: group, header and unit
};

/// The table of the house: what `shoal solve` prints and what papers get.
struct Table {
  std::string name;  ///< letters, digits and `_.:-`; LaTeX refers to it as tab:NAME
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> notes;  ///< below it: what the uncertainties are, say
};

// The table in one of the forms below; each ends with a line break. Where estimates know their n, a
// note says it once; those that differ from most others, or had failures, carry a mark, and a note
// says what it stands for. A number of events is followed by how many trials saw it: `1350 +- 40
// (18 of 20)`.
//
// All throw std::invalid_argument for a table without columns, rows of another length, columns that
// mix kinds, numbers that are not finite, intervals whose ends are swapped, negative counts and
// uncertainties, and a name that is not fit for a label.

/// For terminals. Best values end with `*`.
std::string as_text(const Table& table);

/// RFC 4180 with `\n`; caption and notes are left out. An estimate takes columns of its own: `x`,
/// then `x_plus_minus`, `x_sd` or `x_low` and `x_high`, then `x_n` and `x_failed`, and `x_not_run`,
/// `x_best`, `x_reached`, `x_remarks` and `x_each` (values separated by blanks) where any is.
/// Numbers are in full precision. Of columns with one name, those with numbers keep it; labels
/// become `x_label`, and others `x_2`.
std::string as_csv(const Table& table);

/// A pipe table of GitHub. Best values are bold.
std::string as_markdown(const Table& table);

/// A table environment that needs booktabs, graphicx and siunitx (2 or 3), or, of one with
/// sentences, a longtable. Best values are bold.
std::string as_latex(const Table& table);

/// A table element with its caption, in a figure with its notes. Best values are strong.
std::string as_html(const Table& table);

}  // namespace shoal::analysis

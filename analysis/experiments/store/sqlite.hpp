#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace shoal::analysis {

/// What went wrong last, and what to do about it.
std::string last_error(sqlite3* connection);

/// A prepared statement of SQLite. Parameters count from 1, columns from 0.
class Statement {
 public:
  /// Throws SystemError if it is not one.
  Statement(sqlite3* connection, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int i, const std::string& text);
  void bind(int i, std::int64_t number);
  void bind(int i, const std::optional<double>& number);
  /// As their bytes; they must stay until the statement is reset or gone.
  void bind(int i, std::span<const double> numbers);

  /// Whether there is a row. Throws SystemError.
  bool step();
  /// Makes it ready to run again, with nothing bound.
  void reset();

  std::string text(int i) const;
  bool null(int i) const;

  // SQLite keeps values of any type in any column, and turns them into what is asked for: "abc"
  // into the number 0.
  bool holds_text(int i) const;
  bool holds_integer(int i) const;
  bool holds_number(int i) const;   ///< an integer or a real
  bool holds_numbers(int i) const;  ///< the bytes of a span of numbers

  std::int64_t integer(int i) const;
  std::optional<double> number(int i) const;
  std::vector<double> numbers(int i) const;

 private:
  sqlite3* connection_;
  sqlite3_stmt* statement_ = nullptr;
};

/// A place for a statement that is run again and again: to prepare one takes longer than to run it.
class KeptStatement {
 public:
  /// The statement, with nothing bound; made if it is the first one, or another than before.
  Statement& ready(sqlite3* connection, const std::string& sql);
  /// A connection with statements cannot be closed.
  void drop() { statement_.reset(); }

 private:
  std::string sql_;
  std::unique_ptr<Statement> statement_;
};

/// All that is written until commit(), or nothing of it.
class Transaction {
 public:
  explicit Transaction(sqlite3* connection);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit();

 private:
  sqlite3* connection_;
  bool done_ = false;
};

}  // namespace shoal::analysis

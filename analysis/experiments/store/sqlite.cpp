#include "shoal/analysis/experiments/store/sqlite.hpp"

#include <sqlite3.h>

#include <cstring>

#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

const char* advice(int code) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program holds it; wait until that has ended";
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_ERROR:  // a table or a column that every store has is missing
      return "the file is damaged; move it away and run the study again";
    case SQLITE_NOMEM:
      return "there is not enough memory; close other programs";
    default:
      return "check free space and permissions";
  }
}

[[noreturn]] void fail(sqlite3* connection) {
  const char* file = sqlite3_db_filename(connection, "main");
  throw SystemError("cannot use the store " + std::string(file ? file : "") + ": " +
                    last_error(connection));
}

}  // namespace

std::string last_error(sqlite3* connection) {
  return std::string(sqlite3_errmsg(connection)) + "; " +
         advice(sqlite3_extended_errcode(connection));
}

Statement::Statement(sqlite3* connection, const std::string& sql) : connection_(connection) {
  if (sqlite3_prepare_v2(connection, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) {
    fail(connection);
  }
}

Statement::~Statement() {
  sqlite3_finalize(statement_);
}

void Statement::bind(int i, const std::string& text) {
  sqlite3_bind_text(statement_, i, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
}

void Statement::bind(int i, std::int64_t number) {
  sqlite3_bind_int64(statement_, i, number);
}

void Statement::bind(int i, const std::optional<double>& number) {
  // SQLite keeps no NaN, and a measure has none: what has no value is null.
  if (number) {
    sqlite3_bind_double(statement_, i, *number);
  } else {
    sqlite3_bind_null(statement_, i);
  }
}

void Statement::bind(int i, std::span<const double> numbers) {
  // An empty span may have no address, which SQLite would take for null.
  const void* bytes = numbers.empty() ? "" : static_cast<const void*>(numbers.data());
  sqlite3_bind_blob64(statement_, i, bytes, numbers.size_bytes(), SQLITE_STATIC);
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    fail(connection_);
  }
  return code == SQLITE_ROW;
}

void Statement::reset() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

std::string Statement::text(int i) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, i));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, i)))
               : std::string();
}

bool Statement::null(int i) const {
  return sqlite3_column_type(statement_, i) == SQLITE_NULL;
}

bool Statement::holds_text(int i) const {
  return sqlite3_column_type(statement_, i) == SQLITE_TEXT;
}

bool Statement::holds_integer(int i) const {
  return sqlite3_column_type(statement_, i) == SQLITE_INTEGER;
}

bool Statement::holds_number(int i) const {
  return holds_integer(i) || sqlite3_column_type(statement_, i) == SQLITE_FLOAT;
}

bool Statement::holds_numbers(int i) const {
  return sqlite3_column_type(statement_, i) == SQLITE_BLOB &&
         static_cast<std::size_t>(sqlite3_column_bytes(statement_, i)) % sizeof(double) == 0;
}

std::int64_t Statement::integer(int i) const {
  return sqlite3_column_int64(statement_, i);
}

std::optional<double> Statement::number(int i) const {
  if (null(i)) return std::nullopt;
  return sqlite3_column_double(statement_, i);
}

std::vector<double> Statement::numbers(int i) const {
  std::vector<double> numbers(static_cast<std::size_t>(sqlite3_column_bytes(statement_, i)) /
                              sizeof(double));
  if (!numbers.empty()) {
    std::memcpy(numbers.data(), sqlite3_column_blob(statement_, i),
                numbers.size() * sizeof(double));
  }
  return numbers;
}

Statement& KeptStatement::ready(sqlite3* connection, const std::string& sql) {
  if (statement_ && sql_ == sql) {
    statement_->reset();
  } else {
    statement_ = std::make_unique<Statement>(connection, sql);
    sql_ = sql;
  }
  return *statement_;
}

Transaction::Transaction(sqlite3* connection) : connection_(connection) {
  Statement(connection, "BEGIN IMMEDIATE").step();
}

Transaction::~Transaction() {
  if (!done_) sqlite3_exec(connection_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  Statement(connection_, "COMMIT").step();
  done_ = true;
}

}  // namespace shoal::analysis

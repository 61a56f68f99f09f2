#include "shoal/analysis/experiments/store/store.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "shoal/analysis/experiments/store/sqlite.hpp"
#include "shoal/analysis/experiments/store/store_columns.hpp"
#include "shoal/analysis/experiments/store/stored_rows.hpp"
#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

constexpr const char* schema = R"(
  CREATE TABLE trial (
    trial_key TEXT PRIMARY KEY, trial_id TEXT NOT NULL, scenario_id TEXT NOT NULL,
    study_group TEXT NOT NULL, replication INTEGER NOT NULL, seed INTEGER NOT NULL,
    program TEXT NOT NULL, status TEXT NOT NULL, reason TEXT, wall_s REAL NOT NULL) WITHOUT ROWID;
  CREATE TABLE series (
    trial_key TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, meaning TEXT NOT NULL,
    time_s BLOB NOT NULL, numbers BLOB NOT NULL, PRIMARY KEY (trial_key, name)) WITHOUT ROWID;
  CREATE INDEX series_by_name ON series (name);
  CREATE TABLE factor (column_name TEXT PRIMARY KEY, place INTEGER NOT NULL);
  CREATE TABLE metric (column_name TEXT PRIMARY KEY, place INTEGER NOT NULL);
)";
constexpr int schema_version = 2;
constexpr int patience_ms = 5000;  // with a program that holds the file

}  // namespace

/// The connection, and the columns it knows.
struct Store::Database {
  sqlite3* connection = nullptr;
  fs::path file;
  StoreColumns columns;

  KeptStatement insert, forget, add_series;

  ~Database() {
    forget_statements();  // SQLite closes nothing while there are any
    sqlite3_close(connection);
  }
  void forget_statements() {
    for (KeptStatement* statement : {&insert, &forget, &add_series}) statement->drop();
  }

  [[noreturn]] void fail(const std::string& doing) const {
    throw SystemError("cannot " + doing + " " + file.string() + ": " + last_error(connection));
  }

  void run(const std::string& sql, const std::string& doing = "write") const {
    if (sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(doing);
  }

  void require_tables() const;
  void read_columns();
  void put(const StoredTrial& trial);
  void erase(const std::vector<std::string>& keys) const;
  void add_columns(const std::string& list, std::vector<std::string>& known,
                   const std::vector<std::string>& wanted, const std::string& type);
};

namespace {

std::vector<std::string> column_list(sqlite3* connection, const std::string& list) {
  std::vector<std::string> names;
  Statement select(connection, "SELECT column_name FROM " + list + " ORDER BY place");
  while (select.step()) names.push_back(select.text(0));
  return names;
}

}  // namespace

void Store::Database::require_tables() const {
  for (const char* table : {"trial", "series", "factor", "metric"}) {
    Statement find(connection, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = ?");
    find.bind(1, std::string(table));
    if (!find.step()) refuse_damaged(file, "it has no table " + std::string(table));
  }
}

void Store::Database::read_columns() {
  columns = {column_list(connection, "factor"), column_list(connection, "metric")};
}

void Store::Database::add_columns(const std::string& list, std::vector<std::string>& known,
                                  const std::vector<std::string>& wanted, const std::string& type) {
  for (const std::string& name : wanted) {
    if (std::ranges::find(known, name) != known.end()) continue;
    run("ALTER TABLE trial ADD COLUMN " +
        (list == "factor" ? factor_column(name) : measure_column(name)) + " " + type);
    Statement entry(connection, "INSERT INTO " + list + " VALUES (?, ?)");
    entry.bind(1, name);
    entry.bind(2, static_cast<std::int64_t>(known.size()));
    entry.step();
    known.push_back(name);
  }
}

Store::Store(const fs::path& folder, Access access) : database_(std::make_unique<Database>()) {
  Database& db = *database_;
  db.file = folder / "trials.sqlite";
  std::error_code ignored;
  const bool exists = fs::exists(db.file, ignored);
  if (access == Access::read && !exists) {
    throw InputError(folder.string() +
                     " holds no trials.sqlite; name a folder that shoal sweep wrote");
  }
  const int flags =
      access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  // An absolute path: SQLite may take one that begins with `file:` for an address.
  if (sqlite3_open_v2(fs::absolute(db.file).c_str(), &db.connection, flags, nullptr) != SQLITE_OK)
    db.fail("open");
  sqlite3_busy_timeout(db.connection, patience_ms);
  const int first =
      sqlite3_exec(db.connection, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr);
  if (first == SQLITE_NOTADB) {
    throw InputError(db.file.string() +
                     " is no store of trials; move it away, or choose another folder");
  }
  if (first != SQLITE_OK) db.fail("read");
  if (access == Access::write) {
    // Killed programs lose nothing that was committed, and a power cut leaves a store that is
    // whole.
    db.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL");
  }
  Statement version(db.connection, "PRAGMA user_version");
  version.step();
  const std::int64_t found = version.integer(0);
  if (found == 0 && access == Access::write) {
    Transaction transaction(db.connection);
    db.run(schema);
    db.run("PRAGMA user_version=" + std::to_string(schema_version));
    transaction.commit();
  } else if (found != schema_version) {
    throw InputError(db.file.string() +
                     " is no store of this version of shoal; choose another folder");
  }
  db.require_tables();
  db.read_columns();
}

Store::~Store() {
  // A store at rest is one file, which may also be read where nothing can be written. A reader
  // cannot change that, and need not.
  if (database_) database_->forget_statements();
  if (database_ && !sqlite3_db_readonly(database_->connection, "main")) {
    sqlite3_exec(database_->connection, "PRAGMA journal_mode=DELETE", nullptr, nullptr, nullptr);
  }
}

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

const fs::path& Store::file() const {
  return database_->file;
}

void Store::Database::put(const StoredTrial& trial) {
  std::vector<std::string> factor_names, measure_names;
  for (const auto& [name, label] : trial.factors) factor_names.push_back(name);
  for (const auto& [name, value] : trial.measures) measure_names.push_back(name);
  add_columns("factor", columns.factors, factor_names, "TEXT");
  // Without a type: a column of type REAL takes the sign from a zero.
  add_columns("metric", columns.measures, measure_names, "");

  std::string names = columns_of_every_trial;
  std::string places = "?, ?, ?, ?, ?, ?, ?, ?, ?, ?";
  for (const std::string& name : factor_names) names += ", " + factor_column(name), places += ", ?";
  for (const std::string& name : measure_names)
    names += ", " + measure_column(name), places += ", ?";
  Statement& row = insert.ready(
      connection, "INSERT OR REPLACE INTO trial (" + names + ") VALUES (" + places + ")");
  row.bind(1, trial.key);
  row.bind(2, trial.id);
  row.bind(3, trial.scenario);
  row.bind(4, trial.group);
  row.bind(5, static_cast<std::int64_t>(trial.replication));
  row.bind(6, trial.seed);
  row.bind(7, trial.program);
  row.bind(8, std::string(trial.failed() ? "failed" : "done"));
  row.bind(9, trial.failure);
  row.bind(10, std::optional(trial.wall_s));
  int place = 11;
  for (const auto& [name, label] : trial.factors) row.bind(place++, label);
  for (const auto& [name, value] : trial.measures) {
    if (value && std::isnan(*value)) {
      throw std::logic_error("the measure " + name + " of " + trial.key +
                             " is NaN; what has no value is null");
    }
    row.bind(place++, value);
  }
  row.step();

  Statement& old = forget.ready(connection, "DELETE FROM series WHERE trial_key = ?");
  old.bind(1, trial.key);
  old.step();
  for (const scenarios::Series& series : trial.series) {
    Statement& add = add_series.ready(connection, "INSERT INTO series VALUES (?, ?, ?, ?, ?, ?)");
    add.bind(1, trial.key);
    add.bind(2, series.name);
    add.bind(3, series.unit);
    add.bind(4, series.meaning);
    add.bind(5, std::span(series.time_s));
    add.bind(6, std::span(series.values));
    add.step();
  }
}

void Store::Database::erase(const std::vector<std::string>& keys) const {
  for (const char* table : {"trial", "series"}) {
    Statement remove(connection, std::string("DELETE FROM ") + table + " WHERE trial_key = ?");
    for (const std::string& key : keys) {
      remove.bind(1, key);
      remove.step();
      remove.reset();
    }
  }
}

void Store::together(const std::function<void()>& work) {
  Database& db = *database_;
  // Inside other work, it is part of that.
  if (sqlite3_get_autocommit(db.connection) == 0) return work();
  const StoreColumns before = db.columns;
  try {
    Transaction transaction(db.connection);
    work();
    transaction.commit();
  } catch (...) {
    db.columns = before;
    throw;
  }
}

void Store::write(const StoredTrial& trial) {
  together([&] { database_->put(trial); });
}

void Store::erase(const std::vector<std::string>& keys) {
  together([&] { database_->erase(keys); });
}

void Store::visit(const std::function<void(StoredTrial&)>& visitor,
                  const std::optional<std::vector<std::string>>& measures) const {
  const Database& db = *database_;
  TrialRows rows(db.connection, db.file, db.columns, measures ? *measures : db.columns.measures);
  while (rows.step()) {
    StoredTrial trial = rows.trial();
    visitor(trial);
  }
}

std::vector<StoredTrial> Store::trials(
    const std::optional<std::vector<std::string>>& measures) const {
  std::vector<StoredTrial> trials;
  visit([&](StoredTrial& trial) { trials.push_back(std::move(trial)); }, measures);
  return trials;
}

std::optional<StoredTrial> Store::find(const std::string& key) const {
  const Database& db = *database_;
  TrialRows rows(db.connection, db.file, db.columns, db.columns.measures, key);
  if (!rows.step()) return std::nullopt;
  return rows.trial();
}

std::vector<scenarios::Series> Store::series_of(const std::string& key) const {
  SeriesRows rows(database_->connection, database_->file, SeriesRows::Of::trial, key);
  std::vector<scenarios::Series> all;
  while (rows.step()) all.push_back(rows.series());
  return all;
}

std::vector<std::pair<std::string, scenarios::Series>> Store::series(
    const std::string& name) const {
  SeriesRows rows(database_->connection, database_->file, SeriesRows::Of::name, name);
  std::vector<std::pair<std::string, scenarios::Series>> all;
  while (rows.step()) all.emplace_back(rows.key(), rows.series());
  return all;
}

std::vector<std::string> Store::keys_with_series(const std::string& name) const {
  Statement select(database_->connection, "SELECT trial_key FROM series WHERE name = ?");
  select.bind(1, name);
  std::vector<std::string> keys;
  while (select.step()) keys.push_back(select.text(0));
  return keys;
}

std::vector<std::string> Store::measure_names() const {
  return database_->columns.measures;
}

std::vector<std::string> Store::series_names() const {
  std::vector<std::string> names;
  Statement select(database_->connection, "SELECT DISTINCT name FROM series ORDER BY name");
  while (select.step()) names.push_back(select.text(0));
  return names;
}

}  // namespace shoal::analysis

#include "shoal/analysis/experiments/store/store.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "shoal/analysis/experiments/store/sqlite.hpp"
#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

// The columns that come before those of factors ("f:NAME") and measures ("NAME").
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

std::string quoted_name(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace

/// The connection, and the columns it knows.
struct Store::Database {
  sqlite3* connection = nullptr;
  fs::path file;
  std::vector<std::string> factors, measures;

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

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError({file.string()},
                     why + "; the file is damaged, move it away and run the study again");
  }

  void run(const std::string& sql, const std::string& doing = "write") const {
    if (sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(doing);
  }

  void require_tables() const;
  void read_columns();
  void put(const StoredTrial& trial);
  void erase(const std::vector<std::string>& keys) const;
  /// The statement that reads `names`, with `condition`, and what a row of it says.
  std::string selecting(const std::vector<std::string>& names, const std::string& condition) const;
  StoredTrial read(const Statement& select, const std::vector<std::string>& names) const;
  scenarios::Series read_series(const Statement& select, int place, const std::string& name,
                                const std::string& key) const;
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

std::string factor_column(const std::string& name) {
  return quoted_name("f:" + name);
}

}  // namespace

void Store::Database::require_tables() const {
  for (const char* table : {"trial", "series", "factor", "metric"}) {
    Statement find(connection, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = ?");
    find.bind(1, std::string(table));
    if (!find.step()) refuse("it has no table " + std::string(table));
  }
}

void Store::Database::read_columns() {
  factors = column_list(connection, "factor");
  measures = column_list(connection, "metric");
}

void Store::Database::add_columns(const std::string& list, std::vector<std::string>& known,
                                  const std::vector<std::string>& wanted, const std::string& type) {
  for (const std::string& name : wanted) {
    if (std::ranges::find(known, name) != known.end()) continue;
    run("ALTER TABLE trial ADD COLUMN " +
        (list == "factor" ? factor_column(name) : quoted_name(name)) + " " + type);
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
  add_columns("factor", factors, factor_names, "TEXT");
  // Without a type: a column of type REAL takes the sign from a zero.
  add_columns("metric", measures, measure_names, "");

  std::string columns =
      "trial_key, trial_id, scenario_id, study_group, replication, seed, program, status, reason, "
      "wall_s";
  std::string places = "?, ?, ?, ?, ?, ?, ?, ?, ?, ?";
  for (const std::string& name : factor_names)
    columns += ", " + factor_column(name), places += ", ?";
  for (const std::string& name : measure_names)
    columns += ", " + quoted_name(name), places += ", ?";
  Statement& row = insert.ready(
      connection, "INSERT OR REPLACE INTO trial (" + columns + ") VALUES (" + places + ")");
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
  const std::vector<std::string> factors_before = db.factors, measures_before = db.measures;
  try {
    Transaction transaction(db.connection);
    work();
    transaction.commit();
  } catch (...) {
    db.factors = factors_before;
    db.measures = measures_before;
    throw;
  }
}

void Store::write(const StoredTrial& trial) {
  together([&] { database_->put(trial); });
}

void Store::erase(const std::vector<std::string>& keys) {
  together([&] { database_->erase(keys); });
}

std::string Store::Database::selecting(const std::vector<std::string>& names,
                                       const std::string& condition) const {
  std::string columns =
      "trial_key, trial_id, scenario_id, study_group, replication, seed, program, status, reason, "
      "wall_s";
  for (const std::string& name : factors) columns += ", " + factor_column(name);
  for (const std::string& name : names) {
    const bool known = std::ranges::find(measures, name) != measures.end();
    columns += known ? ", " + quoted_name(name) : std::string(", NULL");
  }
  return "SELECT " + columns + " FROM trial" + condition;
}

StoredTrial Store::Database::read(const Statement& select,
                                  const std::vector<std::string>& names) const {
  StoredTrial trial;
  trial.key = select.text(0);
  int place = 1;
  const auto require = [&](bool holds, const std::string& column, const char* what) {
    if (!holds) refuse("the trial " + trial.key + ": " + column + " holds no " + what);
  };
  const auto text = [&](const char* column) {
    require(select.holds_text(place), column, "text");
    return select.text(place++);
  };
  const auto integer = [&](const char* column) {
    require(select.holds_integer(place), column, "integer");
    return select.integer(place++);
  };
  trial.id = text("trial_id");
  trial.scenario = text("scenario_id");
  trial.group = text("study_group");
  const std::int64_t replication = integer("replication");
  require(std::in_range<int>(replication) && replication >= 0, "replication",
          "integer of 0 or more");
  trial.replication = static_cast<int>(replication);
  trial.seed = integer("seed");
  trial.program = text("program");
  const std::string status = text("status");
  require(status == "done" || status == "failed", "status", "\"done\" and no \"failed\"");
  if (status == "failed") {
    require(select.holds_text(place) && !select.text(place).empty(), "reason", "text");
    trial.failure = select.text(place);
  }
  ++place;
  require(select.holds_number(place), "wall_s", "number");
  trial.wall_s = *select.number(place++);
  for (const std::string& name : factors) {
    require(select.null(place) || select.holds_text(place), "f:" + name, "text");
    if (!select.null(place)) trial.factors.emplace_back(name, select.text(place));
    ++place;
  }
  for (const std::string& name : names) {
    require(select.null(place) || select.holds_number(place), name, "number");
    trial.measures.emplace_back(name, select.number(place++));
  }
  return trial;
}

void Store::visit(const std::function<void(StoredTrial&)>& visitor,
                  const std::optional<std::vector<std::string>>& measures) const {
  const Database& db = *database_;
  const std::vector<std::string>& wanted = measures ? *measures : db.measures;
  Statement select(db.connection, db.selecting(wanted, ""));
  while (select.step()) {
    StoredTrial trial = db.read(select, wanted);
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
  Statement select(db.connection, db.selecting(db.measures, " WHERE trial_key = ?"));
  select.bind(1, key);
  if (!select.step()) return std::nullopt;
  return db.read(select, db.measures);
}

/// A series in the columns from `place` on: unit, meaning, time_s, numbers.
scenarios::Series Store::Database::read_series(const Statement& select, int place,
                                               const std::string& name,
                                               const std::string& key) const {
  const auto refuse_it = [&](const std::string& why) {
    refuse("the series " + name + " of the trial " + key + " has " + why);
  };
  if (!select.holds_numbers(place + 2)) refuse_it("no numbers in time_s");
  if (!select.holds_numbers(place + 3)) refuse_it("no numbers in numbers");
  scenarios::Series series{name, select.text(place), select.text(place + 1),
                           select.numbers(place + 2), select.numbers(place + 3)};
  if (series.time_s.size() != series.values.size()) {
    refuse_it(
        fmt::format("{} instants and {} numbers", series.time_s.size(), series.values.size()));
  }
  return series;
}

std::vector<scenarios::Series> Store::series_of(const std::string& key) const {
  Statement select(database_->connection,
                   "SELECT name, unit, meaning, time_s, numbers FROM series WHERE trial_key = ? "
                   "ORDER BY name");
  select.bind(1, key);
  std::vector<scenarios::Series> all;
  while (select.step()) all.push_back(database_->read_series(select, 1, select.text(0), key));
  return all;
}

std::vector<std::pair<std::string, scenarios::Series>> Store::series(
    const std::string& name) const {
  Statement select(database_->connection,
                   "SELECT trial_key, unit, meaning, time_s, numbers FROM series WHERE name = ?");
  select.bind(1, name);
  std::vector<std::pair<std::string, scenarios::Series>> all;
  while (select.step()) {
    const std::string key = select.text(0);
    all.emplace_back(key, database_->read_series(select, 1, name, key));
  }
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
  return database_->measures;
}

std::vector<std::string> Store::series_names() const {
  std::vector<std::string> names;
  Statement select(database_->connection, "SELECT DISTINCT name FROM series ORDER BY name");
  while (select.step()) names.push_back(select.text(0));
  return names;
}

}  // namespace shoal::analysis

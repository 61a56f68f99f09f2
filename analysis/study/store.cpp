#include "shoal/analysis/study/store.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <span>

#include "shoal/analysis/study/sqlite.hpp"
#include "shoal/core/error.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

// The columns that come before those of factors ("f:NAME") and metrics ("NAME").
constexpr const char* schema = R"(
  CREATE TABLE trial (
    trial_key TEXT PRIMARY KEY, trial_id TEXT NOT NULL, study_group TEXT NOT NULL,
    replication INTEGER NOT NULL, seed INTEGER NOT NULL, program TEXT NOT NULL,
    status TEXT NOT NULL, reason TEXT, wall_s REAL NOT NULL) WITHOUT ROWID;
  CREATE TABLE series (
    trial_key TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, meaning TEXT NOT NULL,
    time_s BLOB NOT NULL, numbers BLOB NOT NULL, PRIMARY KEY (name, trial_key)) WITHOUT ROWID;
  CREATE TABLE factor (column_name TEXT PRIMARY KEY, place INTEGER NOT NULL);
  CREATE TABLE metric (column_name TEXT PRIMARY KEY, place INTEGER NOT NULL);
)";
constexpr int schema_version = 1;

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace

/// The connection, and the columns it knows.
struct Store::Database {
  sqlite3* connection = nullptr;
  fs::path file;
  std::vector<std::string> factors, metrics;

  ~Database() { sqlite3_close(connection); }

  [[noreturn]] void fail(const std::string& doing) const {
    throw SystemError("cannot " + doing + " " + file.string() + ": " + sqlite3_errmsg(connection) +
                      "; check free space and permissions");
  }

  void run(const std::string& sql, const std::string& doing = "write") const {
    if (sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(doing);
  }

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
  return quoted("f:" + name);
}

}  // namespace

void Store::Database::add_columns(const std::string& list, std::vector<std::string>& known,
                                  const std::vector<std::string>& wanted, const std::string& type) {
  for (const std::string& name : wanted) {
    if (std::ranges::find(known, name) != known.end()) continue;
    run("ALTER TABLE trial ADD COLUMN " + (list == "factor" ? factor_column(name) : quoted(name)) +
        " " + type);
    Statement insert(connection, "INSERT INTO " + list + " VALUES (?, ?)");
    insert.bind(1, name);
    insert.bind(2, static_cast<std::int64_t>(known.size()));
    insert.step();
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
  if (sqlite3_open_v2(db.file.c_str(), &db.connection, flags, nullptr) != SQLITE_OK)
    db.fail("open");
  sqlite3_busy_timeout(db.connection, 10000);
  if (sqlite3_exec(db.connection, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr,
                   nullptr) == SQLITE_NOTADB) {
    throw InputError(db.file.string() +
                     " is no store of trials; move it away, or choose another folder");
  }
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
  db.factors = column_list(db.connection, "factor");
  db.metrics = column_list(db.connection, "metric");
}

Store::~Store() {
  // A store at rest is one file, which may also be read where nothing can be written. A reader
  // cannot change that, and need not.
  if (database_ && !sqlite3_db_readonly(database_->connection, "main")) {
    sqlite3_exec(database_->connection, "PRAGMA journal_mode=DELETE", nullptr, nullptr, nullptr);
  }
}

Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

void Store::write(const StoredTrial& trial) {
  Database& db = *database_;
  const std::vector<std::string> factors_before = db.factors, metrics_before = db.metrics;
  try {
    Transaction transaction(db.connection);
    std::vector<std::string> factors, metrics;
    for (const auto& [name, label] : trial.factors) factors.push_back(name);
    for (const auto& [name, value] : trial.metrics) metrics.push_back(name);
    db.add_columns("factor", db.factors, factors, "TEXT");
    db.add_columns("metric", db.metrics, metrics, "REAL");

    std::string columns =
        "trial_key, trial_id, study_group, replication, seed, program, status, reason, wall_s";
    std::string places = "?, ?, ?, ?, ?, ?, ?, ?, ?";
    for (const std::string& name : factors) columns += ", " + factor_column(name), places += ", ?";
    for (const std::string& name : metrics) columns += ", " + quoted(name), places += ", ?";
    Statement insert(db.connection,
                     "INSERT OR REPLACE INTO trial (" + columns + ") VALUES (" + places + ")");
    insert.bind(1, trial.key);
    insert.bind(2, trial.id);
    insert.bind(3, trial.group);
    insert.bind(4, static_cast<std::int64_t>(trial.replication));
    insert.bind(5, trial.seed);
    insert.bind(6, trial.program);
    insert.bind(7, std::string(trial.failed() ? "failed" : "done"));
    insert.bind(8, trial.failure);
    insert.bind(9, std::optional(trial.wall_s));
    int place = 10;
    for (const auto& [name, label] : trial.factors) insert.bind(place++, label);
    for (const auto& [name, value] : trial.metrics) insert.bind(place++, value);
    insert.step();

    Statement forget(db.connection, "DELETE FROM series WHERE trial_key = ?");
    forget.bind(1, trial.key);
    forget.step();
    for (const scenarios::Series& series : trial.series) {
      Statement add(db.connection, "INSERT INTO series VALUES (?, ?, ?, ?, ?, ?)");
      add.bind(1, trial.key);
      add.bind(2, series.name);
      add.bind(3, series.unit);
      add.bind(4, series.meaning);
      add.bind(5, std::span(series.time_s));
      add.bind(6, std::span(series.values));
      add.step();
    }
    transaction.commit();
  } catch (...) {
    db.factors = factors_before;
    db.metrics = metrics_before;
    throw;
  }
}

void Store::erase(const std::vector<std::string>& keys) {
  Transaction transaction(database_->connection);
  for (const std::string& key : keys) {
    for (const char* table : {"trial", "series"}) {
      Statement remove(database_->connection,
                       std::string("DELETE FROM ") + table + " WHERE trial_key = ?");
      remove.bind(1, key);
      remove.step();
    }
  }
  transaction.commit();
}

std::vector<StoredTrial> Store::trials(
    const std::optional<std::vector<std::string>>& metrics) const {
  const Database& db = *database_;
  const std::vector<std::string>& wanted = metrics ? *metrics : db.metrics;
  std::string columns =
      "trial_id, study_group, replication, seed, program, status, reason, wall_s, trial_key";
  for (const std::string& name : db.factors) columns += ", " + factor_column(name);
  for (const std::string& name : wanted) {
    const bool known = std::ranges::find(db.metrics, name) != db.metrics.end();
    columns += known ? ", " + quoted(name) : std::string(", NULL");
  }
  Statement select(db.connection, "SELECT " + columns + " FROM trial");
  std::vector<StoredTrial> trials;
  while (select.step()) {
    StoredTrial& trial = trials.emplace_back();
    trial.id = select.text(0);
    trial.group = select.text(1);
    trial.replication = static_cast<int>(select.integer(2));
    trial.seed = select.integer(3);
    trial.program = select.text(4);
    if (select.text(5) == "failed") trial.failure = select.text(6);
    trial.wall_s = select.number(7).value_or(0.0);
    trial.key = select.text(8);
    int place = 9;
    for (const std::string& name : db.factors) {
      if (!select.null(place)) trial.factors.emplace_back(name, select.text(place));
      ++place;
    }
    for (const std::string& name : wanted) trial.metrics.emplace_back(name, select.number(place++));
  }
  return trials;
}

std::vector<std::pair<std::string, scenarios::Series>> Store::series(
    const std::string& name) const {
  Statement select(database_->connection,
                   "SELECT trial_key, unit, meaning, time_s, numbers FROM series WHERE name = ?");
  select.bind(1, name);
  std::vector<std::pair<std::string, scenarios::Series>> all;
  while (select.step()) {
    all.emplace_back(select.text(0), scenarios::Series{name, select.text(1), select.text(2),
                                                       select.numbers(3), select.numbers(4)});
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

std::vector<std::string> Store::metric_names() const {
  return database_->metrics;
}

std::vector<std::string> Store::series_names() const {
  std::vector<std::string> names;
  Statement select(database_->connection, "SELECT DISTINCT name FROM series ORDER BY name");
  while (select.step()) names.push_back(select.text(0));
  return names;
}

}  // namespace shoal::analysis

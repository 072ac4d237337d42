// The one file that knows SQLite.
#include "study/result_store.hpp"

#include <sqlite3.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace zwang::study {

namespace {

constexpr std::size_t most_pending = 256;  // cells of a transaction: a commit costs as much as ten of them

/// A name as SQL takes it, whatever is in it.
std::string in_quotes(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::vector<std::string> columns_of(const StudyIdentity& identity) {
  std::vector<std::string> columns{
      "cell INTEGER PRIMARY KEY", "of_matrix TEXT", "outcome TEXT", "because TEXT", "why TEXT",
      "simulated REAL",           "torque REAL",    "wall REAL"};
  for (const std::string& draw : identity.draws) columns.push_back(in_quotes(draw) + " REAL");
  for (std::size_t i = 1; i <= identity.claims.size(); ++i) {
    const std::string n = std::to_string(i);
    columns.insert(columns.end(),
                   {"held_" + n + " INTEGER", "margin_" + n + " REAL", "value_" + n + " REAL"});
  }
  return columns;
}

/// A statement with its values, given and taken in their order.
class Statement {
 public:
  Statement(sqlite3* handle, const std::string& path, const std::string& sql) : handle_(handle), path_(path) {
    if (sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) fail();
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void give(const std::string& text) {
    sqlite3_bind_text(statement_, ++given_, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void give(std::size_t number) {
    sqlite3_bind_int64(statement_, ++given_, static_cast<sqlite3_int64>(number));
  }
  /// Nothing and what is no number are null.
  void give(const std::optional<double>& number) {
    ++given_;
    if (number && !std::isnan(*number)) sqlite3_bind_double(statement_, given_, *number);
  }
  /// For other values.
  void begin_again() {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
    given_ = 0;
  }
  /// Whether there is a row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail();
    taken_ = 0;
    return code == SQLITE_ROW;
  }
  std::string text() {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, taken_));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, taken_++));
    return bytes == nullptr ? std::string() : std::string(bytes, size);
  }
  std::size_t count() { return static_cast<std::size_t>(sqlite3_column_int64(statement_, taken_++)); }
  std::optional<double> number() {
    const int column = taken_++;
    if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::nullopt;
    return sqlite3_column_double(statement_, column);
  }

 private:
  [[noreturn]] void fail() const { throw std::runtime_error(path_ + ": " + sqlite3_errmsg(handle_)); }

  sqlite3* handle_;
  const std::string& path_;
  sqlite3_stmt* statement_ = nullptr;
  int given_ = 0, taken_ = 0;
};

void put_into(Statement& statement, const CellRecord& record) {
  statement.give(record.cell);
  for (const std::string* text : {&record.of_matrix, &record.outcome, &record.because, &record.why})
    statement.give(*text);
  for (const double number : {record.simulated, record.torque, record.wall})
    statement.give(std::optional<double>(number));
  for (const double drawn : record.drawn) statement.give(std::optional<double>(drawn));
  for (const ExpectationRecord& one : record.expectations) {
    statement.give(std::size_t{one.held ? 1U : 0U});
    statement.give(one.margin);
    statement.give(one.value);
  }
  statement.step();
}

CellRecord taken_from(Statement& row, std::size_t draws, std::size_t claims) {
  CellRecord record;
  record.cell = row.count();
  for (std::string* text : {&record.of_matrix, &record.outcome, &record.because, &record.why})
    *text = row.text();
  for (double* number : {&record.simulated, &record.torque, &record.wall})
    *number = row.number().value_or(0.0);
  for (std::size_t i = 0; i < draws; ++i) record.drawn.push_back(row.number().value_or(0.0));
  for (std::size_t i = 0; i < claims; ++i) {
    const bool held = row.count() != 0;
    const std::optional<double> margin = row.number();
    record.expectations.push_back({held, margin, row.number()});
  }
  return record;
}

const char* const name_another = "name another one with --out";
const char* const leave_it_out = "leave it out of --merge";

/// The fingerprint of the study whose results the file holds; empty: it holds nothing yet. Throws, with the
/// advice, where it holds something else.
std::string fingerprint_in(sqlite3* handle, const std::string& path, const std::string& advice) {
  std::string reason = path + ": other tables";
  try {
    Statement tables(handle, path, "SELECT count(*) FROM sqlite_master");
    tables.step();
    if (tables.count() == 0) return {};
    Statement said(handle, path, "SELECT value FROM study WHERE key = 'fingerprint'");
    if (said.step()) return said.text();
  } catch (const std::runtime_error& error) {
    reason = error.what();
  }
  throw std::runtime_error(reason + ". This is no file of results: " + advice);
}

/// A file that is only read. Without a log beside it no process writes it, and SQLite need not write one
/// itself: it may be another's, or on a disk that cannot be written.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    constexpr std::string_view special = "%?#";
    const std::size_t which = special.find(c);
    uri += which == std::string_view::npos ? std::string(1, c) : std::array{"%25", "%3f", "%23"}[which];
  }
  std::error_code none;
  const auto size = std::filesystem::file_size(path + "-wal", none);
  return none || size == 0 ? uri + "?immutable=1" : uri;
}

/// Their real time alone or the memory of the machine may have ended them: another look may end otherwise.
constexpr const char* ended_by_the_machine = "outcome IN ('hung', 'crashed')";

}  // namespace

struct ResultStore::Database {
  explicit Database(const std::string& file, bool is_written = true) : path(file) {
    const int flags =
        is_written ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
    const std::string name = is_written ? path : uri_of(path);
    if (sqlite3_open_v2(name.c_str(), &handle, flags, nullptr) == SQLITE_OK) return;
    const std::string why = handle != nullptr ? sqlite3_errmsg(handle) : "out of memory";
    sqlite3_close(handle);
    throw std::runtime_error(path + ": " + why);
  }
  ~Database() {
    insert.reset();
    sqlite3_close(handle);
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void require(int code) const {
    if (code != SQLITE_OK && code != SQLITE_DONE && code != SQLITE_ROW)
      throw std::runtime_error(path + ": " + sqlite3_errmsg(handle));
  }
  void run(const std::string& sql) const {
    require(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr));
  }

  std::string path;
  sqlite3* handle = nullptr;
  std::optional<Statement> insert;  ///< a cell
  std::size_t pending = 0;          ///< cells of the open transaction
};

namespace {

/// In the order of the cells.
std::vector<CellRecord> records_that(sqlite3* handle, const std::string& path, const StudyIdentity& identity,
                                     const std::string& condition) {
  Statement rows(handle, path, "SELECT * FROM cells WHERE " + condition + " ORDER BY cell");
  std::vector<CellRecord> records;
  while (rows.step()) records.push_back(taken_from(rows, identity.draws.size(), identity.claims.size()));
  return records;
}

}  // namespace

StudyIdentity identity_of(const lang::Study& study, const std::string& fingerprint) {
  std::error_code absent;
  StudyIdentity identity{
      fingerprint, std::filesystem::weakly_canonical(study.path, absent).string(), {}, {}, study.claims};
  for (const lang::Draw& draw : study.draws) {
    identity.draws.push_back("draw." + draw.name);
    identity.units.push_back(draw.unit);
  }
  return identity;
}

ResultStore::ResultStore(const std::string& path, const StudyIdentity& identity)
    : database_(std::make_unique<Database>(path)), identity_(identity) {
  sqlite3* handle = database_->handle;
  constexpr int patience = 10'000;  // [ms]
  sqlite3_busy_timeout(handle, patience);
  const std::string found = fingerprint_in(handle, path, name_another);
  if (!found.empty() && found != identity.fingerprint)
    throw std::runtime_error(path +
                             ": holds the results of other files or of another version of zwang; "
                             "keep it and name another one with --out, or begin anew with --fresh");
  // Readers do not wait for the writer. A commit need not reach the disk at once: the log does.
  database_->run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;");
  if (found.empty()) make_tables();
  std::string places = "?";
  for (std::size_t i = 1; i < columns_of(identity).size(); ++i) places += ", ?";
  database_->insert.emplace(handle, database_->path, "INSERT OR REPLACE INTO cells VALUES (" + places + ")");
}

void ResultStore::make_tables() {
  const StudyIdentity& identity = identity_;
  sqlite3* handle = database_->handle;
  std::string columns;
  for (const std::string& column : columns_of(identity)) columns += (columns.empty() ? "" : ", ") + column;
  database_->run(
      "BEGIN IMMEDIATE; CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT);"
      "CREATE TABLE draws (number INTEGER PRIMARY KEY, name TEXT, unit TEXT);"
      "CREATE TABLE expectations (number INTEGER PRIMARY KEY, text TEXT, probability REAL, confidence "
      "REAL); CREATE TABLE cells (" +
      columns + ");");
  for (std::size_t i = 0; i < identity.draws.size(); ++i) {
    Statement draw(handle, database_->path, "INSERT INTO draws VALUES (?, ?, ?)");
    draw.give(i + 1);
    draw.give(identity.draws[i]);
    draw.give(identity.units[i]);
    draw.step();
  }
  for (std::size_t i = 0; i < identity.claims.size(); ++i) {
    Statement claim(handle, database_->path, "INSERT INTO expectations VALUES (?, ?, ?, ?)");
    claim.give(i + 1);
    claim.give(identity.claims[i].text);
    claim.give(identity.claims[i].probability);
    claim.give(std::optional<double>(identity.claims[i].confidence));
    claim.step();
  }
  Statement said(handle, database_->path, "INSERT INTO study VALUES ('fingerprint', ?), ('path', ?)");
  said.give(identity.fingerprint);
  said.give(identity.path);
  said.step();
  database_->run("COMMIT");
}

void ResultStore::require_results_of(const StudyIdentity& identity, const std::string& path) {
  if (!std::filesystem::exists(path)) return;
  const Database database(path, false);
  if (fingerprint_in(database.handle, path, name_another).empty()) return;
  Statement said(database.handle, path, "SELECT value FROM study WHERE key = 'path'");
  const std::string of = said.step() ? said.text() : identity.path;  // older files do not say it
  if (of == identity.path) return;
  throw std::runtime_error(path + ": holds the results of " + of + "; delete it yourself, or " +
                           name_another);
}

ResultStore::~ResultStore() {
  try {
    keep();
  } catch (const std::exception&) {  // cells that are not kept run again
  }
}

std::set<std::size_t> ResultStore::ended_cells() const {
  Statement rows(database_->handle, database_->path,
                 std::string("SELECT cell FROM cells WHERE NOT ") + ended_by_the_machine);
  std::set<std::size_t> cells;
  while (rows.step()) cells.insert(rows.count());
  return cells;
}

void ResultStore::put(const CellRecord& record) {
  Database& d = *database_;
  if (d.pending == 0) d.run("BEGIN IMMEDIATE");
  d.insert->begin_again();
  put_into(*d.insert, record);
  if (++d.pending == most_pending) keep();
}

void ResultStore::keep() {
  if (database_->pending == 0) return;
  database_->insert->begin_again();
  database_->run("COMMIT");
  database_->pending = 0;
}

std::vector<CellRecord> ResultStore::records(std::size_t runs, std::size_t first, std::size_t of) const {
  return records_that(
      database_->handle, database_->path, identity_,
      "cell < " + std::to_string(runs) + " AND cell % " + std::to_string(of) + " = " + std::to_string(first));
}

void ResultStore::merge(const std::string& path) {
  const Database other(path, false);
  const std::string found = fingerprint_in(other.handle, path, leave_it_out);
  if (found.empty())
    throw std::runtime_error(path + ": holds no results. Copy " + path + "-wal along with it, or " +
                             leave_it_out);
  if (found != identity_.fingerprint)
    throw std::runtime_error(path + ": holds the results of other files or of another version of zwang; " +
                             leave_it_out);
  for (const CellRecord& record :
       records_that(other.handle, path, identity_, std::string("NOT ") + ended_by_the_machine))
    put(record);
  const std::set<std::size_t> ended = ended_cells();
  for (const CellRecord& record : records_that(other.handle, path, identity_, ended_by_the_machine)) {
    if (!ended.contains(record.cell)) put(record);
  }
  keep();
}

}  // namespace zwang::study

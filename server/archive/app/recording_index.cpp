#include "server/archive/app/recording_index.h"

#include <fcntl.h>
#include <sqlite3.h>

#include <cerrno>
#include <optional>
#include <utility>

#include "common/io/fd.h"
#include "common/io/output_file.h"

namespace tandem::server {

namespace {

constexpr int kBusyMs = 5000;
constexpr int kVersion = 2;               // 1 had no parts of recordings
constexpr int kApplication = 0x54644d72;  // "TdMr"; tells this index from other databases
constexpr mode_t kIndexMode = 0640;

constexpr const char* kTables =
    "CREATE TABLE IF NOT EXISTS recording (file TEXT PRIMARY KEY, bytes INTEGER NOT NULL, modified_ns INTEGER NOT NULL,"
    " problem TEXT NOT NULL, session TEXT NOT NULL, scene TEXT NOT NULL, start_unix_ns INTEGER NOT NULL,"
    " duration_s REAL NOT NULL, rows INTEGER NOT NULL, missing_ticks INTEGER NOT NULL, complete INTEGER NOT NULL,"
    " session_id TEXT NOT NULL, epoch TEXT NOT NULL, recording TEXT NOT NULL, part INTEGER NOT NULL,"
    " last INTEGER, previous_file TEXT NOT NULL)"
    " STRICT;"
    "CREATE TABLE IF NOT EXISTS person (file TEXT NOT NULL REFERENCES recording ON DELETE CASCADE, place INTEGER NOT "
    "NULL, name TEXT NOT NULL, part TEXT NOT NULL, PRIMARY KEY (file, place)) STRICT;"
    "CREATE INDEX IF NOT EXISTS person_name ON person (name);";

/// A prepared statement. Parameters and columns are numbered from the left.
class Statement {
 public:
  Statement(sqlite3* database, const char* text) : database_(database) {
    if (sqlite3_prepare_v2(database, text, -1, &statement_, nullptr) != SQLITE_OK) statement_ = nullptr;
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(const std::string& text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(std::int64_t number) {
    sqlite3_bind_int64(statement_, ++bound_, number);
    return *this;
  }
  Statement& bind(std::optional<bool> flag) {
    if (flag) return bind(std::int64_t{*flag ? 1 : 0});
    sqlite3_bind_null(statement_, ++bound_);
    return *this;
  }
  Statement& bind(double number) {
    sqlite3_bind_double(statement_, ++bound_, number);
    return *this;
  }
  /// Takes the next row. @return whether there is one
  [[nodiscard]] bool next() {
    column_ = 0;
    result_ = sqlite3_step(statement_);
    return result_ == SQLITE_ROW;
  }
  [[nodiscard]] bool run() { return !next() && result_ == SQLITE_DONE; }
  /// Whether all rows were read without an error.
  [[nodiscard]] bool finished() const noexcept { return result_ == SQLITE_DONE; }

  [[nodiscard]] std::string text() {
    const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column_));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column_++));
    return bytes == nullptr ? std::string{} : std::string(bytes, size);
  }
  [[nodiscard]] std::int64_t whole() { return sqlite3_column_int64(statement_, column_++); }
  [[nodiscard]] std::optional<bool> flag() {
    const bool known = sqlite3_column_type(statement_, column_) != SQLITE_NULL;
    const std::int64_t value = whole();
    return known ? std::optional(value != 0) : std::nullopt;
  }
  [[nodiscard]] double real() { return sqlite3_column_double(statement_, column_++); }

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0, column_ = 0, result_ = SQLITE_OK;
};

std::int64_t stored(std::uint64_t number) { return static_cast<std::int64_t>(number); }

}  // namespace

void RecordingIndex::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

std::string RecordingIndex::error() const {
  const int code = sqlite3_errcode(database_.get());
  std::string text = path_ + ": ";
  const int reason = code == SQLITE_FULL ? ENOSPC : code == SQLITE_READONLY || code == SQLITE_PERM ? EACCES : 0;
  if (reason != 0) return text + io::write_error_text(reason);
  switch (code) {
    case SQLITE_BUSY:
      return text + "another process uses the index for longer than 5 s; repeat the command";
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return text + "it is damaged or no index (" + sqlite3_errmsg(database_.get()) +
             "); move it away and repeat: the scan of the folder makes a new one";
    default:
      return text + sqlite3_errmsg(database_.get());
  }
}

std::expected<RecordingIndex, std::string> RecordingIndex::open(const std::string& folder) {
  const std::string path = folder + "/" + kFile;
  // Created here, because SQLite would let every user read the file.
  const io::Fd made{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kIndexMode)};
  if (made.get() < 0) return std::unexpected(path + ": " + io::write_error_text(errno));
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr);
  RecordingIndex index(path, std::unique_ptr<sqlite3, Close>(database));
  if (database == nullptr) return std::unexpected(path + ": no memory");
  if (code != SQLITE_OK) return std::unexpected(index.error());
  sqlite3_busy_timeout(database, kBusyMs);
  if (std::string problem = index.prepare(); !problem.empty()) return std::unexpected(problem);
  return index;
}

std::string RecordingIndex::run(const char* statements) {
  return sqlite3_exec(database_.get(), statements, nullptr, nullptr, nullptr) == SQLITE_OK ? std::string{} : error();
}

std::string RecordingIndex::prepare() {
  const auto pragma = [this](const char* text) {
    Statement statement(database_.get(), text);
    return statement.next() ? std::optional<std::int64_t>(statement.whole()) : std::nullopt;
  };
  const auto application = pragma("PRAGMA application_id"), version = pragma("PRAGMA user_version"),
             objects = pragma("SELECT count(*) FROM sqlite_schema");
  if (!application || !version || !objects) return error();
  if (*objects > 0 && *application != kApplication)
    return path_ + " is a database of another program; move it away and repeat";
  if (*version > kVersion)
    return path_ + " was made by a newer version of tandem-server; use that version, or move the file away";
  if (std::string problem = run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON;"
                                "PRAGMA secure_delete = ON");
      !problem.empty())
    return problem;
  if (*objects > 0 && *version == kVersion) return {};
  // The rows of an older version are read again from the recordings.
  const std::string first =
      "BEGIN IMMEDIATE; DROP TABLE IF EXISTS person; DROP TABLE IF EXISTS recording; "
      "PRAGMA application_id = " +
      std::to_string(kApplication) + "; PRAGMA user_version = " + std::to_string(kVersion) + "; " + kTables + "COMMIT;";
  return run(first.c_str());
}

std::expected<std::vector<RecordingRow>, std::string> RecordingIndex::rows() const {
  std::vector<RecordingRow> rows;
  Statement all(database_.get(),
                "SELECT file, bytes, modified_ns, problem, session, scene, start_unix_ns, duration_s, rows, "
                "missing_ticks, complete, session_id, epoch, recording, part, last, previous_file FROM recording ORDER "
                "BY file");
  while (all.next()) {
    RecordingRow& row = rows.emplace_back();
    row.file = all.text();
    row.bytes = static_cast<std::uint64_t>(all.whole());
    row.modified_ns = all.whole();
    row.problem = all.text();
    row.summary.session = all.text();
    row.summary.scene = all.text();
    row.summary.start_unix_ns = all.whole();
    row.summary.duration_s = all.real();
    row.summary.rows = static_cast<std::uint64_t>(all.whole());
    row.summary.missing_ticks = static_cast<std::uint64_t>(all.whole());
    row.summary.complete = all.whole() != 0;
    RecordedPart& part = row.summary.part;
    part.session_id = all.text();
    part.epoch = all.text();
    part.recording = all.text();
    part.number = static_cast<unsigned>(all.whole());
    part.last = all.flag();
    part.previous_file = all.text();
  }
  if (!all.finished()) return std::unexpected(error());
  for (RecordingRow& row : rows) {
    Statement persons(database_.get(), "SELECT name, part FROM person WHERE file = ? ORDER BY place");
    persons.bind(row.file);
    while (persons.next()) {
      RecordedPerson& person = row.summary.persons.emplace_back();
      person.name = persons.text();
      person.part = persons.text();
    }
    if (!persons.finished()) return std::unexpected(error());
  }
  return rows;
}

std::string RecordingIndex::put_content(const RecordingRow& row) {
  const RecordingSummary& s = row.summary;
  Statement remove(database_.get(), "DELETE FROM recording WHERE file = ?");
  if (!remove.bind(row.file).run()) return error();
  Statement insert(database_.get(), "INSERT INTO recording VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(row.file).bind(stored(row.bytes)).bind(row.modified_ns).bind(row.problem).bind(s.session).bind(s.scene);
  insert.bind(s.start_unix_ns).bind(s.duration_s).bind(stored(s.rows)).bind(stored(s.missing_ticks));
  insert.bind(std::int64_t{s.complete ? 1 : 0}).bind(s.part.session_id).bind(s.part.epoch).bind(s.part.recording);
  insert.bind(std::int64_t{s.part.number}).bind(s.part.last).bind(s.part.previous_file);
  if (!insert.run()) return error();
  std::int64_t place = 0;
  for (const RecordedPerson& person : s.persons) {
    Statement add(database_.get(), "INSERT INTO person VALUES (?, ?, ?, ?)");
    if (!add.bind(row.file).bind(place++).bind(person.name).bind(person.part).run()) return error();
  }
  return {};
}

std::string RecordingIndex::put(const RecordingRow& row) {
  if (std::string problem = run("BEGIN IMMEDIATE"); !problem.empty()) return problem;
  std::string problem = put_content(row);
  if (problem.empty()) problem = run("COMMIT");
  if (!problem.empty()) static_cast<void>(run("ROLLBACK"));
  return problem;
}

std::string RecordingIndex::remove(const std::string& file) {
  Statement remove(database_.get(), "DELETE FROM recording WHERE file = ?");
  return remove.bind(file).run() ? std::string{} : error();
}

}  // namespace tandem::server

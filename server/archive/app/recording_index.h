#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "server/archive/recording_row.h"

struct sqlite3;

namespace tandem::server {

/// The index of a folder of recordings: a SQLite database in the folder. A killed process or a power cut leaves a
/// consistent index that may lack its last changes, which the next scan makes again (journal WAL, synchronous NORMAL).
/// Several processes may use it. It holds nothing that the recordings do not hold.
class RecordingIndex {
 public:
  static constexpr const char* kFile = "recordings.sqlite";

  /// Opens the index of a folder, and creates it if there is none. @return the index, or the error with its remedy
  [[nodiscard]] static std::expected<RecordingIndex, std::string> open(const std::string& folder);

  /// Returns all rows in the order of their file names, or the error.
  [[nodiscard]] std::expected<std::vector<RecordingRow>, std::string> rows() const;
  /// Adds a row, or replaces that of the same file. @return the error, empty if it is stored
  [[nodiscard]] std::string put(const RecordingRow& row);
  /// Removes the row of a file with all that the index knows of it. @return the error, empty if there is none
  [[nodiscard]] std::string remove(const std::string& file);

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };

  RecordingIndex(std::string path, std::unique_ptr<sqlite3, Close> database)
      : path_(std::move(path)), database_(std::move(database)) {}
  [[nodiscard]] std::string prepare();
  /// Runs statements without results. @return the error
  [[nodiscard]] std::string run(const char* statements);
  [[nodiscard]] std::string put_content(const RecordingRow& row);
  [[nodiscard]] std::string error() const;

  std::string path_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace tandem::server

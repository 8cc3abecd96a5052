#pragma once

#include <cstddef>
#include <expected>
#include <map>
#include <string>

#include "common/io/fd.h"

namespace tandem::netsim {

/// File of finished cells, so that an interrupted sweep continues where it ended. Text: a first line that names
/// program and cells, then one line per finished cell, `NUMBER CHECKSUM RESULT`, in the order in which they finished.
/// A line is appended as a whole and synced. A program that is killed leaves at most one line without its end, which
/// the next one removes. A write that fails, such as on a full disk, is undone.
class CellJournal {
 public:
  /// Values that results depend on: two sweeps with equal identities give equal results.
  struct Identity {
    std::string program;    ///< program_digest
    std::string cells;      ///< LoadedCells::digest
    std::size_t count = 0;  ///< number of cells
  };

  /// Opens or creates the file and locks it against other processes.
  /// Error: it cannot be used, another process uses it, it is damaged, or it has results of another program or of other
  /// cells; the text names the file, the reason and the remedy. Such a file stays unchanged.
  [[nodiscard]] static std::expected<CellJournal, std::string> open(const std::string& file, const Identity& identity);

  /// Returns the results that the file had when it was opened, by number of the cell.
  [[nodiscard]] const std::map<std::size_t, std::string>& finished() const noexcept { return finished_; }
  /// Appends the result of a cell. @param result  one line without line feed
  /// @return the error; empty: the result is on disk
  [[nodiscard]] std::string append(std::size_t number, const std::string& result);

 private:
  CellJournal(std::string name, io::Fd file) : name_(std::move(name)), file_(std::move(file)) {}
  [[nodiscard]] std::string read(const Identity& identity);
  [[nodiscard]] std::string read_line(std::string_view line, std::size_t number, const Identity& identity);
  [[nodiscard]] std::string append_line(const std::string& line);

  std::string name_;
  io::Fd file_;
  std::map<std::size_t, std::string> finished_;
};

}  // namespace tandem::netsim

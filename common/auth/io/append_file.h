#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "common/io/fd.h"

namespace tandem::auth {

/// An append-only file of whole lines in a state directory, which must outlive this object. Each call opens and locks
/// the file, so that several processes may append.
class AppendFile {
 public:
  /// Treatment of a last line without line feed, which a crash left. It is cut off (its write was never confirmed), or
  /// ended so that it is a readable line of its own. Appended text always begins on a new line.
  enum class TornLine { kCut, kEnded };
  AppendFile(const StateDirectory& folder, std::string name, TornLine torn = TornLine::kCut)
      : folder_(folder), name_(std::move(name)), torn_(torn) {}

  /// Appends whole lines and syncs them, under a lock on the file. A partial write is undone. A file with
  /// TornLine::kCut stays below StateDirectory::kFileMax; the other kind grows until `rotate`.
  /// @return the error, empty if the lines are on disk
  [[nodiscard]] std::string append(std::string_view lines) const;
  /// Renames the file to `name.1`, that to `name.2`, and so on, if it has more than `size_max` bytes. Removes files
  /// beyond `name.older`.
  /// @param older  rotated files kept, at least 1  @return number of bytes moved, 0: the file is small enough; or the
  /// error
  [[nodiscard]] std::expected<std::uint64_t, std::string> rotate(std::uint64_t size_max, std::uint32_t older) const;
  /// Returns why the file could not be appended to; empty: it could. Nothing is written.
  [[nodiscard]] std::string problem() const;

 private:
  /// Opens and locks the file; creates it if it is missing.
  [[nodiscard]] std::expected<io::Fd, std::string> open_locked() const;
  [[nodiscard]] std::uint64_t size_max() const noexcept;

  const StateDirectory& folder_;
  std::string name_;
  TornLine torn_;
};

}  // namespace tandem::auth

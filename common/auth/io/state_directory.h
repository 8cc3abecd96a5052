#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/base/secret.h"
#include "common/io/fd.h"

namespace tandem::auth {

/// A directory that only its owner may read (0700), with files of mode 0600. Files readable by others, files of another
/// owner and links of other users are rejected with the remedy. They are never repaired silently, because another user
/// may have read them already. Files are replaced whole: written to a temporary file, synced and renamed, so that a
/// crash leaves the old or the new one.
class StateDirectory {
 public:
  static constexpr std::size_t kFileMax = 8U << 20;

  enum class Missing { kIsAnError, kIsMade };
  /// @param hint  for users, after "there is no such folder": the command to run
  [[nodiscard]] static std::expected<StateDirectory, std::string> open(const std::string& path, Missing missing,
                                                                       std::string_view hint = {});

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string path_of(std::string_view name) const { return path_ + "/" + std::string(name); }

  [[nodiscard]] bool has(const std::string& name) const noexcept;
  /// @return the file's bytes, nullopt if there is no such file, or the error
  [[nodiscard]] std::expected<std::optional<SecretBuffer>, std::string> read(const std::string& name) const;
  /// @return the error, empty if the data are on disk
  [[nodiscard]] std::string replace(const std::string& name, std::span<const std::byte> bytes) const;
  [[nodiscard]] std::string replace(const std::string& name, std::string_view text) const;
  /// Treatment of a last line without line feed, which a crash left. It is cut off (its write was never confirmed), or
  /// ended so that it is a readable line of its own. Appended text always begins on a new line.
  enum class TornLine { kCut, kEnded };
  /// Appends whole lines and syncs them, under a lock on the file, so that several processes may append. A partial
  /// write is undone. A file with TornLine::kCut stays below kFileMax; the other kind grows until `rotate`.
  /// @return the error, empty if the lines are on disk
  [[nodiscard]] std::string append(const std::string& name, std::string_view lines,
                                   TornLine torn = TornLine::kCut) const;
  /// Renames `name` to `name.1`, that to `name.2`, and so on, if it has more than `size_max` bytes. Removes files
  /// beyond `name.older`.
  /// @param older  rotated files kept, at least 1  @return number of bytes moved, 0: the file is small enough; or the
  /// error
  [[nodiscard]] std::expected<std::uint64_t, std::string> rotate(const std::string& name, std::uint64_t size_max,
                                                                 std::uint32_t older) const;
  /// Returns why no file could be created here, or why `name` could not be appended to; empty: it could. Nothing is
  /// written.
  [[nodiscard]] std::string write_problem() const;
  [[nodiscard]] std::string append_problem(const std::string& name, TornLine torn = TornLine::kCut) const;
  [[nodiscard]] std::string remove(const std::string& name) const;
  /// Removes temporary files of processes that died during a replacement. Call under the lock of such processes.
  void remove_leftovers() const noexcept;

  /// Changes when a file is replaced or written; 0 if there is none. Costs one system call.
  struct Stamp {
    std::uint64_t inode = 0, size = 0;
    std::int64_t changed_ns = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  [[nodiscard]] Stamp stamp(const std::string& name) const noexcept;

  /// Locks `name` against other processes as long as it exists.
  using Lock = io::Fd;
  static constexpr std::chrono::milliseconds kLockTimeout{5000};
  /// Waits for the lock. After a timeout the error names the process that holds it, if the system reports that.
  /// @param patience  timeout
  [[nodiscard]] std::expected<Lock, std::string> lock(const std::string& name,
                                                      std::chrono::milliseconds patience = kLockTimeout) const;
  /// @return nullopt if another process holds the lock
  [[nodiscard]] std::expected<std::optional<Lock>, std::string> try_lock(const std::string& name) const;
  /// Returns the process that holds `name`, for users: `process 1234 (tandem-server)`, or `another process` if the
  /// system does not report it.
  [[nodiscard]] std::string holder_of(const std::string& name) const;

 private:
  StateDirectory(std::string path, io::Fd folder) : path_(std::move(path)), folder_(std::move(folder)) {}
  [[nodiscard]] std::string trouble(const std::string& name, std::string_view doing) const;
  [[nodiscard]] std::string wrong_with(int fd, const std::string& name, std::uint64_t size_max = kFileMax) const;
  /// Opens and locks a file; creates it if it is missing.
  [[nodiscard]] std::expected<io::Fd, std::string> open_to_append(const std::string& name, TornLine torn) const;
  /// @return false: it was not free in time
  [[nodiscard]] static bool wait_for(int fd, std::chrono::milliseconds patience) noexcept;

  std::string path_;
  io::Fd folder_;
};

/// Returns the state directory of a server: `option`, else $TANDEM_STATE, else /var/lib/tandem if this user may write
/// there, else ~/.local/state/tandem.
[[nodiscard]] std::expected<std::string, std::string> server_state_path(const std::string& option);
/// Returns ` --state DIR` for commands that must find this directory of a server; empty where they find it without the
/// option.
[[nodiscard]] std::string server_state_option(const std::string& folder);
/// Returns the state directory of a workstation: `option`, else $TANDEM_CLIENT_STATE, else ~/.config/tandem.
[[nodiscard]] std::expected<std::string, std::string> client_state_path(const std::string& option);
/// Returns the directory shared by servers and clients of one user on one machine: $TANDEM_RUNTIME, else
/// $XDG_RUNTIME_DIR/tandem, else /run/user/UID/tandem if this user owns /run/user/UID, else /tmp/tandem-UID.
/// @param users  parent of the users' runtime directories
[[nodiscard]] std::string runtime_path(const std::string& users = "/run/user");

/// Fills `out` with random bytes of the operating system.
void fill_random(std::span<std::byte> out) noexcept;
template <class T>
[[nodiscard]] T random_bytes() {
  T out{};
  fill_random(out);
  return out;
}
/// Returns the seconds since 1970, UTC.
[[nodiscard]] std::int64_t wall_seconds() noexcept;

}  // namespace tandem::auth

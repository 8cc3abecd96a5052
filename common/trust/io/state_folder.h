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

namespace tandem::trust {

/// A folder that only its owner may look into (0700), with files only he may read (0600). Whatever is readable by others, belongs to
/// somebody else, or is a stranger's link is refused with the remedy, never mended silently: somebody may have read it already.
/// Files are replaced whole: written beside, synced, renamed, so that a crash leaves the old or the new one.
class StateFolder {
 public:
  static constexpr std::size_t kFileMax = 8U << 20;

  enum class Missing { kIsAnError, kIsMade };
  /// @param hint  for a person, after "there is no such folder": what to run
  [[nodiscard]] static std::expected<StateFolder, std::string> open(const std::string& path, Missing missing, std::string_view hint = {});

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string path_of(std::string_view name) const { return path_ + "/" + std::string(name); }

  [[nodiscard]] bool has(const std::string& name) const noexcept;
  /// @return the file's bytes, nothing if there is no such file, or what is wrong with it
  [[nodiscard]] std::expected<std::optional<SecretBuffer>, std::string> read(const std::string& name) const;
  /// @return what is wrong, empty if it is on disk
  [[nodiscard]] std::string replace(const std::string& name, std::span<const std::byte> bytes) const;
  [[nodiscard]] std::string replace(const std::string& name, std::string_view text) const;
  /// What becomes of a last line without a line feed, which a crash left: it is cut off (nobody was told that it is there), or ended, so
  /// that it stands alone and can be read. Whatever is appended begins on a line of its own.
  enum class TornLine { kCut, kEnded };
  /// Adds whole lines at the end and syncs them, under a lock on the file, so that several processes may append. What could not be written
  /// whole is taken back. A file whose torn line is cut stays below kFileMax, the other kind grows until `rotate`.
  /// @return what is wrong, empty if it is on disk
  [[nodiscard]] std::string append(const std::string& name, std::string_view lines, TornLine torn = TornLine::kCut) const;
  /// Renames `name` to `name.1`, that to `name.2`, and so on, if it has more than `size_max` bytes. Removes what would be beyond `name.older`.
  /// @param older  files kept beside it, at least 1  @return how many bytes were moved, 0: it is short enough; or what is wrong
  [[nodiscard]] std::expected<std::uint64_t, std::string> rotate(const std::string& name, std::uint64_t size_max, std::uint32_t older) const;
  /// Why no file could be made here, or `name` not be appended to; empty: it could. Nothing is written.
  [[nodiscard]] std::string unfit_to_write() const;
  [[nodiscard]] std::string unfit_to_append(const std::string& name, TornLine torn = TornLine::kCut) const;
  [[nodiscard]] std::string remove(const std::string& name) const;
  /// Removes what processes that died left beside the files they were replacing. Under the lock that such processes hold.
  void remove_leftovers() const noexcept;

  /// Changes when a file was replaced or written to; 0 if there is none. Costs one system call.
  struct Stamp {
    std::uint64_t inode = 0, size = 0;
    std::int64_t changed_ns = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  [[nodiscard]] Stamp stamp(const std::string& name) const noexcept;

  /// Holds `name` against other processes until it goes.
  using Lock = io::Fd;
  static constexpr std::chrono::milliseconds kLockPatience{5000};
  /// Waits for its holder, for at most `patience`; then the error names the holder's process, if the system tells.
  [[nodiscard]] std::expected<Lock, std::string> lock(const std::string& name, std::chrono::milliseconds patience = kLockPatience) const;
  /// @return nothing if another process has it
  [[nodiscard]] std::expected<std::optional<Lock>, std::string> try_lock(const std::string& name) const;
  /// The process that holds `name`, for a person: `process 1234 (tandem-server)`; `another process` if the system does not tell.
  [[nodiscard]] std::string holder_of(const std::string& name) const;

 private:
  StateFolder(std::string path, io::Fd folder) : path_(std::move(path)), folder_(std::move(folder)) {}
  [[nodiscard]] std::string trouble(const std::string& name, std::string_view doing) const;
  [[nodiscard]] std::string wrong_with(int fd, const std::string& name, std::uint64_t size_max = kFileMax) const;
  /// Opened and locked; made if it is missing.
  [[nodiscard]] std::expected<io::Fd, std::string> open_to_append(const std::string& name, TornLine torn) const;
  /// @return false: it was not free in time
  [[nodiscard]] static bool wait_for(int fd, std::chrono::milliseconds patience) noexcept;

  std::string path_;
  io::Fd folder_;
};

/// Where a server keeps its state: `option`, else $TANDEM_STATE, else /var/lib/tandem if this user may write there, else
/// ~/.local/state/tandem.
[[nodiscard]] std::expected<std::string, std::string> server_state_path(const std::string& option);
/// ` --state DIR` for commands that shall find this folder of a server; empty where they find it by themselves.
[[nodiscard]] std::string server_state_option(const std::string& folder);
/// Where a workstation does: `option`, else $TANDEM_CLIENT_STATE, else ~/.config/tandem.
[[nodiscard]] std::expected<std::string, std::string> client_state_path(const std::string& option);
/// Where servers and clients of one user on one machine meet: $TANDEM_RUNTIME, else $XDG_RUNTIME_DIR/tandem, else /run/user/UID/tandem if
/// /run/user/UID is this user's own folder, else /tmp/tandem-UID.
/// @param users  where the folders of users are
[[nodiscard]] std::string runtime_path(const std::string& users = "/run/user");

/// Random bytes of the operating system.
void fill_random(std::span<std::byte> out) noexcept;
template <class T>
[[nodiscard]] T random_bytes() {
  T out{};
  fill_random(out);
  return out;
}
/// Seconds since 1970, UTC.
[[nodiscard]] std::int64_t wall_seconds() noexcept;

}  // namespace tandem::trust

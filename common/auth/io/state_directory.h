#pragma once

#include <sys/types.h>

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
  /// Whether a replacement waits for the disk. Without it a power cut may leave an empty file: only for a file that
  /// each start writes again.
  enum class Sync { kYes, kNo };
  /// @return the error, empty if the data are on disk (kYes) or with the system (kNo)
  [[nodiscard]] std::string replace(const std::string& name, std::span<const std::byte> bytes,
                                    Sync sync = Sync::kYes) const;
  [[nodiscard]] std::string replace(const std::string& name, std::string_view text, Sync sync = Sync::kYes) const;
  /// Returns why no file of 16 KiB could be written here; empty: it could. Writes such a file, and removes it.
  [[nodiscard]] std::string write_problem() const;
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

  // ---- For the classes of files in the directory ----
  static constexpr mode_t kFileMode = 0600;
  /// Returns the open directory.
  [[nodiscard]] int fd() const noexcept { return folder_.get(); }
  /// Returns the text for a failed call on `name`: `doing` is what failed, errno the reason.
  [[nodiscard]] std::string call_error(const std::string& name, std::string_view doing) const;
  /// Returns why an open file must not be used: its kind, owner, mode or size; empty: it may be.
  [[nodiscard]] std::string file_problem(int fd, const std::string& name, std::uint64_t size_max = kFileMax) const;

 private:
  StateDirectory(std::string path, io::Fd folder) : path_(std::move(path)), folder_(std::move(folder)) {}

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

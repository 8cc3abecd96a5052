#pragma once

#include <chrono>
#include <expected>
#include <optional>
#include <string>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "common/io/fd.h"

namespace tandem::auth {

/// Lock on a file of a state directory against other processes, until it is released or destroyed. The file is created
/// if it is missing.
class DirectoryLock {
 public:
  static constexpr std::chrono::milliseconds kTimeout{5000};

  /// A lock that holds nothing.
  DirectoryLock() = default;
  /// Waits for the lock. After a timeout the error names the process that holds it, if the system reports that.
  /// @param timeout  longest wait
  [[nodiscard]] static std::expected<DirectoryLock, std::string> wait(const StateDirectory& folder,
                                                                      const std::string& name,
                                                                      std::chrono::milliseconds timeout = kTimeout);
  /// @return nullopt if another process holds the lock
  [[nodiscard]] static std::expected<std::optional<DirectoryLock>, std::string> attempt(const StateDirectory& folder,
                                                                                        const std::string& name);
  /// Waits for the lock on an open file. @return false: it was not free in time; errno holds the reason
  [[nodiscard]] static bool wait_for(int fd, std::chrono::milliseconds timeout) noexcept;
  /// Returns the process that holds `name`, for users: `process 1234 (tandem-server)`, or `another process` if the
  /// system does not report it.
  [[nodiscard]] static std::string holder_of(const StateDirectory& folder, const std::string& name);

  [[nodiscard]] bool held() const noexcept { return file_.open(); }
  void release() noexcept { file_.reset(); }

 private:
  explicit DirectoryLock(io::Fd file) noexcept : file_(std::move(file)) {}

  io::Fd file_;
};

}  // namespace tandem::auth

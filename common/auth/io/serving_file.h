#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>

#include "common/auth/io/directory_lock.h"
#include "common/auth/io/state_directory.h"
#include "proto/spec/registry_spec.h"

namespace tandem::auth {

/// Messages between a running server and the commands beside it, in the state directory: which process serves, its
/// description, and a request to end. Without a directory nothing is written and nothing is read.
class ServingFile {
 public:
  static constexpr const char* kFile = "serving.textproto";
  static constexpr const char* kLock = "serving.lock";
  static constexpr const char* kEndFile = "end_in_s";
  static constexpr const char* kServiceFile = "service_sessions";  ///< of the service, while a member of one runs

  /// @param lists_lock  file that commands lock while they check for a running server
  ServingFile(std::shared_ptr<const StateDirectory> folder, const char* lists_lock)
      : folder_(std::move(folder)), lists_lock_(lists_lock) {}
  /// Removes the description, if this process serves.
  ~ServingFile();
  ServingFile(ServingFile&&) noexcept = default;
  ServingFile& operator=(ServingFile&&) noexcept = default;

  /// Marks this process as the one that serves from the directory. @return the error, such as another running server
  [[nodiscard]] std::string begin();
  /// Describes this server for commands. @return the error
  [[nodiscard]] std::string write(const ServingSpec& serving) const;
  /// Returns a request to end made since `begin`, once: the time for the drain [s]. Costs one system call.
  [[nodiscard]] std::optional<std::uint32_t> requested_shutdown() const;

  // ---- For commands ----
  /// Returns the description of the running server; nullopt: no server is running.
  [[nodiscard]] std::expected<std::optional<ServingSpec>, std::string> read() const;
  /// Requests the running server to end: it rejects new joins at once and disengages all hands in `grace_s`.
  /// @return the error
  [[nodiscard]] std::string request_shutdown(std::uint32_t grace_s) const;

 private:
  std::shared_ptr<const StateDirectory> folder_;  ///< null: no directory
  const char* lists_lock_;
  DirectoryLock serving_;  ///< held by the serving process
};

}  // namespace tandem::auth

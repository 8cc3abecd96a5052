#pragma once

#include <asio/io_context.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "common/auth/audit_throttle.h"
#include "common/auth/io/server_keystore.h"
#include "server/app/control/control_event.h"

namespace tandem::server {

/// Returns the end of an audit line's detail that names the person behind it; empty without a name.
[[nodiscard]] std::string by_person(const std::string& name);

/// State of the audit log.
struct AuditState {
  std::string trouble{};       ///< current write error; empty: none
  std::uint64_t lost = 0;      ///< lines that could not be written
  std::uint64_t left_out = 0;  ///< lines about rejected peers that the throttle suppressed
};

/// Writer of a server's audit log: all joins, rejections up to a limit per source, and the events of sessions. It
/// reports when the log fails and when it recovers. Without a state directory nothing is written. All members except
/// `post` run on the control plane's thread.
class AuditWriter {
 public:
  /// @param on_event    receives failures of the log
  /// @param on_message  receives other messages about the log, one line each, for the operator of the server
  AuditWriter(asio::io_context& context, auth::ServerKeystore& trust,
              const std::function<void(const ControlEventRecord&)>& on_event,
              const std::function<void(const std::string&)>& on_message)
      : context_(context), trust_(trust), on_event_(on_event), on_message_(on_message) {}

  /// Writes a join or a rejection. @return false if the source has too many such lines
  [[nodiscard]] bool record(const ControlEventRecord& news);
  /// Appends an event of a session. Thread-safe, does not wait.
  /// @param author  returns the name of the person behind it, on the control plane's thread; empty: not named
  void post(std::string_view event, std::string session, std::string detail, std::function<std::string()> author = {});
  /// Writes pending lines, and reports when the log fails and when it recovers. Call it once per second.
  void service();
  /// Writes pending lines before the server ends.
  void close();
  [[nodiscard]] AuditState state() const;

 private:
  asio::io_context& context_;
  auth::ServerKeystore& trust_;
  std::function<void(const ControlEventRecord&)> on_event_;
  std::function<void(const std::string&)> on_message_;
  auth::AuditThrottle throttle_;
  std::uint64_t lost_reported_ = 0;  ///< lost lines that were reported
  bool fails_ = false;               ///< a failure was reported
};

}  // namespace tandem::server

#pragma once

#include <expected>
#include <functional>
#include <string>

#include "common/io/fd.h"

namespace tandem::netsim {

/// Server end of the proxy's control channel: a Unix socket that only its owner may use (mode 0600). A control client
/// connects, sends one line and receives the answer.
class ControlSocket {
 public:
  ControlSocket() = default;
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  /// Opens the socket. Replaces an unused socket of an earlier proxy; rejects a socket in use or another kind of file.
  /// @return error, or empty on success
  [[nodiscard]] std::string open(const std::string& path);
  /// Returns the descriptor to poll; -1 when not open.
  [[nodiscard]] int fd() const noexcept { return fd_.get(); }
  /// Serves all pending connections: `answer` gets the line and returns the reply. A connection that sends nothing for
  /// 1 s is closed.
  void serve(const std::function<std::string(const std::string& line)>& answer);

 private:
  std::string path_;
  io::Fd fd_;
};

/// Sends a line to the proxy that listens at `path`.
/// @param stop_fd  readable: cancels the wait; -1: no cancellation
/// @return answer (empty if `stop_fd` came first), or an error
[[nodiscard]] std::expected<std::string, std::string> send_control_request(const std::string& path,
                                                                           const std::string& line, int stop_fd = -1);

}  // namespace tandem::netsim

#pragma once

#include <expected>
#include <functional>
#include <string>

#include "common/io/fd.h"

namespace tandem::netsim {

/// The end of a control channel in the proxy: a Unix socket that only its owner may use (mode 0600). Whoever connects
/// sends one line and gets the answer.
class ControlSocket {
 public:
  ControlSocket() = default;
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  /// A socket that a proxy left behind is replaced, one that is in use or another kind of file is not.
  /// @return what is wrong, empty if nothing
  [[nodiscard]] std::string open(const std::string& path);
  /// To wait for; -1 when not open.
  [[nodiscard]] int fd() const noexcept { return fd_.get(); }
  /// Serves everybody who waits: `answer` gets the line, and gives what is sent back. Someone who says nothing for a
  /// second is sent away.
  void serve(const std::function<std::string(const std::string& line)>& answer);

 private:
  std::string path_;
  io::Fd fd_;
};

/// Sends a line to the proxy that listens at `path`.
/// @param stop_fd  readable: whoever asks does not want to wait any more; -1: waits
/// @return its answer, empty if `stop_fd` was first, or why there is none
[[nodiscard]] std::expected<std::string, std::string> ask_control(const std::string& path, const std::string& line, int stop_fd = -1);

}  // namespace tandem::netsim

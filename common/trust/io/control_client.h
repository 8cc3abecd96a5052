#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/io/socket_address.h"
#include "common/trust/io/control_stream.h"
#include "proto/control_messages.h"

namespace tandem::trust {

/// Why a client got no answer.
struct ClientFault {
  enum class Kind { kUnreachable, kRefusedKey, kStream, kBadFrame, kInterrupted } kind = Kind::kStream;
  StreamEnd end = StreamEnd::kTrouble;  ///< kStream
  std::string text;                     ///< for a person
};

/// A client's control connection that blocks the calling thread, each step with a deadline, and gives up at once when `signals` becomes
/// readable (signals.h; -1: nothing interrupts). For one thread.
class ControlClient {
 public:
  using Duration = std::chrono::milliseconds;

  /// Connects, proves both keys. `judge` sees the server's key before anything of value was sent (ClientTls).
  [[nodiscard]] static std::expected<ControlClient, ClientFault> connect(const io::SocketAddress& server, ClientTls::Judge judge, Duration patience, int signals);
  ~ControlClient();
  ControlClient(ControlClient&&) noexcept;
  ControlClient& operator=(ControlClient&&) noexcept;

  /// Sends a frame under the next request number and waits for the answer to it.
  [[nodiscard]] std::expected<control::Body, ClientFault> ask(const control::Body& body, Duration patience);

  /// For poll: readable while nothing was asked means that the server has ended the connection.
  [[nodiscard]] int fd() const noexcept;
  [[nodiscard]] const Pin& server() const noexcept;
  [[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(const LinkContext& context);

 private:
  struct State;
  explicit ControlClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tandem::trust

#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/auth/io/control_stream.h"
#include "common/io/socket_address.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::auth {

/// Reason why a client received no reply.
struct ClientError {
  enum class Kind { kUnreachable, kRefusedKey, kStream, kBadFrame, kInterrupted } kind = Kind::kStream;
  StreamErrorCode end = StreamErrorCode::kNetwork;  ///< for kStream
  std::string text;                                 ///< for users
  bool absent = false;                              ///< for kUnreachable: no program listens there
};

/// A client's control connection with blocking calls. Each step has a deadline and ends at once when `signals` becomes
/// readable (signals.h; -1: no interruption). For one thread.
class ControlClient {
 public:
  using Duration = std::chrono::milliseconds;

  /// Connects and authenticates both keys. `judge` receives the server's key before any sensitive data are sent
  /// (ClientTls).
  [[nodiscard]] static std::expected<ControlClient, ClientError> connect(const io::SocketAddress& server,
                                                                         ClientTls::IdentityCallback judge,
                                                                         Duration timeout, int signals);
  ~ControlClient();
  ControlClient(ControlClient&&) noexcept;
  ControlClient& operator=(ControlClient&&) noexcept;

  /// Sends a frame under the next request number and waits for its reply.
  [[nodiscard]] std::expected<rpc::Body, ClientError> ask(const rpc::Body& body, Duration timeout);

  /// Descriptor for poll: readable without a pending request means that the server has ended the connection.
  [[nodiscard]] int fd() const noexcept;
  [[nodiscard]] const KeyFingerprint& server() const noexcept;
  [[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(const ExporterContext& context);

 private:
  struct State;
  explicit ControlClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tandem::auth

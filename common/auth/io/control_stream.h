#pragma once

#include <asio/ssl/stream.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>

#include "common/auth/io/byte_limited_socket.h"
#include "common/auth/io/tls_context.h"
#include "common/base/secret.h"

namespace tandem::auth {

/// Reason why a stream cannot continue.
enum class StreamErrorCode : std::uint8_t {
  kClosed,     ///< by the peer
  kDeadline,   ///< a step exceeded its time
  kTooMuch,    ///< more input than allowed
  kLength,     ///< a frame longer than allowed, or empty
  kHandshake,  ///< no TLS 1.3, wrong key, wrong protocol, no certificate
  kStopped,    ///< `close` was called
  kNetwork,    ///< error of the network
};
struct StreamError {
  StreamErrorCode end = StreamErrorCode::kNetwork;
  std::string text;
};

/// Frames over TLS over TCP, for the one thread that runs the socket's io_context. Callbacks run on that thread, each
/// once, and never within the call that requested them. At most one handshake, one read and one write may be in
/// progress. The stream keeps itself alive meanwhile. It reads only on request.
class ControlStream : public std::enable_shared_from_this<ControlStream> {
 public:
  enum class Side { kServer, kClient };
  using Duration = std::chrono::steady_clock::duration;
  using Peer = std::expected<KeyFingerprint, StreamError>;
  using Bytes = std::expected<SecretBuffer, StreamError>;

  /// @param context  must outlive the stream
  [[nodiscard]] static std::shared_ptr<ControlStream> make(asio::ip::tcp::socket socket, asio::ssl::context& context,
                                                           Side side);

  /// Sets the deadline of all operations in progress; it replaces an earlier one. After it they end with kDeadline, and
  /// the connection ends with them.
  /// @param late  called at the deadline, also when no operation is in progress
  void set_deadline(Duration from_now, std::function<void()> late = {});
  void clear_deadline();
  /// Sets how many bytes may still be read, including those of TLS.
  void allow_input(std::size_t bytes) noexcept { stream_.next_layer().allow(bytes); }

  /// Performs the handshake. `done` receives the fingerprint of the key that the peer proved.
  void handshake(std::function<void(Peer)> done);
  /// Reads one frame; the result excludes its length. `frame_max`: longer frames end the stream before they are read.
  /// @param frame_deadline  for the rest of a frame after its first bytes; zero: only `set_deadline` applies
  void read(std::size_t frame_max, Duration frame_deadline, const std::function<void(Bytes)>& done);
  /// @param frame  with its length, as the codec encodes it
  void write(SecretBuffer frame, std::function<void(std::expected<void, StreamError>)> done);
  /// Sends the end of the stream if that is possible without waiting, and closes.
  void close();

  [[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(const ExporterContext& context) {
    return auth::export_secrets(stream_.native_handle(), context);
  }
  /// Whether the peer knows rpc::SessionPhase::kHeld. @pre the handshake is over
  [[nodiscard]] bool peer_knows_held() noexcept { return auth::peer_knows_held(stream_.native_handle()); }
  [[nodiscard]] asio::ip::tcp::socket& socket() noexcept { return stream_.next_layer().socket(); }

 private:
  ControlStream(asio::ip::tcp::socket socket, asio::ssl::context& context, Side side);
  /// Converts `error` to a reason, considering which limits ended the stream.
  [[nodiscard]] StreamError fault(const asio::error_code& error, bool in_handshake = false);
  void drop();

  asio::ssl::stream<ByteLimitedSocket> stream_;
  Side side_;
  asio::steady_timer deadline_, frame_deadline_;
  bool late_ = false, stopped_ = false;
  std::array<std::byte, 4> head_{};
  SecretBuffer in_, out_;
};

}  // namespace tandem::auth

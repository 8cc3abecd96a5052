#pragma once

#include <asio/ssl/stream.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>

#include "common/base/secret.h"
#include "common/trust/io/metered_socket.h"
#include "common/trust/io/tls_context.h"

namespace tandem::trust {

/// Why a stream cannot go on.
enum class StreamEnd : std::uint8_t {
  kClosed,     ///< by the other side
  kDeadline,   ///< it took longer than it was given
  kTooMuch,    ///< more input than it was allowed
  kLength,     ///< a frame longer than allowed, or empty
  kHandshake,  ///< no TLS 1.3, wrong key, wrong protocol, no certificate
  kStopped,    ///< `close` was called
  kTrouble,    ///< the network's
};
struct StreamFault {
  StreamEnd end = StreamEnd::kTrouble;
  std::string text;
};

/// Frames over TLS over TCP, for one thread that runs the socket's io_context. Callbacks come from that thread, each once, never from
/// within the call that asked. One handshake, one read and one write may be under way at a time. The stream keeps itself alive while
/// something is; it reads nothing that nobody asked for.
class ControlStream : public std::enable_shared_from_this<ControlStream> {
 public:
  enum class Side { kServer, kClient };
  using Duration = std::chrono::steady_clock::duration;
  using Peer = std::expected<Pin, StreamFault>;
  using Bytes = std::expected<SecretBuffer, StreamFault>;

  /// @param context  must live as long as the stream
  [[nodiscard]] static std::shared_ptr<ControlStream> make(asio::ip::tcp::socket socket, asio::ssl::context& context, Side side);

  /// Everything under way must be over by then, else it ends with kDeadline and the connection with it. Replaces an earlier deadline.
  /// @param late  told then, also when nothing is under way
  void set_deadline(Duration from_now, std::function<void()> late = {});
  void clear_deadline();
  /// How many bytes may still come in, TLS's own included.
  void allow_input(std::size_t bytes) noexcept { stream_.next_layer().allow(bytes); }

  /// The peer proved the key with this pin.
  void handshake(std::function<void(Peer)> done);
  /// One frame, without its length. `frame_max`: longer ones end the stream before they are read.
  /// @param frame_deadline  for the rest of a frame whose first bytes have come; zero: only `set_deadline` counts
  void read(std::size_t frame_max, Duration frame_deadline, std::function<void(Bytes)> done);
  /// @param frame  with its length, as the codec makes it
  void write(SecretBuffer frame, std::function<void(std::expected<void, StreamFault>)> done);
  /// Tells the other side that nothing follows, as far as that takes no time, and closes.
  void close();

  [[nodiscard]] std::expected<Secret<kExportSize>, std::string> export_secrets(const LinkContext& context) {
    return trust::export_secrets(stream_.native_handle(), context);
  }
  [[nodiscard]] asio::ip::tcp::socket& socket() noexcept { return stream_.next_layer().socket(); }

 private:
  ControlStream(asio::ip::tcp::socket socket, asio::ssl::context& context, Side side);
  /// What `error` means, given what was done to the stream.
  [[nodiscard]] StreamFault fault(const asio::error_code& error, bool in_handshake = false);
  void drop();

  asio::ssl::stream<MeteredSocket> stream_;
  Side side_;
  asio::steady_timer deadline_, frame_deadline_;
  bool late_ = false, stopped_ = false;
  std::array<std::byte, 4> head_{};
  SecretBuffer in_, out_;
};

}  // namespace tandem::trust

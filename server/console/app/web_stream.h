#pragma once

#include <array>
#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace tandem::console {

/// The connection of a browser, with TLS or without. One type for both, so that HTTP and WebSocket are compiled once.
class WebStream {
 public:
  using Tcp = boost::beast::tcp_stream;
  using Tls = boost::beast::ssl_stream<Tcp>;
  using executor_type = Tcp::executor_type;

  explicit WebStream(Tcp plain) : plain_(std::make_unique<Tcp>(std::move(plain))) {}
  WebStream(Tcp plain, boost::asio::ssl::context& tls) : tls_(std::make_unique<Tls>(std::move(plain), tls)) {}

  [[nodiscard]] executor_type get_executor() noexcept { return lowest().get_executor(); }
  [[nodiscard]] Tcp& lowest() noexcept { return tls_ ? tls_->next_layer() : *plain_; }
  /// Null: without TLS.
  [[nodiscard]] Tls* tls() noexcept { return tls_.get(); }
  void close() {
    lowest().cancel();
    lowest().close();
  }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return boost::asio::async_initiate<Handler, void(boost::beast::error_code, std::size_t)>(
        [this](auto&& done, const Buffers& into) {
          if (tls_) {
            tls_->async_read_some(into, std::forward<decltype(done)>(done));
          } else {
            plain_->async_read_some(into, std::forward<decltype(done)>(done));
          }
        },
        handler, buffers);
  }
  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    return boost::asio::async_initiate<Handler, void(boost::beast::error_code, std::size_t)>(
        [this](auto&& done, const Buffers& from) {
          if (tls_) {
            tls_->async_write_some(from, std::forward<decltype(done)>(done));
          } else {
            plain_->async_write_some(from, std::forward<decltype(done)>(done));
          }
        },
        handler, buffers);
  }

  /// Called by a WebSocket after its close frame. The close frames show that no byte is missing, so TLS needs no end of
  /// its own. Beast 1.74 closes after one read; unread bytes then reset the connection before the peer has read the
  /// close frame. This reads to the end of the peer, at most for kDrain.
  template <class Handler>
  friend void async_teardown(boost::beast::role_type, WebStream& stream, Handler&& handler) {
    boost::beast::error_code ignored;
    static_cast<void>(stream.lowest().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored));
    stream.lowest().expires_after(kDrain);
    Drain<std::decay_t<Handler>>{&stream, std::forward<Handler>(handler), std::make_unique<Bytes>()}({}, 0);
  }
  /// Called by a WebSocket after a timeout.
  friend void beast_close_socket(WebStream& stream) { stream.lowest().close(); }

 private:
  static constexpr std::chrono::seconds kDrain{2};
  using Bytes = std::array<char, 2048>;

  /// Reads and forgets until the connection ends, then closes it and calls `done`.
  template <class Handler>
  struct Drain {
    WebStream* stream;
    Handler done;
    std::unique_ptr<Bytes> bytes;

    void operator()(boost::beast::error_code error, std::size_t) {
      if (!error) {
        const auto into = boost::asio::buffer(*bytes);
        return stream->lowest().async_read_some(into, std::move(*this));
      }
      stream->lowest().close();
      done(boost::beast::error_code{});
    }
  };

  std::unique_ptr<Tcp> plain_;
  std::unique_ptr<Tls> tls_;
};

}  // namespace tandem::console

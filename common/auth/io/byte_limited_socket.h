#pragma once

#include <asio/buffer.hpp>
#include <asio/error.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/post.hpp>
#include <cstddef>
#include <limits>
#include <utility>

namespace tandem::auth {

/// A TCP socket that reads at most the allowed number of bytes. It works below TLS, so handshakes of any form count
/// too. Excess data stays in the kernel, and the reader gets `no_buffer_space`. For one thread.
class ByteLimitedSocket {
 public:
  using lowest_layer_type = asio::ip::tcp::socket::lowest_layer_type;
  using executor_type = asio::ip::tcp::socket::executor_type;
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  explicit ByteLimitedSocket(asio::ip::tcp::socket socket) : socket_(std::move(socket)) {}

  /// Sets the number of bytes that may be read from now on; an earlier remainder is dropped.
  void allow(std::size_t bytes) noexcept { left_ = bytes; }
  [[nodiscard]] bool used_up() const noexcept { return left_ == 0; }

  [[nodiscard]] executor_type get_executor() noexcept { return socket_.get_executor(); }
  [[nodiscard]] lowest_layer_type& lowest_layer() noexcept { return socket_.lowest_layer(); }
  [[nodiscard]] const lowest_layer_type& lowest_layer() const noexcept { return socket_.lowest_layer(); }
  [[nodiscard]] asio::ip::tcp::socket& socket() noexcept { return socket_; }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    const asio::mutable_buffer first = *asio::buffer_sequence_begin(buffers);
    if (left_ == 0) {
      asio::post(get_executor(), [h = std::forward<Handler>(handler)]() mutable {
        h(asio::error_code(asio::error::no_buffer_space), std::size_t{0});
      });
      return;
    }
    socket_.async_read_some(asio::buffer(first, left_), [this, h = std::forward<Handler>(handler)](
                                                            asio::error_code error, std::size_t size) mutable {
      if (left_ != kUnlimited) left_ -= size;
      h(error, size);
    });
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    socket_.async_write_some(buffers, std::forward<Handler>(handler));
  }

 private:
  asio::ip::tcp::socket socket_;
  std::size_t left_ = kUnlimited;
};

}  // namespace tandem::auth

#pragma once

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <thread>
#include <utility>

#include "common/io/datagram_batch.h"
#include "common/io/realtime.h"
#include "common/io/udp_socket.h"
#include "common/transport/datagram.h"
#include "tests/bench/crowd.h"

namespace tandem::bench {

/// A bare echo on a thread of its own: the cheapest server there can be that answers each datagram at once. A datagram
/// begins with its number, and so does its answer.
class AnsweringEcho {
 public:
  explicit AnsweringEcho(std::size_t size)
      : socket_(std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0)))), size_(size) {
    thread_ = std::thread([this] { run(); });
  }
  ~AnsweringEcho() {
    stop_.store(true);
    thread_.join();
  }
  AnsweringEcho(const AnsweringEcho&) = delete;
  AnsweringEcho& operator=(const AnsweringEcho&) = delete;

  [[nodiscard]] const io::SocketAddress& address() const { return socket_.local; }
  [[nodiscard]] Duration cpu() { return cpu_of(thread_.native_handle()); }
  [[nodiscard]] std::uint64_t answered() const { return answered_.load(); }

 private:
  void run() {
    io::request_realtime(70);
    io::ReceiveBatch::prepare(socket_.fd.get(), AF_INET, false);
    while (!stop_.load()) {
      pollfd wait{socket_.fd.get(), POLLIN, 0};
      poll(&wait, 1, 10);
      for (int count = 0; !stop_.load() && (count = in_.receive(socket_.fd.get())) > 0;) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          to_[i].size = sizeof(sockaddr_in);
          std::memcpy(&to_[i].storage, &in_.from(i), to_[i].size);
          std::memcpy(answers_[i].data(), in_.bytes(i).data(), sizeof(std::uint32_t));
          out_.add(std::span{answers_[i]}.first(size_), &to_[i], nullptr);
        }
        out_.send(socket_.fd.get());
        answered_ += static_cast<std::uint64_t>(count);
      }
    }
  }

  io::UdpSocket socket_;
  std::size_t size_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> answered_{0};
  io::ReceiveBatch in_;
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, io::ReceiveBatch::kMax> answers_{};
  std::array<io::SocketAddress, io::ReceiveBatch::kMax> to_{};
  std::thread thread_;
};

}  // namespace tandem::bench

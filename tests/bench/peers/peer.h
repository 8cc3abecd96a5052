#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "common/io/clock.h"

/// A common harness for ways to exchange the messages of a haptic loop: each program of this folder implements `Peer`
/// with one package.
namespace tandem::bench {

/// Messages of a measurement: every client sends `up` bytes at each millisecond and gets `down` bytes for them.
struct Exchange {
  std::size_t clients = 1;
  std::size_t up = 0, down = 0;  ///< contents of a message, without the package's own overhead [bytes]
  bool sealed = false;           ///< encrypted and authenticated
};

/// Receives the times of each answer.
/// @param loop  time since the message that it answers was sent
/// @param held  part of `loop` during which the server waited for its tick by design; 0 for servers that answer at once
using Heard = std::function<void(Duration loop, Duration held)>;

/// All clients, in the process that measures.
class PeerClients {
 public:
  PeerClients() = default;
  virtual ~PeerClients() = default;
  PeerClients(const PeerClients&) = delete;
  PeerClients& operator=(const PeerClients&) = delete;

  /// Sends the next message of one client.
  virtual void send(std::size_t client) = 0;
  /// Ends a round of sends; packages that collect messages send them now.
  virtual void flush() {}
  /// Waits until `until` and hands over each answer at its arrival.
  virtual void receive(Time until, const Heard& heard) = 0;
};

/// One package. `connect` and `serve` run in different processes.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Answers messages until the process is ended. @param ready  to be called once with the port to connect to
  virtual void serve(const std::function<void(std::uint16_t port)>& ready) = 0;
  /// @throws std::runtime_error  if not all clients get through
  virtual std::unique_ptr<PeerClients> connect(std::uint16_t port) = 0;
};

/// Returns the package of this program, before the server's process is forked: it must start no thread.
/// @return null: the package cannot encrypt
std::unique_ptr<Peer> make_peer(const Exchange& exchange);

/// First bytes of each message and its answer.
struct Mark {
  std::uint32_t client = 0, number = 0;
};

/// Numbers the messages of all clients and tells how long an answer took. One thread stamps, any thread hears.
class SendTimes {
 public:
  explicit SendTimes(const Exchange& exchange) : numbers_(exchange.clients), sent_(exchange.clients * kKept) {}

  /// Writes the mark of the next message and notes the time. @pre `message` has room for a Mark
  void stamp(std::size_t client, std::span<std::byte> message) {
    const Mark mark{static_cast<std::uint32_t>(client), numbers_[client].load(std::memory_order_relaxed)};
    sent_[client * kKept + mark.number % kKept] = io::monotonic_now();
    numbers_[client].store(mark.number + 1, std::memory_order_release);
    std::memcpy(message.data(), &mark, sizeof mark);
  }
  /// Passes the time of an answer to `heard`; ignores answers to messages that are no longer kept.
  void hear(std::span<const std::byte> answer, const Heard& heard) const {
    Mark mark;
    if (answer.size() < sizeof mark) return;
    std::memcpy(&mark, answer.data(), sizeof mark);
    if (mark.client >= numbers_.size()) return;
    if (numbers_[mark.client].load(std::memory_order_acquire) - mark.number - 1 >= kKept) return;
    heard(io::monotonic_now() - sent_[mark.client * kKept + mark.number % kKept].load(), {});
  }

 private:
  static constexpr std::uint32_t kKept = 1024;  ///< a second of messages
  std::vector<std::atomic<std::uint32_t>> numbers_;
  std::vector<std::atomic<Time>> sent_;
};

}  // namespace tandem::bench

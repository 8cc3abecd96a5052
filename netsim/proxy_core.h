#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/delay_queue.h"
#include "netsim/path.h"
#include "netsim/path_spec.h"
#include "netsim/submit.h"

namespace tandem::netsim {

/// The proxy without sockets and clock: datagrams in, scheduled datagrams out. It uses the same Path and the same way
/// in as the virtual network, so equal seed, client number, times and sizes give equal verdicts (a test holds it to
/// that).
class ProxyCore {
 public:
  static constexpr std::size_t kClientsMax = 64;
  /// Datagrams under way, all clients together; of one direction of one client at most kPerLaneMax.
  static constexpr std::size_t kSlots = 131'072;
  static constexpr std::uint64_t kPerLaneMax = 65'536;

  /// @throws std::invalid_argument listing all problems of the spec.
  ProxyCore(const LinkSpec& spec, std::uint64_t seed);

  /// Takes a free place for a new client.
  /// @return its number in [0, kClientsMax); empty: the house is full
  /// Randomness is keyed by how many clients came before, so the n-th client meets the n-th link of the virtual
  /// network.
  std::optional<std::uint32_t> add_client();
  /// Frees the place. What is still under way for the client is dropped when due.
  void remove_client(std::uint32_t client) noexcept;
  [[nodiscard]] std::size_t clients() const noexcept { return clients_; }
  [[nodiscard]] std::uint64_t clients_seen() const noexcept { return clients_seen_; }

  /// A datagram of at most kSlotBytes came in at `now`.
  Outcome ingress(Time now, std::uint32_t client, Direction direction,
                  std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// Something to be sent: bytes stay valid until `done`.
  struct Egress {
    std::uint32_t client = 0;
    Direction direction = Direction::kUp;
    std::span<const std::byte> bytes;
    DelayQueue::Item item;
  };
  /// The next datagram due at `now`, in the order (time, arrival).
  std::optional<Egress> take(Time now) noexcept TANDEM_REALTIME;
  /// Gives the bytes back after sending.
  void done(const Egress& egress) noexcept TANDEM_REALTIME { queue_.recycle(egress.item.slot); }

  [[nodiscard]] std::optional<Time> next_due() const noexcept { return queue_.next_due(); }

  /// Of one present client; of all clients together, also those that left.
  [[nodiscard]] const PathCounters& counters(std::uint32_t client, Direction direction) const noexcept;
  [[nodiscard]] PathCounters total(Direction direction) const noexcept;

 private:
  struct Lane {
    Lane(const PathSpec& spec, const Path::Keys& keys) : path(spec, keys) {}
    Path path;
    PathCounters counters;
  };
  struct Client {
    std::array<std::optional<Lane>, kDirections> lanes;
    std::uint32_t generation = 0;  ///< tells datagrams of a client that left from those of its successor
  };
  [[nodiscard]] std::uint32_t lane_name(std::uint32_t client, Direction direction) const noexcept;

  LinkSpec spec_;
  std::uint64_t seed_;
  DelayQueue queue_;
  std::vector<Client> places_;
  std::size_t clients_ = 0;
  std::uint64_t clients_seen_ = 0;
  std::array<PathCounters, kDirections> left_;  ///< of clients that left
};

}  // namespace tandem::netsim

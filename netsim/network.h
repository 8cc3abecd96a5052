#pragma once

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

/// A datagram that came out.
struct Delivery {
  std::uint32_t link = 0;
  Direction direction = Direction::kUp;
  Time sent;
  Time at;
  std::uint64_t index = 0;  ///< of the datagram on its path; a copy has the index of its original
  std::size_t size = 0;     ///< [bytes]; also when the buffer was smaller and the rest was cut off
};

/// Links of a virtual network: datagrams go in, and come out when the caller's clock has reached their time.
/// All memory is taken by `add_link`; `send` and `poll` take none. Same seed, specs and calls: same deliveries.
class Network {
 public:
  explicit Network(std::uint64_t seed) noexcept : seed_(seed) {}

  /// Adds a client's link; setup only.
  /// @param name  what the link's randomness is keyed by, so that other links do not move it; default: its number
  /// @return the link's number: 0, 1, ...
  /// @throws std::invalid_argument listing all problems of the spec.
  std::uint32_t add_link(const LinkSpec& spec);
  std::uint32_t add_link(const LinkSpec& spec, std::uint64_t name);

  [[nodiscard]] std::size_t links() const noexcept { return lanes_.size() / kDirections; }

  /// Sends one datagram of at most kSlotBytes.
  /// @return what was decided; an unknown link drops (kOverflow)
  Outcome send(Time now, std::uint32_t link, Direction direction,
               std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// Takes the next datagram of this link and direction that is due at `now` into `buffer`; call until empty.
  /// Without delay a datagram is due at the very `now` it was sent. Equal times: order of sending.
  std::optional<Delivery> poll(Time now, std::uint32_t link, Direction direction,
                               std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// The same over all links, ordered by (time, link, direction, sequence).
  std::optional<Delivery> poll_any(Time now, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// When the next datagram is due on this link and direction, or on any.
  [[nodiscard]] std::optional<Time> next_due(std::uint32_t link, Direction direction) const noexcept;
  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  [[nodiscard]] const PathCounters& counters(std::uint32_t link, Direction direction) const noexcept;

 private:
  struct Lane {
    Lane(const PathSpec& spec, const Path::Keys& keys);
    Path path;
    DelayQueue queue;
    PathCounters counters;
  };
  [[nodiscard]] Lane* lane(std::uint32_t link, Direction direction) const noexcept;
  std::optional<Delivery> take(Lane& from, Time now, std::span<std::byte> buffer) noexcept;

  std::uint64_t seed_;
  std::vector<std::unique_ptr<Lane>> lanes_;  ///< link * 2 + direction
};

}  // namespace tandem::netsim

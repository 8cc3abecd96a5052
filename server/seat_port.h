#pragma once

#include <memory>
#include <optional>

#include "common/control/channel.h"
#include "common/link/link.h"
#include "proto/scene_spec.h"
#include "proto/wire_codec.h"

namespace tandem::server {

/// Where somebody is: the bytes of a socket address, opaque to cores.
struct Endpoint {
  std::array<std::byte, 28> bytes{};
  std::uint8_t size = 0;
  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// The server's end of one seat: its link, what it last said, and its end of the spring.
class SeatPort {
 public:
  SeatPort(const SceneSpec& scene, std::size_t seat, const AxisArray& scale);

  /// A client took the seat. Energies, statistics and freshness start anew.
  void bind(Time now, Endpoint at, std::uint64_t nonce, const link::Link::Params& link);
  /// Since it was last heard; since it was bound when it never spoke.
  [[nodiscard]] Duration silence(Time now) const noexcept;
  void release() noexcept { link_.reset(); }
  [[nodiscard]] bool bound() const noexcept { return link_.has_value(); }
  [[nodiscard]] std::uint64_t nonce() const noexcept { return nonce_; }
  [[nodiscard]] const Endpoint& endpoint() const noexcept { return at_; }

  /// Opens and decodes; STATE acts here. @return the other messages, for the session.
  struct Heard {
    std::optional<wire::AuthorityMessage> authority;
    bool close = false;
  };
  Heard on_datagram(Time now, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// Heard from within the hold limit, its device streams, nothing latched.
  [[nodiscard]] bool alive(Time now) const noexcept;
  [[nodiscard]] bool ready(Time now) const noexcept { return alive(now) && (rx_.ready || rx_.engaged); }
  [[nodiscard]] bool alive_once() const noexcept { return generation_ > 0; }
  /// Its spring may act on tools.
  [[nodiscard]] bool present(Time now) const noexcept { return alive(now) && rx_.engaged; }

  /// What the near end of the spring hangs on.
  struct Near {
    AxisArray x{};           ///< the tool's position, a weighted one where a seat serves several tools
    AxisArray offset{};      ///< hand minus tool, taken off what was received
    AxisArray dissipated{};  ///< heat at the tools this seat may spend [J]
    double weight = 0;       ///< how many such springs a move loads
    double pass_on = 1;      ///< share of the heat the client may have when it is not needed here
  };
  /// Moves this end's reference; rests it (no elongation) while the seat is not present.
  void move(Time now, double dt, bool present, const Near& near) noexcept TANDEM_REALTIME;

  [[nodiscard]] control::ChannelEnd& end() noexcept { return *end_; }
  [[nodiscard]] const control::ChannelEnd& end() const noexcept { return *end_; }
  [[nodiscard]] link::Link* link() noexcept { return link_ ? &*link_ : nullptr; }
  [[nodiscard]] const link::Link* link() const noexcept { return link_ ? &*link_ : nullptr; }
  [[nodiscard]] const wire::StateMessage& heard() const noexcept { return rx_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }  ///< counts STATEs that acted
  [[nodiscard]] bool energy_fell() const noexcept { return energy_fell_; }
  [[nodiscard]] std::uint32_t outages() const noexcept { return outages_; }

  wire::ForceMessage tx{};  ///< the next FORCE, filled by the session

  /// Seals `tx` (or CLOSE). @return size, 0 if nothing could be written.
  [[nodiscard]] std::size_t transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t transmit_close(Time now, std::uint32_t tick, wire::CloseReason why, std::span<std::byte> buffer) noexcept;

 private:
  template <class Message>
  std::size_t seal(Time now, std::uint32_t tick, wire::Type type, const Message& m, std::span<std::byte> buffer) noexcept;

  const SceneSpec* scene_;
  std::size_t seat_;
  AxisArray scale_;
  std::unique_ptr<control::ChannelEnd> end_;
  std::optional<link::Link> link_;
  wire::Codec codec_;
  Endpoint at_{};
  Time bound_at_{};
  std::uint64_t nonce_ = 0;
  wire::StateMessage rx_{};
  std::uint64_t generation_ = 0;
  bool was_present_ = false, energy_fell_ = false;
  std::uint32_t outages_ = 0;
};

}  // namespace tandem::server

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "proto/visit.h"
#include "proto/wire_codec.h"
#include "server/connection.h"

namespace tandem::server {

/// Those who judge their link to this server (proto/visit.h). Nothing of them reaches a seat, a tool or a report. They hear one FORCE
/// per tick, at the address they proved.
class Visitors {
 public:
  static constexpr std::size_t kMax = 4;

  Visitors(std::size_t dof, PortSpace port, Duration tick) : codec_(dof, port), tick_(tick) {}

  /// Puts the visitor in. @param link  holds what was there before afterwards  @return his place; nothing: all are taken
  [[nodiscard]] std::optional<std::size_t> admit(Time now, std::unique_ptr<link::Link>& link) noexcept;
  /// How many more could come now.
  [[nodiscard]] std::size_t free(Time now) const noexcept;
  /// Sends one away: he is told, then the place is free. @return false: he is not there any more
  bool dismiss(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept;
  /// @return false: not of a visitor
  bool on_datagram(Time now, const Endpoint& from, std::uint32_t cid, std::span<const std::byte> bytes, PathTokens& tokens) noexcept TANDEM_REALTIME;
  /// Forgets who fell silent; the others are due for a FORCE.
  void on_tick(Time now) noexcept TANDEM_REALTIME;

  /// @param closing  tells them that the server ends instead, by this reason
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick, std::optional<wire::CloseReason> closing,
                                                      std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

 private:
  struct Visitor {
    std::optional<Connection> connection;  ///< kept when he has left, until another comes
    bool here = false, due = false;
    unsigned farewells = 0;  ///< CLOSEs that are still to be sent to one who was sent away
    wire::CloseReason why = wire::CloseReason::kRemoved;
  };
  std::array<Visitor, kMax> visitors_;
  wire::Codec codec_;
  Duration tick_;
};

}  // namespace tandem::server

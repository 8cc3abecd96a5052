#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/link/link.h"
#include "proto/visit.h"
#include "proto/wire_codec.h"
#include "server/seat_port.h"

namespace tandem::server {

/// Those who judge their link to this server (proto/visit.h). Nothing of them reaches a seat, a tool or a report. They hear one FORCE
/// per tick, only while their own authentic datagrams come from the address they bound from.
class Visitors {
 public:
  static constexpr std::size_t kMax = 4;

  Visitors(std::size_t dof, PortSpace port) : codec_(dof, port) {}

  /// @return the connection id for datagrams to the server; 0: all places are taken. A repeated BIND gets the same one.
  /// @param drawn  a connection id nobody has
  [[nodiscard]] std::uint32_t bind(Time now, const Endpoint& from, std::uint64_t nonce, std::uint32_t client_cid, std::uint32_t drawn,
                                   Duration tick) noexcept;
  /// @return false: not of a visitor
  bool on_datagram(Time now, const Endpoint& from, std::uint32_t cid, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;
  /// Forgets who fell silent; the others are due for a FORCE.
  void on_tick(Time now) noexcept TANDEM_REALTIME;

  struct Transmit {
    Endpoint to;
    std::size_t size = 0;
  };
  /// @param closing  tells them that the server ends instead, by this reason
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick, std::optional<wire::CloseReason> closing,
                                                      std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

 private:
  struct Visitor {
    std::optional<link::Link> link;
    Endpoint at;
    std::uint64_t nonce = 0;
    Time heard{};            ///< or bound
    bool spoke = false, due = false;
  };
  std::array<Visitor, kMax> visitors_;
  wire::Codec codec_;
};

}  // namespace tandem::server

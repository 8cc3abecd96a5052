#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "common/link/seal.h"
#include "proto/scene_spec.h"
#include "proto/wire_codec.h"
#include "server/seat_port.h"
#include "server/visitors.h"

namespace tandem::server {

/// Where people ask for a seat: opens BIND, gives connection ids, answers with the seat's setup or with the reason why not.
/// BIND and BIND_ACK travel under connection id 0, so that they can never be taken for a datagram of a connection.
class Lobby {
 public:
  Lobby(const SceneSpec& scene, const AxisArray& scale, std::uint64_t secret);

  /// @return false for bytes that are no BIND: no reply, no state.
  bool on_bind(Time now, const Endpoint& from, std::span<const std::byte> bytes, std::span<SeatPort> seats, Visitors& visitors,
               bool closed) noexcept;
  [[nodiscard]] std::optional<std::size_t> seat_of_cid(std::uint32_t cid) const noexcept;

  struct Answer {
    Endpoint to;
    std::size_t size = 0;
  };
  [[nodiscard]] std::optional<Answer> poll(std::span<std::byte> buffer) noexcept;

 private:
  void answer(const Endpoint& to, const wire::BindAckMessage& ack) noexcept;
  [[nodiscard]] wire::BindAckMessage receive_visitor(Time now, const Endpoint& from, const wire::BindMessage& m,
                                                     Visitors& visitors) noexcept;
  [[nodiscard]] std::uint32_t draw_cid(std::size_t seat) noexcept;

  struct Waiting {
    Endpoint to;
    std::array<std::byte, link::kDatagramMax> bytes{};
    std::size_t size = 0;
  };
  static constexpr std::size_t kWaitingMax = 32;  // more are dropped: clients ask again

  const SceneSpec* scene_;
  std::vector<wire::BindAckMessage> accepted_;     ///< one per seat, setup encoded once
  std::array<std::uint32_t, kSeatsMax> cids_{};    ///< 0: nobody
  link::Seal opening_, sealing_;
  wire::Codec codec_;
  std::uint64_t secret_, draws_ = 0, counter_ = 0;
  std::vector<Waiting> waiting_;
};

}  // namespace tandem::server

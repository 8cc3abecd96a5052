#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "client/seat.h"
#include "common/link/link.h"
#include "hal/sim/sim_device.h"
#include "netsim/world_joining.h"
#include "proto/wire_codec.h"
#include "server/session.h"

namespace tandem::bench {

/// A client that costs next to nothing: seals STATEs of an engaged hand at rest, answers challenges, and learns from FORCE only what it
/// must echo.
class BareClient {
 public:
  BareClient(const netsim::VirtualSeat& joined)
      : link_(joined.link), codec_(joined.setup.dof, joined.setup.port) {
    state_.ready = true;
  }

  void hear(Time now, std::span<const std::byte> bytes) {
    const auto opened = link_.open(now, bytes);
    if (!opened) return;
    if (opened->type == wire::Type::kPathChallenge) {
      if (const auto asked = codec_.decode_path(opened->plaintext)) answer_ = asked->message;
      return;
    }
    const auto force = codec_.decode_force(opened->plaintext);
    if (!force || !opened->newer) return;
    link_.accept(now, *opened, force->preamble);
    ++forces_;
    state_.engaged = force->message.engage;
    if (!settled_) state_.port.x = force->message.port.x;  // where the tool is: no elongation
    settled_ = state_.engaged;
  }
  /// The next datagram; 0: there is none.
  std::size_t send(Time now, std::uint32_t tick, std::span<std::byte> buffer) {
    const auto body = buffer.subspan(link::kHeaderSize);
    if (answer_) {
      const std::size_t plain = codec_.encode(link_.preamble(now, tick), *answer_, body);
      answer_.reset();
      return link_.seal(now, wire::Type::kPathResponse, buffer, plain);
    }
    return link_.seal(now, wire::Type::kState, buffer, codec_.encode(link_.preamble(now, tick), state_, body));
  }
  [[nodiscard]] const link::Link& link() const { return link_; }
  [[nodiscard]] bool settled() const { return settled_; }
  [[nodiscard]] bool answers() const { return answer_.has_value(); }
  [[nodiscard]] std::uint64_t forces() const { return forces_; }

 private:
  link::Link link_;
  wire::Codec codec_;
  wire::StateMessage state_;
  std::optional<wire::PathMessage> answer_;
  bool settled_ = false;
  std::uint64_t forces_ = 0;
};

/// Caps of the device that a seat of the scene describes.
inline hal::DeviceCaps caps_of(const SceneSpec& scene, std::size_t seat) {
  return (*hal::sim::SimDevice::make({scene.seats[seat].device, HandSpec{}, scene.seats[seat].environment, nullptr, Time{}}))->caps();
}

}  // namespace tandem::bench

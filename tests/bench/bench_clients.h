#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "client/seat/seat.h"
#include "client/seat/telemetry_pace.h"
#include "common/transport/secure_channel.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/wire/wire_codec.h"
#include "server/session/session.h"

namespace tandem::bench {

/// Minimal client: seals STATE messages of an engaged hand and answers path challenges. It uses only those fields of
/// FORCE that it must echo, and sends telemetry as often as the server asks. The hand rests, or swings along one axis.
class BareClient {
 public:
  BareClient(const netsim::SimulatedJoin& joined)
      : link_(joined.channel_params), codec_(body_layout(joined.setup)), telemetry_(joined.setup.tick_hz) {
    state_.ready = true;
  }

  void hear(Time now, std::span<const std::byte> bytes) {
    const auto opened = link_.open(now, bytes);
    if (!opened) return;
    counter_ = std::max(counter_, opened->counter);
    if (opened->type == wire::Type::kPathChallenge) {
      if (const auto asked = codec_.decode_path(opened->plaintext)) answer_ = asked->message;
      return;
    }
    const auto force = codec_.decode_force(opened->plaintext);
    if (!force || !opened->newer) return;
    link_.accept(now, *opened, force->preamble);
    ++forces_;
    telemetry_every_tick_ = force->message.telemetry_every_tick;
    state_.engaged = force->message.engage;
    if (!settled_) rest_ = state_.port.x = force->message.port.x;  // of the tool: the coupling has no elongation
    settled_ = state_.engaged;
  }
  /// Writes the next datagram into `buffer`. @return size [bytes]; 0: none
  std::size_t send(Time now, std::uint32_t tick, std::span<std::byte> buffer) {
    const auto body = buffer.subspan(transport::kHeaderSize);
    if (answer_) {
      const std::size_t plain = codec_.encode(link_.preamble(now, tick), *answer_, body);
      answer_.reset();
      return link_.seal(now, wire::Type::kPathResponse, buffer, plain);
    }
    state_.with_telemetry = telemetry_.due(tick, telemetry_every_tick_);
    if (swings_ && settled_) swing(tick);
    return link_.seal(now, wire::Type::kState, buffer, codec_.encode(link_.preamble(now, tick), state_, body));
  }
  /// From now on the hand swings by 20 mm at 1.5 Hz; seats of one session one after the other.
  void set_swinging(std::size_t seat) {
    swings_ = true;
    swing_phase_ = static_cast<double>(seat);
  }
  [[nodiscard]] const transport::SecureChannel& link() const { return link_; }
  [[nodiscard]] bool settled() const { return settled_; }
  [[nodiscard]] bool answers() const { return answer_.has_value(); }
  [[nodiscard]] std::uint64_t forces() const { return forces_; }
  /// Highest counter received. Its growth is the number of datagrams that the server sent, whatever the socket lost.
  [[nodiscard]] std::uint64_t counter() const { return counter_; }

 private:
  void swing(std::uint32_t tick) {
    constexpr double kAmplitude = 0.02, kRate = 2 * std::numbers::pi * 1.5;  // [m, rad/s]
    const double angle = kRate * 1e-3 * tick + swing_phase_;
    state_.port.x[0] = rest_[0] + kAmplitude * std::sin(angle);
    state_.port.v[0] = kAmplitude * kRate * std::cos(angle);
  }

  transport::SecureChannel link_;
  wire::Codec codec_;
  wire::StateMessage state_;
  std::optional<wire::PathMessage> answer_;
  client::TelemetryPace telemetry_;
  bool settled_ = false, telemetry_every_tick_ = true, swings_ = false;
  AxisArray rest_{};
  double swing_phase_ = 0;  ///< [rad]
  std::uint64_t counter_ = 0, forces_ = 0;
};

/// Returns the capabilities of the device that the scene describes for a seat.
inline hal::DeviceCaps caps_of(const SceneSpec& scene, std::size_t seat) {
  return (*hal::sim::SimDevice::make(
              {scene.seats[seat].device, HandSpec{}, scene.seats[seat].environment, nullptr, Time{}}))
      ->caps();
}

}  // namespace tandem::bench

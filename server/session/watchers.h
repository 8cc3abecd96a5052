#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "proto/spec/scene_spec.h"
#include "proto/wire/telemetry_codec.h"
#include "server/policy/load_shedder.h"
#include "server/session/peer_slots.h"
#include "server/session/staggered_turn.h"

namespace tandem::server {

/// Numbers of a scene that decide the length of TELEMETRY.
[[nodiscard]] wire::TelemetryLayout telemetry_layout(const SceneSpec& scene) noexcept;

/// Consoles that see the session: they get TELEMETRY (proto/wire/session_telemetry.h), and keep their slot with WATCH.
/// Nothing that they send reaches a seat or a tool. TELEMETRY is the first work that an overloaded server sheds.
class Watchers {
 public:
  static constexpr std::size_t kMax = 8;

  /// @param session_end  close-out of the session; must outlive this
  Watchers(const SceneSpec& scene, const CloseOut& session_end);

  [[nodiscard]] PeerSlots& slots() noexcept { return slots_; }
  /// False if there is no watcher: no call has anything to do then.
  [[nodiscard]] bool any() const noexcept { return slots_.any(); }
  /// A watcher gets every tick at this shed level: seats should send telemetry at every tick.
  [[nodiscard]] bool record_every_tick(ShedLevel level) const noexcept {
    return slots_.any_every_tick() && level == ShedLevel::kNone;
  }
  /// @return false if the header names no watcher
  /// @param header  of the datagram `bytes`
  bool on_datagram(Time now, const PeerAddress& from, const transport::Header& header, std::span<const std::byte> bytes,
                   PathTokens& tokens) noexcept TANDEM_REALTIME {
    return slots_.on_datagram(now, from, header, bytes, tokens, wire::Type::kWatch,
                              [this](std::span<const std::byte> in) { return codec_.decode_watch(in); });
  }

  /// Ticks between two TELEMETRY datagrams to a watcher; at least 1. Without overload 60 per second, and every tick for
  /// recorders. At the first shed level a quarter and a tenth of that, then two per second.
  [[nodiscard]] std::uint32_t interval(bool recorder, ShedLevel level) const noexcept {
    if (level == ShedLevel::kNone) [[likely]]
      return recorder ? 1 : usual_;
    return interval_shedding(recorder, level);
  }
  /// Sets the ticks at which consoles get TELEMETRY. Sessions of a shard have different phases.
  /// @param phase  [ticks]
  void set_phase(std::uint32_t phase) noexcept { console_turn_.set_phase(phase); }
  /// Removes silent watchers, and marks the datagrams of this tick. All consoles have their turn at the same ticks.
  /// @param tick  number of the server's tick
  /// @return whether TELEMETRY is due: the caller fills `telemetry` before the next `poll_transmit`
  [[nodiscard]] bool on_tick(Time now, std::uint32_t tick, ShedLevel level) noexcept TANDEM_REALTIME {
    const bool recorders = slots_.any_every_tick() && recorder_turn_.begins(tick, interval(true, level));
    const bool consoles = console_turn_.begins(tick, interval(false, level));
    return (recorders || consoles || slots_.closing()) && slots_.on_tick(now, recorders, consoles);
  }
  [[nodiscard]] wire::SessionTelemetry& telemetry() noexcept { return telemetry_; }
  /// Number of the next TELEMETRY, for the turns of seats and tools.
  [[nodiscard]] std::uint32_t next_turn() noexcept { return turn_++; }
  /// False: `poll_transmit` has nothing to send.
  [[nodiscard]] bool may_send() const noexcept { return slots_.may_send(); }
  /// Writes the next datagram; nullopt if none is due.
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::uint32_t tick,
                                                      std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    return slots_.poll_transmit(now, tick, buffer, [&](Connection& to) {
      return to.seal(now, tick, wire::Type::kTelemetry, telemetry_, codec_, buffer);
    });
  }

 private:
  [[nodiscard]] std::uint32_t interval_shedding(bool recorder, ShedLevel level) const noexcept;

  PeerSlots slots_;
  wire::TelemetryCodec codec_;
  std::uint32_t usual_, slowest_;  ///< intervals [ticks]: of 60 and of 2 datagrams per second
  StaggeredTurn console_turn_, recorder_turn_;
  std::uint32_t turn_ = 0;
  wire::SessionTelemetry telemetry_{};
};

}  // namespace tandem::server

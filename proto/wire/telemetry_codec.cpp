#include "proto/wire/telemetry_codec.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "proto/wire/message_body.h"

namespace tandem::wire {
namespace {

constexpr std::integral_constant<std::size_t, 3> kThree;
/// Largest gap and age of a link [ms], and largest energy margin [J], as in the telemetry of a STATE.
constexpr double kMillisecondsMax = 1e9, kJouleMax = 1e9;

/// Bits of the words of TELEMETRY (wire.proto).
constexpr std::uint32_t kTaken = 1, kHeard = 2, kEngaged = 4, kStopped = 8, kPoseKnown = 16, kGateBit = 5,
                        kSeatFlagsMax = 0xff;
constexpr std::uint32_t kInContact = 1, kBraked = 2, kSlaveKnown = 4, kToolFlagsMax = 7;
constexpr std::uint32_t kUpKnown = 1, kRttKnown = 2, kDownKnown = 4, kLinkFlagsMax = 7;
constexpr std::uint32_t kShedAt = 8, kStateMax = 0xffff, kOriginAt = 6, kTransferMax = 0x7ff;

bool finite(const std::array<double, 3>& v) noexcept {
  return std::ranges::all_of(v, [](double c) { return std::isfinite(c); });
}
bool zero(const std::array<double, 3>& v) noexcept {
  return std::ranges::all_of(v, [](double c) { return c == 0; });
}
std::array<double, 3> none() noexcept { return {kUnknown, kUnknown, kUnknown}; }

template <class Values, class Seat>
void walk_hand(Values& v, Seat& s) noexcept {
  v.message(6, detail::kWatchedHandBody);
  v.floats(1, s.x, kThree, kPositionMaxM);
  v.floats(2, s.f, kThree, kEffortMax);
}
template <class Values, class Tool, class Word>
void walk_tool(Values& v, Tool& t, Word& flags) noexcept {
  v.message(7, detail::kWatchedToolBody);
  v.word(1, flags, kToolFlagsMax);
  v.floats(2, t.x, kThree, kPositionMaxM);
  v.floats(3, t.f, kThree, kEffortMax);
  v.number32(4, t.depth, -kPositionMaxM, kPositionMaxM);
}
template <class Values, class Link, class Word>
void walk_link(Values& v, Link& l, Word& flags, std::size_t seats) noexcept {
  v.message(8, detail::kWatchedLinkBody);
  v.word(1, flags, kLinkFlagsMax);
  v.word(2, l.seat, static_cast<std::uint32_t>(seats) - 1);
  v.number32(3, l.rtt_p50_ms, 0, kMillisecondsMax);
  v.number32(4, l.loss_up_percent, 0, 100);
  v.number32(5, l.gap_up_ms, 0, kMillisecondsMax);
  v.number32(6, l.loss_down_percent, 0, 100);
  v.number32(7, l.gap_down_ms, 0, kMillisecondsMax);
  v.number32(8, l.age_p99_ms, 0, kMillisecondsMax);
  v.number32(9, l.margin_min_j, -kJouleMax, kJouleMax);
  v.word(10, l.gate_trips);
  v.word(11, l.late_ticks);
}
template <class Values, class Authority, class Word>
void walk_authority(Values& v, Authority& a, Word& transfer, const TelemetryLayout& l) noexcept {
  v.message(9, detail::watched_authority_body(l.masters));
  v.word(1, a.tool, static_cast<std::uint32_t>(l.tools) - 1);
  v.word(2, transfer, kTransferMax);
  v.floats(3, a.wanted, l.masters, 1);
  v.floats(4, a.applied, l.masters, 1);
}
template <class Values, class Message, class Word>
void walk_head(Values& v, Message& m, Word& state) noexcept {
  v.word(1, m.session_tick);
  v.word(2, state, kStateMax);
  v.word(3, m.authority_version);
  v.word(4, m.stops);
}

bool pose_known(const WatchedSeatState& s) noexcept { return finite(s.x) && finite(s.f); }
std::uint32_t seat_flags(const WatchedSeatState& s, bool master) noexcept {
  return (s.taken ? kTaken : 0) | (s.heard ? kHeard : 0) | (s.engaged ? kEngaged : 0) | (s.stopped ? kStopped : 0) |
         (master && pose_known(s) ? kPoseKnown : 0) | static_cast<std::uint32_t>(s.gate) << kGateBit;
}
/// @return whether gate and pose fit the seat
bool read_seat_flags(std::uint32_t flags, bool master, WatchedSeatState& out) noexcept {
  out.taken = (flags & kTaken) != 0;
  out.heard = (flags & kHeard) != 0;
  out.engaged = (flags & kEngaged) != 0;
  out.stopped = (flags & kStopped) != 0;
  out.gate = static_cast<GateState>(flags >> kGateBit & 7U);
  return out.gate <= GateState::kFault && (master || (flags & kPoseKnown) == 0);
}
void write_hand(FieldWriter& values, const WatchedSeatState& s) noexcept {
  WatchedSeatState sent = s;
  if (!pose_known(s)) sent.x = sent.f = {};
  walk_hand(values, sent);
}

void write_tool(FieldWriter& values, const WatchedToolState& t) noexcept {
  const bool known = finite(t.x) && finite(t.f) && std::isfinite(t.depth);
  const std::uint32_t flags = (t.touching ? kInContact : 0) | (t.braked ? kBraked : 0) | (known ? kSlaveKnown : 0);
  WatchedToolState sent = t;
  if (!known) {
    sent.x = sent.f = {};
    sent.depth = 0;
  }
  walk_tool(values, sent, flags);
}
void read_tool(FieldReader& values, WatchedToolState& out) noexcept {
  std::uint32_t flags = 0;
  walk_tool(values, out, flags);
  out.touching = (flags & kInContact) != 0;
  out.braked = (flags & kBraked) != 0;
  if ((flags & kSlaveKnown) != 0) return;
  values.require(zero(out.x) && zero(out.f) && out.depth == 0);
  out.x = out.f = none();
  out.depth = kUnknown;
}

void write_link(FieldWriter& values, const WatchedLink& l, std::size_t seats) noexcept {
  const bool up = std::isfinite(l.loss_up_percent) && std::isfinite(l.gap_up_ms), rtt = std::isfinite(l.rtt_p50_ms);
  const bool down = std::isfinite(l.loss_down_percent) && std::isfinite(l.gap_down_ms) && std::isfinite(l.age_p99_ms) &&
                    std::isfinite(l.margin_min_j);
  const std::uint32_t flags = (up ? kUpKnown : 0) | (rtt ? kRttKnown : 0) | (down ? kDownKnown : 0);
  WatchedLink sent = l;
  if (!up) sent.loss_up_percent = sent.gap_up_ms = 0;
  if (!rtt) sent.rtt_p50_ms = 0;
  if (!down) sent.loss_down_percent = sent.gap_down_ms = sent.age_p99_ms = sent.margin_min_j = 0;
  walk_link(values, sent, flags, seats);
}
void read_link(FieldReader& values, WatchedLink& out, std::size_t seats) noexcept {
  std::uint32_t flags = 0;
  walk_link(values, out, flags, seats);
  const auto unless_known = [&](std::uint32_t flag, auto&... value) {
    if ((flags & flag) != 0) return;
    values.require(((value == 0) && ...));
    ((value = kUnknown), ...);
  };
  unless_known(kUpKnown, out.loss_up_percent, out.gap_up_ms);
  unless_known(kRttKnown, out.rtt_p50_ms);
  unless_known(kDownKnown, out.loss_down_percent, out.gap_down_ms, out.age_p99_ms, out.margin_min_j);
}

void read_authority(FieldReader& values, WatchedAuthority& out, const TelemetryLayout& layout) noexcept {
  std::uint32_t transfer = 0;
  walk_authority(values, out, transfer, layout);
  out.transfer_ticks = transfer & ((1U << kOriginAt) - 1);
  out.transfer_by = transfer >> kOriginAt;
  values.require(out.transfer_ticks <= kTransferNoticeTicks && (out.transfer_ticks > 0 || out.transfer_by == 0));
  values.require(out.transfer_by <= layout.seats || out.transfer_by == TransferParties::kOperator);
  for (std::size_t i = 0; i < layout.masters; ++i) values.require(out.wanted[i] >= 0 && out.applied[i] >= 0);
}

}  // namespace

std::size_t TelemetryCodec::encode(const Preamble& preamble, const SessionTelemetry& in,
                                   std::span<std::byte> out) const noexcept {
  return body::write(preamble, telemetry_size(layout_), out, [&](FieldWriter& values) {
    const std::uint32_t state = static_cast<std::uint32_t>(in.state) | in.shed_level << kShedAt;
    walk_head(values, in, state);
    std::array<std::uint32_t, kSeatsMax> flags{};
    for (std::size_t i = 0; i < layout_.seats; ++i) flags[i] = seat_flags(in.seats[i], i < layout_.masters);
    values.words(5, flags, layout_.seats, kSeatFlagsMax);
    for (std::size_t i = 0; i < layout_.masters; ++i) write_hand(values, in.seats[i]);
    for (std::size_t j = 0; j < layout_.tools; ++j) write_tool(values, in.tools[j]);
    write_link(values, in.link, layout_.seats);
    const std::uint32_t transfer = in.authority.transfer_ticks | in.authority.transfer_by << kOriginAt;
    walk_authority(values, in.authority, transfer, layout_);
  });
}

Decoded<SessionTelemetry> TelemetryCodec::decode_telemetry(std::span<const std::byte> in) const noexcept {
  return body::read<SessionTelemetry>(in, telemetry_size(layout_), [this](FieldReader& values, SessionTelemetry& out) {
    std::uint32_t state = 0;
    walk_head(values, out, state);
    values.require((state & 0xffU) <= static_cast<std::uint32_t>(SessionState::kOverloaded));
    out.state = static_cast<SessionState>(state & 0xffU);
    out.shed_level = state >> kShedAt & 0xffU;
    values.require(out.shed_level <= kShedLevelMax);
    std::array<std::uint32_t, kSeatsMax> flags{};
    values.words(5, flags, layout_.seats, kSeatFlagsMax);
    for (std::size_t i = 0; i < layout_.seats; ++i)
      values.require(read_seat_flags(flags[i], i < layout_.masters, out.seats[i]));
    for (std::size_t i = 0; i < layout_.masters; ++i) {
      walk_hand(values, out.seats[i]);
      if ((flags[i] & kPoseKnown) != 0) continue;
      values.require(zero(out.seats[i].x) && zero(out.seats[i].f));
      out.seats[i].x = out.seats[i].f = none();
    }
    for (std::size_t j = 0; j < layout_.tools; ++j) read_tool(values, out.tools[j]);
    read_link(values, out.link, layout_.seats);
    read_authority(values, out.authority, layout_);
  });
}

std::size_t TelemetryCodec::encode(const Preamble& preamble, const WatchMessage&,
                                   std::span<std::byte> out) const noexcept {
  return body::write(preamble, kWatchSize, out, [](FieldWriter& values) { values.zeros(1, detail::kWatchPadding); });
}

Decoded<WatchMessage> TelemetryCodec::decode_watch(std::span<const std::byte> in) const noexcept {
  return body::read<WatchMessage>(in, kWatchSize,
                                  [](FieldReader& values, WatchMessage&) { values.zeros(1, detail::kWatchPadding); });
}

}  // namespace tandem::wire

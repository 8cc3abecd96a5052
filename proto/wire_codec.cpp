#include "proto/wire_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "proto/wire_messages.h"

namespace tandem::wire {
namespace {

static_assert(std::endian::native == std::endian::little, "the preamble is copied as it lies in memory");

template <class Repeated, std::size_t N>
void put(const std::array<double, N>& in, std::size_t count, Repeated& out) {
  using Element = std::remove_reference_t<decltype(*out.mutable_data())>;
  out.Resize(static_cast<int>(count), 0);
  for (std::size_t i = 0; i < count; ++i) out.mutable_data()[i] = static_cast<Element>(in[i]);
}
void put(const EnergyArray& in, std::size_t count, google::protobuf::RepeatedField<std::uint64_t>& out) {
  out.Resize(static_cast<int>(count), 0);
  std::copy_n(in.begin(), count, out.mutable_data());
}

/// Reads numbers and remembers the worst thing seen.
class Judge {
 public:
  template <class Repeated, std::size_t N>
  void magnitudes(const Repeated& in, double limit, std::array<double, N>& out) noexcept {
    for (int i = 0; i < in.size(); ++i)
      out[static_cast<std::size_t>(i)] = magnitude(static_cast<double>(in.Get(i)), limit);
  }
  void energies(const google::protobuf::RepeatedField<std::uint64_t>& in, EnergyArray& out) noexcept {
    for (int i = 0; i < in.size(); ++i) {
      out[static_cast<std::size_t>(i)] = in.Get(i);
      in_range_ &= in.Get(i) <= kEnergyMax;
    }
  }
  double magnitude(double value, double limit) noexcept { return within(value, -limit, limit); }
  double within(double value, double low, double high) noexcept {
    if (!(value >= low && value <= high)) [[unlikely]] {  // also true for NaN
      in_range_ = false;
      finite_ = finite_ && std::isfinite(value);
    }
    return value;
  }
  std::uint32_t at_most(std::uint32_t value, std::uint32_t limit) noexcept {
    in_range_ &= value <= limit;
    return value;
  }
  void require(bool condition) noexcept { in_range_ &= condition; }

  template <class Message>
  Decoded<Message>& verdict(Decoded<Message>& result) const noexcept {
    if (!finite_) {
      result = std::unexpected(DecodeError::kNotFinite);
    } else if (!in_range_) {
      result = std::unexpected(DecodeError::kOutOfRange);
    }
    return result;
  }

 private:
  bool finite_ = true;
  bool in_range_ = true;
};

/// Energies of telemetry are cumulative joules of a hand; beyond this they cannot be meant.
constexpr double kJouleMax = 1e9;
/// Gaps and ages of a link: eleven days.
constexpr double kMillisecondsMax = 1e9;

/// Writes preamble and body.
template <class Body>
std::size_t write(const Preamble& preamble, const Body& body, std::span<std::byte> out) noexcept {
  const std::size_t size = kPreambleSize + body.ByteSizeLong();
  if (out.size() < size) return 0;
  std::memcpy(out.data(), &preamble, kPreambleSize);
  const auto rest = out.subspan(kPreambleSize, size - kPreambleSize);
  return body.SerializePartialToArray(rest.data(), static_cast<int>(rest.size())) ? size : 0;
}
static_assert(sizeof(Preamble) == kPreambleSize && std::is_trivially_copyable_v<Preamble>);

Preamble read_preamble(std::span<const std::byte> in) noexcept {
  Preamble preamble;
  std::memcpy(&preamble, in.data(), kPreambleSize);
  return preamble;
}

/// Size and skeleton first: what is left for the parser is what the encoder could have made.
template <class Body, std::size_t N>
std::expected<void, DecodeError> read(std::span<const std::byte> in, const Skeleton<N>& skeleton, Body& body) noexcept {
  if (in.size() != kPreambleSize + skeleton.size()) return std::unexpected(DecodeError::kSize);
  const auto bytes = in.subspan(kPreambleSize);
  if (!skeleton.matches(bytes) || !body.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return std::unexpected(DecodeError::kMalformed);
  }
  return {};
}

}  // namespace

Codec::Codec(std::size_t axes, PortSpace port) : messages_(std::make_unique<Messages>()) { configure(axes, port); }
Codec::~Codec() = default;
Codec::Codec(Codec&&) noexcept = default;
Codec& Codec::operator=(Codec&&) noexcept = default;

void Codec::configure(std::size_t axes, PortSpace port) noexcept {
  messages_->configure(std::clamp<std::size_t>(axes, 1, kAxesMax),
                       port == PortSpace::kTip ? kPositionMaxM : kPositionMaxRad);
}
std::size_t Codec::axes() const noexcept { return messages_->axes; }

std::size_t Codec::encode(const Preamble& preamble, const StateMessage& in, std::span<std::byte> out) noexcept {
  auto& s = messages_->state;
  const std::size_t axes = messages_->axes;
  put(in.port.x, axes, *s.mutable_x());
  put(in.port.v, axes, *s.mutable_v());
  put(in.port.f, axes, *s.mutable_f());
  put(in.port.e_in, axes, *s.mutable_e_in());
  put(in.telemetry.q, axes, *s.mutable_q());
  put(in.telemetry.x, 3, *s.mutable_tip_x());
  put(in.telemetry.f_cmd, 3, *s.mutable_f_cmd());
  put(in.telemetry.f_out, 3, *s.mutable_f_out());
  put(in.telemetry.e_out, axes, *s.mutable_e_out());
  s.set_dissipated_j(static_cast<float>(in.telemetry.dissipated_j));
  s.set_refused_j(static_cast<float>(in.telemetry.refused_j));
  s.set_delivered_j(static_cast<float>(in.telemetry.delivered_j));
  s.set_margin_min_j(static_cast<float>(in.telemetry.margin_min_j));
  s.set_gate(static_cast<std::uint32_t>(in.gate));
  s.set_flags((in.ready ? 1U : 0U) | (in.engaged ? 2U : 0U) | (in.stop ? 4U : 0U) | (in.stop_all ? 8U : 0U));
  s.set_gate_trips(in.gate_trips);
  s.set_late_ticks(in.late_ticks);
  s.set_seat_tick(in.seat_tick);
  put(in.telemetry.f_env, 3, *s.mutable_f_env());
  s.set_penetration_m(static_cast<float>(in.telemetry.penetration_m));
  s.set_down_loss_percent(static_cast<float>(in.telemetry.down_loss_percent));
  s.set_down_longest_gap_ms(static_cast<float>(in.telemetry.down_longest_gap_ms));
  s.set_down_age_p99_ms(static_cast<float>(in.telemetry.down_age_p99_ms));
  s.set_resume_stop(in.resume_stop);
  return write(preamble, s, out);
}

std::size_t Codec::encode(const Preamble& preamble, const ForceMessage& in, std::span<std::byte> out) noexcept {
  auto& f = messages_->force;
  const std::size_t axes = messages_->axes;
  put(in.port.x, axes, *f.mutable_x());
  put(in.port.v, axes, *f.mutable_v());
  put(in.port.f, axes, *f.mutable_f());
  put(in.port.e_in, axes, *f.mutable_e_in());
  f.set_session(static_cast<std::uint32_t>(in.session));
  f.set_engage(in.engage ? 1 : 0);
  f.set_session_tick(in.session_tick);
  f.set_authority_version(in.authority_version);
  f.set_missing(in.missing);
  f.set_alpha(in.alpha);
  f.set_stops(in.stops);
  return write(preamble, f, out);
}

std::size_t Codec::encode(const Preamble& preamble, const PathMessage& in, std::span<std::byte> out) noexcept {
  messages_->path.set_token(in.token);
  return write(preamble, messages_->path, out);
}

std::size_t Codec::encode(const Preamble& preamble, const AuthorityMessage& in, std::span<std::byte> out) noexcept {
  if (in.masters > kMastersMax) return 0;
  auto& a = messages_->authority;
  a.set_version(in.version);
  a.set_tool(in.tool);
  a.set_masters(in.masters);
  put(in.alpha, kMastersMax, *a.mutable_alpha());
  for (std::size_t i = in.masters; i < kMastersMax; ++i) a.set_alpha(static_cast<int>(i), 0);
  return write(preamble, a, out);
}

std::size_t Codec::encode(const Preamble& preamble, const CloseMessage& in, std::span<std::byte> out) noexcept {
  messages_->close.set_reason(static_cast<std::uint32_t>(in.reason));
  return write(preamble, messages_->close, out);
}

std::size_t Codec::encode(const Preamble& preamble, const PingMessage&, std::span<std::byte> out) noexcept {
  if (out.size() < kPingSize) return 0;
  std::memcpy(out.data(), &preamble, kPreambleSize);
  return kPingSize;
}

Decoded<StateMessage> Codec::decode_state(std::span<const std::byte> in) noexcept {
  auto& s = messages_->state;
  if (auto ok = read(in, messages_->state_skeleton, s); !ok) return std::unexpected(ok.error());
  Decoded<StateMessage> result{std::in_place};
  result->preamble = read_preamble(in);
  auto& out = result->message;
  Judge judge;
  judge.magnitudes(s.x(), messages_->position_max, out.port.x);
  judge.magnitudes(s.v(), kVelocityMax, out.port.v);
  judge.magnitudes(s.f(), kEffortMax, out.port.f);
  judge.energies(s.e_in(), out.port.e_in);
  judge.magnitudes(s.q(), kPositionMaxRad, out.telemetry.q);
  judge.magnitudes(s.tip_x(), kPositionMaxM, out.telemetry.x);
  judge.magnitudes(s.f_cmd(), kEffortMax, out.telemetry.f_cmd);
  judge.magnitudes(s.f_out(), kEffortMax, out.telemetry.f_out);
  judge.energies(s.e_out(), out.telemetry.e_out);
  out.telemetry.dissipated_j = judge.magnitude(static_cast<double>(s.dissipated_j()), kJouleMax);
  out.telemetry.refused_j = judge.magnitude(static_cast<double>(s.refused_j()), kJouleMax);
  out.telemetry.delivered_j = judge.magnitude(static_cast<double>(s.delivered_j()), kJouleMax);
  out.telemetry.margin_min_j = judge.magnitude(static_cast<double>(s.margin_min_j()), kJouleMax);
  out.gate = static_cast<GateState>(judge.at_most(s.gate(), static_cast<std::uint32_t>(GateState::kFault)));
  const auto flags = judge.at_most(s.flags(), 15);
  out.ready = (flags & 1U) != 0;
  out.engaged = (flags & 2U) != 0;
  out.stop = (flags & 4U) != 0;
  out.stop_all = (flags & 8U) != 0;
  out.resume_stop = s.resume_stop();
  out.gate_trips = s.gate_trips();
  out.late_ticks = s.late_ticks();
  out.seat_tick = s.seat_tick();
  judge.magnitudes(s.f_env(), kEffortMax, out.telemetry.f_env);
  out.telemetry.penetration_m = judge.magnitude(static_cast<double>(s.penetration_m()), kPositionMaxM);
  out.telemetry.down_loss_percent = judge.within(static_cast<double>(s.down_loss_percent()), 0, 100);
  out.telemetry.down_longest_gap_ms = judge.within(static_cast<double>(s.down_longest_gap_ms()), 0, kMillisecondsMax);
  out.telemetry.down_age_p99_ms = judge.within(static_cast<double>(s.down_age_p99_ms()), 0, kMillisecondsMax);
  return judge.verdict(result);
}

Decoded<ForceMessage> Codec::decode_force(std::span<const std::byte> in) noexcept {
  auto& f = messages_->force;
  if (auto ok = read(in, messages_->force_skeleton, f); !ok) return std::unexpected(ok.error());
  Decoded<ForceMessage> result{std::in_place};
  result->preamble = read_preamble(in);
  auto& out = result->message;
  Judge judge;
  judge.magnitudes(f.x(), messages_->position_max, out.port.x);
  judge.magnitudes(f.v(), kVelocityMax, out.port.v);
  judge.magnitudes(f.f(), kEffortMax, out.port.f);
  judge.energies(f.e_in(), out.port.e_in);
  out.session =
      static_cast<SessionState>(judge.at_most(f.session(), static_cast<std::uint32_t>(SessionState::kEnding)));
  out.engage = judge.at_most(f.engage(), 1) != 0;
  out.session_tick = f.session_tick();
  out.authority_version = f.authority_version();
  out.missing = judge.at_most(f.missing(), kSeatsMax);
  out.alpha = judge.within(f.alpha(), 0, 1);
  out.stops = f.stops();
  return judge.verdict(result);
}

Decoded<PathMessage> Codec::decode_path(std::span<const std::byte> in) noexcept {
  auto& p = messages_->path;
  if (auto ok = read(in, messages_->path_skeleton, p); !ok) return std::unexpected(ok.error());
  return Received<PathMessage>{read_preamble(in), {p.token()}};
}

Decoded<AuthorityMessage> Codec::decode_authority(std::span<const std::byte> in) noexcept {
  auto& a = messages_->authority;
  if (auto ok = read(in, messages_->authority_skeleton, a); !ok) return std::unexpected(ok.error());
  Decoded<AuthorityMessage> result{std::in_place};
  result->preamble = read_preamble(in);
  auto& out = result->message;
  Judge judge;
  out.version = a.version();
  out.tool = judge.at_most(a.tool(), kToolsMax - 1);
  out.masters = judge.at_most(a.masters(), kMastersMax);
  double sum = 0;
  for (std::size_t i = 0; i < kMastersMax; ++i) {
    const double most = i < out.masters ? 1 : 0;
    out.alpha[i] = judge.within(a.alpha(static_cast<int>(i)), 0, most);
    sum += out.alpha[i];
  }
  judge.require(std::abs(sum - 1) <= 1e-9);
  return judge.verdict(result);
}

Decoded<CloseMessage> Codec::decode_close(std::span<const std::byte> in) noexcept {
  auto& c = messages_->close;
  if (auto ok = read(in, messages_->close_skeleton, c); !ok) return std::unexpected(ok.error());
  Decoded<CloseMessage> result{std::in_place};
  result->preamble = read_preamble(in);
  Judge judge;
  result->message.reason =
      static_cast<CloseReason>(judge.at_most(c.reason(), static_cast<std::uint32_t>(CloseReason::kRefused)));
  return judge.verdict(result);
}

Decoded<PingMessage> Codec::decode_ping(std::span<const std::byte> in) noexcept {
  if (in.size() != kPingSize) return std::unexpected(DecodeError::kSize);
  return Received<PingMessage>{read_preamble(in), {}};
}

}  // namespace tandem::wire

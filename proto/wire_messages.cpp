#include "proto/wire_messages.h"

#include <array>
#include <span>

namespace tandem::wire {
namespace {

/// More elements than any plaintext can hold, so that even bytes that were not meant never make an array grow.
constexpr int kReserve = static_cast<int>(kPlaintextMax / sizeof(float));

void shape(pb::State& s, std::size_t axes, Bits bits) noexcept {
  for (auto* array : {s.mutable_x(), s.mutable_v(), s.mutable_f()}) fill(*array, axes, bits);
  fill(*s.mutable_e_in(), axes, bits);
  fill(*s.mutable_q(), axes, bits);
  for (auto* array : {s.mutable_tip_x(), s.mutable_f_cmd(), s.mutable_f_out()}) fill(*array, 3, bits);
  fill(*s.mutable_e_out(), axes, bits);
  s.set_dissipated_j(of<float>(bits));
  s.set_refused_j(of<float>(bits));
  s.set_delivered_j(of<float>(bits));
  s.set_margin_min_j(of<float>(bits));
  s.set_gate(of<std::uint32_t>(bits));
  s.set_flags(of<std::uint32_t>(bits));
  s.set_gate_trips(of<std::uint32_t>(bits));
  s.set_late_ticks(of<std::uint32_t>(bits));
  s.set_seat_tick(of<std::uint32_t>(bits));
  fill(*s.mutable_f_env(), 3, bits);
  s.set_penetration_m(of<float>(bits));
  s.set_down_loss_percent(of<float>(bits));
  s.set_down_longest_gap_ms(of<float>(bits));
  s.set_down_age_p99_ms(of<float>(bits));
  s.set_resume_stop(of<std::uint32_t>(bits));
}
void shape(pb::Force& f, std::size_t axes, Bits bits) noexcept {
  for (auto* array : {f.mutable_x(), f.mutable_v(), f.mutable_f()}) fill(*array, axes, bits);
  fill(*f.mutable_e_in(), axes, bits);
  f.set_session(of<std::uint32_t>(bits));
  f.set_engage(of<std::uint32_t>(bits));
  f.set_session_tick(of<std::uint32_t>(bits));
  f.set_authority_version(of<std::uint32_t>(bits));
  f.set_missing(of<std::uint32_t>(bits));
  f.set_alpha(of<double>(bits));
  f.set_stops(of<std::uint32_t>(bits));
}
void shape(pb::Path& p, std::size_t, Bits bits) noexcept { p.set_token(of<std::uint64_t>(bits)); }
void shape(pb::AuthorityChange& a, std::size_t, Bits bits) noexcept {
  a.set_version(of<std::uint32_t>(bits));
  a.set_tool(of<std::uint32_t>(bits));
  a.set_masters(of<std::uint32_t>(bits));
  fill(*a.mutable_alpha(), kMastersMax, bits);
}
void shape(pb::Close& c, std::size_t, Bits bits) noexcept { c.set_reason(of<std::uint32_t>(bits)); }

/// Learns the bytes that carry structure from two messages that differ in every bit of every value.
template <class Body, std::size_t N>
void learn(Body& body, std::size_t axes, Skeleton<N>& skeleton) noexcept {
  std::array<std::uint8_t, N> zeros{}, ones{};
  shape(body, axes, Bits::kZeros);
  const std::size_t size = body.ByteSizeLong();
  if (size > N) return;  // cannot happen, see the sizes in the header: an empty skeleton refuses everything
  body.SerializeWithCachedSizesToArray(zeros.data());
  shape(body, axes, Bits::kOnes);
  (void)body.ByteSizeLong();
  body.SerializeWithCachedSizesToArray(ones.data());
  skeleton = Skeleton<N>(std::span(zeros).first(size), std::span(ones).first(size));
}

}  // namespace

Codec::Messages::Messages() {
  for (auto* array : {state.mutable_x(), state.mutable_v(), state.mutable_f(), force.mutable_x(), force.mutable_v(),
                      force.mutable_f(), authority.mutable_alpha()}) {
    array->Reserve(kReserve);
  }
  for (auto* array : {state.mutable_e_in(), state.mutable_e_out(), force.mutable_e_in()}) array->Reserve(kReserve);
  for (auto* array : {state.mutable_q(), state.mutable_tip_x(), state.mutable_f_cmd(), state.mutable_f_out()}) {
    array->Reserve(kReserve);
  }
  learn(path, 0, path_skeleton);
  learn(authority, 0, authority_skeleton);
  learn(close, 0, close_skeleton);
}

void Codec::Messages::configure(std::size_t axes_now, double position_max_now) noexcept {
  axes = axes_now;
  position_max = position_max_now;
  learn(state, axes, state_skeleton);
  learn(force, axes, force_skeleton);
}

}  // namespace tandem::wire

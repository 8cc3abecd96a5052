#include "server/seat_port.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::server {

namespace {
/// How long a seat that fell silent still holds its end of the spring: then its weight goes to others or the tool is braked.
/// With the ramp of a lost holder's weight (`common/control/authority.cpp`, 100 ms) within 220 ms (design notes, security 2.4).
constexpr Duration kHoldLimit = std::chrono::milliseconds(100);
/// A client whose gate must have let go for silence is believed to be deaf so much later.
constexpr Duration kDeafMargin = std::chrono::milliseconds(10);
/// Its own word aside: echoes that stand still for so long while datagrams come, or for as long as it may be deaf if that is longer.
constexpr Duration kEchoStallMax = std::chrono::milliseconds(200);
/// Between two samples of an engaged hand that are less than the hold limit apart.
constexpr double kJumpMaxM = 1, kJumpMaxRad = 5;

/// How long a seat may be given force without news, at the longest [s].
double patience(const SceneSpec& scene, std::size_t seat) {
  return scene.seats[seat].kind == SeatKind::kMaster ? silence_limits(scene.gate, scene.channel.law, 1).most : scene.gate.silence_limit;
}
/// A hand that simulates its tool holds on for as long as its own gate does: the tool waits for it.
SilenceLimits hold_limits(const SceneSpec& scene, std::size_t seat) {
  const double usual = seconds(kHoldLimit);
  const bool simulates = scene.channel.law == LawKind::kReplica && scene.seats[seat].kind == SeatKind::kMaster;
  if (!simulates) return {usual, usual};
  const SilenceLimits own = silence_limits(scene.gate, scene.channel.law, 1);
  return {std::max(usual, own.least), std::max(usual, own.most)};
}
}  // namespace

SeatPort::SeatPort(const SceneSpec& scene, std::size_t seat, const AxisArray& scale)
    : scene_(&scene),
      tick_(from_seconds(1.0 / scene.tick_hz)),
      role_(access_role(scene.seats[seat].role)),
      feels_(allowed(role_, Right::kForce) != Grant::kNo),
      hold_least_(from_seconds(hold_limits(scene, seat).least)),
      hold_most_(from_seconds(hold_limits(scene, seat).most)),
      deaf_after_(from_seconds(patience(scene, seat)) + kDeafMargin),
      ends_(make_channel_ends(scene, seat, scale)),
      end_mask_(ends_.size() == 1 ? 0 : ~std::size_t{0}) {
  const SeatSetup setup = seat_setup(scene, seat);
  tied_tools_.push_back(setup.seat.tool);
  for (const TieSetup& tie : setup.further) {
    tie_of_[tie.tool] = static_cast<std::uint8_t>(tied_tools_.size());
    tied_tools_.push_back(tie.tool);
  }
  codec_.configure(scene.dof, scene.port, setup.further.size());
  further_rx_.resize(setup.further.size());
  further_next_.resize(setup.further.size());
  further_tx_.resize(setup.further.size());
}

void SeatPort::take(Time now, Entry& entry) noexcept {
  std::unique_ptr<link::Link> before = connection_ ? connection_->give_up() : nullptr;
  connection_.emplace(now, std::exchange(entry.link, std::move(before)), tick_);
  std::swap(ends_, entry.ends);  // as many
  taken_ = true;
  generation_ = 0;
  *rx_ = {};
  std::ranges::fill(further_rx_, PortSample{});
  was_engaged_ = {};
  conduct_ = {};
  resume_ = entry.resume;
  force_scale_ = entry.force_scale;
  was_present_ = false;
}

SeatPort::Heard SeatPort::on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes, PathTokens& tokens) noexcept {
  Heard heard;
  const auto opened = connection_->open(now, from, bytes, codec_);
  if (!opened) return heard;
  link::Link& link = connection_->link();
  if (!allowed(role_, opened->type)) {
    link.refuse(link::Refusal::kRole);
    heard.forbidden = true;
    return heard;
  }
  // It opened under the client's own keys: what cannot be meant is his, and nobody else could have sent it.
  const auto offence = [&] {
    link.refuse_body();
    conduct_.offend(now);
  };
  switch (opened->type) {
    case wire::Type::kState: {
      const auto preamble = further_next_.empty() ? codec_.decode_state(opened->plaintext, *next_) : codec_.decode_state(opened->plaintext, *next_, further_next_);
      if (!preamble) {
        offence();
        break;
      }
      if (!opened->newer) break;  // latest wins: nothing acts backwards
      bool jumped = jumps(next_->port, rx_->port);
      for (std::size_t k = 0; k < further_rx_.size(); ++k) jumped |= jumps(further_next_[k], further_rx_[k]);
      if (jumped && alive(now) && rx_->engaged && next_->engaged) conduct_.offend(now);
      heard.acted = true;
      connection_->acts(now, from, *opened, *preamble, tokens);
      std::swap(rx_, next_);
      further_rx_.swap(further_next_);
      ++generation_;
      break;
    }
    case wire::Type::kAuthority:
      if (const auto decoded = codec_.decode_authority(opened->plaintext)) {
        link.accept_other();
        wish_ = decoded->message;
        heard.authority = &wish_;
      } else {
        offence();
      }
      break;
    case wire::Type::kClose:
      if (codec_.decode_close(opened->plaintext)) {
        heard.close = true;
      } else {
        offence();
      }
      break;
    default: offence(); break;
  }
  return heard;
}

bool SeatPort::alive(Time now) const noexcept {
  if (!taken_ || generation_ == 0) return false;
  const Duration silence = connection_->silence(now);
  return silence < hold_least_ || silence < connection_->link().freshness().gaps().patience(hold_least_, hold_most_);
}

bool SeatPort::deaf() const noexcept {
  const link::Freshness& fresh = connection_->link().freshness();
  return (feels_ && fresh.peer_silence() > deaf_after_) || fresh.echo_stall() > std::max(kEchoStallMax, deaf_after_);  // who feels nothing is not told often
}

bool SeatPort::jumps(const PortSample& next, const PortSample& last) noexcept {
  const double most = scene_->port == PortSpace::kTip ? kJumpMaxM : kJumpMaxRad;
  bool near = true, fell = false;
  for (std::size_t a = 0, axes = scene_->dof; a < axes; ++a) {
    near &= std::abs(next.x[a] - last.x[a]) <= most;
    fell |= next.e_in[a] < last.e_in[a];
  }
  energy_fell_ |= fell;
  return !near;
}

void SeatPort::hold(std::span<const Near> near) noexcept {
  if (was_present_) ++outages_;
  was_present_ = false;
  was_engaged_ = {};
  for (std::size_t k = 0; k < ends_.size(); ++k) ends_[k]->give_way(near[k].x);
}

void SeatPort::move(Time now, double dt, std::span<const Near> near) noexcept {
  input_.age = age_ = taken_ ? seconds(connection_->link().freshness().age(now)) : 0;
  input_.dt = dt;
  bool present = false;
  for (std::size_t k = 0; k < near.size(); ++k) {
    present |= near[k].engaged;
    move(k, near[k]);
  }
  if (was_present_ && !present) ++outages_;
  was_present_ = present;
}

void SeatPort::move(std::size_t k, const Near& near) noexcept {
  if (!near.engaged || !was_engaged_[k]) {
    was_engaged_[k] = near.engaged;
    return ends_[k]->engage(near.x, age_);
  }
  input_.weight = near.weight;
  input_.pass_on = near.pass_on;
  const PortSample& heard = heard_of(k);
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    input_.x[a] = near.x[a];
    input_.dissipated[a] = near.dissipated[a];
    input_.rx.x[a] = heard.x[a] - near.offset[a];
    input_.rx.v[a] = heard.v[a];
    input_.rx.f[a] = heard.f[a];
    input_.rx.a[a] = heard.a[a];
    input_.rx.e_in[a] = heard.e_in[a];
  }
  ends_[k]->move(input_);
}

Transmit SeatPort::transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept {
  if (further_tx_.empty()) return taken_ ? connection_->seal(now, tick, wire::Type::kForce, tx, codec_, buffer) : Transmit{};
  return !taken_ ? Transmit{} : connection_->seal(now, tick, wire::Type::kForce, wire::ForceWithTies{tx, further_tx_}, codec_, buffer);
}

Transmit SeatPort::transmit_close(Time now, std::uint32_t tick, wire::CloseReason why, std::span<std::byte> buffer) noexcept {
  return taken_ ? connection_->seal(now, tick, wire::Type::kClose, wire::CloseMessage{why}, codec_, buffer) : Transmit{};
}

}  // namespace tandem::server

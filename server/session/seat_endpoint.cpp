#include "server/session/seat_endpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::server {

static_assert(control::HeldSample::kReach == wire::kPositionMaxM, "a prediction fits into a datagram");

namespace {
/// Margin added to the silence limit of the client's gate: a client that reports more silence receives nothing.
constexpr Duration kDeafMargin = std::chrono::milliseconds(10);
/// The link counts as one-way if the client's echoes stay the same for this long while its datagrams arrive. The limit
/// is `one_way_after_` if that is longer.
constexpr Duration kEchoStallMax = std::chrono::milliseconds(200);
/// Largest credible step [m, rad] between two samples of an engaged hand that are less than the hold limit apart.
constexpr double kJumpMaxM = 1, kJumpMaxRad = 5;

/// Longest silence for which the client's gate still lets it apply force [s].
double silence_limit(const SceneSpec& scene, std::size_t seat) {
  return scene.seats[seat].kind == SeatKind::kMaster ? silence_limits(scene.gate, scene.channel.law, 1).most
                                                     : scene.gate.silence_limit;
}
/// Silence for which a seat keeps its end of the spring. Then its authority moves to other seats, or the tool is
/// braked. With the ramp-down of a lost holder's authority (`common/control/authority.cpp`, 100 ms) this ends within
/// 220 ms (ARCHITECTURE.md, invariant 38). A hand that simulates its tool (law `replica`) keeps its end for as long as
/// its own gate tolerates silence: the tool waits for it.
SilenceLimits hold_limits(const SceneSpec& scene, std::size_t seat) {
  const double usual = kServerHold;
  const bool simulates = scene.channel.law == LawKind::kReplica && scene.seats[seat].kind == SeatKind::kMaster;
  if (!simulates) return {usual, usual};
  const SilenceLimits own = silence_limits(scene.gate, scene.channel.law, 1);
  return {std::max(usual, own.least), std::max(usual, own.most)};
}
}  // namespace

SeatEndpoint::SeatEndpoint(const SceneSpec& scene, std::size_t seat, const AxisArray& scale)
    : scene_(&scene),
      tick_(from_seconds(1.0 / scene.tick_hz)),
      role_(access_role(scene.seats[seat].role)),
      receives_force_(allowed(role_, Right::kForce) != Grant::kNo),
      hold_time_min_(from_seconds(hold_limits(scene, seat).least)),
      hold_time_max_(from_seconds(hold_limits(scene, seat).most)),
      one_way_after_(from_seconds(silence_limit(scene, seat)) + kDeafMargin),
      ends_(make_channel_ends(scene, seat, scale)),
      end_mask_(ends_.size() == 1 ? 0 : ~std::size_t{0}) {
  const SeatSetup setup = seat_setup(scene, seat);
  coupled_tools_.push_back(setup.seat.tool);
  for (const CoupledTool& tie : setup.further) {
    coupling_index_[tie.tool] = static_cast<std::uint8_t>(coupled_tools_.size());
    coupled_tools_.push_back(tie.tool);
  }
  codec_.configure(body_layout(setup));
  further_rx_.resize(setup.further.size());
  further_next_.resize(setup.further.size());
  further_tx_.resize(setup.further.size());
  held_ = setup::held_sample(setup);
  if (held_.on()) pace_.emplace(setup);
}

void SeatEndpoint::attach(Time now, SeatConnection& entry) noexcept {
  std::unique_ptr<transport::SecureChannel> before = connection_ ? connection_->release_link() : nullptr;
  connection_.emplace(now, std::exchange(entry.link, std::move(before)), tick_);
  connection_->record_outputs(outputs_);
  std::swap(ends_, entry.ends);  // both have the same number of ends
  taken_ = true;
  generation_ = 0;
  *rx_ = {};
  telemetry_ = {};
  sent_telemetry_ = false;
  std::ranges::fill(further_rx_, PortSample{});
  was_engaged_ = {};
  misbehaviour_ = {};
  resume_ = entry.resume;
  force_scale_ = entry.force_scale;
  was_present_ = false;
  if (pace_) pace_->restart();
  held_.restart();
}

SeatEndpoint::Received SeatEndpoint::on_datagram(Time now, const PeerAddress& from, const transport::Header& header,
                                                 std::span<const std::byte> bytes, PathTokens& tokens) noexcept {
  Received heard;
  const auto authentic = connection_->authenticate(now, header, bytes);
  if (!authentic) return heard;
  heard.plaintext = authentic->plaintext;
  const Connection::Opened* const opened = &*authentic;
  if (!connection_->handle(now, from, *opened, codec_)) return heard;
  transport::SecureChannel& link = connection_->link();
  if (!allowed(role_, opened->type)) {
    link.drop(transport::DropReason::kRole);
    heard.forbidden = true;
    return heard;
  }
  // The payload opened under the client's own keys, so invalid content is this client's misbehaviour. No other sender
  // could have produced it.
  const auto offence = [&] {
    link.drop_body();
    misbehaviour_.report_misbehaviour(now);
  };
  switch (opened->type) {
    case wire::Type::kState: {
      const auto preamble = codec_.decode_state(opened->plaintext, *next_, further_next_);
      if (!preamble) {
        offence();
        break;
      }
      if (!opened->newer) break;  // the newest STATE wins; older ones never act
      bool jumped = jumps(next_->port, rx_->port);
      const bool several = !further_rx_.empty();
      for (std::size_t k = 0; several && k < further_rx_.size(); ++k) jumped |= jumps(further_next_[k], further_rx_[k]);
      if (jumped && alive(now) && rx_->engaged && next_->engaged) misbehaviour_.report_misbehaviour(now);
      heard.accepted_state = true;
      connection_->on_accepted_message(now, from, *opened, *preamble, tokens);
      if (next_->with_telemetry) {
        telemetry_ = next_->telemetry;
        sent_telemetry_ = true;
      }
      std::swap(rx_, next_);
      if (several) further_rx_.swap(further_next_);
      ++generation_;
      held_.restart();
      break;
    }
    case wire::Type::kAuthority:
      if (const auto decoded = codec_.decode_authority(opened->plaintext)) {
        link.accept_other();
        authority_request_ = decoded->message;
        heard.authority = &authority_request_;
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
    default:
      offence();
      break;
  }
  return heard;
}

bool SeatEndpoint::alive(Time now) const noexcept {
  if (!taken_ || generation_ == 0) return false;
  const Duration silence = connection_->silence(now);
  return silence < hold_time_min_ ||
         silence < connection_->link().timing().gaps().silence_limit(hold_time_min_, hold_time_max_);
}

bool SeatEndpoint::one_way() const noexcept {
  const transport::LinkTiming& fresh = connection_->link().timing();
  // Seats without force receive at most 60 FORCE datagrams per second, so their echoes change rarely.
  return (receives_force_ && fresh.peer_silence() > one_way_after_) ||
         fresh.echo_stall() > std::max(kEchoStallMax, one_way_after_);
}

bool SeatEndpoint::jumps(const PortSample& next, const PortSample& last) noexcept {
  const double most = scene_->port == PortSpace::kTip ? kJumpMaxM : kJumpMaxRad;
  bool near = true, fell = false;
  each_axis(scene_->dof, [&](std::size_t a) {
    near &= std::abs(next.x[a] - last.x[a]) <= most;
    fell |= next.e_in[a] < last.e_in[a];
  });
  energy_fell_ |= fell;
  return !near;
}

void SeatEndpoint::hold(std::span<const control::NearEnd> near) noexcept {
  if (was_present_) ++outages_;
  was_present_ = false;
  was_engaged_ = {};
  for (std::size_t k = 0; k < ends_.size(); ++k) ends_[k]->clamp_reference(near[k].x);
}

void SeatEndpoint::move(Time now, double dt, std::span<const control::NearEnd> near) noexcept {
  input_.age = age_ = taken_ ? seconds(connection_->link().timing().age(now)) : 0;
  if (held_.on() && taken_) [[unlikely]]
    predict(now);
  input_.dt = dt;
  bool present = false;
  for (std::size_t k = 0; k < near.size(); ++k) {
    present |= near[k].engaged;
    move(k, near[k]);
  }
  if (was_present_ && !present) ++outages_;
  was_present_ = present;
}

void SeatEndpoint::predict(Time now) noexcept {
  const double step = held_.advance(seconds(connection_->link().timing().silence(now)));
  input_.age = age_ -= held_.held();
  held_.predict(rx_->port, scene_->dof, step);
  for (PortSample& port : further_rx_) held_.predict(port, scene_->dof, step);
}

void SeatEndpoint::move(std::size_t k, const control::NearEnd& near) noexcept {
  if (!near.engaged || !was_engaged_[k]) {
    was_engaged_[k] = near.engaged;
    return ends_[k]->engage(near.x, age_);
  }
  input_.weight = near.weight;
  input_.pass_on = near.heat_share;
  const PortSample& heard = last_sample(k);
  each_axis(scene_->dof, [&](std::size_t a) {
    input_.x[a] = near.x[a];
    input_.dissipated[a] = near.dissipated[a];
    input_.rx.x[a] = heard.x[a] - near.offset[a];
    input_.rx.v[a] = heard.v[a];
    input_.rx.f[a] = heard.f[a];
    input_.rx.a[a] = heard.a[a];
    input_.rx.e_in[a] = heard.e_in[a];
  });
  ends_[k]->move(input_);
}

Transmit SeatEndpoint::transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept {
  if (!taken_) return {};
  const Transmit out = further_tx_.empty() ? connection_->seal(now, tick, wire::Type::kForce, tx, codec_, buffer)
                                           : connection_->seal(now, tick, wire::Type::kForce,
                                                               wire::ForceWithTools{tx, further_tx_}, codec_, buffer);
  if (pace_ && out.size > 0) [[unlikely]]
    pace_->sent(tick, tx, further_tx_);
  return out;
}

Transmit SeatEndpoint::transmit_close(Time now, std::uint32_t tick, wire::CloseReason why,
                                      std::span<std::byte> buffer) noexcept {
  return taken_ ? connection_->seal(now, tick, wire::Type::kClose, wire::CloseMessage{why}, codec_, buffer)
                : Transmit{};
}

}  // namespace tandem::server

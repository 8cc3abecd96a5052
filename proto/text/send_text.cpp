#include <array>
#include <cmath>
#include <optional>

#include "proto/text/message_keys.h"
#include "proto/text/scene_convert.h"
#include "proto/text/scene_text.h"

namespace tandem {
namespace {

using text::MessageValidator;
using text::number_text;

constexpr std::array<text::MessageKey<SendSpec>, 3> kSendKeys{{{"rate_hz", &SendSpec::rate},
                                                               {"heartbeat_ms", &SendSpec::heartbeat, 1e3},
                                                               {"prediction_order", &SendSpec::prediction_order}}};
constexpr std::array<text::MessageKey<DeadBandSpec>, 3> kDeadBandKeys{
    {{"weber", &DeadBandSpec::weber},
     {"velocity_floor_m_s", &DeadBandSpec::velocity_floor},
     {"force_floor_n", &DeadBandSpec::force_floor}}};
constexpr double kRounding = 1e-9;  ///< relative; a written maximum counts as the maximum
/// Rounds to 4 decimals for messages, so that a user may write the number shown.
double round_down(double ms) { return std::floor(ms * 1e4) / 1e4; }
double round_up(double hz) { return std::ceil(hz * 1e4) / 1e4; }

}  // namespace

void read_send(const pb::Send& in, SendSpec& out) {
  text::read_keys(in, kSendKeys, out);
  if (in.has_dead_band()) text::read_keys(in.dead_band(), kDeadBandKeys, out.dead_band.emplace());
}

void write_send(const SendSpec& in, pb::Send& out) {
  if (in.rate > 0) out.set_rate_hz(in.rate);
  if (in.heartbeat > 0) out.set_heartbeat_ms(in.heartbeat * 1e3);
  out.set_prediction_order(in.prediction_order);
  if (in.dead_band) text::write_keys(*in.dead_band, kDeadBandKeys, *out.mutable_dead_band());
}

std::optional<LawProblem> send_problem(const SendSpec& send, const ChannelSpec& channel, const GateSpec& gate,
                                       PortSpace port, double tick_hz) {
  if (!send.is_on()) return std::nullopt;
  if (channel.law != LawKind::kReplica && channel.law != LawKind::kSetPosition)
    return LawProblem{"send",
                      "holds datagrams back; laws TDPA, WAVE, PD and RAW need one at every tick, because they act on "
                      "each single one. Use law: REPLICA or SET_POSITION, or remove send"};
  if (channel.mfs == MfsMode::kSeed || channel.mfs == MfsMode::kSeedSigned)
    return LawProblem{"send",
                      "holds datagrams back; mfs SEED and SEED_SIGNED compare the exact energies of every tick with 0. "
                      "Use mfs: OPEN or TANK, or remove send"};
  if (port != PortSpace::kTip)
    return LawProblem{"send", "compares metres and newtons with what a hand notices; it needs port: TIP"};
  const double longest = heartbeat_max(gate, channel.law);
  const std::string reason = " ms, a sixth of the shortest silence that gates and server tolerate";
  if (send.heartbeat > longest * (1 + kRounding))
    return LawProblem{"send.heartbeat_ms", "must be at most " + number_text(round_down(longest * 1e3)) + reason +
                                               "; lower it, or raise gate.silence_limit_ms (SET_POSITION) or "
                                               "gate.follow_hold_ms (REPLICA)"};
  if (send.rate > tick_hz * (1 + kRounding))
    return LawProblem{"send.rate_hz", "must be at most tick_hz = " + number_text(tick_hz) + " Hz"};
  const double heartbeat = send.heartbeat > 0 ? send.heartbeat : longest;
  const double ticks = std::floor(heartbeat * tick_hz * (1 + kRounding));
  if (ticks < 1)
    return LawProblem{"send.heartbeat_ms", "must be at least one tick = " + number_text(1e3 / tick_hz) + " ms"};
  const double slowest = tick_hz / ticks;
  if (send.rate > 0 && send.rate < slowest * (1 - kRounding))
    return LawProblem{"send.rate_hz", "must be at least " + number_text(round_up(slowest)) +
                                          " Hz: one datagram per heartbeat of " + number_text(heartbeat * 1e3) +
                                          " ms, in whole ticks"};
  return std::nullopt;
}

void check_send(const pb::Send& in, const std::string& path, MessageValidator& validator) {
  if (in.has_rate_hz() || in.has_dead_band()) return;
  if (in.has_heartbeat_ms() || in.has_prediction_order())
    validator.error(path, "holds no datagram back; add rate_hz or dead_band { }, or remove it");
}

}  // namespace tandem

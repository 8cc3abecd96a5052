#include "proto/text/scene_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proto/text/scene_convert.h"
#include "proto/text/scene_rules.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::MessageValidator;

/// `server/scenes/contact.textproto` -> `contact`
std::string scene_name(std::string_view file_name) {
  const auto slash = file_name.rfind('/');
  if (slash != std::string_view::npos) file_name.remove_prefix(slash + 1);
  return std::string(file_name.substr(0, file_name.find('.')));
}

/// Range of `tick_hz` [Hz], as in scene.proto.
constexpr double kTickHzMin = 100, kTickHzMax = 1e4;
/// Largest number of ticks in a session; the wire counts them in 32 bits.
constexpr double kTicksMax = 4294967295.0;

void read_basics(const pb::Scene& in, MessageValidator& validator, SceneSpec& out) {
  // A tick_hz out of range has an error of its own. 0 skips all rules that need it: their errors would only follow.
  if (in.has_tick_hz()) out.tick_hz = in.tick_hz() >= kTickHzMin && in.tick_hz() <= kTickHzMax ? in.tick_hz() : 0;
  if (in.has_dof()) out.dof = in.dof();
  if (in.has_duration_s()) out.duration = in.duration_s();
  if (const double most = std::floor(kTicksMax / out.tick_hz);
      out.tick_hz > 0 && in.has_duration_s() && out.duration > most)
    validator.error("duration_s", "must be at most " + text::number_text(most) +
                                      " s at tick_hz = " + text::number_text(out.tick_hz) +
                                      ": a session has at most 2^32 - 1 ticks; omit it for a session without end");
  out.clock_runs_while_stopped = in.clock_runs_while_stopped();
  out.port = static_cast<PortSpace>(in.port());
  out.unsafe_gains = in.unsafe_gains();
  out.commanded_force = in.judged_on() == pb::Scene::COMMANDED;
  if (in.alpha_step() && in.has_alpha_slew_per_s()) {
    validator.error("alpha_step", "excludes alpha_slew_per_s: authority either jumps or slews");
  }
  if (in.has_alpha_slew_per_s()) out.alpha_slew = in.alpha_slew_per_s();
  if (in.alpha_step()) out.alpha_slew = std::numeric_limits<double>::infinity();
}

}  // namespace

void choose_law(SceneSpec& scene, LawKind law) noexcept {
  scene.channel.law = law;
  const double own = e0_by_law(scene.channel, scene.gate);
  scene.channel.e0 = scene.channel.e0_given ? std::max(scene.channel.e0, own) : own;
}

namespace {

std::optional<LawProblem> coupling_problem(const SceneSpec& scene) {
  const HandCouplingKind coupling = scene.channel.coupling;
  if (coupling == HandCouplingKind::kEsc) return std::nullopt;
  const LawKind law = scene.channel.law;
  const std::string key = "channel.coupling";
  if (law != LawKind::kSetPosition && law != LawKind::kPd && law != LawKind::kRaw)
    return LawProblem{key,
                      "couples hands by positions that the server combines; it needs law: SET_POSITION, PD or RAW, "
                      "named explicitly"};
  if (scene.channel.mfs != MfsMode::kOpen) return LawProblem{key, "has no flow sources; it needs mfs: OPEN"};
  if (scene.port != PortSpace::kTip) return LawProblem{key, "needs port: TIP"};
  if (scene.tools.size() != 1 || scene.tools[0].remote)
    return LawProblem{key, "needs exactly one tool, and none that a SLAVE seat serves"};
  const bool any_number = coupling == HandCouplingKind::kPdPeer || coupling == HandCouplingKind::kAveragePosition;
  if (!any_number && scene.masters() != 2)
    return LawProblem{key, "has equations for two hands; the scene has " +
                               text::number_text(static_cast<double>(scene.masters())) +
                               " MASTER seats. ESC, PD_PEER and AVERAGE_POSITION take any number"};
  return std::nullopt;
}

}  // namespace

std::optional<LawProblem> law_problem(const SceneSpec& scene) {
  if (auto problem = coupling_problem(scene)) return problem;
  if (auto problem = numerics_problem(scene)) return problem;
  if (auto problem = send_problem(scene.send, scene.channel, scene.gate, scene.port, scene.tick_hz)) return problem;
  if (scene.channel.e0 > kE0Max)  // reachable by choose_law only: scene files have a lower maximum
    return LawProblem{"gate.force_max_n", "force_max_n^2 / (2 k_min_n_m) = " + text::number_text(scene.channel.e0) +
                                              " J must be at most " + text::number_text(kE0Max) +
                                              " J under this law; lower it or raise channel.k_min_n_m"};
  if (scene.channel.law != LawKind::kReplica) return std::nullopt;
  if (scene.port == PortSpace::kJoint)
    return LawProblem{"channel.law",
                      "law REPLICA, which is the default, needs port: TIP, where every client simulates the tool; for "
                      "port: JOINT name law: SET_POSITION (or RAW)"};
  if (scene.channel.mfs == MfsMode::kSeed || scene.channel.mfs == MfsMode::kSeedSigned)
    return LawProblem{"channel.mfs",
                      "cuts a velocity, which law REPLICA (named or by default) does not send; use OPEN or TANK, or "
                      "name law: SET_POSITION"};
  return std::nullopt;
}

std::expected<SceneSpec, InputErrors> parse_scene(std::string_view text, std::string_view file_name) {
  pb::Scene in;
  MessageValidator validator(file_name);
  if (!text::read_document(text, file_name, in, validator)) return std::unexpected(validator.take());

  SceneSpec out;
  out.name = scene_name(file_name);
  read_basics(in, validator, out);
  read_channel(in.channel(), "channel", validator, out.channel);
  read_coupling(in.device_coupling(), out.coupling);
  read_gate(in.gate(), out.gate);
  read_numerics(in.numerics(), out.numerics);
  read_send(in.send(), out.send);
  check_send(in.send(), "send", validator);
  resolve_e0(in.channel(), "channel", validator, out.gate, out.channel);
  check_gate(out.gate, out.tick_hz, "gate", validator);
  rules::read_seats_and_tools(in, validator, out);
  rules::read_authority(in, validator, out);
  rules::read_follow(in, validator, out);
  rules::read_phases(in, validator, out);
  rules::check_law(in, validator, out);
  rules::check_passivity(in, validator, out);
  rules::check_numerics(validator, out);
  if (!validator.ok()) return std::unexpected(validator.take());
  return out;
}

}  // namespace tandem

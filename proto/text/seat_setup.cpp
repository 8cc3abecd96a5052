#include "proto/text/seat_setup.h"

#include <google/protobuf/stubs/logging.h>

#include <cmath>

#include "proto/text/message_keys.h"
#include "proto/text/scene_convert.h"

namespace tandem {
namespace {

using text::MessageKey;
using text::MessageValidator;

constexpr std::array<MessageKey<SeatSetup>, 10> kSetupKeys{
    {{"tick_hz", &SeatSetup::tick_hz},
     {"unsafe_gains", &SeatSetup::unsafe_gains},
     {"clock_runs_while_stopped", &SeatSetup::clock_runs_while_stopped},
     {"k_s_n_m", &SeatSetup::k_s},
     {"m_s_kg", &SeatSetup::m_s},
     {"b_s_n_s_m", &SeatSetup::b_s},
     {"stiffness_asked_n_m", &SeatSetup::stiffness_asked},
     {"weight", &SeatSetup::weight},
     {"drivers", &SeatSetup::driver_mask},
     {"ends_pauses", &SeatSetup::may_end_pauses}}};
constexpr std::array<MessageKey<CoupledTool>, 3> kCoupledToolKeys{
    {{"weight", &CoupledTool::weight}, {"m_s_kg", &CoupledTool::m_s}, {"b_s_n_s_m", &CoupledTool::b_s}}};

void check_scale(const pb::SeatSetup& in, MessageValidator& validator) {
  if (static_cast<std::uint32_t>(in.axis_scale_size()) != in.dof()) {
    validator.error("axis_scale", "must have one number per axis");
  }
}

/// Reads further tools. Only masters of law REPLICA simulate several tools, each once and in order; the weights of
/// their forces sum to 1.
void read_ties(const pb::SeatSetup& in, MessageValidator& validator, SeatSetup& out) {
  double sum = out.weight;
  std::size_t before = out.seat.tool;
  for (int k = 0; k < in.further_size(); ++k) {
    const pb::CoupledTool& tie = in.further(k);
    const std::string path = text::child_path("", "further", k);
    CoupledTool& read = out.further.emplace_back();
    read.tool = tie.tool_index();
    text::read_keys(tie, kCoupledToolKeys, read);
    read_environment(tie.environment(), out.dof, text::child_path(path, "environment"), validator, read.environment);
    check_friction(out.numerics, read.environment, path, validator);
    if (read.tool <= before)
      validator.error(text::child_path(path, "tool_index"),
                      "must be above that of the tool before, " + std::to_string(before));
    before = read.tool;
    sum += read.weight;
  }
  if (!out.further.empty() && (out.channel.law != LawKind::kReplica || out.seat.kind != SeatKind::kMaster))
    validator.error("further", "is for masters of law REPLICA");
  if (!out.further.empty() && !(std::abs(sum - 1) <= 1e-9))
    validator.error("weight", "and those of `further` sum to " + text::number_text(sum) + "; they must sum to 1");
}

}  // namespace

SeatSetup seat_setup(const SceneSpec& scene, std::size_t seat) {
  SeatSetup setup;
  setup.tick_hz = scene.tick_hz;
  setup.dof = scene.dof;
  setup.port = scene.port;
  setup.duration = scene.duration;
  setup.clock_runs_while_stopped = scene.clock_runs_while_stopped;
  setup.unsafe_gains = scene.unsafe_gains;
  setup.channel = scene.channel;
  if (scene.channel.coupling == HandCouplingKind::kPdPeer && scene.masters() > 1) {  // one spring to each other hand
    const auto springs = static_cast<double>(scene.masters() - 1);
    for (double* const gain : {&setup.channel.k, &setup.channel.k_min, &setup.channel.k_delay}) *gain *= springs;
  }
  setup.coupling = scene.coupling;
  setup.gate = scene.gate;
  setup.numerics = scene.numerics;
  if (scene.send.is_on() && scene.seats[seat].kind == SeatKind::kMaster) {
    setup.send = scene.send;
    if (!(setup.send.heartbeat > 0)) setup.send.heartbeat = heartbeat_max(scene.gate, scene.channel.law);
  }
  setup.alpha_slew = scene.alpha_slew;
  setup.seat = scene.seats[seat];
  if (setup.seat.kind == SeatKind::kSlave && setup.seat.tool < scene.tools.size())
    setup.k_s = scene.tools[setup.seat.tool].k_s;
  setup.stiffness_asked = setup.seat.kind == SeatKind::kSlave ? setup.k_s : setup.coupling.k_c;
  // The tool whose authority this seat receives, and may change as INSTRUCTOR.
  if (setup.seat.kind == SeatKind::kMaster)
    for (std::size_t j = scene.tools.size(); j-- > 0;)
      if (scene.follow[seat][j] > 0) setup.seat.tool = j;
  if (setup.seat.tool < scene.tools.size()) {
    const ToolSpec& tool = scene.tools[setup.seat.tool];
    setup.m_s = tool.m_s;
    setup.b_s = tool.b_s;
    if (!tool.remote)
      setup.environment = tool.environment;  // the contacts of a SLAVE seat's device are unknown to other seats
  }
  if (setup.seat.kind == SeatKind::kMaster && scene.channel.law == LawKind::kReplica) {
    setup.weight = scene.follow[seat][setup.seat.tool];
    for (std::size_t j = setup.seat.tool + 1; j < scene.tools.size(); ++j) {
      const ToolSpec& tool = scene.tools[j];
      if (scene.follow[seat][j] > 0)
        setup.further.push_back(
            {j, scene.follow[seat][j], tool.m_s, tool.b_s, tool.remote ? EnvironmentSpec{} : tool.environment});
    }
  }
  const bool instructor = setup.seat.kind == SeatKind::kMaster && setup.seat.role == Role::kInstructor;
  for (std::size_t i = 0; i < scene.masters(); ++i) {
    const Role role = scene.seats[i].role;
    setup.masters.push_back(scene.seats[i].name);
    if (instructor && (role == Role::kInstructor || role == Role::kTrainee)) setup.driver_mask |= 1u << i;
  }
  if (setup.seat.kind == SeatKind::kMaster) setup.own_master = seat;
  if (scene.tools.size() > 1)
    for (const ToolSpec& tool : scene.tools) setup.tools.push_back(tool.name);
  setup.may_end_pauses =
      !scene.has_instructor() && setup.seat.kind == SeatKind::kMaster && setup.seat.role != Role::kObserver;
  return setup;
}

wire::BodyLayout body_layout(const SeatSetup& setup) noexcept {
  const bool master = setup.seat.kind == SeatKind::kMaster;
  return wire::BodyLayout{.axes = setup.dof,
                          .port = setup.port,
                          .further = setup.further.size(),
                          .tool_copies = master && setup.channel.law == LawKind::kReplica,
                          .environment = !master,
                          .exact = setup.channel.mfs == MfsMode::kSeed || setup.channel.mfs == MfsMode::kSeedSigned}
      .valid();
}

std::size_t encode_seat_setup(const SeatSetup& setup, std::span<char> out) {
  pb::SeatSetup message;
  text::write_keys(setup, kSetupKeys, message);
  message.set_dof(static_cast<std::uint32_t>(setup.dof));
  message.set_port(static_cast<pb::Scene::Port>(setup.port));
  if (std::isfinite(setup.duration)) message.set_duration_s(setup.duration);
  write_channel(setup.channel, *message.mutable_channel());
  write_coupling(setup.coupling, *message.mutable_device_coupling());
  write_gate(setup.gate, *message.mutable_gate());
  write_seat(setup.seat, *message.mutable_seat());
  write_numerics(setup.numerics, *message.mutable_numerics());
  if (setup.send.is_on()) write_send(setup.send, *message.mutable_send());
  message.set_tool_index(static_cast<std::uint32_t>(setup.seat.tool));
  for (std::size_t axis = 0; axis < setup.dof && axis < kAxesMax; ++axis)
    message.add_axis_scale(setup.axis_scale[axis]);
  for (const std::string& name : setup.masters) message.add_master(name);
  for (const std::string& name : setup.tools) message.add_tool_name(name);
  message.set_own_master(static_cast<std::uint32_t>(setup.own_master));
  write_environment(setup.environment, *message.mutable_environment());
  for (const CoupledTool& tie : setup.further) {
    pb::CoupledTool& out_tie = *message.add_further();
    out_tie.set_tool_index(static_cast<std::uint32_t>(tie.tool));
    text::write_keys(tie, kCoupledToolKeys, out_tie);
    write_environment(tie.environment, *out_tie.mutable_environment());
  }
  message.set_alpha_slew_per_s(std::isfinite(setup.alpha_slew) ? setup.alpha_slew : 0);
  const std::size_t size = message.ByteSizeLong();
  if (size > out.size() || !message.SerializeToArray(out.data(), static_cast<int>(size))) return 0;
  return size;
}

std::expected<SeatSetup, InputErrors> decode_seat_setup(std::span<const char> bytes) {
  pb::SeatSetup in;
  MessageValidator validator("seat setup");
  const google::protobuf::LogSilencer silence;  // bytes from the network must not flood the log
  // Unknown fields inside are skipped: a newer server may send more than this client can use.
  if (bytes.size() > wire::kSetupMax || !in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    validator.error_at({}, "", "is not a seat setup");
    return std::unexpected(validator.take());
  }
  validator.check_limits(in);
  check_scale(in, validator);
  SeatSetup out;
  if (validator.ok()) {  // numbers are in range here; only contradictions are left
    text::read_keys(in, kSetupKeys, out);
    out.dof = in.dof();
    out.port = static_cast<PortSpace>(in.port());
    if (in.has_duration_s()) out.duration = in.duration_s();
    read_channel(in.channel(), "channel", validator, out.channel);
    read_coupling(in.device_coupling(), out.coupling);
    read_gate(in.gate(), out.gate);
    read_numerics(in.numerics(), out.numerics);
    read_send(in.send(), out.send);
    resolve_e0(in.channel(), "channel", validator, out.gate, out.channel);
    if (out.channel.law == LawKind::kReplica && out.port == PortSpace::kJoint)
      validator.error("channel.law", "is REPLICA, which needs port: TIP");
    check_gate(out.gate, out.tick_hz, "gate", validator);
    check_send(in.send(), "send", validator);
    if (const auto problem = send_problem(out.send, out.channel, out.gate, out.port, out.tick_hz))
      validator.error(problem->key, problem->words);
    if (out.send.is_on() && !(out.send.heartbeat > 0)) validator.error("send.heartbeat_ms", "is missing");
    read_seat(in.seat(), out.dof, "seat", validator, out.seat);
    if (out.send.is_on() && out.seat.kind != SeatKind::kMaster)
      validator.error("send", "is given to a SLAVE seat, which sends at every tick");
    if (out.seat.motion_scale != 1 && out.port == PortSpace::kJoint)
      validator.error("seat.motion_scale", "needs port: TIP");
    out.seat.tool = in.tool_index();
    read_environment(in.environment(), out.dof, "environment", validator, out.environment);
    check_friction(out.numerics, out.environment, "the tool of this seat", validator);
    read_ties(in, validator, out);
    for (std::size_t axis = 0; axis < out.dof; ++axis) out.axis_scale[axis] = in.axis_scale(static_cast<int>(axis));
    out.masters.assign(in.master().begin(), in.master().end());
    out.tools.assign(in.tool_name().begin(), in.tool_name().end());
    out.own_master = in.own_master();
    out.alpha_slew = in.alpha_slew_per_s() > 0 ? in.alpha_slew_per_s() : std::numeric_limits<double>::infinity();
    if (!out.masters.empty() && out.own_master >= out.masters.size())
      validator.error("own_master", "is not one of the masters");
  }
  if (!validator.ok()) return std::unexpected(validator.take());
  return out;
}

}  // namespace tandem

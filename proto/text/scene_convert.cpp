#include "proto/text/scene_convert.h"

#include <algorithm>
#include <cmath>

#include "proto/text/message_keys.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageKey;
using text::MessageValidator;
using text::number_text;
using text::read_keys;
using text::write_keys;

// Enumerators are converted by number; the assertion on the last of each pair fails if one side gains an enumerator.
static_assert(static_cast<int>(LawKind::kReplica) == pb::Channel::REPLICA &&
              static_cast<int>(LawKind::kPd) == pb::Channel::PD && pb::Channel::Law_MAX == pb::Channel::PD &&
              pb::Channel::Law_ARRAYSIZE == kLaws);
static_assert(static_cast<int>(HandCouplingKind::kAveragePosition) == pb::Channel::AVERAGE_POSITION &&
              pb::Channel::Coupling_MAX == pb::Channel::AVERAGE_POSITION);
static_assert(static_cast<int>(MfsMode::kSeedSigned) == pb::Channel::SEED_SIGNED &&
              pb::Channel::Mfs_MAX == pb::Channel::SEED_SIGNED);
static_assert(static_cast<int>(ContactsMode::kEstimated) == pb::Tool::ESTIMATED &&
              pb::Tool::Contacts_MAX == pb::Tool::ESTIMATED);
static_assert(static_cast<int>(SeatKind::kSlave) == pb::Seat::SLAVE && pb::Seat::Kind_MAX == pb::Seat::SLAVE);
static_assert(static_cast<int>(Role::kObserver) == pb::Seat::OBSERVER && pb::Seat::Role_MAX == pb::Seat::OBSERVER);
static_assert(static_cast<int>(HandModel::kRecorded) == pb::Hand::RECORDED &&
              pb::Hand::Model_MAX == pb::Hand::RECORDED);
static_assert(static_cast<int>(HandModel::kLettingGo) == pb::Hand::LETTING_GO);
static_assert(static_cast<int>(PortSpace::kJoint) == pb::Scene::JOINT && pb::Scene::Port_MAX == pb::Scene::JOINT);

constexpr std::array<MessageKey<ChannelSpec>, 13> kChannelKeys{{{"k_n_m", &ChannelSpec::k},
                                                                {"k_min_n_m", &ChannelSpec::k_min},
                                                                {"k_delay_n_s_m", &ChannelSpec::k_delay},
                                                                {"b_delay", &ChannelSpec::b_delay},
                                                                {"lead_max_ms", &ChannelSpec::lead_max, 1e3},
                                                                {"effort_half", &ChannelSpec::effort_half},
                                                                {"e0_j", &ChannelSpec::e0},
                                                                {"eta", &ChannelSpec::eta},
                                                                {"margin_max_j", &ChannelSpec::margin_max},
                                                                {"v_app_m_s", &ChannelSpec::v_app},
                                                                {"tank_j", &ChannelSpec::tank},
                                                                {"b_rel_n_s_m", &ChannelSpec::b_rel},
                                                                {"impedance_n_s_m", &ChannelSpec::impedance}}};
constexpr std::array<MessageKey<CouplingSpec>, 3> kCouplingKeys{
    {{"k_c_n_m", &CouplingSpec::k_c}, {"b_n_s_m", &CouplingSpec::b}, {"m_c_kg", &CouplingSpec::m_c}}};
constexpr std::array<MessageKey<GateSpec>, 7> kGateKeys{{{"silence_limit_ms", &GateSpec::silence_limit, 1e3},
                                                         {"local_hold_ms", &GateSpec::local_hold, 1e3},
                                                         {"follow_hold_ms", &GateSpec::follow_hold, 1e3},
                                                         {"loop_age_max_ms", &GateSpec::loop_age_max, 1e3},
                                                         {"latch", &GateSpec::latch},
                                                         {"ramp_in_ms", &GateSpec::ramp_in, 1e3},
                                                         {"force_max_n", &GateSpec::force_max}}};
constexpr std::array<MessageKey<Point>, 3> kPointKeys{{{"x", &Point::x}, {"y", &Point::y}, {"z", &Point::z}}};
/// Of Device and of Slave.
constexpr std::array<MessageKey<SimDeviceSpec>, 6> kDeviceKeys{
    {{"friction_n", &SimDeviceSpec::friction},
     {"damping_n_s_m", &SimDeviceSpec::damping},
     {"gravity", &SimDeviceSpec::gravity},
     {"gravity_compensation", &SimDeviceSpec::gravity_compensation},
     {"friction_feedforward", &SimDeviceSpec::friction_feedforward},
     {"force_peak_n", &SimDeviceSpec::force_peak}}};
constexpr std::array<MessageKey<Trajectory>, 3> kCircleKeys{
    {{"radius_m", &Trajectory::radius}, {"frequency_hz", &Trajectory::frequency}, {"ramp_s", &Trajectory::ramp}}};
/// Keys of every hand.
constexpr std::array<MessageKey<HandSpec>, 4> kHandKeys{{{"k_n_m", &HandSpec::k},
                                                         {"b_n_s_m", &HandSpec::b},
                                                         {"m_kg", &HandSpec::m},
                                                         {"relaxed_b_n_s_m", &HandSpec::relaxed_b}}};
constexpr std::array<MessageKey<HandSpec>, 2> kTremorKeys{
    {{"tremor_amplitude_m", &HandSpec::tremor_amplitude}, {"tremor_frequency_hz", &HandSpec::tremor_frequency}}};

/// Reads Device or Slave. They have the same numbers; `slave { model ... }` avoids another level in the text.
template <class Message>
void read_device(const Message& in, std::size_t dof, const std::string& path, MessageValidator& validator,
                 SimDeviceSpec& out) {
  if (in.model() == pb::VIRTUAL)
    validator.error(child_path(path, "model"), "is for tool { slave { } }: a hand holds a device", "VIRTUAL");
  const bool linear = in.has_model() && in.model() != pb::VIRTUAL ? in.model() == pb::LINEAR : dof == 1;
  out.model = linear ? DeviceModel::kLinear : DeviceModel::kTouch;
  const std::size_t axes = linear ? 1 : 3;
  if (axes != dof) {
    validator.error(child_path(path, "model"),
                    (linear ? "a LINEAR device has 1 axis" : "a TOUCH has 3 axes") + std::string(", but dof is ") +
                        std::to_string(dof) + "; " + (dof == 1 ? "use LINEAR" : "set dof: " + std::to_string(axes)),
                    linear ? "LINEAR" : "TOUCH");
  }
  out.encoder = linear ? 5.5e-5 : 4.1e-4;
  if (linear && in.has_encoder_rad()) validator.error(child_path(path, "encoder_rad"), "a LINEAR device has encoder_m");
  if (!linear && in.has_encoder_m()) validator.error(child_path(path, "encoder_m"), "a TOUCH has encoder_rad");
  if (!linear && in.has_mass_kg())
    validator.error(child_path(path, "mass_kg"), "is for LINEAR devices; a TOUCH's links are fixed");
  if (linear && in.has_encoder_m()) out.encoder = in.encoder_m();
  if (!linear && in.has_encoder_rad()) out.encoder = in.encoder_rad();
  read_keys(in, kDeviceKeys, out);
  if (in.has_mass_kg()) out.mass = in.mass_kg();
  out.load = in.load_kg();
  out.calibrate = in.calibrate();
  if (in.has_numerics()) {
    read_numerics(in.numerics(), out.numerics.emplace());
    check_device_numerics(out, child_path(path, "numerics"), validator);
  }
  read_keys(in.start_m(), kPointKeys, out.start);
  if (linear && (out.start.y != 0 || out.start.z != 0)) {
    validator.error(child_path(path, "start_m"), "a LINEAR device moves along x only");
  }
}
template <class Message>
void write_device(const SimDeviceSpec& in, Message& out) {
  const bool linear = in.model == DeviceModel::kLinear;
  out.set_model(linear ? pb::LINEAR : pb::TOUCH);
  write_keys(in, kDeviceKeys, out);
  if (linear) {
    out.set_encoder_m(in.encoder);
    out.set_mass_kg(in.mass);
  } else {
    out.set_encoder_rad(in.encoder);
  }
  if (in.load != 0) out.set_load_kg(in.load);
  if (in.calibrate) out.set_calibrate(true);
  if (in.numerics) write_numerics(*in.numerics, *out.mutable_numerics());
  write_keys(in.start, kPointKeys, *out.mutable_start_m());
}

void read_trajectory(const pb::Trajectory& in, const std::string& path, MessageValidator& validator, Trajectory& out) {
  if (in.has_circle() && in.waypoint_size() > 0) {
    validator.error(child_path(path, "waypoint", 0), "a trajectory is a circle or waypoints, not both");
  }
  if (in.has_circle()) {
    const auto& c = in.circle();
    read_keys(c.center_m(), kPointKeys, out.center);
    read_keys(c, kCircleKeys, out);
    if (c.has_normal()) out.plane = "xyz"[std::clamp(static_cast<int>(c.normal()), 0, 2)];
  }
  if (in.waypoint_size() > 0) out.kind = Trajectory::Kind::kWaypoints;
  for (int i = 0; i < in.waypoint_size(); ++i) {
    const auto& w = in.waypoint(i);
    if (i > 0 && !(w.at_s() > in.waypoint(i - 1).at_s())) {
      validator.error(child_path(child_path(path, "waypoint", i), "at_s"), "waypoints must come in order of time");
    }
    out.waypoints.push_back({w.at_s(), {w.x_m(), w.y_m(), w.z_m()}});
  }
}
void write_trajectory(const Trajectory& in, pb::Trajectory& out) {
  if (in.kind == Trajectory::Kind::kCircle) {
    auto& circle = *out.mutable_circle();
    write_keys(in.center, kPointKeys, *circle.mutable_center_m());
    write_keys(in, kCircleKeys, circle);
    circle.set_normal(in.plane == 'x' ? pb::X : in.plane == 'y' ? pb::Y : pb::Z);
    return;
  }
  for (const auto& w : in.waypoints) {
    auto& waypoint = *out.add_waypoint();
    waypoint.set_at_s(w.at);
    waypoint.set_x_m(w.p.x);
    waypoint.set_y_m(w.p.y);
    waypoint.set_z_m(w.p.z);
  }
}

/// Sets the impedance of a simulated hand: a leader's grip is tight, a relaxed hand only adds mass and damping.
void set_model(HandModel model, HandSpec& out) {
  out.model = model;
  switch (model) {
    case HandModel::kNone:
      out.k = out.b = out.m = 0;
      return;
    case HandModel::kRelaxed:
      out.k = 0, out.b = 2, out.m = 0.1;
      return;
    case HandModel::kResting:
      out.k = 50, out.b = 2, out.m = 0.1;
      return;
    default:
      out.k = 1000, out.b = 10, out.m = 0.1;
  }
}

bool moves_along_trajectory(HandModel model) {
  return model == HandModel::kLeader || model == HandModel::kLettingGo || model == HandModel::kTremor;
}

void read_hand(const pb::Hand& in, const std::string& path, MessageValidator& validator, HandSpec& out) {
  set_model(static_cast<HandModel>(in.model()), out);
  read_keys(in, kHandKeys, out);
  if (in.has_release_at_s()) out.release_at = in.release_at_s();
  if (in.has_drags_n()) {
    if (out.model != HandModel::kLettingGo)
      validator.error(child_path(path, "drags_n"), "is for hands that open: LETTING_GO");
    read_keys(in.drags_n(), kPointKeys, out.drags);
  }
  read_keys(in, kTremorKeys, out);
  if (in.has_from_s()) out.from = in.from_s();
  if (in.has_until_s()) out.until = in.until_s();
  if (moved_by_person(out.model))
    for (const auto& [given, key] : {std::pair{in.has_from_s(), "from_s"}, std::pair{in.has_until_s(), "until_s"}})
      if (given)
        validator.error(child_path(path, key),
                        "is for hands that the scene moves; a KEYBOARD or RECORDED hand is never relaxed by the scene: "
                        "take the key away");
  if (!(out.until > out.from))
    validator.error(child_path(path, "until_s"), "must be after from_s = " + number_text(out.from));
  const std::string where = child_path(path, "trajectory");
  if (in.has_trajectory()) {
    if (!moves_along_trajectory(out.model))
      validator.error(where, "is for hands that lead: LEADER, LETTING_GO, TREMOR");
    read_trajectory(in.trajectory(), where, validator, out.trajectory);
  }
  for (const auto& d : in.deviation()) {
    auto& deviation = out.deviations.emplace_back(Deviation{d.at_s(), d.for_s(), {}});
    read_keys(d.force_n(), kPointKeys, deviation.force);
  }
}
void write_hand(const HandSpec& in, pb::Hand& out) {
  out.set_model(static_cast<pb::Hand::Model>(in.model));
  write_keys(in, kHandKeys, out);
  if (moves_along_trajectory(in.model)) write_trajectory(in.trajectory, *out.mutable_trajectory());
  for (const auto& d : in.deviations) {
    auto& deviation = *out.add_deviation();
    deviation.set_at_s(d.at);
    deviation.set_for_s(d.length);
    write_keys(d.force, kPointKeys, *deviation.mutable_force_n());
  }
  if (in.model == HandModel::kLettingGo) {
    out.set_release_at_s(in.release_at);
    write_keys(in.drags, kPointKeys, *out.mutable_drags_n());
  }
  if (in.model == HandModel::kTremor) write_keys(in, kTremorKeys, out);
  if (!moved_by_person(in.model)) out.set_from_s(in.from);
  if (!moved_by_person(in.model) && std::isfinite(in.until)) out.set_until_s(in.until);
}

}  // namespace

void read_channel(const pb::Channel& in, const std::string& path, MessageValidator& validator, ChannelSpec& out) {
  if (in.has_law()) out.law = static_cast<LawKind>(in.law());
  out.mfs = static_cast<MfsMode>(in.mfs());
  out.coupling = static_cast<HandCouplingKind>(in.coupling());
  read_keys(in, kChannelKeys, out);
  // The default k_min is reduced to k of a softer channel; a written k_min above k is an error.
  if (!in.has_k_min_n_m()) out.k_min = std::min(out.k_min, out.k);
  if (out.k_min > out.k)
    validator.error(child_path(path, "k_min_n_m"), "must not be above k_n_m = " + number_text(out.k));
  out.e0_given = in.has_e0_j();
}

void read_coupling(const pb::DeviceCoupling& in, CouplingSpec& out) { read_keys(in, kCouplingKeys, out); }

void read_gate(const pb::Gate& in, GateSpec& out) { read_keys(in, kGateKeys, out); }

double e0_min(const ChannelSpec& channel, const GateSpec& gate) noexcept {
  return channel.k_min > 0 ? gate.force_max * gate.force_max / (2 * channel.k_min) : 0;
}

double e0_by_law(const ChannelSpec& channel, const GateSpec& gate) noexcept {
  const double least = ChannelSpec{}.e0;
  return channel.law == LawKind::kReplica ? least : std::max(least, e0_min(channel, gate));
}

void resolve_e0(const pb::Channel& in, const std::string& path, MessageValidator& validator, const GateSpec& gate,
                ChannelSpec& out) {
  const double least = e0_min(out, gate);
  if (!in.has_e0_j() && out.law != LawKind::kReplica &&
      least > kE0Max) {  // otherwise every client would reject its SeatSetup
    const std::string cause =
        "force_max_n^2 / (2 k_min_n_m) = " + number_text(least) + " J must be at most " + number_text(kE0Max) +
        " J: each end of the channel begins with this energy; lower gate.force_max_n or raise channel.k_min_n_m";
    const bool by_stiffness = in.has_k_min_n_m();
    validator.error(by_stiffness ? child_path(path, "k_min_n_m") : "gate.force_max_n", cause,
                    number_text(by_stiffness ? out.k_min : gate.force_max));
  } else if (!in.has_e0_j()) {
    out.e0 = e0_by_law(out, gate);
  } else if (out.law == LawKind::kSetPosition && out.e0 < least * (1 - 1e-9)) {
    validator.error(child_path(path, "e0_j"), "must be at least force_max_n^2 / (2 k_min_n_m) = " + number_text(least) +
                                                  " J, or the channel dead-locks at its start; raise it or k_min_n_m");
  }
}

void check_gate(const GateSpec& gate, double tick_hz, const std::string& path, MessageValidator& validator) {
  if (tick_hz > 0 && gate.silence_limit * tick_hz < 2 * (1 - 1e-9)) {
    validator.error(child_path(path, "silence_limit_ms"),
                    "must be at least two ticks = " + number_text(2e3 / tick_hz) + " ms, or every tick is a loss",
                    number_text(gate.silence_limit * 1e3));
  }
}

void read_seat(const pb::Seat& in, std::size_t dof, const std::string& path, MessageValidator& validator,
               SeatSpec& out) {
  out.name = in.name();
  out.kind = static_cast<SeatKind>(in.kind());
  if (in.has_role()) out.role = static_cast<Role>(in.role());
  if (in.has_required()) out.required = in.required();
  read_device(in.device(), dof, child_path(path, "device"), validator, out.device);
  if (out.kind == SeatKind::kMaster) {
    if (in.has_tool())
      validator.error(child_path(path, "tool"), "is for SLAVE seats; follow { } names the tools of a master");
    if (in.has_environment())
      validator.error(child_path(path, "environment"), "is for SLAVE seats and for tool { slave { } }");
    read_hand(in.hand(), child_path(path, "hand"), validator, out.hand);
    if (in.has_assist()) out.assist = {in.assist().force_n(), in.assist().in_contact()};
    if (in.has_motion_scale()) out.motion_scale = in.motion_scale();
    out.force_separation = in.force_separation();
    if (out.force_separation && !out.device.calibrate)
      validator.error(child_path(path, "force_separation"),
                      "needs device { calibrate: true }: only measured weight and friction are taken out", "true");
  } else {
    if (in.has_assist()) validator.error(child_path(path, "assist"), "is for MASTER seats: a slave follows no hand");
    if (in.has_force_separation())
      validator.error(child_path(path, "force_separation"), "is for MASTER seats: a slave has no hand");
    if (in.has_motion_scale())
      validator.error(child_path(path, "motion_scale"), "is for MASTER seats: scale the hands that move the slave");
    if (in.has_role()) validator.error(child_path(path, "role"), "is for MASTER seats: a slave has no role");
    if (in.has_hand()) validator.error(child_path(path, "hand"), "is for MASTER seats: a slave has no hand");
    read_environment(in.environment(), dof, child_path(path, "environment"), validator, out.environment);
    refuse_friction(in.environment(), child_path(path, "environment"), validator);
  }
}

void read_slave(const pb::Slave& in, std::size_t dof, const std::string& path, MessageValidator& validator,
                SimDeviceSpec& device, EnvironmentSpec& environment) {
  read_device(in, dof, path, validator, device);
  read_environment(in.environment(), dof, child_path(path, "environment"), validator, environment);
  refuse_friction(in.environment(), child_path(path, "environment"), validator);
}

void write_channel(const ChannelSpec& in, pb::Channel& out) {
  out.set_law(static_cast<pb::Channel::Law>(in.law));
  out.set_mfs(static_cast<pb::Channel::Mfs>(in.mfs));
  if (in.coupling != HandCouplingKind::kEsc) out.set_coupling(static_cast<pb::Channel::Coupling>(in.coupling));
  write_keys(in, kChannelKeys, out);
}

void write_coupling(const CouplingSpec& in, pb::DeviceCoupling& out) { write_keys(in, kCouplingKeys, out); }

void write_gate(const GateSpec& in, pb::Gate& out) { write_keys(in, kGateKeys, out); }

void write_point(const Point& in, pb::PointM& out) { write_keys(in, kPointKeys, out); }

void write_seat(const SeatSpec& in, pb::Seat& out) {
  out.set_name(in.name);
  out.set_kind(static_cast<pb::Seat::Kind>(in.kind));
  out.set_required(in.required);
  write_device(in.device, *out.mutable_device());
  if (in.kind == SeatKind::kMaster) {
    out.set_role(static_cast<pb::Seat::Role>(in.role));
    write_hand(in.hand, *out.mutable_hand());
    if (in.assist.force != 0) {
      out.mutable_assist()->set_force_n(in.assist.force);
      out.mutable_assist()->set_in_contact(in.assist.in_contact);
    }
    if (in.motion_scale != 1) out.set_motion_scale(in.motion_scale);
    if (in.force_separation) out.set_force_separation(true);
  } else {
    write_environment(in.environment, *out.mutable_environment());
  }
}

void write_slave(const SimDeviceSpec& device, const EnvironmentSpec& environment, pb::Slave& out) {
  write_device(device, out);
  write_environment(environment, *out.mutable_environment());
}

}  // namespace tandem

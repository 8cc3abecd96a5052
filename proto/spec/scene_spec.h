#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/base/axes.h"

/// A scene after validation: every number is finite and in range, every name is resolved. Only proto/text/scene_text.h
/// creates it.
namespace tandem {

/// Space of a port: the tip in Cartesian axes, or the joints of the device.
enum class PortSpace : std::uint8_t { kTip, kJoint };
/// Channel laws of a scene.
enum class LawKind : std::uint8_t { kSetPosition, kRaw, kReplica, kTdpa, kWave, kPd };
/// Number of channel laws.
inline constexpr std::size_t kLaws = 6;
/// Couplings between the hands of a tool (common/control/hand_coupling.h).
enum class HandCouplingKind : std::uint8_t {
  kEsc,
  kClc,
  kMcet,
  kNudehi,
  kNpdSaturated,
  kPdVariableDelay,
  kPdPeer,
  kAveragePosition
};
/// Modulation of the flow sources of law SET_POSITION: none, by a tank, or as in the source paper.
enum class MfsMode : std::uint8_t { kOpen, kTank, kSeed, kSeedSigned };
/// A hand, or a slave with a seat of its own.
enum class SeatKind : std::uint8_t { kMaster, kSlave };
/// Rights of a participant (server/policy/roles.h).
enum class Role : std::uint8_t { kInstructor, kTrainee, kEvaluator, kObserver };

/// Parameters of the channel between a seat and the server (ARCHITECTURE.md, "The channel, as built"). Gains are tip
/// gains; joint ports scale them by diag(J^T J).
struct ChannelSpec {
  LawKind law = LawKind::kReplica;                     ///< channel law
  HandCouplingKind coupling = HandCouplingKind::kEsc;  ///< between the hands
  MfsMode mfs = MfsMode::kOpen;                        ///< modulation of the flow sources
  double k = 1500;                                     ///< stiffness without delay [N/m]
  double k_min = 60;                                   ///< smallest stiffness at any delay [N/m]
  double k_delay = 5;                                  ///< k <= k_delay / d [N s/m]
  double b_delay = 0.25;                               ///< added damping = b_delay k d [1]
  double impedance = 5;                                ///< of the waves of law WAVE [N s/m]
  double lead_max = 0.1;                               ///< longest extrapolation [s]; 0: none
  bool effort_half = true;                             ///< the server's target includes the effort
  double e0 = 0.05;                                    ///< initial energy of each axis at each end [J]
  bool e0_given = false;                               ///< the scene sets e0; otherwise the law does, see `choose_law`
  double eta = 0.9;                                    ///< share of the dissipation that the ledger may spend
  double margin_max = 0.1;                             ///< unspent energy above this is forfeited [J]
  double v_app = 0.1;                                  ///< approach speed after an outage [m/s]
  double b_rel = 14;   ///< REPLICA: damping of the tool relative to the reference that drives it [N s/m]
  double tank = 0.05;  ///< MFS tank and authority tank, initial [J]
};

/// Coupling of a master's device to its virtual mass (common/control/ipc.h).
struct CouplingSpec {
  double k_c = 400;   ///< [N/m]
  double b = 0.5;     ///< [N s/m]
  double m_c = 0.02;  ///< [kg]
};

/// Parameters of the force gate of each seat (common/control/force_gate.h).
struct GateSpec {
  double silence_limit = 0.020;  ///< [s]
  double local_hold = 0.45;      ///< REPLICA: longest silence that a seat leading alone tolerates [s]
  double follow_hold = 0.45;  ///< REPLICA: the same for the other seats; the energy tank bounds the force meanwhile [s]
  double loop_age_max = 0.100;  ///< [s]
  bool latch = true;            ///< three losses within 10 s latch the gate
  double ramp_in = 0.5;         ///< [s]
  double force_max = 3.3;       ///< [N]; never above the limit that the device declares
};
/// Authority from which a seat counts as leading alone.
inline constexpr double kLeadsAlone = 0.98;
/// Time for which a seat may receive force without new datagrams: `least` on a link without gaps, `most` on any link
/// [s].
struct SilenceLimits {
  double least = 0,  ///< on a link without gaps [s]
      most = 0;      ///< on any link [s]
};
/// Returns the limits of a seat with this authority.
[[nodiscard]] constexpr SilenceLimits silence_limits(const GateSpec& gate, LawKind law, double authority) noexcept {
  constexpr double kLocalLeast = 0.25, kFollowLeast = 0.1;
  if (law != LawKind::kReplica) return {gate.silence_limit, gate.silence_limit};
  const bool leads = authority >= kLeadsAlone;
  const double hold = leads ? gate.local_hold : gate.follow_hold, least = leads ? kLocalLeast : kFollowLeast;
  const double most = hold > gate.silence_limit ? hold : gate.silence_limit;
  return {least < most ? least : most, most};
}

/// Silence of a seat for which the server keeps its end of the spring, unless its client tolerates more [s].
inline constexpr double kServerHold = 0.1;

/// Returns the longest time between two datagrams of a scene with `send` [s]: a sixth of the shortest silence that a
/// master's gate and the server tolerate. At 5 % random loss, five losses in a row occur every day or two.
[[nodiscard]] constexpr double heartbeat_max(const GateSpec& gate, LawKind law) noexcept {
  constexpr double kIntervals = 6;
  double least = kServerHold;
  for (const double authority : {0.0, 1.0}) {
    const double tolerated = silence_limits(gate, law, authority).least;
    if (tolerated < least) least = tolerated;
  }
  return least / kIntervals;
}

/// Share of the force limit and of the energy after a loss that a role may receive. Evaluators, which never lead, get
/// half (ARCHITECTURE.md, invariant 49).
[[nodiscard]] constexpr double share_of_force(Role role) noexcept { return role == Role::kEvaluator ? 0.5 : 1.0; }

/// Position [m] or force [N] in the HAL frame.
struct Point {
  double x = 0,  ///< right
      y = 0,     ///< away from the user
      z = 0;     ///< up
};

/// Integrators of a simulated tool or device (common/control/numerics.h).
enum class IntegratorKind : std::uint8_t { kImplicitEuler, kImplicitMidpoint, kSemiImplicitEuler, kRk4, kExact };
/// Numbers in which a simulated tool or device is stepped.
enum class PrecisionKind : std::uint8_t { kDouble, kFloat };
/// Largest number of steps per tick.
inline constexpr std::uint32_t kSubstepsMax = 64;
/// How the server steps a simulated tool, and every client its copy; or how a simulated device is stepped.
struct NumericsSpec {
  IntegratorKind integrator = IntegratorKind::kImplicitEuler;  ///< method of one step
  PrecisionKind precision = PrecisionKind::kDouble;            ///< numbers of one step
  std::uint32_t substeps = 1;                                  ///< steps per tick, 1 to kSubstepsMax
  /// Whether no step creates energy for any gains and surfaces.
  [[nodiscard]] bool keeps_proof() const noexcept {
    return integrator == IntegratorKind::kImplicitEuler && precision == PrecisionKind::kDouble;
  }
  /// Whether this is the default, one implicit step per tick.
  [[nodiscard]] bool is_default() const noexcept { return keeps_proof() && substeps == 1; }
};

/// Simulated devices: Touch with three joints, or one prismatic axis.
enum class DeviceModel : std::uint8_t { kTouch, kLinear };
/// A simulated device (hal/sim/sim_device.h).
struct SimDeviceSpec {
  DeviceModel model = DeviceModel::kTouch;  ///< kind of device
  double friction = 0.1;                    ///< Coulomb, at the tip [N]
  double damping = 0.2;                     ///< b_device at the tip [N s/m]
  bool gravity = true;                      ///< the device has weight
  bool gravity_compensation = true;         ///< its motors balance the weight
  bool friction_feedforward = false;        ///< its motors compensate friction
  double force_peak = 3.3;                  ///< [N]
  double encoder = 4.1e-4;                  ///< joint resolution [rad], 0: exact; LINEAR: default 5.5e-5 [m]
  double mass = 0.1;                        ///< LINEAR only [kg]
  double load = 0;                          ///< mass at the tip that the built-in model does not contain [kg]
  bool calibrate = false;                   ///< weight and friction are measured by a slow motion before the session
  Point start;                              ///< tip position at the start [m]
  std::optional<NumericsSpec> numerics;     ///< steps of its motion; empty: linearly implicit, at most 0.25 ms each
};

/// Simulated hands.
enum class HandModel : std::uint8_t { kNone, kLeader, kRelaxed, kResting, kLettingGo, kTremor, kKeyboard, kRecorded };
/// Whether a human operator moves this hand, now or when it was recorded. Then no scene defines when it is relaxed.
[[nodiscard]] constexpr bool moved_by_person(HandModel model) noexcept {
  return model == HandModel::kKeyboard || model == HandModel::kRecorded;
}
struct Waypoint {
  double at = 0;  ///< session time [s]
  Point p;        ///< tip [m]
};  ///< minimum jerk between waypoints, held before the first and after the last
struct Deviation {
  double at = 0,   ///< begin in session time [s]
      length = 0;  ///< duration [s]
  Point force;     ///< force [N]
};  ///< extra force of the operator [N]
/// Intended motion of a hand.
struct Trajectory {
  /// Forms of a motion.
  enum class Kind : std::uint8_t { kCircle, kWaypoints } kind = Kind::kCircle;  ///< form of this motion
  Point center;                                                                 ///< center of the circle [m]
  double radius = 0.05;                                                         ///< [m]
  double frequency = 0.5;                                                       ///< [Hz]
  char plane = 'y';                 ///< axis normal to the circle's plane: 'x', 'y' or 'z'; LINEAR devices use x only
  double ramp = 1.0;                ///< radius grows smoothly from 0 in this time [s]
  std::vector<Waypoint> waypoints;  ///< kWaypoints: ascending in time
};
/// A simulated hand.
struct HandSpec {
  HandModel model = HandModel::kNone;  ///< kind of hand
  double k = 0,                        ///< stiffness, unless the scene sets it that of the model [N/m]
      b = 0,                           ///< damping, likewise [N s/m]
      m = 0;                           ///< mass, likewise [kg]
  Trajectory trajectory;               ///< intended motion
  std::vector<Deviation> deviations;   ///< pushes of the operator
  double release_at = 5;               ///< LETTING_GO: time at which the hand releases the device [s]
  Point drags;                         ///< LETTING_GO: force that still acts on the handle after release [N]
  double tremor_amplitude = 0.002;     ///< [m]
  double tremor_frequency = 9;         ///< [Hz]
  double from = 0;  ///< before this time the hand is RELAXED (scene contact: the trainee aligns from 12 s) [s]
  double until =
      std::numeric_limits<double>::infinity();  ///< from this time on it is RELAXED again; a leader then follows [s]
  double relaxed_b = 2;                         ///< damping of the hand outside [from, until), where k = 0 [N s/m]
};

/// The hand of a human operator who replaces the simulated one. Times at which the scene's hand is relaxed, releases or
/// pushes do not apply to it. The impedance is that of `model`. The position of a recording relative to the working
/// pose is kept.
/// @pre moved_by_person(model)
[[nodiscard]] inline HandSpec person_instead_of(const HandSpec& simulated, HandModel model) {
  HandSpec own;
  own.model = model;
  own.trajectory.center = simulated.trajectory.center;
  return own;
}

/// A stiff wall normal to one axis.
struct WallSpec {
  int axis = 0;            ///< normal: 0 x, 1 y, 2 z
  double at = 0;           ///< position [m]
  double k = 20000;        ///< stiffness [N/m]
  double b = 5;            ///< damping [N s/m]
  bool from_below = true;  ///< the free side is below `at`
  /// Coulomb friction [1]
  double mu = 0;
};
/// A soft surface whose stiffness grows with the depth.
struct TissueSpec {
  int axis = 2;             ///< normal: 0 x, 1 y, 2 z
  double at = 0;            ///< position [m]
  double k = 300;           ///< stiffness [N/m]
  double k3 = 1e6;          ///< cubic stiffness [N/m^3]
  double b = 3;             ///< damping [N s/m]
  bool from_below = false;  ///< the free side is below `at`
  /// Coulomb friction [1]
  double mu = 0;
};
/// Surfaces that a tool or a slave touches.
struct EnvironmentSpec {
  std::optional<WallSpec> wall;      ///< empty: none
  std::optional<TissueSpec> tissue;  ///< empty: none
};

/// A force that pulls a following seat towards the leading seat, law REPLICA.
struct AssistSpec {
  double force = 0;         ///< largest force, in addition to the force of following [N]; 0: none
  bool in_contact = false;  ///< also while the tool touches a surface
};

/// A seat of the scene.
struct SeatSpec {
  std::string name;                   ///< name, unique in the scene
  SeatKind kind = SeatKind::kMaster;  ///< hand or slave
  Role role = Role::kTrainee;         ///< rights of its participant
  bool required = true;               ///< the session waits for this seat
  std::size_t tool = 0;               ///< SLAVE seats: the tool whose slave this is
  SimDeviceSpec device;               ///< simulated device
  HandSpec hand;                      ///< masters
  AssistSpec assist;                  ///< masters
  bool force_separation = false;      ///< masters: others do not feel weight and friction of this device
  double motion_scale = 1;            ///< masters: motion of the tool per motion of the hand, s; F_hand = s F_tool [1]
  EnvironmentSpec environment;        ///< SLAVE seats
};

/// Mass of a virtual tool [kg]. It is small so that the hand's own spring does not resonate with it. With 0.05 kg a
/// motion of 14 Hz is amplified by 1.7, with this mass by 1.2.
inline constexpr double kVirtualToolMass = 0.02;
/// Mass of the moving part of a tool that pulls a slave device [kg].
inline constexpr double kDeviceToolMass = 0.05;
/// Information that masters receive about the contacts of a SLAVE seat's slave, law REPLICA.
enum class ContactsMode : std::uint8_t {
  kNone,       ///< nothing: masters receive the slave's force through a spring over the network
  kEstimated,  ///< a plane, once one is estimated from motion and effort of the slave
};
/// A tool of the scene.
struct ToolSpec {
  std::string name;               ///< name, unique in the scene
  double k_s = 400;               ///< spring between tool and slave device; unused for a virtual tool [N/m]
  double m_s = kVirtualToolMass;  ///< [kg]
  double b_s = 0.2;               ///< [N s/m]
  bool is_virtual = true;         ///< no slave device: the tool itself touches the environment
  bool remote = false;            ///< its slave is a SLAVE seat
  std::size_t seat = 0;           ///< index of that seat if remote
  SimDeviceSpec slave;            ///< simulated slave device
  EnvironmentSpec environment;    ///< surfaces at the slave
  ContactsMode contacts = ContactsMode::kEstimated;  ///< remote tools
};

/// Authority of all masters (index = seat) over one tool; sum 1.
struct AuthorityRow {
  std::size_t tool = 0;                   ///< index of the tool
  std::array<double, kSeatsMax> alpha{};  ///< authority of each master [0, 1]
};
/// A change of authority in the scene's timeline.
struct TimedAuthority {
  double at = 0;     ///< session time [s]
  AuthorityRow row;  ///< authority from then on
};
/// Time span that the report evaluates by itself.
struct PhaseSpec {
  std::string name;      ///< name in the report
  double from = 0,       ///< begin on the session clock [s]
      to = 0;            ///< end on the session clock [s]
  bool contact = false;  ///< the report evaluates contact forces
};

/// Changes that a participant does not notice, as shares of the present value (common/control/send_pace.h).
struct DeadBandSpec {
  double weber = 0.1;           ///< Weber fraction [1]
  double velocity_floor = 0.1;  ///< the share is never of less than this velocity of the hand [m/s]
  double force_floor = 0.6;     ///< the share is never of less than this force on the hand [N]
};

/// When masters send STATE, and the server sends FORCE to them. Default: at every tick.
struct SendSpec {
  double rate = 0;                        ///< largest rate of datagrams [Hz]; 0: one per tick
  std::optional<DeadBandSpec> dead_band;  ///< empty: a datagram is sent whenever `rate` allows
  double heartbeat = 0;                   ///< longest time between two datagrams [s]; 0: the default, heartbeat_max
  std::uint32_t prediction_order = 1;     ///< prediction of values that are not sent: 0 holds, 1 extrapolates linearly
  /// Whether some ticks have no datagram.
  [[nodiscard]] bool is_on() const noexcept { return rate > 0 || dead_band; }
};

/// A validated scene.
struct SceneSpec {
  std::string name;                                           ///< name
  double tick_hz = 1000;                                      ///< rate of server and clients [Hz]
  std::size_t dof = 3;                                        ///< number of axes of a port
  PortSpace port = PortSpace::kTip;                           ///< space of the ports
  double duration = std::numeric_limits<double>::infinity();  ///< of the session clock [s]; infinity: no scheduled end
  bool clock_runs_while_stopped = false;  ///< false: clock and timeline do not advance while STOPPED or PAUSED
  double alpha_slew = 1;                  ///< [1/s]; infinity: authority changes in one step
  bool unsafe_gains = false;              ///< springs may exceed their passivity limit
  bool commanded_force = false;           ///< force errors refer to commanded instead of delivered force
  ChannelSpec channel;                    ///< channel of every seat
  CouplingSpec coupling;                  ///< coupling of every master's device
  GateSpec gate;                          ///< force gate of every seat
  NumericsSpec numerics;                  ///< steps of the simulated tools
  SendSpec send;                          ///< datagrams of masters
  std::vector<SeatSpec> seats;            ///< masters first, then slaves
  std::vector<ToolSpec> tools;            ///< at least one
  std::vector<AuthorityRow> authority;    ///< one per tool
  std::array<std::array<double, kToolsMax>, kSeatsMax> follow{};  ///< C_ji as [seat][tool]; each seat's row sums to 1
  std::vector<TimedAuthority> timeline;                           ///< ascending in time
  std::vector<PhaseSpec> phases;                                  ///< empty: the report covers the whole session

  /// Whether the session has no scheduled end.
  [[nodiscard]] bool endless() const noexcept { return !(duration < std::numeric_limits<double>::infinity()); }
  /// Returns the number of MASTER seats.
  [[nodiscard]] std::size_t masters() const noexcept {
    std::size_t n = 0;
    for (const auto& s : seats) n += s.kind == SeatKind::kMaster ? 1 : 0;
    return n;
  }
  /// Whether a seat has role INSTRUCTOR.
  [[nodiscard]] bool has_instructor() const noexcept {
    for (const auto& s : seats)
      if (s.kind == SeatKind::kMaster && s.role == Role::kInstructor) return true;
    return false;
  }
};

}  // namespace tandem

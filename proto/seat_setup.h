#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "proto/input_error.h"
#include "proto/scene_spec.h"
#include "proto/wire.h"

namespace tandem {

/// One of several tools that a hand is tied to, as its client simulates it.
struct TieSetup {
  std::size_t tool = 0;  ///< number of it
  double weight = 0;     ///< of its force in what the hand feels, C_ji (0, 1)
  double m_s = 0.02, b_s = 0.2;  ///< mass and damping [kg, N s/m]
  EnvironmentSpec environment;
};

/// What the server tells a client about the seat it was given (in WELCOME): all a seat core needs, no more.
struct SeatSetup {
  double tick_hz = 1000;  ///< 100 ... 10000 [Hz]
  std::size_t dof = 3;    ///< 1 ... 3
  PortSpace port = PortSpace::kTip;
  double duration = std::numeric_limits<double>::infinity();  ///< of the session clock [s]; infinity: no end
  bool clock_runs_while_stopped = false;
  bool unsafe_gains = false;  ///< springs may command more than a motor delivers
  ChannelSpec channel;    ///< tip gains
  CouplingSpec coupling;  ///< masters
  double k_s = 400;       ///< SLAVE seats: tool - slave spring at the tip [N/m]
  /// What the scene asks of the spring that meets the device, coupling.k_c or k_s: more than that where the device renders less [N/m].
  double stiffness_asked = 400;
  double m_s = 0.02, b_s = 0.2;  ///< mass and damping of the tool this seat follows [kg, N s/m]
  EnvironmentSpec environment;   ///< of that tool: a master of law REPLICA simulates it
  double weight = 1;             ///< of that tool's force in what the hand feels, C_ji (0, 1]
  std::vector<TieSetup> further; ///< of a master of law REPLICA: the other tools that it follows, in the scene's order
  GateSpec gate;
  SeatSpec seat;
  std::array<double, kAxesMax> axis_scale{1, 1, 1, 1,
                                          1, 1, 1};  ///< tip gain -> port gain, per axis: diag(J^T J), 1 at a TIP port
  std::vector<std::string> masters;  ///< names of all MASTER seats in the order of authority weights
  std::vector<std::string> tools;    ///< names of all tools in order; empty where there is only one
  std::size_t own_master = 0;        ///< place of this seat among the masters; 0 for SLAVE seats
  std::uint32_t drivers = 0;         ///< INSTRUCTOR seats: bit i: master i may be given authority; 0 for others
  /// Whether this seat's person moves authority.
  [[nodiscard]] bool moves_authority() const noexcept { return drivers != 0; }
  double alpha_slew = 1;  ///< largest change of a weight [1/s]; infinity: in one step. For what the person reads
  bool ends_pauses = false;  ///< no seat is an instructor's: who may pause may take his pause back
};

/// The part of a scene that belongs to one seat; axis_scale is left at 1. @pre seat < scene.seats.size()
[[nodiscard]] SeatSetup seat_setup(const SceneSpec& scene, std::size_t seat);

/// Writes `setup` as the protobuf message tandem.pb.SeatSetup.
/// @return bytes written; 0 if it does not fit into `out`. A validated scene always fits wire::kSetupMax.
[[nodiscard]] std::size_t encode_seat_setup(const SeatSetup& setup, std::span<char> out);

/// Reads what encode_seat_setup wrote. Any bytes are safe: the same ranges and rules as for scene files are checked.
/// @return the setup, or every mistake, by key path
[[nodiscard]] std::expected<SeatSetup, InputErrors> decode_seat_setup(std::span<const char> bytes);

}  // namespace tandem

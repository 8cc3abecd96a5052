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
#include "proto/spec/input_error.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/body_layout.h"
#include "proto/wire/wire_messages.h"

namespace tandem {

/// One of several tools that a master is coupled to, as its client simulates it.
struct CoupledTool {
  std::size_t tool = 0;         ///< index of the tool
  double weight = 0;            ///< weight of its force in the force on the seat, C_ji (0, 1)
  double m_s = 0.02,            ///< mass [kg]
      b_s = 0.2;                ///< damping [N s/m]
  EnvironmentSpec environment;  ///< surfaces of the tool
};

/// Parameters of a seat that the server sends to its client in Welcome: all that a seat core needs, no more.
struct SeatSetup {
  double tick_hz = 1000;                                      ///< 100 ... 10000 [Hz]
  std::size_t dof = 3;                                        ///< 1 ... 3
  PortSpace port = PortSpace::kTip;                           ///< space of the port
  double duration = std::numeric_limits<double>::infinity();  ///< of the session clock [s]; infinity: no scheduled end
  bool clock_runs_while_stopped = false;  ///< the session clock advances while the session is stopped
  bool unsafe_gains = false;              ///< springs may command more than a motor delivers
  ChannelSpec channel;                    ///< tip gains
  CouplingSpec coupling;                  ///< MASTER seats
  double k_s = 400;                       ///< SLAVE seats: spring between tool and slave at the tip [N/m]
  /// Stiffness that the scene requests for the spring on the device, coupling.k_c or k_s [N/m]. It is larger than the
  /// value in use if the device renders less.
  double stiffness_asked = 400;
  double m_s = 0.02,                 ///< mass of the tool this seat follows [kg]
      b_s = 0.2;                     ///< damping of that tool [N s/m]
  NumericsSpec numerics;             ///< steps of all simulated tools
  SendSpec send;                     ///< datagrams of this seat; its heartbeat is above 0 if it is on
  EnvironmentSpec environment;       ///< of that tool: a master of law REPLICA simulates it
  double weight = 1;                 ///< weight of that tool's force in the force on this seat, C_ji (0, 1]
  std::vector<CoupledTool> further;  ///< masters of law REPLICA: the other tools, in the scene's order
  GateSpec gate;                     ///< force gate of this seat
  SeatSpec seat;                     ///< the scene's entry of this seat
  std::array<double, kAxesMax> axis_scale{1, 1, 1, 1,
                                          1, 1, 1};  ///< tip gain -> port gain, per axis: diag(J^T J), 1 at a TIP port
  std::vector<std::string> masters;                  ///< names of all MASTER seats in the order of the authority vector
  std::vector<std::string> tools;                    ///< names of all tools in order; empty if there is only one
  std::size_t own_master = 0;                        ///< index of this seat among the masters; 0 for SLAVE seats
  std::uint32_t driver_mask = 0;  ///< INSTRUCTOR seats: bit i is set if master i can be given authority; 0 for others
  /// Whether the operator of this seat may change authority.
  [[nodiscard]] bool moves_authority() const noexcept { return driver_mask != 0; }
  double alpha_slew = 1;        ///< largest change of authority [1/s], for display; infinity: in one step
  bool may_end_pauses = false;  ///< no seat has role INSTRUCTOR: a role that may pause may also end its own pause
};

/// The layout of the STATEs and FORCEs of this seat. Both ends of its datagrams use this function.
[[nodiscard]] wire::BodyLayout body_layout(const SeatSetup& setup) noexcept;

/// The part of a scene that belongs to one seat; axis_scale is left at 1. @pre seat < scene.seats.size()
[[nodiscard]] SeatSetup seat_setup(const SceneSpec& scene, std::size_t seat);

/// Writes `setup` as the protobuf message tandem.pb.SeatSetup.
/// @return bytes written; 0 if it does not fit into `out`. A validated scene always fits wire::kSetupMax.
[[nodiscard]] std::size_t encode_seat_setup(const SeatSetup& setup, std::span<char> out);

/// Parses the output of encode_seat_setup. Any input is safe: the ranges and rules of scene files are checked.
/// @return the setup, or every error, by key path
[[nodiscard]] std::expected<SeatSetup, InputErrors> decode_seat_setup(std::span<const char> bytes);

}  // namespace tandem

#pragma once

#include <cstddef>
#include <string>

#include "proto/checker.h"
#include "proto/scene.pb.h"
#include "proto/scene_spec.h"

/// Private to proto/*.cpp: the parts that scene files and seat setups have in common, between tandem::pb and SceneSpec.
/// `read_*` take messages that passed check_limits or not: what is absent keeps the default, what contradicts itself is
/// told to the checker. `write_*` set every field in force.
namespace tandem {

void read_channel(const pb::Channel& in, const std::string& path, text::Checker& checker, ChannelSpec& out);
void read_coupling(const pb::DeviceCoupling& in, CouplingSpec& out);
void read_gate(const pb::Gate& in, GateSpec& out);
constexpr double kE0Max = 10;  ///< what the schemas of scene and seat take as e0 [J]
/// Smallest initial ledger energy that does not dead-lock the channel at its start: F_max^2 / (2 k_min) [J] (design notes, control
/// 4).
[[nodiscard]] double e0_min(const ChannelSpec& channel, const GateSpec& gate) noexcept;
/// What e0 is where a scene names none, by the law of `channel` [J].
[[nodiscard]] double e0_by_law(const ChannelSpec& channel, const GateSpec& gate) noexcept;
/// The default of e0, or the rule about a written one.
void settle_e0(const pb::Channel& in, const std::string& path, text::Checker& checker, const GateSpec& gate,
               ChannelSpec& out);
void check_gate(const GateSpec& gate, double tick_hz, const std::string& path, text::Checker& checker);

/// Reads all of a seat but the tool it serves. @param dof axes of the scene's ports; device and environment must fit
void read_seat(const pb::Seat& in, std::size_t dof, const std::string& path, text::Checker& checker, SeatSpec& out);
/// Reads a tool's own slave; `in` may be absent for remote tools.
void read_slave(const pb::Slave& in, std::size_t dof, const std::string& path, text::Checker& checker,
                SimDeviceSpec& device, EnvironmentSpec& environment);

/// The same of a tool without a device. Any key about one is a mistake.
void read_virtual_slave(const pb::Slave& in, std::size_t dof, const std::string& path, text::Checker& checker, Point& start,
                        EnvironmentSpec& environment);
void read_environment(const pb::Environment& in, std::size_t dof, const std::string& path, text::Checker& checker, EnvironmentSpec& out);
/// Surfaces that a simulated device meets have no friction.
void refuse_friction(const pb::Environment& in, const std::string& path, text::Checker& checker);

void write_environment(const EnvironmentSpec& in, pb::Environment& out);
void write_channel(const ChannelSpec& in, pb::Channel& out);
void write_coupling(const CouplingSpec& in, pb::DeviceCoupling& out);
void write_gate(const GateSpec& in, pb::Gate& out);
void write_seat(const SeatSpec& in, pb::Seat& out);
void write_slave(const SimDeviceSpec& device, const EnvironmentSpec& environment, pb::Slave& out);

}  // namespace tandem

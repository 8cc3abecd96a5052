#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "proto/schema/scene.pb.h"
#include "proto/spec/scene_spec.h"
#include "proto/text/message_validator.h"
#include "proto/text/scene_text.h"

/// Private to proto/text: conversion between tandem::pb and SceneSpec of the parts that scene files and seat setups
/// share. `read_*` accept messages that did or did not pass check_limits. Absent values keep the default, and
/// contradictions are reported to the validator. `write_*` set every field in force.
namespace tandem {

/// A scene with every value in force.
[[nodiscard]] pb::Scene to_proto(const SceneSpec& scene);
void read_channel(const pb::Channel& in, const std::string& path, text::MessageValidator& validator, ChannelSpec& out);
void read_coupling(const pb::DeviceCoupling& in, CouplingSpec& out);
void read_gate(const pb::Gate& in, GateSpec& out);
void read_numerics(const pb::Numerics& in, NumericsSpec& out);
constexpr double kE0Max = 10;  ///< largest e0 in the schemas of scene and seat [J]
/// Smallest initial ledger energy that does not deadlock the channel at its start: F_max^2 / (2 k_min) [J].
[[nodiscard]] double e0_min(const ChannelSpec& channel, const GateSpec& gate) noexcept;
/// Default of e0 for the law of `channel` [J].
[[nodiscard]] double e0_by_law(const ChannelSpec& channel, const GateSpec& gate) noexcept;
/// Sets e0 to its default, or checks a written value.
void resolve_e0(const pb::Channel& in, const std::string& path, text::MessageValidator& validator, const GateSpec& gate,
                ChannelSpec& out);
void check_gate(const GateSpec& gate, double tick_hz, const std::string& path, text::MessageValidator& validator);

/// Reads all of a seat but its tool. @param dof axes of the scene's ports; device and environment must fit
void read_seat(const pb::Seat& in, std::size_t dof, const std::string& path, text::MessageValidator& validator,
               SeatSpec& out);
/// Reads the simulated slave of a tool; `in` may be absent for remote tools.
void read_slave(const pb::Slave& in, std::size_t dof, const std::string& path, text::MessageValidator& validator,
                SimDeviceSpec& device, EnvironmentSpec& environment);

/// Reads the slave of a tool without a device. Any key of a device is an error.
void read_virtual_slave(const pb::Slave& in, std::size_t dof, const std::string& path,
                        text::MessageValidator& validator, Point& start, EnvironmentSpec& environment);
void read_environment(const pb::Environment& in, std::size_t dof, const std::string& path,
                      text::MessageValidator& validator, EnvironmentSpec& out);
/// Rejects friction of surfaces that a simulated device touches.
void refuse_friction(const pb::Environment& in, const std::string& path, text::MessageValidator& validator);

void write_point(const Point& in, pb::PointM& out);
void write_environment(const EnvironmentSpec& in, pb::Environment& out);
void write_channel(const ChannelSpec& in, pb::Channel& out);
void write_coupling(const CouplingSpec& in, pb::DeviceCoupling& out);
void write_gate(const GateSpec& in, pb::Gate& out);
/// Returns the conflict of the numerics with the tools and the law of a scene; empty if there is none.
[[nodiscard]] std::optional<LawProblem> numerics_problem(const SceneSpec& scene);
/// Rejects friction that the numerics do not solve. @param whose  owner of the surfaces, for the message
void check_friction(const NumericsSpec& numerics, const EnvironmentSpec& environment, const std::string& whose,
                    text::MessageValidator& validator);
/// Rejects an integrator that cannot follow the friction of its device. @param path  of the message numerics
void check_device_numerics(const SimDeviceSpec& device, const std::string& path, text::MessageValidator& validator);
void write_numerics(const NumericsSpec& in, pb::Numerics& out);
void read_send(const pb::Send& in, SendSpec& out);
void write_send(const SendSpec& in, pb::Send& out);
/// Returns the conflict of `send` with law, port, gate and tick; empty if there is none.
[[nodiscard]] std::optional<LawProblem> send_problem(const SendSpec& send, const ChannelSpec& channel,
                                                     const GateSpec& gate, PortSpace port, double tick_hz);
/// Rejects a block that changes nothing.
void check_send(const pb::Send& in, const std::string& path, text::MessageValidator& validator);
void write_seat(const SeatSpec& in, pb::Seat& out);
void write_slave(const SimDeviceSpec& device, const EnvironmentSpec& environment, pb::Slave& out);

}  // namespace tandem

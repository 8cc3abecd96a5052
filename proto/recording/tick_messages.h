#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "common/base/axes.h"

/// Messages that a recording has for every tick (proto/schema/recording.proto), as plain structs. Numbers survive
/// exactly: NaN, infinity and the sign of zero, too.
namespace tandem::rec {

using Triple = std::array<double, 3>;

/// Message SeatEnergy. Units as in the schema.
struct SeatEnergySample {
  EnergyArray e_in{}, e_out{};
  double dissipated_j = 0, refused_j = 0, margin_min_j = 0, delivered_j = 0;
};

/// Message ToolEnergy.
struct ToolEnergySample {
  double mfs_j = 0, e_p_j = 0;
  Triple e_p_axis_j{};
};

/// Message Seat.
struct SeatSample {
  Triple measured_cp{}, measured_cv{}, measured_cf{}, servo_cf{};
  AxisArray measured_jp{};
  std::uint32_t sample_tick = 0;
  double alpha = 0;
  std::uint8_t gate = 0;
  bool engaged = false;
  std::uint32_t leader = 0;
  Triple ghost{};
  SeatEnergySample energy;
};

/// Message Tool.
struct ToolSample {
  Triple measured_cp{}, setpoint_cp{}, measured_cf{}, servo_cf{};
  AxisArray measured_jp{};
  std::uint32_t sample_tick = 0;
  double penetration = 0;
  bool braked = false;
  ToolEnergySample energy;
};

/// Message Authority.
struct AuthoritySample {
  std::size_t tools = 0, masters = 0;
  std::array<std::array<double, kMastersMax>, kToolsMax> alpha{};
};

/// Message SessionTick.
struct SessionSample {
  bool running = false;
  std::uint64_t stopped_ticks = 0, dropped_ticks = 0;
  friend bool operator==(const SessionSample&, const SessionSample&) = default;
};

/// Rounds the numbers of a tool: energies to single precision, others to the nearest of 16 significant bits, with a
/// relative error of at most 2^-17 (0.8 um at 100 mm), far below the steps of encoders. E_p stays the sum of its axes.
void round_tool(ToolSample& sample) noexcept;

/// Replace `out` by the message. Axes behind the last one that is not 0 are omitted.
void encode(const SeatSample& sample, std::string& out);
void encode(const ToolSample& sample, std::string& out);
void encode(const AuthoritySample& sample, std::string& out);
void encode(const SessionSample& sample, std::string& out);

/// Read a message. Unknown fields are ignored; absent ones have their default.
/// @return false if the bytes are damaged; `out` then has any values
[[nodiscard]] bool decode(std::span<const std::byte> bytes, SeatSample& out) noexcept;
[[nodiscard]] bool decode(std::span<const std::byte> bytes, ToolSample& out) noexcept;
[[nodiscard]] bool decode(std::span<const std::byte> bytes, AuthoritySample& out) noexcept;
[[nodiscard]] bool decode(std::span<const std::byte> bytes, SessionSample& out) noexcept;

}  // namespace tandem::rec

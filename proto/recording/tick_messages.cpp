#include "proto/recording/tick_messages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "proto/recording/protobuf_fields.h"

namespace tandem::rec {
namespace {

/// Returns the values up to the last one whose bits are not all 0.
template <class Value, std::size_t kSize>
std::span<const Value> without_zeros(const std::array<Value, kSize>& values) noexcept {
  std::size_t size = kSize;
  while (size > 0 && std::bit_cast<std::uint64_t>(values[size - 1]) == 0) --size;
  return std::span{values}.first(size);
}

/// Reads packed or single values of eight bytes. @param count  of values so far; more than fit are ignored
template <class Value, std::size_t kSize>
bool read_values(const Field& field, std::array<Value, kSize>& out, std::size_t& count) noexcept {
  if (field.type == FieldType::kFixed64) {
    if (count < kSize) out[count++] = std::bit_cast<Value>(field.value);
    return true;
  }
  if (field.bytes.size() % sizeof(Value) != 0) return false;
  const std::size_t room = kSize - count, given = field.bytes.size() / sizeof(Value);
  const std::size_t taken = given < room ? given : room;
  if (taken > 0) std::memcpy(out.data() + count, field.bytes.data(), taken * sizeof(Value));
  count += taken;
  return true;
}

/// Reads packed or single values of four bytes each.
template <std::size_t kSize>
bool read_singles(const Field& field, std::array<double, kSize>& out, std::size_t& count) noexcept {
  if (field.type == FieldType::kFixed32) {
    if (count < kSize) out[count++] = std::bit_cast<float>(static_cast<std::uint32_t>(field.value));
    return true;
  }
  if (field.bytes.size() % sizeof(float) != 0) return false;
  for (std::size_t at = 0; at < field.bytes.size() && count < kSize; at += sizeof(float)) {
    float value = 0;
    std::memcpy(&value, field.bytes.data() + at, sizeof value);
    out[count++] = value;
  }
  return true;
}

/// Reads a message Vector3 or Joints.
template <std::size_t kSize>
bool read_numbers(std::span<const std::byte> bytes, std::array<double, kSize>& out) noexcept {
  std::array<double, kSize> exact{};
  std::size_t singles = 0, doubles = 0;
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  bool ok = true;
  while (scanner.next(field)) {
    if (field.number == 1) ok &= read_singles(field, out, singles);
    if (field.number == 2) ok &= read_values(field, exact, doubles);
  }
  if (doubles > 0) out = exact;
  return ok && scanner.ok();
}

void write_seat_energy(FieldWriter& fields, const SeatEnergySample& sample) {
  fields.packed(1, without_zeros(sample.e_in));
  fields.packed(2, without_zeros(sample.e_out));
  const std::array<double, 4> values{sample.dissipated_j, sample.refused_j, sample.margin_min_j, sample.delivered_j};
  bool exact = true;
  for (unsigned k = 0; k < values.size(); ++k) {
    fields.fixed32(3 + k, std::bit_cast<std::uint32_t>(to_single(values[k])));
    exact &= is_single(values[k]);
  }
  if (!exact) fields.packed(7, std::span<const double>(values));
}

/// The sum as the server computes it, and as a reader does if the message has no e_p_j.
double sum_of(const Triple& axes) noexcept { return 0 + axes[0] + axes[1] + axes[2]; }
/// False for NaN, which may have other bits in another program's sum.
bool is_sum(double all, const Triple& axes) noexcept {
  return !std::isnan(all) && std::bit_cast<std::uint64_t>(all) == std::bit_cast<std::uint64_t>(sum_of(axes));
}

void write_tool_energy(FieldWriter& fields, const ToolEnergySample& sample) {
  const bool sum = is_sum(sample.e_p_j, sample.e_p_axis_j);
  fields.fixed32(1, std::bit_cast<std::uint32_t>(to_single(sample.mfs_j)));
  if (!sum) fields.fixed32(2, std::bit_cast<std::uint32_t>(to_single(sample.e_p_j)));
  fields.singles(3, sample.e_p_axis_j);
  if (is_single(sample.mfs_j) && (sum || is_single(sample.e_p_j)) && std::ranges::all_of(sample.e_p_axis_j, is_single))
    return;
  const Triple& axes = sample.e_p_axis_j;
  const std::array<double, 5> exact{sample.mfs_j, sample.e_p_j, axes[0], axes[1], axes[2]};
  fields.packed(4, std::span<const double>(exact));
}

bool read_seat_energy(std::span<const std::byte> bytes, SeatEnergySample& out) noexcept {
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  std::array<double, 4> values{}, exact{};
  std::size_t in = 0, given = 0, doubles = 0;
  bool ok = true;
  while (scanner.next(field)) switch (field.number) {
      case 1:
        ok &= read_values(field, out.e_in, in);
        break;
      case 2:
        ok &= read_values(field, out.e_out, given);
        break;
      case 3:
      case 4:
      case 5:
      case 6:
        if (field.type == FieldType::kFixed32)
          values[field.number - 3] = std::bit_cast<float>(static_cast<std::uint32_t>(field.value));
        break;
      case 7:
        ok &= read_values(field, exact, doubles);
        break;
      default:
        break;
    }
  if (doubles > 0) values = exact;
  out.dissipated_j = values[0];
  out.refused_j = values[1];
  out.margin_min_j = values[2];
  out.delivered_j = values[3];
  return ok && scanner.ok();
}

bool read_tool_energy(std::span<const std::byte> bytes, ToolEnergySample& out) noexcept {
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  std::size_t axes = 0, doubles = 0;
  std::optional<double> all;
  std::array<double, 5> exact{};
  bool ok = true;
  while (scanner.next(field)) {
    if (field.number == 1) out.mfs_j = field.single_value();
    if (field.number == 2) all = field.single_value();
    if (field.number == 3) ok &= read_singles(field, out.e_p_axis_j, axes);
    if (field.number == 4) ok &= read_values(field, exact, doubles);
  }
  out.e_p_j = all ? *all : sum_of(out.e_p_axis_j);
  if (doubles > 0) out = {exact[0], exact[1], {exact[2], exact[3], exact[4]}};
  return ok && scanner.ok();
}

}  // namespace

void round_tool(ToolSample& sample) noexcept {
  ToolEnergySample& energy = sample.energy;
  const bool sum = is_sum(energy.e_p_j, energy.e_p_axis_j);
  for (Triple* values : {&sample.measured_cp, &sample.setpoint_cp, &sample.measured_cf, &sample.servo_cf})
    for (double& value : *values) value = to_short(value);
  for (double& value : sample.measured_jp) value = to_short(value);
  sample.penetration = to_short(sample.penetration);
  energy.mfs_j = to_single(energy.mfs_j);
  for (double& value : energy.e_p_axis_j) value = to_single(value);
  energy.e_p_j = sum ? sum_of(energy.e_p_axis_j) : to_single(energy.e_p_j);
}

void encode(const SeatSample& sample, std::string& out) {
  out.clear();
  FieldWriter fields{out};
  fields.numbers(1, sample.measured_cp);
  fields.numbers(2, sample.measured_cv);
  fields.numbers(3, sample.measured_cf);
  fields.numbers(4, sample.servo_cf);
  fields.numbers(5, without_zeros(sample.measured_jp));
  fields.fixed32(6, sample.sample_tick);
  fields.number(7, sample.alpha);
  fields.varint(8, sample.gate);
  fields.varint(9, sample.engaged ? 1 : 0);
  fields.varint(10, sample.leader);
  if (!without_zeros(sample.ghost).empty()) fields.numbers(11, sample.ghost);
  fields.message(12, [&](FieldWriter& energy) { write_seat_energy(energy, sample.energy); });
}

void encode(const ToolSample& sample, std::string& out) {
  out.clear();
  FieldWriter fields{out};
  fields.numbers(1, sample.measured_cp);
  fields.numbers(2, sample.setpoint_cp);
  fields.numbers(3, sample.measured_cf);
  fields.numbers(4, sample.servo_cf);
  if (const auto joints = without_zeros(sample.measured_jp); !joints.empty()) fields.numbers(5, joints);
  fields.fixed32(6, sample.sample_tick);
  fields.fixed32(7, std::bit_cast<std::uint32_t>(to_single(sample.penetration)));
  fields.varint(8, sample.braked ? 1 : 0);
  fields.message(9, [&](FieldWriter& energy) { write_tool_energy(energy, sample.energy); });
  if (!is_single(sample.penetration)) fields.number(10, sample.penetration);
}

void encode(const AuthoritySample& sample, std::string& out) {
  out.clear();
  FieldWriter fields{out};
  for (std::size_t j = 0; j < sample.tools; ++j)
    fields.message(1, [&](FieldWriter& row) { row.packed(1, std::span{sample.alpha[j]}.first(sample.masters)); });
}

void encode(const SessionSample& sample, std::string& out) {
  out.clear();
  FieldWriter fields{out};
  fields.varint(1, sample.running ? 1 : 0);
  fields.varint(2, sample.stopped_ticks);
  fields.varint(3, sample.dropped_ticks);
}

bool decode(std::span<const std::byte> bytes, SeatSample& out) noexcept {
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  bool ok = true;
  while (scanner.next(field)) switch (field.number) {
      case 1:
        ok &= read_numbers(field.bytes, out.measured_cp);
        break;
      case 2:
        ok &= read_numbers(field.bytes, out.measured_cv);
        break;
      case 3:
        ok &= read_numbers(field.bytes, out.measured_cf);
        break;
      case 4:
        ok &= read_numbers(field.bytes, out.servo_cf);
        break;
      case 5:
        ok &= read_numbers(field.bytes, out.measured_jp);
        break;
      case 6:
        out.sample_tick = static_cast<std::uint32_t>(field.value);
        break;
      case 7:
        out.alpha = field.number_value();
        break;
      case 8:
        out.gate = static_cast<std::uint8_t>(field.value);
        break;
      case 9:
        out.engaged = field.value != 0;
        break;
      case 10:
        out.leader = static_cast<std::uint32_t>(field.value);
        break;
      case 11:
        ok &= read_numbers(field.bytes, out.ghost);
        break;
      case 12:
        ok &= read_seat_energy(field.bytes, out.energy);
        break;
      default:
        break;
    }
  return ok && scanner.ok();
}

bool decode(std::span<const std::byte> bytes, ToolSample& out) noexcept {
  out = {};
  std::optional<double> exact_penetration;
  FieldScanner scanner{bytes};
  Field field;
  bool ok = true;
  while (scanner.next(field)) switch (field.number) {
      case 1:
        ok &= read_numbers(field.bytes, out.measured_cp);
        break;
      case 2:
        ok &= read_numbers(field.bytes, out.setpoint_cp);
        break;
      case 3:
        ok &= read_numbers(field.bytes, out.measured_cf);
        break;
      case 4:
        ok &= read_numbers(field.bytes, out.servo_cf);
        break;
      case 5:
        ok &= read_numbers(field.bytes, out.measured_jp);
        break;
      case 6:
        out.sample_tick = static_cast<std::uint32_t>(field.value);
        break;
      case 7:
        out.penetration = field.single_value();
        break;
      case 8:
        out.braked = field.value != 0;
        break;
      case 9:
        ok &= read_tool_energy(field.bytes, out.energy);
        break;
      case 10:
        exact_penetration = field.number_value();
        break;
      default:
        break;
    }
  if (exact_penetration) out.penetration = *exact_penetration;
  return ok && scanner.ok();
}

bool decode(std::span<const std::byte> bytes, AuthoritySample& out) noexcept {
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  while (scanner.next(field)) {
    if (field.number != 1 || out.tools == kToolsMax) continue;
    FieldScanner row{field.bytes};
    Field value;
    std::size_t masters = 0;
    while (row.next(value))
      if (value.number == 1 && !read_values(value, out.alpha[out.tools], masters)) return false;
    if (!row.ok()) return false;
    out.masters = masters;
    ++out.tools;
  }
  return scanner.ok();
}

bool decode(std::span<const std::byte> bytes, SessionSample& out) noexcept {
  out = {};
  FieldScanner scanner{bytes};
  Field field;
  while (scanner.next(field)) {
    if (field.number == 1) out.running = field.value != 0;
    if (field.number == 2) out.stopped_ticks = field.value;
    if (field.number == 3) out.dropped_ticks = field.value;
  }
  return scanner.ok();
}

}  // namespace tandem::rec

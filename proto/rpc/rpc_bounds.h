#pragma once

#include <google/protobuf/repeated_field.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/rpc/rpc_texts.h"

/// Bounds of single values in control frames, for all messages. Each `take` returns whether the value is in range;
/// total.
namespace tandem::rpc {

inline constexpr double kFactMax = 1e4;

inline bool is_code(std::string_view text) noexcept {
  return text.size() == kSessionCodeSize &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); });
}

template <std::size_t N>
bool take(const std::string& in, std::array<std::byte, N>& out) noexcept {
  if (in.size() != N) return false;
  std::ranges::transform(in, out.begin(), [](char c) { return static_cast<std::byte>(c); });
  return true;
}
inline std::vector<std::byte> to_bytes(const std::string& in) {
  std::vector<std::byte> out(in.size());
  std::ranges::transform(in, out.begin(), [](char c) { return static_cast<std::byte>(c); });
  return out;
}
inline std::string text_of(std::span<const std::byte> in) {
  std::string out(in.size(), '\0');
  std::ranges::transform(in, out.begin(), [](std::byte b) { return static_cast<char>(b); });
  return out;
}

inline bool within(std::uint32_t value, std::uint32_t least, std::uint32_t most) noexcept {
  return value >= least && value <= most;
}
inline bool within(double value) noexcept { return value >= 0 && value <= kFactMax; }  // false for NaN

inline bool take_name(const std::string& in, std::string& out, bool may_be_empty = false) {
  out = in;
  return is_name(in) || (may_be_empty && in.empty());
}
inline bool take_role(std::uint32_t in, AccessRole& out) noexcept {
  out = static_cast<AccessRole>(in < kAccessRoles ? in : 0);
  return in < kAccessRoles;
}

inline bool take_weights(const google::protobuf::RepeatedField<double>& in, std::vector<double>& out) {
  double sum = 0;
  for (const double a : in) {
    if (!(a >= 0 && a <= 1)) return false;
    sum += a;
  }
  out.assign(in.begin(), in.end());
  return !out.empty() && out.size() <= kMastersMax && std::abs(sum - 1) <= 1e-9;
}

}  // namespace tandem::rpc

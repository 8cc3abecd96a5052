#pragma once

#include <google/protobuf/repeated_field.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"

/// Bounds of single values in control frames, for all messages. Each `take` returns whether the value is in range;
/// total.
namespace tandem::rpc {

inline constexpr double kFactMax = 1e4;
inline constexpr double kTimeMax = 1e9;  // [s]

inline bool is_name(std::string_view text) noexcept {
  return !text.empty() && text.size() <= kNameMax && std::ranges::all_of(text, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

inline bool is_code(std::string_view text) noexcept {
  return text.size() == kSessionCodeSize &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); });
}

/// Whether text is UTF-8 [RFC 3629] without control characters, so that it cannot control a terminal; at most
/// `most` bytes.
inline bool is_text(std::string_view text, std::size_t most = kTextMax) noexcept {
  if (text.size() > most) return false;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead < 0x20 || lead == 0x7f) return false;
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xc2 ? 4
                             : lead < 0xe0 ? 1
                             : lead < 0xf0 ? 2
                             : lead < 0xf5 ? 3
                                           : 4;
    if (more > 3 || i + more >= text.size()) return false;
    std::uint32_t point = more == 0 ? lead : lead & (0x3fU >> more);
    for (std::size_t k = 1; k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xc0U) != 0x80) return false;
      point = point << 6 | (next & 0x3fU);
    }
    const bool shortest = more < 2 || point >= (more == 2 ? 0x800U : 0x10000U);
    if (!shortest || point > 0x10ffff || (point >= 0xd800 && point <= 0xdfff) || (point >= 0x80 && point < 0xa0))
      return false;
    i += more + 1;
  }
  return true;
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

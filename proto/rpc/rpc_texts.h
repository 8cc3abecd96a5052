#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "proto/rpc/rpc_limits.h"

/// Rules of texts and times in control messages, for programs that read them from elsewhere. Total.
namespace tandem::rpc {

inline constexpr double kTimeMax = 1e9;  ///< of a session clock [s]

/// The rule of `is_name` in words.
inline constexpr std::string_view kNameRule = "1 to 32 characters of A-Z a-z 0-9 _ -";
static_assert(kNameMax == 32);

/// Whether text is a name: 1 to kNameMax of A-Z a-z 0-9 _ -.
inline bool is_name(std::string_view text) noexcept {
  return !text.empty() && text.size() <= kNameMax && std::ranges::all_of(text, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// Whether text may be HOST:PORT: at most kAddressMax printable characters without space and quote. Only a client that
/// connects resolves it.
inline bool is_address(std::string_view text) noexcept {
  return text.size() >= 3 && text.size() <= kAddressMax && text.find(':') != std::string_view::npos &&
         std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~' && c != '"' && c != '\\'; });
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

}  // namespace tandem::rpc

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tandem::console {

/// Name and port of a Host header.
struct HostName {
  std::string_view name;  ///< without brackets; empty: the header is wrong
  std::uint16_t port = 0;
};
/// Splits a Host header [RFC 9110, 7.2]. @param usual  port of a header without one: 80, or 443 with TLS
[[nodiscard]] HostName split_host(std::string_view host, std::uint16_t usual) noexcept;
/// Returns whether a name is one of this computer's loopback: 127.0.0.1, localhost or ::1. Another name means DNS
/// rebinding, unless a certificate covers it: a foreign page that resolves to this computer.
[[nodiscard]] bool is_loopback_name(std::string_view name) noexcept;
/// Returns whether a request with this Origin header comes from the page of the same Host. @param tls  https, not http
[[nodiscard]] bool origin_allowed(std::string_view origin, std::string_view host, bool tls);
/// Returns the value of a cookie in the Cookie header [RFC 6265, 4.2.1]; empty: it is not there.
[[nodiscard]] std::string_view cookie_value(std::string_view header, std::string_view name) noexcept;
/// Returns the token of the request target `/?token=...`; empty: the target has another form.
[[nodiscard]] std::string_view token_of(std::string_view target) noexcept;

}  // namespace tandem::console

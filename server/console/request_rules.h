#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tandem::console {

/// Returns whether `host`, the Host header, names this gateway on loopback: 127.0.0.1, localhost or [::1] with its
/// port. Another name means DNS rebinding: a foreign page that resolves to this computer.
[[nodiscard]] bool host_allowed(std::string_view host, std::uint16_t port);
/// Returns whether a WebSocket with this Origin header comes from the page of the same Host.
[[nodiscard]] bool origin_allowed(std::string_view origin, std::string_view host);
/// Returns the value of a cookie in the Cookie header [RFC 6265, 4.2.1]; empty: it is not there.
[[nodiscard]] std::string_view cookie_value(std::string_view header, std::string_view name) noexcept;
/// Returns the token of the request target `/?token=...`; empty: the target has another form.
[[nodiscard]] std::string_view token_of(std::string_view target) noexcept;

}  // namespace tandem::console

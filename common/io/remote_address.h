#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace tandem::io {

/// Validates `HOST:PORT` or `[IPV6]:PORT` as an address that another machine will connect to; only that machine
/// resolves the name. @return the error, empty if valid
[[nodiscard]] inline std::string remote_address_error(std::string_view text) {
  const auto wrong = [text](const char* why) { return "\"" + std::string(text) + "\": " + why; };
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return wrong("needs HOST:PORT, such as lab-server:7000");
  const std::string_view host = text.substr(0, colon), port_text = text.substr(colon + 1);
  unsigned port = 0;
  const auto [end, error] = std::from_chars(port_text.data(), port_text.data() + port_text.size(), port);
  if (error != std::errc{} || end != port_text.data() + port_text.size() || port < 1 || port > 65535)
    return wrong("the port must be a whole number in [1, 65535]");
  const bool brackets = host.size() >= 2 && host.front() == '[' && host.back() == ']';
  if (host.empty() || host == "[]") return wrong("the host is missing, such as lab-server:7000");
  if (!brackets && host.find(':') != std::string_view::npos)
    return wrong("an IPv6 address needs brackets, such as [2001:db8::1]:7000");
  for (const char c : host)
    if (c <= ' ' || c > '~' || c == '"' || c == '\\') return wrong("the host holds a character that no address has");
  if (text.size() > 96) return wrong("is longer than 96 characters");
  if (host == "0.0.0.0" || host == "[::]")
    return wrong("is no address that a client can connect to; name the address by which clients reach this machine");
  return {};
}

}  // namespace tandem::io

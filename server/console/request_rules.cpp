#include "server/console/request_rules.h"

#include <charconv>
#include <system_error>

namespace tandem::console {

HostName split_host(std::string_view host, std::uint16_t usual) noexcept {
  const bool bracket = host.starts_with('[');
  const auto end = bracket ? host.find(']') : host.find(':');
  HostName split{host.substr(0, end), usual};
  std::string_view rest = end == std::string_view::npos ? std::string_view{} : host.substr(end);
  if (bracket) {
    if (rest.empty()) return {};
    split.name.remove_prefix(1);
    rest.remove_prefix(1);
  }
  if (rest.empty()) return split;
  if (!rest.starts_with(':')) return {};
  rest.remove_prefix(1);
  const auto [last, error] = std::from_chars(rest.data(), rest.data() + rest.size(), split.port);
  if (error != std::errc{} || last != rest.data() + rest.size()) return {};
  return split;
}

bool is_loopback_name(std::string_view name) noexcept {
  return name == "127.0.0.1" || name == "localhost" || name == "::1";
}

bool origin_allowed(std::string_view origin, std::string_view host, bool tls) {
  return !host.empty() && origin == (tls ? "https://" : "http://") + std::string(host);
}

std::string_view cookie_value(std::string_view header, std::string_view name) noexcept {
  while (!header.empty()) {
    const auto end = header.find(';');
    std::string_view pair = header.substr(0, end);
    header = end == std::string_view::npos ? std::string_view{} : header.substr(end + 1);
    while (pair.starts_with(' ')) pair.remove_prefix(1);
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('=')) return pair.substr(name.size() + 1);
  }
  return {};
}

std::string_view token_of(std::string_view target) noexcept {
  constexpr std::string_view kBegin = "/?token=";
  return target.starts_with(kBegin) ? target.substr(kBegin.size()) : std::string_view{};
}

}  // namespace tandem::console

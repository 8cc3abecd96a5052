#include "server/console/request_rules.h"

namespace tandem::console {

bool host_allowed(std::string_view host, std::uint16_t port) {
  const std::string end = ":" + std::to_string(port);
  if (!host.ends_with(end)) return false;
  host.remove_suffix(end.size());
  return host == "127.0.0.1" || host == "localhost" || host == "[::1]";
}

bool origin_allowed(std::string_view origin, std::string_view host) {
  return !host.empty() && origin == "http://" + std::string(host);
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

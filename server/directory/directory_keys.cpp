#include "server/directory/directory_keys.h"

#include <algorithm>

namespace tandem::directory {

bool DirectoryKeys::valid_name(std::string_view name) noexcept {
  constexpr std::size_t kNameMax = 64;
  return !name.empty() && name.size() <= kNameMax && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  });
}

std::optional<DirectoryKeys::Parsed> DirectoryKeys::parse(std::string_view key) const {
  const std::string servers = server(""), sessions = live() + "sessions/";
  Parsed parsed;
  if (key.starts_with(servers)) {
    parsed.name = key.substr(servers.size());
  } else if (key.starts_with(sessions)) {
    key.remove_prefix(sessions.size());
    const std::size_t slash = key.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const std::string_view what = key.substr(slash + 1);
    if (what != "owner" && what != "standby") return std::nullopt;
    parsed.kind = what == "owner" ? Parsed::Kind::kOwner : Parsed::Kind::kStandby;
    parsed.name = key.substr(0, slash);
  } else {
    return std::nullopt;
  }
  if (!valid_name(parsed.name)) return std::nullopt;
  return parsed;
}

}  // namespace tandem::directory

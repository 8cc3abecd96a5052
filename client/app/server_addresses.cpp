#include "client/app/server_addresses.h"

#include <algorithm>

#include "common/io/remote_address.h"

namespace tandem::client {
namespace {

void add_once(const io::SocketAddress& address, std::vector<io::SocketAddress>& list) {
  const std::string text = io::to_text(address);
  if (list.size() < kAddressesTried &&
      std::ranges::none_of(list, [&](const io::SocketAddress& other) { return io::to_text(other) == text; }))
    list.push_back(address);
}

/// Whether a known server is one that the options name.
bool is_meant(const ServerRow& row, const JoinOptions& options, const std::vector<io::SocketAddress>& given) {
  const auto named = [&](const std::string& address) {
    return std::ranges::find(options.typed, address) != options.typed.end() ||
           std::ranges::any_of(given, [&](const io::SocketAddress& a) { return io::to_text(a) == address; });
  };
  return named(row.address) || std::ranges::any_of(row.members, named);
}

}  // namespace

std::string set_server_addresses(std::string_view text, JoinOptions& options) {
  std::vector<io::SocketAddress> found;
  std::string wrong;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view part = text.substr(at, end - at);
    at = end + 1;
    const auto addresses = io::resolve_addresses(part, 1);
    if (addresses) {
      options.typed.emplace_back(part);
      for (const io::SocketAddress& address : *addresses) add_once(address, found);
      continue;
    }
    if (std::string mistake = io::remote_address_error(part); !mistake.empty()) return mistake;
    wrong += (wrong.empty() ? "" : "; ") + addresses.error();  // the others may do
  }
  if (found.empty()) return wrong;
  options.unresolved = wrong;
  options.server = found.front();
  options.alternatives.assign(found.begin() + 1, found.end());
  return {};
}

void add_addresses(std::string_view text, std::vector<io::SocketAddress>& list) {
  if (const auto addresses = io::resolve_addresses(text, 1))
    for (const io::SocketAddress& address : *addresses) add_once(address, list);
}

std::vector<io::SocketAddress> addresses_to_try(const JoinOptions& options, const std::vector<ServerRow>& known) {
  std::vector<io::SocketAddress> list{options.server};
  for (const io::SocketAddress& address : options.alternatives) add_once(address, list);
  const std::vector<io::SocketAddress> given = list;
  for (const ServerRow& row : known)
    if (is_meant(row, options, given))
      for (const std::string& member : row.members) add_addresses(member, list);
  return list;
}

}  // namespace tandem::client

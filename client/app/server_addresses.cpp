#include "client/app/server_addresses.h"

#include <algorithm>

#include "common/io/clock.h"
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

void ServerAddresses::add(const io::SocketAddress& address) {
  if (size() < kAddressesTried) add_once(address, known_);
}

void ServerAddresses::add(std::string_view text) {
  if (const auto address = io::numeric_address(text, 1)) return add(*address);
  if (size() < kAddressesTried && std::ranges::find(names_, text, &Name::text) == names_.end())
    names_.push_back({std::string(text), {}});
}

void ServerAddresses::begin(Duration names_wait, Time names_until) noexcept {
  next_ = 0;
  wait_ = names_wait;
  until_ = names_until;
  pending_ = false;
}

bool ServerAddresses::has(std::size_t i) {
  while (i >= known_.size() && next_ < names_.size() && !interrupted_) {
    const Time asked = io::monotonic_now();
    const auto found = resolver_.resolve(names_[next_].text, std::min<Duration>(wait_, until_ - asked), signals_);
    wait_ = std::max(Duration{}, wait_ - (io::monotonic_now() - asked));
    if (found) {
      names_.erase(names_.begin() + static_cast<std::ptrdiff_t>(next_));
      for (const io::SocketAddress& address : *found) add(address);
      continue;
    }
    using Kind = io::NameResolver::Failure::Kind;
    pending_ = pending_ || found.error().kind == Kind::kPending;
    interrupted_ = found.error().kind == Kind::kInterrupted;
    names_[next_++].why = found.error().text;
  }
  return i < known_.size();
}

std::string ServerAddresses::unresolved() const {
  std::string text;
  for (const Name& name : names_)
    if (!name.why.empty()) text += (text.empty() ? "" : "; ") + name.why;
  return text;
}

ServerAddresses addresses_to_try(const JoinOptions& options, const std::vector<ServerRow>& known) {
  ServerAddresses list{options};
  list.add(options.server);
  for (const io::SocketAddress& address : options.alternatives) list.add(address);
  const std::vector<io::SocketAddress> given = list.known();
  for (const ServerRow& row : known)
    if (is_meant(row, options, given))
      for (const std::string& member : row.members) list.add(member);
  return list;
}

}  // namespace tandem::client

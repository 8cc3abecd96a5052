#include "server/app/service/service_locator.h"

#include <algorithm>

namespace tandem::server {
namespace {

std::optional<std::vector<std::byte>> bytes_of(const std::string& hex) {
  if (hex.size() % 2 != 0) return std::nullopt;
  std::vector<std::byte> bytes(hex.size() / 2);
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const char c = hex[i];
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    if (digit < 0) return std::nullopt;
    bytes[i / 2] = bytes[i / 2] << 4 | static_cast<std::byte>(digit);
  }
  return bytes;
}

}  // namespace

std::optional<ServerLocation> location_of(const directory::ServerRecord& record, const std::string& session,
                                          std::uint64_t revision) {
  const auto key = bytes_of(record.key);
  auto voucher = bytes_of(record.voucher);
  ServerLocation location{.address = record.address, .voucher = {}, .session = session, .revision = revision};
  if (!key || key->size() != location.key.size() || !voucher) return std::nullopt;
  std::ranges::copy(*key, location.key.begin());
  location.voucher = std::move(*voucher);
  return location;
}

std::vector<std::string> member_addresses(const std::string& own,
                                          const std::map<std::string, directory::ServerRecord>& present,
                                          const std::map<std::string, std::string>& seen) {
  std::vector<std::string> addresses;
  const auto add = [&](const std::string& address) {
    if (addresses.size() < ServiceLocator::kMembersMax && std::ranges::find(addresses, address) == addresses.end())
      addresses.push_back(address);
  };
  if (const auto record = present.find(own); record != present.end())
    add(record->second.address);
  else if (const auto before = seen.find(own); before != seen.end())
    add(before->second);
  for (const auto& [name, record] : present) add(record.address);
  for (const auto& [name, address] : seen) add(address);
  return addresses;
}

SessionLocator::Found ServiceLocator::locate(const rpc::SessionChoice& choice) {
  const SessionPlace place = thread_.with([&](ServiceMember& member, Time) { return member.locate(choice); });
  switch (place.kind) {
    case SessionPlace::Kind::kNone:
      return None{};
    case SessionPlace::Kind::kHere:
      return Here{};
    case SessionPlace::Kind::kComing:
      return Coming{};
    case SessionPlace::Kind::kUnknown:
      return Unknown{"the directory of the service does not answer, or has lost its data"};
    case SessionPlace::Kind::kElsewhere:
      break;
  }
  auto location = location_of(*place.record, place.session, static_cast<std::uint64_t>(place.revision));
  if (!location)
    return Unknown{"server " + place.server + " has published no valid key (a restart of that server mends this)"};
  return std::move(*location);
}

std::vector<SessionLocator::Elsewhere> ServiceLocator::elsewhere() const {
  return thread_.quietly([&](ServiceMember& member, Time) {
    std::vector<Elsewhere> list;
    for (auto& [name, server] : member.places().away()) {
      const ServiceCatalogue::Entry& entry = member.directory().catalogue.entries().find(name)->second;
      Elsewhere there{{entry.spec->id, name, {}, {}}, std::move(server)};
      static_cast<void>(read_listed(entry.listed_text, there.session));
      if (there.server.empty()) there.session.phase = rpc::SessionPhase::kWaiting;  // its last server left the text
      list.push_back(std::move(there));
    }
    return list;
  });
}

void ServiceLocator::remember_members() {
  const auto records = thread_.quietly([](const ServiceMember& member, Time) { return member.directory().members(); });
  const std::lock_guard lock(lock_);
  for (const auto& [name, record] : records)
    if (addresses_.size() < kMembersMax || addresses_.contains(name)) addresses_[name] = record.address;
}

std::vector<std::string> ServiceLocator::members() const {
  const auto records = thread_.quietly([](const ServiceMember& member, Time) { return member.directory().members(); });
  const std::lock_guard lock(lock_);
  return member_addresses(server_, records, addresses_);
}

bool ServiceLocator::fresh() const noexcept {
  return thread_.quietly([](ServiceMember& member, Time now) { return member.status(now).current; });
}

}  // namespace tandem::server

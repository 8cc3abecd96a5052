#include "server/service/servers_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/base/utc_date.h"
#include "proto/rpc/service_codec.h"
#include "server/directory/placement/server_record.h"

namespace tandem::server {

namespace {

using Row = std::array<std::string, 9>;

std::string voucher_end(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  const auto credential = rpc::decode_member_credential(bytes);
  const auto statement = rpc::decode_service_statement(credential ? credential->voucher : bytes);
  const auto content = statement ? rpc::decode_voucher_content(statement->content) : std::nullopt;
  return content ? utc_date(content->not_after) : "?";
}

bool is_hex(const std::string& text) {
  return text.find_first_not_of("0123456789abcdef") == std::string::npos && text.size() % 2 == 0;
}

std::string lines_of(const std::vector<Row>& rows) {
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += row[c] + std::string(widths[c] + 2 - row[c].size(), ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// Numbers of a version such as 1.2.10.
std::vector<unsigned long> numbers_in(const std::string& version) {
  std::vector<unsigned long> numbers;
  for (std::size_t at = 0; at < version.size() && numbers.size() < 8;) {
    const std::size_t begin = version.find_first_of("0123456789", at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(version.find_first_not_of("0123456789", begin), version.size());
    unsigned long number = 0;
    static_cast<void>(std::from_chars(version.data() + begin, version.data() + end, number));
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

std::string newest_version(const directory::DirectoryView& view) {
  std::string newest;
  for (const auto& [name, server] : view.servers())
    if (const auto record = directory::parse_server_record(server.text))
      if (numbers_in(newest) < numbers_in(record->version)) newest = record->version;
  return newest;
}

std::string lease_text(const LeaseRests& rests, directory::LeaseId lease) {
  const auto rest = rests.find(lease);
  if (rest == rests.end()) return "?";
  return rest->second ? format("%.0f s left", seconds(*rest->second)) : "ended";
}

}  // namespace

std::string servers_table(const directory::DirectoryView& view, const ServiceCatalogue& catalogue,
                          const LeaseRests& rests) {
  std::vector<Row> rows{
      {"SERVER", "ADDRESS", "VERSION", "ZONE", "LOAD", "SESSIONS", "STANDBY", "LEASE", "VOUCHER UNTIL"}};
  const std::string newest = newest_version(view);
  for (const auto& [name, server] : view.servers()) {
    const auto owned = std::ranges::count_if(view.sessions(), [&](const auto& session) {
      return session.second.owner && session.second.owner->name == name;
    });
    const auto stands_by = std::ranges::count_if(view.sessions(), [&](const auto& session) {
      return session.second.standby && session.second.standby->name == name;
    });
    const std::string lease = lease_text(rests, server.lease);
    const auto record = directory::parse_server_record(server.text);
    if (!record) {
      rows.push_back({name, "unreadable", "", "", "", std::to_string(owned), std::to_string(stands_by), lease, ""});
      continue;
    }
    rows.push_back({name, sanitize(record->address),
                    sanitize(record->version) + (numbers_in(record->version) < numbers_in(newest) ? " (older)" : ""),
                    record->zone.empty() ? "-" : sanitize(record->zone),
                    format("%.2f of %.1f cores", record->used, record->capacity) + (record->drains ? ", drains" : ""),
                    std::to_string(owned), std::to_string(stands_by), lease,
                    is_hex(record->voucher) ? voucher_end(record->voucher) : "?"});
  }
  const bool alone = view.servers().size() == 1;
  bool without = false;
  std::string text = rows.size() > 1 ? lines_of(rows) : "no server is registered in this service\n";
  for (const auto& [name, entry] : catalogue.entries()) {
    const auto* const seen = view.session(name);
    if (entry.spec && (seen == nullptr || !seen->owner))
      text += "session " + name +
              (view.servers().empty() ? " has no server; it begins again when one starts\n"
                                      : " has no server; one takes it over when a client asks for it\n");
    else if (entry.spec && !seen->standby && alone)
      without = true;
    else if (entry.spec && !seen->standby)
      text += "session " + name + " has no standby now: its server names one within some seconds\n";
  }
  if (without) text += "no session has a standby, because no other server is registered\n";
  return text;
}

}  // namespace tandem::server

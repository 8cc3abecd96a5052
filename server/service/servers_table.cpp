#include "server/service/servers_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "proto/rpc/service_codec.h"
#include "server/directory/placement/server_record.h"

namespace tandem::server {

namespace {

using Row = std::array<std::string, 7>;

/// Date of a time in seconds since 1970, UTC, by the proleptic Gregorian calendar. Source: Howard Hinnant,
/// "chrono-Compatible Low-Level Date Algorithms", civil_from_days.
std::string date_text(std::int64_t at) {
  const std::chrono::year_month_day day{
      std::chrono::sys_days{std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds{std::chrono::seconds(at)})}};
  return format("%04d-%02u-%02u", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                static_cast<unsigned>(day.day()));
}

std::string voucher_end(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  const auto credential = rpc::decode_member_credential(bytes);
  const auto statement = rpc::decode_service_statement(credential ? credential->voucher : bytes);
  const auto content = statement ? rpc::decode_voucher_content(statement->content) : std::nullopt;
  return content ? date_text(content->not_after) : "?";
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

}  // namespace

std::string servers_table(const directory::DirectoryView& view, const ServiceCatalogue& catalogue) {
  std::vector<Row> rows{{"SERVER", "ADDRESS", "VERSION", "ZONE", "LOAD", "SESSIONS", "VOUCHER UNTIL"}};
  for (const auto& [name, server] : view.servers()) {
    const auto owned = std::ranges::count_if(view.sessions(), [&](const auto& session) {
      return session.second.owner && session.second.owner->name == name;
    });
    const auto record = directory::parse_server_record(server.text);
    if (!record) {
      rows.push_back({name, "unreadable", "", "", "", std::to_string(owned), ""});
      continue;
    }
    rows.push_back({name, sanitize(record->address), sanitize(record->version),
                    record->zone.empty() ? "-" : sanitize(record->zone),
                    format("%.2f of %.1f cores", record->used, record->capacity) + (record->drains ? ", drains" : ""),
                    std::to_string(owned), is_hex(record->voucher) ? voucher_end(record->voucher) : "?"});
  }
  std::string text = rows.size() > 1 ? lines_of(rows) : "no server is registered in this service\n";
  for (const auto& [name, entry] : catalogue.entries()) {
    const auto* const seen = view.session(name);
    if (entry.spec && (seen == nullptr || !seen->owner))
      text += "session " + name + " has no server; one takes it over when a client asks for it\n";
  }
  return text;
}

}  // namespace tandem::server

#include "proto/text/registry_text.h"

#include <algorithm>
#include <set>
#include <span>

#include "common/base/hex.h"
#include "proto/schema/registry.pb.h"
#include "proto/text/registry_reader.h"

namespace tandem {
namespace {

using text::bytes_from;
using text::child_path;
using text::MessageValidator;

/// Checks the form HOST:PORT only; a client that dials the address checks the rest.
void check_address(const std::string& address, MessageValidator& validator, const std::string& key) {
  const bool printable =
      std::ranges::all_of(address, [](char c) { return c > ' ' && c <= '~' && c != '"' && c != '\\'; });
  if (validator.is_set(key) &&
      (address.empty() || address.size() > 96 || !printable || address.find(':') == std::string::npos))
    validator.error(key, "must be HOST:PORT, at most 96 characters");
}

/// Rejects a value that an earlier row has.
template <class Value>
void once(std::set<Value>& seen, const Value& value, MessageValidator& validator, const std::string& key) {
  if (!seen.insert(value).second) validator.error(key, "occurs twice; delete one of the two rows");
}

std::string row(std::string_view key, const std::string& value) {
  return "  " + std::string(key) + ": \"" + value + "\"\n";
}
std::string row(std::string_view key, std::uint64_t value) {
  return "  " + std::string(key) + ": " + std::to_string(value) + "\n";
}
std::string row(std::string_view key, std::int64_t value) {
  return row(key, static_cast<std::uint64_t>(std::max<std::int64_t>(value, 0)));
}

}  // namespace

std::expected<std::vector<WorkstationRow>, InputErrors> parse_workstations(std::string_view text,
                                                                           std::string_view file) {
  MessageValidator validator(file);
  const auto in = text::read_registry_file<pb::WorkstationBookFile>(text, validator);
  std::vector<WorkstationRow> rows;
  std::set<std::string> names;
  std::set<Sha256> keys;
  for (int i = 0; i < in.workstation_size(); ++i) {
    const pb::Workstation& w = in.workstation(i);
    const std::string at = child_path("", "workstation", i);
    const Sha256 spki = bytes_from<32>(w.spki_sha256(), validator, child_path(at, "spki_sha256"));
    once(names, w.name(), validator, child_path(at, "name"));
    once(keys, spki, validator, child_path(at, "spki_sha256"));
    rows.push_back({w.name(), spki, static_cast<std::int64_t>(w.enrolled_at_s())});
  }
  return text::registry_verdict(std::move(rows), validator);
}

std::expected<std::vector<CodeRow>, InputErrors> parse_codes(std::string_view text, std::string_view file) {
  MessageValidator validator(file);
  const auto in = text::read_registry_file<pb::EnrolmentCodeFile>(text, validator);
  std::vector<CodeRow> rows;
  std::set<Sha256> hashes;
  for (int i = 0; i < in.code_size(); ++i) {
    const pb::EnrolmentCode& c = in.code(i);
    const std::string at = child_path("", "code", i);
    const Sha256 hash = bytes_from<32>(c.sha256(), validator, child_path(at, "sha256"));
    once(hashes, hash, validator, child_path(at, "sha256"));
    rows.push_back({hash, c.workstation(), static_cast<std::int64_t>(c.not_after_s())});
  }
  return text::registry_verdict(std::move(rows), validator);
}

std::expected<std::vector<ServerRow>, InputErrors> parse_servers(std::string_view text, std::string_view file) {
  MessageValidator validator(file);
  const auto in = text::read_registry_file<pb::KnownServerFile>(text, validator);
  std::vector<ServerRow> rows;
  std::set<std::string> addresses;
  for (int i = 0; i < in.server_size(); ++i) {
    const pb::KnownServer& s = in.server(i);
    const std::string at = child_path("", "server", i);
    check_address(s.address(), validator, child_path(at, "address"));
    once(addresses, s.address(), validator, child_path(at, "address"));
    ServerRow& row =
        rows.emplace_back(s.address(), bytes_from<32>(s.spki_sha256(), validator, child_path(at, "spki_sha256")),
                          s.name(), std::nullopt, std::vector<std::string>{});
    if (s.has_service_key()) {
      row.service.emplace().key = bytes_from<32>(s.service_key(), validator, child_path(at, "service_key"));
      if (s.has_service_key_before())
        row.service->previous = bytes_from<32>(s.service_key_before(), validator, child_path(at, "service_key_before"));
      row.service->previous_until = static_cast<std::int64_t>(s.service_key_before_until_s());
    }
    if (s.has_service_key_before() != s.has_service_key_before_until_s() ||
        (s.has_service_key_before() && !s.has_service_key()))
      validator.error(child_path(at, "service_key_before"),
                      "stands only together with service_key and service_key_before_until_s");
    for (int k = 0; k < s.member_size(); ++k) {
      check_address(s.member(k), validator, child_path(at, "member", k));
      row.members.push_back(s.member(k));
    }
  }
  return text::registry_verdict(std::move(rows), validator);
}

std::expected<ServingSpec, InputErrors> parse_serving(std::string_view text, std::string_view file) {
  MessageValidator validator(file);
  const auto in = text::read_registry_file<pb::ServingFile>(text, validator);
  check_address(in.address(), validator, "address");
  ServingSpec out{in.address(), {}};
  std::set<std::array<std::byte, 16>> ids;
  for (int i = 0; i < in.session_size(); ++i) {
    const pb::ServedSession& s = in.session(i);
    const std::string at = child_path("", "session", i);
    OpenSession session{
        bytes_from<16>(s.id(), validator, child_path(at, "id")), s.code(), s.name(), s.epoch(), {}, s.phase()};
    once(ids, session.id, validator, child_path(at, "id"));
    const bool code = s.code().size() == 10 && std::ranges::all_of(s.code(), [](char c) {
                        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z');
                      });
    if (!code && s.has_code()) validator.error(child_path(at, "code"), "must be 10 characters of 0-9 A-Z");
    for (int k = 0; k < s.seat_size(); ++k) {
      const auto role = access_role_named(s.seat(k).role());
      if (!role && s.seat(k).has_role())
        validator.error(child_path(child_path(at, "seat", k), "role"),
                        "must be instructor, trainee, evaluator, observer, operator or recorder");
      session.seats.push_back(
          {s.seat(k).name(), role.value_or(AccessRole::kObserver), s.seat(k).taken(), s.seat(k).required()});
    }
    out.sessions.push_back(std::move(session));
  }
  return text::registry_verdict(std::move(out), validator);
}

std::string print_workstations(const std::vector<WorkstationRow>& rows) {
  std::string out =
      text::registry_header("Enrolled workstations; to revoke one, `tandem-server revoke NAME` or delete its row.");
  for (const WorkstationRow& r : rows)
    out += "workstation {\n" + row("name", r.name) + row("spki_sha256", to_hex(r.spki)) +
           row("enrolled_at_s", r.enrolled_at) + "}\n";
  return out;
}

std::string print_codes(const std::vector<CodeRow>& rows) {
  std::string out = text::registry_header("Hashes of one-time enrolment codes that were not used yet.");
  for (const CodeRow& r : rows)
    out += "code {\n" + row("sha256", to_hex(r.hash)) + row("workstation", r.workstation) +
           row("not_after_s", r.not_after) + "}\n";
  return out;
}

std::string print_servers(const std::vector<ServerRow>& rows) {
  std::string out = text::registry_header("Servers this workstation was enrolled at.");
  for (const ServerRow& r : rows) {
    out += "server {\n" + row("address", r.address) + row("spki_sha256", to_hex(r.spki)) + row("name", r.name);
    if (r.service) out += row("service_key", to_hex(r.service->key));
    if (r.service && r.service->previous_until > 0)
      out += row("service_key_before", to_hex(r.service->previous)) +
             row("service_key_before_until_s", r.service->previous_until);
    for (const std::string& member : r.members) out += row("member", member);
    out += "}\n";
  }
  return out;
}

std::string print_serving(const ServingSpec& serving) {
  std::string out = text::registry_header("Sessions of the running server.") + "address: \"" + serving.address + "\"\n";
  for (const OpenSession& s : serving.sessions) {
    out += "session {\n" + row("id", to_hex(s.id)) + (s.code.empty() ? std::string() : row("code", s.code)) +
           row("name", s.name) + row("epoch", s.epoch);
    if (!s.phase.empty()) out += row("phase", s.phase);
    for (const OpenSeat& seat : s.seats)
      out += "  seat { name: \"" + seat.name + "\" role: \"" + std::string(to_text(seat.role)) + "\"" +
             (seat.taken ? " taken: true" : "") + (seat.required ? " required: true" : "") + " }\n";
    out += "}\n";
  }
  return out;
}

}  // namespace tandem

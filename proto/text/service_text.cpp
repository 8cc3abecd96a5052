#include "proto/text/service_text.h"

#include <cstdint>

#include "common/base/hex.h"
#include "common/base/secret.h"
#include "proto/schema/registry.pb.h"
#include "proto/text/registry_reader.h"

namespace tandem {
namespace {

using text::MessageValidator;

constexpr std::size_t kStatementBytesMax = 256;

std::vector<std::byte> statement_from(const std::string& hex, MessageValidator& validator, const std::string& key) {
  std::vector<std::byte> out(hex.size() / 2);
  const bool good = !hex.empty() && out.size() <= kStatementBytesMax && text::from_lower_hex(hex, out);
  if (!good && validator.is_set(key))
    validator.error(key, "must be 2 to 512 lower-case hex digits, an even number of them");
  return out;
}

template <class File>
std::vector<std::vector<std::byte>> changes_in(const File& in, MessageValidator& validator) {
  std::vector<std::vector<std::byte>> out;
  for (int i = 0; i < in.key_change_size(); ++i)
    out.push_back(statement_from(in.key_change(i), validator, text::child_path("", "key_change", i)));
  return out;
}

}  // namespace

std::expected<MemberRow, InputErrors> parse_member(std::string_view text, std::string_view file) {
  MessageValidator validator(file);
  auto in = text::read_registry_file<pb::MemberFile>(text, validator);
  MemberRow out{in.name(), text::bytes_from<32>(in.service_key(), validator, "service_key"), in.ticket_key(),
                statement_from(in.voucher(), validator, "voucher"), changes_in(in, validator)};
  wipe(*in.mutable_ticket_key());
  return text::registry_verdict(std::move(out), validator);
}

std::expected<std::vector<std::vector<std::byte>>, InputErrors> parse_service(std::string_view text,
                                                                              std::string_view file) {
  MessageValidator validator(file);
  auto out = changes_in(text::read_registry_file<pb::ServiceFile>(text, validator), validator);
  return text::registry_verdict(std::move(out), validator);
}

std::expected<std::vector<VouchedRow>, InputErrors> parse_vouched(std::string_view text, std::string_view file) {
  MessageValidator validator(file);
  const auto in = text::read_registry_file<pb::VouchedFile>(text, validator);
  std::vector<VouchedRow> rows;
  for (int i = 0; i < in.server_size(); ++i) {
    const pb::VouchedServer& s = in.server(i);
    const std::string at = text::child_path(text::child_path("", "server", i), "spki_sha256");
    rows.push_back(
        {s.name(), text::bytes_from<32>(s.spki_sha256(), validator, at), static_cast<std::int64_t>(s.not_after_s())});
  }
  return text::registry_verdict(std::move(rows), validator);
}

std::string print_member(const MemberRow& member) {
  std::string out =
      text::registry_header("This server belongs to a service. Secret: holds the key that signs tickets.") +
      "name: \"" + member.name + "\"\nservice_key: \"" + to_hex(member.service_key) + "\"\nticket_key: \"" +
      member.ticket_key + "\"\nvoucher: \"" + to_hex(member.voucher) + "\"\n";
  for (const auto& change : member.key_changes) out += "key_change: \"" + to_hex(change) + "\"\n";
  return out;
}

std::string print_service(const std::vector<std::vector<std::byte>>& key_changes) {
  std::string out = text::registry_header("Changes of this service's key, oldest first.");
  for (const auto& change : key_changes) out += "key_change: \"" + to_hex(change) + "\"\n";
  return out;
}

std::string print_vouched(const std::vector<VouchedRow>& rows) {
  std::string out = text::registry_header("Vouchers of this service that have not expired.");
  for (const VouchedRow& row : rows)
    out += "server { name: \"" + row.name + "\" spki_sha256: \"" + to_hex(row.spki) +
           "\" not_after_s: " + std::to_string(row.not_after) + " }\n";
  return out;
}

}  // namespace tandem

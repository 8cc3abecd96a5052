#include "common/auth/io/service_membership.h"

#include "common/base/raw_bytes.h"
#include "proto/text/service_text.h"

namespace tandem::auth {

std::string renewal(const std::string& name, const KeyFingerprint& server) {
  return "where the service's folder is, run `tandem-server service vouch FOLDER --name " +
         (name.empty() ? "NAME" : name) + " --key " + server.hex() +
         " --out FILE`, and here `tandem-server service join FILE`";
}

std::expected<std::pair<ServiceMembership, TicketKey>, std::string> read_membership(std::span<const std::byte> text,
                                                                                    const std::string& file,
                                                                                    const KeyFingerprint& server) {
  auto row = parse_member(text_of(text), file);
  // The content is not shown: it holds a key, or it is another file, perhaps with a secret.
  if (!row)
    return std::unexpected(
        file + ": is no member file of a service, or a damaged one; make a new one: " + renewal({}, server));
  std::string line = row->ticket_key + "\n";
  auto ticket_key = TicketKey::from_text(bytes_of(line));
  wipe(line);
  wipe(row->ticket_key);
  if (!ticket_key) return std::unexpected(file + ": ticket_key " + ticket_key.error());
  const auto statement = rpc::decode_service_statement(row->voucher);
  const auto content = statement ? rpc::decode_voucher_content(statement->content) : std::nullopt;
  const auto voucher =
      check_voucher(row->voucher, ServicePin{row->service_key, {}, 0}, server, content ? content->not_before : 0);
  if (!voucher)
    return std::unexpected(file + ": " + to_text(voucher.error()) + ". This server's key is " + server.hex() + ": " +
                           renewal(row->name, server));
  if (voucher->name != row->name)
    return std::unexpected(file + ": name is " + row->name + ", and its voucher names " + voucher->name + ": " +
                           renewal(row->name, server));
  return std::pair{ServiceMembership{row->service_key, std::move(row->voucher), row->name, std::move(row->key_changes),
                                     voucher->not_before, voucher->not_after},
                   std::move(*ticket_key)};
}

bool is_older(const ServiceMembership& file, const ServiceMembership& present) {
  return file.service_key != present.service_key &&
         follow_key_changes({file.service_key, {}, 0}, present.key_changes).key == present.service_key;
}

std::string membership_problem(const ServiceMembership& membership, const KeyFingerprint& server, std::int64_t now) {
  const auto voucher = check_voucher(membership.voucher, ServicePin{membership.service_key, {}, 0}, server, now);
  if (voucher) return {};
  return to_text(voucher.error()) + ". Clients would reject this server: " + renewal(membership.name, server);
}

}  // namespace tandem::auth

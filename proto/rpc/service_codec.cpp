#include "proto/rpc/service_codec.h"

#include <algorithm>

#include "common/base/raw_bytes.h"
#include "proto/rpc/canonical_bytes.h"
#include "proto/rpc/rpc_bounds.h"
#include "proto/schema/service.pb.h"

namespace tandem::rpc {

std::vector<std::byte> encode(const VoucherContent& content) {
  pb::Voucher out;
  out.set_name(content.name);
  out.set_server(text_of(content.server));
  out.set_not_before(content.not_before);
  out.set_not_after(content.not_after);
  return serialized(out);
}

std::vector<std::byte> encode(const KeyChangeContent& content) {
  pb::KeyChange out;
  out.set_old_key(text_of(content.old_key));
  out.set_new_key(text_of(content.new_key));
  out.set_at(content.at);
  out.set_old_until(content.old_until);
  return serialized(out);
}

std::vector<std::byte> encode(const ServiceStatement& statement) {
  pb::ServiceStatement out;
  out.set_version(statement.version);
  out.set_kid(statement.kid);
  out.set_content(text_of(std::span(statement.content)));
  out.set_signature(text_of(statement.signature));
  return serialized(out);
}

std::vector<std::byte> encode(const MemberCredential& credential) {
  pb::MemberCredential out;
  out.set_service_key(text_of(credential.service_key));
  out.set_voucher(text_of(std::span(credential.voucher)));
  for (const auto& change : credential.key_changes) out.add_key_change(text_of(std::span(change)));
  return serialized(out);
}

std::optional<VoucherContent> decode_voucher_content(std::span<const std::byte> bytes) {
  pb::Voucher in;
  VoucherContent out;
  if (!parse(bytes, in, kStatementMax) || !take(in.server(), out.server)) return std::nullopt;
  out.name = in.name();
  out.not_before = in.not_before();
  out.not_after = in.not_after();
  return if_canonical(std::move(out), bytes);
}

std::optional<KeyChangeContent> decode_key_change_content(std::span<const std::byte> bytes) {
  pb::KeyChange in;
  KeyChangeContent out;
  if (!parse(bytes, in, kStatementMax) || !take(in.old_key(), out.old_key) || !take(in.new_key(), out.new_key))
    return std::nullopt;
  out.at = in.at();
  out.old_until = in.old_until();
  return if_canonical(out, bytes);
}

std::optional<ServiceStatement> decode_service_statement(std::span<const std::byte> bytes) {
  pb::ServiceStatement in;
  ServiceStatement out;
  if (!parse(bytes, in, kStatementMax) || !take(in.signature(), out.signature)) return std::nullopt;
  out.version = in.version();
  out.kid = in.kid();
  out.content = to_bytes(in.content());
  return if_canonical(std::move(out), bytes);
}

std::optional<MemberCredential> decode_member_credential(std::span<const std::byte> bytes) {
  pb::MemberCredential in;
  MemberCredential out;
  if (!parse(bytes, in, kCredentialMax) || !take(in.service_key(), out.service_key)) return std::nullopt;
  if (in.key_change_size() > static_cast<int>(kKeyChangesMax)) return std::nullopt;
  out.voucher = to_bytes(in.voucher());
  for (const std::string& change : in.key_change()) out.key_changes.push_back(to_bytes(change));
  return if_canonical(std::move(out), bytes);
}

}  // namespace tandem::rpc

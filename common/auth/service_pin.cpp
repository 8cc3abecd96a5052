#include "common/auth/service_pin.h"

#include <algorithm>

#include "common/auth/registry.h"
#include "common/base/format.h"
#include "common/base/raw_bytes.h"

namespace tandem::auth {
namespace {

constexpr std::uint32_t kStatementVersion = 1;
/// Domain separation: a signature under a label can only mean that statement. The zero ends the label.
constexpr std::string_view kVoucherLabel{"tandem voucher v1\0", 18};
constexpr std::string_view kKeyChangeLabel{"tandem key change v1\0", 21};

/// Returns the bytes that are signed: the label, then the content.
std::vector<std::byte> labelled(std::string_view label, std::span<const std::byte> content) {
  std::vector<std::byte> message(label.size() + content.size());
  std::ranges::copy(content, std::ranges::copy(bytes_of(label), message.begin()).out);
  return message;
}

std::vector<std::byte> signed_statement(std::string_view label, std::vector<std::byte> content, const TicketKey& key) {
  rpc::ServiceStatement out{
      .version = kStatementVersion, .kid = key.verifier().kid, .content = std::move(content), .signature = {}};
  out.signature = key.sign(labelled(label, out.content));
  return rpc::encode(out);
}

/// Returns the field that is out of range; empty: all are in range.
std::string wrong_voucher_field(const Voucher& v) {
  if (!is_valid_name(v.name)) return "name must be 1 to 32 characters of A-Z a-z 0-9 _ -";
  if (v.not_before < 0 || v.not_after < v.not_before || v.not_after - v.not_before > Voucher::kLifeMax)
    return "not_after must be at most 1200 days after not_before, and not before it";
  return {};
}
std::string wrong_change_field(const KeyChange& c) {
  if (c.old_key == c.new_key) return "new_key must differ from old_key";
  if (c.at < 0 || c.old_until < c.at || c.old_until - c.at > KeyChange::kGraceMax)
    return "old_until must be at most 400 days after `at`, and not before it";
  return {};
}

std::string days_or_less(std::int64_t s) {
  if (s < 2 * Voucher::kDay) return format("%lld h", static_cast<long long>(s / 3600));
  return format("%lld days", static_cast<long long>(s / Voucher::kDay));
}

/// Returns the change if it continues the pin.
std::optional<KeyChange> continuing(const ServicePin& pin, std::span<const std::byte> bytes) {
  const auto statement = rpc::decode_service_statement(bytes);
  if (!statement || statement->version != kStatementVersion) return std::nullopt;
  const auto content = rpc::decode_key_change_content(statement->content);
  if (!content || content->old_key != pin.key) return std::nullopt;
  const TicketVerifier key = TicketVerifier::of(pin.key);
  if (statement->kid != key.kid || !key.verifies(labelled(kKeyChangeLabel, statement->content), statement->signature))
    return std::nullopt;
  const KeyChange change{content->old_key, content->new_key, content->at, content->old_until};
  return wrong_change_field(change).empty() ? std::optional{change} : std::nullopt;
}

}  // namespace

std::expected<std::vector<std::byte>, std::string> sign_voucher(const Voucher& voucher, const TicketKey& service_key) {
  if (std::string wrong = wrong_voucher_field(voucher); !wrong.empty()) return std::unexpected(std::move(wrong));
  return signed_statement(
      kVoucherLabel,
      rpc::encode(rpc::VoucherContent{voucher.name, voucher.server.sha256, voucher.not_before, voucher.not_after}),
      service_key);
}

std::expected<std::vector<std::byte>, std::string> sign_key_change(const KeyChange& change, const TicketKey& old_key) {
  if (std::string wrong = wrong_change_field(change); !wrong.empty()) return std::unexpected(std::move(wrong));
  return signed_statement(
      kKeyChangeLabel, rpc::encode(rpc::KeyChangeContent{change.old_key, change.new_key, change.at, change.old_until}),
      old_key);
}

std::string to_text(const VoucherError& error) {
  const std::string whose = error.name.empty() ? "the server's voucher" : "the voucher of server " + error.name;
  constexpr const char* kNewVoucher = "its administrator renews it with `tandem-server service vouch` and `join`";
  switch (error.rule) {
    case VoucherCheck::kFormat:
      return whose + " is damaged or incomplete; " + kNewVoucher;
    case VoucherCheck::kVersion:
      return whose + " is of another version of Tandem; use the same release on both";
    case VoucherCheck::kService:
      return whose +
             " is signed with a key that this workstation does not know for its service: the server is of another "
             "service, or its service has rotated its key and this server has no member file of the new key yet. Use "
             "the address of another server of this service; after a rotation, its administrator runs `tandem-server "
             "service vouch` and `join` for this server; to use another service, enrol there";
    case VoucherCheck::kReplaced:
      return whose +
             " is signed with the key of before the last `tandem-server service rotate`, and the time for which that "
             "key stayed valid (--grace-days) is over. Use the address of another server of the service; " +
             kNewVoucher;
    case VoucherCheck::kSignature:
      return whose + " was changed after it was signed; " + kNewVoucher;
    case VoucherCheck::kContent:
      return whose + " has invalid contents; " + kNewVoucher;
    case VoucherCheck::kNotYet:
      return whose + " is valid only in " + days_or_less(error.seconds) + "; check the clocks of both computers";
    case VoucherCheck::kExpired:
      return whose + " expired " + days_or_less(error.seconds) + " ago; " + kNewVoucher +
             ". If that is not so, check this computer's clock";
    case VoucherCheck::kServer:
      return whose + " was issued for another key than this server has; " + kNewVoucher;
  }
  return "?";
}

std::expected<Voucher, VoucherError> check_voucher(std::span<const std::byte> bytes, const ServicePin& pin,
                                                   const KeyFingerprint& server, std::int64_t now) {
  const auto broken = [](VoucherCheck rule, std::int64_t seconds = 0, std::string name = {}) {
    return std::unexpected(VoucherError{rule, seconds, std::move(name)});
  };
  const auto statement = rpc::decode_service_statement(bytes);
  if (!statement) return broken(VoucherCheck::kFormat);
  if (statement->version != kStatementVersion) return broken(VoucherCheck::kVersion);
  TicketVerifier key = TicketVerifier::of(pin.key);
  if (statement->kid != key.kid && pin.previous_until > 0) {
    const TicketVerifier previous = TicketVerifier::of(pin.previous);
    if (statement->kid == previous.kid && now > pin.previous_until) return broken(VoucherCheck::kReplaced);
    key = previous;
  }
  if (statement->kid != key.kid) return broken(VoucherCheck::kService);
  if (!key.verifies(labelled(kVoucherLabel, statement->content), statement->signature))
    return broken(VoucherCheck::kSignature);

  const auto content = rpc::decode_voucher_content(statement->content);
  if (!content) return broken(VoucherCheck::kContent);
  Voucher v{content->name, KeyFingerprint{content->server}, content->not_before, content->not_after};
  if (!wrong_voucher_field(v).empty()) return broken(VoucherCheck::kContent);
  if (now < v.not_before) return broken(VoucherCheck::kNotYet, v.not_before - now, v.name);
  if (now > v.not_after) return broken(VoucherCheck::kExpired, now - v.not_after, v.name);
  if (v.server != server) return broken(VoucherCheck::kServer, 0, v.name);
  return v;
}

ServicePin follow_key_changes(ServicePin pin, std::span<const std::vector<std::byte>> changes) {
  for (const auto& bytes : changes.first(std::min(changes.size(), rpc::kKeyChangesMax)))
    if (const auto change = continuing(pin, bytes)) pin = {change->new_key, change->old_key, change->old_until};
  return pin;
}

std::expected<AcceptedMember, std::string> accept_member(std::span<const std::byte> credential, const ServicePin& pin,
                                                         const KeyFingerprint& server, std::int64_t now) {
  const auto shown = rpc::decode_member_credential(credential);
  if (!shown) return std::unexpected(to_text(VoucherError{}));
  const ServicePin newest = follow_key_changes(pin, shown->key_changes);
  auto voucher = check_voucher(shown->voucher, newest, server, now);
  if (!voucher) return std::unexpected(to_text(voucher.error()));
  return AcceptedMember{std::move(*voucher), newest};
}

std::expected<AcceptedMember, std::string> accept_sent_member(std::span<const std::byte> statement,
                                                              const ServicePin& pin, const KeyFingerprint& server,
                                                              std::int64_t now) {
  if (rpc::decode_member_credential(statement)) return accept_member(statement, pin, server, now);
  auto voucher = check_voucher(statement, pin, server, now);
  if (!voucher) return std::unexpected(to_text(voucher.error()));
  return AcceptedMember{std::move(*voucher), pin};
}

bool same_service(const ServicePin& a, const ServicePin& b) noexcept {
  const auto continues = [](const ServicePin& newer, const ServicePin& older) {
    return newer.key == older.key || (newer.previous_until > 0 && newer.previous == older.key);
  };
  return continues(a, b) || continues(b, a);
}

std::expected<ServicePin, std::string> first_pin(std::span<const std::byte> credential, const KeyFingerprint& server,
                                                 std::int64_t now) {
  const auto shown = rpc::decode_member_credential(credential);
  if (!shown) return std::unexpected(to_text(VoucherError{}));
  const ServicePin pin{shown->service_key, {}, 0};
  if (const auto voucher = check_voucher(shown->voucher, pin, server, now); !voucher)
    return std::unexpected(to_text(voucher.error()));
  // The other servers may have vouchers of the key before.
  for (const auto& change : shown->key_changes) {
    const auto statement = rpc::decode_service_statement(change);
    const auto content = statement ? rpc::decode_key_change_content(statement->content) : std::nullopt;
    if (!content || content->new_key != pin.key) continue;
    const ServicePin followed = follow_key_changes({content->old_key, {}, 0}, std::span(&change, 1));
    if (followed.key == pin.key) return followed;
  }
  return pin;
}

}  // namespace tandem::auth

#include "common/auth/ticket.h"

#include <algorithm>

#include "common/auth/base32.h"
#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "proto/rpc/ticket_codec.h"

namespace tandem::auth {
namespace {

/// Domain separation: a signature under this key can only mean a ticket. The zero ends the label.
constexpr std::string_view kDomain{"tandem ticket v2\0", 17};
constexpr std::string_view kTicketPrefix = "ticket:";
static_assert(sizeof(Signature) == sizeof(rpc::SignedTicket::signature));

/// Whether the bytes have the length and the first byte of format 1, the fixed layout before Protocol Buffers.
bool is_format_1(std::span<const std::byte> bytes) noexcept { return bytes.size() == 192 && bytes[0] == std::byte{1}; }

/// Returns the bytes that are signed: the label, then the content.
std::vector<std::byte> message_to_sign(std::span<const std::byte> content) {
  std::vector<std::byte> message(kDomain.size() + content.size());
  std::ranges::copy(content, std::ranges::copy(bytes_of(kDomain), message.begin()).out);
  return message;
}

bool legal_name(std::string_view name) noexcept {
  return name.size() <= Ticket::kNameMax && std::ranges::all_of(name, [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

/// Returns the field that is out of range; empty: all are in range.
std::string wrong_field(const Ticket& t) {
  if (static_cast<std::uint8_t>(t.role) >= kAccessRoles) return "role must be one of the six";
  if (t.force_scale < 1 || t.force_scale > Ticket::kFullForce) return "force_scale must be in [1, 1000] thousandths";
  if (!legal_name(t.seat)) return "seat must be at most 32 characters of A-Z a-z 0-9 _ -";
  if (!legal_name(t.person)) return "person must be at most 32 characters of A-Z a-z 0-9 _ -";
  if (t.not_before < 0 || t.not_after < t.not_before || t.not_after - t.not_before > Ticket::kLifeMax)
    return "not_after must be at most 12 h after not_before, and not before it";
  return {};
}

/// Returns the content of a ticket, or the field that is out of range.
std::expected<Ticket, std::string> read(const rpc::TicketContent& in) {
  if (in.role >= kAccessRoles || in.force_scale > Ticket::kFullForce)
    return std::unexpected("role or force_scale is out of range");
  Ticket t{.ticket_id = in.ticket_id,
           .session_id = in.session_id,
           .seat = in.seat,
           .role = static_cast<AccessRole>(in.role),
           .workstation = {in.workstation},
           .force_scale = static_cast<std::uint16_t>(in.force_scale),
           .not_before = in.not_before,
           .not_after = in.not_after,
           .epoch_min = in.epoch_min,
           .person = in.person};
  if (std::string wrong = wrong_field(t); !wrong.empty()) return std::unexpected(std::move(wrong));
  return t;
}

/// Returns the content that a ticket claims, without a check of its signature.
std::optional<rpc::TicketContent> claimed_content(std::span<const std::byte> bytes) {
  const auto ticket = rpc::decode_signed_ticket(bytes);
  return ticket ? rpc::decode_ticket_content(ticket->content) : std::nullopt;
}

constexpr std::int64_t kHour = 3600, kDay = 24 * kHour;  // [s]
/// [s] before its validity, from which on a ticket shows that a clock is wrong.
constexpr std::int64_t kClockDoubt = 300;

/// Returns "2 s", "5 min", "3 h" or "4 days", rounded down.
std::string span_text(std::int64_t s) {
  if (s < 120) return format("%lld s", static_cast<long long>(s));
  if (s < 2 * kHour) return format("%lld min", static_cast<long long>(s / 60));
  if (s < 2 * kDay) return format("%lld h", static_cast<long long>(s / kHour));
  return format("%lld days", static_cast<long long>(s / kDay));
}

struct Words {
  std::string_view name, text;
};
/// In the order of TicketCheck.
constexpr std::array<Words, kTicketChecks> kWords{{
    {"format", "this is no ticket: its bytes are incomplete or damaged; copy it again, whole"},
    {"version",
     "the ticket is of another version of Tandem, this server reads version 2; ask for a new one, which `tandem-server "
     "ticket` of this release makes"},
    {"key", "the ticket was made by another server, or before this server got new keys; ask for a new one"},
    {"signature", "the ticket was changed after it was made; ask for a new one"},
    {"content", "the ticket has invalid contents; ask for a new one"},
    {"not_yet", "the ticket is not valid yet"},
    {"expired", "the ticket has expired; ask for a new one"},
    {"workstation",
     "the ticket was made for another workstation; use it there, or ask for one for this machine. If this machine "
     "has several folders of keys, name the right one with --state"},
    {"enrolment",
     "the ticket was made before this workstation was enrolled again: its revocation has voided all tickets of before; "
     "ask for a new one"},
    {"session", "the ticket was made for another session; ask for one for this session"},
    {"epoch", "the ticket is for a later run of this session"},
    {"seat", "the ticket is for another seat"},
    {"role", "the ticket gives another role than this seat has"},
    {"used", "the ticket has been used already: each is valid for one join; ask for a new one"},
    {"book_full", "the server's list of used tickets is full; try again when the oldest have expired, within 12 h"},
}};

}  // namespace

std::expected<TicketBytes, std::string> sign_ticket(const Ticket& ticket, const TicketKey& key) {
  if (std::string wrong = wrong_field(ticket); !wrong.empty()) return std::unexpected(std::move(wrong));
  rpc::SignedTicket out{.version = Ticket::kVersion,
                        .kid = key.verifier().kid,
                        .content = rpc::encode(rpc::TicketContent{.role = static_cast<std::uint32_t>(ticket.role),
                                                                  .force_scale = ticket.force_scale,
                                                                  .ticket_id = ticket.ticket_id,
                                                                  .session_id = ticket.session_id,
                                                                  .workstation = ticket.workstation.sha256,
                                                                  .seat = ticket.seat,
                                                                  .not_before = ticket.not_before,
                                                                  .not_after = ticket.not_after,
                                                                  .epoch_min = ticket.epoch_min,
                                                                  .person = ticket.person})};
  out.signature = key.sign(message_to_sign(out.content));
  return rpc::encode(out);
}

std::string ticket_text(std::span<const std::byte> ticket) { return std::string(kTicketPrefix) + to_base32(ticket); }

std::expected<TicketBytes, std::string> ticket_from_text(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";  // around a ticket that was copied from an indented line
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  text.remove_suffix(text.size() - (text.find_last_not_of(kBlank) + 1));
  if (!text.starts_with(kTicketPrefix))
    return std::unexpected("a ticket begins with `ticket:`, as tandem-server ticket prints it");
  auto bytes = from_base32(text.substr(kTicketPrefix.size()));
  if (!bytes) return std::unexpected("a character of the ticket is wrong or missing; copy it again, whole");
  if (is_format_1(*bytes))
    return std::unexpected(
        "the ticket was made by an older version of Tandem, format 1, this version reads format 2; ask for a new one, "
        "which `tandem-server ticket` of the same release makes");
  if (!claimed_content(*bytes))
    return std::unexpected(
        format("the %zu bytes of the ticket are incomplete or damaged; copy it again, whole", bytes->size()));
  return std::move(*bytes);
}

std::string_view name_of(TicketCheck rule) noexcept {
  const auto i = static_cast<std::size_t>(rule);
  return i < kTicketChecks ? kWords[i].name : "?";
}

std::optional<Id16> claimed_session(std::span<const std::byte> bytes) {
  const auto content = claimed_content(bytes);
  return content ? std::optional{content->session_id} : std::nullopt;
}

std::optional<KeyFingerprint> claimed_workstation(std::span<const std::byte> bytes) {
  const auto content = claimed_content(bytes);
  return content ? std::optional{KeyFingerprint{content->workstation}} : std::nullopt;
}

std::optional<AccessRole> claimed_role(std::span<const std::byte> bytes) {
  const auto content = claimed_content(bytes);
  return content && content->role < kAccessRoles ? std::optional{static_cast<AccessRole>(content->role)} : std::nullopt;
}

std::string to_text(const TicketError& fault) {
  const auto i = static_cast<std::size_t>(fault.rule);
  if (i >= kTicketChecks) return "?";
  switch (fault.rule) {
    case TicketCheck::kExpired:
      if (fault.seconds < kDay) return "the ticket expired " + span_text(fault.seconds) + " ago; ask for a new one";
      return "by the clock of this server, the ticket expired " + span_text(fault.seconds) +
             " ago; ask for a new one. If the ticket is newer than that, the clock of this server is wrong: ask its "
             "administrator to set it, then use the same ticket again";
    case TicketCheck::kNotYet:
      if (fault.seconds < kClockDoubt) return "the ticket is valid only in " + span_text(fault.seconds) + "; wait";
      return "by the clock of this server, the ticket is valid only in " + span_text(fault.seconds) +
             ": the clock of this server is wrong, or that of the server that made the ticket. Ask their "
             "administrator to set it, then use the same ticket again";
    case TicketCheck::kContent:
      return std::string(kWords[i].text) + " (" + fault.detail + ")";
    case TicketCheck::kSeat:
    case TicketCheck::kRole:
      return std::string(kWords[i].text) + ": " + (fault.detail.empty() ? "none" : fault.detail);
    default:
      return std::string(kWords[i].text);
  }
}

std::expected<Ticket, TicketError> check_ticket(std::span<const std::byte> bytes, const TicketVerifier& key,
                                                const TicketUse& use) {
  const auto broken = [](TicketCheck rule, std::int64_t seconds = 0, std::string detail = {}) {
    return std::unexpected(TicketError{rule, seconds, std::move(detail)});
  };
  if (is_format_1(bytes)) return broken(TicketCheck::kVersion);
  const auto ticket = rpc::decode_signed_ticket(bytes);
  if (!ticket) return broken(TicketCheck::kFormat);
  if (ticket->version != Ticket::kVersion) return broken(TicketCheck::kVersion);
  if (ticket->kid != key.kid) return broken(TicketCheck::kKey);
  if (!key.verifies(message_to_sign(ticket->content), ticket->signature)) return broken(TicketCheck::kSignature);

  const auto content = rpc::decode_ticket_content(ticket->content);
  if (!content) return broken(TicketCheck::kContent, 0, "not the encoding of a ticket");
  auto read_ticket = read(*content);
  if (!read_ticket) return broken(TicketCheck::kContent, 0, std::move(read_ticket.error()));
  const Ticket& t = *read_ticket;
  if (use.now < t.not_before) return broken(TicketCheck::kNotYet, t.not_before - use.now);
  if (use.now > t.not_after) return broken(TicketCheck::kExpired, use.now - t.not_after);
  if (t.workstation != use.workstation) return broken(TicketCheck::kWorkstation);
  if (t.not_before < use.enrolled_at) return broken(TicketCheck::kEnrolment);
  if (t.session_id != use.session_id) return broken(TicketCheck::kSession);
  if (use.epoch < t.epoch_min) return broken(TicketCheck::kEpoch);
  if (t.seat != use.seat) return broken(TicketCheck::kSeat, 0, t.seat);
  if (use.role && t.role != *use.role) return broken(TicketCheck::kRole, 0, std::string(to_text(t.role)));
  return t;
}

}  // namespace tandem::auth

#include "common/auth/ticket.h"

#include <algorithm>

#include "common/auth/base32.h"
#include "common/base/format.h"
#include "common/base/raw_bytes.h"

namespace tandem::auth {
namespace {

constexpr std::size_t kSigned = 128;
constexpr std::size_t kVersionAt = 0, kRoleAt = 1, kForceAt = 2, kKidAt = 4, kTicketAt = 8, kSessionAt = 24,
                      kWorkstationAt = 40, kSeatAt = 72, kNotBeforeAt = 104, kNotAfterAt = 112, kEpochAt = 120;
static_assert(kSeatAt + Ticket::kSeatMax == kNotBeforeAt && kEpochAt + 8 == kSigned &&
              kSigned + sizeof(Signature) == kTicketSize);
/// Domain separation: a signature under this key can only mean a ticket. The zero ends the label.
constexpr std::string_view kDomain{"tandem ticket v1\0", 17};
constexpr std::string_view kTicketPrefix = "ticket:";

template <class T>
void put(std::span<std::byte> out, std::size_t at, T value) noexcept {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    out[at + i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
}
template <class T>
T get(std::span<const std::byte> in, std::size_t at) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::to_integer<std::uint64_t>(in[at + i]) << (8 * i);
  return static_cast<T>(value);
}

bool legal_seat(std::string_view seat) noexcept {
  return seat.size() <= Ticket::kSeatMax && std::ranges::all_of(seat, [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

/// Returns whether a role may hold a ticket without a seat. An instructor may also observe from a console.
bool needs_no_seat(AccessRole role) noexcept {
  return role == AccessRole::kInstructor || role == AccessRole::kOperator || role == AccessRole::kRecorder;
}

/// Returns the field that is out of range; empty: all are in range.
std::string wrong_field(const Ticket& t) {
  if (static_cast<std::uint8_t>(t.role) >= kAccessRoles) return "role must be one of the six";
  if (t.force_scale < 1 || t.force_scale > Ticket::kFullForce) return "force_scale must be in [1, 1000] thousandths";
  if (!legal_seat(t.seat)) return "seat must be at most 32 characters of A-Z a-z 0-9 _ -";
  if (t.seat.empty() && !needs_no_seat(t.role)) return "seat is missing: this role needs a seat";
  if (t.not_before < 0 || t.not_after < t.not_before || t.not_after - t.not_before > Ticket::kLifeMax)
    return "not_after must be at most 12 h after not_before, and not before it";
  return {};
}

Ticket read(std::span<const std::byte> in) {
  Ticket t;
  t.role = static_cast<AccessRole>(get<std::uint8_t>(in, kRoleAt));
  t.force_scale = get<std::uint16_t>(in, kForceAt);
  const auto take = [&](std::size_t at, auto& out) {
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(at), out.size(), out.begin());
  };
  take(kTicketAt, t.ticket_id);
  take(kSessionAt, t.session_id);
  take(kWorkstationAt, t.workstation.sha256);
  const std::string_view seat = text_of(in.subspan(kSeatAt, Ticket::kSeatMax));
  t.seat = seat.substr(0, seat.find('\0'));
  t.not_before = get<std::int64_t>(in, kNotBeforeAt);
  t.not_after = get<std::int64_t>(in, kNotAfterAt);
  t.epoch_min = get<std::uint64_t>(in, kEpochAt);
  return t;
}

/// Returns "2 s", "5 min" or "3 h", rounded down.
std::string span_text(std::int64_t s) {
  if (s < 120) return format("%lld s", static_cast<long long>(s));
  if (s < 7200) return format("%lld min", static_cast<long long>(s / 60));
  return format("%lld h", static_cast<long long>(s / 3600));
}

struct Words {
  std::string_view name, text;
};
/// In the order of TicketCheck.
constexpr std::array<Words, kTicketChecks> kWords{{
    {"length", "this is no ticket: it has the wrong length; copy it again, whole"},
    {"version", "the ticket is of another version of Tandem; ask for a new one"},
    {"key", "the ticket was made by another server, or before this server got new keys; ask for a new one"},
    {"signature", "the ticket was changed after it was made; ask for a new one"},
    {"content", "the ticket has invalid contents; ask for a new one"},
    {"not_yet", "the ticket is not valid yet"},
    {"expired", "the ticket has expired; ask for a new one"},
    {"workstation", "the ticket was made for another workstation; use it there, or ask for one for this machine"},
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
  TicketBytes out{};
  put(out, kVersionAt, Ticket::kVersion);
  put(out, kRoleAt, static_cast<std::uint8_t>(ticket.role));
  put(out, kForceAt, ticket.force_scale);
  put(out, kKidAt, key.verifier().kid);
  const auto give = [&](std::size_t at, const auto& in) {
    std::ranges::copy(in, out.begin() + static_cast<std::ptrdiff_t>(at));
  };
  give(kTicketAt, ticket.ticket_id);
  give(kSessionAt, ticket.session_id);
  give(kWorkstationAt, ticket.workstation.sha256);
  give(kSeatAt, bytes_of(ticket.seat));
  put(out, kNotBeforeAt, ticket.not_before);
  put(out, kNotAfterAt, ticket.not_after);
  put(out, kEpochAt, ticket.epoch_min);
  std::array<std::byte, kDomain.size() + kSigned> message;
  std::ranges::copy(bytes_of(kDomain), message.begin());
  std::copy_n(out.begin(), kSigned, message.begin() + kDomain.size());
  std::ranges::copy(key.sign(message), out.begin() + kSigned);
  return out;
}

std::string ticket_text(const TicketBytes& ticket) { return std::string(kTicketPrefix) + to_base32(ticket); }

std::expected<TicketBytes, std::string> ticket_from_text(std::string_view text) {
  if (!text.starts_with(kTicketPrefix))
    return std::unexpected("a ticket begins with `ticket:`, as tandem-server ticket prints it");
  const auto bytes = from_base32(text.substr(kTicketPrefix.size()));
  if (!bytes) return std::unexpected("a character of the ticket is wrong or missing; copy it again, whole");
  if (bytes->size() != kTicketSize)
    return std::unexpected(format("the ticket has %zu of %zu bytes; copy it again, whole", bytes->size(), kTicketSize));
  TicketBytes out;
  std::ranges::copy(*bytes, out.begin());
  return out;
}

std::string_view name_of(TicketCheck rule) noexcept {
  const auto i = static_cast<std::size_t>(rule);
  return i < kTicketChecks ? kWords[i].name : "?";
}

Id16 claimed_session(const TicketBytes& ticket) noexcept {
  Id16 id;
  std::copy_n(ticket.begin() + 24, id.size(), id.begin());
  return id;
}

std::optional<AccessRole> claimed_role(std::span<const std::byte> bytes) noexcept {
  const auto role = bytes.size() == kTicketSize ? std::to_integer<std::uint8_t>(bytes[1]) : kAccessRoles;
  return role < kAccessRoles ? std::optional(static_cast<AccessRole>(role)) : std::nullopt;
}

std::string to_text(const TicketError& fault) {
  const auto i = static_cast<std::size_t>(fault.rule);
  if (i >= kTicketChecks) return "?";
  switch (fault.rule) {
    case TicketCheck::kExpired:
      return "the ticket expired " + span_text(fault.seconds) + " ago; ask for a new one";
    case TicketCheck::kNotYet:
      return "the ticket is valid only in " + span_text(fault.seconds) + "; wait, and check the server's clock";
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
  if (bytes.size() != kTicketSize) return broken(TicketCheck::kLength);
  if (get<std::uint8_t>(bytes, kVersionAt) != Ticket::kVersion) return broken(TicketCheck::kVersion);
  if (get<std::uint32_t>(bytes, kKidAt) != key.kid) return broken(TicketCheck::kKey);
  std::array<std::byte, kDomain.size() + kSigned> message;
  std::ranges::copy(bytes_of(kDomain), message.begin());
  std::copy_n(bytes.begin(), kSigned, message.begin() + kDomain.size());
  Signature signature;
  std::copy_n(bytes.begin() + kSigned, signature.size(), signature.begin());
  if (!key.verifies(message, signature)) return broken(TicketCheck::kSignature);

  Ticket t = read(bytes);
  if (std::string wrong = wrong_field(t); !wrong.empty()) return broken(TicketCheck::kContent, 0, std::move(wrong));
  const auto rest = bytes.subspan(kSeatAt + t.seat.size(), Ticket::kSeatMax - t.seat.size());
  if (!std::ranges::all_of(rest, [](std::byte b) { return b == std::byte{0}; }))
    return broken(TicketCheck::kContent, 0, "bytes after the seat's name");
  if (use.now < t.not_before) return broken(TicketCheck::kNotYet, t.not_before - use.now);
  if (use.now > t.not_after) return broken(TicketCheck::kExpired, use.now - t.not_after);
  if (t.workstation != use.workstation) return broken(TicketCheck::kWorkstation);
  if (t.session_id != use.session_id) return broken(TicketCheck::kSession);
  if (use.epoch < t.epoch_min) return broken(TicketCheck::kEpoch);
  if (t.seat != use.seat) return broken(TicketCheck::kSeat, 0, t.seat);
  if (use.role && t.role != *use.role) return broken(TicketCheck::kRole, 0, std::string(to_text(t.role)));
  return t;
}

}  // namespace tandem::auth

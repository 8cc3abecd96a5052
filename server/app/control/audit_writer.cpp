#include "server/app/control/audit_writer.h"

#include <netinet/in.h>

#include <asio/post.hpp>
#include <cstring>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "common/io/socket_address.h"

namespace tandem::server {

std::string by_person(const std::string& name) { return name.empty() ? name : "; by " + name; }

namespace {

/// Source of a line for the throttle: the workstation if known, otherwise the IPv4 address or the IPv6 /64 network.
std::string source_of(const ControlEventRecord& news) {
  if (!news.workstation.empty()) return "workstation " + news.workstation;
  const auto address = io::parse_address(news.address, 0);
  if (!address || address->family() != AF_INET6) return news.address.substr(0, news.address.rfind(':'));
  sockaddr_in6 v6;
  std::memcpy(&v6, address->get(), sizeof v6);
  const auto& b = v6.sin6_addr.s6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&v6.sin6_addr)) return format("%u.%u.%u.%u", b[12], b[13], b[14], b[15]);
  return format("%x:%x:%x:%x::/64", b[0] << 8 | b[1], b[2] << 8 | b[3], b[4] << 8 | b[5], b[6] << 8 | b[7]);
}

}  // namespace

bool AuditWriter::record(const ControlEventRecord& news) {
  if (!trust_.on_disk()) return true;  // no log: all clients are on this computer
  switch (news.event) {
    case ControlEvent::kForbidden:
      if (news.detail.empty()) return true;  // only counted
      [[fallthrough]];
    case ControlEvent::kRefused:
    case ControlEvent::kNotEnrolled:
    case ControlEvent::kCodeRefused:
    case ControlEvent::kBlocked:
      if (!throttle_.admit(source_of(news), io::monotonic_now())) return false;
      [[fallthrough]];
    case ControlEvent::kWelcomed:
      trust_.audit(auth::wall_seconds(), to_text(news.event), news.workstation,
                   news.address + " " + news.detail + by_person(news.person));
      return true;
    // Events that decide about no workstation are only counted; the keystore logs enrolments itself.
    default:
      return true;
  }
}

void AuditWriter::service() {
  const std::int64_t now = auth::wall_seconds();
  if (const auto left = throttle_.summary(io::monotonic_now())) {
    trust_.audit(now, "suppressed", "", *left);
    if (on_message_) on_message_("audit log: " + *left);
    io::log_event(io::Level::kWarn, {.event = "suppressed", .text = *left});
  }
  trust_.retry_audit(now);
  const auth::AuditLog& log = trust_.audit_log();
  const std::uint64_t all_lost = log.lost(), lost = all_lost - std::exchange(lost_reported_, all_lost);
  const std::string error = log.error();  // read after the number: its lines failed with this error, or it is over
  const bool fails = !error.empty();
  if (fails != std::exchange(fails_, fails)) {
    if (fails && on_event_)
      on_event_({ControlEvent::kTrouble, "", "", "the audit log fails, and /readyz is 503 until it works: " + error});
    const std::string again = "the audit log is written again; lines lost so far: " + std::to_string(all_lost);
    if (!fails && on_message_) on_message_(again);
    // It failed and recovered since the last call.
    if (!fails) io::log_event(io::Level::kWarn, {.event = "audit_recovered", .text = again});
  } else if (!fails && lost > 0 && on_event_) {
    on_event_({ControlEvent::kTrouble, "", "", "the audit log lost lines: " + std::to_string(lost)});
  }
}

void AuditWriter::close() {
  if (const auto left = throttle_.last_summary()) trust_.audit(auth::wall_seconds(), "suppressed", "", *left);
  trust_.retry_audit(auth::wall_seconds());
}

void AuditWriter::post(std::string_view event, std::string session, std::string detail,
                       std::function<std::string()> author) {
  if (!trust_.on_disk()) return;
  asio::post(
      context_, [this, event, session = std::move(session), detail = std::move(detail), author = std::move(author)] {
        trust_.audit(auth::wall_seconds(), event, session, detail + by_person(author ? author() : std::string{}));
      });
}

AuditState AuditWriter::state() const {
  const auth::AuditLog& log = trust_.audit_log();
  return {log.error(), log.lost(), throttle_.suppressed()};
}

}  // namespace tandem::server

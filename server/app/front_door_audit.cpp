#include <asio/post.hpp>
#include <netinet/in.h>

#include <cstring>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "server/app/front_door.h"

/// What the door writes to the audit log: all of the people it knows, and of strangers no more than fits.
namespace tandem::server {
namespace {

/// The source of a line, for its throttle: the workstation if it is known, else the IPv4 address or the IPv6 network (/64) it came from.
std::string source_of(const ControlNews& news) {
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

bool FrontDoor::note(const ControlNews& news) {
  if (!trust_.on_disk()) return true;  // no log; whoever comes is on this computer
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
      trust_.audit(trust::wall_seconds(), to_text(news.event), news.workstation, news.address + " " + news.detail);
      return true;
    default:  // what is no decision about a person is only counted; enrolments note themselves
      return true;
  }
}

void FrontDoor::look_after_audit() {
  const std::int64_t now = trust::wall_seconds();
  if (const auto left = throttle_.summary(io::monotonic_now())) {
    trust_.audit(now, "left_out", "", *left);
    if (say_) say_("audit log: " + *left);
    io::tell(io::Level::kWarn, {.event = "left_out", .text = *left});
  }
  trust_.retry_audit(now);
  const trust::AuditLog& log = trust_.audit_log();
  const bool fails = !log.trouble().empty();
  const std::uint64_t lost = log.lost() - std::exchange(lost_told_, log.lost());
  if (fails != std::exchange(audit_fails_, fails)) {
    if (fails && tell_) tell_({ControlEvent::kTrouble, "", "", "the audit log fails, and /readyz is 503 until it works: " + log.trouble()});
    const std::string again = "the audit log is written again; lines lost so far: " + std::to_string(log.lost());
    if (!fails && say_) say_(again);
    if (!fails) io::tell(io::Level::kWarn, {.event = "audit_works", .text = again});
  } else if (!fails && lost > 0 && tell_) {  // it failed and worked again since the last look
    tell_({ControlEvent::kTrouble, "", "", "the audit log lost lines: " + std::to_string(lost)});
  }
}

void FrontDoor::end_audit() {
  if (const auto left = throttle_.last_summary()) trust_.audit(trust::wall_seconds(), "left_out", "", *left);
  trust_.retry_audit(trust::wall_seconds());
}

void FrontDoor::audit(std::string_view event, std::string session, std::string detail) {
  if (!trust_.on_disk()) return;
  asio::post(thread_.context(), [this, event, session = std::move(session), detail = std::move(detail)] {
    trust_.audit(trust::wall_seconds(), event, session, detail);
  });
}

}  // namespace tandem::server

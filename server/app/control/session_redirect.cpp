#include "server/app/control/session_redirect.h"

#include <algorithm>
#include <utility>

#include "proto/rpc/rpc_texts.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;

/// In `after` of a SessionListRequest: the rest is a place in the list of other servers' sessions.
constexpr std::uint32_t kOthersBegin = 0x8000'0000U;
constexpr std::size_t kChoicesNamed = 8;  // in the text of a rejection
constexpr std::uint32_t kAskAgainS = 1;

std::string bounded_text(std::string text) {
  if (text.size() > rpc::kTextMax) text.resize(rpc::kTextMax);
  return text;
}

/// The first names, and the number of the others.
std::string some_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kChoicesNamed); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kChoicesNamed) text += " and " + std::to_string(names.size() - kChoicesNamed) + " more";
  return text;
}

bool says_coming(const SessionLocator::Found& found) {
  return std::holds_alternative<SessionLocator::Here>(found) || std::holds_alternative<SessionLocator::Coming>(found);
}

rpc::Elsewhere elsewhere_of(const ServerLocation& at, const rpc::SessionChoice& choice) {
  const auto* const id = std::get_if<rpc::Id>(&choice);
  return {.address = at.address,
          .key = at.key,
          .voucher = at.voucher,
          .session = at.session,
          .id = id == nullptr ? std::nullopt : std::optional(*id),
          .revision = at.revision};
}

}  // namespace

ErrorReply being_taken_over() {
  return {ErrorCode::kNotNow, "a server of this service is about to serve the session; try again in a moment",
          kAskAgainS};
}

std::optional<SessionRedirect::Reply> SessionRedirect::find(const rpc::SessionChoice& choice, bool understands) {
  if (locator_ == nullptr) return std::nullopt;
  if (std::holds_alternative<std::monostate>(choice)) return only_session(understands);
  if (is_served_here(choice)) return std::nullopt;
  return located(choice, understands);
}

bool SessionRedirect::is_served_here(const rpc::SessionChoice& choice) {
  const auto chosen = registry_.choose(choice);
  const auto* const here = std::get_if<SessionEntry*>(&chosen);
  return here != nullptr && !(*here)->given_up;
}

bool SessionRedirect::is_coming(const rpc::SessionChoice& choice) {
  if (locator_ == nullptr || std::holds_alternative<std::monostate>(choice) || is_served_here(choice)) return false;
  return says_coming(locator_->locate(choice));
}

/// A client that names no session gets the only one of the whole service.
std::optional<SessionRedirect::Reply> SessionRedirect::only_session(bool understands) {
  const auto away = others();
  if (away.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const SessionEntry& e : registry_.entries())
    if (e.open()) names.push_back(e.registration.name);
  if (names.empty() && away.size() == 1) return located(away.front().session.id, understands);
  for (const auto& other : away) names.push_back(other.session.name);
  return ErrorReply{
      ErrorCode::kNoSession,
      bounded_text("this service has several sessions: " + some_of(names) + "; choose one with --session"), 0};
}

ErrorReply SessionRedirect::refusal(const rpc::SessionChoice& choice, const ErrorReply& own) const {
  if (locator_ == nullptr || (own.code != ErrorCode::kNoSession && own.code != ErrorCode::kCode)) return own;
  std::vector<std::string> names;
  for (const SessionEntry& e : registry_.entries())
    if (e.open()) names.push_back(e.registration.name);
  const bool none_here = names.empty(), any = std::holds_alternative<std::monostate>(choice);
  for (const auto& other : others()) names.push_back(other.session.name);
  if (!locator_->fresh() && none_here)
    return {ErrorCode::kInternal,
            "this server serves no session, and does not reach the directory of its service, so it knows none of other "
            "servers; try again in some seconds, or use the address of another server",
            kAskAgainS};
  if (names.empty()) return {ErrorCode::kNoSession, "no session is open in this service", 0};
  if (any) return own;  // several sessions of this server
  const std::string open = "; sessions of the service: " + some_of(names);
  if (std::holds_alternative<std::string>(choice))
    return {
        ErrorCode::kCode,
        bounded_text("no session of this service has this code (a restarted session has a new code: ask its operator)" +
                     open),
        0};
  return {ErrorCode::kNoSession, bounded_text("this service has no such session" + open), 0};
}

std::optional<SessionRedirect::Reply> SessionRedirect::located(const rpc::SessionChoice& choice, bool understands) {
  const SessionLocator::Found found = locator_->locate(choice);
  if (std::holds_alternative<SessionLocator::None>(found)) return std::nullopt;
  if (says_coming(found)) return being_taken_over();
  if (const auto* const unknown = std::get_if<SessionLocator::Unknown>(&found))
    return ErrorReply{ErrorCode::kInternal,
                      bounded_text("this server cannot tell which server of the service has the session: " +
                                   unknown->why + "; try again, or use the address of another server"),
                      kAskAgainS};
  const auto& at = std::get<ServerLocation>(found);
  if (understands) return elsewhere_of(at, choice);
  return ErrorReply{ErrorCode::kNoSession,
                    bounded_text("session " + at.session + " is at another server of this service, " + at.address +
                                 ", to which a client of this version does not follow; install a client of this "
                                 "server's release, or enrol there and use --server " +
                                 at.address),
                    0};
}

ErrorReply SessionRedirect::draining() const {
  constexpr std::uint32_t kDrainAgainS = 10;
  return {ErrorCode::kDraining,
          locator_ == nullptr
              ? "this server is draining and rejects new joins; wait until it has restarted, or ask its operator"
              : "this server is draining and rejects new joins. Its sessions move to other servers of the service, if "
                "one has room; try again in some seconds, or ask the operator",
          locator_ == nullptr ? kDrainAgainS : kAskAgainS};
}

std::vector<SessionLocator::Elsewhere> SessionRedirect::others() const {
  auto all = locator_->elsewhere();
  // A session that has just moved here may still stand in the copy of the directory. One that was handed over stays
  // here for a moment after its end.
  std::erase_if(all, [&](const auto& other) {
    const SessionEntry* const here = std::as_const(registry_).find(other.session.id);
    return here != nullptr && (here->open() || !here->given_up);
  });
  std::ranges::sort(all, {}, [](const auto& other) -> const std::string& { return other.session.name; });
  return all;
}

rpc::SessionList SessionRedirect::list(const rpc::SessionListRequest& request) const {
  const bool here = request.after < kOthersBegin;
  rpc::SessionList page = here ? registry_.list(request.after) : rpc::SessionList{};
  if (!request.service || locator_ == nullptr) return page;
  for (rpc::ListedSession& session : page.sessions) session.server = name_;
  page.old = !locator_->fresh();
  if (page.more) return page;
  const auto away = others();
  for (std::size_t i = here ? 0 : request.after - kOthersBegin; i < away.size(); ++i) {
    if (page.sessions.size() == rpc::kListedSessionsMax) {
      page.more = true;
      page.last = kOthersBegin + static_cast<std::uint32_t>(i);
      break;
    }
    page.sessions.push_back(away[i].session);
    page.sessions.back().server = away[i].server;
  }
  return page;
}

std::vector<std::string> SessionRedirect::members() const {
  if (locator_ == nullptr) return {};
  auto all = locator_->members();
  std::erase_if(all, [](const std::string& address) { return !rpc::is_address(address); });
  if (all.size() > rpc::kMembersMax) all.resize(rpc::kMembersMax);
  return all;
}

}  // namespace tandem::server

#include "client/app/join_hello.h"

#include <algorithm>
#include <optional>
#include <string>

#include "client/seat/device_facts.h"
#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
#include "common/transport/secure_channel.h"
#include "proto/rpc/session_pages.h"

namespace tandem::client {
namespace {

std::expected<rpc::ListedSession, JoinError> find_session(ServerConnection& server, const auth::Id16& id, bool is_id,
                                                          const std::optional<std::string>& code) {
  const JoinOptions& options = server.options();
  const auto list = rpc::all_sessions([&](const rpc::Body& page) { return server.request<rpc::SessionList>(page); },
                                      server.service().has_value());
  if (!list) return std::unexpected(list.error());
  std::string names;
  const rpc::ListedSession* found = nullptr;
  for (const rpc::ListedSession& s : list->sessions) {
    names += (names.empty() ? "" : ", ") + s.name;
    const bool only = (code || options.session.empty()) && list->sessions.size() == 1;
    if (s.name == options.session || (is_id ? s.id == id : only)) found = &s;
  }
  if (found != nullptr) return *found;
  const std::string at = io::to_text(server.address());
  if (list->sessions.empty() && list->old)
    return join_failure("no session is known at " + at +
                        ": this server of the service serves none, and does not reach the directory of the service; "
                        "try again in some seconds, or use the address of another server of the service");
  if (list->sessions.empty() && server.service())
    return join_failure("no session is open in the service of " + at +
                        "; ask its operator for one, or create one: `tandem-client control create`");
  if (list->sessions.empty()) return join_failure("no session is open at " + at + "; start " + server.start_command());
  return join_failure(options.session.empty()
                          ? "several sessions are open there: " + names + "; say which with --session"
                          : "--session " + options.session + ": no such session there; open: " + names +
                                (list->old ? ". Newer sessions of other servers are not known: that server does not "
                                             "reach the directory of its service"
                                           : ""));
}

/// Signs a ticket with the server's ticket key, which only the server's own user on the same computer can read.
std::expected<rpc::Credential, JoinError> issue_local_ticket(const rpc::ListedSession& session,
                                                             const auth::LocalKeys& keys, const JoinOptions& options) {
  const auto seat = std::ranges::find(session.seats, options.seat, &rpc::ListedSeat::name);
  if (seat == session.seats.end() && !options.console) {
    std::string names;
    for (const rpc::ListedSeat& s : session.seats) names += " " + s.name;
    return join_failure("--seat " + options.seat + ": no seat of this name; seats:" + names);
  }
  const std::int64_t now = auth::wall_seconds();
  auth::Ticket ticket{.session_id = session.id,
                      .seat = options.seat,
                      .role = options.console ? *options.console : seat->role,
                      .workstation = keys.workstation.fingerprint(),
                      .not_before = now - 1,
                      .not_after = now + 59};
  auth::fill_random(ticket.ticket_id);
  const auto bytes = auth::sign_ticket(ticket, keys.ticket_key);
  if (!bytes) return join_failure("a ticket cannot be made: " + bytes.error());
  return rpc::TicketCredential{{bytes->begin(), bytes->end()}};
}

}  // namespace

rpc::Hello base_hello(const JoinOptions& options) {
  rpc::Hello hello;
  hello.seat = options.seat;
  hello.link_test = options.seat.empty() && !options.console;
  hello.watch = options.watch;
  if (!options.console) hello.device = device_facts(options.caps);
  hello.has_aes = transport::fastest_cipher() == transport::Cipher::kAes256Gcm;
  const auto cid = auth::random_bytes<std::array<std::byte, 4>>();
  for (std::size_t i = 0; i < 4; ++i) hello.client_cid |= std::to_integer<std::uint32_t>(cid[i]) << (8 * i);
  hello.client_cid |= 1;
  return hello;
}

std::expected<rpc::Hello, JoinError> make_hello(ServerConnection& server) {
  const JoinOptions& options = server.options();
  rpc::Hello hello = base_hello(options);
  if (options.back) {
    hello.session = options.back->session;
    hello.credential = rpc::ResumeCredential{options.back->secret};
    return hello;
  }
  const auto code = auth::canonical_session_code(options.session);
  auth::Id16 id;
  const bool is_id = auth::from_hex(options.session, id), by_name = !options.session.empty() && !is_id && !code;
  if (is_id) hello.session = id;
  if (!is_id && code) hello.session = *code;
  if (!options.ticket.empty()) {
    const auto ticket = auth::ticket_from_text(options.ticket);
    if (!ticket) return join_failure("--ticket: " + ticket.error());
    hello.credential = rpc::TicketCredential{{ticket->begin(), ticket->end()}};
    if (options.session.empty()) {
      hello.session = auth::claimed_session(*ticket).value_or(auth::Id16{});
    } else if (by_name) {  // the server checks that the ticket is for this session
      const auto found = find_session(server, id, is_id, code);
      if (!found) return std::unexpected(found.error());
      hello.session = found->id;
    }
    return hello;
  }
  if (by_name || (server.local() && !hello.link_test)) {
    const auto found = find_session(server, id, is_id, code);
    if (!found) return std::unexpected(found.error());
    hello.session = found->id;
    if (server.local() && !hello.link_test) {
      auto own = issue_local_ticket(*found, *server.local(), options);
      if (!own) return std::unexpected(own.error());
      hello.credential = std::move(*own);
      return hello;
    }
  }
  if (code && !hello.link_test) hello.credential = rpc::CodeCredential{*code};
  return hello;
}

}  // namespace tandem::client

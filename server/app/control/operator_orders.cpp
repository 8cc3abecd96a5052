// Orders of operators about whole sessions.
#include <algorithm>

#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/io/log.h"
#include "server/app/control/session_commands.h"
#include "server/policy/roles.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;

constexpr std::int64_t kTicketLifeS = std::int64_t{4} * 3600;  // as `tandem-server ticket` without --hours
constexpr std::int64_t kTicketLifeMaxS = std::int64_t{12} * 3600;

std::string with_reason(const std::string& text, const std::string& why) {
  return why.empty() ? text : text + ": " + why;
}

}  // namespace

std::optional<ErrorReply> SessionCommands::holder_problem(const rpc::CreateSession& wanted) {
  if (wanted.holders.empty()) return std::nullopt;
  const auto workstations = audit_.registry().workstations();
  if (!workstations) {
    report_failure({}, workstations.error());
    return ErrorReply{ErrorCode::kInternal,
                      "the server cannot read its registry of workstations; its log has the cause", 0};
  }
  for (const rpc::SeatHolder& holder : wanted.holders) {
    const std::string whose = !holder.seat.empty()     ? "seat " + holder.seat
                              : !holder.person.empty() ? holder.person
                                                       : "console at " + holder.workstation;
    if (auth::find_workstation(*workstations, holder.workstation) == nullptr)
      return ErrorReply{ErrorCode::kNotEnrolled,
                        whose + ": no workstation " + holder.workstation +
                            " is enrolled here; enrol it with `tandem-server enroll " + holder.workstation +
                            " --address HOST:PORT`",
                        0};
    if (holder.seat.empty() && (holder.role == AccessRole::kOperator || !may_join_console(holder.role)))
      return ErrorReply{ErrorCode::kNotAllowed,
                        whose + ": no ticket for a console has the role " + std::string(to_text(holder.role)) +
                            " here; an operator's is made on the server's computer, by `tandem-server ticket`",
                        0};
  }
  return std::nullopt;
}

void SessionCommands::order(rpc::Body command, const std::string& who, const std::function<void(rpc::Body)>& answer) {
  if (orders_ == nullptr)
    return answer(ErrorReply{ErrorCode::kNotAllowed, "this server creates and ends no sessions on request", 0});
  SessionOrder order{.who = who};
  std::function<void()> announce = [] {};  // once the order is accepted
  if (std::holds_alternative<rpc::SceneListRequest>(command)) {
    order.body = rpc::SceneListRequest{};
    order.answer = answer;
  } else if (auto* const create = std::get_if<rpc::CreateSession>(&command)) {
    if (registry_.drain().active())
      return answer(ErrorReply{ErrorCode::kDraining, "this server is draining and creates no sessions", 10});
    if (auto refused = holder_problem(*create)) return answer(std::move(*refused));
    order.body = std::move(*create);
    const rpc::CreateSession& wanted = std::get<rpc::CreateSession>(order.body);
    rpc::CreateSession kept{.name = wanted.name,
                            .scene = wanted.scene,
                            .tickets_only = wanted.tickets_only,
                            .life_s = wanted.life_s,
                            .holders = wanted.holders};
    order.answer = [this, kept = std::move(kept), who, answer](rpc::Body reply) {
      if (auto* const created = std::get_if<rpc::SessionCreated>(&reply)) complete(*created, kept, who);
      answer(std::move(reply));
    };
  } else if (const auto* const record = std::get_if<rpc::RecordSession>(&command)) {
    order.body = *record;
    order.answer = [this, wanted = *record, who, answer](rpc::Body reply) {
      if (std::holds_alternative<rpc::Ok>(reply)) conclude_recording(wanted, who);
      answer(std::move(reply));
    };
  } else {
    order.body = std::move(std::get<rpc::EndSession>(command));
    const rpc::EndSession& end = std::get<rpc::EndSession>(order.body);
    std::string name;
    if (SessionEntry* const entry = registry_.find(end.session_id)) {
      name = entry->registration.name;
      announce = [entry, text = truncate_utf8(with_reason("the session is ENDED by " + who, end.why), rpc::kTextMax)] {
        entry->notices.add(text);
      };
    }
    order.answer = [this, name, detail = with_reason(who, end.why), answer](rpc::Body reply) {
      if (std::holds_alternative<rpc::Ok>(reply)) {
        io::log_event(io::Level::kInfo, {.event = "session_ended", .session = name, .text = detail});
        audit_.audit(auth::wall_seconds(), "end", name, detail);
      }
      answer(std::move(reply));
    };
  }
  if (orders_->post(std::move(order))) return announce();
  answer(ErrorReply{ErrorCode::kNotNow,
                    format("%zu orders about sessions wait already; repeat it when they are done", SessionOrders::kMax),
                    1});
}

void SessionCommands::conclude_recording(const rpc::RecordSession& order, const std::string& who) {
  SessionEntry* const entry = registry_.find(order.session_id);
  if (entry == nullptr) return;
  const std::string& session = entry->registration.name;
  const std::string text = std::string("the recording of the session ") + (order.on ? "STARTS" : "ENDS");
  entry->notices.add(text + "; ordered by " + who);
  io::log_event(io::Level::kInfo,
                {.event = order.on ? "recording_started" : "recording_ended", .session = session, .text = who});
  audit_.audit(auth::wall_seconds(), order.on ? "record" : "record_end", session, who);
  if (on_message_) on_message_(text + ", ordered by " + who);
}

void SessionCommands::complete(rpc::SessionCreated& created, const rpc::CreateSession& wanted, const std::string& who) {
  const SessionEntry* const entry = std::as_const(registry_).find(created.session.id);
  const std::int64_t now = auth::wall_seconds();
  std::string detail = who + ": scene " + (wanted.scene.empty() ? "given as text" : wanted.scene) +
                       format(", %zu seats", created.session.seats.size());
  if (wanted.life_s > 0) detail += format(", ends after %u s", wanted.life_s);
  io::log_event(io::Level::kInfo, {.event = "session_created", .session = wanted.name, .text = detail});
  audit_.audit(now, "create", wanted.name, detail);
  const auto workstations = audit_.registry().workstations();
  if (entry == nullptr || !workstations) return;  // over already, or the registry fails: the reply has no tickets
  const std::int64_t life = wanted.life_s > 0 ? std::min<std::int64_t>(wanted.life_s, kTicketLifeMaxS) : kTicketLifeS;
  for (const rpc::SeatHolder& holder : wanted.holders) {
    const WorkstationRow* const workstation = auth::find_workstation(*workstations, holder.workstation);
    const auto seat = std::ranges::find(created.session.seats, holder.seat, &rpc::ListedSeat::name);
    if (workstation == nullptr || (!holder.seat.empty() && seat == created.session.seats.end())) continue;
    const AccessRole role = holder.seat.empty() ? holder.role : seat->role;
    const auth::Ticket ticket{.ticket_id = auth::random_bytes<auth::Id16>(),
                              .session_id = created.session.id,
                              .seat = holder.seat,
                              .role = role,
                              .workstation = {workstation->spki},
                              .force_scale = auth::Ticket::kFullForce,
                              .not_before = std::max(now, workstation->enrolled_at),  // by another server's clock
                              .not_after = now + life,
                              .epoch_min = entry->registration.epoch,
                              .person = holder.person};
    const auto bytes = auth::sign_ticket(ticket, audit_.ticket_key());
    if (!bytes) continue;  // impossible for checked names
    created.tickets.push_back({holder.seat, holder.workstation, {bytes->begin(), bytes->end()}, holder.person, role});
    audit_.audit(now, "ticket", holder.workstation,
                 auth::to_hex(ticket.ticket_id) + " " + ticket.seat + " " + std::string(to_text(ticket.role)) +
                     (ticket.person.empty() ? "" : " for " + ticket.person) + "; by " + who);
  }
}

}  // namespace tandem::server

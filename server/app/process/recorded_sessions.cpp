// Recordings of the sessions of a server: started with them or by orders, reported, completed.
#include <algorithm>
#include <utility>

#include "server/app/process/session_table.h"

namespace tandem::server {

using rpc::ErrorCode;
using rpc::ErrorReply;

void SessionTable::start_recording(SessionInstance& session) {
  const RecordingOptions& wanted = session.options().record;
  if (wanted.target.empty() || !wanted.from_start) return;
  const std::string problem = session.start_recording();
  if (problem.empty()) return report_recordings(session);
  report(session, session.live_session().status(),
         {"recording_failed", "", "the session is NOT RECORDED: " + problem, true});
}

std::string SessionTable::no_recording(const SessionInstance& session) const {
  if (!session.options().record.target.empty()) return {};
  return std::string("this server has no place for recordings; ") +
         (options_.command == std::string("serve")
              ? "write a key `record` in its configuration and restart it"
              : "a server that is started by `tandem-server run SCENE --record FOLDER` has one");
}

rpc::Body SessionTable::record_session(const rpc::RecordSession& wanted) {
  const auto found =
      std::ranges::find_if(sessions_, [&](const auto& session) { return session->id() == wanted.session_id; });
  if (found == sessions_.end()) return ErrorReply{ErrorCode::kNoSession, "this server has no such session", 0};
  SessionInstance& session = **found;
  if (wanted.on == (session.recording() != nullptr))
    return ErrorReply{ErrorCode::kOutdated,
                      wanted.on ? "the session is recorded already" : "no recording of this session runs", 0};
  if (!wanted.on) {
    session.end_recording();
    return rpc::Ok{};
  }
  if (std::string why = no_recording(session); !why.empty())
    return ErrorReply{ErrorCode::kNotAllowed, std::move(why), 0};
  if (const std::string problem = session.start_recording(); !problem.empty())
    return ErrorReply{ErrorCode::kInternal, "no recording was started: " + problem, 0};
  report_recordings(session);
  return rpc::Ok{};
}

void SessionTable::report_recordings(SessionInstance& session) {
  for (LiveRecording::Message& message : session.service_recordings())
    report(session, session.live_session().status(), {message.event, "", std::move(message.text), message.warning});
}

void SessionTable::service_recordings() {
  for (const auto& session : sessions_) report_recordings(*session);
  for (auto* const sessions : {&closing_, &finished_})
    for (const auto& session : *sessions) report_recordings(*session);
  std::erase_if(closing_, [](const auto& session) { return !session->recordings_busy(); });
}

bool SessionTable::recordings_busy() const noexcept {
  return !closing_.empty() || std::ranges::any_of(finished_, [](const auto& s) { return s->recordings_busy(); });
}

}  // namespace tandem::server

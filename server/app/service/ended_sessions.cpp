#include "server/app/service/ended_sessions.h"

#include <utility>

namespace tandem::server {

void EndedSessions::add(const std::string& session, const rpc::Id& id, std::vector<SessionOrder> orders, Time now) {
  for (SessionOrder& order : orders) waiting_.push_back({session, id, now + kConfirmedMax, std::move(order)});
}

void EndedSessions::step(Time now, ServiceThread& service, SessionTable& sessions) {
  std::erase_if(waiting_, [&](const Ended& ended) {
    const bool erased = service.quietly([&](const ServiceMember& member, Time) {
      if (member.ends(ended.session)) return false;
      const auto& entries = member.directory().catalogue.entries();
      const auto found = entries.find(ended.session);
      return found == entries.end() || !found->second.spec || found->second.spec->id != ended.id;
    });
    if (!erased && now < ended.until) return false;
    rpc::Body reply = rpc::Ok{};
    if (!erased)
      reply = rpc::ErrorReply{rpc::ErrorCode::kNotNow,
                              "session " + ended.session +
                                  " is over at this server, but the directory of the service does not confirm it, and "
                                  "another server may begin it again. Look at `sessions` in some seconds",
                              5};
    sessions.reply(ended.order, std::move(reply));
    return true;
  });
}

}  // namespace tandem::server

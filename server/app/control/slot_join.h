#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <variant>

#include "common/base/format.h"
#include "server/app/control/join_handler.h"
#include "server/app/control/join_replies.h"
#include "server/app/control/session_redirect.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {

/// Reply to a request for a session that ends on this server.
[[nodiscard]] inline rpc::ErrorReply session_ends(const SessionEntry& entry) {
  if (entry.given_up) return being_taken_over();
  return {rpc::ErrorCode::kSessionOver, "the session is ending", 0};
}

inline constexpr std::uint32_t kSlotRetryS = 3;  ///< a silent peer's slot is free by then

/// Reserves a slot for a peer without a seat, and replies with what `admit` makes of its place in connection ids.
template <class Slots>
void reserve_slot(SessionRegistry& registry, SessionEntry& entry, Slots& slots, ShardRequest::Peers peers,
                  const char* what, std::function<JoinReply(std::uint8_t place)> admit,
                  std::function<void(JoinReply)> answer) {
  const rpc::ErrorReply full{
      rpc::ErrorCode::kFull,
      format("all %zu %s of this session are taken; try again in %u s", Slots::kMax, what, kSlotRetryS), kSlotRetryS};
  if (!slots.begin_join()) return answer(full);
  ShardRequest query{.what = ShardRequest::What::kQueryPeers, .peers = peers};
  query.done = [&entry, &slots, full, admit = std::move(admit), answer = std::move(answer)](ShardRequest& asked) {
    JoinReply reply = full;
    if (asked.result == JoinResult::kBusy) {
      reply = shard_busy();
    } else if (asked.result != JoinResult::kAccepted) {
      reply = session_ends(entry);
    } else if (slots.enough(asked.place)) {
      reply = admit(slots.next_place());
    }
    if (std::holds_alternative<rpc::ErrorReply>(reply)) slots.cancel_join();
    answer(std::move(reply));
  };
  registry.post(entry, std::move(query));
}

}  // namespace tandem::server

#pragma once

#include <cstddef>
#include <utility>

#include "proto/rpc/rpc_messages.h"

namespace tandem::rpc {

/// Requests that `all_sessions` makes at most. Sessions that are opened meanwhile follow the known ones, so a server
/// that is full needs one page more than its sessions take.
inline constexpr std::size_t kSessionPagesMax = (kSessionsMax + kListedSessionsMax - 1) / kListedSessionsMax + 1;

/// Requests the whole list of sessions, page by page.
/// @param ask  takes a SessionListRequest, returns `std::expected<SessionList, E>` or `std::optional<SessionList>`
/// @return the list with the sessions of all pages; `more` only if the server still announced another page. Otherwise
///         what `ask` returned without a list
template <class Ask>
[[nodiscard]] auto all_sessions(Ask ask) {
  auto whole = ask(SessionListRequest{});
  for (std::size_t pages = 1; whole && whole->more && whole->last != 0 && pages < kSessionPagesMax; ++pages) {
    auto page = ask(SessionListRequest{whole->last});
    if (!page) return page;
    whole->more = page->more;
    whole->last = page->last;
    for (ListedSession& session : page->sessions) whole->sessions.push_back(std::move(session));
  }
  return whole;
}

}  // namespace tandem::rpc

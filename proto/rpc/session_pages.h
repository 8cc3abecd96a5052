#pragma once

#include <cstddef>
#include <utility>

#include "proto/rpc/rpc_messages.h"

namespace tandem::rpc {

/// Requests that `all_sessions` makes at most. Sessions that are opened meanwhile follow the known ones, so a server
/// that is full needs one page more than its sessions take. A service may have more sessions; a server answers 20
/// requests at once.
inline constexpr std::size_t kSessionPagesMax = (kSessionsMax + kListedSessionsMax - 1) / kListedSessionsMax + 1,
                             kServicePagesMax = 18;

/// Requests the whole list of sessions, page by page.
/// @param ask  takes a SessionListRequest, returns `std::expected<SessionList, E>` or `std::optional<SessionList>`
/// @param service  the sessions of the whole service; only for a server that shows a credential of a service
/// @return the list with the sessions of all pages; `more` only if the server still announced another page. Otherwise
///         what `ask` returned without a list
template <class Ask>
[[nodiscard]] auto all_sessions(Ask ask, bool service = false) {
  const std::size_t pages_max = service ? kServicePagesMax : kSessionPagesMax;
  auto whole = ask(SessionListRequest{0, service});
  for (std::size_t pages = 1; whole && whole->more && whole->last != 0 && pages < pages_max; ++pages) {
    auto page = ask(SessionListRequest{whole->last, service});
    if (!page) return page;
    whole->more = page->more;
    whole->last = page->last;
    whole->old = whole->old || page->old;
    for (ListedSession& session : page->sessions) whole->sessions.push_back(std::move(session));
  }
  return whole;
}

}  // namespace tandem::rpc

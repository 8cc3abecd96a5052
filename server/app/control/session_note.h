#pragma once

#include <cstdint>
#include <string>

#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// A mark or sheet that a participant wrote, with its author and time.
struct SessionNote {
  rpc::Id session_id{};
  std::string session, workstation, seat;  ///< names; seat empty: a console
  AccessRole role = AccessRole::kObserver;
  std::uint32_t tick = 0;
  double time_s = 0;  ///< session clock [s]
  rpc::NoteKind kind = rpc::NoteKind::kMark;
  std::string json;
};

}  // namespace tandem::server

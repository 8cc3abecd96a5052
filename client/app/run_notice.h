#pragma once

#include <utility>

#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Decides when a client says that the session runs: at its begin, and after a break that the client has named. Breaks
/// that are too short for a status of the server, such as a held tool, are not named, so their ends are not either.
class RunNotice {
 public:
  /// The client has named a break.
  void on_break() noexcept { due_ = true; }
  /// To be called when the state has changed.
  /// @param reported  the server's status reports the end of the break
  /// @return true if the client is to say that the session runs
  [[nodiscard]] bool update(wire::SessionState now, bool reported) noexcept {
    return now == wire::SessionState::kRunning && std::exchange(due_, false) && !reported;
  }

 private:
  bool due_ = true;
};

}  // namespace tandem::client

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "client/app/authority_script.h"
#include "common/base/axes.h"
#include "common/base/time.h"
#include "common/control/authority.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Decides when the authority changes of a script are requested, on the servo thread. Each is requested ahead of its
/// time, because the server announces a transfer 50 ticks before it begins. A rejected request is repeated. A script
/// states the authority over session time: of several due changes only the newest is requested, as after a late join.
class AuthorityScriptPlayer {
 public:
  /// @param changes  ascending in time  @param tick_hz  rate of the session [Hz]
  AuthorityScriptPlayer(std::vector<AuthorityScript::Change> changes, double tick_hz) noexcept
      : changes_(std::move(changes)), lead_(wire::kTransferNoticeTicks / tick_hz) {}

  /// Returns the authority to request now; null: none.
  /// @param silence   time since the server last acknowledged a datagram. The script pauses after 200 ms of it.
  /// @param transfer  notice in the newest FORCE  @param time  session time as the server counts it [s]
  [[nodiscard]] const control::MasterArray* due(Time now, Duration silence, wire::TransferNotice transfer,
                                                const std::optional<double>& time) noexcept TANDEM_REALTIME;
  /// The user requested other authority: a rejection does not belong to the script any more.
  void cancel_retry() noexcept { requested_.reset(); }

 private:
  std::vector<AuthorityScript::Change> changes_;
  double lead_;           ///< [s]
  std::size_t next_ = 0;  ///< index of the first change that is not yet due
  std::optional<Time> requested_;
};

}  // namespace tandem::client

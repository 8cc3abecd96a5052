#pragma once

#include <cstdint>

#include "client/app/client_status.h"
#include "common/base/axes.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Keeps the notice of an authority transfer for the user. The server announces a transfer for only 50 ticks, less than
/// the refresh interval of the screen. The notice is therefore kept for 1000 ticks and as long as the authority
/// changes.
class TransferTracker {
 public:
  /// @param tick_hz  rate of the session [Hz]
  explicit TransferTracker(double tick_hz) noexcept : tick_hz_(tick_hz) {}

  /// Takes the newest FORCE; called once per tick.
  void update(const wire::ForceMessage& force) noexcept TANDEM_REALTIME;
  [[nodiscard]] const TransferStatus& status() const noexcept { return status_; }

 private:
  double tick_hz_;
  TransferStatus status_;
  std::uint64_t tick_ = 0;
  wire::TransferNotice notice_ = wire::TransferNotice::kNone;  ///< in FORCE at the previous tick
  std::uint32_t version_ = 0;
  double alpha_ = 0;                         ///< own authority at the previous tick
  std::uint64_t announced_ = 0, begin_ = 0;  ///< ticks of the last notice and of its begin
  std::uint64_t last_change_ = 0;            ///< tick of the last change of the own authority
};

}  // namespace tandem::client

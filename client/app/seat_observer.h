#pragma once

#include <string>
#include <vector>

#include "client/app/client_status.h"

namespace tandem::client {

/// Observer of a running seat. The SeatSupervisor calls it on the main thread.
class SeatObserver {
 public:
  virtual ~SeatObserver() = default;
  /// Called after the join. @param setup  valid as long as the seat
  virtual void on_joined(const SeatSetup& setup) = 0;
  virtual void on_key(const std::string& key) = 0;
  /// Returns lines for the user that are due. @param now_s  monotonic time [s]
  [[nodiscard]] virtual std::vector<std::string> messages(double now_s, const ClientStatus& status) = 0;
  /// Returns why the client should leave the seat; empty if it should stay.
  [[nodiscard]] virtual std::string leave_reason() = 0;
};

}  // namespace tandem::client

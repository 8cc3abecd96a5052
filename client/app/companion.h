#pragma once

#include <string>
#include <vector>

#include "client/app/client_status.h"

namespace tandem::client {

/// Something that accompanies a seat while it is attended, on the person's thread.
class Companion {
 public:
  virtual ~Companion() = default;
  /// The seat is taken; `setup` lives as long as the seat.
  virtual void begin(const SeatSetup& setup) = 0;
  virtual void pressed(const std::string& key) = 0;
  /// Lines for the person. @param now_s  monotonic [s]
  [[nodiscard]] virtual std::vector<std::string> say(double now_s, const ClientStatus& status) = 0;
  /// Why the seat should be left; empty: it should not.
  [[nodiscard]] virtual std::string why_leave() = 0;
};

}  // namespace tandem::client

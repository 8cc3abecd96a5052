#pragma once

#include <cstddef>
#include <memory>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Player of a recorded delay. The recording repeats after its end.
class DelayTracePlayer {
 public:
  explicit DelayTracePlayer(std::shared_ptr<const DelayTrace> trace) noexcept : trace_(std::move(trace)) {}

  [[nodiscard]] bool present() const noexcept { return trace_ != nullptr; }

  /// Returns the step in force at `t`. Requires `present()`.
  /// @param t  Time{} or later, any order
  [[nodiscard]] DelayTrace::Step at(Time t) noexcept;

 private:
  std::shared_ptr<const DelayTrace> trace_;
  std::size_t here_ = 0;
};

}  // namespace tandem::netsim

#pragma once

#include <cstddef>
#include <memory>

#include "common/base/time.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// Plays a recorded delay: the step in force at a time, from the start again after the recording's end.
class TracePlayer {
 public:
  explicit TracePlayer(std::shared_ptr<const DelayTrace> trace) noexcept : trace_(std::move(trace)) {}

  [[nodiscard]] bool present() const noexcept { return trace_ != nullptr; }

  /// Valid while `present()`. @param t [Time{} or later], any order
  [[nodiscard]] DelayTrace::Step at(Time t) noexcept;

 private:
  std::shared_ptr<const DelayTrace> trace_;
  std::size_t here_ = 0;
};

}  // namespace tandem::netsim

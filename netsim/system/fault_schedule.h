#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "netsim/system/fault.h"

namespace tandem::netsim {

/// Faults of one seat, or of the server, over network time.
class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<Fault> faults = {}) : faults_(std::move(faults)) {}

  [[nodiscard]] bool empty() const noexcept { return faults_.empty(); }
  /// Returns whether a fault of this kind acts at `now`, in [at, at + length).
  [[nodiscard]] bool active(Fault::Kind kind, Time now) const noexcept {
    return std::ranges::any_of(faults_, [&](const Fault& f) {
      return f.kind == kind && now >= Time{} + f.at && now < Time{} + f.at + f.length;
    });
  }
  /// Returns whether a fault of this kind ends within (before, now].
  [[nodiscard]] bool ended(Fault::Kind kind, Time before, Time now) const noexcept {
    return std::ranges::any_of(faults_, [&](const Fault& f) {
      return f.kind == kind && now >= Time{} + f.at + f.length && before < Time{} + f.at + f.length;
    });
  }
  /// Returns whether the schedule has a fault of this kind at any time.
  [[nodiscard]] bool contains(Fault::Kind kind) const noexcept {
    return std::ranges::any_of(faults_, [&](const Fault& f) { return f.kind == kind; });
  }

 private:
  std::vector<Fault> faults_;
};

}  // namespace tandem::netsim

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Fingerprints of the workstations that were removed from a session. The session's code does not admit them again; a
/// ticket does. At most kRemovedWorkstationsMax are stored; then every workstation counts as removed.
class RemovedWorkstations {
 public:
  using Key = std::array<std::byte, 32>;
  /// @param on_change  receives the full list after each addition; empty: the list is not stored
  explicit RemovedWorkstations(std::vector<Key> keys = {}, std::function<void(const std::vector<Key>&)> on_change = {})
      : keys_(std::move(keys)), on_change_(std::move(on_change)) {}

  [[nodiscard]] bool contains(const Key& workstation) const noexcept {
    return keys_.size() >= kRemovedWorkstationsMax || std::ranges::find(keys_, workstation) != keys_.end();
  }
  void add(const Key& workstation) {
    if (contains(workstation)) return;
    keys_.push_back(workstation);
    if (on_change_) on_change_(keys_);
  }

 private:
  std::vector<Key> keys_;
  std::function<void(const std::vector<Key>&)> on_change_;
};

}  // namespace tandem::server

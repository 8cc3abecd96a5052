#pragma once

#include <cstdint>
#include <vector>

#include "common/base/axes.h"

namespace tandem::netsim {

/// Record of the indices seen among the last 65 536. Real-time safe.
class SeenNumbers {
 public:
  /// Relation of an index to those seen before.
  enum class Kind : std::uint8_t { kNewest, kReordered, kAgain };
  SeenNumbers() : words_(kNumbers / 64) {}
  /// Records a number and returns its kind. Numbers older than the record count as reordered.
  Kind insert(std::uint64_t number) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }

 private:
  static constexpr std::uint64_t kNumbers = 65'536;
  std::vector<std::uint64_t> words_;
  std::uint64_t newest_ = 0;
  bool any_ = false;
};

}  // namespace tandem::netsim

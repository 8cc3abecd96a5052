#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::server {

/// Broken invariants of a run. `expected`: the chosen law or flow source mode never promised it, so it fails nothing.
struct Violation {
  std::string invariant;
  std::string seat;      ///< seat or tool, empty: the whole session
  double at_s = 0;       ///< first time [s]
  bool expected = false;
  std::uint64_t count = 1;
};

class Violations {
 public:
  /// Allocates: a breach is the end of quiet, not the normal tick.
  void note(std::string_view invariant, std::string_view seat, double at_s, bool expected) {
    expected = expected || std::ranges::any_of(excused_, [&](const Excuse& e) { return e.invariant == invariant && e.seat == seat; });
    const auto same = std::ranges::find_if(list_, [&](const Violation& v) { return v.invariant == invariant && v.seat == seat; });
    if (same != list_.end()) {
      ++same->count;
      return;
    }
    list_.push_back({std::string(invariant), std::string(seat), at_s, expected, 1});
  }
  /// From now on a breach of `invariant` at `seat` is expected: somebody was made to break it.
  void excuse(std::string_view invariant, std::string_view seat) { excused_.push_back({std::string(invariant), std::string(seat)}); }
  [[nodiscard]] const std::vector<Violation>& list() const noexcept { return list_; }
  [[nodiscard]] bool passed() const noexcept {
    return std::ranges::all_of(list_, [](const Violation& v) { return v.expected; });
  }

 private:
  struct Excuse {
    std::string invariant, seat;
  };
  std::vector<Violation> list_;
  std::vector<Excuse> excused_;
};

}  // namespace tandem::server

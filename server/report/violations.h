#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::server {

/// A violated invariant of a run. `expected`: the selected law or flow source mode does not guarantee it, so the run
/// does not fail.
struct Violation {
  std::string invariant;
  std::string seat;  ///< seat or tool, empty: the whole session
  double at_s = 0;   ///< time of the first violation [s]
  bool expected = false;
  std::uint64_t count = 1;
};

class Violations {
 public:
  /// Adds a violation. Allocates: violations do not occur in normal ticks.
  void add(std::string_view invariant, std::string_view seat, double at_s, bool expected) {
    expected = expected || std::ranges::any_of(expectations_, [&](const Expectation& e) {
                 return e.invariant == invariant && e.seat == seat;
               });
    const auto same =
        std::ranges::find_if(list_, [&](const Violation& v) { return v.invariant == invariant && v.seat == seat; });
    if (same != list_.end()) {
      ++same->count;
      return;
    }
    list_.push_back({std::string(invariant), std::string(seat), at_s, expected, 1});
  }
  /// Marks later violations of `invariant` at `seat` as expected, because a test provokes them.
  void expect(std::string_view invariant, std::string_view seat) {
    expectations_.push_back({std::string(invariant), std::string(seat)});
  }
  [[nodiscard]] const std::vector<Violation>& list() const noexcept { return list_; }
  [[nodiscard]] bool passed() const noexcept {
    return std::ranges::all_of(list_, [](const Violation& v) { return v.expected; });
  }

 private:
  struct Expectation {
    std::string invariant, seat;
  };
  std::vector<Violation> list_;
  std::vector<Expectation> expectations_;
};

}  // namespace tandem::server

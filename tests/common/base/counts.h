#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace tandem::test {

/// Returns the number of seeds of a random test: `reduced`, ten times as many for TANDEM_COUNTS=full, a hundred times
/// for nightly. Prints the number, so that a short run is never mistaken for a long one.
inline std::uint64_t seeds(std::uint64_t reduced) {
  const char* counts = std::getenv("TANDEM_COUNTS");
  const std::string_view name = counts == nullptr ? "reduced" : counts;
  const std::uint64_t factor = name == "nightly" ? 100 : name == "full" ? 10 : 1;
  std::printf("[  seeds   ] 1..%llu (TANDEM_COUNTS=%.*s)\n", static_cast<unsigned long long>(factor * reduced),
              static_cast<int>(name.size()), name.data());
  return factor * reduced;
}

/// Returns the number of draws of a statistical test, by TANDEM_COUNTS.
inline std::size_t draws(std::size_t reduced, std::size_t full, std::size_t nightly) {
  const char* counts = std::getenv("TANDEM_COUNTS");
  const std::string_view name = counts == nullptr ? "reduced" : counts;
  return name == "nightly" ? nightly : name == "full" ? full : reduced;
}

/// Returns whether TANDEM_COUNTS leaves the long parts of tests out: it does unless full or nightly.
inline bool reduced_counts() { return draws(1, 0, 0) == 1; }

}  // namespace tandem::test

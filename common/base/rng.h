#pragma once

#include <cstdint>

namespace tandem {

/// SplitMix64's finaliser [Steele, Lea, Flood 2014]: a bijection of 64 bits in which every input bit changes about half
/// of the output bits.
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t z) noexcept {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Counter-based random numbers: a pure function of (key, counter). An additional flow, model or draw therefore changes
/// no other decision. Callers derive one key per purpose with `derive`.
class RandomKey {
 public:
  constexpr explicit RandomKey(std::uint64_t seed) noexcept : key_(mix64(seed)) {}

  /// Returns a key for a sub-purpose (link, direction, model, ...), independent of its siblings.
  [[nodiscard]] constexpr RandomKey derive(std::uint64_t purpose) const noexcept {
    RandomKey k{0};
    k.key_ = mix64(key_ ^ mix64(purpose ^ 0xd1b54a32d192ed03ULL));
    return k;
  }
  [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t counter) const noexcept {
    return mix64(key_ ^ mix64(counter));
  }
  /// Returns a number in [0, 1) with 53 random bits.
  [[nodiscard]] constexpr double uniform(std::uint64_t counter) const noexcept {
    return static_cast<double>(bits(counter) >> 11) * 0x1.0p-53;
  }
  [[nodiscard]] constexpr double uniform(std::uint64_t counter, double lo, double hi) const noexcept {
    return lo + (hi - lo) * uniform(counter);
  }

 private:
  std::uint64_t key_;
};

/// The same as a sequence, for tests and for code with a fixed order of draws.
class RandomStream {
 public:
  constexpr explicit RandomStream(RandomKey key) noexcept : key_(key) {}
  constexpr explicit RandomStream(std::uint64_t seed) noexcept : key_(seed) {}
  constexpr std::uint64_t bits() noexcept { return key_.bits(counter_++); }
  constexpr double uniform() noexcept { return key_.uniform(counter_++); }
  constexpr double uniform(double lo, double hi) noexcept { return key_.uniform(counter_++, lo, hi); }
  /// Returns a number in [0, n). @pre n > 0
  constexpr std::uint64_t below(std::uint64_t n) noexcept { return bits() % n; }

 private:
  RandomKey key_;
  std::uint64_t counter_ = 0;
};

}  // namespace tandem

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tandem::server {

/// Store of random tokens for path challenges: 64 bits each, drawn outside the tick and taken within it. A server
/// fills it from the kernel (server/app), a simulation from its seed. No token is given twice, and a client cannot
/// derive one from anything it knows. While the store is empty no address is challenged; clients repeat STATE every
/// tick, so the validation starts later.
class PathTokens {
 public:
  static constexpr std::size_t kMax = 64;

  /// Number of tokens that can be added.
  [[nodiscard]] std::size_t free_slots() const noexcept { return kMax - size_; }
  /// True if the store should be filled. Challenges take at most two tokens per connection and tick.
  [[nodiscard]] bool low() const noexcept { return size_ < kMax / 2; }
  /// Adds a token; no effect if the store is full.
  void add(std::uint64_t token) noexcept {
    if (size_ < kMax) tokens_[size_++] = token;
  }
  [[nodiscard]] std::optional<std::uint64_t> take() noexcept {
    if (size_ == 0) return std::nullopt;
    ++taken_;
    return last_ = tokens_[--size_];
  }
  /// Number of tokens taken so far, and the last of them.
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
  [[nodiscard]] const std::uint64_t& last_taken() const noexcept { return last_; }

 private:
  std::array<std::uint64_t, kMax> tokens_{};
  std::size_t size_ = 0;
  std::uint64_t taken_ = 0, last_ = 0;
};

}  // namespace tandem::server

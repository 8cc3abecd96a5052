#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tandem::server {

/// Random tokens for path challenges: 64 bits each, drawn outside the tick and taken below it. The host of a session fills it from the
/// kernel (server/app), a virtual world from its seed. A token that was taken is never given again, and nothing that a client knows
/// leads to it. Empty: nobody is challenged until it is filled again; a client repeats its STATE every tick.
class PathTokens {
 public:
  static constexpr std::size_t kMax = 64;

  /// How many more may be added.
  [[nodiscard]] std::size_t room() const noexcept { return kMax - size_; }
  /// It is time to fill it. Two per connection and tick is the most that challenges take.
  [[nodiscard]] bool low() const noexcept { return size_ < kMax / 2; }
  /// Ignored when it is full.
  void add(std::uint64_t token) noexcept {
    if (size_ < kMax) tokens_[size_++] = token;
  }
  [[nodiscard]] std::optional<std::uint64_t> take() noexcept {
    if (size_ == 0) return std::nullopt;
    return tokens_[--size_];
  }

 private:
  std::array<std::uint64_t, kMax> tokens_{};
  std::size_t size_ = 0;
};

}  // namespace tandem::server

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace tandem {

/// A text of at most `kMost` bytes inside its owner, for data that is copied between threads without memory from the
/// heap.
template <std::size_t kMost>
class FixedText {
 public:
  constexpr FixedText() noexcept = default;
  /// @param text  cut to its first `kMost` bytes
  constexpr explicit FixedText(std::string_view text) noexcept : size_(std::min(text.size(), kMost)) {
    std::ranges::copy(text.substr(0, size_), bytes_.begin());
  }
  [[nodiscard]] constexpr std::string_view view() const noexcept { return {bytes_.data(), size_}; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }

 private:
  std::size_t size_ = 0;
  std::array<char, kMost> bytes_{};
};

}  // namespace tandem

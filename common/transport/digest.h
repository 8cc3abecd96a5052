#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace tandem::transport {

/// SHA-256 of a stream of text.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;
  void add(std::string_view bytes) noexcept;
  /// Returns the lower-case hex of all added text; the digest cannot be continued.
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Returns the SHA-256 of the parts, one after the other.
[[nodiscard]] std::array<std::byte, 32> sha256(std::span<const std::byte> first,
                                               std::span<const std::byte> second = {}) noexcept;

}  // namespace tandem::transport

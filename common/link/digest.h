#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace tandem::link {

/// SHA-256 of a stream of text.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;
  void add(std::string_view bytes) noexcept;
  /// Lower-case hex of everything added so far; the digest cannot be continued.
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of bytes that are all there.
[[nodiscard]] std::array<std::byte, 32> sha256(std::span<const std::byte> bytes) noexcept;

}  // namespace tandem::link

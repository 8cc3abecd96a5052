#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Bytes that nobody else may learn: wiped when they go, compared in a time that tells nothing.
namespace tandem {

/// Overwrites with zeros; not removed by the optimiser: it must believe that somebody reads them.
inline void wipe(std::span<std::byte> bytes) noexcept {
  for (std::byte& b : bytes) b = std::byte{0};
  asm volatile("" : : "r"(bytes.data()) : "memory");
}
inline void wipe(std::string& text) noexcept {
  for (char& c : text) c = '\0';
  asm volatile("" : : "r"(text.data()) : "memory");
  text.clear();
}

/// Equal lengths and equal bytes, in a time that depends on the lengths only.
[[nodiscard]] inline bool equal_secret(std::span<const std::byte> a, std::span<const std::byte> b) noexcept {
  if (a.size() != b.size()) return false;
  std::byte differs{0};
  for (std::size_t i = 0; i < a.size(); ++i) {
    differs |= a[i] ^ b[i];
    asm volatile("" : "+r"(differs));  // keeps the compiler from leaving early
  }
  return differs == std::byte{0};
}

/// A secret of fixed size. Every copy wipes itself.
template <std::size_t N>
struct Secret {
  std::array<std::byte, N> bytes{};

  Secret() = default;
  explicit Secret(std::span<const std::byte, N> from) noexcept {
    for (std::size_t i = 0; i < N; ++i) bytes[i] = from[i];
  }
  Secret(const Secret&) = default;
  Secret& operator=(const Secret&) = default;
  ~Secret() { wipe(bytes); }

  friend bool operator==(const Secret& a, const Secret& b) noexcept { return equal_secret(a.bytes, b.bytes); }
};

/// A secret whose size is known only when it is read, such as a key file. Never grows, so no copy is left behind by a new allocation.
class SecretBuffer {
 public:
  SecretBuffer() = default;
  explicit SecretBuffer(std::size_t size) : bytes_(size) {}
  explicit SecretBuffer(std::span<const std::byte> from) : bytes_(from.begin(), from.end()) {}
  SecretBuffer(SecretBuffer&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  SecretBuffer& operator=(SecretBuffer&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  SecretBuffer(const SecretBuffer&) = delete;
  SecretBuffer& operator=(const SecretBuffer&) = delete;
  ~SecretBuffer() { wipe(bytes_); }

  [[nodiscard]] std::span<std::byte> bytes() noexcept { return bytes_; }
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace tandem

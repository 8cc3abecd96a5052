#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Secret bytes: wiped on destruction and compared in constant time.
namespace tandem {

/// Overwrites with zeros. The assembly statement keeps the optimiser from removing this.
inline void wipe(std::span<std::byte> bytes) noexcept {
  for (std::byte& b : bytes) b = std::byte{0};
  asm volatile("" : : "r"(bytes.data()) : "memory");
}
inline void wipe(std::string& text) noexcept {
  for (char& c : text) c = '\0';
  asm volatile("" : : "r"(text.data()) : "memory");
  text.clear();
}

/// Returns whether lengths and bytes are equal; the time depends on the lengths only.
[[nodiscard]] inline bool equal_secret(std::span<const std::byte> a, std::span<const std::byte> b) noexcept {
  if (a.size() != b.size()) return false;
  std::byte differs{0};
  for (std::size_t i = 0; i < a.size(); ++i) {
    differs |= a[i] ^ b[i];
    asm volatile("" : "+r"(differs));  // keeps the compiler from returning early
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

/// A secret whose size is known only when it is read, such as a key file. It never grows, so no reallocation leaves a
/// copy behind.
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

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem {

/// A flat surface near a tool that the server tells a client of, so that the client simulates it without delay.
/// Frame: the tip's. Force on the tool: (k d - b v_n) along `normal` at penetration d > 0, never pulling, and friction of at most
/// `mu` times that across it. Single precision: these numbers travel in every FORCE.
struct LocalContact {
  std::uint32_t id = 0;           ///< the same while it is the same surface, also where it moves; above 0
  std::array<float, 3> point{};   ///< on the surface [m]
  std::array<float, 3> normal{};  ///< outward, of length 1; 0 along axes that the port does not have
  float k = 0;                    ///< [N/m]
  float b = 0;                    ///< [N s/m]
  float mu = 0;                   ///< Coulomb friction [1]

  static constexpr float kPointMax = 10, kStiffnessMax = 1e6F, kDampingMax = 1e3F, kFrictionMax = 2;
  static constexpr float kLengthTolerance = 1e-4F;  ///< of the square of the normal's length
  friend bool operator==(const LocalContact&, const LocalContact&) = default;
};

/// Of one tool.
inline constexpr std::size_t kLocalContactsMax = 4;

/// At most `kLocalContactsMax` of them.
struct LocalContactList {
  std::array<LocalContact, kLocalContactsMax> item{};
  std::uint32_t size = 0;

  [[nodiscard]] std::span<const LocalContact> all() const noexcept { return std::span{item}.first(size); }
  /// @return false: there is no room
  bool add(const LocalContact& contact) noexcept {
    if (size == kLocalContactsMax) return false;
    item[size++] = contact;
    return true;
  }
};

/// Whether the length of the normal, the axes and the identity are those of a surface. Magnitudes are judged elsewhere.
/// @param axes  of the port, 1 to 3
[[nodiscard]] inline bool is_surface(const LocalContact& c, std::size_t axes) noexcept {
  float square = 0;
  bool inside = true;
  for (std::size_t a = 0; a < c.normal.size(); ++a) {
    square += c.normal[a] * c.normal[a];
    inside = inside && (a < axes || c.normal[a] == 0);
  }
  return c.id > 0 && inside && std::abs(square - 1) <= LocalContact::kLengthTolerance;  // false for NaN
}

/// Whether all numbers are finite and in range.
[[nodiscard]] inline bool in_range(const LocalContact& c) noexcept {
  const auto within = [](float value, float low, float high) { return value >= low && value <= high; };  // false for NaN
  bool good = within(c.k, 0, LocalContact::kStiffnessMax) && within(c.b, 0, LocalContact::kDampingMax) && within(c.mu, 0, LocalContact::kFrictionMax);
  for (const float p : c.point) good = good && within(p, -LocalContact::kPointMax, LocalContact::kPointMax);
  for (const float n : c.normal) good = good && within(n, -2, 2);
  return good;
}

}  // namespace tandem

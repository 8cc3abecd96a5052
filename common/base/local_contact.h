#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem {

/// A flat surface near a tool, sent by the server so that the client simulates it without delay. Frame: the tip's. At
/// penetration d > 0 the force on the tool is (k d - b v_n) along `normal`, and it never pulls. Friction across the
/// normal is at most `mu` times that force. Single precision, because every FORCE carries these numbers.
struct LocalContact {
  std::uint32_t id = 0;           ///< identity of the surface, constant also while it moves; above 0
  std::array<float, 3> point{};   ///< on the surface [m]
  std::array<float, 3> normal{};  ///< outward, of length 1; 0 along axes that the port does not have
  float k = 0;                    ///< [N/m]
  float b = 0;                    ///< [N s/m]
  float mu = 0;                   ///< Coulomb friction [1]

  static constexpr float kPointMax = 10, kStiffnessMax = 1e6F, kDampingMax = 1e3F, kFrictionMax = 2;
  static constexpr float kLengthTolerance = 1e-4F;  ///< for the square of the normal's length
  friend bool operator==(const LocalContact&, const LocalContact&) = default;
};

/// Largest number of surfaces of one tool.
inline constexpr std::size_t kLocalContactsMax = 4;

/// A list of at most `kLocalContactsMax` surfaces.
struct LocalContactList {
  std::array<LocalContact, kLocalContactsMax> item{};
  std::uint32_t size = 0;

  [[nodiscard]] std::span<const LocalContact> all() const noexcept { return std::span{item}.first(size); }
  /// Adds a surface. @return false if the list is full
  bool add(const LocalContact& contact) noexcept {
    if (size == kLocalContactsMax) return false;
    item[size++] = contact;
    return true;
  }
};

/// Returns whether the length of the normal, the axes and the identity are those of a surface. `in_range` checks the
/// magnitudes.
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

/// Returns whether all numbers are finite and in range.
[[nodiscard]] inline bool in_range(const LocalContact& c) noexcept {
  const auto within = [](float value, float low, float high) {
    return value >= low && value <= high;
  };  // false for NaN
  bool good = within(c.k, 0, LocalContact::kStiffnessMax) && within(c.b, 0, LocalContact::kDampingMax) &&
              within(c.mu, 0, LocalContact::kFrictionMax);
  for (const float p : c.point) good = good && within(p, -LocalContact::kPointMax, LocalContact::kPointMax);
  for (const float n : c.normal) good = good && within(n, -2, 2);
  return good;
}

}  // namespace tandem

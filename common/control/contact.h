#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace tandem::control {

/// A flat surface that a virtual tool meets: force (k d + k3 d^3) + b d' along `normal` at penetration d > 0, never pulling, and Coulomb
/// friction of at most `mu` times that force across it. Frame: the tip's [m].
struct Contact {
  std::array<double, 3> normal{};  ///< outward, of length 1
  double at = 0;                   ///< the surface is where normal . x = at [m]
  double k = 0;                    ///< [N/m], at least 0
  double k3 = 0;                   ///< [N/m^3], at least 0
  double b = 0;                    ///< [N s/m], at least 0
  double mu = 0;                   ///< [1], at least 0

  [[nodiscard]] double penetration(const std::array<double, 3>& x) const noexcept {
    return at - (normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]);
  }
  [[nodiscard]] double slope(double d) const noexcept { return d > 0 ? k + 3 * k3 * d * d : k; }
  [[nodiscard]] double spring(double d) const noexcept { return d > 0 ? d * (k + k3 * d * d) : k * d; }
};

/// All surfaces that one tool may meet: two of a scene and four that are told (LocalContact).
class ContactSet {
 public:
  static constexpr std::size_t kMax = 6;

  /// @return false: there is no room
  bool add(const Contact& contact) noexcept {
    if (size_ == kMax) return false;
    contacts_[size_++] = contact;
    return true;
  }
  /// Takes those after the first `size` away. @pre size <= this->size()
  void keep(std::size_t size) noexcept { size_ = size; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const Contact& operator[](std::size_t i) const noexcept { return contacts_[i]; }

 private:
  std::array<Contact, kMax> contacts_{};
  std::size_t size_ = 0;
};

}  // namespace tandem::control

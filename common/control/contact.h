#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace tandem::control {

/// A flat surface that a virtual tool can touch. At penetration d > 0 its force along `normal` is (k d + k3 d^3) + b d'
/// and never pulls. Across the normal acts Coulomb friction of at most `mu` times that force. Frame: the tip's [m].
struct Contact {
  std::array<double, 3> normal{};  ///< outward, of length 1
  double at = 0;                   ///< offset: the surface is where normal . x = at [m]
  double k = 0;                    ///< [N/m], at least 0
  double k3 = 0;                   ///< [N/m^3], at least 0
  double b = 0;                    ///< [N s/m], at least 0
  double mu = 0;                   ///< [1], at least 0

  /// Returns the depth of `x` below the surface [m]; negative outside.
  [[nodiscard]] double penetration(const std::array<double, 3>& x) const noexcept {
    return at - (normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]);
  }
  /// Returns the derivative of the spring force at depth `d` [N/m].
  [[nodiscard]] double slope(double d) const noexcept { return d > 0 ? k + 3 * k3 * d * d : k; }
  /// Returns the spring force at depth `d` [N]; outside the linear part, which is negative.
  [[nodiscard]] double spring(double d) const noexcept { return d > 0 ? d * (k + k3 * d * d) : k * d; }
};

/// All surfaces that one tool may touch: two of the scene and four received from the server (LocalContact).
class ContactSet {
 public:
  static constexpr std::size_t kMax = 6;

  /// Adds a surface. @return false if the set is full
  bool add(const Contact& contact) noexcept {
    if (size_ == kMax) return false;
    contacts_[size_++] = contact;
    return true;
  }
  /// Keeps the first `size` surfaces and removes the others. @pre size <= this->size()
  void keep(std::size_t size) noexcept { size_ = size; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const Contact& operator[](std::size_t i) const noexcept { return contacts_[i]; }

 private:
  std::array<Contact, kMax> contacts_{};
  std::size_t size_ = 0;
};

}  // namespace tandem::control

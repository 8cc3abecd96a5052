#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/local_contact.h"
#include "common/control/channel.h"
#include "common/control/contact.h"

namespace tandem::control {

/// The surfaces received from the server (LocalContact), as a tool touches them. The server's tool and every client
/// copy execute this same code.
///
/// A surface that presses at the tool and begins, moves, turns or stiffens does work on it. It therefore changes at a
/// bounded rate, so that no force steps, and only as far as the ledger pays. Its stored energy is 1/2 k d^2; of a
/// change, axis a bears the part n_a^2. A change that releases energy is credited. A surface that does not press takes
/// its new place at once.
///
/// A surface is valid for `kValid` after the server last named it. It then retreats at the same bounded rate until it
/// no longer presses.
class LocalContacts {
 public:
  static constexpr std::size_t kMax = kLocalContactsMax;
  static constexpr double kValid = 0.1;  ///< [s]
  static constexpr double kTurn = 2;     ///< largest turning rate of a normal whose surface presses [rad/s]
  /// Bounds of motion.
  struct Params {
    std::size_t axes = 3;
    double v_app = 0.1;  ///< largest speed of a surface that presses [m/s]
    double k_c = 400;    ///< of the spring that pulls the tool [N/m]
    double dt = 0.001;   ///< duration of a tick [s]
  };
  explicit LocalContacts(const Params& params) noexcept;

  /// Removes all surfaces. Their stored energy is dropped and never credited.
  void clear() noexcept;
  /// Stores the surfaces that the server names now. @pre each is_surface and in_range
  void update(std::span<const LocalContact> told) noexcept TANDEM_REALTIME;
  /// Moves the surfaces by one tick; called before the tool's step.
  /// @param x    position of the tool [m]
  /// @param end  pays for motion against the tool; null: nothing is paid (the server's own tool)
  /// @return whether `surfaces` may have changed
  bool step(const AxisArray& x, ChannelEnd* end) noexcept TANDEM_REALTIME;

  /// The surfaces as the tool touches them now.
  [[nodiscard]] const ContactSet& surfaces() const noexcept { return surfaces_; }
  /// Number of received surfaces that found no free slot, cumulative.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  struct Slot {
    bool used = false;
    std::uint32_t id = 0;
    std::uint32_t valid = 0;     ///< remaining ticks
    Contact now;                 ///< as the tool touches it
    Contact told;                ///< its target
    double moved = 0, paid = 0;  ///< distance of its last move against the tool, and the cost of that [m, J]
  };
  void follow(Slot& slot, const std::array<double, 3>& x, ChannelEnd* end) noexcept;
  void settle(Slot& slot, double depth, ChannelEnd* end) const noexcept;
  void turn(Contact& now, const Contact& told) const noexcept;
  [[nodiscard]] static double affordable(double energy, const Contact& now, std::size_t axes,
                                         const ChannelEnd& end) noexcept;

  Params p_;
  std::uint32_t valid_ticks_;
  std::array<Slot, kMax> slots_{};
  std::size_t used_ = 0;
  ContactSet surfaces_;
  std::uint64_t dropped_ = 0;
};

}  // namespace tandem::control

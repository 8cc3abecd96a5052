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

/// The surfaces that were told of (LocalContact), as a tool meets them. The server's tool and every copy follow them by this very code.
///
/// A surface that begins, moves, turns or stiffens where it presses at the tool does so at a bounded rate, so that no force steps, and
/// only as far as the ledger pays: it does work on the tool. Its stored energy is 1/2 k d^2; of a change, the axis a bears the part
/// n_a^2. A change that takes energy out comes back as credit. A surface that does not press is where it was told to be, at once.
///
/// A surface is valid for `kValid` after it was last named. Then it retreats at the same bounded rate, until it presses no more.
class LocalContacts {
 public:
  static constexpr std::size_t kMax = kLocalContactsMax;
  static constexpr double kValid = 0.1;  ///< [s]
  static constexpr double kTurn = 2;     ///< a normal turns at most so fast where its surface presses [rad/s]
  struct Params {
    std::size_t axes = 3;
    double v_app = 0.1;  ///< a surface that presses moves at most so fast [m/s]
    double k_c = 400;    ///< of the spring that pulls at the tool [N/m]
    double dt = 0.001;   ///< tick [s]
  };
  explicit LocalContacts(const Params& params) noexcept;

  /// Forgets all of them. What they stored is dropped, never credited.
  void clear() noexcept;
  /// These were named now. @pre each is_surface and in_range
  void hear(std::span<const LocalContact> told) noexcept TANDEM_REALTIME;
  /// Once per tick, before the tool's step.
  /// @param x    of the tool [m]
  /// @param end  pays for what moves against the tool; null: nothing is paid (the server's own tool)
  /// @return whether `surfaces` may differ from before
  bool step(const AxisArray& x, ChannelEnd* end) noexcept TANDEM_REALTIME;

  [[nodiscard]] const ContactSet& surfaces() const noexcept { return surfaces_; }
  [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }  ///< named while there was no room, so far

 private:
  struct Slot {
    bool used = false;
    std::uint32_t id = 0;
    std::uint32_t valid = 0;  ///< ticks
    Contact now;              ///< as the tool meets it
    Contact told;             ///< where it goes
    double moved = 0, paid = 0;  ///< by its last move against the tool, and for it [m, J]
  };
  void follow(Slot& slot, const std::array<double, 3>& x, ChannelEnd* end) noexcept;
  void settle(Slot& slot, double depth, ChannelEnd* end) const noexcept;
  void turn(Contact& now, const Contact& told) const noexcept;
  [[nodiscard]] static double affordable(double energy, const Contact& now, std::size_t axes, const ChannelEnd& end) noexcept;

  Params p_;
  std::uint32_t valid_ticks_;
  std::array<Slot, kMax> slots_{};
  std::size_t used_ = 0;
  ContactSet surfaces_;
  std::uint64_t left_out_ = 0;
};

}  // namespace tandem::control

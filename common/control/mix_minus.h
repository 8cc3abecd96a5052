#pragma once

#include <algorithm>
#include <cstddef>

#include "common/base/axes.h"
#include "common/control/channel.h"
#include "common/control/esc_hub.h"
#include "common/control/leading_hand.h"

namespace tandem::control {

/// Mix-minus of law `replica`, as in a telephone conference: the target of one seat for one tool is where the other
/// hands pull at the tool, without this hand's own echo:
///
///     r_i = sum_{h != i} A_jh p_h / sum_{h != i} A_jh        the tool itself where no other hand has authority
///
/// A hand that shares the tool receives the others' samples as measured; a hand that only follows receives the
/// prediction for now. Where the force of a SLAVE seat's device arrives through the server, the springs to the others
/// (1 - a) and to the device (s), as parts of k_c, become one spring to their weighted mean. Writes position [m] and
/// velocity [m/s] of the target, per axis of the port. Real-time safe.
class MixMinus {
 public:
  /// @param x, v  out: the target; those of the tool, or 0 until all parts are added
  MixMinus(const EscHub& hub, std::size_t seat, std::size_t tool, AxisArray& x, AxisArray& v) noexcept
      : hub_(hub), seat_(seat), tool_(tool), x_(x), v_(v) {
    for (std::size_t h = 0; h < hub.params().masters; ++h) others_ += h == seat ? 0 : hub.coupling(h, tool).alpha;
    for (std::size_t a = 0; a < hub.params().axes; ++a) {
      x[a] = led() ? 0 : hub.tool(tool).x[a];
      v[a] = led() ? 0 : hub.tool(tool).v[a];
    }
  }

  /// Another hand has authority over the tool.
  [[nodiscard]] bool led() const noexcept { return others_ > kNoAuthority; }
  /// This hand shares the tool: its motion returns to it through the other hands.
  [[nodiscard]] bool shares() const noexcept { return hub_.coupling(seat_, tool_).alpha >= kSharedAuthorityMin; }
  /// Part of a hand in the target, [0, 1]; 0 for this hand itself. @pre led()
  [[nodiscard]] double part(std::size_t hand) const noexcept {
    return hand == seat_ ? 0 : hub_.coupling(hand, tool_).alpha / others_;
  }
  /// Adds a hand as measured.
  void add_measured(double part, const PortSample& hand) noexcept TANDEM_REALTIME {
    for (std::size_t a = 0; a < hub_.params().axes; ++a) {
      x_[a] += part * hand.x[a];
      v_[a] += part * hand.v[a];
    }
  }
  /// Adds a hand as predicted for now.
  /// @param end     the hand's end of the spring to the tool
  /// @param lead    its steady prediction
  /// @param steady  share of the steady prediction [0, 1]
  /// @param moves   false: only the steady prediction has a velocity, because the hand is lost
  void add_predicted(double part, const EndState& end, const LeadingHand& lead, double steady,
                     bool moves) noexcept TANDEM_REALTIME {
    for (std::size_t a = 0; a < hub_.params().axes; ++a) {
      const double rate = moves ? end.led[a] : 0;
      x_[a] += part * (end.ref[a] + steady * (lead.steady_x(a) - end.ref[a]));
      v_[a] += part * (rate + steady * (lead.steady_v(a) - rate));
    }
  }
  /// Puts one spring in place of the two to the others and to the device.
  /// @param share  s, see `slave_share`  @param x, v  motion of the device
  void add_slave(double share, const AxisArray& x, const AxisArray& v) noexcept TANDEM_REALTIME {
    const double alone = 1 - hub_.coupling(seat_, tool_).alpha;
    for (std::size_t a = 0; a < hub_.params().axes; ++a) {
      x_[a] = (alone * x_[a] + share * x[a]) / (alone + share);
      v_[a] = (alone * v_[a] + share * v[a]) / (alone + share);
    }
  }

  /// Share of a hand's k_c with which a slave's spring pulls the hand's copy of the tool. The loop of this spring is
  /// closed over both networks. P+d therefore limits its stiffness by the sum of both delays
  /// [Nuno et al., IJRR 28(7) 2009].
  /// @param share    share of the slave's spring that acts at the tool [0, 1]
  /// @param k_delay  largest product of stiffness and delay [N s/m]
  /// @param k_c      stiffness of the seat's own spring, which its device may have lowered below the scene's [N/m]
  [[nodiscard]] static double slave_share(double share, const GainSchedule& hand, const GainSchedule& slave,
                                          double k_delay, double k_c) noexcept TANDEM_REALTIME {
    const double delay = hand.delay() + slave.delay();
    const double most = delay > 0 ? k_delay / delay : slave.stiffness();
    return share * std::min(1.0, std::min(slave.stiffness(), most) / k_c);
  }

  /// Sum of the others' authority up to which the seat follows the tool itself.
  static constexpr double kNoAuthority = 1e-9;
  /// Authority from which a hand's motion returns to it through the other hands.
  static constexpr double kSharedAuthorityMin = 1e-3;

 private:
  const EscHub& hub_;
  std::size_t seat_, tool_;
  AxisArray &x_, &v_;
  double others_ = 0;
};

}  // namespace tandem::control

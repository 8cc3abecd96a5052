#pragma once

#include <optional>

#include "common/control/assist.h"
#include "common/control/channel.h"
#include "common/control/hand_motion.h"
#include "common/control/local_contacts.h"
#include "common/control/reengage_offset.h"
#include "common/control/virtual_tool.h"

namespace tandem::control {

/// The tool as one hand feels it: a copy of the server's tool, simulated at the client with its surfaces. Contact and
/// sole leading therefore feel no delay.
///
///     m x'' = a k_c (q - x) + (1 - a) k_x (r - x) + b_rel (v_in - v) - b v + F_env(x)      one implicit step
///     F     = k_c (y - q)                                  on the hand; y = x as far as paid
///
/// Where y lags x, the hand's spring pulls the copy by the same force: a k_c (q - (y - x) - x).
///
/// The storage is
///
///     W = 1/2 m v^2 + 1/2 k_c |q - x|^2 + 1/2 (1 - a) k_x |r - x|^2 + H_env
///
/// The ledger pays, per axis and in advance, for:
/// - moves of r (ReplicaReference);
/// - F (dy - a dx), which is (1 - a) F dx where y = x;
/// - b_rel (v_in - v) dx;
/// - moves of surfaces received from the server (LocalContacts);
/// - F do for the decay of an offset o between hand and tool, and for the shift that assists a following hand (Assist).
///
/// Negative costs are refunded. A hand with sole authority (a = 1) pays nothing and receives nothing, so the copy is
/// passive by construction.
class ToolCopy {
 public:
  static constexpr std::size_t kAxes = VirtualTool::kAxes;
  /// Parameters of the copy.
  struct Params {
    VirtualTool::Gains tool;   ///< those of the server's tool
    std::size_t axes = 3;      ///< of a TIP port, 1 to 3
    ContactSet contacts;       ///< surfaces of the scene
    double k_c = 400;          ///< hand to copy [N/m]
    double b_rel = 14;         ///< [N s/m]
    double v_app = 0.1;        ///< speed at which an offset decays [m/s]
    double offset_hold = 0.5;  ///< time from engaging until an offset decays [s]: the ramp of the gate
    double force_max = 3.3;    ///< of the gate [N]
    bool of_several = false;   ///< the hand also feels other tools
    double dt = 0.001;         ///< duration of a tick [s]
    Numerics numerics;         ///< those of the server's tool
    Assist::Params assist;     ///< bound and conditions; its axes, k_c and dt are replaced by those of the copy
  };
  explicit ToolCopy(const Params& params) noexcept;

  /// Resets the copy for a seat that is not engaged. The copy takes the position of the server's tool; the distance to
  /// the hand becomes the offset.
  void rest_at(const AxisArray& tool, const AxisArray& hand) noexcept;
  /// Stores the surfaces that the server names now, in addition to those of the scene. @pre each is_surface and
  /// in_range
  void update_contacts(std::span<const LocalContact> told) noexcept TANDEM_REALTIME { received_contacts_.update(told); }
  /// Sets the predicted present motion of the leading hand for `step` in this tick. Without this call no other hand
  /// leads.
  /// @param touching  the tool touches an object that is not a surface of the copy, such as a slave felt over the
  /// network
  void set_leader(const AxisArray& x, const AxisArray& velocity, bool touching = false) noexcept TANDEM_REALTIME;
  /// Advances the copy by one tick.
  /// @param end  end of this seat, already moved in this tick; provides reference, stiffness, damping and ledger
  /// @return the effort wanted on the hand, before the gate [N]
  const AxisArray& step(const AxisArray& hand, double authority, ChannelEnd& end) noexcept TANDEM_REALTIME;
  /// Reports the part of `step`'s effort that the gate passed; the copy is pulled by exactly that effort.
  void delivered(const AxisArray& effort) noexcept TANDEM_REALTIME;
  /// Moves into the offset a share of the elongation per axis, [0, 1], because the motor does not give its force while
  /// the gate ramps in.
  void yield(const AxisArray& part) noexcept TANDEM_REALTIME;

  /// Returns the given share of the wanted effort, [0, 1]; nullopt where the wanted effort is too small for a ratio.
  [[nodiscard]] static std::optional<double> share_of(const AxisArray& given, const AxisArray& wanted,
                                                      std::size_t axes) noexcept;

  [[nodiscard]] const VirtualTool& tool() const noexcept { return tool_; }
  [[nodiscard]] const LocalContacts& received_contacts() const noexcept { return received_contacts_; }
  /// The anchor from which the hand pulls the tool, for the server: q where the whole effort is given, nearer to the
  /// copy where it is clipped.
  [[nodiscard]] const HandMotion& anchor(std::size_t axis) const noexcept { return anchor_[axis].now(); }
  /// Heat of the last step that may be spent [J].
  [[nodiscard]] double dissipated(std::size_t axis) const noexcept { return dissipated_[axis]; }
  /// Hand minus tool, decaying to 0 [m].
  [[nodiscard]] double offset(std::size_t axis) const noexcept { return offset_[axis]; }
  [[nodiscard]] const Assist& assist() const noexcept { return assist_; }

 private:
  void grow_offset(const AxisArray& hand) noexcept;
  void release_spring() noexcept;
  void decay_offset(const AxisArray& hand, ChannelEnd& end) noexcept;
  void apply_assist(const AxisArray& hand, double authority, ChannelEnd& end) noexcept;
  /// Position of the hand as the copy sees it: without its offset and the shift of its assist [m].
  [[nodiscard]] double place(const AxisArray& hand, std::size_t axis) const noexcept {
    return hand[axis] - offset_[axis] - assist_.shift(axis);
  }
  void apply_received_contacts(ChannelEnd& end) noexcept;
  [[nodiscard]] VirtualTool::Parts advance_in_parts(const VirtualTool::Pulls& pulls,
                                                    const VirtualTool::Pulls& without_dampers,
                                                    const VirtualTool& before, ChannelEnd& end) noexcept;
  [[nodiscard]] bool pay_for_dampers(const VirtualTool::Pulls& pulls, const VirtualTool& before,
                                     ChannelEnd& end) noexcept;
  [[nodiscard]] bool pay_in_all_axes(const AxisArray& cost, ChannelEnd& end) noexcept;
  void show(std::size_t axis, double hand, double others, ChannelEnd& end) noexcept;

  Params p_;
  VirtualTool tool_;
  LocalContacts received_contacts_;
  Assist assist_;
  Assist::Input leader_;  ///< of this tick
  std::array<HandVelocity, kAxes> hand_;
  std::array<HandMotionFilter, kAxes> anchor_;
  ReengageOffset offset_;
  AxisArray shown_{}, wanted_{}, dissipated_{};
  AxisArray lag_{};   ///< y - x: motion that the hand is not shown because it is not paid [m]
  double share_ = 0;  ///< share of the wanted effort that the gate passed last [0, 1]
  double pull_ =
      0;  ///< share with which the hand pulls the copy: equal to `share_`, but limited to what its motor could give
  double engaged_for_ = 0;  ///< time since engaging [s]
};

}  // namespace tandem::control

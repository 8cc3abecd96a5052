#pragma once

#include <optional>

#include "common/control/assist.h"
#include "common/control/channel.h"
#include "common/control/hand_motion.h"
#include "common/control/local_contacts.h"
#include "common/control/virtual_tool.h"

namespace tandem::control {

/// The tool as one hand feels it: a copy of the server's, simulated at the client with its surfaces, so that contact and leading cost no delay.
///
///     m x'' = a k_c (q - x) + (1 - a) k_x (r - x) + b_rel (v_in - v) - b v + F_env(x)        one implicit step
///     F     = k_c (y - q)                                                                  on the hand; y = x as far as is paid
///
/// Where y lags x, the copy is pulled by the same force: a k_c (q - (y - x) - x).
///
/// What the ledger pays, per axis, before it acts (storage W = 1/2 m v^2 + 1/2 k_c |q - x|^2 + 1/2 (1 - a) k_x |r - x|^2 + H_env): moves of r
/// (ReplicaReference), F (dy - a dx), which is (1 - a) F dx where y = x, b_rel (v_in - v) dx, moves of surfaces that the server tells of (LocalContacts), and F do for the way
/// home of an offset o between hand and tool and for the shift by which a hand that follows is assisted (Assist). Negative costs come back. A hand that leads alone (a = 1) pays nothing and gets nothing: passive by construction.
class ToolCopy {
 public:
  static constexpr std::size_t kAxes = VirtualTool::kAxes;
  struct Params {
    VirtualTool::Gains tool;
    std::size_t axes = 3;      ///< of a TIP port, 1 to 3
    ContactSet contacts;
    double k_c = 400;          ///< hand to copy [N/m]
    double b_rel = 14;         ///< [N s/m]
    double v_app = 0.1;        ///< of an offset's way home [m/s]
    double offset_rests = 0.5; ///< how long an offset stays once it began [s]: the ramp of the gate
    double force_max = 3.3;    ///< of the gate [N]
    bool of_several = false;   ///< the hand feels other tools too
    double dt = 0.001;         ///< tick [s]
    Assist::Params assist;     ///< bound and where it acts; axes, k_c and dt are the copy's own
  };
  explicit ToolCopy(const Params& params) noexcept;

  /// Not engaged: the copy stands where the server's tool is, the hand wherever it is; their distance becomes the offset.
  void rest_at(const AxisArray& tool, const AxisArray& hand) noexcept;
  /// The server named these surfaces now, beside those of the scene. @pre each is_surface and in_range
  void hear(std::span<const LocalContact> told) noexcept TANDEM_REALTIME { told_.hear(told); }
  /// Where the hand is by now that leads this one, for `step` in this tick; not called: no other hand leads.
  /// @param touching  something that is no surface of the copy, as a slave that is felt over the network
  void see_leader(const AxisArray& x, const AxisArray& velocity, bool touching = false) noexcept TANDEM_REALTIME;
  /// @param end  of this seat, already moved in this tick: its reference, stiffness, damping and ledger
  /// @return the effort wanted on the hand, before the gate [N]
  const AxisArray& step(const AxisArray& hand, double authority, ChannelEnd& end) noexcept TANDEM_REALTIME;
  /// What the gate let through of `step`'s effort: the copy is pulled by just that.
  void delivered(const AxisArray& effort) noexcept TANDEM_REALTIME;

  /// How much of what was wanted was given; nothing where so little was wanted that a ratio says nothing.
  [[nodiscard]] static std::optional<double> share_of(const AxisArray& given, const AxisArray& wanted, std::size_t axes) noexcept;

  [[nodiscard]] const VirtualTool& tool() const noexcept { return tool_; }
  [[nodiscard]] const LocalContacts& told() const noexcept { return told_; }
  /// Where the hand pulls at the tool, as the server shall take it: q where the whole effort is given, nearer to the copy where it is clipped.
  [[nodiscard]] const HandMotion& anchor(std::size_t axis) const noexcept { return anchor_[axis].now(); }
  [[nodiscard]] double dissipated(std::size_t axis) const noexcept { return dissipated_[axis]; }  ///< heat of the last step that may be spent [J]
  [[nodiscard]] double offset(std::size_t axis) const noexcept { return offset_[axis]; }          ///< hand minus tool, on its way to 0 [m]
  [[nodiscard]] const Assist& assist() const noexcept { return assist_; }

 private:
  void let_offset_grow(const AxisArray& hand) noexcept;
  void let_spring_go() noexcept;
  void bring_offset_home(ChannelEnd& end) noexcept;
  void pull_to_leader(const AxisArray& hand, double authority, ChannelEnd& end) noexcept;
  /// Where the hand stands beside the copy: its offset and the shift of its assist taken off [m].
  [[nodiscard]] double place(const AxisArray& hand, std::size_t axis) const noexcept { return hand[axis] - offset_[axis] - assist_.shift(axis); }
  void meet_told(ChannelEnd& end) noexcept;
  [[nodiscard]] bool pay_for_dampers(const VirtualTool::Pulls& pulls, const VirtualTool& before, ChannelEnd& end) noexcept;
  void show(std::size_t axis, double hand, double others, ChannelEnd& end) noexcept;

  Params p_;
  VirtualTool tool_;
  LocalContacts told_;
  Assist assist_;
  Assist::Input leader_;  ///< as seen in this tick
  std::array<HandVelocity, kAxes> hand_;
  std::array<HandMotionFilter, kAxes> anchor_;
  AxisArray shown_{}, offset_{}, wanted_{}, dissipated_{};
  AxisArray lag_{};        ///< y - x: what the hand is not shown, as it is not paid [m]
  double share_ = 0;       ///< of the wanted effort that the gate gave last [0, 1]
  double pull_ = 0;        ///< of it that the hand pulls the copy with: as much, and no more than its motor could give
  double engaged_for_ = 0; ///< [s]
};

}  // namespace tandem::control

#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "common/base/axes.h"
#include "common/base/port_sample.h"
#include "common/control/energy_ledger.h"
#include "common/control/gain_schedule.h"

/// Interface of the channel laws. The network is cut at the reference port: every seat is a spring whose two ends run
/// on two machines (ARCHITECTURE.md, "The channel, as built"). A channel law computes the reference of one end in every
/// tick, whether or not a datagram has arrived.
namespace tandem::control {

/// The machine on which an end runs.
enum class Side : std::uint8_t { kClient, kServer };

/// Parameters of one end of a channel.
struct ChannelParams {
  Side side = Side::kClient;             ///< machine on which this end runs
  std::size_t dof = 3;                   ///< number of axes in use, 1 to kAxesMax
  GainScheduleParams schedule;           ///< gains at the tip; `scale` converts them to this port
  AxisArray scale{1, 1, 1, 1, 1, 1, 1};  ///< per axis: diag(J^T J) for joint ports, else 1
  bool effort_half = true;               ///< server: half of the target comes from the received effort
  double e0 = 0.05;                      ///< initial energy E_0 of the ledger, per axis [J]
  double eta = 0.9;                      ///< share of the dissipated energy that may be spent [0, 1]
  double margin_max = 0.1;               ///< unspent energy above this is forfeited, per axis [J]
  double v_app = 0.1;                    ///< approach speed at the tip [m/s]
  double effort_max =
      std::numeric_limits<double>::infinity();  ///< largest useful spring force: the strongest motor's [N at the tip]
  double k_c = 400;  ///< `replica`: stiffness from hand to tool, and to the other seats where no force is fed back [N/m
                     ///< at the tip]
  double impedance = 5;  ///< `wave`: impedance b of the waves [N s/m at the tip]
  double kappa =
      2;  ///< `replica`: largest product of stiffness and round trip where hands share a tool [N s/m at the tip]
  double b_rel = 14;  ///< `replica`: damping relative to the motion that drives the tool [N s/m at the tip]
};

/// The invariants that a law guarantees. Monitors report a breach of any other invariant as expected and do not fail.
struct Guarantees {
  bool ledger = false;        ///< E_out <= E_0 + E_in received + eta D
  bool bounded_step = false;  ///< |dr| <= (|v_rx| + v_app + correction speed of the prediction) T away from x; towards
                              ///< x (yielding to the hand) it may be faster
};

/// Input of one tick. Arrays are per axis of the port; values are in the port's units.
struct EndInput {
  double dt = 0.001;  ///< duration of a tick [s]
  double age = 0;     ///< current age of `rx` [s]
  double weight = 1;  ///< number of equal springs that load this end: 1, except for seats that drive several tools
  AxisArray x{};      ///< position at the near end of the spring: xc at a client, the tool at the server [m or rad]
  AxisArray dissipated{};  ///< heat generated at this end during the last step that may be spent [J]
  double authority = 1;    ///< authority of this seat's hand over its tool [0, 1]; `replica` only
  double slave_pull = 0;   ///< fraction of k_c with which a slave pulls through the reference [0, 1]; `replica` only
  double pass_on = 1;      ///< share of this end's unneeded heat that may be passed to the other end [0, 1]
  PortSample rx{};         ///< port sample of the newest datagram
};

/// Result of one tick. Arrays are per axis of the port; values are in the port's units.
struct EndState {
  AxisArray ref{};   ///< reference r (client) or p (server) [m or rad]
  AxisArray k{};     ///< stiffness to the reference
  AxisArray b{};     ///< damping to add at this end
  AxisArray rate{};  ///< velocity to which that damping is relative [m/s]; 0: ground
  AxisArray led{};   ///< `replica`, server: predicted velocity of the hand without encoder steps, which leads the other
                     ///< hands [m/s]
  AxisArray absorbed{};  ///< energy that this move returned [J]; the owner decides how much becomes credit
  AxisArray paid{};      ///< energy that this move cost [J]
  AxisArray passed{};    ///< heat of this end that was passed to the other end [J]

  /// Returns the energy stored in the spring whose near end is at `x` [J].
  [[nodiscard]] double stored(const AxisArray& x, std::size_t axes) const noexcept {
    double energy = 0;
    for (std::size_t a = 0; a < axes; ++a) {
      const double e = ref[a] - x[a];
      energy += 0.5 * k[a] * e * e;
    }
    return energy;
  }
};

/// Returns a share within [0, 1], and `otherwise` for one that is not a number.
[[nodiscard]] constexpr double unit_share(double share, double otherwise) noexcept {
  return share >= 0 ? (share < 1 ? share : 1) : share < 0 ? 0 : otherwise;
}

/// One end of a channel: holds the reference, the gain schedule and one energy ledger per axis.
class ChannelEnd {
 public:
  /// Starts with all references at 0. @param params  parameters of this end; `dof` is at most kAxesMax
  explicit ChannelEnd(const ChannelParams& params);
  virtual ~ChannelEnd() = default;
  ChannelEnd(const ChannelEnd&) = delete;
  ChannelEnd& operator=(const ChannelEnd&) = delete;

  /// Starts or restarts with zero elongation at `x`. Energy stored in the spring is dropped and never credited.
  /// @param x    position of the near end, per axis
  /// @param age  delay known at this time [s]
  virtual void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME;
  /// Replaces `move` while the other end is silent and this end still pulls. The reference stays where it is, but
  /// within the distance from `x` at which the spring pulls with the strongest motor's force. Energy released by this
  /// clamp is dropped and never credited.
  virtual void clamp_reference(const AxisArray& x) noexcept TANDEM_REALTIME;
  /// Computes the new reference, stiffness and damping; called once per tick. Accepts any input and is real-time safe.
  virtual const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME = 0;
  /// Replaces what this law sends in place of the velocity; most laws send the velocity itself.
  /// @param v  velocity of the near end, per axis; changed in place
  virtual void replace_velocity(AxisArray& v) const noexcept TANDEM_REALTIME;
  /// Returns the invariants that this law guarantees.
  [[nodiscard]] virtual Guarantees guarantees() const noexcept = 0;

  /// Credits absorbed energy [J], which the other end may then spend.
  void credit(std::size_t axis, double joule) noexcept { ledger_[axis].absorb(joule); }
  /// Pays for an action of the owner other than a move of the reference [J]; a negative cost is refunded. @return false
  /// if the margin is too small; nothing is paid then
  [[nodiscard]] bool pay(std::size_t axis, double joule) noexcept {
    if (joule < 0) ledger_[axis].refund(-joule);
    return joule <= 0 || ledger_[axis].spend(joule);
  }
  /// Adds energy [J] that the owner could not pay for, for reports.
  void note_refused(double joule) noexcept { refused_ += joule; }
  /// Result of the last `move`.
  [[nodiscard]] const EndState& state() const noexcept { return state_; }
  /// Returns the energy account of one axis.
  [[nodiscard]] const EnergyLedger& ledger(std::size_t axis) const noexcept { return ledger_[axis]; }
  /// Returns the gains at the present delay.
  [[nodiscard]] const GainSchedule& schedule() const noexcept { return schedule_; }
  /// Energy of moves that were refused [J], cumulative.
  [[nodiscard]] double refused() const noexcept { return refused_; }
  /// Smallest unspent energy so far [J].
  [[nodiscard]] double margin_min() const noexcept { return 1e-9 * static_cast<double>(margin_min_nj_); }
  /// Number of axes in use.
  [[nodiscard]] std::size_t dof() const noexcept { return params_.dof; }
  /// Cumulative energy absorbed at this end, per axis [nJ].
  [[nodiscard]] EnergyArray e_in() const noexcept {
    EnergyArray e{};
    for (std::size_t a = 0; a < params_.dof; ++a) e[a] = ledger_[a].in_nj();
    return e;
  }
  /// Cumulative energy paid at this end, per axis [nJ].
  [[nodiscard]] EnergyArray e_out() const noexcept;

 protected:
  /// Takes the margin of an axis into the smallest one. To be called at the end of its move.
  void note_margin(const EnergyLedger& ledger) noexcept {
    margin_min_nj_ = std::min(margin_min_nj_, ledger.margin_nj());
  }
  /// Laws without a bound on energy: the received position becomes the reference of an axis at stiffness k. The ledger
  /// books the change of the spring's energy and limits nothing.
  void follow_unpaid(const EndInput& in, std::size_t axis, double k) noexcept;

  ChannelParams params_;                         ///< parameters of this end
  GainSchedule schedule_;                        ///< gains at the present delay
  EndState state_;                               ///< result of the last tick
  std::array<EnergyLedger, kAxesMax> ledger_{};  ///< one energy account per axis
  double refused_ = 0;                           ///< energy of refused moves [J]
  std::uint64_t margin_min_nj_ = 0;              ///< smallest margin so far [nJ]
};

/// A law that users select by name. A new law needs a file with its class, a line in channel.cpp and a row in the
/// comparison table.
struct ChannelLaw {
  std::string_view name;     ///< name that users type
  std::string_view summary;  ///< one line for help texts
  /// Makes one end of a channel of this law.
  std::unique_ptr<ChannelEnd> (*make)(const ChannelParams&);
};
/// Returns all laws that users can select.
[[nodiscard]] std::span<const ChannelLaw> channel_laws() noexcept;
/// Returns one end of the named law, or nullptr if no law has this name.
[[nodiscard]] std::unique_ptr<ChannelEnd> make_channel_end(std::string_view law, const ChannelParams& params);

}  // namespace tandem::control

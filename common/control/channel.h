#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "common/base/axes.h"
#include "common/base/port_sample.h"
#include "common/control/energy_ledger.h"
#include "common/control/schedule.h"

/// The network is cut at the reference port: every seat is a spring whose two ends live on two machines (design notes, control 4). A
/// channel law says where this end's reference goes when a datagram came, or none did.
namespace tandem::control {

enum class Side : std::uint8_t { kClient, kServer };

struct ChannelParams {
  Side side = Side::kClient;
  std::size_t dof = 3;
  ScheduleParams schedule;      ///< tip gains; `scale` turns them into this port's
  AxisArray scale{1, 1, 1, 1, 1, 1, 1};  ///< diag(J^T J) for joint ports, else 1
  bool effort_half = true;
  double e0 = 0.05;             ///< [J] per axis
  double eta = 0.9;
  double margin_max = 0.1;      ///< [J] per axis
  double v_app = 0.1;           ///< at the tip [m/s]
  double effort_max = std::numeric_limits<double>::infinity();  ///< a spring need not pull harder: no motor could [N at the tip]
  double k_c = 400;             ///< `replica`: between hand and tool, and to the others where nothing is fed back [N/m at the tip]
  double b_rel = 14;            ///< `replica`: damping relative to what drives the tool [N s/m at the tip]
};

/// What a law promises; a breach of anything else is reported as expected and fails nothing.
struct Promises {
  bool ledger = false;          ///< E_out <= E_0 + E_in received + eta D
  bool bounded_step = false;    ///< |dr| <= (|v_rx| + v_app + what a prediction gains) T away from x; giving way to a hand is faster
};

struct EndInput {
  double dt = 0.001;            ///< tick [s]
  double age = 0;               ///< of `rx`, now [s]
  double weight = 1;            ///< how many such springs this end loads: 1 but for seats that drive several tools
  AxisArray x{};                ///< what hangs on the near end of the spring: xc at a client, the tool at the server
  AxisArray dissipated{};       ///< heat made here during the last step that may be spent [J]
  double authority = 1;         ///< of this seat's hand over its tool [0, 1]; `replica` only
  double slave_pull = 0;        ///< part of k_c with which a slave pulls by way of the reference [0, 1]; `replica` only
  double pass_on = 1;           ///< share of this end's heat the other end may have when it is not needed here [0, 1]
  PortSample rx{};              ///< newest datagram's port
};

struct EndState {
  AxisArray ref{};              ///< reference r (client) or p (server)
  AxisArray k{};                ///< stiffness to it
  AxisArray b{};                ///< damping to be added at this end
  AxisArray rate{};             ///< velocity which that damping is relative to [m/s]; 0: the ground
  AxisArray led{};              ///< `replica`, server: velocity of the hand by now, without the encoder's steps; others are led by it [m/s]
  AxisArray absorbed{};         ///< energy this move gave back [J]; the owner decides how much becomes credit
  AxisArray paid{};             ///< energy this move cost [J]
  AxisArray passed{};           ///< heat of this end that was passed on [J]
};

class ChannelEnd {
 public:
  explicit ChannelEnd(const ChannelParams& params);
  virtual ~ChannelEnd() = default;
  ChannelEnd(const ChannelEnd&) = delete;
  ChannelEnd& operator=(const ChannelEnd&) = delete;

  /// Starts, or starts again, with zero elongation: whatever the spring held is dropped, never credited.
  virtual void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME;
  /// In place of `move` while the other end is silent and this end still pulls: the reference stays where it is, but never farther
  /// from `x` than the strongest motor could pull. What giving way frees is dropped, never credited.
  virtual void give_way(const AxisArray& x) noexcept TANDEM_REALTIME;
  /// Once per tick: new reference, stiffness and damping. Total and real-time safe.
  virtual const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME = 0;
  [[nodiscard]] virtual Promises promises() const noexcept = 0;

  /// Turns absorbed energy into credit the other end may spend [J].
  void credit(std::size_t axis, double joule) noexcept { ledger_[axis].absorb(joule); }
  /// Pays for what the owner does beside moving the reference; a negative cost comes back [J]. @return false: not paid, the margin is too small
  [[nodiscard]] bool pay(std::size_t axis, double joule) noexcept {
    if (joule < 0) ledger_[axis].take_back(-joule);
    return joule <= 0 || ledger_[axis].spend(joule);
  }
  void note_refused(double joule) noexcept { refused_ += joule; }
  [[nodiscard]] const EndState& state() const noexcept { return state_; }
  [[nodiscard]] const EnergyLedger& ledger(std::size_t axis) const noexcept { return ledger_[axis]; }
  [[nodiscard]] const DelaySchedule& schedule() const noexcept { return schedule_; }
  [[nodiscard]] double refused() const noexcept { return refused_; }        ///< [J], cumulative
  [[nodiscard]] double margin_min() const noexcept { return margin_min_; }  ///< smallest unspent energy so far [J]
  [[nodiscard]] std::size_t dof() const noexcept { return params_.dof; }
  [[nodiscard]] EnergyArray e_in() const noexcept {
    EnergyArray e{};
    for (std::size_t a = 0; a < params_.dof; ++a) e[a] = ledger_[a].in_nj();
    return e;
  }
  [[nodiscard]] EnergyArray e_out() const noexcept;

 protected:
  /// Where the reference would go if energy were free (design notes, control 4, "lead" and "effort half").
  [[nodiscard]] double target(const EndInput& in, std::size_t a, double k) const noexcept {
    const double ahead = in.rx.x[a] + schedule_.lead(in.age) * in.rx.v[a];
    const double d = schedule_.delay();
    // Force feed-forward under the same certificate: the ledger bounds any target, so targets may be mixed freely.
    const bool mix = params_.side == Side::kServer && params_.effort_half && d >= DelaySchedule::kShort && d <= 0.25;
    return mix ? 0.5 * ahead + 0.5 * (in.x[a] + in.rx.f[a] / k) : ahead;
  }

  ChannelParams params_;
  DelaySchedule schedule_;
  EndState state_;
  std::array<EnergyLedger, kAxesMax> ledger_{};
  double refused_ = 0;
  double margin_min_ = 0;
};

/// A law people can choose by name. Adding one: a file with its class, a line in channel.cpp, a row in the comparison table.
struct ChannelLaw {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<ChannelEnd> (*make)(const ChannelParams&);
};
[[nodiscard]] std::span<const ChannelLaw> channel_laws() noexcept;
/// @return nullptr if no law has this name.
[[nodiscard]] std::unique_ptr<ChannelEnd> make_channel_end(std::string_view law, const ChannelParams& params);

}  // namespace tandem::control

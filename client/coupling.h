#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/base/local_contact.h"
#include "common/control/channel.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"
#include "proto/seat_setup.h"
#include "proto/wire.h"

namespace tandem::client {

/// What stands between a seat's device and its end of the channel. Real-time safe after construction.
class Coupling {
 public:
  /// One tool that the hand is tied to: this client's end of the channel, and what the server said last. Law `replica` has one for each tool
  /// that the hand follows, the other laws one for all.
  struct Tie {
    control::ChannelEnd* end = nullptr;
    const wire::TieForce* told = nullptr;
  };
  struct Input {
    double dt = 0.001;
    double age = 0;       ///< of what was told, now [s]
    const AxisArray& q;   ///< of the device's port
    const AxisArray& v;
    std::span<const Tie> ties;  ///< as many as `SeatSetup` says
    const wire::Ghost* ghost = nullptr;  ///< as told; of the first tool's leader
  };
  virtual ~Coupling() = default;
  /// Not engaged: begins, or begins again, without elongation. @param told  the server said where its tools are
  virtual void rest(const Input& in, bool told) noexcept TANDEM_REALTIME = 0;
  /// @return the effort wanted on the device, before the gate
  [[nodiscard]] virtual AxisArray step(const Input& in) noexcept TANDEM_REALTIME = 0;
  /// The server named these surfaces now, near the tool of tie k. @pre each is_surface and in_range
  virtual void hear(std::size_t, std::span<const LocalContact>) noexcept TANDEM_REALTIME {}
  /// What the gate let through of it.
  virtual void delivered(const AxisArray&) noexcept TANDEM_REALTIME {}
  /// What the server is told of tie k: x, v, f, a. @param engaged  else the device's own motion
  virtual void tell(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept TANDEM_REALTIME = 0;
  /// The copy of tie k's tool that the hand hangs on, where there is one.
  [[nodiscard]] virtual const control::VirtualTool* copy(std::size_t = 0) const noexcept { return nullptr; }
  /// The pull towards the leader's hand, where there is one [N].
  [[nodiscard]] virtual double assist_force() const noexcept { return 0; }
  [[nodiscard]] double dissipated() const noexcept { return dissipated_; }  ///< all axes, cumulative [J]

 protected:
  double dissipated_ = 0;
};

/// By the law of the channel and the kind of the seat.
[[nodiscard]] std::unique_ptr<Coupling> make_coupling(const SeatSetup& setup);

/// A hand on device - k_c - virtual mass - k - reference; a slave's device directly on k, so that a remote slave is the server's own slave
/// but for the extra tick.
class SpringCoupling final : public Coupling {
 public:
  explicit SpringCoupling(const SeatSetup& setup);
  void rest(const Input& in, bool told) noexcept override;
  AxisArray step(const Input& in) noexcept override;
  void tell(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept override;

 private:
  std::size_t dof_;
  bool master_;
  std::array<control::MasterIpc, kAxesMax> ipc_{};
  std::array<control::MasterIpc::Gains, kAxesMax> gains_{};
};

/// A hand on copies of its tools, law `replica`: it feels sum_j C_j F_j of copies that each are as if they were alone. Energy too is that
/// sum, so a hand that is given no more than was paid by each copy is given no more than was paid.
class CopyCoupling final : public Coupling {
 public:
  explicit CopyCoupling(const SeatSetup& setup);
  void rest(const Input& in, bool told) noexcept override;
  AxisArray step(const Input& in) noexcept override;
  void hear(std::size_t k, std::span<const LocalContact> contacts) noexcept override { copies_[k].tool.hear(contacts); }
  void delivered(const AxisArray& effort) noexcept override;
  void tell(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept override;
  [[nodiscard]] const control::VirtualTool* copy(std::size_t k = 0) const noexcept override { return k < copies_.size() ? &copies_[k].tool.tool() : nullptr; }
  [[nodiscard]] double assist_force() const noexcept override { return copies_[0].weight * copies_[0].tool.assist().force(); }

 private:
  struct Copy {
    control::ToolCopy tool;
    double weight = 1;    ///< C_j: of its force in what the hand feels
    AxisArray wanted{};   ///< of this copy alone [N]
    AxisArray effort{};   ///< what was delivered of it [N]
  };
  [[nodiscard]] const AxisArray& wanted_of(Copy& copy, const Tie& tie, const Input& in) noexcept;

  std::size_t dof_;
  std::vector<Copy> copies_;
  AxisArray wanted_{};       ///< in all
  double share_ = 0;         ///< of it that was delivered last [0, 1]
};

}  // namespace tandem::client

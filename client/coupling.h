#pragma once

#include <array>
#include <memory>
#include <span>

#include "common/base/local_contact.h"
#include "common/control/channel.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"
#include "proto/seat_setup.h"

namespace tandem::client {

/// What stands between a seat's device and its end of the channel. Real-time safe after construction.
class Coupling {
 public:
  struct Input {
    double dt = 0.001;
    double age = 0;       ///< of `rx`, now [s]
    double authority = 0; ///< of this hand
    double slave_pull = 0;  ///< of a SLAVE seat's device, by way of the reference (wire::ForceMessage)
    AxisArray q{}, v{};   ///< of the device's port
    const PortSample* rx = nullptr;
    const wire::Ghost* ghost = nullptr;  ///< as heard with `rx`
  };
  virtual ~Coupling() = default;
  /// Not engaged: begins, or begins again, without elongation. @param tool  where the server's tool is, if it was told
  virtual void rest(const AxisArray& q, const AxisArray* tool, double age, control::ChannelEnd& end) noexcept TANDEM_REALTIME = 0;
  /// @return the effort wanted on the device, before the gate
  [[nodiscard]] virtual AxisArray step(const Input& in, control::ChannelEnd& end) noexcept TANDEM_REALTIME = 0;
  /// The server named these surfaces now. @pre each is_surface and in_range
  virtual void hear(std::span<const LocalContact>) noexcept TANDEM_REALTIME {}
  /// What the gate let through of it.
  virtual void delivered(const AxisArray&) noexcept TANDEM_REALTIME {}
  /// What the server is told: x, v, f, a. @param engaged  else the device's own motion
  virtual void tell(const AxisArray& q, const AxisArray& v, bool engaged, const control::ChannelEnd& end, PortSample& out) const noexcept TANDEM_REALTIME = 0;
  /// The copy of the tool that the hand hangs on, where there is one.
  [[nodiscard]] virtual const control::VirtualTool* copy() const noexcept { return nullptr; }
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
  void rest(const AxisArray& q, const AxisArray* tool, double age, control::ChannelEnd& end) noexcept override;
  AxisArray step(const Input& in, control::ChannelEnd& end) noexcept override;
  void tell(const AxisArray& q, const AxisArray& v, bool engaged, const control::ChannelEnd& end, PortSample& out) const noexcept override;

 private:
  std::size_t dof_;
  bool master_;
  std::array<control::MasterIpc, kAxesMax> ipc_{};
  std::array<control::MasterIpc::Gains, kAxesMax> gains_{};
};

/// A hand on a copy of the tool, law `replica`.
class CopyCoupling final : public Coupling {
 public:
  explicit CopyCoupling(const SeatSetup& setup);
  void rest(const AxisArray& q, const AxisArray* tool, double age, control::ChannelEnd& end) noexcept override;
  AxisArray step(const Input& in, control::ChannelEnd& end) noexcept override;
  void hear(std::span<const LocalContact> contacts) noexcept override { copy_.hear(contacts); }
  void delivered(const AxisArray& effort) noexcept override;
  void tell(const AxisArray& q, const AxisArray& v, bool engaged, const control::ChannelEnd& end, PortSample& out) const noexcept override;
  [[nodiscard]] const control::VirtualTool* copy() const noexcept override { return &copy_.tool(); }
  [[nodiscard]] double assist_force() const noexcept override { return copy_.assist().force(); }

 private:
  std::size_t dof_;
  control::ToolCopy copy_;
  AxisArray effort_{};
};

}  // namespace tandem::client

#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/base/local_contact.h"
#include "common/control/channel.h"
#include "common/control/ipc.h"
#include "common/control/tool_copy.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// The dynamics between a seat's device and its channel ends. Real-time safe after construction. Arrays are in port
/// axes: position [m or rad], velocity [m/s or rad/s], effort [N or N m].
class Coupling {
 public:
  /// Coupling of the seat to one tool: this client's channel end and the newest received values. Law `replica` has one
  /// for each tool that the seat follows, the other laws have one in total.
  struct Tool {
    control::ChannelEnd* end = nullptr;
    const wire::ToolForce* received = nullptr;
  };
  struct Input {
    double dt = 0.001;
    double age = 0;                      ///< age of the received values [s]
    const AxisArray& q;                  ///< position of the device's port
    const AxisArray& v;                  ///< velocity of the device's port
    std::span<const Tool> tools;         ///< 1 + SeatSetup::further.size()
    const wire::Ghost* ghost = nullptr;  ///< received leader of the first tool
    /// Part of the force on the tool that is not the hand's, taken out of samples (client/seat/force_separation.h) [N];
    /// null: nothing is
    const AxisArray* device_force = nullptr;
  };
  virtual ~Coupling() = default;
  /// Restarts the coupling without elongation; called while the seat is not engaged.
  /// @param heard true once a FORCE arrived, so that the received tool positions are valid
  virtual void reset(const Input& in, bool heard) noexcept TANDEM_REALTIME = 0;
  /// Advances by one tick. @return the effort wanted on the device, before the gate
  [[nodiscard]] virtual AxisArray step(const Input& in) noexcept TANDEM_REALTIME = 0;
  /// Sets the contact surfaces that the server sent for tool k. @pre each is_surface and in_range
  virtual void set_contacts(std::size_t, std::span<const LocalContact>) noexcept TANDEM_REALTIME {}
  /// Sets the part of the effort from `step` that passed the gate.
  virtual void set_delivered(const AxisArray&) noexcept TANDEM_REALTIME {}
  /// Gives up a share of the wanted effort per axis, [0, 1]: the gate ramps in and holds it back.
  virtual void yield(const AxisArray&) noexcept TANDEM_REALTIME {}
  /// Writes position, velocity, force and acceleration of tool k into the sample for the server.
  /// @param engaged  false: the sample contains the motion of the device itself
  virtual void fill_sample(std::size_t k, const Input& in, bool engaged,
                           PortSample& out) const noexcept TANDEM_REALTIME = 0;
  /// Local copy of tool k; nullptr for laws without copies.
  [[nodiscard]] virtual const control::VirtualTool* tool_copy(std::size_t = 0) const noexcept { return nullptr; }
  /// Assist force towards the leader [N]; 0 without one.
  [[nodiscard]] virtual double assist_force() const noexcept { return 0; }
  [[nodiscard]] double dissipated() const noexcept { return dissipated_; }  ///< all axes, cumulative [J]

 protected:
  double dissipated_ = 0;
};

/// Returns a CopyCoupling for master seats of law `replica`, a SpringCoupling for all others.
[[nodiscard]] std::unique_ptr<Coupling> make_coupling(const SeatSetup& setup);

/// Spring coupling: for a master seat the chain device - k_c - virtual mass - k - reference. The device of a SLAVE seat
/// is attached directly to k. A remote slave therefore behaves as a local slave of the server with one extra tick.
class SpringCoupling final : public Coupling {
 public:
  explicit SpringCoupling(const SeatSetup& setup);
  void reset(const Input& in, bool heard) noexcept override;
  AxisArray step(const Input& in) noexcept override;
  void fill_sample(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept override;

 private:
  std::size_t dof_;
  bool master_;
  std::array<control::MasterIpc, kAxesMax> ipc_{};
  std::array<control::MasterIpc::Gains, kAxesMax> gains_{};
};

/// Coupling of a master seat to local copies of its tools, law `replica`. The effort is sum_j C_j F_j; each copy j is
/// simulated independently of the others. Energy is the same sum, so a seat whose copies each receive at most the
/// energy paid for them receives at most the total energy paid.
class CopyCoupling final : public Coupling {
 public:
  explicit CopyCoupling(const SeatSetup& setup);
  void reset(const Input& in, bool heard) noexcept override;
  AxisArray step(const Input& in) noexcept override;
  void set_contacts(std::size_t k, std::span<const LocalContact> contacts) noexcept override {
    copies_[k].tool.update_contacts(contacts);
  }
  void set_delivered(const AxisArray& effort) noexcept override;
  void yield(const AxisArray& part) noexcept override;
  void fill_sample(std::size_t k, const Input& in, bool engaged, PortSample& out) const noexcept override;
  [[nodiscard]] const control::VirtualTool* tool_copy(std::size_t k = 0) const noexcept override {
    return k < copies_.size() ? &copies_[k].tool.tool() : nullptr;
  }
  [[nodiscard]] double assist_force() const noexcept override {
    return copies_[0].weight * copies_[0].tool.assist().force();
  }

 private:
  struct Copy {
    control::ToolCopy tool;
    double weight = 1;   ///< C_j, share of this copy's force in the effort of the seat
    AxisArray wanted{};  ///< wanted effort of this copy alone [N]
    AxisArray effort{};  ///< delivered part of it [N]
  };
  [[nodiscard]] const AxisArray& wanted_of(Copy& copy, const Tool& tool, const Input& in) noexcept;

  std::size_t dof_;
  double k_c_;  ///< hand to tool, at the tool [N/m]
  std::vector<Copy> copies_;
  AxisArray wanted_{};  ///< total wanted effort [N]
  double share_ = 0;    ///< share of it that was delivered last [0, 1]
};

}  // namespace tandem::client

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "client/seat/coupling.h"
#include "common/base/axes.h"
#include "common/base/time.h"
#include "common/control/channel.h"
#include "common/control/send_pace.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// The tools that a seat is coupled to: for each one its channel end, the newest received values and the values to
/// send. A seat has one tool, or under law `replica` one for each tool that it follows. After construction only
/// `make_ends` allocates.
class ToolChannels {
 public:
  using Ends = std::vector<std::unique_ptr<control::ChannelEnd>>;

  /// @throws std::runtime_error if the law is unknown.
  explicit ToolChannels(const SeatSetup& setup);
  ToolChannels(const ToolChannels&) = delete;  // tools_ points into this object
  ToolChannels& operator=(const ToolChannels&) = delete;

  /// Returns new channel ends for one connection. Allocates. Any thread may call it.
  [[nodiscard]] static Ends make_ends(const SeatSetup& setup);
  /// Replaces the channel ends by those of a new connection. @param ends  holds the old ones afterwards
  void swap_ends(Ends& ends) noexcept TANDEM_REALTIME;
  /// Drops the received values.
  void clear_received() noexcept TANDEM_REALTIME;

  /// Place for the values of the tools beyond the first of a FORCE that is being decoded, so that a datagram rejected
  /// half way changes nothing.
  [[nodiscard]] std::span<wire::ToolForce> further_next() noexcept { return further_next_; }
  /// Takes a decoded FORCE, and the values in `further_next`.
  void receive(const wire::ForceMessage& force) noexcept TANDEM_REALTIME;

  /// Advances the received samples, and the leader's hand, to what the server expects this client to predict.
  /// @param silence  time since the newest FORCE arrived
  void predict(control::HeldSample& held, Duration silence) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::size_t size() const noexcept { return tools_.size(); }
  [[nodiscard]] std::span<const Coupling::Tool> all() const noexcept { return tools_; }
  /// Channel end and newest received values of one tool. @pre tool < size()
  [[nodiscard]] control::ChannelEnd& end(std::size_t tool) const noexcept { return *ends_[tool]; }
  [[nodiscard]] const wire::ToolForce& received(std::size_t tool) const noexcept { return *tools_[tool].received; }
  /// The newest FORCE. `heard` is false until one arrived on this connection; all its values are then zero.
  [[nodiscard]] const wire::ForceMessage& force() const noexcept { return force_; }
  [[nodiscard]] bool heard() const noexcept { return heard_; }
  /// Largest authority of this seat over any of its tools, in [0, 1].
  [[nodiscard]] double authority() const noexcept;

  /// Values to send for the tools beyond the first.
  [[nodiscard]] std::span<PortSample> further_samples() noexcept { return further_samples_; }
  [[nodiscard]] std::span<const PortSample> further_samples() const noexcept { return further_samples_; }
  /// Writes the energies of the channel ends into `out`.
  void fill(wire::Telemetry& out) const noexcept TANDEM_REALTIME;

 private:
  void bind() noexcept;

  std::vector<double> weights_;  ///< of each tool's force in the force on the seat
  Ends ends_;
  wire::ForceMessage force_{};  ///< its base holds the values of the first tool
  std::vector<wire::ToolForce> further_, further_next_;
  std::vector<PortSample> further_samples_;
  std::vector<Coupling::Tool> tools_;
  bool heard_ = false;
};

}  // namespace tandem::client

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/control/channel.h"
#include "common/transport/secure_channel.h"
#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "proto/text/seat_setup.h"

namespace tandem::server {

enum class JoinResult : std::uint8_t {
  kAccepted,
  kNoSuchSeat,
  kSeatTaken,
  kDeviceUnfit,
  kSessionOver,
  kBusy,  ///< the shard has no place for another question now
};

/// Resources of one client at one seat: channel and spring ends. They are allocated outside the real-time path; the
/// session's thread only swaps them in.
struct SeatConnection {
  std::unique_ptr<transport::SecureChannel> link;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends;
  std::array<std::byte, 32> resume{};  ///< resume_hash of the client's resume secret; zero: none
  double force_scale = 1;              ///< of the client's ticket, 0 to 1; kept for a resume
  tandem::rpc::DeviceFacts device{};   ///< for which the ends were made
};

/// Server ends of a seat's springs as the scene defines them: one per tool for masters under law REPLICA, one for all
/// tools otherwise.
/// @param scale  tip gain to port gain at the working pose, per axis
[[nodiscard]] std::vector<std::unique_ptr<control::ChannelEnd>> make_channel_ends(const SceneSpec& scene,
                                                                                  std::size_t seat,
                                                                                  const AxisArray& scale);

/// The constant facts about a session's seats, readable on any thread. The control plane answers join requests from
/// it: which seats exist, which devices fit, what a client must know, and the client's resources. Only the session
/// knows whether a seat is free.
class SeatCatalogue {
 public:
  /// @param scene  must outlive this
  /// @param scale  tip gain to port gain at the working pose, per axis
  SeatCatalogue(const SceneSpec& scene, const AxisArray& scale);

  [[nodiscard]] std::optional<std::size_t> seat_named(std::string_view name) const noexcept;
  /// Names of all seats, separated by spaces, for messages.
  [[nodiscard]] std::string seat_names() const;
  /// Why this device cannot be used in this session; empty if it can.
  [[nodiscard]] std::string device_incompatibility(const tandem::rpc::DeviceFacts& device) const;
  /// Setup of a seat as the scene defines it, for any device.
  [[nodiscard]] const SeatSetup& setup(std::size_t seat) const noexcept { return setups_[seat]; }
  /// Setup of a seat for this device: its spring is limited to the stiffness that the device can render.
  [[nodiscard]] SeatSetup setup_for(std::size_t seat, const tandem::rpc::DeviceFacts& device) const;
  /// Message for the operator about a spring that was softened for this device; empty if none was.
  [[nodiscard]] std::string softened_spring_text(std::size_t seat, const tandem::rpc::DeviceFacts& device) const;
  /// @param link    with the ids and the secrets of this join
  /// @param device  both ends use the stiffness that it can render
  [[nodiscard]] SeatConnection make_connection(std::size_t seat, transport::SecureChannel::Params link,
                                               const tandem::rpc::DeviceFacts& device) const;
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  /// Interval between two datagrams of a seat.
  [[nodiscard]] Duration tick() const noexcept { return from_seconds(1.0 / scene_->tick_hz); }

 private:
  const SceneSpec* scene_;
  AxisArray scale_;
  std::vector<SeatSetup> setups_;
};

}  // namespace tandem::server

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
#include "common/link/link.h"
#include "proto/scene_spec.h"
#include "proto/seat_setup.h"
#include "proto/control_messages.h"

namespace tandem::server {

enum class JoinResult : std::uint8_t { kAccepted, kNoSuchSeat, kSeatTaken, kDeviceUnfit, kSessionOver };

/// A seat's place in the session for one client, made where memory may be taken; the session's own thread only puts it in.
struct Entry {
  std::unique_ptr<link::Link> link;
  std::vector<std::unique_ptr<control::ChannelEnd>> ends;
  std::array<std::byte, 32> resume{};  ///< resume_hash of the secret this client may come back with; zero: none
  double force_scale = 1;              ///< its ticket's, told to the client; kept for when it comes back
};

/// The server's end of a seat's spring, as the scene asks for it: one for all tools, or one for each where law REPLICA predicts a hand for each.
[[nodiscard]] std::vector<std::unique_ptr<control::ChannelEnd>> make_channel_ends(const SceneSpec& scene, std::size_t seat, const AxisArray& scale);

/// Who asks for a seat is answered from what never changes in a session, on any thread: which seats there are, who fits, what a client
/// must know, and the entry itself. Whether the seat is free only the session knows.
class Reception {
 public:
  /// @param scene  must outlive this  @param scale  tip gain to port gain at the working pose, per axis
  Reception(const SceneSpec& scene, const AxisArray& scale);

  [[nodiscard]] std::optional<std::size_t> seat_named(std::string_view name) const noexcept;
  /// The names of all seats, for a person.
  [[nodiscard]] std::string seat_names() const;
  /// Why this device may not sit in this session; empty when it may.
  [[nodiscard]] std::string unfit(const tandem::control::DeviceFacts& device) const;
  /// As the scene asks for it, whatever device comes.
  [[nodiscard]] const SeatSetup& setup(std::size_t seat) const noexcept { return setups_[seat]; }
  /// For this device: its spring no stiffer than the device renders.
  [[nodiscard]] SeatSetup setup_for(std::size_t seat, const tandem::control::DeviceFacts& device) const;
  /// What the operator is told of that spring; empty where the device renders what the scene asks for.
  [[nodiscard]] std::string softened_words(std::size_t seat, const tandem::control::DeviceFacts& device) const;
  /// @param link  with the ids and the secrets of this joining  @param device  both ends reckon with the spring it renders
  [[nodiscard]] Entry prepare(std::size_t seat, link::Link::Params link, const tandem::control::DeviceFacts& device) const;
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  /// Between two datagrams of a seat.
  [[nodiscard]] Duration tick() const noexcept { return from_seconds(1.0 / scene_->tick_hz); }

 private:
  const SceneSpec* scene_;
  AxisArray scale_;
  std::vector<SeatSetup> setups_;
};

}  // namespace tandem::server

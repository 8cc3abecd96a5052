#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/sim/hand.h"
#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/devices/falcon_mechanics.h"
#include "tests/hal/emulation/devices/ftdi_model.h"

namespace tandem::hal::emulation {

/// Faults from now on. Counts decrease as they are used up.
struct FalconFaults {
  int deaf_greetings = 0;                              ///< greetings that the boot loader does not answer
  int wrong_echoes = 0;                                ///< image bytes echoed with one bit flipped
  int dead_loads = 0;                                  ///< images that are accepted but do not run
  int frozen_loads = 0;                                ///< images that run, but whose encoders never change
  bool leading_zero = false;                           ///< the boot loader's replies begin with 00
  bool leading_13 = false;                             ///< 13 41 instead of 41
  bool never_cts = false;                              ///< CTS is not raised for the image's speed
  bool needs_cts = false;                              ///< bytes received before CTS is raised are lost
  int stall_out = 0, stall_in = 0, stall_control = 0;  ///< transfers answered with STALL
  int short_replies = 0;                               ///< replies without their last two bytes
  int glued_replies = 0;    ///< replies that are held back and sent together with the next one
  int split_replies = 0;    ///< replies whose second half is sent with the next one
  int noise_bytes = 0;      ///< random bytes before the next reply
  int line_errors = 0;      ///< replies for which the bridge reports lost bytes
  int flipped_replies = 0;  ///< replies with one byte made illegal
  int lost_replies = 0;     ///< replies that are never sent
  bool silent = false;      ///< no replies at all
  int jump_counts = 0;      ///< counts added to leg 1 in the next reply only
  Duration late{};          ///< delay of each reply before it is sent
};

struct FalconModelSpec {
  FalconMechanicsSpec mechanics;
  FalconFlagBits bits;
  std::size_t image_bytes = 7324;  ///< size of the image that runs; others are accepted and do nothing
  bool running = false;            ///< the firmware is loaded already
  bool homed = false;              ///< the device is homed already
};

/// Model of a Novint Falcon at the bus: FTDI bridge, boot loader, firmware in lock-step frames. Homing by pulling the
/// grip out and pushing it in; a tip held by a hand.
/// The motors keep their last values when frames stop or the cable is unplugged. No watchdog of the device is known, so
/// tests must assume the worst case.
class FalconModel final : public EmulatedUsbDevice {
 public:
  /// A command of the host, with its arrival in the model's time.
  struct HostFrame {
    Time at{};
    std::array<std::int16_t, 3> motor{};
  };
  static constexpr std::size_t kRemembered = 256;

  explicit FalconModel(const FalconModelSpec& spec = {});

  void advance(Duration dt) noexcept override;
  void unplug() noexcept override;
  void plug_in() noexcept override;
  [[nodiscard]] bool plugged_in() const noexcept override { return plugged_in_; }
  /// Interrupts the external supply: motors off, firmware and origin lost.
  void lose_power() noexcept;

  [[nodiscard]] std::span<const std::byte> device_descriptor() const noexcept override;
  [[nodiscard]] std::span<const std::byte> config_descriptor() const noexcept override;
  [[nodiscard]] std::string_view string(std::uint8_t index) const noexcept override;
  TransferResult control(const SetupPacket& setup, std::span<std::byte> data) noexcept override;
  TransferResult bulk_out(std::uint8_t ep, std::span<const std::byte> bytes) noexcept override;
  TransferResult bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept override;

  /// Sets the hand that holds the grip, updated once a millisecond. Without it the force law of `mechanics()` applies.
  void set_hand(std::unique_ptr<sim::Hand> hand) noexcept { hand_ = std::move(hand); }
  [[nodiscard]] sim::Hand* hand() noexcept { return hand_.get(); }
  [[nodiscard]] FalconMechanics& mechanics() noexcept { return mechanics_; }
  void set_buttons(std::uint8_t mask) noexcept { buttons_ = mask; }
  /// Clears the homed flags of the legs in `mask`; they return only after the homing bit was off for a frame.
  void drop_homed(std::uint8_t mask) noexcept;
  FalconFaults faults;

  // Observations for tests.
  [[nodiscard]] bool running() const noexcept { return state_ == State::kRunning; }
  [[nodiscard]] std::uint8_t homed() const noexcept { return homed_; }
  [[nodiscard]] const FalconCommand& order() const noexcept { return order_; }  ///< newest frame received
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }       ///< complete frames received
  /// Returns the frame `back` places before the newest; back < min(frames(), kRemembered).
  [[nodiscard]] const HostFrame& host_frame(std::size_t back) const noexcept {
    return remembered_[(frames_ + kRemembered - 1 - back) % kRemembered];
  }
  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] std::uint64_t bad_frames() const noexcept { return bad_frames_; }
  /// Returns the number of frames with force while not all legs were homed; it must stay 0.
  [[nodiscard]] std::uint64_t unsafe_frames() const noexcept { return unsafe_frames_; }
  [[nodiscard]] std::uint64_t loads() const noexcept { return loads_; }  ///< complete images received
  [[nodiscard]] const std::vector<std::byte>& image() const noexcept { return image_; }

 private:
  enum class State : std::uint8_t { kBootLoader, kGreeted, kLoading, kRunning };

  void step(Duration h) noexcept;
  void take_line_changes() noexcept;
  void take(std::byte b) noexcept;
  void take_boot(std::byte b) noexcept;
  void take_image(std::byte b) noexcept;
  void take_frame(const FalconCommand& order) noexcept;
  void answer() noexcept;
  void find_origins() noexcept;
  void send(std::span<const std::byte> bytes) noexcept;

  Time now_{};
  FalconModelSpec spec_;
  FtdiModel line_;
  FalconMechanics mechanics_;
  std::unique_ptr<sim::Hand> hand_;
  bool plugged_in_ = true;
  bool halted_out_ = false, halted_in_ = false;
  Duration hand_left_{};

  State state_ = State::kBootLoader;
  std::uint64_t pulses_seen_ = 0;
  std::array<std::byte, 3> heard_{};  ///< the boot loader's last bytes
  std::vector<std::byte> image_;
  Duration cts_in_{};  ///< until CTS is raised
  bool cts_ = false;

  FalconFramer framer_;
  FalconCommand order_;
  std::uint8_t homed_ = 0, out_seen_ = 0;
  bool wants_edge_ = false;  ///< flags were dropped: the homing bit must be off for one frame
  bool frozen_ = false;
  std::array<std::int16_t, 3> frozen_at_{};
  std::uint8_t buttons_ = 0;
  std::array<std::byte, 4 * kFalconFrame> kept_{};
  std::size_t kept_size_ = 0;
  std::array<std::byte, 4 * kFalconFrame> delayed_{};
  std::size_t delayed_size_ = 0;
  Duration delayed_for_{};

  std::uint64_t frames_ = 0, bad_frames_ = 0, unsafe_frames_ = 0, loads_ = 0;
  std::array<HostFrame, kRemembered> remembered_{};
};

}  // namespace tandem::hal::emulation

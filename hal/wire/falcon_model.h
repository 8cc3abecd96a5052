#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/falcon/falcon_frame.h"
#include "hal/sim/hand.h"
#include "hal/wire/falcon_mechanics.h"
#include "hal/wire/ftdi_model.h"
#include "hal/wire/wire_model.h"

namespace tandem::hal::wire {

/// What shall go wrong, from now on. Counts go down by themselves as they are used up.
struct FalconFaults {
  int deaf_greetings = 0;   ///< greetings of the boot loader that find no answer
  int wrong_echoes = 0;     ///< image bytes that come back with one bit flipped
  int dead_loads = 0;       ///< images that are taken, but do not run
  int frozen_loads = 0;     ///< images that run, but whose encoders never change
  bool leading_zero = false;   ///< the boot loader's answers begin with 00
  bool leading_13 = false;     ///< 13 41 instead of 41
  bool never_cts = false;      ///< CTS is not raised for the image's speed
  bool needs_cts = false;      ///< what comes before CTS is up is lost
  int stall_out = 0, stall_in = 0, stall_control = 0;  ///< transfers that meet a stall
  int short_replies = 0;    ///< answers without their last two bytes
  int glued_replies = 0;    ///< answers that are kept back and sent together with the next one
  int split_replies = 0;    ///< answers of which the second half comes with the next one
  int noise_bytes = 0;      ///< rubbish before the next answer
  int line_errors = 0;      ///< answers with which the bridge says that it lost bytes
  int flipped_replies = 0;  ///< answers with one byte made illegal
  int lost_replies = 0;     ///< answers that never come
  bool silent = false;      ///< no answers at all
  int jump_counts = 0;      ///< added to leg 1 in the next answer only
  Duration late{};          ///< each answer waits so long before it is put on the line
};

struct FalconModelSpec {
  FalconMechanicsSpec mechanics;
  FalconFlagBits bits;
  std::size_t image_bytes = 7324;  ///< the image that runs; others are taken and do nothing
  bool running = false;            ///< its firmware is loaded already
  bool homed = false;              ///< and it is homed
};

/// Novint Falcon as the bus sees it: FTDI bridge, boot loader, firmware in lock-step frames, homing by pulling the grip out
/// and pushing it in, and a tip that a hand holds. The motors keep their last values when frames stop or the cable is
/// pulled: nothing is known of a watchdog in the device, so tests must assume the worst.
class FalconModel final : public UsbWireModel {
 public:
  /// What the host ordered, and when in the model's time.
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
  /// The external supply is pulled and put back: motors off, firmware and origin forgotten.
  void lose_power() noexcept;

  [[nodiscard]] std::span<const std::byte> device_descriptor() const noexcept override;
  [[nodiscard]] std::span<const std::byte> config_descriptor() const noexcept override;
  [[nodiscard]] std::string_view string(std::uint8_t index) const noexcept override;
  WireMoved control(const SetupPacket& setup, std::span<std::byte> data) noexcept override;
  WireMoved bulk_out(std::uint8_t ep, std::span<const std::byte> bytes) noexcept override;
  WireMoved bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept override;

  /// A hand of its own that holds the grip; asked once a millisecond. Without one, `mechanics()` has its pull set.
  void set_hand(std::unique_ptr<sim::Hand> hand) noexcept { hand_ = std::move(hand); }
  [[nodiscard]] sim::Hand* hand() noexcept { return hand_.get(); }
  [[nodiscard]] FalconMechanics& mechanics() noexcept { return mechanics_; }
  void set_buttons(std::uint8_t mask) noexcept { buttons_ = mask; }
  /// Takes back the homed flags of the legs in `mask`; they come again only after the homing bit was off for a frame.
  void drop_homed(std::uint8_t mask) noexcept;
  FalconFaults faults;

  // What a test looks at.
  [[nodiscard]] bool running() const noexcept { return state_ == State::kRunning; }
  [[nodiscard]] std::uint8_t homed() const noexcept { return homed_; }
  [[nodiscard]] const FalconOrder& order() const noexcept { return order_; }  ///< newest frame taken
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }     ///< whole frames taken
  /// `back` frames before the newest; back < min(frames(), kRemembered).
  [[nodiscard]] const HostFrame& host_frame(std::size_t back) const noexcept {
    return remembered_[(frames_ + kRemembered - 1 - back) % kRemembered];
  }
  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] std::uint64_t bad_frames() const noexcept { return bad_frames_; }
  /// Frames with force while not all legs were homed: there must never be one.
  [[nodiscard]] std::uint64_t unsafe_frames() const noexcept { return unsafe_frames_; }
  [[nodiscard]] std::uint64_t loads() const noexcept { return loads_; }  ///< images taken whole
  [[nodiscard]] const std::vector<std::byte>& image() const noexcept { return image_; }

 private:
  enum class State : std::uint8_t { kBootLoader, kGreeted, kLoading, kRunning };

  void step(Duration h) noexcept;
  void take_line_changes() noexcept;
  void take(std::byte b) noexcept;
  void take_boot(std::byte b) noexcept;
  void take_image(std::byte b) noexcept;
  void take_frame(const FalconOrder& order) noexcept;
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
  Duration cts_in_{};                 ///< until CTS is raised
  bool cts_ = false;

  FalconFramer framer_;
  FalconOrder order_;
  std::uint8_t homed_ = 0, out_seen_ = 0;
  bool wants_edge_ = false;           ///< flags were dropped: the homing bit must be off once
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

}  // namespace tandem::hal::wire

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"
#include "hal/drivers/falcon/falcon_frame.h"

/// Start-up of a Falcon's processor. It loses its program without power and receives it through its boot loader.
/// The program is Novint's, under a licence that forbids redistribution: users provide their own file.
namespace tandem::hal {

/// Firmware image of the user.
struct FalconFirmware {
  std::string file;  ///< for messages
  std::vector<std::byte> image;
  std::string sha256;  ///< of `image`, lower-case hex
};

/// Range of firmware sizes [bytes]; images known to work have 7.3 to 8.5 kB.
inline constexpr std::size_t kFirmwareMin = 7000, kFirmwareMax = 9000;
/// Checks the size, the content (neither a text nor a constant) and the hash, if one is expected.
/// Error: names the actual content, the expected content and the remedy.
[[nodiscard]] Result<> check_firmware(const FalconFirmware& firmware, const std::optional<std::string>& sha256);

/// Largest number of loading attempts. Loading is unreliable on every system; each attempt begins with a full reset.
inline constexpr int kBootAttempts = 12;

class FalconBoot {
 public:
  FalconBoot(UsbPipe& pipe, Clock& clock, BringUp& watcher) noexcept : pipe_(pipe), clock_(clock), watcher_(watcher) {}

  /// Tests whether the firmware runs already: configures the servo line and sends up to ten zero frames.
  /// Returns the reply, or nothing if none came. Error: Errc::kUnplugged and other errors of the pipe.
  [[nodiscard]] std::expected<std::optional<FalconReply>, Errc> probe() noexcept;

  /// Loads the firmware, in up to kBootAttempts attempts: reset, greeting, image with every byte echoed, probe.
  /// Returns the first reply of the firmware.
  [[nodiscard]] Result<FalconReply> load(const FalconFirmware& firmware);

  /// Returns the number of attempts of the last load().
  [[nodiscard]] int attempts() const noexcept { return attempts_; }

 private:
  struct Trouble {
    Errc code = Errc::kFirmware;
    const char* what = "";
  };
  using Step = std::expected<void, Trouble>;
  [[nodiscard]] Step attempt(std::span<const std::byte> image);
  [[nodiscard]] Step greet() noexcept;
  [[nodiscard]] Step open_for_image() noexcept;
  [[nodiscard]] Step send_image(std::span<const std::byte> image);
  [[nodiscard]] Step write(std::span<const std::byte> bytes) noexcept;
  /// Reads until `take(payload, cts)` returns true (result: true) or `wait` is over (result: false).
  template <class Take>
  [[nodiscard]] std::expected<bool, Trouble> read_for(Duration wait, Take take) noexcept;

  UsbPipe& pipe_;
  Clock& clock_;
  BringUp& watcher_;
  int attempts_ = 0;
};

}  // namespace tandem::hal

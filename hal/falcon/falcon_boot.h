#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/falcon/falcon_frame.h"
#include "hal/pipes.h"

/// Bringing a Falcon's processor up: it forgets its program when it loses power and is given it again through its boot
/// loader. The program is Novint's, under a licence that forbids passing it on: users bring their own file.
namespace tandem::hal {

/// A user's file, as read.
struct FalconFirmware {
  std::string file;  ///< for messages
  std::vector<std::byte> image;
  std::string sha256;  ///< of `image`, lower-case hex
};

/// Images known to work have 7.3 to 8.5 kB.
inline constexpr std::size_t kFirmwareMin = 7000, kFirmwareMax = 9000;
/// Size, not a text or a constant, and the hash if one is expected. Error: what it is, what it should be, remedy.
[[nodiscard]] Result<> check_firmware(const FalconFirmware& firmware, const std::optional<std::string>& sha256);

/// Loading is flaky on every system: each attempt begins with a full reset.
inline constexpr int kBootAttempts = 12;

class FalconBoot {
 public:
  FalconBoot(UsbPipe& pipe, Clock& clock, BringUp& watcher) noexcept : pipe_(pipe), clock_(clock), watcher_(watcher) {}

  /// Whether the firmware runs already: servo line, up to ten zero frames. The answer, none, or Errc::kUnplugged and other
  /// troubles of the pipe.
  [[nodiscard]] std::expected<std::optional<FalconReply>, Errc> probe() noexcept;

  /// Up to kBootAttempts times: reset, greeting, image with every byte echoed, probe. Returns the first answer.
  [[nodiscard]] Result<FalconReply> load(const FalconFirmware& firmware);

  /// Attempts the last load() took.
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
  /// Reads until `take(payload, cts)` says true (done) or `wait` is over (false).
  template <class Take>
  [[nodiscard]] std::expected<bool, Trouble> read_for(Duration wait, Take take) noexcept;

  UsbPipe& pipe_;
  Clock& clock_;
  BringUp& watcher_;
  int attempts_ = 0;
};

}  // namespace tandem::hal

#pragma once

#include <atomic>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/rate_hand.h"
#include "common/io/terminal.h"
#include "hal/device.h"
#include "hal/io/backend.h"
#include "hal/io/deadman.h"

namespace tandem::client {

/// Real hardware in a person's hand before there is a seat for it: opened by the name he gave, brought up with progress,
/// homed with his help, and exchanging zeros until somebody is served.
class HeldDevice {
 public:
  /// Between two exchanges with the device, whatever the scene's rate is.
  static constexpr Duration kPeriod = std::chrono::milliseconds(1);

  /// Whether these words of --device mean hardware at all, not a simulated device.
  [[nodiscard]] static bool is_meant(std::string_view spec);

  /// All that is wrong with the words and with the files they name, whatever is attached: a line each, for a person.
  [[nodiscard]] static std::vector<std::string> mistakes(std::string_view spec);

  struct Failure {
    bool interrupted = false;
    bool wrong_words = false;  ///< what was typed cannot be meant, whatever is attached
    std::string reason;  ///< cause and remedy; or which signal
  };
  /// What is known of the directions of its motors, where they come from a file.
  struct Motors {
    std::string state = {};      ///< folder of their book, as given by --state
    bool being_confirmed = false;  ///< a person is about to: forces up to kConfirmingShare of the peak
  };
  /// A device whose motors are not confirmed is taken without force; `no_force` says so, and `line` warned.
  /// @param signals  file of signals.h: Ctrl-C ends the waiting
  [[nodiscard]] static std::expected<std::unique_ptr<HeldDevice>, Failure> take(std::string_view spec, int signals, io::StatusLine& line,
                                                                                const Motors& motors);
  ~HeldDevice();

  /// What a seat is told of it.
  [[nodiscard]] hal::DeviceCaps caps() const;
  [[nodiscard]] hal::Device& device() noexcept { return *device_; }
  [[nodiscard]] const std::string& note() const noexcept { return note_; }
  /// Why no force comes of it, with the command that changes that; empty: one may come.
  [[nodiscard]] const std::string& no_force() const noexcept { return no_force_; }
  /// Where the directions of its motors come from; nothing: not from a file, or no current may flow.
  [[nodiscard]] const std::optional<hal::SignFile>& signs() const noexcept { return signs_; }
  /// What speaks to it, with its version.
  [[nodiscard]] const std::string& library() const noexcept { return library_; }

  /// Whether the process that would send zeros after a crash was there and is gone.
  [[nodiscard]] bool unguarded();

  /// From now on `client` is called with what the device itself says.
  void observe(hal::ServoClient& client) { relay_.to.store(&client, std::memory_order_release); }
  /// The same for a seat: of a device that says how fast, it sees where. It must live until `device().close()`.
  void serve(hal::ServoClient& client);

 private:
  /// Serves nobody until it is told whom.
  struct Relay final : hal::ServoClient {
    std::atomic<hal::ServoClient*> to{nullptr};
    std::atomic<bool> was_lost{false};
    hal::Command tick(const hal::State& state) noexcept override {
      hal::ServoClient* client = to.load(std::memory_order_acquire);
      return client != nullptr ? client->tick(state) : hal::Command{};
    }
    void lost(hal::Errc why) noexcept override {
      was_lost = true;
      if (hal::ServoClient* client = to.load(std::memory_order_acquire)) client->lost(why);
    }
  };

  HeldDevice() = default;
  [[nodiscard]] std::expected<void, Failure> wait_until_homed(int signals, io::StatusLine& line);

  std::shared_ptr<void> bus_;
  std::unique_ptr<hal::Deadman> deadman_;  ///< says goodbye after the device was closed
  Relay relay_;
  std::unique_ptr<hal::Device> device_;
  std::unique_ptr<RateHand> rate_;
  std::optional<hal::SignFile> signs_;
  std::string note_, library_, no_force_;
};

}  // namespace tandem::client

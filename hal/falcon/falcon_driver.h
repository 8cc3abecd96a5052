#pragma once

#include <optional>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/falcon/falcon_boot.h"
#include "hal/falcon/falcon_force.h"
#include "hal/falcon/falcon_frame.h"
#include "hal/falcon/falcon_homing.h"
#include "hal/falcon/falcon_kinematics.h"
#include "hal/pipes.h"
#include "hal/reply_pace.h"

namespace tandem::hal {

struct FalconOptions {
  FalconSpec spec;
  std::optional<FalconFirmware> firmware;  ///< checked by check_firmware before it is sent
};

/// Novint Falcon: three motors, three encoders, four buttons, three lights. Joints are the legs' angles [rad].
/// - Force only while all legs are homed, the pose is known, and no frame of homing is asked for; it fades out near
///   singular poses (falcon_effort_share) and is cut in its direction to what the motors or the ceiling give.
/// - An unhomed Falcon has no origin: `q` counts from an arbitrary one, `x` stays where it was last known.
/// - exchange() sends zeros and returns Errc::kFirmware once the encoders were found frozen: bring it up again, which loads the
///   firmware anew; silence() then leaves it in its boot loader, so that another program loads it too. Errc::kProtocol also for encoder counts that no pose has.
/// Lock-step: each frame sent is answered by one. An answer that comes late is taken by the next exchange.
class FalconDriver final : public Driver {
 public:
  /// Error: the calibration in `options.spec` contradicts itself.
  [[nodiscard]] static std::expected<FalconDriver, std::string> make(DeviceId id, UsbPipe& pipe, Clock& clock,
                                                                     FalconOptions options);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  void silence() noexcept override;

  /// Attempts of the last loading; 0: the firmware ran already.
  [[nodiscard]] int boot_attempts() const noexcept { return boot_attempts_; }

 private:
  /// A frame on its way, or the one before: what acts between two readings.
  struct Order {
    std::uint64_t seq = 0;
    Vec3 tau = Vec3::Zero();
    bool saturated = false;
  };

  FalconDriver(DeviceId id, UsbPipe& pipe, Clock& clock, FalconOptions options, const FalconForce& force);
  void first_reading(const FalconReply& reply) noexcept;
  [[nodiscard]] FalconOrder frame_for(const Orders& orders, Order& order) noexcept;
  [[nodiscard]] std::expected<void, Errc> send(const FalconOrder& frame) noexcept;
  /// Into `reply_`: waits for one, or takes all that is there if `wait` is 0.
  [[nodiscard]] std::expected<void, Errc> receive(Duration wait) noexcept;
  [[nodiscard]] std::expected<void, Errc> forget_old_answers() noexcept;
  [[nodiscard]] std::expected<Exchange, Errc> take(State& state, Time now) noexcept;
  [[nodiscard]] Errc after(Errc trouble) noexcept;

  DeviceId id_;
  UsbPipe* pipe_;
  Clock* clock_;
  FalconOptions options_;
  FalconForce force_;
  FalconFlagBits bits_;
  DeviceCaps caps_;
  int boot_attempts_ = 0;
  bool reload_ = false;

  FalconFramer framer_;
  FalconHoming homing_;
  std::optional<FalconReply> reply_;  ///< newest of this exchange
  bool line_error_ = false;
  bool jumped_ = true;                ///< readings before say nothing about speed
  bool anew_ = false;                 ///< the next reading is the first after a standstill
  std::optional<FalconPose> pose_;    ///< of the last reading, homed
  Vec3 x_last_ = Vec3::Zero();
  Vec3 theta_last_ = Vec3::Zero(), dtheta_ = Vec3::Zero();
  Time read_at_{};
  ReplyPace pace_;
  Order acting_, sent_;
};

}  // namespace tandem::hal

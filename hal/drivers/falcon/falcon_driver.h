#pragma once

#include <optional>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"
#include "hal/core/reply_deadline.h"
#include "hal/drivers/falcon/falcon_boot.h"
#include "hal/drivers/falcon/falcon_force.h"
#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/drivers/falcon/falcon_homing.h"
#include "hal/drivers/falcon/falcon_kinematics.h"

namespace tandem::hal {

struct FalconOptions {
  FalconSpec spec;
  std::optional<FalconFirmware> firmware;  ///< check_firmware checks it before it is sent
};

/// Driver of the Novint Falcon: three motors, three encoders, four buttons, three lights. Joints are the legs' angles
/// [rad].
/// - Force flows only if all legs are homed, the pose is known and no homing is requested. It fades out near singular
///   poses (falcon_effort_share).
/// - The force is limited, with its direction kept, to the capability of the motors or to the ceiling.
/// - An unhomed Falcon has no origin: `q` counts from an arbitrary one, `x` stays at its last known value.
/// - exchange() returns Errc::kFirmware once the encoders were found frozen and sends no force. `bring_up` then loads
///   the firmware again.
/// - send_zeros() then leaves the device in its boot loader, so that another program loads the firmware too.
/// - exchange() returns Errc::kProtocol also for encoder counts that correspond to no pose.
/// Lock-step: each frame sent is answered by one. The next exchange takes a late reply.
class FalconDriver final : public Driver {
 public:
  /// Returns a driver. Error: the calibration in `options.spec` contradicts itself.
  [[nodiscard]] static std::expected<FalconDriver, std::string> make(DeviceId id, UsbPipe& pipe, Clock& clock,
                                                                     FalconOptions options);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  void send_zeros() noexcept override;

  /// Returns the number of attempts of the last loading; 0: the firmware ran already.
  [[nodiscard]] int boot_attempts() const noexcept { return boot_attempts_; }

 private:
  /// Command of a frame that was sent, or of the one before: the command in effect between two readings.
  struct SentCommand {
    std::uint64_t seq = 0;
    Vec3 tau = Vec3::Zero();
    bool saturated = false;
  };

  FalconDriver(DeviceId id, UsbPipe& pipe, Clock& clock, FalconOptions options, const FalconForce& force);
  void first_reading(const FalconReply& reply) noexcept;
  [[nodiscard]] FalconCommand frame_for(const ServoCommand& command, SentCommand& next) noexcept;
  [[nodiscard]] std::expected<void, Errc> send(const FalconCommand& frame) noexcept;
  /// Receives into `reply_`: waits for one reply, or reads all queued replies if `wait` is 0.
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
  std::optional<FalconReply> reply_;  ///< newest reply of this exchange
  bool line_error_ = false;
  bool jumped_ = true;              ///< earlier readings give no information about speed
  bool after_stall_ = false;        ///< the next reading is the first after a stall
  std::optional<FalconPose> pose_;  ///< pose of the last homed reading
  Vec3 x_last_ = Vec3::Zero();
  Vec3 theta_last_ = Vec3::Zero(), dtheta_ = Vec3::Zero();
  Time read_at_{};
  ReplyDeadline pace_;
  SentCommand acting_, sent_;
};

}  // namespace tandem::hal

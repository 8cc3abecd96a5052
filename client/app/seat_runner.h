#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "client/app/authority_script_player.h"
#include "client/app/client_status.h"
#include "client/app/connection_swapper.h"
#include "client/app/sample.h"
#include "client/app/seat_socket.h"
#include "client/app/seat_status_recorder.h"
#include "client/app/status_pace.h"
#include "client/app/user_commands.h"
#include "client/seat/seat.h"
#include "client/seat/tick_decimator.h"
#include "client/seat/tick_phase.h"
#include "common/io/event_fd.h"
#include "common/io/published.h"
#include "hal/sim/sim_device.h"

namespace tandem::client {

/// Runs a seat on its device's servo thread: drains the socket, advances the seat by one tick, sends. The servo thread
/// never waits for another thread.
class SeatRunner final : public hal::ServoClient {
 public:
  /// @param seat      must outlive this object; only the servo thread accesses it from `Device::start` to `close`
  /// @param sim       simulated device that receives the session time; null for hardware
  /// @param script    authority changes by session time, ascending. Each is requested 50 ticks ahead, the time for
  ///                  which the server announces a transfer.
  /// @param samples   receives one sample per tick; null: no trace
  /// @param exchange  exchange period of a device with its own rate, at most one tick of the scene. The seat then ticks
  ///                  in the exchange nearest to each tick time and holds its command in between. Zero: one tick per
  ///                  exchange.
  SeatRunner(io::UdpSocket socket, Seat& seat, hal::sim::SimDevice* sim, std::vector<AuthorityScript::Change> script,
             SampleQueue* samples, Duration exchange = Duration::zero());

  hal::Command tick(const hal::State& state) noexcept override;
  [[nodiscard]] Duration next_shift() noexcept override;
  void lost(hal::Errc why) noexcept override;

  // Called on the main thread.
  [[nodiscard]] UserCommands& commands() noexcept { return commands_; }
  /// The servo thread takes an offered connection with its next tick.
  [[nodiscard]] ConnectionSwapper& connections() noexcept { return connections_; }
  [[nodiscard]] ClientStatus status() const { return published_.read(); }
  /// Readable once `status` says that the session is closed, or the device is lost.
  [[nodiscard]] int finished_fd() const noexcept { return finished_.get(); }
  /// Clears `finished_fd` before a reconnect of a closed session.
  void clear_finished() noexcept;
  [[nodiscard]] bool device_lost() const noexcept { return lost_.load(std::memory_order_acquire); }

  /// The last status. @pre the device is closed
  [[nodiscard]] const ClientStatus& final_status() const noexcept { return recorder_.status(); }

 private:
  void swap_connection(Time now) noexcept;
  void request_scripted_authority(Time now) noexcept;
  void record(Time now, const std::optional<double>& session_time) noexcept;

  Seat* seat_;
  SeatSocket socket_;
  ConnectionSwapper connections_;
  UserCommands commands_;
  AuthorityScriptPlayer script_;
  hal::sim::SimDevice* sim_;
  SampleQueue* samples_;
  TickDecimator pace_;
  TickPhase phase_;
  hal::Command command_{};  ///< command of the last tick
  std::uint64_t ticks_ = 0;
  Time first_tick_{};
  io::EventFd finished_;
  std::atomic<bool> lost_{false};
  SeatStatusRecorder recorder_;
  StatusPace status_pace_;
  io::Published<ClientStatus> published_;
};

}  // namespace tandem::client

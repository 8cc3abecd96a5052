#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "client/app/alpha_script.h"
#include "client/app/client_status.h"
#include "client/seat.h"
#include "client/tick_pace.h"
#include "common/io/datagram_batch.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "hal/sim/sim_device.h"

namespace tandem::client {

/// One servo tick for a trace.
struct Sample {
  double t_s = 0;  ///< session time, or time before it as a negative number [s]
  AxisArray q{};
  std::array<double, 3> x{}, f_cmd{}, f_gate{}, f_out{};  ///< tip [m]; wanted, let through by the gate, delivered [N]
  wire::GateState gate = wire::GateState::kOff;
  double alpha = 0;
  double silence_s = -1;  ///< since the newest datagram that acted, on the own clock [s]; -1: none yet on this connection
};
using SampleQueue = io::SpscQueue<Sample>;

/// Runs a seat on its device's servo thread: drains the socket, steps the seat, sends. People's wishes come through
/// atomics and a bounded queue; nothing here waits for anybody.
class SeatPump final : public hal::ServoClient {
 public:
  /// @param seat     must outlive the pump; only the servo thread touches it from `Device::start` to `close`
  /// @param sim      to be told the session time; null for hardware
  /// @param script   changes of authority by session time, ascending; each is asked for 50 ticks ahead, as that is how long it is announced
  /// @param samples   every tick, null: not wanted
  /// @param exchange  period of a device that has a rate of its own, at most a tick of the scene: the seat then works in the exchange
  ///                  nearest to each of its ticks, and its command is held meanwhile. Zero: one tick per exchange
  SeatPump(io::UdpSocket socket, Seat& seat, hal::sim::SimDevice* sim, std::vector<AlphaScript::Change> script,
           SampleQueue* samples, Duration exchange = Duration::zero());
  ~SeatPump() override;

  hal::Command tick(const hal::State& state) noexcept override;
  void lost(hal::Errc why) noexcept override;

  // Of the person's thread.
  void press_reset() noexcept { reset_.store(true, std::memory_order_relaxed); }
  void leave() noexcept { leave_.store(true, std::memory_order_relaxed); }
  /// The own hand is let go with the next servo tick, until `resume`.
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
  /// Everybody's, as far as the role of this seat may.
  void stop_all() noexcept { stop_all_.store(true, std::memory_order_relaxed); }
  void resume() noexcept { resume_.store(true, std::memory_order_relaxed); }
  void request_authority(const control::Weights& alpha) noexcept { wishes_.push(alpha); }
  /// A new connection: the servo thread takes it with its next tick, without waiting for anybody. One at a time: not before `take_old`
  /// gave the one before back.
  struct Handover {
    io::UdpSocket socket;
    Seat::Connection connection;
  };
  void hand_over(std::unique_ptr<Handover> next) noexcept { next_.store(next.release(), std::memory_order_release); }
  /// What the servo thread put away, null if nothing; goes on the caller's thread.
  [[nodiscard]] std::unique_ptr<Handover> take_old() noexcept { return std::unique_ptr<Handover>(old_.exchange(nullptr, std::memory_order_acquire)); }
  [[nodiscard]] ClientStatus status() const;
  /// Readable once the session is closed or the device is lost.
  [[nodiscard]] int finished_fd() const noexcept { return finished_.get(); }
  /// The session was closed, and this seat means to come back.
  void finished_read() noexcept;
  [[nodiscard]] bool device_lost() const noexcept { return lost_.load(std::memory_order_acquire); }

  /// After the device is closed.
  [[nodiscard]] const ClientStatus& final_status() const noexcept { return picture_; }

 private:
  void change_connection(Time now) noexcept;
  void receive(Time now) noexcept;
  void obey_person() noexcept;
  void obey_script(Time now) noexcept;
  void ask_script(Time now) noexcept;
  void send(Time now) noexcept;
  void see_handover() noexcept;
  void look(Time now) noexcept;
  [[nodiscard]] double distance_to_tool() const noexcept;

  io::UdpSocket socket_;
  io::Fd finished_;
  Seat* seat_;
  hal::sim::SimDevice* sim_;
  std::vector<AlphaScript::Change> script_;
  std::size_t next_change_ = 0;
  std::optional<Time> script_asked_;  ///< nothing: somebody asked for something else since
  SampleQueue* samples_;
  io::SpscQueue<control::Weights> wishes_{64};
  std::atomic<bool> reset_{false}, leave_{false}, lost_{false}, stop_{false}, stop_all_{false}, resume_{false};
  std::size_t masters_;

  static constexpr std::size_t kSendMax = 4;
  io::ReceiveBatch in_;
  io::SendBatch out_;
  std::array<std::array<std::byte, link::kDatagramMax>, kSendMax> buffers_;

  std::atomic<Handover*> next_{nullptr}, old_{nullptr};
  struct Counts {
    std::uint64_t sent = 0, accepted = 0, late = 0, refused = 0;
  };
  Counts before_;  ///< of connections that were given up
  [[nodiscard]] Counts counts() const noexcept;

  TickPace pace_;
  hal::Command held_{};  ///< of the last tick
  std::uint64_t ticks_ = 0;
  Time began_{}, connected_{};
  bool told_ = false;
  wire::Handover handover_ = wire::Handover::kNone;  ///< as FORCE said in the tick before
  std::uint32_t handover_version_ = 0;
  std::uint64_t handover_told_ = 0, handover_begins_ = 0, handover_moved_ = 0;  ///< ticks; the last: when the weight moved last
  double handover_alpha_ = 0;  ///< own weight in the tick before
  ClientStatus picture_;
  mutable std::mutex published_lock_;  ///< the servo thread only tries it
  ClientStatus published_;
};

}  // namespace tandem::client

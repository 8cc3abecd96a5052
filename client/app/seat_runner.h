#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "client/app/authority_script.h"
#include "client/app/client_status.h"
#include "client/seat/seat.h"
#include "client/seat/tick_decimator.h"
#include "common/io/datagram_batch.h"
#include "common/io/event_fd.h"
#include "common/io/published.h"
#include "common/io/spsc_queue.h"
#include "common/io/udp_socket.h"
#include "hal/sim/sim_device.h"

namespace tandem::client {

/// One servo tick of a trace.
struct Sample {
  double t_s = 0;  ///< session time [s]; before the session, minus the time since the first tick
  AxisArray q{};   ///< joints [rad or m]
  std::array<double, 3> x{}, f_cmd{}, f_gate{}, f_out{};  ///< tip [m]; force wanted, after the gate, delivered [N]
  wire::GateState gate = wire::GateState::kOff;
  double alpha = 0;  ///< own authority [0, 1]
  double silence_s =
      -1;  ///< time since the newest accepted datagram on the client's clock [s]; -1: none on this connection
};
using SampleQueue = io::SpscQueue<Sample>;

/// Runs a seat on its device's servo thread: drains the socket, advances the seat by one tick, sends. The main thread
/// passes user requests through atomics and a bounded queue. The servo thread never waits for another thread.
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
  ~SeatRunner() override;

  hal::Command tick(const hal::State& state) noexcept override;
  void lost(hal::Errc why) noexcept override;

  // Called on the main thread.
  void request_gate_reset() noexcept { reset_.store(true, std::memory_order_relaxed); }
  void leave() noexcept { leave_.store(true, std::memory_order_relaxed); }
  /// Stops this seat with the next servo tick, until `resume`.
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
  /// Requests a stop or pause of the whole session, as the role of this seat allows.
  void stop_all() noexcept { stop_all_.store(true, std::memory_order_relaxed); }
  void resume() noexcept { resume_.store(true, std::memory_order_relaxed); }
  void request_authority(const control::MasterArray& alpha) noexcept { authority_requests_.push(alpha); }
  /// A new connection with its socket. The servo thread takes it with its next tick, without a lock. Only one swap at a
  /// time: the next one must wait until `take_old_connection` has returned the previous connection.
  struct ConnectionSwap {
    io::UdpSocket socket;
    Seat::Connection connection;
  };
  void swap_connection(std::unique_ptr<ConnectionSwap> next) noexcept {
    next_.store(next.release(), std::memory_order_release);
  }
  /// Returns the connection that the servo thread replaced, so that the caller frees it; null if there is none.
  [[nodiscard]] std::unique_ptr<ConnectionSwap> take_old_connection() noexcept {
    return std::unique_ptr<ConnectionSwap>(old_.exchange(nullptr, std::memory_order_acquire));
  }
  [[nodiscard]] ClientStatus status() const;
  /// Readable once the session is closed or the device is lost.
  [[nodiscard]] int finished_fd() const noexcept { return finished_.get(); }
  /// Clears `finished_fd` before a reconnect of a closed session.
  void clear_finished() noexcept;
  [[nodiscard]] bool device_lost() const noexcept { return lost_.load(std::memory_order_acquire); }

  /// The last status. @pre the device is closed
  [[nodiscard]] const ClientStatus& final_status() const noexcept { return snapshot_; }

 private:
  void change_connection(Time now) noexcept;
  void receive(Time now) noexcept;
  void apply_user_input() noexcept;
  void apply_script(Time now) noexcept;
  void request_scripted_authority(Time now) noexcept;
  void send(Time now) noexcept;
  void track_transfer() noexcept;
  void snapshot(Time now) noexcept;
  [[nodiscard]] double distance_to_tool() const noexcept;

  io::UdpSocket socket_;
  io::EventFd finished_;
  Seat* seat_;
  hal::sim::SimDevice* sim_;
  std::vector<AuthorityScript::Change> script_;
  std::size_t next_change_ = 0;
  std::optional<Time> script_requested_;  ///< empty: the user made another request since
  SampleQueue* samples_;
  io::SpscQueue<control::MasterArray> authority_requests_{64};
  std::atomic<bool> reset_{false}, leave_{false}, lost_{false}, stop_{false}, stop_all_{false}, resume_{false};
  std::size_t masters_;

  static constexpr std::size_t kSendMax = 4;
  io::ReceiveBatch in_;
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, kSendMax> buffers_;

  std::atomic<ConnectionSwap*> next_{nullptr}, old_{nullptr};
  struct Counts {
    std::uint64_t sent = 0, accepted = 0, late = 0, refused = 0;
  };
  Counts earlier_counts_;  ///< sum over the replaced connections
  [[nodiscard]] Counts counts() const noexcept;

  TickDecimator pace_;
  hal::Command command_{};  ///< command of the last tick
  std::uint64_t ticks_ = 0;
  Time began_{}, connected_{};
  bool close_signalled_ = false;
  wire::TransferNotice transfer_ = wire::TransferNotice::kNone;  ///< notice in FORCE at the previous tick
  std::uint32_t transfer_version_ = 0;
  std::uint64_t transfer_announced_ = 0, transfer_begins_ = 0,
                transfer_moved_ = 0;  ///< tick counts; transfer_moved_: last change of the own authority
  double transfer_alpha_ = 0;         ///< own authority at the previous tick
  ClientStatus snapshot_;
  io::Published<ClientStatus> published_;
};

}  // namespace tandem::client

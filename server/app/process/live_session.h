#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "common/io/event_fd.h"
#include "common/io/fd.h"
#include "common/io/published.h"
#include "common/io/spsc_queue.h"
#include "server/app/monitor/session_status.h"
#include "server/app/process/act_limit.h"
#include "server/app/process/checkpoint_publisher.h"
#include "server/app/process/local_slaves.h"
#include "server/app/process/tick_queue.h"
#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::server {

using AuditEventQueue = io::SpscQueue<AuditEvent>;

/// A session as served by a shard: the session, its invariant checker, the queue of its tick records, and a status
/// copy for other threads.
class LiveSession {
 public:
  /// @param scene    must outlive this
  /// @param records  receives a record per running tick; if it is full, records are dropped and counted
  /// @param from     checkpoint to restore; null: a new session
  /// @param saved_at time of that checkpoint, by the clock of this server
  /// @pre incompatibility(*from, scene) is empty, and `slaves` have the joint positions of `from`
  LiveSession(const SceneSpec& scene, LocalSlaves slaves, std::uint8_t slot, TickQueue& records,
              const Checkpoint* from = nullptr, Time saved_at = {});
  /// Sets the mailbox for checkpoints, before a shard serves the session.
  /// @param epoch  as the clients know it
  void persist_to(std::shared_ptr<CheckpointMailbox> mailbox, std::uint64_t epoch) {
    checkpoints_.attach(std::move(mailbox), epoch, scene_->tick_hz);
  }

  /// Sets whether a report or trace is made of the records, before a shard serves the session. Without one, clients
  /// send telemetry at 60 Hz, and as many ticks are recorded.
  void set_recorded(bool on) noexcept { reported_ = on; }

  // ---- Any thread ----
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const SeatCatalogue& seat_catalogue() const noexcept { return session_.seat_catalogue(); }
  [[nodiscard]] std::uint8_t slot() const noexcept { return slot_; }
  /// Time of the session's first tick, from which its records count; nullopt: it has not ticked.
  [[nodiscard]] std::optional<Time> first_tick() const noexcept {
    const std::int64_t ns = first_tick_.load(std::memory_order_acquire);
    return ns == 0 ? std::nullopt : std::optional(Time{Duration{ns}});
  }
  /// Recent status, updated every 64 ticks, or every 256 while the shard sheds telemetry.
  [[nodiscard]] SessionStatus status() const;
  /// File descriptor that becomes readable when the session is over.
  [[nodiscard]] int over_fd() const noexcept { return over_event_.get(); }
  /// No shard serves the session any more. All members may be read, and it may be destroyed.
  [[nodiscard]] bool over() const noexcept { return over_.load(std::memory_order_acquire); }

  /// Processor time of a tick, without the kernel's part of receiving and sending [s]: mean of about the last 4 that
  /// were measured; 0: none yet.
  [[nodiscard]] double cost() const noexcept { return cost_.load(std::memory_order_relaxed); }

  /// Sets whether a recording is made of the records, from one of the next ticks on; as `set_recorded`.
  void set_recording(bool on) noexcept { recording_.store(on, std::memory_order_relaxed); }

  /// Has the ticks disengage all hands from a time on, and engage them again when it was set to a later one. Each tick
  /// reads the clock. Before the first tick. Default: none.
  void set_act_limit(std::shared_ptr<const ActLimit> limit) noexcept { act_limit_ = std::move(limit); }
  /// The session ends by itself: its clients are being closed, or it is over.
  [[nodiscard]] bool ends() const noexcept { return ends_.load(std::memory_order_relaxed); }
  /// Has the next ticks disengage all hands for ever: another server may own the session.
  void stop_acting() noexcept { acts_.store(false, std::memory_order_relaxed); }

  /// Queue of audit events for one reading thread. If it is full, events are dropped and counted.
  [[nodiscard]] AuditEventQueue& audit() noexcept { return audit_; }

  // ---- The shard's thread ----
  [[nodiscard]] Session& session() noexcept { return session_; }
  /// Runs a tick. A session without clients gets the time at which the tick was due: these times are evenly spaced, so
  /// that a recording of its inputs takes no space.
  /// @param due      time of the tick, at most one period before `now`
  /// @param machine  of the shard; the session counts late and missed ticks itself, because it may change the shard
  /// @return time that the session got, with which its datagrams are to be polled
  Time tick(Time now, Time due, std::uint32_t missed, const MachineStatus& machine) noexcept;
  /// Sets the number of the tick before the session's first one. Shards of one tick rate number their ticks alike.
  void set_last_tick(std::uint64_t number) noexcept { last_tick_ = number; }
  /// Number of ticks that the session missed before this one, which becomes its last. nullopt: it has had this tick
  /// already, on the shard that passed it on.
  [[nodiscard]] std::optional<std::uint32_t> begin_tick(std::uint64_t number) noexcept {
    if (number <= last_tick_) return std::nullopt;
    return static_cast<std::uint32_t>(number - std::exchange(last_tick_, number) - 1);
  }
  /// Adds the processor time of one tick of the session, sealing included, to the mean that `cost` returns.
  void add_cost(Duration spent) noexcept;
  /// Publishes the final status and checkpoint. The shard does not access the session afterwards.
  void finish(Time now, const MachineStatus& machine) noexcept;

  // ---- After it is over ----
  [[nodiscard]] const SessionStatus& final_status() const noexcept { return status_; }
  [[nodiscard]] const Violations& violations() const noexcept { return violations_; }
  /// Number of ticks that were not recorded because the shard shed load.
  [[nodiscard]] std::uint64_t skipped_records() const noexcept { return skipped_records_; }

 private:
  void update_seat_status(std::size_t seat, Time now) noexcept;
  void publish(Time now, const MachineStatus& machine) noexcept;
  void draw_path_tokens() noexcept;

  const SceneSpec* scene_;
  std::uint8_t slot_;
  Session session_;
  TickQueue* records_;
  AuditEventQueue audit_{1024};
  Violations violations_;
  std::atomic<bool> over_{false};
  io::EventFd over_event_;
  std::uint32_t seldom_interval_;              ///< [ticks] between records that nothing needs
  bool reported_ = true;                       ///< every tick is needed: for a report or a trace
  std::atomic<bool> recording_{false};         ///< likewise: for a recording
  std::shared_ptr<const ActLimit> act_limit_;  ///< nullptr: none
  std::atomic<bool> acts_{true};
  std::atomic<bool> ends_{false};
  std::atomic<std::int64_t> first_tick_{0};  ///< [ns]; 0: none
  std::uint64_t ticks_ = 0, skipped_records_ = 0;
  std::uint64_t last_tick_ = 0;  ///< in the numbering of the shards
  std::uint64_t late_ticks_ = 0, missed_ticks_ = 0;
  std::atomic<double> cost_{0};
  SessionStatus status_;
  std::array<decltype(SeatStatus::refused), kSeatsMax> rejected_before_{};  ///< of each seat's connection
  io::Published<SessionStatus> published_;
  CheckpointPublisher checkpoints_;
};

}  // namespace tandem::server

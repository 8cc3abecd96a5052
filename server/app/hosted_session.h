#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "common/io/fd.h"
#include "common/io/spsc_queue.h"
#include "server/app/checkpoint_mail.h"
#include "server/app/slaves.h"
#include "server/app/status.h"
#include "server/session.h"
#include "server/violations.h"

namespace tandem::server {

using TickQueue = io::SpscQueue<TickRecord>;
using AuditEvents = io::SpscQueue<AuditEvent>;

/// A session as a shard serves it: the core, its monitor, the queue of its records, and a picture of it that other threads may look at.
class HostedSession {
 public:
  /// @param scene    must outlive it
  /// @param records  every tick while it runs; full: dropped and counted
  /// @param from     where it goes on; null: it is new  @pre unfit(*from, scene) is empty, and `slaves` stand where it says
  HostedSession(const SceneSpec& scene, Slaves slaves, std::uint8_t slot, TickQueue& records, const Checkpoint* from = nullptr);
  /// Before it is hosted: lays its checkpoint down there, twice a second and at once when the session begins or somebody comes, goes,
  /// moves authority or stops.
  /// @param epoch  as its clients know it
  void keep_in(std::shared_ptr<CheckpointMail> mail, std::uint64_t epoch);

  // ---- Any thread ----
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const Reception& reception() const noexcept { return session_.reception(); }
  [[nodiscard]] std::uint8_t slot() const noexcept { return slot_; }
  /// A recent picture.
  [[nodiscard]] SessionStatus status() const;
  /// Readable once it is over.
  [[nodiscard]] int over_fd() const noexcept { return over_event_.get(); }
  /// No shard serves it any more: everything may be looked at, and it may go.
  [[nodiscard]] bool over() const noexcept { return over_.load(std::memory_order_acquire); }

  /// What happened, for whoever writes it down: one thread reads. Full: dropped and counted.
  [[nodiscard]] AuditEvents& audit() noexcept { return audit_; }

  // ---- The shard's thread ----
  [[nodiscard]] Session& session() noexcept { return session_; }
  void tick(Time now, std::uint32_t missed, const MachineStatus& machine) noexcept;
  /// Its last act.
  void finish(Time now, const MachineStatus& machine) noexcept;

  // ---- After it is over ----
  [[nodiscard]] const SessionStatus& final_status() const noexcept { return picture_; }
  [[nodiscard]] const Violations& violations() const noexcept { return violations_; }
  /// Ticks that were not recorded because the server was too busy.
  [[nodiscard]] std::uint64_t spared() const noexcept { return spared_; }

 private:
  void look_at_seat(std::size_t seat, Time now) noexcept;
  void publish(Time now, const MachineStatus& machine) noexcept;
  void lay_down_checkpoint() noexcept;
  void draw_path_tokens() noexcept;

  const SceneSpec* scene_;
  std::uint8_t slot_;
  Session session_;
  TickQueue* records_;
  AuditEvents audit_{1024};
  Violations violations_;
  std::atomic<bool> over_{false};
  io::Fd over_event_;
  std::uint64_t ticks_ = 0, unrecorded_ = 0, spared_ = 0;
  SessionStatus picture_;
  mutable std::mutex published_lock_;  ///< the shard only tries it
  SessionStatus published_;
  std::shared_ptr<CheckpointMail> mail_;  ///< null: nobody keeps it
  std::uint64_t epoch_ = 1, kept_every_ = 0, since_kept_ = 0;
  bool keep_now_ = true, begun_ = false;
};

}  // namespace tandem::server

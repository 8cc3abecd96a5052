#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "client/seat/seat.h"
#include "netsim/system/attacker.h"
#include "netsim/system/fault_schedule.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Client program at one seat: it starts and dies, joins the session, and joins a restarted server again. A dead
/// program loses its core; its place in the scene stays.
class SimulatedProgram {
 public:
  /// @param key  randomness of its connections and of its back-off
  SimulatedProgram(const SceneSpec& scene, std::size_t seat, RandomKey key)
      : scene_(&scene), seat_index_(seat), key_(key) {}

  /// Starts the program unless it runs.
  void start() noexcept;
  /// Ends the program. @return whether it ran
  bool die() noexcept;
  /// Joins the session if the program has no seat, or joins again with new keys if the server restarted. It tries at
  /// most every 200 ms.
  /// @param attacker  learns the keys of the connection; may be null
  /// @return why the client cannot have the seat; empty if it can
  [[nodiscard]] std::string connect(Time now, server::Session& session, const hal::DeviceCaps& caps,
                                    Attacker* attacker);
  /// Applies the key presses of the user that the faults require. Needs a seat.
  void apply_stop_faults(Time now, const FaultSchedule& faults) noexcept;

  /// Returns the core; null while the program is dead or has no seat.
  [[nodiscard]] const client::Seat* seat() const noexcept { return seat_.get(); }
  [[nodiscard]] client::Seat* seat() noexcept { return seat_.get(); }
  [[nodiscard]] std::uint32_t starts() const noexcept { return starts_; }
  [[nodiscard]] std::uint32_t joins() const noexcept { return joins_; }  ///< number of connections so far
  /// Returns how often the gate has released the hand, including programs that ended.
  [[nodiscard]] std::uint32_t gate_trips() const noexcept {
    return trips_before_ + (seat_ ? seat_->gate().trips() : 0);
  }
  /// Returns the connection id at the server; 0 before the first join.
  [[nodiscard]] std::uint32_t server_cid() const noexcept { return server_cid_; }

 private:
  [[nodiscard]] std::string join_failed(server::JoinResult why, Time now, const server::Session& session,
                                        const hal::DeviceCaps& caps);

  const SceneSpec* scene_;
  std::size_t seat_index_;
  RandomKey key_;
  std::unique_ptr<client::Seat> seat_;
  bool running_ = false;
  bool stopped_ = false, stop_all_requested_ = false;  ///< by a fault: the user's own hand, the session
  std::uint64_t known_epoch_ = 0;                      ///< of the newest server that it knows of
  std::uint64_t epoch_ = 0;                            ///< of the session that it joined
  std::uint32_t joins_ = 0, starts_ = 0, trips_before_ = 0, server_cid_ = 0;
  Time retry_at_{};
  std::uint64_t join_attempts_ = 0;
};

}  // namespace tandem::netsim

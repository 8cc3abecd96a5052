#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/core/device.h"
#include "netsim/system/fault_schedule.h"
#include "netsim/system/simulation_config.h"
#include "server/policy/load_shedder.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Server process of a simulation: its session and slaves, its checkpoint, and the faults that end or suspend it.
/// Ticks that it misses while it is suspended are run later, all at once.
class SimulatedServer {
 public:
  /// @param config  must outlive the server
  explicit SimulatedServer(const SimulationConfig& config);

  /// Starts the first session. Call it once, before all other functions.
  /// @param scale  tip gain to port gain, per axis of the port
  /// @return an error: a slave that cannot be made; empty: none
  [[nodiscard]] std::string start(Time now, const AxisArray& scale);
  /// Ends the server or restarts it from its checkpoint, where the faults require it.
  /// @return why it cannot restart; empty: no error
  [[nodiscard]] std::string apply_restarts(Time now);
  /// Returns whether the server runs. While it does not, `session` has the state in which the server died.
  [[nodiscard]] bool up() const noexcept { return up_; }

  /// Returns the number of ticks that the server runs in the simulation's tick at `now`, 0 while it is suspended or
  /// busy. If it is not 0, call `run` and then `finish`.
  [[nodiscard]] std::uint32_t due_ticks(Time now) noexcept;
  /// Runs the ticks that are due, after the datagrams of this tick were given to the session.
  void run(Time now) noexcept;
  /// Takes the time that the tick costs, after its datagrams were sent.
  void finish(Time now, std::size_t sent);
  /// Updates the checkpoint twice a second and whenever participants, authority or the session's state change.
  /// @param participants_changed  a seat joined or left in this tick
  void update_checkpoint(Time now, bool participants_changed);

  [[nodiscard]] server::Session& session() noexcept { return *session_; }
  [[nodiscard]] const server::Session& session() const noexcept { return *session_; }
  [[nodiscard]] const server::Checkpoint& checkpoint() const noexcept { return checkpoint_; }

 private:
  /// Makes the session and its slaves.
  /// @param from  where they continue; null: at the beginning
  /// @return an error: a slave that cannot be made; empty: none
  [[nodiscard]] std::string make_session(Time now, const server::Checkpoint* from);

  const SimulationConfig* config_;
  FaultSchedule faults_;
  Duration tick_;
  AxisArray scale_{};
  std::unique_ptr<server::Session> session_;
  bool up_ = true;
  server::Checkpoint checkpoint_{};  ///< from which a restart resumes
  Time checkpoint_at_{};
  server::LoadShedder load_shedder_;
  Duration tick_used_{};      ///< processor time of the last tick, on the virtual processor
  Time busy_until_{};         ///< of that processor
  std::uint32_t missed_ = 0;  ///< ticks missed while the server's thread was suspended
  std::uint64_t token_draws_ = 0;
};

}  // namespace tandem::netsim

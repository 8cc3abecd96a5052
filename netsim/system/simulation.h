#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/engine/network.h"
#include "netsim/quality/link_monitor.h"
#include "netsim/system/invariant_checker.h"
#include "netsim/system/simulated_client.h"
#include "netsim/system/simulation_config.h"
#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Simulates the whole system in virtual time: the server's and the clients' own cores, simulated devices, hands and
/// slaves, and the network between them. It has one thread and reads no clock. The same setup and build give the same
/// trace, byte for byte.
class Simulation {
 public:
  /// Error: a device that cannot be made, a slave out of reach, or a fault or endpoint that names an unknown seat.
  /// @throws std::invalid_argument listing all problems of a link that cannot be simulated.
  [[nodiscard]] static std::expected<std::unique_ptr<Simulation>, std::string> make(const SimulationConfig& setup);

  /// Runs one tick. @return false once the session is over
  bool step();

  [[nodiscard]] Time now() const noexcept { return now_; }
  /// Returns whether the server runs. While it does not, `session` has the state in which the server died.
  [[nodiscard]] bool server_up() const noexcept { return server_up_; }
  /// Returns the checkpoint from which a server would restart now.
  [[nodiscard]] const server::Checkpoint& checkpoint() const noexcept { return checkpoint_; }
  /// Returns the session of the running server; each restart of the server makes another session.
  [[nodiscard]] const server::Session& session() const noexcept { return *session_; }
  [[nodiscard]] const client::Seat* seat(std::size_t i) const noexcept { return clients_[i].seat(); }
  [[nodiscard]] client::Seat* seat(std::size_t i) noexcept { return clients_[i].seat(); }
  [[nodiscard]] const hal::sim::SimDevice& device(std::size_t i) const noexcept { return clients_[i].device(); }
  [[nodiscard]] hal::sim::SimDevice& device(std::size_t i) noexcept { return clients_[i].device(); }
  [[nodiscard]] std::uint32_t gate_trips(std::size_t i) const noexcept { return clients_[i].gate_trips(); }
  /// Returns the current time on the clock of this seat's program.
  [[nodiscard]] Time client_time(std::size_t i) const noexcept { return clients_[i].own_time(now_); }
  /// Returns the session's record with every seat's values of this tick, without the network's delay.
  [[nodiscard]] const server::TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const server::Violations& violations() const noexcept { return checker_.violations(); }
  [[nodiscard]] const Network& network() const noexcept { return network_; }
  [[nodiscard]] Network& network() noexcept { return network_; }
  /// Returns the link statistics of this seat since the session began; null unless the setup requested them.
  [[nodiscard]] const LinkMonitor* link_monitor(std::size_t i) const noexcept {
    return i < link_monitors_.size() ? link_monitors_[i].get() : nullptr;
  }
  /// Starts the recovery phase: the caller guarantees that all faults are over. From then on the checker also judges
  /// invariants that hold only for ordinary motion.
  /// @return whether the hands of this scene move in such a way
  bool begin_recovery_phase() noexcept { return checker_.begin_recovery_phase(); }
  /// Called for each audit event of the session, in order; may be empty.
  std::function<void(const server::AuditEvent&)> on_audit = {};
  /// Returns why a seat could not join; empty if all joined.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return setup_.scene; }

 private:
  explicit Simulation(const SimulationConfig& setup)
      : setup_(setup),
        network_(setup.seed),
        tick_(from_seconds(1.0 / setup.scene.tick_hz)),
        load_shedder_(tick_),
        checker_(setup_.scene) {}
  [[nodiscard]] std::string add_client(std::size_t seat);
  void step_clients();
  [[nodiscard]] bool wakes_before(std::size_t a, std::size_t b) const noexcept;
  void step_server();
  [[nodiscard]] std::expected<std::vector<std::unique_ptr<hal::SteppedDevice>>, std::string> make_local_slaves(
      const server::Checkpoint* from) const;
  void attach_contact_sources();
  /// Ends or restarts the server where the faults require it.
  void apply_server_restart();
  void restart_server();
  void update_checkpoint(bool people_changed);
  void inject_attacks();
  void apply_resume_requests();
  [[nodiscard]] std::uint64_t heap_taken() const noexcept {
    return setup_.heap_count != nullptr ? setup_.heap_count() : 0;
  }
  [[nodiscard]] bool server_paused() const noexcept;
  void check_start_timeout();
  void update_record();
  void start_link_monitors();

  SimulationConfig setup_;
  Network network_;
  Duration tick_;
  server::LoadShedder load_shedder_;
  Duration tick_used_{};  ///< processor time of the server's last tick, on the virtual processor
  Time busy_until_{};
  Time now_{};
  std::unique_ptr<server::Session> session_;
  bool server_up_ = true;
  server::Checkpoint checkpoint_{};  ///< from which a restart resumes
  Time checkpoint_at_{};
  AxisArray scale_{};
  std::vector<SimulatedClient> clients_;
  std::vector<std::size_t> order_;  ///< order of clients within a tick; empty: all at the tick's end, by number
  std::vector<Fault> server_faults_, session_stop_faults_;
  std::uint64_t token_draws_ = 0;
  std::uint32_t server_missed_ = 0;  ///< ticks that the server missed while its thread was suspended
  std::array<std::byte, transport::kDatagramMax> buffer_{};
  server::TickRecord record_{};
  InvariantChecker checker_;
  std::vector<std::unique_ptr<LinkMonitor>> link_monitors_;  ///< by seat
  std::string trouble_;
};

}  // namespace tandem::netsim

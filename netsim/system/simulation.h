#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/engine/network.h"
#include "netsim/system/fault_schedule.h"
#include "netsim/system/invariant_checker.h"
#include "netsim/system/session_link_monitors.h"
#include "netsim/system/simulated_client.h"
#include "netsim/system/simulated_server.h"
#include "netsim/system/simulation_config.h"
#include "netsim/system/wake_order.h"
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
  /// Returns the server's process. While it does not run, `session` has the state in which the server died.
  [[nodiscard]] const SimulatedServer& server() const noexcept { return server_; }
  /// Returns the session of the running server; each restart of the server makes another session.
  [[nodiscard]] const server::Session& session() const noexcept { return server_.session(); }
  [[nodiscard]] const client::Seat* seat(std::size_t i) const noexcept { return clients_[i].seat(); }
  [[nodiscard]] client::Seat* seat(std::size_t i) noexcept { return clients_[i].seat(); }
  [[nodiscard]] const hal::sim::SimDevice& device(std::size_t i) const noexcept { return clients_[i].device(); }
  [[nodiscard]] hal::sim::SimDevice& device(std::size_t i) noexcept { return clients_[i].device(); }
  [[nodiscard]] const SimulatedClient& client(std::size_t i) const noexcept { return clients_[i]; }
  /// Returns the session's record with every seat's values of this tick, without the network's delay.
  [[nodiscard]] const server::TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const server::Violations& violations() const noexcept { return checker_.violations(); }
  [[nodiscard]] const Network& network() const noexcept { return network_; }
  [[nodiscard]] Network& network() noexcept { return network_; }
  /// Returns the link quality of every seat during the session, in the order of the scene. Empty unless the setup
  /// requested it (`monitor_quality`) and the session began.
  [[nodiscard]] std::vector<NamedLink> link_qualities() const { return link_monitors_.qualities(setup_.scene); }
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
        now_(Time{} + tick_),
        server_(setup_),
        order_(setup.scene.seats.size()),
        faults_(setup.faults),
        checker_(setup_.scene) {}
  [[nodiscard]] std::string add_client(std::size_t seat);
  void step_clients();
  void step_server();
  void receive_at_server();
  std::size_t send_from_server();
  void inject_attacks();
  void request_resumes();

  SimulationConfig setup_;
  Network network_;
  Duration tick_;
  Time now_;  ///< Time{} is the network's zero; the simulation begins one tick later: no time stamp is the empty one
  SimulatedServer server_;
  std::vector<SimulatedClient> clients_;
  WakeOrder order_;
  FaultSchedule faults_;  ///< of all seats and of the server
  std::array<std::byte, transport::kDatagramMax> buffer_{};
  server::TickRecord record_{};
  InvariantChecker checker_;
  SessionLinkMonitors link_monitors_;
  std::string trouble_;
};

}  // namespace tandem::netsim

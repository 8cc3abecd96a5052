#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/link_watch.h"
#include "netsim/network.h"
#include "netsim/world_setup.h"
#include "netsim/world_station.h"
#include "netsim/world_watch.h"
#include "server/session.h"
#include "server/violations.h"

namespace tandem::netsim {

/// The whole system in virtual time: the server's and the clients' own cores, simulated devices, hands and slaves, and
/// a network between them. One thread, no clock: same setup and build, same trace, byte for byte.
class World {
 public:
  /// Error: a device that cannot be made, a slave out of reach, a fault or an endpoint of a seat that is not there.
  /// @throws std::invalid_argument listing all problems of a link that cannot be simulated.
  [[nodiscard]] static std::expected<std::unique_ptr<World>, std::string> make(const WorldSetup& setup);

  /// One tick. @return false once the session is over.
  bool step();

  [[nodiscard]] Time now() const noexcept { return now_; }
  /// The server lives. While it does not, `session` is what it was when it died.
  [[nodiscard]] bool server_up() const noexcept { return up_; }
  /// What a restart would find now.
  [[nodiscard]] const server::Checkpoint& checkpoint() const noexcept { return checkpoint_; }
  /// Of another one than before after each restart of the server.
  [[nodiscard]] const server::Session& session() const noexcept { return *session_; }
  [[nodiscard]] const client::Seat* seat(std::size_t i) const noexcept { return stations_[i].seat(); }
  [[nodiscard]] client::Seat* seat(std::size_t i) noexcept { return stations_[i].seat(); }
  [[nodiscard]] const hal::sim::SimDevice& device(std::size_t i) const noexcept { return stations_[i].device(); }
  [[nodiscard]] hal::sim::SimDevice& device(std::size_t i) noexcept { return stations_[i].device(); }
  [[nodiscard]] std::uint32_t gate_trips(std::size_t i) const noexcept { return stations_[i].gate_trips(); }
  /// Now, on the clock of this seat's program.
  [[nodiscard]] Time own_time(std::size_t i) const noexcept { return stations_[i].own_time(now_); }
  /// The session's record with every seat's values of this very tick, not as old as the network made them.
  [[nodiscard]] const server::TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const server::Violations& violations() const noexcept { return watch_.violations(); }
  [[nodiscard]] const Network& network() const noexcept { return network_; }
  [[nodiscard]] Network& network() noexcept { return network_; }
  /// What this seat's link was like since the session began; null unless the setup asked for it.
  [[nodiscard]] const LinkWatch* quality(std::size_t i) const noexcept {
    return i < qualities_.size() ? qualities_[i].get() : nullptr;
  }
  /// Whoever drew the faults knows that they are over: from now on also what only ordinary motion is promised is judged.
  /// @return whether the hands of this scene move so
  bool is_calm() noexcept { return watch_.calm(); }
  /// Told what the session noted about its people, in order; may be empty.
  std::function<void(const server::AuditEvent&)> on_audit = {};
  /// Why a seat could not join, if so.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return setup_.scene; }

 private:
  explicit World(const WorldSetup& setup)
      : setup_(setup), network_(setup.seed), tick_(from_seconds(1.0 / setup.scene.tick_hz)), ladder_(tick_), watch_(setup_.scene) {}
  [[nodiscard]] std::string add_station(std::size_t seat);
  void serve_clients();
  [[nodiscard]] bool works_before(std::size_t a, std::size_t b) const noexcept;
  void serve_server();
  [[nodiscard]] std::expected<std::vector<std::unique_ptr<hal::SteppedDevice>>, std::string> make_slaves(const server::Checkpoint* from) const;
  void plug_contact_sources();
  /// Dies, or comes back, as the faults say.
  void keep_server();
  void restart_server();
  void keep_checkpoint(bool people_changed);
  void attack_server();
  void people_resume();
  [[nodiscard]] std::uint64_t heap_taken() const noexcept { return setup_.heap_count != nullptr ? setup_.heap_count() : 0; }
  [[nodiscard]] bool server_stands_still() const noexcept;
  void give_up_waiting();
  void take_record();
  void watch_links();

  WorldSetup setup_;
  Network network_;
  Duration tick_;
  server::LoadLadder ladder_;
  Duration tick_used_{};  ///< of the virtual processor, by the last tick of the server
  Time busy_until_{};
  Time now_{};
  std::unique_ptr<server::Session> session_;
  bool up_ = true;
  server::Checkpoint checkpoint_{};  ///< what a restart finds
  Time checkpoint_at_{};
  AxisArray scale_{};
  std::vector<WorldStation> stations_;
  std::vector<std::size_t> order_;  ///< in which stations work within a tick; empty: all at its end, by number
  std::vector<Fault> server_faults_, stops_;
  std::uint64_t token_draws_ = 0;
  std::uint32_t server_missed_ = 0;  ///< ticks the server's thread stood still
  std::array<std::byte, link::kDatagramMax> buffer_{};
  server::TickRecord record_{};
  WorldWatch watch_;
  std::vector<std::unique_ptr<LinkWatch>> qualities_;  ///< by seat
  std::string trouble_;
};

}  // namespace tandem::netsim

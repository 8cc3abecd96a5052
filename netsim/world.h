#pragma once

#include <cstdint>
#include <expected>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/joining.h"
#include "client/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/network.h"
#include "server/session.h"
#include "server/violations.h"

namespace tandem::netsim {

/// What `tandem-netsim run` needs to know.
struct WorldSetup {
  SceneSpec scene;
  LinkSpec network;  ///< every seat has one of its own
  std::uint64_t seed = 1;
  std::map<std::string, std::shared_ptr<const hal::sim::RecordedMotion>> motions;  ///< by seat
};

/// The whole system in virtual time: the server's and the clients' own cores, simulated devices, hands and slaves, and
/// a network between them. One thread, no clock: same setup and build, same trace, byte for byte.
class World {
 public:
  /// Error: a device that cannot be made, a slave out of reach, a seat that is refused.
  [[nodiscard]] static std::expected<std::unique_ptr<World>, std::string> make(const WorldSetup& setup);

  /// One tick. @return false once the session is over.
  bool step();

  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] const server::Session& session() const noexcept { return *session_; }
  [[nodiscard]] const client::Seat* seat(std::size_t i) const noexcept { return hands_[i].seat.get(); }
  [[nodiscard]] const hal::sim::SimDevice& device(std::size_t i) const noexcept { return *hands_[i].device; }
  [[nodiscard]] hal::sim::SimDevice& device(std::size_t i) noexcept { return *hands_[i].device; }
  [[nodiscard]] client::Seat* seat(std::size_t i) noexcept { return hands_[i].seat.get(); }
  /// The session's record with every seat's values of this very tick, not as old as the network made them.
  [[nodiscard]] const server::TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const server::Violations& violations() const noexcept { return violations_; }
  [[nodiscard]] const Network& network() const noexcept { return network_; }
  /// Why a seat could not join, if so.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return setup_.scene; }

 private:
  explicit World(const WorldSetup& setup) : setup_(setup), network_(setup.seed) {}
  void serve_clients();
  void serve_server();
  void join(std::size_t i);
  void give_up_waiting();
  void watch();
  void take_record();

  /// A workstation: device, hand and client core.
  struct Workstation {
    std::unique_ptr<hal::sim::SimDevice> device;
    std::unique_ptr<client::Joining> joining;
    std::unique_ptr<client::Seat> seat;
    hal::Command command{};
    std::uint64_t accepted_before = 0;
    double last_effort = 0;
  };

  WorldSetup setup_;
  Network network_;
  Duration tick_{};
  Time now_{};
  std::unique_ptr<server::Session> session_;
  std::vector<Workstation> hands_;
  std::array<std::byte, link::kDatagramMax> buffer_{};
  server::TickRecord record_{};
  server::Violations violations_;
  std::string trouble_;
};

}  // namespace tandem::netsim

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/distinct.h"
#include "netsim/endpoint_clock.h"
#include "netsim/fault.h"
#include "netsim/network.h"
#include "netsim/world_joining.h"
#include "netsim/world_tamper.h"
#include "proto/scene_spec.h"

namespace tandem::netsim {

/// A workstation of the virtual world: device, hand, the client's own core, and what goes wrong with them.
class WorldStation {
 public:
  struct Setup {
    const SceneSpec* scene = nullptr;
    std::size_t seat = 0;
    std::uint64_t seed = 1;
    std::unique_ptr<hal::sim::SimDevice> device;
    std::vector<Fault> faults;             ///< of this seat
    std::optional<EndpointSpec> endpoint;  ///< absent: the world's clock, and awake at every tick
  };
  explicit WorldStation(Setup setup);

  /// One tick, (now - tick, now]: the device lives, datagrams are heard, the client's core works and sends, all at the moment
  /// in it at which the program wakes up; without noise that is `now`. The station's number on the network is its seat's.
  /// @param session  null while there is no server
  /// @return why the seat cannot be had, else empty.
  [[nodiscard]] std::string step(Time now, server::Session* session, Network& network, std::span<std::byte> buffer);

  /// What an attacker sends to the server in this tick in the seat's name; empty: nothing.
  struct Forged {
    std::span<const std::byte> replayed, junk;
  };
  [[nodiscard]] Forged forged(Time now) noexcept;

  [[nodiscard]] const client::Seat* seat() const noexcept { return seat_.get(); }
  [[nodiscard]] client::Seat* seat() noexcept { return seat_.get(); }
  [[nodiscard]] const hal::sim::SimDevice& device() const noexcept { return *device_; }
  [[nodiscard]] hal::sim::SimDevice& device() noexcept { return *device_; }

  /// Losses of the hand so far, also of programs that died.
  [[nodiscard]] std::uint32_t gate_trips() const noexcept { return trips_before_ + (seat_ ? seat_->gate().trips() : 0); }
  /// The program's own clock at `now`.
  [[nodiscard]] Time own_time(Time now) const noexcept;
  /// The server was given this datagram: an attacker may use it again.
  void overheard(std::span<const std::byte> bytes) noexcept {
    if (tamper_) tamper_->remember(Direction::kUp, bytes);
  }

  /// When in the tick that ends at `now` its program will wake up; `now` if not at all. Before `step`, for the order of stations.
  [[nodiscard]] Time wakes_at(Time now) const noexcept;

  /// For oracles, of the last step: datagrams that the core was given for the first time; whether the core worked, and
  /// was given a reading that cannot be. And how often its program was started.
  [[nodiscard]] std::uint64_t heard_now() const noexcept { return heard_now_; }
  [[nodiscard]] bool served_now() const noexcept { return served_now_; }
  /// When the core worked last, and the energy the motor really gave the hand during the last step [J].
  [[nodiscard]] Time served_at() const noexcept { return served_at_; }
  [[nodiscard]] double worked_now() const noexcept { return worked_now_; }
  [[nodiscard]] bool misread_now() const noexcept { return misread_now_; }
  [[nodiscard]] std::uint32_t starts() const noexcept { return starts_; }
  /// Connections it had so far.
  [[nodiscard]] std::uint32_t joins() const noexcept { return joins_; }
  [[nodiscard]] bool suffers(Fault::Kind kind, Time now) const noexcept;
  [[nodiscard]] bool ever_suffers(Fault::Kind kind) const noexcept;

 private:
  void live(Duration length) noexcept;
  [[nodiscard]] std::string work(Time now, bool awake, server::Session* session, Network& network, std::span<std::byte> buffer);
  void rejoin(Time now, server::Session& session);
  [[nodiscard]] Duration wait_before_rejoin(std::uint64_t epoch) const noexcept;
  void act(Time now) noexcept;
  void listen(Time now, Network& network, std::span<std::byte> buffer);
  [[nodiscard]] std::string join(Time now, server::Session& session);
  [[nodiscard]] std::optional<double> hand_time(Time own) const noexcept;
  void serve(Time now, Network& network, std::span<std::byte> buffer);
  void hear(Time now, std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] const hal::State& reading(Time now) noexcept;

  const SceneSpec* scene_;
  std::size_t number_;
  Duration tick_;
  RandomKey key_;
  std::optional<EndpointClock> clock_;
  std::optional<WakeUps> wake_;
  std::vector<Fault> faults_;
  std::unique_ptr<hal::sim::SimDevice> device_;
  std::unique_ptr<client::Seat> seat_;
  std::unique_ptr<WorldTamper> tamper_;  ///< only where a fault needs it
  std::uint32_t server_cid_ = 0;
  hal::Command command_{};
  hal::State reading_{};  ///< in place of the device's, where a fault says so
  bool frozen_ = false, down_ = true, served_now_ = false, misread_now_ = false;
  bool stopped_ = false, wished_ = false;  ///< by a fault: his own hand, the session
  std::uint64_t noticed_ = 0;              ///< of the newest server it knows of
  std::uint64_t epoch_ = 0;                ///< of the session it joined
  std::uint32_t joins_ = 0, starts_ = 0, trips_before_ = 0;
  std::uint64_t heard_now_ = 0;
  Time served_at_{};
  double worked_now_ = 0;
  Distinct given_;
  Time ask_again_{};
  std::uint64_t asked_ = 0;
};

}  // namespace tandem::netsim

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/seat/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/engine/network.h"
#include "netsim/models/endpoint_clock.h"
#include "netsim/system/attacker.h"
#include "netsim/system/fault.h"
#include "netsim/system/first_seen_filter.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// Client workstation of a simulation: device, hand, the client's own core, and their faults.
class SimulatedClient {
 public:
  struct Setup {
    const SceneSpec* scene = nullptr;
    std::size_t seat = 0;
    std::uint64_t seed = 1;
    std::unique_ptr<hal::sim::SimDevice> device;
    std::vector<Fault> faults;             ///< of this seat
    std::optional<EndpointSpec> endpoint;  ///< absent: the simulation's clock, and a wake-up at every tick
  };
  explicit SimulatedClient(Setup setup);

  /// Runs one tick, (now - tick, now]: the device moves, the program receives datagrams, the client's core runs and
  /// sends. All of this happens when the program wakes up in the tick; without noise that is `now`. The client's link
  /// number on the network is its seat's number.
  /// @param session  null while there is no server
  /// @return why the client cannot have the seat; empty if it can
  [[nodiscard]] std::string step(Time now, server::Session* session, Network& network, std::span<std::byte> buffer);

  /// Datagrams that an attacker sends to the server in this tick under the seat's address; empty: none.
  struct AttackDatagrams {
    std::span<const std::byte> replayed, junk;
  };
  [[nodiscard]] AttackDatagrams attack_datagrams(Time now) noexcept;

  [[nodiscard]] const client::Seat* seat() const noexcept { return seat_.get(); }
  [[nodiscard]] client::Seat* seat() noexcept { return seat_.get(); }
  [[nodiscard]] const hal::sim::SimDevice& device() const noexcept { return *device_; }
  [[nodiscard]] hal::sim::SimDevice& device() noexcept { return *device_; }

  /// Returns how often the gate has released the hand, including programs that ended.
  [[nodiscard]] std::uint32_t gate_trips() const noexcept {
    return trips_before_ + (seat_ ? seat_->gate().trips() : 0);
  }
  /// Returns `now` on the program's own clock.
  [[nodiscard]] Time own_time(Time now) const noexcept;
  /// Stores a datagram that the server received, for a later replay attack.
  void remember_for_replay(std::span<const std::byte> bytes) noexcept {
    if (attacker_) attacker_->remember(Direction::kUp, bytes);
  }

  /// Returns when in the tick that ends at `now` the program will wake up; `now` if not at all. Call it before `step`,
  /// to order the clients.
  [[nodiscard]] Time wake_time(Time now) const noexcept;

  /// Values of the last step, for the checker: datagrams that the core received for the first time; whether the core
  /// ran, and whether its reading was invalid. Also the number of starts of the program.
  [[nodiscard]] std::uint64_t new_datagrams() const noexcept { return new_datagrams_; }
  [[nodiscard]] bool ran_in_tick() const noexcept { return ran_in_tick_; }
  /// When the core last ran, and the energy that the motor delivered during the last step [J].
  [[nodiscard]] Time last_run() const noexcept { return last_run_; }
  [[nodiscard]] double motor_work() const noexcept { return motor_work_; }
  [[nodiscard]] bool invalid_reading() const noexcept { return invalid_reading_; }
  [[nodiscard]] std::uint32_t starts() const noexcept { return starts_; }
  /// Returns the number of connections so far.
  [[nodiscard]] std::uint32_t joins() const noexcept { return joins_; }
  [[nodiscard]] bool has_fault(Fault::Kind kind, Time now) const noexcept;
  [[nodiscard]] bool ever_has_fault(Fault::Kind kind) const noexcept;

 private:
  void advance_device(Duration length) noexcept;
  [[nodiscard]] std::string run_program(Time now, bool awake, server::Session* session, Network& network,
                                        std::span<std::byte> buffer);
  void rejoin(Time now, server::Session& session);
  [[nodiscard]] Duration rejoin_backoff(std::uint64_t epoch) const noexcept;
  void apply_stop_faults(Time now) noexcept;
  void receive(Time now, Network& network, std::span<std::byte> buffer);
  [[nodiscard]] std::string join(Time now, server::Session& session);
  [[nodiscard]] std::optional<double> hand_time(Time own) const noexcept;
  void run_seat(Time now, Network& network, std::span<std::byte> buffer);
  void deliver(Time now, std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] const hal::State& reading(Time now) noexcept;

  const SceneSpec* scene_;
  std::size_t seat_index_;
  Duration tick_;
  RandomKey key_;
  std::optional<EndpointClock> clock_;
  std::optional<WakeUps> wake_;
  std::vector<Fault> faults_;
  std::unique_ptr<hal::sim::SimDevice> device_;
  std::unique_ptr<client::Seat> seat_;
  std::unique_ptr<Attacker> attacker_;  ///< only where a fault needs it
  std::uint32_t server_cid_ = 0;
  hal::Command command_{};
  hal::State reading_{};  ///< replaces the device's state during a fault of the sensor
  bool frozen_ = false, down_ = true, ran_in_tick_ = false, invalid_reading_ = false;
  bool stopped_ = false, stop_all_requested_ = false;  ///< by a fault: the user's own hand, the session
  std::uint64_t known_epoch_ = 0;                      ///< of the newest server it knows of
  std::uint64_t epoch_ = 0;                            ///< of the session it joined
  std::uint32_t joins_ = 0, starts_ = 0, trips_before_ = 0;
  std::uint64_t new_datagrams_ = 0;
  Time last_run_{};
  double motor_work_ = 0;
  FirstSeenFilter first_seen_;
  Time retry_at_{};
  std::uint64_t join_attempts_ = 0;
};

}  // namespace tandem::netsim

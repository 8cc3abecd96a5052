#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/seat/tick_phase.h"
#include "hal/sim/sim_device.h"
#include "netsim/engine/network.h"
#include "netsim/models/endpoint_clock.h"
#include "netsim/system/attacker.h"
#include "netsim/system/fault_schedule.h"
#include "netsim/system/first_seen_filter.h"
#include "netsim/system/sensor_faults.h"
#include "netsim/system/simulated_program.h"
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
    bool never_starts = false;             ///< the program does not run, and the seat stays free
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

  [[nodiscard]] const SimulatedProgram& program() const noexcept { return program_; }
  [[nodiscard]] const client::Seat* seat() const noexcept { return program_.seat(); }
  [[nodiscard]] client::Seat* seat() noexcept { return program_.seat(); }
  [[nodiscard]] const hal::sim::SimDevice& device() const noexcept { return *device_; }
  [[nodiscard]] hal::sim::SimDevice& device() noexcept { return *device_; }
  [[nodiscard]] const FaultSchedule& faults() const noexcept { return faults_; }

  /// Returns `now` on the program's own clock.
  [[nodiscard]] Time own_time(Time now) const noexcept;
  /// Stores a datagram that the server received, for a later replay attack.
  void remember_for_replay(std::span<const std::byte> bytes) noexcept {
    if (attacker_) attacker_->remember(Direction::kUp, bytes);
  }

  /// Returns when in the tick that ends at `now` the program will wake up; `now` if not at all. Call it before `step`,
  /// to order the clients.
  [[nodiscard]] Time wake_time(Time now) const noexcept;

  // Values of the last step, for the checkers.

  /// Returns the number of datagrams that the core received for the first time.
  [[nodiscard]] std::uint64_t new_datagrams() const noexcept { return new_datagrams_; }
  /// Returns whether the core ran, and when it last ran.
  [[nodiscard]] bool ran_in_tick() const noexcept { return ran_in_tick_; }
  [[nodiscard]] Time last_run() const noexcept { return last_run_; }
  /// Returns the energy that the motor delivered [J].
  [[nodiscard]] double motor_work() const noexcept { return motor_work_; }
  /// Returns the part of `motor_work` after the core ran [J]; 0 if it did not run.
  [[nodiscard]] double motor_work_after_run() const noexcept { return motor_work_after_run_; }
  [[nodiscard]] bool invalid_reading() const noexcept { return sensors_.invalid(); }

 private:
  void advance_device(Duration length) noexcept;
  [[nodiscard]] std::string run_program(Time now, bool awake, server::Session* session, Network& network,
                                        std::span<std::byte> buffer);
  void receive(Time now, Network& network, std::span<std::byte> buffer);
  [[nodiscard]] std::optional<double> hand_time(Time own) const noexcept;
  void run_seat(Time now, Network& network, std::span<std::byte> buffer);
  void deliver(Time at, std::span<const std::byte> bytes) noexcept;

  std::uint32_t link_;  ///< its link on the network: the number of its seat
  Duration tick_;
  bool never_starts_;
  std::optional<EndpointClock> clock_;
  std::optional<WakeUps> wake_;
  std::optional<client::TickPhase> phase_;  ///< of a program that shifts its wake-ups
  FaultSchedule faults_;
  std::unique_ptr<hal::sim::SimDevice> device_;
  SensorFaults sensors_;
  SimulatedProgram program_;
  std::unique_ptr<Attacker> attacker_;  ///< only where a fault needs it
  hal::Command command_{};
  bool ran_in_tick_ = false;
  std::uint64_t new_datagrams_ = 0;
  Time last_run_{};
  double motor_work_ = 0, motor_work_after_run_ = 0;
  FirstSeenFilter first_seen_;
};

}  // namespace tandem::netsim

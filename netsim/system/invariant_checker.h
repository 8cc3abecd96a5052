#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "netsim/system/authority_transfer_checker.h"
#include "netsim/system/first_seen_filter.h"
#include "netsim/system/hand_energy_checker.h"
#include "netsim/system/simulated_client.h"
#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Checks in every tick the invariants of ARCHITECTURE.md that a Simulation can observe. They hold for every network,
/// every motion of the hands and every fault. Each is judged from outside, by numbers that the checked guard does not
/// compute.
class InvariantChecker {
 public:
  explicit InvariantChecker(const SceneSpec& scene);

  /// Checks the state after a tick of the server and all clients.
  /// @param lived  ticks that the server ran in this simulation tick
  void check(std::uint32_t lived, const server::Session& session, const std::vector<SimulatedClient>& stations);
  /// Counts datagram number `index` of this seat, which the server received.
  void on_server_datagram(std::size_t seat, std::uint64_t index) noexcept;
  /// Checks an audit event of the session.
  void on_audit_event(const server::AuditEvent& event);
  /// Records that the server sent to an address that it had not validated.
  void on_reply_to_unknown_peer(double t) { violations_.add("mute", "", t, false); }
  /// Starts the recovery phase: no fault is active any more, and all hands are engaged. The checker then also judges
  /// invariants that hold only for ordinary motion.
  /// @return whether the motion of this scene is ordinary at all
  bool begin_recovery_phase() noexcept;
  /// Records that a core allocated memory within a tick: the core of a seat, or the server's.
  void note_heap_violation(std::size_t seat) { note("heap", seat); }
  void note_heap_violation() { violations_.add("heap", "", t_, false); }
  /// Marks violations of an invariant at a seat as expected. A seat with forged STATE, for example, reports an account
  /// that runs backwards.
  void expect(std::string_view invariant, std::string_view seat) { violations_.expect(invariant, seat); }

  [[nodiscard]] const server::Violations& violations() const noexcept { return violations_; }

 private:
  struct EndState {  ///< state of one end of a channel after the previous tick
    bool known = false;
    AxisArray ref{}, x{}, k{};
    EnergyArray in{}, received{};
    std::array<unsigned, kAxesMax> starved{};  ///< consecutive ticks
    /// The reference reached its target with energy to spare, after hand and tool were last apart.
    std::array<bool, kAxesMax> home{};
  };
  struct SeatState {
    std::uint32_t starts = 0, joins = 0;
    std::uint64_t trips = 0;  ///< of its gate
    bool was_active = false;
    AxisArray effort{};
    Time served{};
    double silence_limit = 0;  ///< longest silence limit since the last fresh datagram [s]
    Time arrived{}, fresh{};   ///< when the last fresh datagram arrived: on the seat's clock, on the simulation's
    double given = 0;          ///< energy that the motor delivered since then and since the gate's release [J]
    double late = 0;           ///< time since its program last ran, beyond one tick [s]
    bool awake = true;
    unsigned invalid_readings = 0, fast = 0, hot = 0;
    struct Frozen {  ///< reading at the time when it froze
      Time since{};
      AxisArray ref{}, effort{};
      bool on = false;
    } frozen;
    double stopped_s = 0;                           ///< since its client first reported a local stop [s]
    bool led = false, required_for_resume = false;  ///< had authority; must be back before any seat engages
    std::uint64_t accepted = 0, generation = 0, server_heard = 0;
    std::uint32_t session_tick = 0, seat_tick = 0;
    FirstSeenFilter given_to_server;
    struct Hand {  ///< input of the energy check over its whole session
      HandEnergyChecker energy;
      std::uint32_t starts = 0, joins = 0;
      double motor_work = 0;        ///< since its program last ran [J]
      unsigned ticks = 0;           ///< since then
      bool sensor_invalid = false;  ///< its sensor failed since then
      AxisArray effort{}, q{};      ///< at that time
    } hand;
    std::array<EndState, kToolsMax> client, server;  ///< by end of a channel

    /// Clears what was known of a client's previous program, after a restart.
    void reset_for_restart(std::uint32_t start) noexcept {
      starts = start;
      was_active = false;
      effort = {};
      served = arrived = fresh = Time{};
      given = 0;
      invalid_readings = fast = hot = session_tick = 0;
      accepted = 0;
      client = {};
    }
  };
  /// @param own  time on the seat's own clock
  void check_effort(Time own, std::size_t i, const SimulatedClient& station);
  void check_silence(Time own, std::size_t i, const SimulatedClient& station);
  void check_restart_barrier(const server::Session& session);
  void check_sensor(std::size_t i, const SimulatedClient& station);
  void check_role(std::size_t i, const SimulatedClient& station, const server::SeatEndpoint& port);
  void check_speed(std::size_t i, const SimulatedClient& station);
  [[nodiscard]] double share(std::size_t i) const noexcept;
  [[nodiscard]] AxisArray coupled_position(std::size_t seat, std::size_t tool,
                                           const server::Session& session) const noexcept;
  [[nodiscard]] AxisArray offset_of(std::size_t i, const server::Session& session) const noexcept;
  void check_energy(std::size_t i, const SimulatedClient& station);
  void check_hand(std::size_t i, const SimulatedClient& station);
  [[nodiscard]] double motor_max(std::size_t i, const SimulatedClient& station) const noexcept;
  void check_reading(std::size_t i, const SimulatedClient& station);
  void check_once(std::size_t i, const SimulatedClient& station, const server::SeatEndpoint& port);
  /// @param x        position of the body that this end is coupled to, after the tick
  /// @param coupled  position of the same body when the reference moved
  /// @param offset   hand minus tool that the session has yet to close
  /// @param steady   whether the end is judged at all
  struct EndSample {
    PortSample rx;
    AxisArray x{}, coupled{}, offset{};
    bool steady = false;
    double gains_speed = 0;  ///< speed that a prediction may add to the received speed [m/s]
  };
  void check_end(std::size_t i, const control::ChannelEnd& end, EndState& before, const AxisArray& scale,
                 const EndSample& look);
  void check_starvation(std::size_t i, const control::ChannelEnd& end, EndState& now, const EndState& before,
                        const AxisArray& scale, const EndSample& look);
  void check_authority(std::uint32_t lived, const server::Session& session);
  void check_felt_authority(std::size_t tool, const server::Session& session);
  [[nodiscard]] bool serves_only(std::size_t tool, std::size_t seat, const server::Session& session) const noexcept;
  void check_server_ends(std::size_t i, const server::Session& session, const client::Seat* seat, bool slave);
  void check_client_ends(std::size_t i, const client::Seat& seat, const server::Session& session, bool slave);
  void note(std::string_view invariant, std::size_t seat, bool expected = false);

  const SceneSpec* scene_;
  double t_ = 0;
  bool ordinary_ = false;        ///< one hand moves the tool and nothing hinders it
  std::size_t moving_seat_ = 0;  ///< index of that hand's seat
  std::vector<SeatState> seats_;
  std::vector<std::array<double, kMastersMax>> alpha_;
  std::vector<bool> held_;
  AuthorityTransferChecker transfers_;
  std::uint64_t epoch_ = 1;
  /// Set since a restart of the server; set while a seat that had authority is not back.
  bool recovering_ = false, participant_missing_ = false;
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};  ///< tip gain to port gain, as the seats received it
  server::Violations violations_;
};

}  // namespace tandem::netsim

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "netsim/distinct.h"
#include "netsim/world_hand_energy.h"
#include "netsim/world_handover.h"
#include "netsim/world_station.h"
#include "server/session.h"
#include "server/violations.h"

namespace tandem::netsim {

/// What must hold in every tick whatever the network, the hands and the faults do: the invariants of ARCHITECTURE.md that a
/// World can see, each judged from the outside, by numbers the guard itself does not decide about.
class WorldWatch {
 public:
  explicit WorldWatch(const SceneSpec& scene);

  /// After a tick of everybody.
  /// @param lived  ticks the server lived through in it
  void check(std::uint32_t lived, const server::Session& session, const std::vector<WorldStation>& stations);
  /// The server was given datagram number `index` of this seat.
  void server_heard(std::size_t seat, std::uint64_t index) noexcept;
  /// What the session noted about its people.
  void noted(const server::AuditEvent& event);
  /// The server wrote to an address that never showed who it is.
  void server_answered_a_stranger(double t) { violations_.note("mute", "", t, false); }
  /// From now on nothing is wrong any more, and everybody is active: what is only promised for ordinary motion is judged too.
  /// @return whether the motion of this scene is ordinary at all
  bool calm() noexcept;
  /// A core took memory within a tick: of a seat, or the server's.
  void took_heap(std::size_t seat) { note("heap", seat); }
  void took_heap() { violations_.note("heap", "", t_, false); }
  /// A seat that is made to lie about its energy: that its account is seen to run backwards is no breach of ours.
  void excuse(std::string_view invariant, std::string_view seat) { violations_.excuse(invariant, seat); }

  [[nodiscard]] const server::Violations& violations() const noexcept { return violations_; }

 private:
  struct End {  ///< of a channel, as it was a tick ago
    bool known = false;
    AxisArray ref{}, x{}, k{};
    EnergyArray in{}, received{};
    std::array<unsigned, kAxesMax> starved{};  ///< ticks on end
    std::array<bool, kAxesMax> home{};         ///< the reference has reached its target with energy to spare since hand and tool were last apart
  };
  struct Seat {
    std::uint32_t starts = 0, joins = 0;
    std::uint64_t trips = 0;  ///< of its gate
    bool was_active = false;
    AxisArray effort{};
    Time served{};
    double silence_limit = 0;  ///< longest that was in force since [s]
    Time arrived{}, fresh{};  ///< when something newer last acted: on the seat's clock, on the world's
    double given = 0;         ///< energy the motor really gave the hand since then, and since the gate let go [J]
    double late = 0;          ///< for how long its program has not been awake, beyond a tick [s]
    bool awake = true;
    unsigned misread = 0, fast = 0, hot = 0;
    struct Frozen {  ///< when the reading stopped to move
      Time since{};
      AxisArray ref{}, effort{};
      bool on = false;
    } frozen;
    double stopped_s = 0;  ///< since its client began to say that the person stopped his hand
    bool led = false, needed = false;  ///< had weight; has to be back before anybody is engaged again
    std::uint64_t accepted = 0, generation = 0, server_heard = 0;
    std::uint32_t session_tick = 0, seat_tick = 0;
    Distinct given_to_server;
    struct Hand {  ///< for the energy of its whole session
      HandEnergy energy;
      std::uint32_t starts = 0, joins = 0;
      double worked = 0;         ///< since its program last worked [J]
      unsigned ticks = 0;        ///< since then
      bool lied = false;         ///< its sensor, since then
      AxisArray effort{}, q{};   ///< of then
    } hand;
    std::array<End, kToolsMax> client, server;  ///< per end

    /// The client's program was started once more: what was known of the one before is void.
    void begin_anew(std::uint32_t start) noexcept {
      starts = start;
      was_active = false;
      effort = {};
      served = arrived = fresh = Time{};
      given = 0;
      misread = fast = hot = session_tick = 0;
      accepted = 0;
      client = {};
    }
  };
  /// @param own  on the seat's own clock
  void check_effort(Time own, std::size_t i, const WorldStation& station);
  void check_silence(Time own, std::size_t i, const WorldStation& station);
  void check_gathering(const server::Session& session);
  void check_sensor(std::size_t i, const WorldStation& station);
  void check_role(std::size_t i, const WorldStation& station, const server::SeatPort& port);
  void check_speed(std::size_t i, const WorldStation& station);
  [[nodiscard]] double share(std::size_t i) const noexcept;
  [[nodiscard]] AxisArray hung_on(std::size_t seat, std::size_t tool, const server::Session& session) const noexcept;
  [[nodiscard]] AxisArray offset_of(std::size_t i, const server::Session& session) const noexcept;
  void check_energy(std::size_t i, const WorldStation& station);
  void check_hand(std::size_t i, const WorldStation& station);
  [[nodiscard]] double motor_max(std::size_t i, const WorldStation& station) const noexcept;
  void check_reading(std::size_t i, const WorldStation& station);
  void check_once(std::size_t i, const WorldStation& station, const server::SeatPort& port);
  /// @param x   of what hangs on this end, after the tick  @param hung  of the same, when the reference moved
  /// @param offset  hand minus tool, that the session has yet to close  @param steady  judged at all
  struct EndLook {
    PortSample rx;
    AxisArray x{}, hung{}, offset{};
    bool steady = false;
    double gains_speed = 0;  ///< [m/s] that a prediction may add to the speed heard
  };
  void check_end(std::size_t i, const control::ChannelEnd& end, End& before, const AxisArray& scale, const EndLook& look);
  void check_starvation(std::size_t i, const control::ChannelEnd& end, End& now, const End& before, const AxisArray& scale, const EndLook& look);
  void check_authority(std::uint32_t lived, const server::Session& session);
  void check_felt(std::size_t tool, const server::Session& session);
  [[nodiscard]] bool serves_only(std::size_t tool, std::size_t seat, const server::Session& session) const noexcept;
  void check_server_ends(std::size_t i, const server::Session& session, const client::Seat* seat, bool slave);
  void check_client_ends(std::size_t i, const client::Seat& seat, const server::Session& session, bool slave);
  void note(std::string_view invariant, std::size_t seat, bool expected = false);

  const SceneSpec* scene_;
  double t_ = 0;
  bool ordinary_ = false;  ///< one hand moves the tool and nothing hinders it
  std::size_t mover_ = 0;  ///< whose
  std::vector<Seat> seats_;
  std::vector<std::array<double, kMastersMax>> alpha_;
  std::vector<bool> held_;
  HandoverWatch handover_;
  std::uint64_t epoch_ = 1;
  bool gathering_ = false, away_ = false;  ///< since a restart; somebody who led is not back yet
  AxisArray scale_{1, 1, 1, 1, 1, 1, 1};  ///< tip gain to port gain, as the seats were told
  server::Violations violations_;
};

}  // namespace tandem::netsim

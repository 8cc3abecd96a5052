#pragma once

#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/seat/device_facts.h"
#include "client/seat/seat.h"
#include "common/base/rng.h"
#include "hal/sim/local_slaves.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/session/build_text.h"
#include "server/session/session.h"

namespace tandem::server::test {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;

inline PeerAddress address(std::uint8_t n) {
  PeerAddress e;
  e.bytes[0] = std::byte{n};
  e.size = 1;
  return e;
}

/// Hash that distinguishes two runs of a test; not secure against attackers.
struct Fingerprint {
  void add(std::span<const std::byte> bytes) noexcept {
    for (const std::byte b : bytes) value = mix64(value ^ std::to_integer<std::uint64_t>(b));
  }
  std::uint64_t value = 0;
};

/// One client of a seat: device, core and address.
struct FixtureSeat {
  std::unique_ptr<hal::sim::SimDevice> device;
  transport::SecureChannel::Params params;  ///< its keys, for attackers that stole them
  std::unique_ptr<client::Seat> core;
  std::uint8_t at = 0;  ///< address; seat i starts at i + 1
  hal::Command command{};
};

/// A real session and the real client cores of all its seats, without network delay. A test can insert an attacker
/// anywhere.
class SessionFixture {
 public:
  /// @param key     selects keys and connection ids
  /// @param rekey   policy of both ends
  /// @param change  modifies the scene before any client joins
  /// @param as_server  only tools that the server simulates have a slave, as in a server
  /// @param journal    records the inputs of the session; null: nothing does. @pre as_server
  explicit SessionFixture(const std::string& scene_name = "one_axis", std::uint64_t key = 3,
                          const transport::RekeyPolicy& rekey = {}, std::uint8_t slot = 0,
                          void (*change)(SceneSpec&) = nullptr, bool as_server = false,
                          InputJournal* journal = nullptr)
      : scene(*parse_scene(find_shipped_scene(scene_name)->text, scene_name + ".textproto")) {
    if (change != nullptr) change(scene);
    AxisArray scale;
    scale.fill(1);
    std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
    if (as_server) slaves = *hal::sim::make_local_slaves(scene, Time{}, [](std::size_t) { return nullptr; });
    for (const ToolSpec& tool : scene.tools)
      if (!as_server) slaves.push_back(std::move(*hal::sim::SimDevice::make({tool.slave, {}, tool.environment, nullptr, Time{}})));
    session = std::make_unique<Session>(scene, std::move(slaves), scale);
    if (journal != nullptr) session->attach_journal(*journal, Time{}, build_text());
    for (std::size_t i = 0; i < scene.seats.size(); ++i) {
      FixtureSeat seat;
      seat.device =
          std::move(*hal::sim::SimDevice::make({scene.seats[i].device, scene.seats[i].hand, {}, nullptr, now}));
      auto joined = netsim::simulate_join(*session, now, i, seat.device->caps(), RandomKey{key}, i + 1, false, slot);
      seat.params = joined->channel_params;
      seat.params.rekey = rekey;
      if (rekey.packets != transport::RekeyPolicy{}.packets)
        renew(i, seat.params, client::device_facts(seat.device->caps()));
      seat.core = std::make_unique<client::Seat>(joined->setup, seat.device->caps(), seat.params);
      seat.at = static_cast<std::uint8_t>(i + 1);
      seats.push_back(std::move(seat));
    }
  }

  /// Runs one tick of a client. @return the datagrams it sends
  std::vector<Bytes> client_tick(std::size_t i = 0) {
    FixtureSeat& s = seats[i];
    if (ticked_) s.device->advance(s.command, 1ms);
    s.device->set_session_time(s.core->clock().session_time(now));
    s.command = s.core->on_servo(now, s.device->state());
    std::vector<Bytes> out;
    std::array<std::byte, transport::kDatagramMax> buffer;
    while (const auto size = s.core->poll_transmit(now, buffer))
      out.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
    return out;
  }
  /// Runs one tick of the server. @return the datagrams it sends, with their addresses
  std::vector<std::pair<std::uint8_t, Bytes>> server_tick() {
    session->on_tick(now, 0);
    return server_sends();
  }
  /// Datagrams that the server has due now, without a tick.
  std::vector<std::pair<std::uint8_t, Bytes>> server_sends() {
    std::vector<std::pair<std::uint8_t, Bytes>> out;
    std::array<std::byte, transport::kDatagramMax> buffer;
    while (const auto due = session->poll_transmit(now, buffer)) {
      const auto to = std::to_integer<std::uint8_t>(due->to.bytes[0]);
      const auto bytes = std::span{buffer}.first(due->size);
      ++(transport::read_header(bytes)->type == wire::Type::kForce ? forces : challenges)[to];
      told.add(bytes);
      out.emplace_back(to, Bytes(bytes.begin(), bytes.end()));
    }
    return out;
  }
  void to_clients(const std::vector<std::pair<std::uint8_t, Bytes>>& sent) {
    others.clear();
    for (const auto& [to, bytes] : sent) {
      bool taken = false;
      for (FixtureSeat& s : seats)
        if (to == s.at) s.core->on_datagram(now, bytes), taken = true;
      if (!taken) others.emplace_back(to, bytes);
    }
  }
  /// Runs one millisecond of all clients and the server. @param between called after the clients have sent and before
  /// the server sends
  template <class Between>
  void tick(Between between) {
    for (std::size_t i = 0; i < seats.size(); ++i)
      for (const Bytes& d : client_tick(i)) session->on_datagram(now, address(seats[i].at), d);
    between();
    to_clients(server_tick());
    ticked_ = true;
    now += 1ms;
  }
  void run(Duration length) {
    for (const Time end = now + length; now < end;) tick([] {});
  }
  [[nodiscard]] const transport::SecureChannelStats& heard(std::size_t i = 0) const {
    return session->seat(i).link()->stats();
  }
  [[nodiscard]] std::uint64_t refused(transport::DropReason why, std::size_t i = 0) const {
    return heard(i).dropped[static_cast<std::size_t>(why)];
  }

  /// Hash of all state that affects the session's future or a participant's hand: tools, springs, authority, energies,
  /// accepted messages.
  [[nodiscard]] std::uint64_t state_hash() const {
    Fingerprint digest;
    const auto add = [&](const auto& value) { digest.add(std::as_bytes(std::span{&value, 1})); };
    add(session->state());
    add(session->clock().session_tick());
    add(session->authority().version());
    for (std::size_t j = 0; j < scene.tools.size(); ++j) {
      add(session->tool(j).position());
      for (std::size_t k = 0; k < scene.masters(); ++k) add(session->tool(j).authority.alpha(k));
    }
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const SeatEndpoint& port = session->seat(i);
      const control::EndState& end = port.end().state();
      for (std::size_t a = 0; a < scene.dof; ++a) {
        add(end.ref[a]);
        add(end.k[a]);
        add(port.end().e_in()[a]);
        add(port.last_state().port.x[a]);
        add(seats[i].device->ground_truth().x[0]);
      }
      add(port.generation());
      add(port.taken());
      add(port.link()->stats().newest);
      add(port.link()->sending_phase());
      add(port.link()->receiving_phase());
    }
    return digest.value;
  }

  SceneSpec scene;
  Time now{1h};
  std::unique_ptr<Session> session;
  std::vector<FixtureSeat> seats;
  std::map<std::uint8_t, int> forces, challenges;      ///< by address
  std::vector<std::pair<std::uint8_t, Bytes>> others;  ///< of the last tick, to addresses of no seat
  Fingerprint told;                                    ///< every byte that the server has sent

 private:
  /// Gives the connection other keys or another rekey policy.
  void renew(std::size_t i, transport::SecureChannel::Params client, const rpc::DeviceFacts& device) {
    std::swap(client.own_cid, client.peer_cid);
    client.outgoing = transport::Direction::kToClient;
    SeatConnection entry = session->seat_catalogue().make_connection(i, client, device);
    static_cast<void>(session->admit(now, i, entry, true));
  }
  bool ticked_ = false;
};

}  // namespace tandem::server::test

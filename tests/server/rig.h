#pragma once

#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/device_facts.h"
#include "client/seat.h"
#include "common/base/rng.h"
#include "hal/sim/sim_device.h"
#include "netsim/world_joining.h"
#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"
#include "server/session.h"

namespace tandem::server::test {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;

inline Endpoint address(std::uint8_t n) {
  Endpoint e;
  e.bytes[0] = std::byte{n};
  e.size = 1;
  return e;
}

/// Not against attackers: tells two runs of a test apart.
struct Fingerprint {
  void add(std::span<const std::byte> bytes) noexcept {
    for (const std::byte b : bytes) value = mix64(value ^ std::to_integer<std::uint64_t>(b));
  }
  std::uint64_t value = 0;
};

/// One client of a seat: device, core, and where it is.
struct RigSeat {
  std::unique_ptr<hal::sim::SimDevice> device;
  link::Link::Params params;  ///< its keys, for attackers who stole them
  std::unique_ptr<client::Seat> core;
  std::uint8_t at = 0;        ///< address; seat i begins at i + 1
  hal::Command command{};
};

/// A real session core and the real client cores of all its seats, with no time between them and an attacker wherever a test wants one.
class Rig {
 public:
  /// @param key  other keys and connection ids for another number  @param rekey  of both ends  @param change  of the scene, before anybody comes
  explicit Rig(const std::string& scene_name = "one_axis", std::uint64_t key = 3, const link::RekeyRule& rekey = {}, std::uint8_t slot = 0,
               void (*change)(SceneSpec&) = nullptr)
      : scene(*parse_scene(find_shipped_scene(scene_name)->text, scene_name + ".textproto")) {
    if (change != nullptr) change(scene);
    AxisArray scale;
    scale.fill(1);
    std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
    for (const ToolSpec& tool : scene.tools) slaves.push_back(std::move(*hal::sim::SimDevice::make({tool.slave, {}, tool.environment, nullptr, Time{}})));
    session = std::make_unique<Session>(scene, std::move(slaves), scale);
    for (std::size_t i = 0; i < scene.seats.size(); ++i) {
      RigSeat seat;
      seat.device = std::move(*hal::sim::SimDevice::make({scene.seats[i].device, scene.seats[i].hand, {}, nullptr, now}));
      auto joined = netsim::join_virtually(*session, now, i, seat.device->caps(), RandomKey{key}, i + 1, false, slot);
      seat.params = joined->link;
      seat.params.rekey = rekey;
      if (rekey.packets != link::RekeyRule{}.packets) renew(i, seat.params, client::device_facts(seat.device->caps()));
      seat.core = std::make_unique<client::Seat>(joined->setup, seat.device->caps(), seat.params);
      seat.at = static_cast<std::uint8_t>(i + 1);
      seats.push_back(std::move(seat));
    }
  }

  /// A tick of one client; what it sends.
  std::vector<Bytes> client_tick(std::size_t i = 0) {
    RigSeat& s = seats[i];
    if (ticked_) s.device->advance(s.command, 1ms);
    s.device->set_session_time(s.core->session_time(now));
    s.command = s.core->on_servo(now, s.device->state());
    std::vector<Bytes> out;
    std::array<std::byte, link::kDatagramMax> buffer;
    while (const auto size = s.core->poll_transmit(now, buffer)) out.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
    return out;
  }
  /// A tick of the server; what it sends, to whom.
  std::vector<std::pair<std::uint8_t, Bytes>> server_tick() {
    session->on_tick(now, 0);
    return server_sends();
  }
  /// What the server has to say now, without a tick.
  std::vector<std::pair<std::uint8_t, Bytes>> server_sends() {
    std::vector<std::pair<std::uint8_t, Bytes>> out;
    std::array<std::byte, link::kDatagramMax> buffer;
    while (const auto due = session->poll_transmit(now, buffer)) {
      const auto to = std::to_integer<std::uint8_t>(due->to.bytes[0]);
      const auto bytes = std::span{buffer}.first(due->size);
      ++(link::read_header(bytes)->type == wire::Type::kForce ? forces : challenges)[to];
      told.add(bytes);
      out.emplace_back(to, Bytes(bytes.begin(), bytes.end()));
    }
    return out;
  }
  void to_clients(const std::vector<std::pair<std::uint8_t, Bytes>>& sent) {
    for (const auto& [to, bytes] : sent)
      for (RigSeat& s : seats)
        if (to == s.at) s.core->on_datagram(now, bytes);
  }
  /// A millisecond of everybody. @param between  called when the clients have spoken and the server has not
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
  [[nodiscard]] const link::LinkStats& heard(std::size_t i = 0) const { return session->seat(i).link()->stats(); }
  [[nodiscard]] std::uint64_t refused(link::Refusal why, std::size_t i = 0) const { return heard(i).refused[static_cast<std::size_t>(why)]; }

  /// Everything by which the session's future could differ, and a person's hand: tools, springs, weights, energies, what acted.
  [[nodiscard]] std::uint64_t state_hash() const {
    Fingerprint digest;
    const auto add = [&](const auto& value) { digest.add(std::as_bytes(std::span{&value, 1})); };
    add(session->state());
    add(session->session_tick());
    add(session->authority_version());
    for (std::size_t j = 0; j < scene.tools.size(); ++j) {
      add(session->tool(j).position());
      for (std::size_t k = 0; k < scene.masters(); ++k) add(session->tool(j).authority.alpha(k));
    }
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const SeatPort& port = session->seat(i);
      const control::EndState& end = port.end().state();
      for (std::size_t a = 0; a < scene.dof; ++a) {
        add(end.ref[a]);
        add(end.k[a]);
        add(port.end().e_in()[a]);
        add(port.heard().port.x[a]);
        add(seats[i].device->truth().x[0]);
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
  std::vector<RigSeat> seats;
  std::map<std::uint8_t, int> forces, challenges;  ///< by address
  Fingerprint told;                                ///< every byte the server sent so far

 private:
  /// The same connection with another rule for its keys.
  void renew(std::size_t i, link::Link::Params client, const control::DeviceFacts& device) {
    std::swap(client.own_cid, client.peer_cid);
    client.outgoing = link::Direction::kToClient;
    Entry entry = session->reception().prepare(i, client, device);
    static_cast<void>(session->admit(now, i, entry, true));
  }
  bool ticked_ = false;
};

}  // namespace tandem::server::test

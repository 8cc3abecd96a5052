#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "client/seat/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "server/app/process/live_session.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {

using namespace std::chrono_literals;

/// A live session of scene one_axis with simulated hands.
struct HostedHands {
  explicit HostedHands(server::TickQueue& records)
      : hosted(scene, *server::make_local_slaves(scene, Time{}), 0, records) {
    for (std::size_t i = 0; i < scene.seats.size(); ++i) {
      auto device = *hal::sim::SimDevice::make(
          {scene.seats[i].device, scene.seats[i].hand, scene.seats[i].environment, nullptr, now});
      hands.push_back({std::move(device), nullptr, {}});
      join(i);
    }
  }
  HostedHands(const HostedHands&) = delete;
  HostedHands& operator=(const HostedHands&) = delete;

  /// Joins the seat of a hand, the first time or again with a new connection.
  void join(std::size_t i) {
    const hal::DeviceCaps caps = hands[i].device->caps();
    const auto joined = *netsim::simulate_join(hosted.session(), now, i, caps, RandomKey{7}.derive(i), joins++, true);
    hands[i].seat = std::make_unique<client::Seat>(joined.setup, caps, joined.channel_params);
  }
  /// A datagram of a hand arrives at the server.
  void arrive(std::size_t i, std::span<const std::byte> datagram) {
    server::PeerAddress from;
    from.bytes[0] = static_cast<std::byte>(i + 1);
    from.size = 1;
    hosted.session().on_datagram(now, from, datagram);
  }
  /// Runs one tick of hands, clients and server.
  void step(const server::MachineStatus& machine = {}) {
    for (std::size_t i = 0; i < hands.size(); ++i) {
      hands[i].device->advance(hands[i].command, 1ms);
      hands[i].command = hands[i].seat->on_servo(now, hands[i].device->state());
      while (const auto size = hands[i].seat->poll_transmit(now, buffer)) up(i, std::span{buffer}.first(*size));
    }
    hosted.tick(now, now, 0, machine);
    while (const auto out = hosted.session().poll_transmit(now, buffer))
      down.push_back({now + delay,
                      std::to_integer<std::size_t>(out->to.bytes[0]) - 1,
                      {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(out->size)}});
    for (; !down.empty() && down.front().due <= now; down.pop_front())
      hands[down.front().hand].seat->on_datagram(now, down.front().bytes);
    now += 1ms;
  }
  [[nodiscard]] bool begun() { return hosted.session().start_condition().begun(); }

  struct Hand {
    std::unique_ptr<hal::sim::SimDevice> device;
    std::unique_ptr<client::Seat> seat;
    hal::Command command;
  };
  struct Datagram {
    Time due;
    std::size_t hand;
    std::vector<std::byte> bytes;
  };
  SceneSpec scene = shipped("one_axis");
  Time now = Time{} + 1ms;
  server::LiveSession hosted;
  std::vector<Hand> hands;
  std::uint64_t joins = 0;
  Duration delay{};  ///< of datagrams to the hands; a change applies to those sent from now on, in their order
  std::deque<Datagram> down;
  /// Takes each datagram of a hand.
  std::function<void(std::size_t, std::span<std::byte>)> up = [this](std::size_t i, auto bytes) { arrive(i, bytes); };
  std::array<std::byte, transport::kDatagramMax> buffer;
};

}  // namespace tandem::test

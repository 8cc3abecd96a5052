#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

#include "common/transport/secure_channel.h"
#include "server/app/process/local_slaves.h"
#include "server/session/session.h"
#include "tests/bench/bench_clients.h"
#include "tests/bench/instruction_count.h"

namespace tandem::bench {

/// One datagram in memory.
struct Carried {
  std::array<std::byte, transport::kDatagramMax> bytes;
  std::size_t size = 0;
  std::size_t client = 0;
  server::PeerAddress address;  ///< of the client
};

inline server::PeerAddress address_of(std::size_t client) {
  server::PeerAddress e;
  e.bytes[0] = static_cast<std::byte>(client);
  e.bytes[1] = static_cast<std::byte>(client >> 8);
  e.size = 2;
  return e;
}

inline std::size_t client_at(const server::PeerAddress& address) {
  return std::to_integer<std::size_t>(address.bytes[0]) | std::to_integer<std::size_t>(address.bytes[1]) << 8;
}

/// Does all work of a server in a tick. callgrind counts inside this function and needs its symbol: not inlined.
/// @return number of datagrams in `out`
[[gnu::noinline]] inline std::size_t serve_one_tick(std::vector<std::unique_ptr<server::Session>>& sessions,
                                                    std::size_t seats, Time now, std::span<const Carried> in,
                                                    std::span<Carried> out) {
  for (const Carried& d : in) sessions[d.client / seats]->on_datagram(now, d.address, std::span{d.bytes}.first(d.size));
  std::size_t sent = 0;
  for (auto& session : sessions) {
    session->on_tick(now, 0);
    while (sent < out.size()) {
      const auto due = session->poll_transmit(now, out[sent].bytes);
      if (!due) break;
      out[sent].size = due->size;
      out[sent++].address = due->to;
    }
  }
  return sent;
}

/// @param recorded  as of a server that writes a report or trace (LiveSession::set_recorded)
inline std::unique_ptr<server::Session> session_of(const SceneSpec& scene, bool recorded) {
  auto slaves = *server::make_local_slaves(scene, Time{});
  auto session = std::make_unique<server::Session>(scene, std::move(slaves.devices), slaves.scale);
  session->set_telemetry_every_tick(recorded);
  if (!recorded)
    session->set_record_interval(static_cast<std::uint32_t>(std::ceil(scene.tick_hz / wire::kTelemetryHz)));
  return session;
}

/// Runs `kSessions` sessions in memory, for callgrind. @return exit code
inline int serve(const SceneSpec& scene, bool recorded, int ticks) {
  const std::size_t seats = scene.seats.size();
  std::vector<std::unique_ptr<server::Session>> sessions;
  std::vector<std::unique_ptr<BareClient>> clients;
  Time now{std::chrono::hours(1)};
  for (std::size_t s = 0; s < kSessions; ++s) {
    sessions.push_back(session_of(scene, recorded));
    for (std::size_t i = 0; i < seats; ++i)
      clients.push_back(std::make_unique<BareClient>(
          *netsim::simulate_join(*sessions.back(), now, i, caps_of(scene, i), RandomKey{s}, i)));
  }
  std::vector<Carried> in(2 * clients.size()), out(2 * clients.size());
  for (int tick = 0; tick < ticks; ++tick, now += std::chrono::milliseconds(1)) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < clients.size(); ++c)
      for (bool more = true; more;) {
        more = clients[c]->answers();
        in[count].client = c;
        in[count].address = address_of(c);
        in[count].size = clients[c]->send(now, static_cast<std::uint32_t>(tick), in[count].bytes);
        ++count;
      }
    const std::size_t sent = serve_one_tick(sessions, seats, now, std::span{in}.first(count), out);
    for (const Carried& d : std::span{out}.first(sent))
      clients[client_at(d.address)]->hear(now, std::span{d.bytes}.first(d.size));
  }
  for (const auto& session : sessions)
    if (session->state() != wire::SessionState::kRunning) return 1;  // otherwise it measured waiting participants
  std::printf("%zu client-ticks\n", clients.size() * static_cast<std::size_t>(ticks));
  return 0;
}

}  // namespace tandem::bench

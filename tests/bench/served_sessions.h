#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "client/diagnostics/session_watch.h"
#include "common/transport/secure_channel.h"
#include "netsim/system/simulated_handshake.h"
#include "server/app/process/local_slaves.h"
#include "server/session/build_text.h"
#include "server/session/input_journal.h"
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

/// Address of the console that watches this session; behind those of all clients.
inline constexpr std::size_t kFirstWatcher = 0x8000;

/// Returns a console that joined the session. @param recorder  it gets every tick
inline std::unique_ptr<client::SessionWatch> watcher_of(server::Session& session, Time now, bool recorder) {
  const auto joined = *netsim::simulate_watch_join(session, now, RandomKey{77}, 1, recorder);
  return std::make_unique<client::SessionWatch>(server::telemetry_layout(session.scene()),
                                                session.seat_catalogue().tick(), joined.channel_params);
}

/// Work of a server besides its scene.
struct Load {
  bool recorded = false;                       ///< a report or trace is written: telemetry and a record at every tick
  std::optional<bool> watched = std::nullopt;  ///< a console sees each session; true: a recorder
  bool inputs = false;  ///< everything that enters a session is recorded; the journals are drained outside of the count
  bool swinging = false;  ///< hands move
};

/// Runs `kSessions` sessions in memory, for callgrind. @return exit code
inline int serve(const SceneSpec& scene, const Load& load, int ticks) {
  const std::size_t seats = scene.seats.size();
  std::vector<std::unique_ptr<server::Session>> sessions;
  std::vector<std::unique_ptr<server::InputJournal>> journals;
  std::vector<std::byte> drained(1 << 16);
  std::size_t journal_bytes = 0;
  std::vector<std::unique_ptr<BareClient>> clients;
  std::vector<std::unique_ptr<client::SessionWatch>> watchers;
  Time now{std::chrono::hours(1)};
  for (std::size_t s = 0; s < kSessions; ++s) {
    sessions.push_back(session_of(scene, load.recorded));
    if (load.inputs) {
      journals.push_back(std::make_unique<server::InputJournal>(transport::HashKey{}));
      if (!sessions.back()->attach_journal(*journals.back(), Time{}, server::build_text())) return 1;
    }
    for (std::size_t i = 0; i < seats; ++i) {
      clients.push_back(std::make_unique<BareClient>(
          *netsim::simulate_join(*sessions.back(), now, i, caps_of(scene, i), RandomKey{s}, i)));
      if (load.swinging) clients.back()->set_swinging(i);
    }
    if (load.watched) watchers.push_back(watcher_of(*sessions.back(), now, *load.watched));
  }
  const std::size_t peers = clients.size() + watchers.size();
  std::vector<Carried> in(2 * peers), out(2 * peers);
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
    for (std::size_t s = 0; s < watchers.size(); ++s)
      while (const auto size = watchers[s]->poll_transmit(now, in[count].bytes)) {
        in[count].client = s * seats;
        in[count].address = address_of(kFirstWatcher + s);
        in[count++].size = *size;
      }
    const std::size_t sent = serve_one_tick(sessions, seats, now, std::span{in}.first(count), out);
    for (const auto& journal : journals)
      while (const std::size_t size = journal->drain(drained)) journal_bytes += size;
    for (const Carried& d : std::span{out}.first(sent)) {
      const std::size_t to = client_at(d.address);
      const auto bytes = std::span{d.bytes}.first(d.size);
      if (to < kFirstWatcher)
        clients[to]->hear(now, bytes);
      else
        watchers[to - kFirstWatcher]->on_datagram(now, bytes);
    }
  }
  for (const auto& session : sessions)
    if (session->state() != wire::SessionState::kRunning) return 1;  // otherwise it measured waiting participants
  for (const auto& watcher : watchers)
    if (!watcher->newest()) return 1;
  for (const auto& journal : journals)
    if (journal->dropped() > 0) return 1;
  std::printf("%zu client-ticks, %zu bytes of inputs\n", clients.size() * static_cast<std::size_t>(ticks),
              journal_bytes);
  return 0;
}

}  // namespace tandem::bench

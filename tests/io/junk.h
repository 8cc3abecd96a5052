#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>

#include "common/base/rng.h"
#include "common/io/clock.h"
#include "common/io/datagram_batch.h"
#include "common/io/udp_socket.h"
#include "common/transport/datagram.h"

namespace tandem::test {

/// Replies that the sender of junk received.
struct JunkOutcome {
  std::uint64_t sent = 0, replies = 0;
};

/// Sends `per_ms` datagrams of junk per millisecond for `length`. One third is noise, one third names places of the
/// first session, one third is valid up to the tag. Only for addresses of this machine.
inline JunkOutcome send_junk(const io::SocketAddress& to, Duration length, std::size_t per_ms, std::uint64_t seed = 1) {
  JunkOutcome out;
  if (!to.loopback()) return out;
  auto socket = io::connect_udp(to);
  if (!socket) return out;
  RandomStream random{seed};
  constexpr std::size_t kKinds = 64;
  std::array<std::array<std::byte, 400>, kKinds> junk;
  std::array<std::size_t, kKinds> size{};
  for (std::size_t i = 0; i < kKinds; ++i) {
    for (std::byte& b : junk[i]) b = static_cast<std::byte>(random.bits());
    size[i] = 1 + random.below(junk[i].size());
    if (i % 3 == 0) continue;
    const auto cid = static_cast<std::uint32_t>(random.below(65536) << 16 | (1 + random.below(4)));
    transport::write_header({wire::Type::kState, 0, cid, random.below(100'000)},
                            std::span(junk[i]).first<transport::kHeaderSize>());
    size[i] = i % 3 == 1 ? std::max<std::size_t>(32, size[i]) : 321;
  }
  const Time begin = io::monotonic_now();
  io::SendBatch batch;
  std::array<std::byte, 1500> back;
  const std::int64_t steps = length / std::chrono::milliseconds(1);
  for (std::int64_t ms = 0; ms < steps; ++ms) {
    const timespec at = io::to_timespec((begin + ms * std::chrono::milliseconds(1)).time_since_epoch());
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
    for (std::size_t k = 0; k < per_ms; ++k) {
      const std::size_t i = (static_cast<std::size_t>(ms) * per_ms + k) % kKinds;
      batch.add(std::span{junk[i]}.first(size[i]), nullptr, nullptr);
      if (batch.size() == io::SendBatch::kMax || k + 1 == per_ms) {
        out.sent += batch.size();
        batch.send(socket->fd.get());
      }
    }
    while (::recv(socket->fd.get(), back.data(), back.size(), MSG_DONTWAIT) >= 0) ++out.replies;
  }
  return out;
}

}  // namespace tandem::test

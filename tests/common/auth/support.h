#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/auth/ticket.h"
#include "common/base/rng.h"
#include "common/base/secret.h"
#include "tests/common/base/counts.h"

namespace tandem::auth::test {

using tandem::test::seeds;

/// Returns the bytes start, start + 1, ...
template <std::size_t N>
constexpr std::array<std::byte, N> counting(unsigned start = 0) {
  std::array<std::byte, N> out{};
  for (std::size_t i = 0; i < N; ++i) out[i] = static_cast<std::byte>(start + i);
  return out;
}

inline std::vector<std::byte> random_bytes(RandomStream& random, std::size_t size) {
  std::vector<std::byte> out(size);
  for (std::byte& b : out) b = static_cast<std::byte>(random.bits() & 0xff);
  return out;
}

template <std::size_t N>
Secret<N> secret_from(unsigned start) {
  const auto bytes = counting<N>(start);
  return Secret<N>(std::span<const std::byte, N>(bytes));
}

constexpr std::int64_t kNow = 1'800'000'000;

inline TicketKey ticket_key(unsigned start = 0) { return TicketKey(secret_from<32>(start)); }

inline Ticket sample_ticket() {
  Ticket t;
  t.ticket_id = counting<16>(1);
  t.session_id = counting<16>(50);
  t.seat = "trainee";
  t.role = AccessRole::kTrainee;
  t.workstation.sha256 = counting<32>(100);
  t.force_scale = 500;
  t.not_before = kNow;
  t.not_after = kNow + 3600;
  t.epoch_min = 7;
  return t;
}

/// Returns the use that `sample_ticket` was issued for.
inline TicketUse sample_use(const Ticket& t) { return {t.session_id, 7, t.seat, t.role, t.workstation, kNow + 10}; }

}  // namespace tandem::auth::test

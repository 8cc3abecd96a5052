// Prints a fingerprint of every decision of the engine over many networks: one line per network, the total last. It
// needs neither GoogleTest nor protobuf, so that any compiler builds it from the engine's own files
// (tests/netsim/engine/determinism_test.cpp). With --extra-flow, other links on the same network are busy; with
// --other-bytes these send other sizes. The output must not change.
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "tests/netsim/models/random_spec.h"

namespace {

using namespace tandem;
using namespace tandem::netsim;
using namespace std::chrono_literals;

struct Others {
  std::uint32_t flows = 0;
  std::size_t size = 64;
};

/// Returns the hash of both directions of link 0 for 4 s of uneven traffic; rows of other links are excluded.
std::uint64_t hash_of(const LinkSpec& spec, std::uint64_t seed, const Others& others) {
  Network network{seed};
  DecisionLog log{200'000};
  for (std::uint32_t i = 0; i <= others.flows; ++i) network.add_link(spec);
  network.log_to(&log);
  RandomStream random{RandomKey{seed}.derive(99)};
  std::array<std::byte, kSlotBytes> buffer{};
  for (Time now{}; now < Time{4s};) {
    now += Duration{static_cast<std::int64_t>(random.below(1'500'000))};
    const std::size_t size = 20 + random.below(400);
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      for (std::uint32_t link = others.flows; link > 0; --link)
        network.send(now, link, direction, std::span{buffer}.first(others.size));
      network.send(now, 0, direction, std::span{buffer}.first(size));
    }
    while (network.poll_any(now, buffer)) {
    }
  }
  network.log_in_flight();
  std::vector<Decision> own;
  for (const Decision& row : log.sorted())
    if (row.link == 0) own.push_back(row);
  if (log.missed() > 0 || own.size() < 5000)
    std::printf("unusable: %zu rows, %" PRIu64 " missed\n", own.size(), log.missed());
  return decision_hash(own);
}

}  // namespace

int main(int count, char** arguments) {
  Others others;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--extra-flow") == 0) others.flows = 2;
    if (std::strcmp(arguments[i], "--other-bytes") == 0) others.size = 999;
  }
  std::uint64_t all = 0;
  const auto show = [&](const char* what, std::uint64_t seed, std::uint64_t hash) {
    std::printf("%s %" PRIu64 " %016" PRIx64 "\n", what, seed, hash);
    all = mix64(all ^ hash);
  };
  show("everything", 1, hash_of({test::everything(), test::everything()}, 1, others));
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomStream random{seed};
    LinkSpec spec;
    spec.up = test::random_path(random, seed % 3 == 0 ? ArrivalOrder::kFree : ArrivalOrder::kFifo);
    spec.down = test::random_path(random, seed % 4 == 0 ? ArrivalOrder::kFree : ArrivalOrder::kFifo);
    show("random", seed, hash_of(spec, seed, others));
  }
  std::printf("all %016" PRIx64 "\n", all);
  return 0;
}

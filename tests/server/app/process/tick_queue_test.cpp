#include "server/app/process/tick_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace tandem::server {
namespace {

/// A record in which every seat and tool has values of its own.
TickRecord record_of(std::uint32_t tick) {
  TickRecord r;
  r.tick = tick, r.time_ns = tick * 1'000'000LL, r.running = true;
  r.stopped_ticks = 3 * std::uint64_t{tick}, r.dropped_ticks = 5 * std::uint64_t{tick};
  for (std::size_t i = 0; i < kSeatsMax; ++i) {
    r.seats[i].alpha = static_cast<double>(tick) + static_cast<double>(i) / 100;
    r.seats[i].sample_tick = tick + static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = 0; i < kToolsMax; ++i) {
    r.tools[i].penetration = static_cast<double>(tick) - static_cast<double>(i) / 100;
    r.tools[i].alpha.back() = static_cast<double>(i);
  }
  return r;
}

void expect_record(const TickRecord& r, std::uint32_t tick, std::size_t seats, std::size_t tools) {
  const TickRecord wanted = record_of(tick);
  EXPECT_EQ(r.tick, wanted.tick);
  EXPECT_EQ(r.time_ns, wanted.time_ns);
  EXPECT_TRUE(r.running);
  EXPECT_EQ(r.stopped_ticks, wanted.stopped_ticks);
  EXPECT_EQ(r.dropped_ticks, wanted.dropped_ticks);
  for (std::size_t i = 0; i < kSeatsMax; ++i) {
    EXPECT_EQ(r.seats[i].alpha, i < seats ? wanted.seats[i].alpha : 0) << "seat " << i;
    EXPECT_EQ(r.seats[i].sample_tick, i < seats ? wanted.seats[i].sample_tick : 0) << "seat " << i;
  }
  for (std::size_t i = 0; i < kToolsMax; ++i) {
    EXPECT_EQ(r.tools[i].penetration, i < tools ? wanted.tools[i].penetration : 0) << "tool " << i;
    EXPECT_EQ(r.tools[i].alpha.back(), i < tools ? wanted.tools[i].alpha.back() : 0) << "tool " << i;
  }
}

TEST(TickQueue, CarriesTheSeatsAndToolsOfItsScene) {
  for (const auto& [seats, tools] :
       {std::pair{std::size_t{2}, std::size_t{1}}, {8, 3}, {kSeatsMax, kToolsMax}, {0, 0}}) {
    TickQueue queue{3, seats, tools};
    EXPECT_EQ(queue.front(), nullptr);
    for (std::uint32_t tick = 1; tick <= 7; ++tick) {  // the places are used again
      EXPECT_TRUE(queue.push(record_of(2 * tick)));
      EXPECT_TRUE(queue.push(record_of(2 * tick + 1)));
      for (const std::uint32_t wanted : {2 * tick, 2 * tick + 1}) {
        ASSERT_NE(queue.front(), nullptr);
        expect_record(*queue.front(), wanted, seats, tools);
        queue.pop();
      }
    }
    EXPECT_EQ(queue.front(), nullptr);
    EXPECT_EQ(queue.dropped(), 0u);
  }
}

TEST(TickQueue, DropsAndCountsRecordsThatDoNotFit) {
  TickQueue queue{2, 1, 1};
  for (std::uint32_t tick = 1; tick <= 5; ++tick) EXPECT_EQ(queue.push(record_of(tick)), tick <= 2);
  EXPECT_EQ(queue.dropped(), 3u);
  expect_record(*queue.front(), 1, 1, 1);
  queue.pop();
  EXPECT_TRUE(queue.push(record_of(6)));
  expect_record(*queue.front(), 2, 1, 1);
  queue.pop();
  expect_record(*queue.front(), 6, 1, 1);
}

// Asked: at most 4 MB per session in all.
TEST(TickQueue, TakesAboutTwoMegabytesForAnyScene) {
  for (std::size_t seats = 1; seats <= kSeatsMax; ++seats)
    for (std::size_t tools = 1; tools <= kToolsMax; ++tools) {
      const std::size_t ticks = TickQueue::capacity_for(seats, tools);
      EXPECT_GE(ticks, 256u);
      EXPECT_LE(ticks, 2048u);
      EXPECT_LE((TickQueue{ticks, seats, tools}.size_bytes()), 3'000'000u) << seats << " seats, " << tools << " tools";
    }
  EXPECT_GE(TickQueue::capacity_for(3, 1), 1000u) << "a second";
  EXPECT_LE((TickQueue{TickQueue::capacity_for(16, 1), 16, 1}.size_bytes()), 1'520'000u) << "of 4 MB for the session";
}

TEST(TickQueue, CarriesRecordsInOrderBetweenTwoThreads) {
  constexpr std::uint32_t kCount = 20'000;
  TickQueue queue{16, 3, 1};
  std::thread writer{[&] {
    for (std::uint32_t tick = 0; tick < kCount;) queue.push(record_of(tick)) ? void(++tick) : std::this_thread::yield();
  }};
  std::uint32_t wrong = 0;
  for (std::uint32_t tick = 0; tick < kCount;) {
    const TickRecord* const r = queue.front();
    if (r == nullptr) {
      std::this_thread::yield();
      continue;
    }
    const TickRecord wanted = record_of(tick);
    wrong += r->tick == tick && r->seats[2].alpha == wanted.seats[2].alpha &&
                     r->tools[0].penetration == wanted.tools[0].penetration
                 ? 0
                 : 1;
    queue.pop();
    ++tick;
  }
  writer.join();
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace tandem::server

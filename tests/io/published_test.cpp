// Values and events that cross threads.
#include "common/io/published.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <array>
#include <functional>
#include <thread>

#include "common/io/event_fd.h"

namespace tandem::io {
namespace {

TEST(Published, KeepsTheValuePublishedLast) {
  Published<int> value;
  EXPECT_EQ(value.read(), 0);
  EXPECT_TRUE(value.publish(3));
  EXPECT_TRUE(value.update([](int& v) { v += 4; }));
  EXPECT_EQ(value.read(), 7);
}

/// Value whose copy takes as long as the test wants.
struct Slow {
  Slow() = default;
  Slow(const Slow& other) : number(other.number) {
    if (other.during_copy) other.during_copy();
  }
  Slow& operator=(const Slow& other) {
    number = other.number;
    return *this;
  }
  int number = 0;
  std::function<void()> during_copy;
};

TEST(Published, SkipsAnUpdateWhileAReaderCopies) {
  Published<Slow> value;
  bool published = true, updated = true;
  // Another thread publishes: a thread must not try a lock that it holds itself.
  const auto publish = [&] {
    std::thread([&] {
      Slow next;
      next.number = 2;
      published = value.publish(next);
      updated = value.update([](Slow& slow) { slow.number = 3; });
    }).join();
  };
  EXPECT_TRUE(value.update([&](Slow& slow) {
    slow.number = 1;
    slow.during_copy = publish;
  }));
  EXPECT_EQ(value.read().number, 1);
  EXPECT_FALSE(published);
  EXPECT_FALSE(updated);
}

TEST(Published, NeverShowsHalfAnUpdate) {
  constexpr int kUpdates = 20'000;
  Published<std::array<int, 64>> value;
  std::jthread writer([&] {
    std::array<int, 64> next{};
    for (int i = 1; i <= kUpdates; ++i) {
      next.fill(i);
      static_cast<void>(value.publish(next));
    }
  });
  for (int before = 0, reads = 0; reads < 2'000; ++reads) {
    const std::array<int, 64> now = value.read();
    for (const int number : now) ASSERT_EQ(number, now[0]);
    ASSERT_GE(now[0], before);
    before = now[0];
  }
}

bool readable(const EventFd& event) {
  pollfd poll{event.get(), POLLIN, 0};
  return ::poll(&poll, 1, 0) == 1;
}

TEST(EventFd, StaysReadableUntilItIsCleared) {
  const EventFd event;
  ASSERT_TRUE(event.open());
  EXPECT_FALSE(readable(event));
  event.clear();  // without a signal it does not wait
  event.signal();
  event.signal();
  EXPECT_TRUE(readable(event));
  event.clear();
  EXPECT_FALSE(readable(event)) << "two signals count as one";
}

}  // namespace
}  // namespace tandem::io

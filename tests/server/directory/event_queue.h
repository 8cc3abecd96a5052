#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/base/time.h"

namespace tandem::directory::test {

/// Events of a simulation in virtual time. Events of one time run in the order in which they were added.
class EventQueue {
 public:
  void at(Time when, std::function<void()> what) {
    events_.push_back({when, ++order_, std::move(what)});
    std::ranges::push_heap(events_, later);
  }
  void after(Duration wait, std::function<void()> what) { at(now_ + wait, std::move(what)); }
  /// Runs the next event. @pre there is one
  void step() {
    std::ranges::pop_heap(events_, later);
    const Event event = std::move(events_.back());
    events_.pop_back();
    now_ = event.at;
    event.run();
  }
  [[nodiscard]] Time now() const noexcept { return now_; }

 private:
  struct Event {
    Time at;
    std::uint64_t order;
    std::function<void()> run;
  };
  static bool later(const Event& a, const Event& b) { return a.at != b.at ? a.at > b.at : a.order > b.order; }

  std::vector<Event> events_;
  std::uint64_t order_ = 0;
  Time now_{};
};

}  // namespace tandem::directory::test

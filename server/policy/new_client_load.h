#pragma once

#include "common/base/time.h"

namespace tandem::server {

/// Load that clients are expected to cause who joined so recently that no measurement has all of it. Without it, many
/// joins within a second would all be accepted by the load of before them. Counts each join for 1.5 to 3 s: a load is
/// measured over 1 s, and a client begins to send within half a second.
class NewClientLoad {
 public:
  static constexpr Duration kPart = std::chrono::milliseconds(1500);

  /// A client joins. @param cost  that is expected of it, as share of one processor [1]
  void add(Time now, double cost) noexcept {
    pass(now);
    newest_ += cost;
  }
  /// Expected load of the new clients, as share of one processor [1].
  [[nodiscard]] double expected(Time now) noexcept {
    pass(now);
    return newest_ + before_;
  }

 private:
  void pass(Time now) noexcept {
    if (now - since_ < kPart) return;
    before_ = now - since_ < 2 * kPart ? newest_ : 0;
    newest_ = 0;
    since_ = now;
  }

  Time since_{};
  double newest_ = 0, before_ = 0;  ///< of this part, and of the one before
};

}  // namespace tandem::server

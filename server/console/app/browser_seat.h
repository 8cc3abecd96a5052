#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "client/app/join_client.h"
#include "common/io/event_fd.h"
#include "server/console/seat_picture.h"

namespace tandem::console {

/// A MASTER seat that a person holds in a browser. The gateway runs the client's own seat core with a simulated device;
/// the person's pointer is the place that the simulated hand intends. A thread of its own joins and watches it, and the
/// device's servo thread runs the seat, so that no browser delays a tick.
class BrowserSeat {
 public:
  static constexpr Duration kSilent = std::chrono::milliseconds(500);  ///< without a pointer the hand is free

  /// @param join  server, session, ticket and name of the seat
  /// @param news  called by the seat's thread after a new picture
  BrowserSeat(client::JoinOptions join, std::function<void()> news);
  /// Waits for the end of the seat, at most about 2 s unless `over`.
  ~BrowserSeat();
  BrowserSeat(const BrowserSeat&) = delete;
  BrowserSeat& operator=(const BrowserSeat&) = delete;

  /// Where the person points [m], in the frame of the scene. @param holds  false: the hand is free
  void point(const std::array<double, 3>& x, bool holds, Time now);
  /// Begins to leave: the force ramps to zero, then the server frees the seat.
  void leave() noexcept;
  /// The seat has ended, and nothing of it runs.
  [[nodiscard]] bool over() const noexcept { return over_.load(std::memory_order_acquire); }
  [[nodiscard]] SeatPicture newest() const;

 private:
  struct Held;
  struct Pointer {
    std::array<double, 3> x{};
    bool holds = false;
    Time at{};
  };
  void work();
  [[nodiscard]] std::string hold(const client::JoinedSeat& joined);
  [[nodiscard]] std::string watch(Held& held);
  void aim(Held& held, Time now);
  template <class Change>
  void update(Change change);

  client::JoinOptions join_;
  std::function<void()> news_;
  io::EventFd end_;
  mutable std::mutex lock_;
  SeatPicture picture_;
  std::optional<Pointer> pointer_;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace tandem::console

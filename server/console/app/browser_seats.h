#pragma once

#include <cstddef>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/console/app/browser_seat.h"

namespace tandem::console {

/// Seats that persons hold in browsers of this gateway. For the web thread.
class BrowserSeats {
 public:
  static constexpr std::size_t kMax = 8;

  /// @param allowed  as by --allow-browser-seats
  /// @param join     server, state and timeout
  /// @param news     called by any thread after a new picture of any seat
  BrowserSeats(bool allowed, client::JoinOptions join, std::function<void()> news)
      : allowed_(allowed), join_(std::move(join)), news_(std::move(news)) {}
  /// Leaves all seats, then waits for their ends.
  ~BrowserSeats();
  BrowserSeats(const BrowserSeats&) = delete;
  BrowserSeats& operator=(const BrowserSeats&) = delete;

  [[nodiscard]] bool allowed() const noexcept { return allowed_; }
  /// Begins to take a seat; its picture says whether the server admits it.
  /// @param session  name of the session  @param ticket  for this seat; empty: by the right of this computer's user
  /// @return error: cause and remedy
  [[nodiscard]] std::expected<std::shared_ptr<BrowserSeat>, std::string> take(const std::string& session,
                                                                              const std::string& seat,
                                                                              const std::string& ticket);
  /// Frees what seats that are over held. Call it about every second.
  void on_second();

 private:
  bool allowed_;
  client::JoinOptions join_;
  std::function<void()> news_;
  std::vector<std::shared_ptr<BrowserSeat>> seats_;  ///< a page that is gone does not wait for the end of its seat
};

}  // namespace tandem::console

#include "server/console/app/browser_seats.h"

namespace tandem::console {

BrowserSeats::~BrowserSeats() {
  for (const auto& seat : seats_) seat->leave();
}

std::expected<std::shared_ptr<BrowserSeat>, std::string> BrowserSeats::take(const std::string& session,
                                                                            const std::string& seat,
                                                                            const std::string& ticket) {
  if (!allowed_) return std::unexpected("this gateway gives no seats to browsers; start it with --allow-browser-seats");
  on_second();
  if (seats_.size() >= kMax)
    return std::unexpected("all 8 browser seats of this gateway are held; leave one of them first");
  client::JoinOptions join = join_;
  join.seat = seat;
  join.ticket = ticket;
  join.session = ticket.empty() ? session : std::string{};
  seats_.push_back(std::make_shared<BrowserSeat>(std::move(join), news_));
  return seats_.back();
}

void BrowserSeats::on_second() {
  std::erase_if(seats_, [](const std::shared_ptr<BrowserSeat>& seat) { return seat->over(); });
}

}  // namespace tandem::console

#include "server/app/control/held_replies.h"

#include <utility>

namespace tandem::server {
namespace {

/// Why an order is not stored yet.
std::string cause(const StoredOrders& stored) {
  std::string why = stored.problem();
  return why.empty() ? "it is not written in time; check the disk of the server, or the directory of its service"
                     : std::move(why);
}

}  // namespace

void HeldReplies::hold(std::shared_ptr<const StoredOrders> stored, std::uint32_t orders, Duration limit,
                       std::function<void(const std::string& why)> give) {
  if (stored->has(orders)) return give({});
  if (held_.size() >= kMax) return give(cause(*stored));
  held_.push_back({std::move(stored), orders, clock_() + limit, std::move(give)});
  if (held_.size() == 1) look_again();
}

void HeldReplies::look_again() {
  timer_.expires_after(kLook);
  timer_.async_wait([this](const asio::error_code& cancelled) {
    if (!cancelled) look();
  });
}

void HeldReplies::look() {
  const Time now = clock_();
  std::list<Held> ready;
  for (auto next = held_.begin(); next != held_.end();) {
    const auto held = next++;
    if (held->stored->has(held->orders) || held->stored->failed(held->orders) || now >= held->until)
      ready.splice(ready.end(), held_, held);
  }
  if (!held_.empty()) look_again();
  for (const Held& held : ready) held.give(held.stored->has(held.orders) ? std::string{} : cause(*held.stored));
}

void HeldReplies::give_all() {
  timer_.cancel();
  for (const Held& held : std::exchange(held_, {}))
    held.give(held.stored->has(held.orders) ? std::string{} : cause(*held.stored));
}

}  // namespace tandem::server

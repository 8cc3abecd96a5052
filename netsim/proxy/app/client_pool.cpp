#include "netsim/proxy/app/client_pool.h"

#include <algorithm>

namespace tandem::netsim {

ClientPool::ClientPool(const ProxyCore& core, const LinkSpec& link, bool watch)
    : core_(&core), monitor_(watch), link_(link), ready_(kReady), returned_(2 * kReady) {
  refill();
}

ClientPool::~ClientPool() {
  for (io::SpscQueue<PreparedClient*>* queue : {&ready_, &returned_}) {
    while (PreparedClient* const* newcomer = queue->front()) {
      delete *newcomer;
      queue->pop();
    }
  }
}

void ClientPool::refill() {
  wanted_.clear();
  while (PreparedClient* const* newcomer = returned_.front()) {
    delete *newcomer;
    returned_.pop();
    --outstanding_;
  }
  for (; outstanding_ < kReady; ++outstanding_) {
    made_ = std::max(made_, arrived_.load(std::memory_order_acquire));
    auto newcomer = std::make_unique<PreparedClient>(core_->prepare_client(link_, version_, made_),
                                                     monitor_ ? std::make_unique<LinkMonitor>() : nullptr);
    if (!ready_.push(newcomer.get())) return;  // cannot happen: the queue holds all clients outstanding
    static_cast<void>(newcomer.release());
    ++made_;
  }
}

void ClientPool::set_next_link(const LinkSpec& link) {
  link_ = link;
  ++version_;
  made_ = 0;
}

void ClientPool::drop_outdated() noexcept {
  arrived_.store(core_->clients_seen(), std::memory_order_release);
  while (PreparedClient* const* front = ready_.front()) {
    PreparedClient* const newcomer = *front;
    // A client prepared for a network that is not in force yet stays in the queue.
    if (core_->fits(newcomer->place) || newcomer->place.version > core_->version()) return;
    ready_.pop();
    give_back(newcomer);
  }
}

ClientPool::PreparedClient* ClientPool::next() noexcept {
  drop_outdated();
  PreparedClient* const* front = ready_.front();
  if (front == nullptr || !core_->fits((*front)->place)) {
    misses_.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  PreparedClient* const newcomer = *front;
  ready_.pop();
  return newcomer;
}

void ClientPool::give_back(PreparedClient* newcomer) noexcept {
  [[maybe_unused]] const bool pushed = returned_.push(newcomer);  // never full
  wanted_.signal();
}

}  // namespace tandem::netsim

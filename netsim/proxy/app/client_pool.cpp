#include "netsim/proxy/app/client_pool.h"

#include <algorithm>

namespace tandem::netsim {

ClientPool::ClientPool(const ProxyCore& core, const LinkSpec& link, bool monitor)
    : core_(&core), monitor_(monitor), link_(link), ready_(kReady), returned_(2 * kReady) {
  refill();
}

ClientPool::~ClientPool() {
  for (io::SpscQueue<PreparedClient*>* queue : {&ready_, &returned_}) {
    while (PreparedClient* const* prepared = queue->front()) {
      delete *prepared;
      queue->pop();
    }
  }
}

void ClientPool::refill() {
  wanted_.clear();
  while (PreparedClient* const* prepared = returned_.front()) {
    delete *prepared;
    returned_.pop();
    --outstanding_;
  }
  for (; outstanding_ < kReady; ++outstanding_) {
    made_ = std::max(made_, arrived_.load(std::memory_order_acquire));
    auto prepared = std::make_unique<PreparedClient>(core_->links().prepare_client(link_, version_, made_),
                                                     monitor_ ? std::make_unique<LinkMonitor>() : nullptr);
    if (!ready_.push(prepared.get())) return;  // cannot happen: the queue holds all clients outstanding
    static_cast<void>(prepared.release());
    ++made_;
  }
}

void ClientPool::set_next_link(const LinkSpec& link) {
  link_ = link;
  ++version_;
  made_ = 0;
}

void ClientPool::drop_outdated() noexcept {
  arrived_.store(core_->clients().seen(), std::memory_order_release);
  while (PreparedClient* const* front = ready_.front()) {
    PreparedClient* const prepared = *front;
    // A client prepared for a network that is not in force yet stays in the queue.
    if (core_->fits(prepared->link) || prepared->link.version > core_->version()) return;
    ready_.pop();
    give_back(prepared);
  }
}

ClientPool::PreparedClient* ClientPool::next() noexcept {
  drop_outdated();
  PreparedClient* const* front = ready_.front();
  if (front == nullptr || !core_->fits((*front)->link)) {
    misses_.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  PreparedClient* const prepared = *front;
  ready_.pop();
  return prepared;
}

void ClientPool::give_back(PreparedClient* prepared) noexcept {
  [[maybe_unused]] const bool pushed = returned_.push(prepared);  // never full
  wanted_.signal();
}

}  // namespace tandem::netsim

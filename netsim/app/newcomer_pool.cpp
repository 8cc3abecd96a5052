#include "netsim/app/newcomer_pool.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>

namespace tandem::netsim {

NewcomerPool::NewcomerPool(const ProxyCore& core, const LinkSpec& link, bool watch)
    : core_(&core), watch_(watch), link_(link), ready_(kReady), back_(2 * kReady), wanted_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  refill();
}

NewcomerPool::~NewcomerPool() {
  for (io::SpscQueue<Newcomer*>* queue : {&ready_, &back_}) {
    while (Newcomer* const* newcomer = queue->front()) {
      delete *newcomer;
      queue->pop();
    }
  }
}

void NewcomerPool::refill() {
  std::uint64_t times = 0;
  [[maybe_unused]] const auto got = ::read(wanted_.get(), &times, sizeof times);
  while (Newcomer* const* newcomer = back_.front()) {
    delete *newcomer;
    back_.pop();
    --out_;
  }
  for (; out_ < kReady; ++out_) {
    made_ = std::max(made_, seen_.load(std::memory_order_acquire));
    auto newcomer = std::make_unique<Newcomer>(core_->prepare_newcomer(link_, version_, made_), watch_ ? std::make_unique<LinkWatch>() : nullptr);
    if (!ready_.push(newcomer.get())) return;  // never: it has room for all that are out
    static_cast<void>(newcomer.release());
    ++made_;
  }
}

void NewcomerPool::link_will_be(const LinkSpec& link) {
  link_ = link;
  ++version_;
  made_ = 0;
}

void NewcomerPool::drop_outdated() noexcept {
  seen_.store(core_->clients_seen(), std::memory_order_release);
  while (Newcomer* const* front = ready_.front()) {
    Newcomer* const newcomer = *front;
    // One made for a network that is not in force yet stays for later.
    if (core_->fits(newcomer->place) || newcomer->place.version > core_->version()) return;
    ready_.pop();
    done(newcomer);
  }
}

NewcomerPool::Newcomer* NewcomerPool::next() noexcept {
  drop_outdated();
  Newcomer* const* front = ready_.front();
  if (front == nullptr || !core_->fits((*front)->place)) {
    missed_.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  Newcomer* const newcomer = *front;
  ready_.pop();
  return newcomer;
}

void NewcomerPool::done(Newcomer* newcomer) noexcept {
  [[maybe_unused]] const bool pushed = back_.push(newcomer);  // it has room for all that are out
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wanted_.get(), &one, sizeof one);
}

}  // namespace tandem::netsim

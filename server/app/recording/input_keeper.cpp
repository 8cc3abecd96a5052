#include "server/app/recording/input_keeper.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/io/clock.h"

namespace tandem::server {
namespace {

// A journal that is drained too late ends. The thread has little to do, so that it precedes others where permitted.
constexpr int kDrainNice = -10;

}  // namespace

InputKeeper::~InputKeeper() {
  {
    const std::lock_guard lock(lock_);
    stop_ = true;
  }
  stopped_.notify_all();
  for (std::thread* const thread : {&drainer_, &keeper_})
    if (thread->joinable()) thread->join();
}

void InputKeeper::add(std::shared_ptr<KeptInputs> inputs) {
  const std::lock_guard lock(lock_);
  inputs_.push_back(std::move(inputs));
  if (drainer_.joinable()) return;
  drainer_ = std::thread([this] { drain(); });
  keeper_ = std::thread([this] { keep(); });
}

std::vector<std::shared_ptr<KeptInputs>> InputKeeper::all() {
  const std::lock_guard lock(lock_);
  return inputs_;
}

bool InputKeeper::pause(Duration interval) {
  std::unique_lock lock(lock_);
  return !stopped_.wait_for(lock, interval, [this] { return stop_; });
}

void InputKeeper::drain() {
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kDrainNice));
  do {
    for (const auto& inputs : all()) inputs->drain();
    drain_ns_.store(io::read_clock(CLOCK_THREAD_CPUTIME_ID).count(), std::memory_order_relaxed);
  } while (pause(kDrainInterval));
}

void InputKeeper::keep() {
  KeptBlockWriter writer;
  do {
    release_unused();
    // One block of each session in turn, so that none waits for the others.
    for (bool more = true; more;) {
      more = false;
      for (const auto& inputs : all()) more = inputs->keep(writer) || more;
    }
    keep_ns_.store(io::read_clock(CLOCK_THREAD_CPUTIME_ID).count(), std::memory_order_relaxed);
  } while (pause(kKeepInterval));
}

void InputKeeper::release_unused() {
  std::vector<std::shared_ptr<KeptInputs>> unused;
  {
    const std::lock_guard lock(lock_);
    // The draining thread may refer to them at this moment; the next round then finds them.
    const auto rest = std::ranges::partition(inputs_, [](const auto& inputs) { return inputs.use_count() > 1; });
    unused.assign(std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
    inputs_.erase(rest.begin(), rest.end());
  }
}

}  // namespace tandem::server

#pragma once

#include <pthread.h>

#include <mutex>

#include "common/io/clock.h"
#include "hal/wire/wire_model.h"
#include "tests/hal/emulation/node.h"

namespace tandem::test {

/// Whoever holds it runs at the priority of whoever waits for it. A servo thread with a real-time priority would else wait for
/// an ordinary thread of the test that a busy machine does not let run: a kernel does not do that to it.
class PriorityMutex {
 public:
  PriorityMutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
  }
  PriorityMutex(const PriorityMutex&) = delete;
  ~PriorityMutex() { pthread_mutex_destroy(&mutex_); }
  void lock() { pthread_mutex_lock(&mutex_); }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_;
};

/// A node in front of a wire model: what usbfs and hidraw have in common. The model's time is the machine's.
template <class Model>
class ModelNode : public Node {
 public:
  /// Runs with nobody else in the model.
  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }
  void unplug() {
    const std::lock_guard hold(mutex_);
    pull();
  }
  /// Unplugs when the `count`-th transfer (usbfs) or report (hidraw) from now on is handed in: 1 is the next one. The device
  /// does not get it.
  void unplug_at(unsigned count) {
    const std::lock_guard hold(mutex_);
    unplug_at_ = handed_in_ + count;
  }
  /// Transfers or reports handed in so far.
  [[nodiscard]] unsigned handed_in() const {
    const std::lock_guard hold(mutex_);
    return handed_in_;
  }

 protected:
  explicit ModelNode(Model& model) : model_(model), served_at_(io::monotonic_now()) {}

  /// What is under way ends as the kernel ends it.
  virtual void end_transfers() = 0;

  // With the mutex held.
  [[nodiscard]] Model& model() { return model_; }
  [[nodiscard]] bool gone() const { return gone_; }
  void advance() {
    const Time now = io::monotonic_now();
    model_.advance(now - served_at_);
    served_at_ = now;
  }
  /// Something is handed in. @return false: there is no device any more
  bool hand_in() {
    ++handed_in_;
    if (unplug_at_ != 0 && handed_in_ == unplug_at_) pull();
    return !gone_;
  }
  mutable PriorityMutex mutex_;

 private:
  void pull() {
    gone_ = true;
    model_.unplug();
    end_transfers();
    gate().hang_up();
  }

  Model& model_;
  Time served_at_;
  unsigned handed_in_ = 0, unplug_at_ = 0;
  bool gone_ = false;
};

}  // namespace tandem::test

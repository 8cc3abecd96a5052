#pragma once

#include <pthread.h>

#include <mutex>

#include "common/io/clock.h"
#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/node.h"

namespace tandem::test {

/// Mutex with priority inheritance: its holder runs at the priority of the thread that waits for it.
/// Otherwise a real-time servo thread would wait for an ordinary test thread that a busy machine does not schedule. A
/// kernel does not do this.
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

/// A node in front of a device model: common part of usbfs and hidraw. The model's time is the machine's.
template <class Model>
class ModelNode : public Node {
 public:
  /// Runs `Do` with exclusive access to the model.
  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }
  void unplug() {
    const std::lock_guard hold(mutex_);
    pull();
  }
  /// Unplugs on submission of the `count`-th transfer (usbfs) or report (hidraw) from now on; 1 is the next one. The
  /// device does not receive it.
  void unplug_at(unsigned count) {
    const std::lock_guard hold(mutex_);
    unplug_at_ = handed_in_ + count;
  }
  /// Returns the number of transfers or reports submitted so far.
  [[nodiscard]] unsigned handed_in() const {
    const std::lock_guard hold(mutex_);
    return handed_in_;
  }

 protected:
  explicit ModelNode(Model& model) : model_(model), served_at_(io::monotonic_now()) {}

  /// Ends pending transfers as the kernel ends them.
  virtual void end_transfers() = 0;

  // Call these with the mutex held.
  [[nodiscard]] Model& model() { return model_; }
  [[nodiscard]] bool gone() const { return gone_; }
  void advance() {
    const Time now = io::monotonic_now();
    model_.advance(now - served_at_);
    served_at_ = now;
  }
  /// Counts a submission. @return false: the device is unplugged
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

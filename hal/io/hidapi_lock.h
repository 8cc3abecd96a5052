#pragma once

#include <mutex>

namespace tandem::hal {

/// Lock of hidapi's enumeration, opening and last error, which are process-wide and not thread-safe.
/// Callers of these functions hold it. Reading and writing of opened devices do not need it.
class HidapiLock {
 public:
  HidapiLock() : hold_(mutex()) {}

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> hold_;
};

}  // namespace tandem::hal

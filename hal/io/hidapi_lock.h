#pragma once

#include <mutex>

namespace tandem::hal {

/// hidapi's enumeration, opening and last error are shared by the whole process and not thread-safe: whoever calls one
/// of them holds this. Reading and writing of opened devices need it not.
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

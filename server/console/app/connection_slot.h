#pragma once

#include <cstddef>
#include <utility>

namespace tandem::console {

/// Counts a connection in `count` during its life.
class ConnectionSlot {
 public:
  explicit ConnectionSlot(std::size_t& count) : count_(&count) { ++count; }
  ~ConnectionSlot() {
    if (count_ != nullptr) --*count_;
  }
  ConnectionSlot(ConnectionSlot&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
  ConnectionSlot& operator=(ConnectionSlot&&) = delete;

 private:
  std::size_t* count_;
};

}  // namespace tandem::console

#pragma once

#include <cstddef>
#include <memory>
#include <utility>

namespace tandem::netsim {

/// A recording that several specs share; null: none. Recordings with the same content are equal, because each reading
/// of a file makes another one.
template <typename Recording>
struct SharedRecording : std::shared_ptr<const Recording> {
  using std::shared_ptr<const Recording>::shared_ptr;
  SharedRecording(std::shared_ptr<const Recording> recording) noexcept
      : std::shared_ptr<const Recording>(std::move(recording)) {}
  friend bool operator==(const SharedRecording& a, const SharedRecording& b) {
    return a.get() == b.get() || (a && b && *a == *b);
  }
  friend bool operator==(const SharedRecording& a, std::nullptr_t) noexcept { return !a; }
};

}  // namespace tandem::netsim

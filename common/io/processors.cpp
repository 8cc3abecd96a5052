#include "common/io/processors.h"

#include <sched.h>

#include <algorithm>
#include <thread>

namespace tandem::io {

unsigned available_processors() noexcept {
  cpu_set_t set;
  CPU_ZERO(&set);
  // A machine with more processors than the set has bits makes the call fail.
  const int allowed = ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
  return std::max(allowed > 0 ? static_cast<unsigned>(allowed) : std::thread::hardware_concurrency(), 1U);
}

}  // namespace tandem::io

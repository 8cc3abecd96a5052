#include "common/io/realtime.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cstdint>

namespace tandem::io {

CpuLatencyRequest::CpuLatencyRequest() noexcept : fd_(::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
  const std::int32_t microseconds = 0;
  if (fd_.open() && ::write(fd_.get(), &microseconds, sizeof microseconds) != sizeof microseconds) fd_.reset();
}

bool lock_memory() noexcept {
  // With a finite limit a lock may succeed now and make every later allocation fail.
  rlimit limit{};
  const bool unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
  if (!unlimited && geteuid() != 0) return false;
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
}

bool request_realtime(int priority) noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  const sched_param p{priority};
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &p) == 0;
}

std::string realtime_warning(bool fifo, bool memory, bool awake) {
  std::string missing;
  const auto add = [&](bool granted, const char* what) {
    if (!granted) missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  add(fifo, "real-time priority");
  add(memory, "locked memory");
  add(awake, "a limit of the CPU's wake-up latency");
  if (missing.empty()) return {};
  return "not permitted here: " + missing +
         "; ticks may come late when the machine is busy (they are counted). Remedy: run as root, or allow `rtprio 80` "
         "and "
         "`memlock unlimited` in /etc/security/limits.conf";
}

}  // namespace tandem::io

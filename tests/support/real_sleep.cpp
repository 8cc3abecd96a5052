// Preloaded before libfaketime 0.9.10. With an absolute time, clock_nanosleep of that version returns at once, for
// every clock.
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* left) {
  return syscall(SYS_clock_nanosleep, clock, flags, until, left) == 0 ? 0 : errno;
}

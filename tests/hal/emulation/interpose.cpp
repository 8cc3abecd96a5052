// The test program's own ioctl, read, write and poll. They are exported (-rdynamic) and therefore precede those of
// umockdev and of libc.
#include <asm/ioctl.h>
#include <dlfcn.h>
#include <linux/poll.h>
#include <sys/types.h>

#include <cerrno>
#include <cstdarg>

#include "common/base/heap_count.h"
#include "tests/hal/emulation/node.h"

namespace {

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Runs a handler as the kernel runs a call: its heap allocations are counted separately.
template <class Handler>
auto inside(Handler handler) {
  const auto before = tandem::heap_allocations();
  const auto result = handler();
  tandem::test::Node::heap_inside() += tandem::heap_allocations() - before;
  return result;
}

template <class Result>
Result as_libc(Result kernel) {
  if (kernel >= 0) return kernel;
  errno = static_cast<int>(-kernel);
  return -1;
}

}  // namespace

extern "C" {

[[gnu::visibility("default")]] int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  const auto type = _IOC_TYPE(request);
  if (type == 'U' || type == 'H') {
    if (auto* node = tandem::test::Node::of(fd))
      return static_cast<int>(as_libc(inside([&] { return node->on_ioctl(fd, request, argument); })));
  }
  static const auto other = next<int (*)(int, unsigned long, ...)>("ioctl");
  return other(fd, request, argument);
}

[[gnu::visibility("default")]] ssize_t read(int fd, void* into, size_t size) {
  if (auto* node = tandem::test::Node::of(fd)) return as_libc(inside([&] { return node->on_read(into, size); }));
  static const auto other = next<ssize_t (*)(int, void*, size_t)>("read");
  return other(fd, into, size);
}

[[gnu::visibility("default")]] ssize_t write(int fd, const void* from, size_t size) {
  if (auto* node = tandem::test::Node::of(fd)) return as_libc(inside([&] { return node->on_write(from, size); }));
  static const auto other = next<ssize_t (*)(int, const void*, size_t)>("write");
  return other(fd, from, size);
}

[[gnu::visibility("default")]] int poll(pollfd* files, unsigned long count, int timeout_ms) {
  if (count == 1) {
    auto* node = tandem::test::Node::of(files->fd);
    if (const auto ready = node == nullptr ? std::nullopt : inside([&] { return node->on_poll(timeout_ms); })) {
      files->revents = static_cast<short>(*ready & (files->events | POLLERR | POLLHUP));
      return files->revents == 0 ? 0 : 1;
    }
  }
  static const auto other = next<int (*)(pollfd*, unsigned long, int)>("poll");
  return other(files, count, timeout_ms);
}
}

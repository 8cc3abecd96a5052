#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

/// Emulation of the kernel's side of a device node inside the test program.
/// The program defines `ioctl`, `read`, `write` and `poll` itself (interpose.cpp); calls on an emulated node are
/// handled here. Real libusb and hidapi therefore run at the speed of a function call.
/// The node is a pseudo terminal, because libusb polls it among others. umockdev provides its name, its sysfs and its
/// uevents.
namespace tandem::test {

/// A pseudo terminal whose poll() result the test sets.
class PollGate {
 public:
  PollGate();
  PollGate(const PollGate&) = delete;
  ~PollGate();
  [[nodiscard]] const std::string& path() const {
    return path_;
  }  ///< path of the terminal's slave, the target of a node's name
  [[nodiscard]] unsigned number() const { return minor_; }  ///< minor number
  void writable(bool yes);                                  ///< POLLOUT
  void hang_up();                                           ///< POLLERR | POLLHUP, permanently

 private:
  int master_ = -1, slave_ = -1;
  unsigned minor_ = 0;
  std::string path_;
};

/// One emulated node. Handlers run on the caller's thread and return -errno as in the kernel.
/// A thread of the bus calls `service` every 200 microseconds, which runs the device's own actions.
class Node {
 public:
  Node();
  Node(const Node&) = delete;
  virtual ~Node();

  virtual long on_ioctl(int fd, unsigned long request, void* argument) = 0;
  virtual ssize_t on_read(void* into, std::size_t size);
  virtual ssize_t on_write(const void* from, std::size_t size);
  /// Waits for one of POLLIN, POLLERR, POLLHUP. Empty: use the pseudo terminal's own poll.
  /// A terminal's own POLLIN comes through a kernel thread that a busy machine delays by milliseconds.
  virtual std::optional<short> on_poll(int timeout_ms);
  virtual void service() = 0;

  [[nodiscard]] PollGate& gate() { return gate_; }

  /// Returns the emulated node behind a descriptor; nullptr: none.
  static Node* of(int fd);

  /// Heap allocations of the handlers on this thread: they belong to the emulated kernel, not to the library or the
  /// pipe.
  static std::uint64_t& heap_inside();

 protected:
  /// Call these at the end of the most derived class's constructor and at the beginning of its destructor.
  void appear();
  void vanish();

 private:
  PollGate gate_;
};

}  // namespace tandem::test

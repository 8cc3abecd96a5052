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

/// The kernel's side of a device node, inside the test program: it defines `ioctl`, `read`, `write`, `poll` itself
/// (interpose.cpp), and those on an emulated node end here, so that real libusb and hidapi run at the speed of a
/// function call. The node is a pseudo terminal, because libusb poll()s it among others; umockdev gives it its name, its sysfs and
/// its uevents.
namespace tandem::test {

/// A pseudo terminal whose poll() answers as told.
class PollGate {
 public:
  PollGate();
  PollGate(const PollGate&) = delete;
  ~PollGate();
  [[nodiscard]] const std::string& path() const { return path_; }  ///< of the slave: what a node's name leads to
  [[nodiscard]] unsigned number() const { return minor_; }         ///< minor number
  void writable(bool yes);                                         ///< POLLOUT
  void hang_up();                                                  ///< POLLERR | POLLHUP for ever

 private:
  int master_ = -1, slave_ = -1;
  unsigned minor_ = 0;
  std::string path_;
};

/// One emulated node. Handlers run on the caller's thread and return -errno as in the kernel. A thread of the bus calls
/// `service` every 200 microseconds, so that what the device does by itself happens.
class Node {
 public:
  Node();
  Node(const Node&) = delete;
  virtual ~Node();

  virtual long on_ioctl(int fd, unsigned long request, void* argument) = 0;
  virtual ssize_t on_read(void* into, std::size_t size);
  virtual ssize_t on_write(const void* from, std::size_t size);
  /// Waits for one of POLLIN, POLLERR, POLLHUP; nothing: the pseudo terminal knows. A terminal's own POLLIN comes through a
  /// thread of the kernel that a busy machine keeps waiting for milliseconds.
  virtual std::optional<short> on_poll(int timeout_ms);
  virtual void service() = 0;

  [[nodiscard]] PollGate& gate() { return gate_; }

  /// The node behind a descriptor, if it is an emulated one.
  static Node* of(int fd);

  /// What handlers took from the heap on this thread: the emulated kernel's, not the library's nor the pipe's.
  static std::uint64_t& heap_inside();

 protected:
  /// To be called at the end of the constructor of the last class and at the beginning of its destructor.
  void appear();
  void vanish();

 private:
  PollGate gate_;
};

}  // namespace tandem::test

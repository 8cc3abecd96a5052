#include "tests/hal/emulation/node.h"

#include <fcntl.h>
#include <pthread.h>
#include <pty.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace tandem::test {
namespace {

constexpr std::size_t kMinors = 4096;
constexpr unsigned kPtyMajor = 136;
std::array<std::atomic<Node*>, kMinors> g_nodes{};
std::atomic<int> g_count{0};

/// Thread that calls `service` of every node; it exists while there is a node.
struct Ticker {
  std::mutex mutex;  ///< held while nodes are served, taken to add and remove them
  std::condition_variable_any wake;
  std::vector<Node*> nodes;
  std::jthread thread;

  void add(Node* node) {
    const std::lock_guard hold(mutex);
    nodes.push_back(node);
    if (!thread.joinable()) {
      thread = std::jthread([this](std::stop_token stop) {
        // A device and its bus are not delayed by other programs: priority above the servos, if the machine allows it.
        const sched_param above_servos{70};
        pthread_setschedparam(pthread_self(), SCHED_FIFO, &above_servos);
        std::unique_lock hold_on(mutex);
        while (!stop.stop_requested()) {
          for (Node* one : nodes) one->service();
          wake.wait_for(hold_on, stop, std::chrono::microseconds(200), [] { return false; });
        }
      });
    }
  }
  void remove(Node* node) {
    std::jthread last;
    {
      const std::lock_guard hold(mutex);
      std::erase(nodes, node);
      if (nodes.empty()) last = std::move(thread);
    }
  }
};
Ticker& ticker() {
  static Ticker one;
  return one;
}

[[noreturn]] void give_up(const char* what) {
  std::perror(what);
  std::abort();
}

}  // namespace

PollGate::PollGate() {
  std::array<char, 128> name{};
  termios raw{};
  cfmakeraw(&raw);
  if (openpty(&master_, &slave_, name.data(), &raw, nullptr) != 0) give_up("openpty");
  fcntl(slave_, F_SETFL, O_RDWR | O_NONBLOCK);
  fcntl(slave_, F_SETFD, FD_CLOEXEC);
  fcntl(master_, F_SETFD, FD_CLOEXEC);
  path_ = name.data();
  struct stat status{};
  if (syscall(SYS_fstat, slave_, &status) != 0) give_up("fstat");
  minor_ = minor(status.st_rdev);
  if (minor_ >= kMinors) give_up("too many pseudo terminals");
  writable(false);
}

PollGate::~PollGate() {
  hang_up();
  close(slave_);
}

void PollGate::writable(bool yes) { syscall(SYS_ioctl, slave_, TCXONC, yes ? TCOON : TCOOFF); }

void PollGate::hang_up() {
  if (master_ >= 0) close(master_);
  master_ = -1;
}

std::uint64_t& Node::heap_inside() {
  thread_local std::uint64_t count = 0;
  return count;
}

Node::Node() = default;
Node::~Node() = default;
ssize_t Node::on_read(void*, std::size_t) { return -EINVAL; }
std::optional<short> Node::on_poll(int) { return std::nullopt; }
ssize_t Node::on_write(const void*, std::size_t) { return -EINVAL; }

void Node::appear() {
  g_nodes[gate_.number()] = this;
  ++g_count;
  ticker().add(this);
}

void Node::vanish() {
  ticker().remove(this);
  g_nodes[gate_.number()] = nullptr;
  --g_count;
}

Node* Node::of(int fd) {
  if (g_count.load(std::memory_order_relaxed) == 0) return nullptr;
  struct stat status{};
  const int before = errno;
  const bool known = syscall(SYS_fstat, fd, &status) == 0 && S_ISCHR(status.st_mode) &&
                     major(status.st_rdev) == kPtyMajor && minor(status.st_rdev) < kMinors;
  errno = before;
  return known ? g_nodes[minor(status.st_rdev)].load() : nullptr;
}

}  // namespace tandem::test

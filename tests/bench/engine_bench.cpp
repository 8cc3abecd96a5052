// Measures the cost of the engine per datagram in virtual time: Network::send and polling of all due datagrams, 128
// bytes at 1 kHz. The reference in the same run is the least possible work: it copies the bytes into a slot and out
// again, and passes a time through std::priority_queue.
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <queue>
#include <string>
#include <vector>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/support/alloc_guard.h"

namespace {

using namespace tandem;
using namespace tandem::netsim;
using namespace std::chrono_literals;

constexpr std::size_t kSize = 128;
constexpr int kWarm = 5'000, kMeasured = 100'000, kRounds = 7;

double cpu_ns() { return 1e9 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A measured case: handles one datagram per call.
class Case {
 public:
  virtual ~Case() = default;
  virtual void one(Time now) = 0;
};

class Reference final : public Case {
 public:
  Reference() : slots_(1024 * kSize) {
    std::vector<Entry> room;
    room.reserve(1024);
    queue_ = Queue{std::greater<>{}, std::move(room)};
  }
  void one(Time now) override {
    const std::size_t slot = (count_++ % 1024) * kSize;
    std::memcpy(slots_.data() + slot, bytes_.data(), kSize);
    queue_.push({now + 20ms, slot});
    while (!queue_.empty() && queue_.top().first <= now) {
      std::memcpy(bytes_.data(), slots_.data() + queue_.top().second, kSize);
      queue_.pop();
    }
  }

 private:
  using Entry = std::pair<Time, std::size_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  std::vector<std::byte> slots_;
  std::array<std::byte, kSize> bytes_{};
  Queue queue_;
  std::size_t count_ = 0;
};

class Through final : public Case {
 public:
  Through(const LinkSpec& spec, bool logged) : network_(1), log_(logged ? 2 * (kWarm + kMeasured) : 1) {
    network_.add_link(spec);
    if (logged) network_.log_to(&log_);
  }
  void one(Time now) override {
    network_.send(now, 0, Direction::kUp, std::span{buffer_}.first(kSize));
    while (network_.poll(now, 0, Direction::kUp, buffer_)) {
    }
  }

 private:
  Network network_;
  DecisionLog log_;
  std::array<std::byte, kSlotBytes> buffer_{};
};

std::unique_ptr<Case> make(const std::string& name) {
  if (name == "reference") return std::make_unique<Reference>();
  const bool logged = name.ends_with(" logged");
  const auto profile = shipped_profile(logged ? name.substr(0, name.find(' ')) : name);
  if (!profile) {
    std::fputs(to_text(profile.error()).c_str(), stderr);
    std::exit(2);
  }
  return std::make_unique<Through>(profile->link, logged);
}

struct Cost {
  double ns = 0;
  std::size_t heap = 0;
};

Cost measure(const std::string& name) {
  const auto one = make(name);
  int i = 0;
  for (; i < kWarm; ++i) one->one(Time{1ms * i});
  const test::AllocGuard guard;
  const double begin = cpu_ns();
  for (; i < kWarm + kMeasured; ++i) one->one(Time{1ms * i});
  return {(cpu_ns() - begin) / kMeasured, guard.count()};
}

/// Opens a counter of this thread's user-space instructions. @return file descriptor; -1: the kernel or the machine
/// provides no counter
int open_counter() {
  perf_event_attr attributes{};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof attributes;
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  return static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
}

double counted_by_kernel(int counter, const std::string& name) {
  const auto one = make(name);
  const auto value = [&] {
    std::uint64_t instructions = 0;
    return read(counter, &instructions, sizeof instructions) == sizeof instructions ? static_cast<double>(instructions)
                                                                                    : 0;
  };
  int i = 0;
  for (; i < kWarm; ++i) one->one(Time{1ms * i});
  const double before = value();
  for (; i < 2 * kWarm; ++i) one->one(Time{1ms * i});
  return (value() - before) / kWarm;
}

/// Returns the instructions of this program for `count` datagrams, counted by callgrind; 0 if callgrind failed.
double collected(const std::string& self, const std::string& name, int count) {
  const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null '" + self + "' --only '" +
                              name + "' " + std::to_string(count) + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return 0;
  double all = 0;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr)
    if (const char* const at = std::strstr(line.data(), "Collected : "); at != nullptr) all = std::atof(at + 12);
  return pclose(pipe) == 0 ? all : 0;
}

double counted_by_valgrind(const std::string& self, const std::string& name) {
  const double few = collected(self, name, kWarm), many = collected(self, name, 3 * kWarm);
  return few > 0 ? (many - few) / (2 * kWarm) : 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string(arguments[1]) == "--only") {  // callgrind runs the program with these arguments
    const auto one = make(arguments[2]);
    const int datagrams = std::atoi(arguments[3]);
    for (int i = 0; i < datagrams; ++i) one->one(Time{1ms * i});
    return 0;
  }
  const std::vector<std::string> names{"reference", "ideal", "lan", "wifi-busy", "4g", "worst", "wifi-busy logged"};
  std::vector<std::vector<Cost>> costs(names.size());
  for (int round = 0; round < kRounds; ++round)  // interleaved, so that a disturbance affects all cases
    for (std::size_t i = 0; i < names.size(); ++i) costs[i].push_back(measure(names[i]));

  const std::string self = "/proc/" + std::to_string(getpid()) + "/exe";
  const int counter = open_counter();
  const bool valgrind = counter < 0 && std::system("command -v valgrind >/dev/null") == 0;
  const auto instructions = [&](const std::string& name) {
    return counter >= 0 ? counted_by_kernel(counter, name) : valgrind ? counted_by_valgrind(self, name) : 0;
  };
  const auto median = [](std::vector<Cost> all) {
    std::ranges::sort(all, {}, &Cost::ns);
    return all[all.size() / 2];
  };
  std::printf("%-18s %14s %12s %14s %12s %14s\n", "network", "ns/datagram", "x reference", "instructions",
              "x reference", "heap/100000");
  double ns = 0, ops = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Cost cost = median(costs[i]);
    const double own = instructions(names[i]);
    if (i == 0) ns = cost.ns, ops = own;
    std::printf("%-18s %14.1f %12.2f %14.0f %12.2f %14zu\n", names[i].c_str(), cost.ns, cost.ns / ns, own,
                ops > 0 ? own / ops : 0, cost.heap);
  }
  std::printf(
      "one way, %zu bytes at 1 kHz in virtual time; CPU time, median of %d interleaved rounds of %d; instructions by "
      "%s\n",
      kSize, kRounds, kMeasured,
      counter >= 0 ? "the kernel's counter (perf_event_open)"
      : valgrind   ? "valgrind --tool=callgrind"
                   : "none: 0");
  if (counter < 0 && !valgrind)
    std::printf("[ NOT RUN  ] instructions per datagram: no counter for us (perf_event_open) and no valgrind\n");
  return 0;
}

// The cost of a service's directory: snapshots of sessions, twice a second each, written to etcd as servers write them.
// How many sessions one cluster of etcd carries, how old a snapshot is when it is safe, and the processor time of each
// write. The reference of the same run is the disk: writes of one snapshot with fdatasync, one after the other.
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/clock.h"
#include "server/directory/io/etcd_directory.h"
#include "server/service/fenced_writer.h"
#include "server/service/service_keys.h"
#include "server/session/session_snapshot.h"
#include "tests/io/etcd_process.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kServers = 3;
constexpr Duration kInterval = 500ms;  // between two snapshots of a session
constexpr Duration kLength = 6s, kAnswerLimit = 2s, kPause = 20ms;

/// A snapshot of two hands on one tool, as a lesson has it.
std::string snapshot() {
  server::SessionSnapshot kept;
  kept.name = "lesson";
  kept.code = "ABCDEFGHJK";
  kept.persons = {"trainer", "trainee"};
  kept.checkpoint.seats_n = kept.checkpoint.masters_n = 2;
  kept.checkpoint.tools_n = 1;
  kept.checkpoint.dof = 3;
  kept.checkpoint.tools[0].alpha[0] = 1;
  const std::vector<std::byte> bytes = encode_snapshot(kept);
  return std::string(text_of(bytes));
}

/// Writes of this size per second that the disk of the temporary folder makes safe, one after the other.
double disk_writes_per_second(const std::string& bytes) {
  const std::string path = (std::filesystem::temp_directory_path() / format("tandem-fsync-%d", getpid())).string();
  const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0) return 0;
  std::size_t writes = 0;
  const Time began = io::monotonic_now();
  for (; io::monotonic_now() - began < 1s; ++writes)
    if (::write(file, bytes.data(), bytes.size()) < 0 || ::fdatasync(file) != 0) break;
  const double rate = static_cast<double>(writes) / seconds(io::monotonic_now() - began);
  ::close(file);
  std::filesystem::remove(path);
  return rate;
}

/// Processor time of a process so far [s].
double cpu_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 2)));
  std::string skipped;
  double user = 0, system = 0;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double own_cpu() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto s = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return s(used.ru_utime) + s(used.ru_stime);
}

/// One server's writer with its sessions.
struct Writer {
  Writer(std::size_t number, std::size_t sessions, const std::vector<std::string>& endpoints)
      : directory([&] {
          directory::EtcdOptions options;
          options.endpoints = endpoints;
          std::ranges::rotate(options.endpoints,
                              options.endpoints.begin() + static_cast<std::ptrdiff_t>(number % endpoints.size()));
          options.answer_limit = kAnswerLimit;
          return options;
        }()),
        writer(keys, places.writes(format("server%zu", number)), kPause),
        due(sessions) {
    for (std::size_t i = 0; i < sessions; ++i) names.push_back(format("server%zu-session%zu", number, i));
  }

  /// Runs one transaction to its end. @return false: no answer, or it did not hold
  bool run(directory::Transaction transaction) {
    directory.begin(++operation, transaction);
    for (const Time start = io::monotonic_now(); io::monotonic_now() - start < 10s;) {
      const auto reply = directory.poll();
      if (!reply) ::poll(nullptr, 0, 1);
      if (!reply || reply->operation != operation) continue;
      revision = reply->revision;
      return reply->outcome == directory::Outcome::kDone && reply->held;
    }
    return false;
  }
  /// Creates the owner keys. @return false: etcd does not answer
  bool own_sessions() {
    for (int tries = 0; !run({}); ++tries) {
      if (tries == 50) return false;
      ::poll(nullptr, 0, 100);
    }
    for (const std::string& name : names) {
      if (!run({{}, {directory::Put{keys.owner(name), "server", 0}}, {}})) return false;
      revisions.push_back(revision);
    }
    return true;
  }
  void step(Time now, const std::string& value) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (now >= due[i]) {
        due[i] += kInterval;
        writer.set(names[i], places.snapshot(names[i]), value, revisions[i]);
        ++wanted;
      }
    if (auto request = writer.poll_request(now, operation + 1, kAnswerLimit)) {
      directory.begin(++operation, *request);
      began = now;
    }
    while (const auto reply = directory.poll())
      if (writer.on_reply(*reply) && reply->outcome == directory::Outcome::kDone)
        answers.push_back(seconds(io::monotonic_now() - began));
  }

  directory::DirectoryKeys keys;
  server::ServiceKeys places{"/tandem/v1/"};
  directory::EtcdDirectory directory;
  server::FencedWriter writer;
  std::vector<std::string> names;
  std::vector<directory::Revision> revisions;
  std::vector<Time> due;
  std::vector<double> answers;  ///< time of each transaction [s]
  directory::OperationId operation = 0;
  directory::Revision revision = 0;
  std::uint64_t wanted = 0;
  Time began{};  ///< of the newest transaction
};

/// @return false: etcd does not answer
bool print_row(std::size_t members, std::size_t sessions, const std::string& value, double disk) {
  test::EtcdCluster cluster(members);
  std::vector<std::unique_ptr<Writer>> writers;
  for (std::size_t n = 0; n < kServers; ++n) {
    writers.push_back(std::make_unique<Writer>(n, (sessions + n) / kServers, cluster.endpoints()));
    if (!writers.back()->own_sessions()) return false;
  }
  const Time began = io::monotonic_now();
  for (const auto& writer : writers)  // spread over the interval, as sessions are
    for (std::size_t i = 0; i < writer->due.size(); ++i)
      writer->due[i] = began + kInterval * static_cast<std::int64_t>(i) / static_cast<std::int64_t>(writer->due.size());
  const auto cpu = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < members; ++i) sum += cpu_of(cluster.member(i).process().id());
    return sum;
  };
  const double etcd_before = cpu(), own_before = own_cpu();
  while (io::monotonic_now() - began < kLength) {
    for (const auto& writer : writers) writer->step(io::monotonic_now(), value);
    ::poll(nullptr, 0, 1);
  }
  const double took = seconds(io::monotonic_now() - began), etcd = cpu() - etcd_before, own = own_cpu() - own_before;
  std::uint64_t written = 0, wanted = 0, batches = 0;
  std::vector<double> answers;
  for (const auto& writer : writers) {
    written += writer->writer.counters().written, batches += writer->writer.counters().batches;
    wanted += writer->wanted;
    answers.insert(answers.end(), writer->answers.begin(), writer->answers.end());
  }
  std::ranges::sort(answers);
  const auto quantile = [&](double q) {
    return answers.empty() ? 0 : 1e3 * answers[static_cast<std::size_t>(q * static_cast<double>(answers.size() - 1))];
  };
  const auto count = static_cast<double>(std::max<std::uint64_t>(written, 1));
  std::printf("%7zu %8zu %9.0f %7.2f %8.1f %7.1f %8.1f %9.0f %9.0f %7.1f\n", members, sessions,
              static_cast<double>(written) / took, static_cast<double>(written) / static_cast<double>(wanted),
              count / static_cast<double>(std::max<std::uint64_t>(batches, 1)), quantile(0.5), quantile(0.99),
              1e6 * etcd / count, 1e6 * own / count, count / took / disk);
  return true;
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem::bench;
  if (tandem::test::etcd_program("etcd").empty()) {
    std::printf("[ NOT RUN ] etcd is not installed (Debian: etcd-server)\n");
    return 0;
  }
  const std::string value = snapshot();
  const double disk = disk_writes_per_second(value);
  std::printf(
      "Snapshots of %zu bytes, two a second and session, by %zu servers on this machine together with etcd; the disk "
      "alone: %.0f safe writes/s\n"
      "%7s %8s %9s %7s %8s %7s %8s %9s %9s %7s\n",
      value.size(), kServers, disk, "members", "sessions", "writes/s", "share", "batch", "p50 ms", "p99 ms", "etcd us",
      "server us", "/ disk");
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  for (const std::size_t members : {std::size_t{1}, std::size_t{3}})
    for (const std::size_t sessions : {30, 300, 1500, 6000})
      if ((!quick || sessions == 30) && !print_row(members, sessions, value, disk)) {
        std::printf("etcd does not answer\n");
        return 1;
      }
  std::printf(
      "share: of the due snapshots, written; batch: snapshots per transaction; us: processor time per snapshot, of all "
      "members together and of all servers\n");
  return 0;
}

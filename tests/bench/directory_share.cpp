// Cost of a directory for a server while its sessions run: processor time of a member of a service over that of the
// same server alone, with the same sessions and clients at the same time.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "common/auth/io/client_keystore.h"
#include "common/auth/ticket.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "tests/bench/service_hosts.h"

namespace tandem::bench {
namespace {

constexpr std::array<std::size_t, 2> kSessions{4, 8};
constexpr std::size_t kRounds = 5;
constexpr int kRoundMs = 6000;

/// Processor time of a process so far [s].
double cpu_of(pid_t process) {
  double sum = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    double ns = 0;
    std::ifstream(task.path() / "schedstat") >> ns;
    sum += 1e-9 * ns;
  }
  return sum;
}

/// A server with two simulated hands per session.
class Played {
 public:
  Played(const std::string& folder, std::size_t sessions, const test::EtcdCluster* etcd)
      : keys_(std::move(*auth::ClientKeystore::open_or_make(folder + "-desk", auth::wall_seconds()))),
        hosts_({folder, 1, sessions}, keys_.identity(), etcd) {
    const Host& host = hosts_[0];
    const std::string address = io::to_text(host.address), desk = folder + "-desk";
    static_cast<void>(keys_.store_server({address, host.keys->identity().fingerprint().sha256, kWorkstation}));
    for (std::size_t m = 0; m < sessions; ++m)
      for (const char* seat : {"trainer", "trainee"}) {
        const std::string name = Hosts::name_of(0, m), file = folder + "-" + name + seat + ".ticket";
        std::ofstream(file) << ticket(host, m, seat) << "\n";
        clients_.emplace_back(std::vector<std::string>{TANDEM_CLIENT, "join", "--server", address, "--state", desk,
                                                       "--session", name, "--seat", seat, "--ticket-file", file,
                                                       "--device", "sim", "--quiet"});
      }
    for (std::size_t m = 0; m < sessions; ++m)
      if (!host.process->wait_for("the session runs")) fail(host.process->out() + host.process->err());
    ::poll(nullptr, 0, 3000);
  }
  [[nodiscard]] double cpu() const { return cpu_of(hosts_[0].process->id()); }

 private:
  static std::string ticket(const Host& host, std::size_t session, const char* seat) {
    auth::Ticket made;
    made.ticket_id = auth::random_bytes<auth::Id16>();
    made.session_id = host.sessions[session];
    made.seat = seat;
    made.role = std::string_view(seat) == "trainer" ? AccessRole::kInstructor : AccessRole::kTrainee;
    made.workstation =
        auth::KeyFingerprint{auth::find_workstation(*host.keys->registry().workstations(), kWorkstation)->spki};
    made.not_before = auth::wall_seconds();
    made.not_after = auth::wall_seconds() + 600;
    const auto bytes = auth::sign_ticket(made, host.keys->ticket_key());
    if (!bytes) fail(bytes.error());
    return auth::ticket_text(*bytes);
  }

  auth::ClientKeystore keys_;
  Hosts hosts_;
  std::vector<test::Process> clients_;
};

/// The directory costs a server about the same, however many clients it has, so that more of them make it less of the
/// whole.
void measure(const std::string& folder, std::size_t sessions) {
  const test::EtcdCluster etcd(3);
  const Played alone(folder + "/alone", sessions, nullptr), member(folder + "/member", sessions, &etcd);
  std::vector<double> ratios;
  double alone_share = 0, member_share = 0;
  for (std::size_t n = 0; n < kRounds; ++n) {
    const std::array before{alone.cpu(), member.cpu()};
    const Time began = io::monotonic_now();
    ::poll(nullptr, 0, kRoundMs);
    const double took = seconds(io::monotonic_now() - began);
    const double a = (alone.cpu() - before[0]) / took, m = (member.cpu() - before[1]) / took;
    ratios.push_back(m / a);
    alone_share += a / kRounds, member_share += m / kRounds;
  }
  std::ranges::sort(ratios);
  std::printf(
      "%zu sessions of two hands at 1 kHz: server alone %.1f %% of a core, member of a service %.1f %%; ratio %.3f "
      "[%.3f..%.3f], median of %zu rounds at the same time (asked: at most 1.02)\n",
      sessions, 100 * alone_share, 100 * member_share, ratios[kRounds / 2], ratios.front(), ratios.back(), kRounds);
}

int run() {
  if (test::etcd_program("etcd").empty()) {
    std::printf("[ NOT RUN ] etcd is not installed (Debian: etcd-server)\n");
    return 0;
  }
  std::string folder = (std::filesystem::temp_directory_path() / "tandem-share-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) fail("no temporary folder");
  for (const std::size_t sessions : kSessions) {
    const std::string of_size = folder + format("/%zu", sessions);
    std::filesystem::create_directory(of_size);
    measure(of_size, sessions);
  }
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main() { return tandem::bench::run(); }

#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/owners_witness.h"
#include "tests/io/pressing_hands.h"
#include "tests/io/service_fixture.h"

namespace tandem::test {

/// A service with session `lab`, in which two hands press a tool against a wall while the test disturbs the servers.
/// At its end `expect_safe` judges what all these tests promise: one owner, and force from zero.
class PressingService {
 public:
  explicit PressingService(std::size_t etcds = 1, const Words& tls = {})
      : service_("session { name: \"lab\" scene: \"press.textproto\" }", etcds, 3, tls) {
    service_.folder().write("press.textproto", pressing());
  }
  [[nodiscard]] LiveService& service() { return service_; }
  [[nodiscard]] OwnersWitness& witness() { return witness_; }

  /// Starts servers; the first one owns the session. Returns when a standby is named.
  void start(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      Process& server = service_.start(name);
      EXPECT_TRUE(server.wait_for("is a member of the service")) << server.err();
      if (name == names.front()) service_.wait_for_sessions(name, 1);
      witness_.watch(name, service_.metrics(name));
      names_.push_back(name);
    }
    if (names.size() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  }
  /// Both hands join at an address of a server, and press. @param more  further arguments of both clients
  void join(const std::string& address, const Words& more = {}) {
    const Folder& folder = service_.folder();
    const std::string own = service_.enrolled("desk");
    for (const char* seat : kSeats) {
      const std::string ticket = folder.write(std::string(seat) + ".ticket", ticket_of(seat));
      Words words{"--session",     "lab",
                  "--ticket-file", ticket,
                  "--state",       own,
                  "--trace",       folder.file(std::string(seat) + ".csv"),
                  "--json",        folder.file(std::string(seat) + ".json")};
      words.insert(words.end(), more.begin(), more.end());
      hands_.push_back(std::make_unique<Process>(client(address, seat, words)));
    }
    wait_until_active();
    std::this_thread::sleep_for(std::chrono::milliseconds(3500));  // until they press
  }
  /// A ticket for a seat of the session, made at a server.
  [[nodiscard]] std::string ticket_of(const std::string& seat, const std::string& server = "a") const {
    return first_line(LiveService::run({"ticket", "--session", "lab", "--seat", seat, "--workstation", "desk",
                                        "--state", service_.folder().file(server)}));
  }
  [[nodiscard]] Process& hand(std::size_t n) { return *hands_.at(n); }

  /// Waits until a condition holds. @return time that it took [s]  @throws std::runtime_error after 30 s
  double wait_until(const std::function<bool()>& holds, const std::string& what) const {
    const auto began = std::chrono::steady_clock::now();
    const auto taken = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(); };
    while (!holds()) {
      if (taken() > 30) throw std::runtime_error("not after 30 s: " + what + "\n" + story());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return taken();
  }
  /// Waits until both hands are wholly active at a server. @param server  empty: at any  @return time that it took [s]
  double wait_until_active(const std::string& server = "") const {
    return wait_until(
        [&] {
          const std::string at = server.empty() ? witness_.owner() : server;
          return witness_.newest(at).active == kSeats.size();
        },
        "both hands are active at server " + (server.empty() ? "any" : server));
  }
  /// Waits until both hands report to a server that they are not engaged. @return time that it took [s]
  double wait_until_released(const std::string& server) const {
    return wait_until([&] { return witness_.newest(server).engaged == 0; }, "both hands are free at server " + server);
  }

  /// Ends the hands, and judges: no two servers engaged hands at one time, and each hand came back from zero force.
  /// @param rejoins  reconnections of each hand; nullopt: any number  @return absences of both hands
  std::vector<Absence> expect_safe(std::optional<std::size_t> rejoins) {
    for (auto& hand : hands_) {
      hand->signal(SIGINT);
      EXPECT_EQ(hand->wait(), 0) << hand->err();
    }
    witness_.stop();
    EXPECT_EQ(witness_.overlaps(), 0U) << "two servers engaged hands at one time";
    std::vector<Absence> all;
    for (const char* seat : kSeats) {
      SCOPED_TRACE(seat);
      if (rejoins) {
        EXPECT_EQ(service_.folder().json(std::string(seat) + ".json")["rejoins"], *rejoins);
      }
      for (const Absence& absence : absences(Trace(service_.folder().read(std::string(seat) + ".csv")))) {
        EXPECT_LE(absence.first_n, kFirstForceMax);
        all.push_back(absence);
      }
    }
    return all;
  }

  static constexpr std::array<const char*, 2> kSeats{"trainer", "trainee"};
  static constexpr double kFirstForceMax = 0.05;  // [N] in the first tick of a return

 private:
  /// Ends all hands and servers. @return what they printed
  [[nodiscard]] std::string story() const {
    std::string text;
    const auto add = [&](Process& process, const std::string& name, int signal) {
      process.signal(SIGCONT);
      process.signal(signal);
      static_cast<void>(process.wait());
      text += "---- " + name + "\n" + process.err();
    };
    for (std::size_t n = 0; n < hands_.size(); ++n) add(*hands_[n], kSeats[n], SIGINT);
    for (const std::string& name : names_) add(service_.of(name), "server " + name, SIGTERM);
    return text;
  }

  LiveService service_;
  OwnersWitness witness_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Process>> hands_;
};

/// Skips a test where a program is missing.
class PressingServiceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  }
};

/// A value of each absence.
inline std::vector<double> values(const std::vector<Absence>& of, double Absence::* part) {
  std::vector<double> all;
  for (const Absence& absence : of) all.push_back(absence.*part);
  return all;
}

}  // namespace tandem::test

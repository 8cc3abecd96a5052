#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/control_client.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/control_thread.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::server::test {

using namespace std::chrono_literals;
using auth::test::Folder;
using auth::test::kNow;

/// Limit for every wait, so that a hanging test fails. No test judges durations.
inline constexpr auto kTimeout = 30s;

/// One session with any requested seat. It redeems tickets as a real server does.
class OneSession : public JoinHandler {
 public:
  explicit OneSession(auth::ServerKeystore& trust, std::function<std::int64_t()> wall)
      : trust_(trust), wall_(std::move(wall)) {}
  ~OneSession() override {
    if (late_.joinable()) late_.join();
  }

  void admit(const JoinRequest& request, std::function<void(JoinReply)> answer) override {
    if (hold) {  // the test answers later
      held = answer;
      return;
    }
    JoinReply result = judge(request);
    if (!from_another_thread) return answer(std::move(result));
    if (late_.joinable()) late_.join();
    late_ = std::thread([answer = std::move(answer), result = std::move(result)] { answer(result); });
  }
  void on_joined(const JoinRequest&, const rpc::Welcome& welcome, const Secret<auth::kExportSize>& secrets) override {
    const std::lock_guard lock(mutex);
    seats_secrets[welcome.seat] = secrets.bytes;
  }
  void on_join_failed(const rpc::Welcome&) override {
    const std::lock_guard lock(mutex);
    ++abandoned_count;
    changed.notify_all();
  }
  rpc::SessionList list(const rpc::SessionListRequest&) override {
    return {{{session_id, "contact", phase, {{"trainee"}}}}, false};
  }
  bool learns_enrolments() const override { return on_unknown && on_unknown(); }
  void command(const rpc::Welcome&, const WorkstationRow&, rpc::Body, std::function<void(rpc::Body)> answer) override {
    const std::lock_guard lock(mutex);
    if (mute) return unanswered.push_back(std::move(answer)), changed.notify_all();
    answer(rpc::Ok{});
  }
  bool is_current(const rpc::Welcome&) const override { return seat_is_held; }
  void on_disconnected(const rpc::Welcome&, bool) override {}

  [[nodiscard]] rpc::Welcome welcome(const std::string& seat) const {
    rpc::Welcome w;
    w.session_id = session_id;
    w.session_name = "contact";
    w.epoch = 7;
    w.server_cid = 99;
    w.seat = seat;
    w.role = AccessRole::kTrainee;
    w.udp_port = 7000;
    w.resume_secret = auth::test::secret_from<32>(200);
    return w;
  }

  const rpc::Id session_id = auth::test::counting<16>(50);
  bool from_another_thread = false, hold = false, mute = false;  ///< mute: commands get no answer
  std::atomic<bool> seat_is_held{true};
  std::atomic<rpc::SessionPhase> phase{rpc::SessionPhase::kWaiting};
  std::function<void(JoinReply)> held;
  std::function<bool()> on_unknown;  ///< result of `learns_enrolments`; on the control plane's thread
  std::mutex mutex;
  std::condition_variable changed;
  int abandoned_count = 0;
  std::vector<std::function<void(rpc::Body)>> unanswered;
  std::map<std::string, std::array<std::byte, auth::kExportSize>> seats_secrets;

 private:
  JoinReply judge(const JoinRequest& request) {
    const auto* ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential);
    if (ticket == nullptr) return rpc::ErrorReply{rpc::ErrorCode::kTicket, "no ticket", 0};
    const auth::TicketUse use{
        session_id, 7, request.hello.seat, AccessRole::kTrainee, auth::KeyFingerprint{request.workstation.spki},
        wall_()};
    const auto redeemed = trust_.tickets().redeem(ticket->bytes, use);
    if (!redeemed) return ticket_error_reply(redeemed.error());
    return welcome(request.hello.seat);
  }

  auth::ServerKeystore& trust_;
  std::function<std::int64_t()> wall_;
  std::thread late_;
};

/// A control server on 127.0.0.1 with a state directory, and the events that it reported.
class ControlServerFixture {
 public:
  explicit ControlServerFixture(const ControlLimits& limits = patient())
      : ControlServerFixture(limits, "127.0.0.1:0") {}
  ControlServerFixture(const ControlLimits& limits, const std::string& at) {
    EXPECT_TRUE(auth::ServerKeystore::init(folder.path("server"), kNow));
    trust_.emplace(std::move(*auth::ServerKeystore::open(folder.path("server"))));
    EXPECT_EQ(trust_->begin_serving(kNow), "");
    sessions.emplace(*trust_, [this] { return wall.load(); });
    ControlClocks clocks;
    clocks.wall = [this] { return wall.load(); };
    clocks.monotonic = [this] { return frozen.load() ? Time{1h} : io::monotonic_now(); };
    plane.emplace(thread_.context(), *trust_, *sessions, limits, clocks, [this](const ControlEventRecord& news) {
      const std::lock_guard lock(mutex_);
      news_.push_back(news);
      told_.notify_all();
    });
    const auto bound = plane->listen(*io::parse_address(at, 0));
    EXPECT_TRUE(bound) << bound.error();
    address = *bound;
    server_fingerprint = trust_->identity().fingerprint();
    thread_.start();
  }
  ~ControlServerFixture() {
    thread_.stop([this] { plane->stop(); });
  }

  /// Limits so generous that a slow machine does not reach them.
  static ControlLimits patient() {
    ControlLimits limits;
    limits.deadline = limits.frame_deadline = limits.first_byte = limits.first_byte_pressed = limits.unjoined_idle =
        std::chrono::minutes(5);
    return limits;
  }

  /// Waits until `event` was reported `times` times. @return false after kTimeout
  bool told(ControlEvent event, std::size_t times = 1) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, kTimeout, [&] {
      return static_cast<std::size_t>(std::ranges::count(news_, event, &ControlEventRecord::event)) >= times;
    });
  }
  std::vector<ControlEventRecord> news() {
    const std::lock_guard lock(mutex_);
    return news_;
  }
  /// Returns a second keystore on the folder, as a command beside the running server opens it.
  [[nodiscard]] auth::ServerKeystore beside() const {
    return std::move(*auth::ServerKeystore::open(folder.path("server")));
  }
  /// Enrolls a workstation with this name. @return its identity
  auth::Identity enrolled(const std::string& name, std::int64_t at = kNow) const {
    auth::Identity made = auth::Identity::make(name, auth::test::counting<16>(), kNow);
    EXPECT_EQ(beside().registry().enroll_without_code({name, made.fingerprint().sha256, at}), "");
    return made;
  }
  std::expected<auth::ControlClient, auth::ClientError> connect(const auth::Identity& as, int signals = -1) const {
    return auth::ControlClient::connect(
        address,
        [&as, this](const auth::KeyFingerprint& fingerprint) -> std::expected<const auth::Identity*, std::string> {
          if (fingerprint == server_fingerprint) return &as;
          return std::unexpected("another key");
        },
        kTimeout, signals);
  }
  [[nodiscard]] auth::TicketBytes ticket(const auth::Identity& workstation, unsigned number = 1) const {
    auth::Ticket t = auth::test::sample_ticket();
    t.ticket_id = auth::test::counting<16>(number);
    t.workstation = workstation.fingerprint();
    return *auth::sign_ticket(t, beside().ticket_key());
  }

  Folder folder;
  std::atomic<std::int64_t> wall{kNow};
  std::atomic<bool> frozen{false};
  io::SocketAddress address;
  auth::KeyFingerprint server_fingerprint;

 private:
  std::optional<auth::ServerKeystore> trust_;
  ControlThread thread_;  // outlives the objects that use its context

 public:
  std::optional<OneSession> sessions;
  std::optional<ControlPlane> plane;

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  std::vector<ControlEventRecord> news_;
};

inline rpc::Hello hello_with(const auth::TicketBytes& ticket, const std::string& seat = "trainee") {
  rpc::Hello hello;
  hello.seat = seat;
  hello.credential = rpc::TicketCredential{{ticket.begin(), ticket.end()}};
  return hello;
}

/// Returns the error code of a rejection; nullopt for any other answer, or none.
inline std::optional<rpc::ErrorCode> reason_of(const std::expected<rpc::Body, auth::ClientError>& answer) {
  if (!answer) return std::nullopt;
  const auto* refused = std::get_if<rpc::ErrorReply>(&*answer);
  return refused == nullptr ? std::nullopt : std::optional(refused->code);
}

}  // namespace tandem::server::test

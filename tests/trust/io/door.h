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

#include "common/trust/io/client_trust.h"
#include "common/trust/io/control_client.h"
#include "server/app/control_plane.h"
#include "tests/trust/io/folder.h"
#include "tests/trust/support.h"

namespace tandem::server::test {

using namespace std::chrono_literals;
using trust::test::Folder;
using trust::test::kNow;

/// Nothing may hang for longer; how long things take is never judged.
inline constexpr auto kPatience = 30s;

/// One session with seats as asked for; tickets are redeemed as a real server does.
class OneSession : public Admissions {
 public:
  explicit OneSession(trust::ServerTrust& trust, std::function<std::int64_t()> wall) : trust_(trust), wall_(std::move(wall)) {}
  ~OneSession() override {
    if (late_.joinable()) late_.join();
  }

  void admit(const JoinRequest& request, std::function<void(Admission)> answer) override {
    if (hold) {  // the test answers when it likes
      held = answer;
      return;
    }
    Admission result = judge(request);
    if (!from_another_thread) return answer(std::move(result));
    if (late_.joinable()) late_.join();
    late_ = std::thread([answer = std::move(answer), result = std::move(result)] { answer(result); });
  }
  void seated(const JoinRequest&, const control::Welcome& welcome, const Secret<trust::kExportSize>& secrets) override {
    const std::lock_guard lock(mutex);
    seats_secrets[welcome.seat] = secrets.bytes;
  }
  void abandoned(const control::Welcome&) override {
    const std::lock_guard lock(mutex);
    ++abandoned_count;
    changed.notify_all();
  }
  control::SessionList list(const WorkstationRow&) override { return {{{session_id, "contact", control::SessionPhase::kWaiting, {{"trainee"}}}}, false}; }
  void command(const control::Welcome&, const WorkstationRow&, const control::Body&, std::function<void(control::Body)> answer) override {
    const std::lock_guard lock(mutex);
    if (mute) return unanswered.push_back(std::move(answer)), changed.notify_all();
    answer(control::Done{});
  }
  bool holds(const control::Welcome&) const override { return seat_is_held; }
  void left(const control::Welcome&, bool) override {}

  [[nodiscard]] control::Welcome welcome(const std::string& seat) const {
    control::Welcome w;
    w.session_id = session_id;
    w.session_name = "contact";
    w.epoch = 7;
    w.server_cid = 99;
    w.seat = seat;
    w.role = AccessRole::kTrainee;
    w.udp_port = 7000;
    w.resume_secret = trust::test::secret_from<32>(200);
    return w;
  }

  const control::Id session_id = trust::test::counting<16>(50);
  bool from_another_thread = false, hold = false, mute = false;  ///< mute: commands get no answer
  std::atomic<bool> seat_is_held{true};
  std::function<void(Admission)> held;
  std::mutex mutex;
  std::condition_variable changed;
  int abandoned_count = 0;
  std::vector<std::function<void(control::Body)>> unanswered;
  std::map<std::string, std::array<std::byte, trust::kExportSize>> seats_secrets;

 private:
  Admission judge(const JoinRequest& request) {
    const auto* ticket = std::get_if<control::TicketCredential>(&request.hello.credential);
    if (ticket == nullptr) return control::Refused{control::Reason::kTicket, "no ticket", 0};
    const trust::TicketUse use{session_id, 7, request.hello.seat, AccessRole::kTrainee, trust::Pin{request.workstation.spki}, wall_()};
    const auto redeemed = trust_.redeem(ticket->bytes, use);
    if (!redeemed) return refusal_of(redeemed.error());
    return welcome(request.hello.seat);
  }

  trust::ServerTrust& trust_;
  std::function<std::int64_t()> wall_;
  std::thread late_;
};

/// A server's door on 127.0.0.1 with a state folder, and what it told.
class Door {
 public:
  explicit Door(const ControlLimits& limits = patient()) : Door(limits, "127.0.0.1:0") {}
  Door(const ControlLimits& limits, const std::string& at) {
    EXPECT_TRUE(trust::ServerTrust::init(folder.path("server"), kNow));
    trust_.emplace(std::move(*trust::ServerTrust::open(folder.path("server"))));
    EXPECT_EQ(trust_->begin_serving(kNow), "");
    sessions.emplace(*trust_, [this] { return wall.load(); });
    ControlClocks clocks;
    clocks.wall = [this] { return wall.load(); };
    clocks.monotonic = [this] { return frozen.load() ? Time{1h} : io::monotonic_now(); };
    plane.emplace(thread_.context(), *trust_, *sessions, limits, clocks, [this](const ControlNews& news) {
      const std::lock_guard lock(mutex_);
      news_.push_back(news);
      told_.notify_all();
    });
    const auto bound = plane->listen(*io::parse_address(at, 0));
    EXPECT_TRUE(bound) << bound.error();
    address = *bound;
    server_pin = trust_->identity().pin();
    thread_.start();
  }
  ~Door() {
    thread_.stop([this] { plane->stop(); });
  }

  /// Generous: a slow machine must not meet them.
  static ControlLimits patient() {
    ControlLimits limits;
    limits.deadline = limits.frame_deadline = limits.first_byte = limits.first_byte_pressed = limits.bare_idle = std::chrono::minutes(5);
    return limits;
  }

  /// Waits until `event` was told `times` times.
  bool told(ControlEvent event, std::size_t times = 1) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, kPatience, [&] { return static_cast<std::size_t>(std::ranges::count(news_, event, &ControlNews::event)) >= times; });
  }
  std::vector<ControlNews> news() {
    const std::lock_guard lock(mutex_);
    return news_;
  }
  /// As a command beside the server.
  [[nodiscard]] trust::ServerTrust beside() const { return std::move(*trust::ServerTrust::open(folder.path("server"))); }
  /// A workstation of the name, enrolled.
  trust::Identity enrolled(const std::string& name) const {
    trust::Identity made = trust::Identity::make(name, trust::test::counting<16>(), kNow);
    EXPECT_EQ(beside().enrol_directly({name, made.pin().sha256, kNow}), "");
    return made;
  }
  std::expected<trust::ControlClient, trust::ClientFault> connect(const trust::Identity& as, int signals = -1) const {
    return trust::ControlClient::connect(
        address,
        [&as, this](const trust::Pin& pin) -> std::expected<const trust::Identity*, std::string> {
          if (pin == server_pin) return &as;
          return std::unexpected("another key");
        },
        kPatience, signals);
  }
  [[nodiscard]] trust::TicketBytes ticket(const trust::Identity& workstation, unsigned number = 1) const {
    trust::Ticket t = trust::test::sample_ticket();
    t.ticket_id = trust::test::counting<16>(number);
    t.workstation = workstation.pin();
    return *trust::sign_ticket(t, beside().ticket_key());
  }

  Folder folder;
  std::atomic<std::int64_t> wall{kNow};
  std::atomic<bool> frozen{false};
  io::SocketAddress address;
  trust::Pin server_pin;

 private:
  std::optional<trust::ServerTrust> trust_;
  ControlThread thread_;  // outlives what uses its context

 public:
  std::optional<OneSession> sessions;
  std::optional<ControlPlane> plane;

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  std::vector<ControlNews> news_;
};

inline control::Hello hello_with(const trust::TicketBytes& ticket, const std::string& seat = "trainee") {
  control::Hello hello;
  hello.seat = seat;
  hello.credential = control::TicketCredential{{ticket.begin(), ticket.end()}};
  return hello;
}

/// The reason of a refusal; nothing: another answer, or none.
inline std::optional<control::Reason> reason_of(const std::expected<control::Body, trust::ClientFault>& answer) {
  if (!answer) return std::nullopt;
  const auto* refused = std::get_if<control::Refused>(&*answer);
  return refused == nullptr ? std::nullopt : std::optional(refused->reason);
}

}  // namespace tandem::server::test

#pragma once

#include <gtest/gtest.h>

#include <asio/post.hpp>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/trust/io/control_client.h"
#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"
#include "server/app/control_plane.h"
#include "server/app/house.h"
#include "tests/trust/io/folder.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// Nothing may hang for longer; how long things take is never judged.
inline constexpr auto kPatience = 30s;

/// A server as people meet it: a session that ticks on its own thread, the house, the door with TLS, a state folder. Everybody who
/// comes is a workstation of his own.
class LiveHouse {
 public:
  /// @param door  limits of the control connections
  /// @param kept  what the session goes on from, made when the state folder and `enrolled` are there; null: it is new
  explicit LiveHouse(const std::string& scene_name = "free_motion", const LoadLimits& load = {}, const ControlLimits& door = limits(),
                     const std::function<KeptSession(const LiveHouse&)>& kept = {})
      : scene_(*parse_scene(find_shipped_scene(scene_name)->text, scene_name + ".textproto")), queue_(1024) {
    EXPECT_TRUE(trust::ServerTrust::init(folder.path("server"), trust::wall_seconds()));
    trust_.emplace(std::move(*trust::ServerTrust::open(folder.path("server"))));
    EXPECT_EQ(trust_->begin_serving(trust::wall_seconds()), "");
    hosted_ = std::make_unique<HostedSession>(scene_, *make_slaves(scene_, Time{}), 0, queue_);
    shard_ = std::make_unique<Shard>(std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), scene_.tick_hz);
    EXPECT_TRUE(shard_->host(*hosted_));
    house_.emplace(thread_.context(), *trust_, load);
    const auto left = kept ? std::optional(kept(*this)) : std::nullopt;
    House::Opening opening{kName, kId, kCode, 1, hosted_.get(), shard_.get()};
    if (left) {
      opening.kept = &*left;
      opening.back_until = io::monotonic_now() + kResumeLife;
    }
    house_->open(std::move(opening));
    house_->watch(*shard_);
    plane_.emplace(thread_.context(), *trust_, *house_, door, ControlClocks{}, [this](const ControlNews& news) {
      const std::lock_guard lock(mutex_);
      news_.push_back(news);
    });
    address = *plane_->listen(*io::parse_address("127.0.0.1:0", 0));
    pin_ = trust_->identity().pin();
    thread_.start();
    ticking_ = std::thread([this] { shard_->run(); });
  }
  ~LiveHouse() {
    thread_.stop([this] {
      plane_->stop();
      house_->stop_watching();
    });
    shard_->stop();
    ticking_.join();
  }

  static ControlLimits limits() {
    ControlLimits limits;
    limits.deadline = limits.frame_deadline = limits.first_byte = limits.first_byte_pressed = limits.bare_idle = std::chrono::minutes(5);
    limits.accept = {1e4, 1e4, 1e4, 1e4};
    return limits;
  }

  /// As a command beside the server.
  [[nodiscard]] trust::ServerTrust beside() const { return std::move(*trust::ServerTrust::open(folder.path("server"))); }
  [[nodiscard]] trust::Identity enrolled(const std::string& name) const {
    std::array<std::byte, 16> serial{};
    trust::fill_random(serial);
    trust::Identity made = trust::Identity::make(name, serial, trust::wall_seconds());
    EXPECT_EQ(beside().enrol_directly({name, made.pin().sha256, trust::wall_seconds()}), "");
    return made;
  }
  [[nodiscard]] control::Credential ticket(const trust::Identity& workstation, AccessRole role, const std::string& seat = {}) const {
    trust::Ticket t;
    trust::fill_random(t.ticket_id);
    t.session_id = kId;
    t.seat = seat;
    t.role = role;
    t.workstation = workstation.pin();
    t.not_before = trust::wall_seconds() - 1;
    t.not_after = t.not_before + 3600;
    const auto bytes = trust::sign_ticket(t, beside().ticket_key());
    EXPECT_TRUE(bytes) << bytes.error();
    return control::TicketCredential{{bytes->begin(), bytes->end()}};
  }
  [[nodiscard]] trust::ControlClient connect(const trust::Identity& as) const {
    auto client = trust::ControlClient::connect(address, [&](const trust::Pin&) -> std::expected<const trust::Identity*, std::string> { return &as; }, kPatience, -1);
    EXPECT_TRUE(client) << client.error().text;
    return std::move(*client);
  }
  [[nodiscard]] static control::Hello hello(const control::Credential& credential, const std::string& seat = {}) {
    control::Hello hello;
    hello.session = kId;
    hello.seat = seat;
    hello.credential = credential;
    hello.client_cid = 7;
    hello.device = {3, 3, true, false, 0, 0, 0};
    return hello;
  }

  /// Runs on the door's thread.
  void on_thread(const std::function<void()>& what) {
    std::promise<void> done;
    asio::post(thread_.context(), [&] {
      what();
      done.set_value();
    });
    done.get_future().wait();
  }
  /// What the door does some times a second.
  void look_for_revoked() {
    on_thread([&] {
      house_->look_for_revoked();
      plane_->look_for_revoked();
    });
  }
  void drain() {
    on_thread([&] { house_->drain(); });
  }
  [[nodiscard]] House& house() { return *house_; }
  [[nodiscard]] Shard& shard() { return *shard_; }
  [[nodiscard]] std::uint64_t count(ControlEvent event) const { return plane_->count(event); }
  [[nodiscard]] bool told(ControlEvent event, const std::string& workstation) {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(news_, [&](const ControlNews& n) { return n.event == event && n.workstation == workstation; });
  }
  [[nodiscard]] const SceneSpec& scene() const { return scene_; }
  [[nodiscard]] std::string audit() const { return folder.read("server/audit.log"); }

  static constexpr const char* kName = "lesson";
  static constexpr const char* kCode = "ABCDE12345";
  static constexpr trust::Id16 kId{std::byte{1}, std::byte{2}, std::byte{3}};

  trust::test::Folder folder;
  io::SocketAddress address;

 private:
  SceneSpec scene_;
  TickQueue queue_;
  std::optional<trust::ServerTrust> trust_;
  std::unique_ptr<HostedSession> hosted_;
  std::unique_ptr<Shard> shard_;
  ControlThread thread_;  // outlives what uses its context
  std::optional<House> house_;
  std::optional<ControlPlane> plane_;
  trust::Pin pin_;
  std::thread ticking_;
  std::mutex mutex_;
  std::vector<ControlNews> news_;
};

/// A workstation and what it was welcomed to.
struct Guest {
  trust::Identity key;
  trust::ControlClient connection;
  std::expected<control::Body, trust::ClientFault> welcome;

  [[nodiscard]] const control::Welcome& in() const { return std::get<control::Welcome>(*welcome); }
  [[nodiscard]] bool welcomed() const { return welcome && std::holds_alternative<control::Welcome>(*welcome); }
  std::expected<control::Body, trust::ClientFault> ask(const control::Body& body) { return connection.ask(body, kPatience); }
};

/// Somebody who joins by a ticket.
inline Guest joined(const LiveHouse& house, const std::string& name, AccessRole role, const std::string& seat = {}) {
  trust::Identity key = house.enrolled(name);
  auto connection = house.connect(key);
  auto welcome = connection.ask(LiveHouse::hello(house.ticket(key, role, seat), seat), kPatience);
  return {std::move(key), std::move(connection), std::move(welcome)};
}

inline std::optional<control::Reason> reason_of(const std::expected<control::Body, trust::ClientFault>& answer) {
  const auto* refused = answer ? std::get_if<control::Refused>(&*answer) : nullptr;
  return refused == nullptr ? std::nullopt : std::optional(refused->reason);
}
inline std::string text_of(const std::expected<control::Body, trust::ClientFault>& answer) {
  if (!answer) return answer.error().text;
  const auto* refused = std::get_if<control::Refused>(&*answer);
  return refused == nullptr ? "" : refused->text;
}
inline bool done(const std::expected<control::Body, trust::ClientFault>& answer) { return answer && std::holds_alternative<control::Done>(*answer); }
/// Who asks too often is told so, and waits. @throws std::runtime_error without an answer: nobody reads seats that are not there
inline control::Status status_of(Guest& guest) {
  auto answer = guest.ask(control::StatusRequest{LiveHouse::kId});
  for (int i = 0; i < 100 && reason_of(answer) == control::Reason::kTooFast; ++i) {
    std::this_thread::sleep_for(100ms);
    answer = guest.ask(control::StatusRequest{LiveHouse::kId});
  }
  if (!answer || !std::holds_alternative<control::Status>(*answer)) throw std::runtime_error("no status: " + text_of(answer));
  return std::get<control::Status>(*answer);
}

}  // namespace tandem::server::test

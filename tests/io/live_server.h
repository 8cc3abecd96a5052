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

#include "common/auth/io/control_client.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/control_thread.h"
#include "server/app/control/session_joins.h"
#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// Limit against hanging; durations are never judged.
inline constexpr auto kTimeout = 30s;

/// A whole server: a session on its own tick thread, the session registry, the control plane with TLS, a state
/// directory. Every client has its own workstation.
class LiveServer {
 public:
  /// @param door  limits of the control connections
  /// @param kept  makes the snapshot to restore, after the state directory and `enrolled` exist; null: a new session
  explicit LiveServer(const std::string& scene_name = "free_motion", const LoadLimits& load = {},
                      const ControlLimits& door = limits(),
                      const std::function<SessionSnapshot(const LiveServer&)>& kept = {})
      : scene_(*parse_scene(find_shipped_scene(scene_name)->text, scene_name + ".textproto")), queue_(1024) {
    EXPECT_TRUE(auth::ServerKeystore::init(folder.path("server"), auth::wall_seconds()));
    trust_.emplace(std::move(*auth::ServerKeystore::open(folder.path("server"))));
    EXPECT_EQ(trust_->begin_serving(auth::wall_seconds()), "");
    hosted_ = std::make_unique<LiveSession>(scene_, *make_local_slaves(scene_, Time{}), 0, queue_);
    shard_ = std::make_unique<Shard>(std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), scene_.tick_hz);
    EXPECT_TRUE(shard_->add_session(*hosted_));
    registry_.emplace(thread_.context());
    commands_.emplace(*registry_, *trust_);
    joins_.emplace(*registry_, *commands_, *trust_, load);
    const auto left = kept ? std::optional(kept(*this)) : std::nullopt;
    SessionRegistration opening{kName, kId, kCode, 1, hosted_.get(), shard_.get()};
    if (left) {
      opening.snapshot = &*left;
      opening.resume_until = io::monotonic_now() + kResumeLife;
    }
    registry_->add(std::move(opening));
    registry_->requests().watch(*shard_);
    plane_.emplace(thread_.context(), *trust_, *joins_, door, ControlClocks{}, [this](const ControlEventRecord& news) {
      const std::lock_guard lock(mutex_);
      news_.push_back(news);
    });
    address = *plane_->listen(*io::parse_address("127.0.0.1:0", 0));
    pin_ = trust_->identity().fingerprint();
    thread_.start();
    ticking_ = std::thread([this] { shard_->run(); });
  }
  ~LiveServer() {
    thread_.stop([this] {
      plane_->stop();
      registry_->requests().stop_watching();
    });
    shard_->stop();
    ticking_.join();
  }

  static ControlLimits limits() {
    ControlLimits limits;
    limits.deadline = limits.frame_deadline = limits.first_byte = limits.first_byte_pressed = limits.unjoined_idle =
        std::chrono::minutes(5);
    limits.accept = {1e4, 1e4, 1e4, 1e4};
    return limits;
  }

  /// The keystore as a local command opens it.
  [[nodiscard]] auth::ServerKeystore beside() const {
    return std::move(*auth::ServerKeystore::open(folder.path("server")));
  }
  [[nodiscard]] auth::Identity enrolled(const std::string& name) const {
    std::array<std::byte, 16> serial{};
    auth::fill_random(serial);
    auth::Identity made = auth::Identity::make(name, serial, auth::wall_seconds());
    EXPECT_EQ(beside().registry().enroll_without_code({name, made.fingerprint().sha256, auth::wall_seconds()}), "");
    return made;
  }
  [[nodiscard]] rpc::Credential ticket(const auth::Identity& workstation, AccessRole role, const std::string& seat = {},
                                       const std::string& person = {}) const {
    auth::Ticket t;
    auth::fill_random(t.ticket_id);
    t.session_id = kId;
    t.seat = seat;
    t.person = person;
    t.role = role;
    t.workstation = workstation.fingerprint();
    t.not_before = auth::wall_seconds();
    t.not_after = t.not_before + 3600;
    const auto bytes = auth::sign_ticket(t, beside().ticket_key());
    EXPECT_TRUE(bytes) << bytes.error();
    return rpc::TicketCredential{{bytes->begin(), bytes->end()}};
  }
  [[nodiscard]] auth::ControlClient connect(const auth::Identity& as) const {
    auto client = auth::ControlClient::connect(
        address, [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> { return &as; },
        kTimeout, -1);
    EXPECT_TRUE(client) << client.error().text;
    return std::move(*client);
  }
  [[nodiscard]] static rpc::Hello hello(const rpc::Credential& credential, const std::string& seat = {}) {
    rpc::Hello hello;
    hello.session = kId;
    hello.seat = seat;
    hello.credential = credential;
    hello.client_cid = 7;
    hello.device = {3, 3, true, false, 0, 0, 0};
    return hello;
  }

  /// Runs on the control thread.
  void on_thread(const std::function<void()>& what) {
    std::promise<void> done;
    asio::post(thread_.context(), [&] {
      what();
      done.set_value();
    });
    done.get_future().wait();
  }
  /// Checks for revoked workstations, as the control server does several times per second.
  void look_for_revoked() {
    on_thread([&] {
      commands_->disconnect_revoked();
      plane_->disconnect_revoked();
    });
  }
  void drain() {
    on_thread([&] { registry_->drain().begin(); });
  }
  [[nodiscard]] SessionRegistry& registry() { return *registry_; }
  [[nodiscard]] Shard& shard() { return *shard_; }
  [[nodiscard]] std::uint64_t count(ControlEvent event) const { return plane_->count(event); }
  [[nodiscard]] bool told(ControlEvent event, const std::string& workstation) {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(
        news_, [&](const ControlEventRecord& n) { return n.event == event && n.workstation == workstation; });
  }
  [[nodiscard]] const SceneSpec& scene() const { return scene_; }
  [[nodiscard]] std::string audit() const { return folder.read("server/audit.log"); }

  static constexpr const char* kName = "lesson";
  static constexpr const char* kCode = "ABCDE12345";
  static constexpr auth::Id16 kId{std::byte{1}, std::byte{2}, std::byte{3}};

  auth::test::Folder folder;
  io::SocketAddress address;

 private:
  SceneSpec scene_;
  TickQueue queue_;
  std::optional<auth::ServerKeystore> trust_;
  std::unique_ptr<LiveSession> hosted_;
  std::unique_ptr<Shard> shard_;
  ControlThread thread_;  // outlives the users of its context
  std::optional<SessionRegistry> registry_;
  std::optional<SessionCommands> commands_;
  std::optional<SessionJoins> joins_;
  std::optional<ControlPlane> plane_;
  auth::KeyFingerprint pin_;
  std::thread ticking_;
  std::mutex mutex_;
  std::vector<ControlEventRecord> news_;
};

/// A workstation and its Welcome.
struct JoinedClient {
  auth::Identity key;
  auth::ControlClient connection;
  std::expected<rpc::Body, auth::ClientError> welcome;

  [[nodiscard]] const rpc::Welcome& in() const { return std::get<rpc::Welcome>(*welcome); }
  [[nodiscard]] bool welcomed() const { return welcome && std::holds_alternative<rpc::Welcome>(*welcome); }
  std::expected<rpc::Body, auth::ClientError> ask(const rpc::Body& body) { return connection.ask(body, kTimeout); }
};

/// Joins by a ticket.
inline JoinedClient joined(const LiveServer& live_server, const std::string& name, AccessRole role,
                           const std::string& seat = {}, const std::string& person = {}) {
  auth::Identity key = live_server.enrolled(name);
  auto connection = live_server.connect(key);
  auto welcome = connection.ask(LiveServer::hello(live_server.ticket(key, role, seat, person), seat), kTimeout);
  return {std::move(key), std::move(connection), std::move(welcome)};
}

inline std::optional<rpc::ErrorCode> reason_of(const std::expected<rpc::Body, auth::ClientError>& answer) {
  const auto* refused = answer ? std::get_if<rpc::ErrorReply>(&*answer) : nullptr;
  return refused == nullptr ? std::nullopt : std::optional(refused->code);
}
inline std::string text_of(const std::expected<rpc::Body, auth::ClientError>& answer) {
  if (!answer) return answer.error().text;
  const auto* refused = std::get_if<rpc::ErrorReply>(&*answer);
  return refused == nullptr ? "" : refused->text;
}
inline bool done(const std::expected<rpc::Body, auth::ClientError>& answer) {
  return answer && std::holds_alternative<rpc::Ok>(*answer);
}
/// Requests the status, and waits when it is rejected for too many requests. @throws std::runtime_error without a
/// reply, so that no test reads missing seats
inline rpc::Status status_of(JoinedClient& guest) {
  auto answer = guest.ask(rpc::StatusRequest{LiveServer::kId});
  for (int i = 0; i < 100 && reason_of(answer) == rpc::ErrorCode::kTooFast; ++i) {
    std::this_thread::sleep_for(100ms);
    answer = guest.ask(rpc::StatusRequest{LiveServer::kId});
  }
  if (!answer || !std::holds_alternative<rpc::Status>(*answer))
    throw std::runtime_error("no status: " + text_of(answer));
  return std::get<rpc::Status>(*answer);
}

}  // namespace tandem::server::test

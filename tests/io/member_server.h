#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <asio/post.hpp>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/auth/io/service_keystore.h"
#include "common/io/event_fd.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/control_thread.h"
#include "server/app/control/session_joins.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/io/free_address.h"

namespace tandem::server::test {

using namespace std::chrono_literals;

/// Directory of a service as the test sets it, the same for all its servers. For one control thread at a time.
struct TestDirectory final : SessionLocator {
  Found locate(const rpc::SessionChoice&) override { return found; }
  std::vector<Elsewhere> elsewhere() const override { return others; }
  std::vector<std::string> members() const override { return addresses; }
  bool fresh() const noexcept override { return is_fresh; }

  Found found = None{};
  std::vector<Elsewhere> others;
  std::vector<std::string> addresses;
  bool is_fresh = true;
};

/// A whole server of a service, without a session until `serve`: a shard on its own thread, registry, control plane
/// with TLS, state directory.
class MemberServer {
 public:
  static constexpr const char* kCode = "ABCDE12345";
  static constexpr auth::Id16 kId{std::byte{1}, std::byte{2}, std::byte{3}};

  /// @param service  folder of the service that vouches for this server; empty: it belongs to none
  /// @param at       free for datagrams and for connections
  /// @param accept   limits of connections
  MemberServer(std::string name, const std::string& service, const std::string& at = tandem::test::free_address(),
               const auth::AcceptLimits& accept = {1e4, 1e4, 1e4, 1e4})
      : name_(std::move(name)), scene_(*parse_scene(find_shipped_scene("free_motion")->text, "free_motion")) {
    const std::int64_t now = auth::wall_seconds();
    key = auth::ServerKeystore::init(folder.path("server"), now).value();
    if (!service.empty()) {
      const auto file = auth::ServiceKeystore::open(service)->vouch({name_, key, now - 60, now + 86400});
      EXPECT_TRUE(auth::ServerKeystore::join_service(folder.path("server"), file->bytes(), "member", now));
    }
    trust_.emplace(std::move(*auth::ServerKeystore::open(folder.path("server"))));
    EXPECT_EQ(trust_->begin_serving(now), "");
    io::UdpSocket socket = std::move(*io::bind_udp(*io::parse_address(at, 0)));
    datagrams_ = socket.fd.get();
    shard_ = std::make_unique<Shard>(std::move(socket), scene_.tick_hz);
    registry_.emplace(thread_.context());
    commands_.emplace(*registry_, *trust_);
    joins_.emplace(*registry_, *commands_, *trust_);
    joins_->set_locator(&directory, name_);
    registry_->requests().watch(*shard_);
    ControlLimits limits;
    limits.accept = accept;
    plane_.emplace(thread_.context(), *trust_, *joins_, limits);
    address = *plane_->listen(shard_->address());  // datagrams and connections have one port
    thread_.start();
    ticking_ = std::thread([this] { shard_->run(); });
  }
  /// Makes the server mute and deaf to datagrams, as if its process were killed: its clients get no CLOSE.
  void silence() const {
    const io::UdpSocket other = std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0)));
    ASSERT_GE(::dup2(other.fd.get(), datagrams_), 0);
  }
  ~MemberServer() {
    thread_.stop([this] {
      plane_->stop();
      registry_->requests().stop_watching();
    });
    shard_->stop();
    ticking_.join();
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
  /// Serves the session from now on. @param resume  hash of the secret with which the seat trainee may be resumed
  void serve(std::uint64_t epoch, const std::optional<SeatReservation::Hash>& resume = {}) {
    hosted_ = std::make_unique<LiveSession>(scene_, *make_local_slaves(scene_, Time{}), 0, queue_);
    hosted_->persist_to(checkpoints_, epoch);
    SessionSnapshot kept;
    kept.checkpoint.seats_n = static_cast<std::uint8_t>(scene_.seats.size());
    for (std::size_t i = 0; resume && i < kept.checkpoint.seats_n; ++i)
      kept.checkpoint.seats[i] = {scene_.seats[i].name == "trainee", *resume, 1};
    std::promise<bool> served;
    on_thread([&] {
      SessionRegistration opening{"lesson", kId, kCode, epoch, hosted_.get(), shard_.get()};
      if (resume) {
        opening.snapshot = &kept;
        opening.resume_until = io::monotonic_now() + kResumeLife;
      }
      registry_->add_running(std::move(opening), [&](bool done) { served.set_value(done); });
    });
    EXPECT_TRUE(served.get_future().get());
  }
  void enrol(const auth::Identity& workstation) {
    on_thread([&] {
      EXPECT_EQ(
          trust_->registry().enroll_without_code({"touch-01", workstation.fingerprint().sha256, auth::wall_seconds()}),
          "");
    });
  }
  /// Hash of the secret with which the seat trainee may be resumed, once a checkpoint has it.
  [[nodiscard]] SeatReservation::Hash resume_hash_of_trainee() {
    while (true) {
      while (checkpoints_->take(newest_)) {
      }
      for (std::size_t i = 0; i < newest_.seats_n; ++i)
        if (scene_.seats[i].name == "trainee" && newest_.seats[i].resume != SeatReservation::Hash{})
          return newest_.seats[i].resume;
      std::this_thread::sleep_for(20ms);
    }
  }
  /// Whether the seat's datagrams arrive.
  [[nodiscard]] bool hears_trainee() const {
    const SessionStatus status = hosted_->status();
    for (std::size_t i = 0; i < scene_.seats.size(); ++i)
      if (scene_.seats[i].name == "trainee") return status.seats[i].taken && status.seats[i].alive;
    return false;
  }
  [[nodiscard]] std::vector<std::byte> voucher() const { return trust_->membership()->voucher; }
  [[nodiscard]] std::string at() const { return io::to_text(address); }
  /// Where this server is, as its directory says it.
  [[nodiscard]] ServerLocation location(std::uint64_t revision) const {
    return {at(), key.sha256, voucher(), "lesson", revision};
  }
  [[nodiscard]] SessionLocator::Elsewhere listed() const {
    return {{kId, "lesson", rpc::SessionPhase::kRunning, {}}, name_};
  }
  [[nodiscard]] std::uint64_t count(ControlEvent event) const { return plane_->count(event); }

  auth::test::Folder folder;
  TestDirectory directory;
  auth::KeyFingerprint key;
  io::SocketAddress address;

 private:
  std::string name_;
  int datagrams_ = -1;  ///< descriptor of the shard's socket
  SceneSpec scene_;
  TickQueue queue_{1024};
  io::EventFd checkpointed_;
  std::shared_ptr<CheckpointMailbox> checkpoints_ = std::make_shared<CheckpointMailbox>(checkpointed_);
  Checkpoint newest_;
  std::optional<auth::ServerKeystore> trust_;
  std::unique_ptr<LiveSession> hosted_;
  std::unique_ptr<Shard> shard_;
  ControlThread thread_;  // outlives the users of its context
  std::optional<SessionRegistry> registry_;
  std::optional<SessionCommands> commands_;
  std::optional<SessionJoins> joins_;
  std::optional<ControlPlane> plane_;
  std::thread ticking_;
};

}  // namespace tandem::server::test

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <expected>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "client/app/join_client.h"
#include "client/app/telemetry_feed.h"
#include "common/io/event_fd.h"
#include "server/console/app/feed_thread.h"
#include "server/console/app/live_source.h"

namespace tandem::console {

/// A console that joined, with the first status of its session.
struct JoinedLink {
  client::Console console;
  rpc::Status status;
  std::optional<client::TelemetryFeed> feed{};  ///< empty: without datagrams
  std::string warning{};                        ///< why without datagrams, although they were wanted
};

/// Joins as a console. @param watch  with datagrams; if the server refuses those, without
[[nodiscard]] std::expected<JoinedLink, client::JoinError> join_link(client::JoinOptions options, bool watch);

/// The control connection of one person, or of the gateway, with a thread of its own: orders, status requests, and the
/// datagrams of the session if it watches.
class ServerLink final : public LiveSource {
 public:
  static constexpr std::size_t kOrdersMax = 16;
  static constexpr std::chrono::seconds kFollow{60};

  struct Options {
    client::JoinOptions join;  ///< `signals` is not used
    bool watch = true;         ///< with datagrams
    /// Joins by itself whenever the connection is lost. Without it a link has a ticket, which is valid once. It then
    /// tries for kFollow to come back with the secret of its Welcome. In a service it also follows a session to another
    /// server, until its ticket is refused: the old server makes the tickets of consoles valid again.
    bool again = false;
    bool list = false;                ///< also reads the list of the server's sessions
    std::function<void()> news = {};  ///< called by any thread after a new picture
    /// Called once by the link's thread after its first join, if the link joins by itself. Text: why it failed.
    std::function<void(std::expected<void, std::string>)> joined = {};
  };
  /// @param joined  empty: the link joins by itself
  explicit ServerLink(Options options, std::optional<JoinedLink> joined = {});
  /// Ends a pending request of the link's own joins at once.
  ~ServerLink() override;
  ServerLink(const ServerLink&) = delete;
  ServerLink& operator=(const ServerLink&) = delete;

  [[nodiscard]] std::shared_ptr<const LivePicture> newest() const override;
  [[nodiscard]] std::uint64_t number() const noexcept override { return number_.load(std::memory_order_acquire); }
  [[nodiscard]] bool order(rpc::Body body, Reply reply) override;
  /// Whether datagrams arrive.
  [[nodiscard]] bool live() const noexcept { return live_.load(std::memory_order_acquire); }
  /// Asks for the status now instead of within its period; at most every 250 ms.
  void poke();
  /// Whether another link shows the session, so that this one asks for the status rarely.
  void set_relieved(bool relieved) noexcept { relieved_.store(relieved, std::memory_order_relaxed); }
  /// Members of `state` of the newest picture (state_json.h). For the web thread only.
  [[nodiscard]] const std::string& state_members(const LivePicture& picture);

 private:
  void work();
  void adopt(JoinedLink joined);
  /// @param answers  the server itself ended the connection's rights, or named another server
  void lose(const std::string& why, bool answers = false);
  [[nodiscard]] bool join();
  /// Joins as the options say, or comes back with the secret of the last Welcome.
  [[nodiscard]] std::expected<JoinedLink, client::JoinError> join_once();
  /// Options of a join: with the secret if the link comes back.
  [[nodiscard]] client::JoinOptions join_options() const;
  [[nodiscard]] bool joins_again() const;
  /// @param why  the server gave, which the picture then has in place of the cause of the loss; empty: none
  void stop_following(const std::string& why = {});
  [[nodiscard]] bool ask_status();
  void ask_sessions();
  void ask_scenes();
  /// Reads the notes that are newer than the ones known, as many as the server's rate limit permits.
  void ask_notes(std::uint32_t newest);
  void regain_feed();
  void execute(const rpc::Body& body, const Reply& reply);
  template <class Change>
  void update(Change change);

  Options options_;
  io::EventFd end_;
  mutable std::mutex lock_;
  std::condition_variable wake_;
  std::shared_ptr<const LivePicture> picture_ = std::make_shared<LivePicture>();
  std::deque<std::pair<rpc::Body, Reply>> orders_;
  bool over_ = false, poked_ = false;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<bool> live_{false}, relieved_{false};
  // Of the link's thread:
  client::Console console_;
  std::unique_ptr<FeedThread> feed_;
  std::optional<JoinedLink> first_;
  std::optional<std::chrono::steady_clock::time_point> follows_until_;  ///< after a loss, if it has a ticket
  bool comes_back_ = false;  ///< with the secret of the Welcome in `console_`, which no server has refused
  std::uint32_t notes_after_ = 0, notes_known_ = 0;  ///< last note read; newest note of the server when all were read
  bool notes_again_ = false;                         ///< all notes must be read again
  bool scenes_stale_ = true;
  // Of the web thread:
  std::uint64_t written_ = 0;
  std::string members_;
  std::thread thread_;
};

}  // namespace tandem::console

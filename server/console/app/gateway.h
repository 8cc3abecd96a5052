#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <expected>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/io/identity_selector.h"
#include "common/auth/limiter.h"
#include "server/console/app/browser_seats.h"
#include "server/console/app/live_scores.h"
#include "server/console/app/mailbox.h"
#include "server/console/app/recording_library.h"
#include "server/console/app/server_link.h"
#include "server/console/app/session_views.h"
#include "server/console/browser_sessions.h"
#include "server/console/join_body.h"
#include "server/console/one_time_token.h"

namespace tandem::console {

/// A person at one or more pages.
struct Person {
  std::string name;     ///< for display
  bool proved = false;  ///< the name is that of the ticket
  /// Control connection, whose rights the person has; the orders go there. Null if the gateway only plays recordings.
  std::shared_ptr<ServerLink> link;
  bool house = false;     ///< has the gateway's own connection
  bool audience = false;  ///< one of many who watch without a ticket
};

/// Connections that a gateway has from the begin.
struct GatewayLinks {
  std::optional<JoinedLink> own{};       ///< empty: each person signs in with a ticket
  std::optional<JoinedLink> audience{};  ///< of an observer, for all who watch without a ticket; empty: there are none
};

/// A sign-in that the gateway does not begin.
struct JoinRefusal {
  bool busy = false;  ///< too many sign in; otherwise the ticket cannot be read
  std::string why;    ///< cause and remedy
};

/// Persons with their control connections and their rights. For the web thread.
class Gateway {
 public:
  static constexpr std::size_t kJoinsMax = 8;    ///< joins at the same time
  static constexpr std::size_t kTokensMax = 16;  ///< tokens that wait for a browser

  struct Options {
    client::JoinOptions join;  ///< of the gateway's own connection; persons join with its server, state and timeout
    bool local = false;        ///< the gateway joins without a ticket, so it may see every session of the server
    std::string release;       ///< version of the program
    Duration away = std::chrono::seconds{60};  ///< a person whose pages are closed for longer signs in again
    std::size_t audience = 0;                  ///< pages of the audience at the same time
    std::string audience_ticket{};             ///< of its connection; empty: it joins without a ticket
    bool seats = false;                        ///< browsers may take seats
    std::string play{};                        ///< seat that a page takes at once; empty: none
    std::string recordings{};                  ///< folder of recordings that persons may see; empty: none
    /// Recordings that this gateway plays, without any server: the person of the printed URL sees them. Empty: none.
    std::vector<std::string> files{};
  };
  /// @param news  called by any thread after a new picture of any link
  Gateway(Options options, GatewayLinks links, std::shared_ptr<Mailbox> mailbox, std::function<void()> news);

  [[nodiscard]] const std::string& release() const noexcept { return options_.release; }
  [[nodiscard]] Mailbox& mailbox() noexcept { return *mailbox_; }
  [[nodiscard]] BrowserSessions<Person>& browsers() noexcept { return browsers_; }
  [[nodiscard]] BrowserSeats& seats() noexcept { return seats_; }
  [[nodiscard]] const std::string& play() const noexcept { return options_.play; }
  /// Name of the gateway's workstation at its server; empty: only the server knows it.
  [[nodiscard]] std::string workstation() const { return options_.local ? auth::kLocalWorkstation : ""; }

  /// Whether the gateway has a connection of its own, or plays files, so that it prints a token.
  [[nodiscard]] bool has_token() const noexcept { return house_ != nullptr; }

  /// Largest number of pages of the audience.
  [[nodiscard]] std::size_t audience_max() const noexcept { return options_.audience; }
  /// Secret of the cookie that each browser of the audience gets: it gives the rights of an observer. Empty: there is
  /// no audience.
  [[nodiscard]] const std::string& audience_secret() const noexcept { return audience_secret_; }

  /// Whether the audience sees nothing any more, because its ticket was valid once and its connection is lost.
  [[nodiscard]] bool audience_lost() const;

  /// Whether any connection reaches a server: the gateway's own ones, or those of persons.
  struct Reach {
    enum class Kind : std::uint8_t { kReached, kTriesAgain, kGone };
    Kind kind = Kind::kReached;  ///< also if there is no connection yet
    std::string why;             ///< why no connection does
  };
  [[nodiscard]] Reach reach() const;

  /// Redeems the token of the printed URL. @return secret of a new cookie; empty: refused
  [[nodiscard]] std::string redeem(std::string_view token, Time now);
  /// Makes a token that `redeem` accepts once. At most kTokensMax wait: the oldest ends when one more is made.
  /// @pre has_token()
  [[nodiscard]] std::string make_token(Time now);

  /// Called in the web thread with the secret of a new cookie, or cause and remedy.
  using Joined = std::function<void(std::expected<std::string, std::string>)>;
  /// Joins the server with the ticket of a person. @return error: refused at once, and `done` is not called
  [[nodiscard]] std::expected<void, JoinRefusal> join(const JoinBody& body, const auth::Source& from, Time now,
                                                      Joined done);

  /// Whether the gateway has recordings that it may show.
  [[nodiscard]] bool has_recordings() const noexcept { return library_ != nullptr; }
  /// Whether a person may see recordings and scores.
  [[nodiscard]] static bool may_review(const Person& person);
  /// Called in the web thread.
  using Recorded = std::function<void(RecordingReply)>;
  /// Reads from a recording. @return false: too many requests wait, and `done` is not called. @pre has_recordings()
  [[nodiscard]] bool ask_recording(RecordingRequest request, Recorded done);

  /// Call it after a new picture of any link.
  void on_news();
  /// Returns the newest message `scores` of a session; null: none yet. It is for persons who may review.
  [[nodiscard]] std::shared_ptr<const std::string> scores_of(const rpc::Id& session) const {
    return scores_ ? scores_->of(session) : nullptr;
  }

  /// Sessions that the person may see.
  [[nodiscard]] std::vector<rpc::ListedSession> sessions_of(const Person& person) const;
  /// Returns the link of another session for a person with the gateway's connection; null: unknown session.
  [[nodiscard]] std::shared_ptr<ServerLink> open(const Person& person, const std::string& session);
  /// Returns the link that shows the session of `link` best: `link` itself, or another one with datagrams.
  [[nodiscard]] std::shared_ptr<ServerLink> best_view(const std::shared_ptr<ServerLink>& link) const {
    return views_.best(link);
  }
  /// Ends pending joins and readings without a reply. @pre the mailbox is disconnected
  void abandon_requests();
  /// Ends cookies that are idle, and links that no person needs. Call it about every second.
  void on_second(Time now);

 private:
  [[nodiscard]] ServerLink::Options own_link(bool watch) const;
  [[nodiscard]] bool has_person(const rpc::Id& session) const;
  [[nodiscard]] std::string name_for(const std::string& wish, AccessRole role);
  [[nodiscard]] static Reach reach_of(std::span<const std::shared_ptr<const LivePicture>> pictures);
  void log_reach();
  void finish(std::uint64_t number, const std::expected<void, std::string>& result);

  Options options_;
  std::shared_ptr<Mailbox> mailbox_;
  std::function<void()> news_;
  std::shared_ptr<Person> house_, audience_;  ///< null: none
  std::string audience_secret_;
  bool audience_logged_ = false;  ///< its loss
  Reach::Kind logged_ = Reach::Kind::kReached;
  std::deque<OneTimeToken> tokens_;
  BrowserSessions<Person> browsers_;
  SessionViews views_;
  auth::SourceTable<TokenBucket> join_rates_;
  TokenBucket all_joins_;
  struct Pending {
    std::shared_ptr<Person> person;
    bool watch;
    Joined done;
  };
  std::map<std::uint64_t, Pending> pending_;  ///< joins, by number
  std::uint64_t joins_ = 0;
  BrowserSeats seats_;
  unsigned names_ = 0;
  std::map<std::uint64_t, Recorded> readings_;  ///< requests about recordings, by number
  std::uint64_t readings_asked_ = 0;
  std::unique_ptr<RecordingLibrary> library_;  ///< null: none
  std::unique_ptr<LiveScores> scores_;         ///< null: the gateway only plays recordings, or ends
};

}  // namespace tandem::console

// Replies to stops, pauses and resumes of consoles, and what is said about the storage of the session.
#include <memory>

#include "tests/server/app/control/commanding.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

/// The test decides what is stored, and what the time is.
struct Storing : Commanding {
  Storing() {
    lesson.registration.stored = stored;
    serve();
  }
  /// Begins a command. @return its number, for `replied`
  std::size_t begin(rpc::Body command) {
    replies.emplace_back();
    timed.execute(joined, office, std::move(command),
                  [this, n = replies.size() - 1](rpc::Body body) { replies[n] = std::move(body); });
    return replies.size() - 1;
  }
  rpc::Body finish(std::size_t n) {
    wait_until([&] { return replies[n].has_value(); });
    return *replies[n];
  }
  rpc::Status status() { return std::get<rpc::Status>(finish(begin(rpc::StatusRequest{id_of(1)}))); }
  /// Looks at the held replies several times.
  void look() { context.run_for(5 * HeldReplies::kLook); }

  std::shared_ptr<StoredOrders> stored = std::make_shared<StoredOrders>();
  std::vector<std::optional<rpc::Body>> replies;
  Time now = Time{} + 1h;
  SessionCommands timed{registry, keys, {}, [this] { return now; }};
};

TEST(ConfirmedOrders, ConfirmAStopOnlyWhenItIsStoredButStopAtOnce) {
  Storing s;
  const std::size_t stop = s.begin(rpc::StopSession{id_of(1), "fire drill"});
  EXPECT_EQ(s.status().phase, rpc::SessionPhase::kStopped) << "at once, and other orders are answered meanwhile";
  s.stored->set_stored(0);
  s.now += SessionCommands::kStoredWait - 1ms;
  s.look();
  EXPECT_FALSE(s.replies[stop]) << "the newest snapshot is of before the stop";
  s.stored->set_stored(1);
  EXPECT_EQ(s.finish(stop), rpc::Body(rpc::Ok{}));
  const std::size_t pause = s.begin(rpc::PauseSession{id_of(1), ""}), end = s.begin(rpc::ResumeSession{id_of(1), 2});
  static_cast<void>(s.status());
  s.look();
  EXPECT_FALSE(s.replies[pause] || s.replies[end]);
  s.stored->set_stored(3);
  EXPECT_EQ(s.finish(pause), rpc::Body(rpc::Ok{}));
  EXPECT_EQ(s.finish(end), rpc::Body(rpc::Ok{}));
}

TEST(ConfirmedOrders, SayThatAStopIsNotStoredWithTheCause) {
  Storing s;
  const std::size_t late = s.begin(rpc::StopSession{id_of(1), ""});
  static_cast<void>(s.status());
  s.now += SessionCommands::kStoredWait;
  const std::string text = std::get<rpc::Ok>(s.finish(late)).not_stored;
  EXPECT_EQ(text.find("the session is STOPPED, but this is not stored yet: it is not written in time; check the disk"),
            0u)
      << text;
  EXPECT_NE(text.find("its hands may engage again"), std::string::npos) << text;
  EXPECT_EQ(s.status().not_stored, "");
  EXPECT_TRUE(s.notices().empty());

  const std::size_t full = s.begin(rpc::ResumeSession{id_of(1), 1});
  static_cast<void>(s.status());  // it was carried out
  s.stored->set_failed(2, "the disk is full; free some space there");
  EXPECT_EQ(
      std::get<rpc::Ok>(s.finish(full)).not_stored,
      "the session is RESUMED, but this is not stored yet: the disk is full; free some space there. If the server "
      "is killed before that, it restores the session as it was before, stopped");
  EXPECT_EQ(s.status().not_stored, "the disk is full; free some space there");
  EXPECT_EQ(s.status().not_stored, "the disk is full; free some space there");
  ASSERT_EQ(s.notices().size(), 2u) << "the end of the stop; the failure, once";
  EXPECT_EQ(s.notices()[1].find("the state of the session is NOT STORED: the disk is full;"), 0u) << s.notices()[1];
  s.stored->set_stored(2);
  EXPECT_EQ(s.status().not_stored, "");
  ASSERT_EQ(s.notices().size(), 3u);
  EXPECT_EQ(s.notices()[2].find("the state of the session is stored again"), 0u) << s.notices()[2];
}

/// The console sends its next order, perhaps a stop, after the reply.
TEST(ConfirmedOrders, ConfirmAResumeSoonerThanAStop) {
  Storing s;
  s.stored->set_stored(1);
  EXPECT_EQ(s.finish(s.begin(rpc::StopSession{id_of(1), ""})), rpc::Body(rpc::Ok{}));
  const std::size_t end = s.begin(rpc::ResumeSession{id_of(1), 1});
  static_cast<void>(s.status());
  s.now += SessionCommands::kResumeStoredWait;
  EXPECT_NE(std::get<rpc::Ok>(s.finish(end)).not_stored, "");
}

TEST(ConfirmedOrders, HoldNoReplyToAnOrderThatWasNotCarriedOut) {
  Storing s;
  EXPECT_EQ(error_of(s.finish(s.begin(rpc::ResumeSession{id_of(1), 5}))).code, ErrorCode::kOutdated);
  s.joined.role = AccessRole::kObserver;
  EXPECT_EQ(error_of(s.finish(s.begin(rpc::StopSession{id_of(1), ""}))).code, ErrorCode::kNotAllowed);
}

}  // namespace
}  // namespace tandem::server

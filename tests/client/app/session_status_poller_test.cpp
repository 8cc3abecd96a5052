// Status polls of a seat, and the end of a connection that a newer one replaces.
#include "client/app/session_status_poller.h"

#include <gtest/gtest.h>

#include <future>

#include "tests/common/auth/io/control_server_fixture.h"

namespace tandem::client {
namespace {

using server::test::ControlServerFixture;

/// Returns a joined control connection; null if the join failed.
std::shared_ptr<auth::ControlClient> joined(const ControlServerFixture& door, const auth::Identity& me) {
  auto client = door.connect(me);
  if (!client) return nullptr;
  const auto welcome = client->ask(server::test::hello_with(door.ticket(me)), server::test::kTimeout);
  if (!welcome || !std::holds_alternative<rpc::Welcome>(*welcome)) return nullptr;
  return std::make_shared<auth::ControlClient>(std::move(*client));
}

/// Waits until the server has received a request that it does not answer. @return false after a timeout
bool asked(ControlServerFixture& door) {
  std::unique_lock lock(door.sessions->mutex);
  return door.sessions->changed.wait_for(lock, server::test::kTimeout,
                                         [&] { return !door.sessions->unanswered.empty(); });
}

TEST(SessionStatusPoller, DoesNotWaitForAReplyAfterCancel) {
  ControlServerFixture door(ControlServerFixture::patient());
  const auto me = door.enrolled("me");
  door.sessions->mute = true;
  const auto connection = joined(door, me);
  ASSERT_NE(connection, nullptr);
  auto words = std::make_unique<SessionStatusPoller>(connection, door.sessions->session_id, std::chrono::hours(1));
  ASSERT_TRUE(asked(door));
  words->cancel();
  const auto gone = std::async(std::launch::async, [&] { words.reset(); });
  EXPECT_EQ(gone.wait_for(server::test::kTimeout), std::future_status::ready)
      << "a caller that waits for it receives no key meanwhile";
  const std::lock_guard lock(door.sessions->mutex);
  for (const auto& answer : door.sessions->unanswered) answer(rpc::Ok{});  // so that a failing test still ends
}

TEST(SessionStatusPoller, LeavesTheConnectionUsableWhenItEnds) {
  ControlServerFixture door(ControlServerFixture::patient());
  const auto me = door.enrolled("me");
  const auto connection = joined(door, me);
  ASSERT_NE(connection, nullptr);
  std::make_unique<SessionStatusPoller>(connection, door.sessions->session_id).reset();
  EXPECT_TRUE(connection->ask(rpc::Ping{1}, server::test::kTimeout));
}

}  // namespace
}  // namespace tandem::client

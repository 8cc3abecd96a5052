// The questions of a seat to its server, and the end of a connection that a newer one took the place of.
#include "client/app/session_words.h"

#include <gtest/gtest.h>

#include <future>

#include "tests/trust/io/door.h"

namespace tandem::client {
namespace {

using server::test::Door;

/// A connection that has joined; null if it could not.
std::shared_ptr<trust::ControlClient> joined(const Door& door, const trust::Identity& me) {
  auto client = door.connect(me);
  if (!client) return nullptr;
  const auto welcome = client->ask(server::test::hello_with(door.ticket(me)), server::test::kPatience);
  if (!welcome || !std::holds_alternative<control::Welcome>(*welcome)) return nullptr;
  return std::make_shared<trust::ControlClient>(std::move(*client));
}

/// Until a question was asked that gets no answer.
bool asked(Door& door) {
  std::unique_lock lock(door.sessions->mutex);
  return door.sessions->changed.wait_for(lock, server::test::kPatience, [&] { return !door.sessions->unanswered.empty(); });
}

TEST(SessionWords, OfAConnectionThatIsGivenUpWaitForNoAnswer) {
  Door door(Door::patient());
  const auto me = door.enrolled("me");
  door.sessions->mute = true;
  const auto connection = joined(door, me);
  ASSERT_NE(connection, nullptr);
  auto words = std::make_unique<SessionWords>(connection, door.sessions->session_id, std::chrono::hours(1));
  ASSERT_TRUE(asked(door));
  words->give_up();
  const auto gone = std::async(std::launch::async, [&] { words.reset(); });
  EXPECT_EQ(gone.wait_for(server::test::kPatience), std::future_status::ready) << "whoever waits for it hears no key meanwhile";
  const std::lock_guard lock(door.sessions->mutex);
  for (const auto& answer : door.sessions->unanswered) answer(control::Done{});  // so that a failing test ends
}

TEST(SessionWords, ThatEndAsPeopleLeaveLeaveTheConnectionForAnotherQuestion) {
  Door door(Door::patient());
  const auto me = door.enrolled("me");
  const auto connection = joined(door, me);
  ASSERT_NE(connection, nullptr);
  std::make_unique<SessionWords>(connection, door.sessions->session_id).reset();
  EXPECT_TRUE(connection->ask(control::Ping{1}, server::test::kPatience));
}

}  // namespace
}  // namespace tandem::client

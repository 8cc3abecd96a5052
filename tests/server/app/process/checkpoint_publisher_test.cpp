// When the checkpoints of a session are published.
#include "server/app/process/checkpoint_publisher.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

/// A session, and a publisher that it has not begun to use.
struct Publishing {
  /// @param runs  the session has begun
  explicit Publishing(bool runs = true) {
    if (runs) fixture.run(1s);
    publisher.attach(mailbox, 7, 1000);
  }
  /// Steps the publisher. @return number of checkpoints that the store found
  int steps(int ticks) {
    int found = 0;
    for (int i = 0; i < ticks; ++i) {
      publisher.step(*fixture.session);
      found += mailbox->take(last) ? 1 : 0;
    }
    return found;
  }
  SessionFixture fixture{"free_motion"};
  io::EventFd wake;
  std::shared_ptr<CheckpointMailbox> mailbox = std::make_shared<CheckpointMailbox>(wake);
  CheckpointPublisher publisher;
  Checkpoint last;
};

TEST(CheckpointPublisher, PublishesTwicePerSecondAndFirstAtOnce) {
  Publishing p;
  EXPECT_EQ(p.steps(1), 1) << "the first";
  EXPECT_EQ(p.last.epoch, 7U) << "the epoch that the clients know";
  EXPECT_EQ(p.last.session_tick, p.fixture.session->clock().session_tick());
  EXPECT_EQ(p.steps(499), 0);
  EXPECT_EQ(p.steps(1), 1);
  EXPECT_EQ(p.steps(1000), 2);
}

TEST(CheckpointPublisher, PublishesAtOnceWhenTheSessionBegins) {
  Publishing p{false};
  EXPECT_EQ(p.steps(2), 1) << "the first";
  p.fixture.run(1s);
  EXPECT_EQ(p.steps(2), 1);
  EXPECT_TRUE(p.last.begun);
}

TEST(CheckpointPublisher, PublishesAtOnceAfterAnEventThatARestartRestores) {
  Publishing p;
  static_cast<void>(p.steps(2));
  p.publisher.note(AuditEvent::What::kStop);
  EXPECT_EQ(p.steps(1), 1);
  p.publisher.note(AuditEvent::What::kQuarantined);
  EXPECT_EQ(p.steps(1), 0) << "no part of a checkpoint";
}

TEST(CheckpointPublisher, PublishesTheLastCheckpointWhenTheSessionEnds) {
  Publishing p;
  static_cast<void>(p.steps(2));
  p.publisher.finish(*p.fixture.session);
  EXPECT_TRUE(p.mailbox->take(p.last));
}

TEST(CheckpointPublisher, DoesNothingWithoutAMailbox) {
  SessionFixture fixture("free_motion");
  CheckpointPublisher publisher, finished;
  publisher.note(AuditEvent::What::kStop);
  publisher.step(*fixture.session);
  finished.finish(*fixture.session);

  const io::EventFd wake;
  for (CheckpointPublisher* const late : {&publisher, &finished}) {
    const auto mailbox = std::make_shared<CheckpointMailbox>(wake);
    Checkpoint found;
    late->attach(mailbox, 7, 1000);
    EXPECT_FALSE(mailbox->take(found)) << "nothing was stored for a later mailbox";
    late->step(*fixture.session);
    EXPECT_TRUE(mailbox->take(found)) << "the checkpoint stayed due, because none was published";
    EXPECT_EQ(found.epoch, 7U);
  }
}

}  // namespace
}  // namespace tandem::server

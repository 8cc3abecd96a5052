// Which orders the files of checkpoints have, on a disk that fails.
#include "server/app/process/checkpoint_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/file_faults.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using test::FileFault;

class CheckpointStoreTest : public testing::Test {
 protected:
  CheckpointStoreTest() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-store-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    auto opened = CheckpointStore::open(
        folder_, "", [this](const std::string& text) { note("FAILS " + text); },
        [this](const std::string& text) { note(text); });
    EXPECT_TRUE(opened) << opened.error();
    store_ = std::move(*opened);
    SessionSnapshot kept;
    kept.name = "lab";
    mailbox_ = store_->add(std::move(kept));
  }
  ~CheckpointStoreTest() override {
    test::no_faults();
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  /// Publishes a checkpoint with this number of orders and stops.
  void publish(std::uint32_t orders, std::uint32_t stops) { publish(*mailbox_, orders, stops); }
  static void publish(CheckpointMailbox& mailbox, std::uint32_t orders, std::uint32_t stops) {
    Checkpoint checkpoint;
    checkpoint.tools_n = checkpoint.masters_n = checkpoint.dof = checkpoint.seats_n = 1;
    checkpoint.tools[0].alpha[0] = 1;
    checkpoint.orders = orders;
    checkpoint.stops = stops;
    checkpoint.stop = StopLatch::Level::kStopped;
    while (!mailbox.publish(checkpoint)) std::this_thread::yield();
  }
  /// Waits until the condition holds, at most 30 s.
  template <class Condition>
  static bool wait_until(Condition condition) {
    for (int n = 0; n < 30000 && !condition(); ++n) std::this_thread::sleep_for(1ms);
    return condition();
  }
  void note(const std::string& text) {
    const std::lock_guard lock(lock_);
    reports_.push_back(text);
  }
  /// Reports of the store so far.
  [[nodiscard]] std::vector<std::string> reports() {
    const std::lock_guard lock(lock_);
    return reports_;
  }
  /// Number of the newest stop in the file.
  [[nodiscard]] std::uint32_t stops_in_file() const {
    const auto bytes = auth::StateDirectory::open(folder_, auth::StateDirectory::Missing::kIsAnError)
                           .value()
                           .read("lab.checkpoint")
                           .value();
    return bytes ? decode_snapshot(std::as_const(*bytes).bytes()).value().checkpoint.stops : 0;
  }
  std::mutex lock_;
  std::vector<std::string> reports_;
  std::string folder_;
  std::unique_ptr<CheckpointStore> store_;
  std::shared_ptr<CheckpointMailbox> mailbox_;
};

TEST_F(CheckpointStoreTest, SaysThatAnOrderIsStoredWhenItsFileHasIt) {
  store_->start();
  EXPECT_FALSE(mailbox_->stored().has(1));
  publish(1, 1);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(1); }));
  EXPECT_EQ(stops_in_file(), 1u);
  EXPECT_FALSE(mailbox_->stored().has(2));
  publish(2, 1);
  EXPECT_TRUE(wait_until([&] { return mailbox_->stored().has(2); })) << "an order that changes nothing is in the file";
}

TEST_F(CheckpointStoreTest, SaysWhyAnOrderIsNotStoredUntilAWriteSucceeds) {
  store_->start();
  publish(1, 1);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(1); }));
  test::inject(folder_, {.kind = FileFault::Kind::kNoSpace, .lasting = true});
  publish(2, 2);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().failed(2); }));
  EXPECT_FALSE(mailbox_->stored().has(2));
  const std::string why = mailbox_->stored().problem();
  EXPECT_EQ(why.find("the checkpoint file cannot be "), 0u) << why;
  EXPECT_NE(why.find("No space left on device"), std::string::npos) << why;
  EXPECT_EQ(why.find(folder_), std::string::npos) << "participants get no paths";
  test::no_faults();
  EXPECT_EQ(stops_in_file(), 1u);
  publish(2, 2);  // as the session does twice a second
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(2); }));
  EXPECT_EQ(stops_in_file(), 2u);
  EXPECT_EQ(mailbox_->stored().problem(), "");
  EXPECT_FALSE(mailbox_->stored().failed(2));
}

/// An operator who reads the log has to know that a restart continues the session again.
TEST_F(CheckpointStoreTest, ReportsThatWritesFailAndThatTheySucceedAgainOnceEach) {
  store_->start();
  std::uint32_t orders = 0;
  const auto write = [&](bool fails) {
    fails ? test::inject(folder_, {.kind = FileFault::Kind::kNoSpace, .lasting = true}) : test::no_faults();
    ++orders;
    publish(orders, orders);
    EXPECT_TRUE(wait_until([&] { return fails ? mailbox_->stored().failed(orders) : mailbox_->stored().has(orders); }));
  };
  write(false);
  EXPECT_TRUE(reports().empty());
  for (int n = 0; n < 4; ++n) {  // the disk has room for each second checkpoint
    write(true);
    write(false);
  }
  ASSERT_EQ(reports().size(), 1u) << reports().back();
  EXPECT_EQ(reports()[0].find("FAILS session lab: "), 0u) << reports()[0];
  EXPECT_TRUE(wait_until([&] {
    publish(orders, orders);  // as the session does twice a second; nothing changes
    return reports().size() > 1;
  }));
  EXPECT_EQ(reports().back(), "session lab: its checkpoints are written again; a restart continues it");
  write(false);
  EXPECT_EQ(reports().size(), 2u);
  write(true);
  EXPECT_TRUE(wait_until([&] { return reports().size() == 3; }));
  EXPECT_EQ(reports().back().find("FAILS session lab: "), 0u);
}

/// The rename succeeds and the sync of the folder fails: the file may be either one, so the next one is written.
TEST_F(CheckpointStoreTest, WritesAgainAfterAFailureAlsoWhatItHadWritten) {
  store_->start();
  publish(1, 1);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(1); }));
  test::inject(folder_, {});
  publish(2, 2);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(2); }));
  const std::size_t sync = test::file_calls() - 1;
  ASSERT_NE(test::file_call(sync).find("fsync"), std::string::npos) << test::file_call(sync);
  test::inject(folder_, {.kind = FileFault::Kind::kInputOutput, .at = sync});
  publish(3, 3);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().failed(3); }));
  EXPECT_EQ(stops_in_file(), 3u);
  publish(4, 2);
  ASSERT_TRUE(wait_until([&] { return mailbox_->stored().has(4); }));
  EXPECT_EQ(stops_in_file(), 2u);
}

TEST_F(CheckpointStoreTest, WritesAnOrderBeforeTheCheckpointsOfOtherSessions) {
  publish(0, 0);
  std::vector<std::shared_ptr<CheckpointMailbox>> others;
  for (int n = 0; n < 20; ++n) {
    SessionSnapshot kept;
    kept.name = "other" + std::to_string(n);
    others.push_back(store_->add(std::move(kept)));
    publish(*others.back(), n == 19 ? 1 : 0, 0);
  }
  test::inject(folder_, {});
  store_->start();
  ASSERT_TRUE(wait_until([&] { return others.back()->stored().has(1); }));
  store_->stop();
  EXPECT_NE(test::file_call(0).find("other19"), std::string::npos) << test::file_call(0);
}

}  // namespace
}  // namespace tandem::server

// A recording of a server that sheds load names the reason of its gaps.
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "server/app/recording/live_recording.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/sim/hosted_hands.h"

namespace tandem::test {
namespace {

TEST(LiveRecording, SaysThatRowsAreLeftOutBecauseLoadIsShed) {
  const auth::test::Folder folder;
  server::TickQueue records{64};
  HostedHands life(records);
  const auto desk = std::make_shared<server::RecordingDesk>(life.scene.seats.size(), false);
  const auto recording =
      server::LiveRecording::start(folder.path("a.mcap"), life.hosted, {}, {}, false, desk, nullptr).value();
  life.hosted.set_recording(true);
  server::MachineStatus machine;
  machine.load_state.level = server::ShedLevel::kTelemetry;
  const auto trouble = [&](bool wanted) {
    for (int n = 0; n < 1000 && desk->status()->trouble.empty() == wanted; ++n) {
      life.step(machine);
      while (records.front() != nullptr) records.pop();
      std::this_thread::sleep_for(10ms);
    }
    return desk->status()->trouble;
  };
  EXPECT_NE(trouble(true).find("one row in ten (load shedding)"), std::string::npos);
  machine.load_state.level = server::ShedLevel::kNone;
  EXPECT_EQ(trouble(false), "");
}

}  // namespace
}  // namespace tandem::test

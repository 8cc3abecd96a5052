// Moves of a session between servers of a service while hands press, and upgrades of its servers one after the other.
#include <algorithm>

#include "tests/common/base/counts.h"
#include "tests/io/pressing_service.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

class ServiceMoves : public PressingServiceTest {};

TEST_F(ServiceMoves, ReleaseHandsForAMomentAndTakeThemAlong) {
  const std::size_t moves = draws(5, 20, 100);
  PressingService pressed;
  pressed.start({"a", "b"});
  pressed.join(pressed.service().address("a"));
  const std::string config = pressed.service().folder().file("a.textproto");
  for (std::size_t n = 0; n < moves; ++n) {
    const std::string to = n % 2 == 0 ? "b" : "a";
    EXPECT_EQ(LiveService::run({"move", "lab", "--to", to, "--config", config}),
              "session lab is at server " + to + " now\n");
    pressed.wait_until_active(to);
    std::this_thread::sleep_for(milliseconds(1500));
  }
  const std::vector<Absence> all = pressed.expect_safe(moves);
  ASSERT_GE(all.size(), 2 * moves);
  print("move: release until the force begins [s], asked <= 1", values(all, &Absence::free_s));
  print("move: release to wholly active [s]", values(all, &Absence::back_s));
  print("move: force in the first tick [N], asked <= 0.05", values(all, &Absence::first_n));
}

/// An upgrade replaces the programs: each server is ended by SIGTERM, and started again.
TEST_F(ServiceMoves, UpgradeOfOneServerAfterTheOtherKeepsAllHandsInTheirSession) {
  const std::size_t rounds = draws(1, 3, 10);
  const std::vector<std::string> names{"a", "b", "c"};
  PressingService pressed(3);
  pressed.start(names);
  pressed.join(pressed.service().address("a"));
  std::size_t ended_owners = 0;
  for (std::size_t n = 0; n < rounds; ++n)
    for (const std::string& name : names) {
      Process& ended = pressed.service().of(name);
      ended_owners += pressed.witness().owner() == name ? 1 : 0;
      ended.signal(SIGTERM);
      ASSERT_EQ(ended.wait(), 0) << ended.err();
      Process& again = pressed.service().start(name);
      ASSERT_TRUE(again.wait_for("is a member of the service")) << again.err();
      pressed.wait_until_active();
      std::this_thread::sleep_for(milliseconds(2500));  // until a standby is named
    }
  EXPECT_GE(ended_owners, rounds) << "no owner was ended";
  const std::vector<Absence> all = pressed.expect_safe(ended_owners);
  ASSERT_GE(all.size(), 2 * ended_owners);
  print("upgrade: release until the force begins [s]", values(all, &Absence::free_s));
  print("upgrade: release to wholly active [s], asked <= 7", values(all, &Absence::back_s));
}

}  // namespace
}  // namespace tandem::test

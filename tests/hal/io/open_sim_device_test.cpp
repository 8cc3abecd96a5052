#include "hal/io/open_sim_device.h"

#include <gtest/gtest.h>

namespace tandem::hal {
namespace {

Result<OpenedSim> opened(std::string_view text) {
  HandSpec leader;
  leader.model = HandModel::kLeader;
  leader.k = 1000, leader.b = 10, leader.m = 0.1;
  return open_sim_device(text, SimDeviceSpec{}, leader);
}

TEST(OpenSimDevice, UsesTheSeatsOwnHandForSim) {
  const auto d = opened("sim");
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->id.backend, "sim");
  EXPECT_EQ(d->device->hand().model(), HandModel::kLeader);
}

TEST(OpenSimDevice, GivesAnotherHandItsOwnImpedance) {
  auto d = opened("sim:hand=relaxed");
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->device->hand().model(), HandModel::kRelaxed);
  d->device->set_session_time(0.0);
  for (int i = 0; i < 1000; ++i) d->device->advance({}, std::chrono::milliseconds(1));
  EXPECT_LT(d->device->ground_truth().f_hand.norm(), 0.01) << "nothing of the leader's 1000 N/m is left";
  EXPECT_NE(d->note.find("relaxed"), std::string::npos);
  EXPECT_EQ(opened("sim:keyboard")->device->hand().model(), HandModel::kKeyboard);
  EXPECT_EQ(opened("sim:model=linear,hand=none")->device->caps().joints, 1u);
}

TEST(OpenSimDevice, DoesNotApplySceneRelaxationToAKeyboard) {
  HandSpec scripted;
  scripted.model = HandModel::kLeader;
  scripted.until = 1;
  scripted.deviations.push_back({3, 2, {5, 0, 0}});
  auto d = open_sim_device("sim:keyboard", SimDeviceSpec{}, scripted);
  ASSERT_TRUE(d.has_value());
  const auto play = [&](int from_ms, int to_ms) {
    for (int i = from_ms; i < to_ms; ++i) {
      d->device->set_session_time(i * 1e-3);
      d->device->advance({}, std::chrono::milliseconds(1));
    }
  };
  play(0, 2900);
  const Vec3 before = d->device->ground_truth().x;
  play(2900, 4500);
  EXPECT_LT((d->device->ground_truth().x - before).norm(), 0.002) << "the scene pushes its own hand, not a person's";
  d->device->hand().keyboard()->set(before + Vec3(0.03, 0, 0));
  play(4500, 6500);
  EXPECT_GT(d->device->ground_truth().x[0] - before[0], 0.025) << "3.5 s after the scene relaxed its hand";
}

TEST(OpenSimDevice, ReportsMistakesWithSuggestions) {
  const struct {
    const char* text;
    const char* part;
  } cases[] = {
      {"falcon", "known here: sim"},
      {"simm", "did you mean sim?"},
      {"sim:hnad=relaxed", "did you mean hand?"},
      {"sim:hand=relxed", "did you mean relaxed?"},
      {"sim:hand=relxed", "known here: none, leader"},
      {"sim:hand", "needs a value"},
      {"sim:", "missing"},
      {"sim:keyboard=1", "no value"},
      {"sim:rec=1", "motion=FILE.csv or motion=FILE.mcap must come before"},
      {"sim:seat=trainer", "motion=FILE.csv or motion=FILE.mcap must come before"},
      {"sim:motion=a.mcap", "motion=a.mcap: this program reads no recordings"},
      {"sim:motion=a.mcap,rec=1", "rec=1: a recording (a.mcap) takes seat=NAME only"},
      {"sim:motion=a.csv,seat=trainer", "a.csv is read as a table"},
      {"sim:motion=/nowhere.csv", "/nowhere.csv: cannot be read: No such file"},
      {"sim:motion=/tmp", "is a directory"},
      {"sim:motion=a.csv,hand=leader", "exclude"},
      {"sim:hand=leader,hand=relaxed", "twice"},
      {"sim:motion=a.csv,axes=abc", "axes=abc"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    const auto d = opened(c.text);
    ASSERT_FALSE(d.has_value());
    EXPECT_NE(d.error().message.find(c.part), std::string::npos) << d.error().message;
  }
}

TEST(OpenSimDevice, NamesEveryErrorCode) {
  for (int c = 0; c <= static_cast<int>(Errc::kInternal); ++c)
    EXPECT_STRNE(to_string(static_cast<Errc>(c)), "unknown error");
}

}  // namespace
}  // namespace tandem::hal

#include "client/diagnostics/device_diagnostics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using Finding = DeviceDiagnostics::Finding;
using Kind = Finding::Kind;

hal::DeviceCaps three_joints(hal::Homing homing = hal::Homing::kNone) {
  hal::DeviceCaps caps;
  caps.joints = caps.tip_axes = 3;
  caps.homing = homing;
  return caps;
}

const Finding* find(const std::vector<Finding>& all, std::string_view words) {
  const auto found =
      std::ranges::find_if(all, [&](const Finding& f) { return f.text.find(words) != std::string::npos; });
  return found == all.end() ? nullptr : &*found;
}

Kind kind_of(const std::vector<Finding>& all, std::string_view words) {
  const Finding* found = find(all, words);
  EXPECT_NE(found, nullptr) << words;
  return found != nullptr ? found->kind : Kind::kTrouble;
}

/// Returns diagnostics after one second in which a user moves `joints` of the device.
DeviceDiagnostics after_a_second(const hal::DeviceCaps& caps, const std::array<bool, 3>& joints, bool homed = true) {
  DeviceDiagnostics examination{caps};
  for (int i = 0; i < 1000; ++i) {
    hal::State state;
    state.homed = homed;
    const double s = std::sin(0.02 * i);
    for (std::size_t j = 0; j < 3; ++j) {
      if (!joints[j]) continue;
      state.raw[j] = static_cast<std::int32_t>(1000 * s);
      state.x[static_cast<Eigen::Index>(j)] = 0.05 * s;
    }
    examination.update(state);
  }
  return examination;
}

TEST(DeviceDiagnostics, FindsNoProblemInAHealthyDevice) {
  const auto found = after_a_second(three_joints(), {true, true, true}).findings({}, 1.0);
  EXPECT_TRUE(std::ranges::none_of(found, [](const Finding& f) { return f.kind == Kind::kTrouble; }));
  EXPECT_EQ(kind_of(found, "1000 readings a second"), Kind::kGood);
  EXPECT_EQ(kind_of(found, "the tip went 100 x 100 x 100 mm"), Kind::kGood);
}

TEST(DeviceDiagnostics, ReportsTheWatchdogOfTheDevice) {
  hal::DeviceCaps caps = three_joints();
  const auto without_motors = after_a_second(caps, {true, true, true}).findings({}, 1.0);
  EXPECT_EQ(find(without_motors, "watchdog process"), nullptr);
  for (hal::AxisLimit& axis : caps.axis) axis.peak = 8;
  const auto unknown = after_a_second(caps, {true, true, true}).findings({}, 1.0);
  EXPECT_EQ(kind_of(unknown, "nothing is known of a watchdog in the device"), Kind::kNotice);
  caps.watchdog = 500ms;
  const auto known = after_a_second(caps, {true, true, true}).findings({}, 1.0);
  EXPECT_EQ(kind_of(known, "the device itself releases the force after 500 ms"), Kind::kNotice);
}

TEST(DeviceDiagnostics, ReportsADeviceThatNeverAnswersAsVisibleButSilent) {
  DeviceDiagnostics examination{three_joints()};
  hal::State stale;
  stale.stale = true;
  for (int i = 0; i < 100; ++i) examination.update(stale);
  const auto found = examination.findings({}, 1.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(kind_of(found, "visible but silent"), Kind::kTrouble);
}

TEST(DeviceDiagnostics, NamesTheFrozenEncoder) {
  const auto found = after_a_second(three_joints(), {true, false, true}).findings({}, 1.0);
  EXPECT_EQ(kind_of(found, "encoder of joint 2 did not move"), Kind::kTrouble);
}

TEST(DeviceDiagnostics, ReportsThePoseOfAnUncalibratedDevice) {
  const auto unhomed = after_a_second(three_joints(hal::Homing::kManual), {}, false).findings({}, 1.0);
  EXPECT_EQ(kind_of(unhomed, "pose of an uncalibrated device"), Kind::kTrouble);
  EXPECT_EQ(kind_of(unhomed, "not homed: it gives no force until it is homed"), Kind::kNotice);
  const auto homed = after_a_second(three_joints(hal::Homing::kManual), {}, true).findings({}, 1.0);
  EXPECT_EQ(kind_of(homed, "no encoder moved"), Kind::kTrouble);
}

TEST(DeviceDiagnostics, FindsLateAndTornRepliesAndALostOrigin) {
  DeviceDiagnostics examination = after_a_second(three_joints(hal::Homing::kManual), {true, true, true});
  hal::State lost;
  lost.homed = false;
  examination.update(lost);
  hal::DeviceStats stats;
  stats.ticks = 1000;
  stats.unanswered = 50;
  const auto found = examination.findings(stats, 2.0);
  EXPECT_EQ(kind_of(found, "only 500 readings"), Kind::kTrouble);
  EXPECT_EQ(kind_of(found, "50 exchanges without"), Kind::kTrouble);
  EXPECT_EQ(kind_of(found, "the origin was lost 1 times"), Kind::kTrouble);
}

/// Runs a force test on a free mass of 0.2 kg whose motors deliver `motors * wanted`.
std::vector<Finding> pushed(const Eigen::Matrix3d& motors, double scale = 1) {
  ForceTest test{three_joints(), Time{1s}};
  hal::State state;
  hal::Vec3 v = hal::Vec3::Zero();
  Time now{1s};
  for (; !test.finished(now); now += 1ms) {
    const hal::Vec3 wanted = test.step(now, state);
    state.f_out = scale * wanted;
    v += (motors * wanted - 2.0 * v) / 0.2 * 1e-3;
    state.x += v * 1e-3;
  }
  EXPECT_EQ(test.step(now, state).norm(), 0.0);
  EXPECT_EQ(now - Time{1s}, 6 * (ForceTest::kPush + ForceTest::kRest));
  return test.findings();
}

TEST(ForceTest, PushesEachAxisBothWaysAndFindsHealthyMotorsGood) {
  const auto found = pushed(Eigen::Matrix3d::Identity());
  ASSERT_EQ(found.size(), 6U);
  for (const Finding& f : found) EXPECT_EQ(f.kind, Kind::kGood) << f.text;
}

TEST(ForceTest, FindsAMotorThatPushesTheWrongWay) {
  const auto found = pushed(Eigen::Vector3d{1, -1, 1}.asDiagonal());
  EXPECT_EQ(kind_of(found, "force along +y"), Kind::kTrouble);
  EXPECT_NE(find(found, "WRONG WAY"), nullptr);
  EXPECT_EQ(kind_of(found, "force along +x"), Kind::kGood);
}

TEST(ForceTest, FindsSwappedAndDeadMotors) {
  Eigen::Matrix3d swapped;
  swapped << 0, 1, 0, 1, 0, 0, 0, 0, 0;
  const auto found = pushed(swapped);
  EXPECT_EQ(kind_of(found, "force along +x"), Kind::kNotice);
  EXPECT_EQ(kind_of(found, "force along +z"), Kind::kNotice);
  EXPECT_EQ(kind_of(pushed(Eigen::Matrix3d::Zero(), 0), "hardly any force left"), Kind::kTrouble);
}

TEST(DeviceDiagnostics, ObservesWithoutHeap) {
  const test::AllocGuard guard;
  static_cast<void>(after_a_second(three_joints(), {true, true, true}));
  EXPECT_EQ(guard.count(), 0U);
}

TEST(DeviceDiagnostics, ReportsTheBatteryOfASpaceMouseAlsoAtRest) {
  hal::DeviceCaps caps = three_joints();
  caps.input = hal::InputKind::kRate;
  for (const auto& [percent, kind] : {std::pair{std::uint8_t{83}, Kind::kGood}, {std::uint8_t{7}, Kind::kNotice}}) {
    DeviceDiagnostics examination{caps};
    hal::State state;
    examination.update(state);
    state.stale = true;  // a SpaceMouse at rest sends nothing
    state.battery_percent = percent;
    examination.update(state);
    EXPECT_EQ(kind_of(examination.findings({}, 1.0), "battery " + std::to_string(percent) + " %"), kind);
  }
  DeviceDiagnostics unknown{caps};
  unknown.update({});
  EXPECT_EQ(find(unknown.findings({}, 1.0), "battery"), nullptr) << "an unknown charge is never reported as a number";
}

TEST(DeviceDiagnostics, ReportsCalibrationFirmwareAndMotors) {
  hal::DeviceCaps caps = three_joints();
  EXPECT_EQ(kind_of(after_a_second(caps, {true, true, true}).findings({}, 1.0), "it gives no force"), Kind::kGood);
  for (hal::AxisLimit& axis : caps.axis)
    axis = {.peak = 4.0, .continuous = {}, .resolution = {}, .from = hal::Provenance::kConfig};
  caps.needs_firmware = true;
  const auto calibrated = after_a_second(caps, {true, true, true}).findings({}, 1.0);
  EXPECT_EQ(kind_of(calibrated, "limits from its calibration file"), Kind::kGood);
  EXPECT_EQ(kind_of(calibrated, "its firmware runs"), Kind::kGood);
  caps.force_calibrated = false;
  EXPECT_EQ(kind_of(after_a_second(caps, {true, true, true}).findings({}, 1.0), "never measured"), Kind::kNotice);
}

}  // namespace
}  // namespace tandem::client

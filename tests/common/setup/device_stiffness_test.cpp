#include "common/setup/device_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/stiffness_limit.h"

namespace tandem::setup {
namespace {

SeatSetup asking_for(double k, LawKind law = LawKind::kReplica, double tick_hz = 1000) {
  SeatSetup s;
  s.channel.law = law;
  s.tick_hz = tick_hz;
  s.coupling.k_c = s.k_s = s.stiffness_asked = k;
  return s;
}
rpc::DeviceFacts device(double damping, double latency, double peak = 3.3) {
  rpc::DeviceFacts f;
  f.force_peak_n = peak;
  f.damping_n_s_m = damping;
  f.latency_s = latency;
  return f;
}
double k_c(const SeatSetup& asked, const rpc::DeviceFacts& d) { return with_limited_stiffness(asked, d).coupling.k_c; }

// Stiffness 0.93 b / (T/2 + t_d), calculated by hand for a Touch: b = 0.2 N s/m.
TEST(DeviceStiffness, CountsTickLatencyAndDamping) {
  struct Row {
    double tick_hz, latency_s, k;
  };
  for (const Row& row : {Row{100, 0, 37.2}, Row{200, 0, 74.4}, Row{500, 0, 186}, Row{1000, 0, 372}, Row{2000, 0, 400},
                         Row{1000, 0.001, 0.93 * 0.2 / 0.0015}, Row{2000, 0.001, 0.93 * 0.2 / 0.00125},
                         Row{100, 0.001, 0.93 * 0.2 / 0.006}})
    EXPECT_NEAR(k_c(asking_for(400, LawKind::kReplica, row.tick_hz), device(0.2, row.latency_s)), row.k, 1e-9)
        << row.tick_hz << " Hz, " << row.latency_s << " s";
  EXPECT_NEAR(k_c(asking_for(400), device(0.1, 0)), 186, 1e-9);
}

TEST(DeviceStiffness, EqualsTheLimitForOtherLaws) {
  EXPECT_EQ(k_c(asking_for(400, LawKind::kSetPosition), device(0.2, 0)), 400);
  EXPECT_NEAR(k_c(asking_for(400, LawKind::kSetPosition), device(0.2, 0.001)), 0.2 / 0.0015, 1e-9);
  EXPECT_NEAR(k_c(asking_for(400, LawKind::kRaw, 500), device(0.2, 0)), 200, 1e-9);
}

TEST(DeviceStiffness, AssumesLowDampingForADeviceThatDeclaresNone) {
  EXPECT_NEAR(k_c(asking_for(400), device(0, 0.001)), 0.93 * kDampingUnknown / 0.0015, 1e-9);
  EXPECT_LT(kDampingUnknown, SimDeviceSpec{}.damping);
}

// 0.93 * 2 * 0.2 N s/m * 1000 Hz = 372 N/m.
TEST(DeviceStiffness, ListsTheGrantedStiffnessOfEverySeatOfAScene) {
  SceneSpec scene;
  scene.tools.resize(1);
  scene.seats.resize(2);
  scene.seats[0].name = "trainer";
  scene.seats[1].name = "trainee";
  scene.seats[1].device.damping = 0.5;  // renders up to 930 N/m
  for (SeatSpec& seat : scene.seats) seat.kind = SeatKind::kMaster;
  scene.authority = {{0, {}}};
  scene.coupling.k_c = 800;
  EXPECT_EQ(granted_listing(scene),
            "seat[0] trainer: k_c_n_m granted 372 N/m of 800 N/m: this device renders at most 0.93 b / (T/2 + t_d) "
            "(damping b 0.2 N s/m, tick T 1 ms, latency t_d 0 ms)\n");
  scene.coupling.k_c = 400;
  EXPECT_NE(granted_listing(scene).find("372 N/m of 400 N/m"), std::string::npos) << "also by less than a tenth";
  scene.coupling.k_c = 372;
  EXPECT_EQ(granted_listing(scene), "");
  scene.coupling.k_c = 800;
  scene.unsafe_gains = true;
  EXPECT_EQ(granted_listing(scene), "") << "this scene accepts the risk";
}

TEST(DeviceStiffness, LimitsTheToolSpringOfASlaveSeat) {
  SeatSetup asked = asking_for(400, LawKind::kSetPosition);
  asked.seat.kind = SeatKind::kSlave;
  const SeatSetup got = with_limited_stiffness(asked, device(0.1, 0));
  EXPECT_NEAR(got.k_s, 200, 1e-9);
  EXPECT_EQ(got.coupling.k_c, 400);
  EXPECT_NE(softened_text(got, device(0.1, 0)).find("k_s_n_m is 200 N/m instead of the scene's 400"), std::string::npos)
      << softened_text(got, device(0.1, 0));
}

TEST(DeviceStiffness, SkipsDevicesWithoutMotorsAndUnsafeScenes) {
  EXPECT_EQ(k_c(asking_for(400), device(0, 0.001, 0)), 400) << "a mouse has no motor to make energy with";
  SeatSetup risky = asking_for(750);
  risky.unsafe_gains = true;
  EXPECT_EQ(k_c(risky, device(0.2, 0.001)), 750);
  EXPECT_EQ(k_c(asking_for(100), device(0.2, 0)), 100) << "never stiffer than asked";
}

TEST(DeviceStiffness, ReportsAReductionWithCauseAndNumbers) {
  EXPECT_EQ(softened_text(with_limited_stiffness(asking_for(300), device(0.2, 0)), device(0.2, 0)), "");
  EXPECT_EQ(softened_text(with_limited_stiffness(asking_for(400), device(0.2, 0)), device(0.2, 0)), "")
      << "372 N/m: a tenth less is not perceptible";
  EXPECT_EQ(softened_text(with_limited_stiffness(asking_for(420), device(0.2, 0)), device(0.2, 0)),
            "k_c_n_m is 372 N/m instead of the scene's 420: this device renders at most 0.93 b / (T/2 + t_d) (damping "
            "b 0.2 N s/m, tick T 1 ms, latency t_d 0 ms)");
  const std::string unknown =
      softened_text(with_limited_stiffness(asking_for(400, LawKind::kSetPosition), device(0, 0.001)), device(0, 0.001));
  EXPECT_EQ(unknown,
            "k_c_n_m is 67 N/m instead of the scene's 400: this device renders at most b / (T/2 + t_d) (damping b 0.1 "
            "N s/m assumed as it is not known, tick T 1 ms, "
            "latency t_d 1 ms); a device file may set damping_n_s_m");
}

// A client with a simulated device receives the device's description from the scene. The server therefore takes the
// properties from the scene.
TEST(DeviceStiffness, UsesTheSceneDescriptionOfASimulatedDevice) {
  rpc::DeviceFacts simulated;
  simulated.simulated = true;
  SimDeviceSpec described;
  described.damping = 0.15;
  EXPECT_EQ(with_declared_properties(simulated, described).damping_n_s_m, 0.15);
  EXPECT_EQ(with_declared_properties(device(0, 0.001), described).damping_n_s_m, 0) << "not of a real one";
}

}  // namespace
}  // namespace tandem::setup

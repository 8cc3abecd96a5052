// The whole stack with the test's own libHD.so: loader, group, driver, state machine. Virtual time: waiting runs the
// stub's servo.
#include <cmath>

#include "tests/hal/drivers/openhaptics/openhaptics_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal::openhaptics {
namespace {

TEST_F(OpenHaptics, ReadsTheDeviceCapabilities) {
  OpenHapticsDriver driver{"Default Device", group, clock};
  ASSERT_TRUE(driver.bring_up(patient));
  const DeviceCaps& caps = driver.caps();
  EXPECT_EQ(caps.joints, 3u);
  EXPECT_TRUE(caps.prismatic);
  EXPECT_EQ(caps.homing, Homing::kInkwell);
  EXPECT_EQ(caps.timing, Timing::kVendor);
  EXPECT_DOUBLE_EQ(*caps.axis[2].peak, 3.3);
  EXPECT_DOUBLE_EQ(*caps.axis[2].continuous, 0.88);
  EXPECT_EQ(caps.axis[0].from, Provenance::kVendorQuery);
  // The vendor's workspace box: x -160..160, y (up) -120..120, z (to the user) -70..70 mm.
  EXPECT_NEAR(caps.workspace_min[1], -0.070, 1e-12);
  EXPECT_NEAR(caps.workspace_max[2], 0.120, 1e-12);
}

TEST_F(OpenHaptics, ConvertsFramesAndUnits) {
  StubDevice& d = stub().devices[0];
  d.x = {10, 20, 30};  // right, up, towards the user
  d.v = {1, 2, 3};
  d.buttons = 2;
  d.encoders = {7, -8, 9};
  auto c = core();
  Pusher p;
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_EQ(c->phase(), Phase::kReady);
  EXPECT_TRUE(p.seen.x.isApprox(Vec3(0.010, -0.030, 0.020)));
  EXPECT_TRUE(p.seen.dx.isApprox(Vec3(0.001, -0.003, 0.002)));
  EXPECT_EQ(p.seen.buttons, 2u);
  EXPECT_EQ(p.seen.raw[1], -8);
  p.effort = {0.5, 1.0, -0.25};  // right, away, down
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 2s);
  EXPECT_NEAR(d.force[0], 0.5, 1e-9);
  EXPECT_NEAR(d.force[1], -0.25, 1e-9) << "up";
  EXPECT_NEAR(d.force[2], -1.0, 1e-9) << "towards the user";
  EXPECT_NEAR(p.seen.f_out[1], 1.0, 1e-9);
  // Power into the hand is the same on both sides: F.v in [N][mm/s] and [N][m/s].
  const double theirs = 1e-3 * (d.force[0] * d.v[0] + d.force[1] * d.v[1] + d.force[2] * d.v[2]);
  EXPECT_NEAR(p.seen.f_out.dot(p.seen.dx), theirs, 1e-12);
  EXPECT_EQ(c->counts().unanswered, 0u);
}

TEST_F(OpenHaptics, GivesNoForceBeforeCalibrationAndCalibratesOnRequest) {
  StubDevice& d = stub().devices[0];
  d.calibration = 0x5002;  // needs the inkwell
  auto c = core();
  Pusher p;
  p.effort = {1, 1, 1};
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 500ms);
  EXPECT_EQ(c->phase(), Phase::kUnhomed);
  EXPECT_FALSE(c->enable());
  d.calibration = 0x5001;  // the stylus was put in
  run({{c.get(), &p}}, 200ms);
  EXPECT_EQ(d.calibrations, 1u);
  EXPECT_EQ(c->phase(), Phase::kReady);
  EXPECT_EQ(d.force, (std::array<double, 3>{})) << "ready, not enabled";
  const unsigned before = d.calibrations;
  d.calibration = 0x5001;
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 500ms);
  EXPECT_EQ(d.calibrations, before) << "never moves the origin under a force";
}

/// A device that finds its origin only by an encoder reset in a known pose.
struct ResetOnly : OpenHaptics {
  ResetOnly() {
    stub().devices[0].style = 1;
    stub().devices[0].calibration = 0x5002;
  }
  StubDevice& d = stub().devices[0];
  Pusher p;
};

TEST_F(ResetOnly, WaitsForTheOperatorBeforeTheServoAndResetsOnce) {
  patient.answers = true;
  patient.meanwhile = [&] {
    EXPECT_EQ(d.calibrations, 0u) << "not in whatever pose it stands";
    EXPECT_FALSE(stub().running) << "before the servo";
  };
  auto c = core();
  ASSERT_TRUE(c->bring_up(patient));
  EXPECT_EQ(c->caps().homing, Homing::kResetPose);
  ASSERT_EQ(patient.asked.size(), 1u);
  EXPECT_NE(patient.asked[0].find("reset pose"), std::string::npos);
  run({{c.get(), &p}}, 200ms);
  EXPECT_EQ(c->phase(), Phase::kReady);
  EXPECT_EQ(d.calibrations, 1u);
}

TEST_F(ResetOnly, StaysUnhomedAndGivesNoForceWithoutAReply) {
  for (const std::uint32_t says : {0x5002U, 0x5001U, 0x5000U}) {  // even if the library accepts an old reset
    d.calibration = says;
    auto c = core();
    p.effort = {1, 1, 1};
    ASSERT_TRUE(c->bring_up(patient));
    run({{c.get(), &p}}, 1s);
    EXPECT_EQ(c->phase(), Phase::kUnhomed) << says;
    EXPECT_FALSE(c->enable());
    EXPECT_EQ(d.calibrations, 0u);
    EXPECT_EQ(d.force, (std::array<double, 3>{}));
  }
}

TEST_F(ResetOnly, AcceptsHomeHereOnceWithoutAPrompt) {
  auto c = core("Default Device", true);
  ASSERT_TRUE(c->bring_up(patient));
  EXPECT_TRUE(patient.asked.empty());
  run({{c.get(), &p}}, 200ms);
  EXPECT_EQ(c->phase(), Phase::kReady);
  EXPECT_EQ(d.calibrations, 1u);
  ASSERT_TRUE(c->bring_up(patient)) << "brought up again, at any position";
  EXPECT_EQ(patient.asked.size(), 1u);
  run({{c.get(), &p}}, 200ms);
  EXPECT_EQ(c->phase(), Phase::kUnhomed);
  EXPECT_EQ(d.calibrations, 1u);
}

TEST_F(ResetOnly, ReportsAFailedResetAndClosesTheDevice) {
  patient.answers = true;
  d.reset_error = 0x0303;
  auto c = core();
  const auto up = c->bring_up(patient);
  ASSERT_FALSE(up);
  EXPECT_NE(up.error().message.find("0x0303"), std::string::npos) << up.error().message;
  EXPECT_FALSE(d.initialised);
  EXPECT_FALSE(stub().running);
}

TEST_F(OpenHaptics, RequestsNoResetPoseFromADeviceWithAnInkwell) {
  auto c = core();
  ASSERT_TRUE(c->bring_up(patient));
  EXPECT_TRUE(patient.asked.empty());
}

TEST_F(OpenHaptics, OpensTheDefaultDeviceWithoutAName) {
  stub().devices[0].name = "Default PHANToM";  // name in older installations
  auto c = core("");
  ASSERT_TRUE(c->bring_up(patient));
  EXPECT_EQ(c->id().key, "default");
  stub().devices.clear();
  auto none = core("");
  const auto up = none->bring_up(patient);
  ASSERT_FALSE(up);
  EXPECT_NE(up.error().message.find("the default device does not answer"), std::string::npos) << up.error().message;
}

TEST_F(OpenHaptics, ClampsToTheReportedLimitAndToZeroWithoutOne) {
  for (const double said : {3.3, 0.0, std::nan(""), -1.0}) {
    SCOPED_TRACE(said);
    stub().devices[0].force_max = said;
    OpenHapticsDriver driver{"Default Device", group, clock};
    ASSERT_TRUE(driver.bring_up(patient));
    ServoCommand command;
    State state;
    command.effort = {1, 0, 0};
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(driver.exchange(command, state));
    ASSERT_FALSE(state.homed) << "homing was not requested";
    EXPECT_EQ(state.f_out.norm(), 0) << "no origin, no force";
    command.effort = {};
    command.homing = true;
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(driver.exchange(command, state));
    ASSERT_TRUE(state.homed);
    command.homing = false;
    command.effort = {30, -40, 0};
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(driver.exchange(command, state));
    const double most = said > 0 ? said : 0;
    EXPECT_NEAR(state.f_out.norm(), most, 1e-9);
    EXPECT_NEAR(state.f_out[0], 0.6 * most, 1e-9);
    EXPECT_TRUE(state.saturated);
    EXPECT_EQ(driver.caps().axis[0].peak.has_value(), said > 0);
  }
}

TEST_F(OpenHaptics, ReleasesWhenCommandsStopDespiteTheVendorsServo) {
  auto c = core();
  Pusher p;
  p.effort = {1, 0, 0};
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 1s);
  ASSERT_NEAR(stub().devices[0].force[0], 1, 1e-9);
  for (unsigned i = 0; i < TouchGroup::kCommandCycles + 1; ++i) stub().cycle();  // Tandem's thread sleeps
  EXPECT_EQ(stub().devices[0].force[0], 0);
}

TEST_F(OpenHaptics, SendsZerosBeforeItCloses) {
  auto c = core();
  Pusher p;
  p.effort = {1, 0, 0};
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 1s);
  c->send_zeros();
  EXPECT_EQ(stub().devices[0].force[0], 0);
  c.reset();
  EXPECT_FALSE(stub().running);
  EXPECT_FALSE(stub().devices[0].initialised);
}

TEST_F(OpenHaptics, SendsZerosWhileAnotherDeviceIsOpened) {
  stub().devices.resize(2);
  stub().devices[1].name = "late";
  auto c = core();
  Pusher p;
  p.effort = {1, 0, 0};
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 1s);
  ASSERT_NEAR(stub().devices[0].force[0], 1, 1e-9);
  OpenHapticsDriver late{"late", group, clock};
  ASSERT_TRUE(late.bring_up(patient));  // the stub reports whether the scheduler was stopped with a force on
  EXPECT_EQ(stub().devices[0].force[0], 0) << "no command came meanwhile";
}

TEST_F(OpenHaptics, ServesThreeDevicesAndLosesOnlyTheUnplugged) {
  stub().devices.resize(3);
  for (int i = 0; i < 3; ++i) {
    stub().devices[static_cast<std::size_t>(i)].name = std::string(1, static_cast<char>('a' + i));
    stub().devices[static_cast<std::size_t>(i)].x = {10.0 * i, 0, 0};
  }
  auto a = core("a"), b = core("b"), c = core("c");
  Pusher pa, pb, pc;
  pa.effort = {0.1, 0, 0};
  pb.effort = {0.2, 0, 0};
  pc.effort = {0.3, 0, 0};
  for (auto* each : {a.get(), b.get(), c.get()}) ASSERT_TRUE(each->bring_up(patient));
  run({{a.get(), &pa}, {b.get(), &pb}, {c.get(), &pc}}, 200ms);
  for (auto* each : {a.get(), b.get(), c.get()}) ASSERT_TRUE(each->enable()) << static_cast<int>(each->phase());
  run({{a.get(), &pa}, {b.get(), &pb}, {c.get(), &pc}}, 1s);
  EXPECT_NEAR(stub().devices[0].force[0], 0.1, 1e-9);
  EXPECT_NEAR(stub().devices[2].force[0], 0.3, 1e-9);
  EXPECT_NEAR(pc.seen.x[0], 0.020, 1e-12);

  stub().devices[1].unplugged = true;
  run({{a.get(), &pa}, {b.get(), &pb}, {c.get(), &pc}}, 5ms);
  EXPECT_EQ(b->phase(), Phase::kLost);
  EXPECT_EQ(pb.losses, 1u);
  EXPECT_EQ(pb.why, Errc::kUnplugged);
  const unsigned touched = stub().devices[1].touched;
  const unsigned frames = stub().devices[0].frames;
  run({{a.get(), &pa}, {c.get(), &pc}}, 500ms);
  EXPECT_EQ(stub().devices[1].touched, touched) << "its handle is never touched again";
  EXPECT_GT(stub().devices[0].frames, frames + 400);
  EXPECT_EQ(a->phase(), Phase::kEnabled);
  EXPECT_NEAR(stub().devices[2].force[0], 0.3, 1e-9);
  b.reset();
  EXPECT_EQ(stub().devices[1].touched, touched);
}

TEST_F(OpenHaptics, ToleratesAndReportsAnErrorOfOneCycle) {
  auto c = core();
  Pusher p;
  p.effort = {1, 0, 0};
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  run({{c.get(), &p}}, 1s);
  for (const std::uint32_t code : {0x0200u, 0x0201u, 0x0202u, 0x0203u, 0x0204u}) {
    SCOPED_TRACE(code);
    stub().devices[0].cycle_error = code;
    bool told = false;
    for (int i = 0; i < 4; ++i) {
      run({{c.get(), &p}}, 1ms);
      told = told || p.seen.saturated;
    }
    EXPECT_TRUE(told);
    EXPECT_EQ(c->phase(), Phase::kEnabled);
    EXPECT_TRUE(stub().errors.empty()) << "the stack is drained";
  }
}

TEST_F(OpenHaptics, LosesTheDeviceOnEveryUnplugCode) {
  for (const std::uint32_t code : {0x0300u, 0x0302u, 0x0303u}) {
    SCOPED_TRACE(code);
    stub().reset();
    stub().devices.resize(1);
    auto c = core();
    Pusher p;
    ASSERT_TRUE(c->bring_up(patient));
    run({{c.get(), &p}}, 100ms);
    stub().devices[0].cycle_error = code;
    run({{c.get(), &p}}, 4ms);
    EXPECT_EQ(c->phase(), Phase::kLost);
    EXPECT_EQ(p.losses, 1u);
  }
}

TEST_F(OpenHaptics, FaultsWhenTheVendorsServoStalls) {
  auto c = core();
  Pusher p;
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  clock.frozen = true;
  run({{c.get(), &p}}, 40ms);
  EXPECT_EQ(c->phase(), Phase::kFault);
  clock.frozen = false;
  run({{c.get(), &p}}, 40ms);
  EXPECT_EQ(c->phase(), Phase::kFault) << "only a person lets it go on";
  ASSERT_TRUE(c->reset());
}

TEST_F(OpenHaptics, RetriesOnceAfterAnUncleanExit) {
  stub().devices[0].held = true;
  OpenHapticsDriver driver{"Default Device", group, clock};
  EXPECT_TRUE(driver.bring_up(patient));
}

TEST_F(OpenHaptics, ReportsStartErrors) {
  struct Case {
    const char* what;
    void (*spoil)(StubHd&);
    Errc code;
    const char* word;
  };
  const Case cases[] = {
      {"absent", [](StubHd& s) { s.devices[0].name = "other"; }, Errc::kNotFound, "plugged in"},
      {"licence", [](StubHd& s) { s.devices[0].init_error = 0x0600; }, Errc::kPermission, "licence"},
      {"busy", [](StubHd& s) { s.devices[0].init_error = 0x0301; }, Errc::kBusy, "another program"},
      {"fault", [](StubHd& s) { s.devices[0].init_error = 0x0300; }, Errc::kUnplugged, "fault"},
      {"input only", [](StubHd& s) { s.devices[0].actuated = 0; }, Errc::kUnsupported, "moves 0 axes"},
      {"no scheduler", [](StubHd& s) { s.scheduler_fails = true; }, Errc::kInternal, "0x0304"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    stub().reset();
    stub().devices.resize(1);
    c.spoil(stub());
    OpenHapticsDriver driver{"Default Device", group, clock};
    const auto up = driver.bring_up(patient);
    ASSERT_FALSE(up);
    EXPECT_EQ(up.error().code, c.code);
    EXPECT_NE(up.error().message.find(c.word), std::string::npos) << up.error().message;
    EXPECT_TRUE(stub().errors.empty());
    EXPECT_FALSE(stub().running);
  }
}

TEST_F(OpenHaptics, RejectsDevicesBeyondItsLimit) {
  stub().devices.resize(TouchGroup::kMax + 1);
  std::vector<std::unique_ptr<OpenHapticsDriver>> drivers;
  for (std::size_t i = 0; i <= TouchGroup::kMax; ++i) {
    stub().devices[i].name = std::to_string(i);
    drivers.push_back(std::make_unique<OpenHapticsDriver>(std::to_string(i), group, clock));
    EXPECT_EQ(drivers.back()->bring_up(patient).has_value(), i < TouchGroup::kMax);
  }
}

TEST_F(OpenHaptics, ExchangesWithoutHeap) {
  auto c = core();
  Pusher p;
  ASSERT_TRUE(c->bring_up(patient));
  run({{c.get(), &p}}, 100ms);
  ASSERT_TRUE(c->enable());
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) {
    clock.wait_until(clock.now() + 1ms);
    c->step(clock.now(), p);
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::hal::openhaptics

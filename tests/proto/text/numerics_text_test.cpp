// The message numerics of a scene: accepted values, refusals with their words, and its way to a client.
#include <array>

#include "proto/text/seat_setup.h"
#include "tests/proto/text/bad_scene.h"

namespace tandem {
namespace {

using namespace bad_scene;

/// The good scene with a virtual tool, and `keys` in line 3.
std::string scene_with(const std::string& keys, const std::string& environment = "") {
  std::string text = with("slave { model: TOUCH }", "slave { environment { " + environment + " } }");
  return text.insert(text.find("device_coupling"), keys + " ");
}

TEST(SceneNumerics, AreOneImplicitStepInDoubleByDefault) {
  const auto scene = parse_scene(good(), "s");
  ASSERT_TRUE(scene);
  EXPECT_TRUE(scene->numerics.is_default());
  EXPECT_NE(effective_scene_text(*scene).find("numerics.integrator"), std::string::npos);
}

TEST(SceneNumerics, ReadsEveryIntegratorAndPrecision) {
  constexpr std::array kNames{"IMPLICIT_EULER", "IMPLICIT_MIDPOINT", "SEMI_IMPLICIT_EULER", "RK4", "EXACT"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto scene = parse_scene(scene_with("unsafe_gains: true numerics { integrator: " + std::string(kNames[i]) +
                                              " substeps: 64 precision: FLOAT }"),
                                   "s");
    ASSERT_TRUE(scene) << to_text(scene.error());
    EXPECT_EQ(static_cast<std::size_t>(scene->numerics.integrator), i);
    EXPECT_EQ(scene->numerics.precision, PrecisionKind::kFloat);
    EXPECT_EQ(scene->numerics.substeps, 64u);
    EXPECT_NE(effective_scene_text(*scene).find(kNames[i]), std::string::npos);
  }
}

TEST(SceneNumerics, NamesValuesOutOfRange) {
  expect_one(scene_with("numerics { substeps: @0 }"), "numerics.substeps", "64");
  expect_one(scene_with("numerics { substeps: @65 }"), "numerics.substeps", "64");
  expect_one(scene_with("numerics { integrator: @7 }"), "numerics.integrator", "7");
}

TEST(SceneNumerics, NeedsUnsafeGainsWithoutTheProofOfPassivity) {
  EXPECT_EQ(to_text(errors_of(scene_with("numerics { substeps: 8 }"))), "");
  expect_one(scene_with("numerics { integrator: @RK4 }"), "numerics.integrator", "unsafe_gains: true");
  expect_one(scene_with("numerics { precision: @FLOAT }"), "numerics.precision", "IMPLICIT_EULER");
  EXPECT_EQ(to_text(errors_of(scene_with("unsafe_gains: true numerics { integrator: RK4 precision: FLOAT }"))), "");
}

TEST(SceneNumerics, RefusesFrictionThatTheStepDoesNotSolve) {
  const std::string rough = "wall { friction: 0.4 }";
  EXPECT_EQ(to_text(errors_of(scene_with("numerics { substeps: 8 }", rough))), "");
  expect_one(scene_with("unsafe_gains: true numerics { integrator: @EXACT }", rough), "numerics.integrator",
             "friction: 0.4");
  expect_one(scene_with("unsafe_gains: true numerics { precision: @FLOAT }", "tissue { friction: 0.1 }"),
             "numerics.precision", "friction: 0.1");
}

TEST(SceneNumerics, RefusesToolsThatADeviceMoves) {
  expect_one(with("device_coupling", "@numerics { substeps: 2 } device_coupling"), "numerics", "tool \"tool\"");
  auto scene = parse_scene(scene_with("numerics { substeps: 2 }"), "s");
  ASSERT_TRUE(scene);
  scene->tools[0].is_virtual = false;
  scene->tools[0].remote = true;
  EXPECT_FALSE(law_problem(*scene)) << "under law REPLICA a SLAVE seat's tool is simulated";
  choose_law(*scene, LawKind::kSetPosition);
  ASSERT_TRUE(law_problem(*scene));
  EXPECT_EQ(law_problem(*scene)->key, "numerics");
}

TEST(SceneNumerics, ReachTheClientUnchanged) {
  auto scene = parse_scene(scene_with("numerics { substeps: 5 }"), "s");
  ASSERT_TRUE(scene);
  scene->numerics.integrator = IntegratorKind::kRk4;
  scene->numerics.precision = PrecisionKind::kFloat;
  std::array<char, wire::kSetupMax> bytes{};
  const std::size_t size = encode_seat_setup(seat_setup(*scene, 0), bytes);
  const auto setup = decode_seat_setup(std::span<const char>(bytes).first(size));
  ASSERT_TRUE(setup) << to_text(setup.error());
  EXPECT_EQ(setup->numerics.integrator, IntegratorKind::kRk4);
  EXPECT_EQ(setup->numerics.precision, PrecisionKind::kFloat);
  EXPECT_EQ(setup->numerics.substeps, 5u);
}

TEST(DeviceNumerics, AreAbsentByDefaultAndReadFromDevicesAndSlaves) {
  const auto plain = parse_scene(good(), "s");
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->seats[0].device.numerics || plain->tools[0].slave.numerics);
  EXPECT_EQ(effective_scene_text(*plain).find("device.numerics"), std::string::npos);
  std::string text = with("slave { model: TOUCH }", "slave { model: TOUCH numerics { substeps: 8 } }");
  const auto scene = parse_scene(text, "s");
  ASSERT_TRUE(scene) << to_text(scene.error());
  ASSERT_TRUE(scene->tools[0].slave.numerics);
  EXPECT_EQ(scene->tools[0].slave.numerics->substeps, 8u);
  EXPECT_EQ(scene->tools[0].slave.numerics->integrator, IntegratorKind::kImplicitEuler);
  EXPECT_TRUE(scene->numerics.is_default()) << "those of the tools are others";
  EXPECT_NE(effective_scene_text(*scene).find("slave.numerics.substeps"), std::string::npos);
}

TEST(DeviceNumerics, ReachTheClientUnchanged) {
  auto scene = parse_scene(good(), "s");
  ASSERT_TRUE(scene);
  scene->seats[0].device.numerics = NumericsSpec{IntegratorKind::kExact, PrecisionKind::kFloat, 7};
  std::array<char, 1 << 16> bytes{};
  const std::size_t size = encode_seat_setup(seat_setup(*scene, 0), bytes);
  const auto setup = decode_seat_setup(std::span<const char>(bytes).first(size));
  ASSERT_TRUE(setup) << to_text(setup.error());
  ASSERT_TRUE(setup->seat.device.numerics);
  EXPECT_EQ(setup->seat.device.numerics->integrator, IntegratorKind::kExact);
  EXPECT_EQ(setup->seat.device.numerics->precision, PrecisionKind::kFloat);
  EXPECT_EQ(setup->seat.device.numerics->substeps, 7u);
}

TEST(DeviceNumerics, RefuseWhatMakesNoSense) {
  expect_one(with("slave { model: TOUCH }", "slave { model: TOUCH numerics { substeps: @65 } }"),
             "tool[0].slave.numerics.substeps", "64");
  for (const std::string how : {"RK4", "SEMI_IMPLICIT_EULER"}) {
    expect_one(
        with("slave { model: TOUCH }", "slave { model: TOUCH friction_n: 0.1 numerics { integrator: @" + how + " } }"),
        "tool[0].slave.numerics.integrator", "friction_n: 0.1");
    EXPECT_EQ(to_text(errors_of(with("slave { model: TOUCH }",
                                     "slave { model: TOUCH friction_n: 0 numerics { integrator: " + how + " } }"))),
              "");
  }
  EXPECT_EQ(to_text(errors_of(
                with("slave { model: TOUCH }",
                     "slave { model: TOUCH friction_n: 0.1 numerics { integrator: EXACT precision: FLOAT } }"))),
            "");
  expect_one(with("slave { model: TOUCH }", "slave { model: @VIRTUAL numerics { substeps: 2 } }"),
             "tool[0].slave.model", "has no device");
}

TEST(SceneNumerics, AClientRefusesFrictionThatTheStepDoesNotSolve) {
  const auto scene = parse_scene(scene_with("numerics { substeps: 5 }", "wall { friction: 0.2 }"), "s");
  ASSERT_TRUE(scene);
  SeatSetup setup = seat_setup(*scene, 0);
  setup.numerics.integrator = IntegratorKind::kExact;
  std::array<char, wire::kSetupMax> bytes{};
  const auto read = decode_seat_setup(std::span<const char>(bytes).first(encode_seat_setup(setup, bytes)));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error()[0].key, "numerics.integrator");
}

}  // namespace
}  // namespace tandem

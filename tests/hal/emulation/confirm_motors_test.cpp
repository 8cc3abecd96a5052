// `tandem-client doctor --confirm-motors` as a user runs it, against an emulated board behind the real hidapi.
// No force before it, force after it, none with another file, none of a reversed motor.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <iterator>
#include <sstream>
#include <thread>

#include "client/app/commands/client_commands.h"
#include "client/app/hardware_device.h"
#include "client/app/motor_registry_file.h"
#include "common/io/clock.h"
#include "common/io/command_line.h"
#include "common/io/signals.h"
#include "hal/backends/device_files.h"
#include "proto/text/presets_embedded.h"
#include "tests/hal/drivers/woodenhaptics/confirmed.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"
#include "tests/hal/emulation/testbed.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using client::HardwareDevice;

/// Input of the user on standard input.
class Typed {
 public:
  explicit Typed(const std::string& text) : before_(::dup(STDIN_FILENO)) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
  }
  ~Typed() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

/// Client that pushes with a joint effort that every motor can give.
struct Pusher final : hal::ServoClient {
  hal::Command tick(const hal::State& state) noexcept override {
    given = std::max(given.load(), state.f_out.norm());
    return {++seq, io::monotonic_now() + 5ms, hal::CommandKind::kJointEffort, {0.05, 0.05, 0.05}};
  }
  void lost(hal::Errc) noexcept override {}
  std::uint64_t seq = 0;
  std::atomic<double> given{0};
};

class ConfirmMotors : public testing::Test {
 protected:
  ConfirmMotors() : signals_(io::make_signalfd()) {}
  /// @param reversed  the motor connected with reversed polarity; 3: none
  void plug(std::size_t reversed) {
    std::string text{find_shipped_preset("woodenhaptics-2019")->text};
    file = folder.write("arm.textproto", text);
    WoodenHapticsSpec truth = *hal::load_device_file(file)->woodenhaptics;
    if (reversed < 3) truth.motor_direction[reversed] = -truth.motor_direction[reversed];
    model = std::make_unique<hal::emulation::WoodenHapticsModel>(WoodenHapticsFixture::at_calibration(truth, {}));
    start = model->tip();
    node = std::make_unique<HidrawNode>(*model);
    bed.plug(*node, *model, "1-2");
    words = "woodenhaptics:preset=" + file + ",enable_motors=yes,home=here";
    state = folder.file("my state");
  }
  void TearDown() override {
    if (node) bed.remove("1-2");
  }
  /// Puts the arm into its calibration pose and releases it there.
  void rest() {
    node->with_model([&] {
      model->place(start);
      model->let_go();
    });
  }
  /// Moves the arm from there into the middle, after a host has read reports for a while, and releases it.
  void carry(const std::stop_token& stop) {
    constexpr std::uint64_t kListens = 50;
    constexpr int kSteps = 400;
    const std::uint64_t before = node->with_model([&] { return model->host_reports(); });
    while (!stop.stop_requested() && node->with_model([&] { return model->host_reports(); }) < before + kListens)
      (void)::poll(nullptr, 0, 1);
    for (int i = 1; i <= kSteps && !stop.stop_requested(); ++i, (void)::poll(nullptr, 0, 1))
      node->with_model([&] { model->place(start * (1 - static_cast<double>(i) / kSteps)); });
    node->with_model([&] { model->let_go(); });
  }
  /// Runs doctor; its output is in `said`.
  int doctor(const std::string& typed, const std::string& more = "--confirm-motors") {
    rest();
    const Typed person(typed);
    const std::jthread hand([this](const std::stop_token& stop) { carry(stop); });
    io::Program program("tandem-client", "", "");
    client::add_doctor_command(program.root());
    std::vector<std::string> typed_words{"doctor", "--device", words, "--state", state};
    std::istringstream rest(more);
    std::copy(std::istream_iterator<std::string>(rest), {}, std::back_inserter(typed_words));
    testing::internal::CaptureStdout();
    const int code = program.run(typed_words);
    said = testing::internal::GetCapturedStdout();
    return code;
  }
  /// Opens the device as `join` does and pushes for a while. @return largest force delivered [N]; `why`: the reason
  /// reported if there is none
  double pushed(std::string& why) {
    rest();
    io::StatusLine line{true};
    Pusher pusher;
    auto held = HardwareDevice::open(words, signals_.get(), line, {.state = state});
    EXPECT_TRUE(held) << held.error().reason;
    if (!held) return -1;
    why = (*held)->no_force_reason();
    (*held)->observe(pusher);
    EXPECT_TRUE((*held)->device().enable());
    double most = 0;
    for (const Time end = io::monotonic_now() + 400ms; io::monotonic_now() < end; (void)::poll(nullptr, 0, 1))
      most = std::max(most, node->with_model([&] { return model->motor_effort().norm(); }));
    (*held)->device().close();
    return std::max(most, pusher.given.load());
  }

  io::Fd signals_;  ///< first member: threads of the test bed inherit the blocked signals
  Folder folder;
  Testbed bed;
  std::unique_ptr<hal::emulation::WoodenHapticsModel> model;
  std::unique_ptr<HidrawNode> node;
  hal::Vec3 start;
  std::string file, words, state, said;
};

TEST_F(ConfirmMotors, EnablesForceForTheConfirmedFileOnly) {
  plug(3);
  std::string why;
  EXPECT_EQ(pushed(why), 0.0);
  EXPECT_NE(why.find("Type:\n  tandem-client doctor --device " + words + " --confirm-motors --state '" + state + "'"),
            std::string::npos)
      << why;
  EXPECT_EQ(doctor("", "--seconds 0.5 --force-test"), 1) << "a force test is a force, too";
  EXPECT_EQ(doctor("no\n"), 1);
  EXPECT_EQ(doctor(""), 1) << "without a user";
  EXPECT_EQ(pushed(why), 0.0) << "not agreed, not confirmed";

  ASSERT_EQ(doctor("yes\n"), 0) << said;
  EXPECT_EQ(node->with_model([&] { return model->motor_effort().norm(); }), 0.0) << "zeros at the end";
  EXPECT_GT(pushed(why), 0.0);
  EXPECT_EQ(why, "");

  file = folder.write("arm.textproto", folder.read("arm.textproto") + "# changed\n");
  EXPECT_EQ(pushed(why), 0.0) << "the signs in it may be others now";
  EXPECT_NE(why.find("they were never confirmed"), std::string::npos) << why;
}

TEST_F(ConfirmMotors, RejectsAReversedMotorDespiteAConfirmation) {
  plug(1);
  confirmed_motors(state, "serial:0001", file);
  EXPECT_EQ(doctor("yes\n"), 1);
  EXPECT_NE(said.find("base: pushes in the commanded direction"), std::string::npos) << said;
  EXPECT_NE(said.find("shoulder: moved AGAINST its command"), std::string::npos) << said;
  EXPECT_NE(said.find("elbow: not tested"), std::string::npos) << said;
  std::string why;
  EXPECT_EQ(pushed(why), 0.0);
  EXPECT_NE(why.find("did not confirm all of them"), std::string::npos) << why;
}

TEST_F(ConfirmMotors, SendsZerosAtASignalAndConfirmsNothing) {
  plug(3);
  std::jthread impatient([&](const std::stop_token& stop) {
    // Waits until a motor receives current.
    while (!stop.stop_requested() && node->with_model([&] { return model->motor_effort().norm(); }) == 0)
      (void)::poll(nullptr, 0, 1);
    ::kill(::getpid(), SIGINT);
  });
  EXPECT_EQ(doctor("yes\n"), 1);
  impatient.request_stop();
  impatient.join();
  signalfd_siginfo came{};
  EXPECT_EQ(::read(signals_.get(), &came, sizeof came), static_cast<ssize_t>(sizeof came));
  EXPECT_EQ(node->with_model([&] { return model->motor_effort().norm(); }), 0.0);
  std::string why;
  EXPECT_EQ(pushed(why), 0.0);
}

TEST_F(ConfirmMotors, RejectsATornRegistryAndDoesNotOverwriteIt) {
  plug(3);
  confirmed_motors(state, "serial:0001", file);
  std::string why;
  EXPECT_GT(pushed(why), 0.0);
  std::string text = folder.read("my state/confirmed_motors");
  folder.write("my state/confirmed_motors", text.substr(0, text.size() / 2));
  EXPECT_EQ(pushed(why), 0.0);
  EXPECT_NE(why.find("confirmed_motors: line 1"), std::string::npos) << why;
  EXPECT_EQ(doctor("yes\n"), 1) << "refused before any force";
  EXPECT_EQ(node->with_model([&] { return model->motor_effort().norm(); }), 0.0);
  EXPECT_EQ(folder.read("my state/confirmed_motors"), text.substr(0, text.size() / 2));
}

}  // namespace
}  // namespace tandem::test

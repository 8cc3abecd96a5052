// The whole chain: an emulated Falcon in the trainer's hand, an emulated WoodenHaptics board in the trainee's, another one as
// the slave; real libusb and hidapi, the client as the program runs it, real UDP, a real server and a real proxy.
#include <gtest/gtest.h>
#include <poll.h>

#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include "client/app/attend.h"
#include "common/io/clock.h"
#include "hal/app/device_files.h"
#include "proto/presets_embedded.h"
#include "tests/hal/emulation/testbed.h"
#include "tests/hal/falcon/bench.h"
#include "tests/hal/woodenhaptics/bench.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

constexpr double kSeconds = 9;
constexpr double kReach = 0.02;  // [m] of the trainer's motion

/// The shipped preset, as somebody would keep it who checked its force scale.
std::string checked_preset() {
  std::string text{find_shipped_preset("woodenhaptics-2015")->text};
  text.insert(text.rfind('}'), "  measured: \"the model's own\"\n");
  return text;
}

constexpr const char* kFalconFile =
    "falcon {\n  force { motor_1_counts_per_nm: 10000 motor_2_counts_per_nm: 10000 motor_3_counts_per_nm: 10000 }\n"
    "  measured: \"the model's own\"\n  peak_n: 6\n}\n";

/// A person at a workstation: `tandem-client join` in a thread of its own.
struct Person {
  Person(const std::string& server, const std::string& seat, const std::string& device, const std::string& json) {
    client::AttendPlan plan;
    plan.server = *io::parse_address(server, 1);
    plan.seat = seat;
    plan.device = device;
    plan.json = json;
    plan.duration_s = kSeconds;
    plan.quiet = true;
    thread = std::thread([this, plan] { code = client::attend(plan); });
  }
  ~Person() { thread.join(); }
  int code = -1;
  std::thread thread;
};

/// Somebody carries an arm from its calibration pose into the workspace, once its host listens, and lets go there.
struct Carry {
  explicit Carry(hal::wire::WoodenHapticsModel& m) : model(m), from(m.tip()) {}
  void go_on(Time now) {
    constexpr std::uint64_t kListens = 300;  // reports: homed long since
    constexpr double kSpeed = 0.2;           // [m/s]
    if (there || model.host_reports() < kListens) return;
    if (!moving) begun = now;
    moving = true;
    const double share = std::min(1.0, kSpeed * seconds(now - begun) / from.norm());
    model.place((1 - share) * from);
    there = share >= 1;
    if (there) model.let_go();
  }
  hal::wire::WoodenHapticsModel& model;
  hal::Vec3 from;
  Time begun{};
  bool moving = false, there = false;
};

struct Seen {
  hal::Vec3 low = hal::Vec3::Constant(1), high = hal::Vec3::Constant(-1);
  double force_max = 0, work = 0;
  hal::Vec3 before = hal::Vec3::Zero();
  bool begun = false;
  void see(const hal::Vec3& tip, const hal::Vec3& force) {
    low = low.cwiseMin(tip);
    high = high.cwiseMax(tip);
    force_max = std::max(force_max, force.norm());
    if (begun) work += force.dot(tip - before);
    begun = true;
    before = tip;
  }
  [[nodiscard]] double way() const { return (high - low).maxCoeff(); }
};

/// How far `path` is from moving as `lead` does, wherever each began: RMS of the difference over RMS of the motion.
double unlike(const std::vector<hal::Vec3>& path, const std::vector<hal::Vec3>& lead) {
  const auto mean = [](const std::vector<hal::Vec3>& all) {
    hal::Vec3 sum = hal::Vec3::Zero();
    for (const hal::Vec3& x : all) sum += x;
    return hal::Vec3{sum / static_cast<double>(all.size())};
  };
  const hal::Vec3 of_path = mean(path), of_lead = mean(lead);
  double difference = 0, motion = 0;
  for (std::size_t i = 0; i < lead.size(); ++i) {
    difference += ((path[i] - of_path) - (lead[i] - of_lead)).squaredNorm();
    motion += (lead[i] - of_lead).squaredNorm();
  }
  return std::sqrt(difference / motion);
}

TEST(WholeChain, AFalconLeadsABoardFollowsAndABoardIsTheSlave) {
  Folder folder;
  Process server = hosting("devices_remote", {"--listen", "127.0.0.1:0", "--duration", "60"});
  Process proxy{{TANDEM_NETSIM, "proxy", "--to", address_of(server), "--listen", "127.0.0.1:0", "--delay", "2", "--loss", "2"}};
  ASSERT_TRUE(proxy.wait_for("listening on "));
  const std::string address = proxy.after("listening on ");

  const std::string preset = folder.write("arm.textproto", checked_preset());
  const auto described = hal::load_device_file(preset);
  ASSERT_TRUE(described) << described.error().message;
  Testbed bed;
  hal::wire::FalconModel falcon{hal::falcon::ready_model()};
  UsbfsNode falcon_node{falcon};
  hal::wire::WoodenHapticsModel held{WoodenBench::at_calibration(*described->woodenhaptics, {})};
  hal::wire::WoodenHapticsModel slave{WoodenBench::at_calibration(*described->woodenhaptics, {})};
  HidrawNode held_node{held}, slave_node{slave};
  bed.plug(falcon_node, falcon, "1-2");
  bed.plug(held_node, held, "1-3");
  bed.plug(slave_node, slave, "1-4");

  Seen leader, follower, tool;
  std::vector<hal::Vec3> lead, follow, tip;  // once all have gone home to a common place
  {
    const std::string boards = "woodenhaptics:preset=" + preset + ",energise=yes,home=here,port=";
    Person trainer{address, "trainer", "falcon:calibration=" + folder.write("falcon.textproto", kFalconFile), folder.file("trainer.json")};
    Person trainee{address, "trainee", boards + "1-3", folder.file("trainee.json")};
    Person patient{address, "slave", boards + "1-4", folder.file("slave.json")};
    // A hand leads the Falcon's grip along what a person might draw; nobody holds the boards.
    Carry held_arm{held}, slave_arm{slave};
    const Time begin = io::monotonic_now();
    Time ready{};
    bool carried = false;
    for (Time now = begin; seconds(now - begin) < kSeconds + 1; now = io::monotonic_now()) {
      held_node.with_model([&] { held_arm.go_on(now); });
      slave_node.with_model([&] { slave_arm.go_on(now); });
      if (!carried) ready = now;
      carried = held_arm.there && slave_arm.there;
      const double t = std::max(0.0, seconds(now - ready) - 1);  // first the forces ramp in
      const hal::Vec3 goal{kReach * std::sin(1.3 * t), 0.5 * kReach * (1 - std::cos(0.9 * t)), 0.5 * kReach * std::sin(2.1 * t)};
      falcon_node.with_model([&] {
        falcon.mechanics().set_pull({.k = 800, .b = 10, .m = 0.2, .x = goal});
        leader.see(falcon.mechanics().tip(), falcon.mechanics().motor_force());
      });
      if (!carried) {
        ::poll(nullptr, 0, 1);
        continue;
      }
      held_node.with_model([&] { follower.see(held.tip(), held.motor_force()); });
      slave_node.with_model([&] { tool.see(slave.tip(), slave.motor_force()); });
      if (t > 1.5) {
        lead.push_back(falcon_node.with_model([&] { return falcon.mechanics().tip(); }));
        follow.push_back(held_node.with_model([&] { return held.tip(); }));
        tip.push_back(slave_node.with_model([&] { return slave.tip(); }));
      }
      ::poll(nullptr, 0, 1);
    }
  }
  std::printf("[  chain   ] way and largest force at the wire: Falcon %.1f mm %.2f N, trainee's board %.1f mm %.2f N, slave %.1f mm %.2f N\n",
              1e3 * leader.way(), leader.force_max, 1e3 * follower.way(), follower.force_max, 1e3 * tool.way(), tool.force_max);
  ASSERT_GT(lead.size(), 500U) << "the session was over before anybody could lead";
  std::printf("[  chain   ] RMS of the difference to the Falcon's motion, over the RMS of that: slave %.2f, trainee's board %.2f, %zu readings\n",
              unlike(tip, lead), unlike(follow, lead), lead.size());
  for (const char* seat : {"trainer", "trainee", "slave"}) {
    ASSERT_FALSE(folder.json(std::string(seat) + ".json").is_discarded()) << seat;
  }
  // The two kinematics share one tool: its slave goes where the Falcon's tip goes, and so does the board in the other hand.
  EXPECT_GT(leader.way(), kReach);
  // 1: stands still; about 0.3 on a quiet machine. On a busy one a gate may let go for a while, and the way home counts.
  EXPECT_LT(unlike(tip, lead), 0.95);
  EXPECT_LT(unlike(follow, lead), 0.95);
  EXPECT_GT(leader.force_max, 0.02);
  EXPECT_LE(leader.force_max, 3.0 + 0.1);  // the scene's gate, in whole motor counts
  EXPECT_LE(follower.force_max, 3.1);
  EXPECT_LE(tool.force_max, 3.1);
  EXPECT_EQ(falcon.unsafe_frames(), 0U);
  // Power: what the wire models say the motors gave is what the clients booked, but for what their clocks sample apart.
  const auto booked = [&](const char* seat) { return folder.json(std::string(seat) + ".json")["energy"]["delivered_j"].get<double>(); };
  EXPECT_NEAR(leader.work, booked("trainer"), 0.01 + 0.3 * std::abs(leader.work));
  // They left: zeros on every wire.
  EXPECT_EQ(falcon.order().motor, (std::array<std::int16_t, 3>{}));
  EXPECT_EQ(held.motor_effort().norm(), 0.0);
  EXPECT_EQ(slave.motor_effort().norm(), 0.0);
  for (const char* port : {"1-2", "1-3", "1-4"}) bed.remove(port);
}

}  // namespace
}  // namespace tandem::test

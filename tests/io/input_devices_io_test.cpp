// Devices without motors at a real session: a recorded motion as a device leads a follower.
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

TEST(ReplayLive, LeadsASession) {
  const Folder folder;
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  for (int i = 0; i <= 60; ++i) csv += std::to_string(0.1 * i) + "," + (i / 10 % 2 == 0 ? "0" : "0.02") + ",0,0\n";
  const std::string motion = folder.write("m.csv", csv);
  Process host = hosting("one_axis", {"--duration", "3", "--json", folder.file("s.json")});
  Process trainer =
      client(address_of(host), "trainer", {"--json", folder.file("c.json")}, "replay:" + motion + ",scale=1,end=loop");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(folder.json("c.json")["ended_by"], "done");
  EXPECT_NE(trainer.err().find("m.csv"), std::string::npos) << trainer.err();
  const Json device = folder.json("c.json")["device_statistics"];
  std::uint64_t held = 0;
  for (const Json& bucket : device["round_trip_ms"]["buckets"]) held += bucket["count"].get<std::uint64_t>();
  EXPECT_EQ(held, device["exchanges"].get<std::uint64_t>()) << device.dump(1);
  EXPECT_NE(trainer.err().find("round trip: p50 "), std::string::npos) << trainer.err();
  EXPECT_GT(folder.json("s.json")["seats"][0]["speed_peak_m_s"].get<double>(), 0.01) << "it moved";
}

TEST(ReplayLive, NamesAFileThatIsNotThere) {
  Process trainer = client("127.0.0.1:9", "trainer", {"--timeout", "0.2"}, "replay:/no/such/file.csv");
  EXPECT_EQ(trainer.wait(), 2);
  EXPECT_NE(trainer.err().find("/no/such/file.csv"), std::string::npos) << trainer.err();
}

TEST(OpenHapticsLive, SaysThatTheVendorsLibraryIsMissing) {
  Process trainer =
      client("127.0.0.1:9", "trainer", {"--timeout", "0.2"}, "openhaptics:left,library=/no/such/libHD.so");
  EXPECT_EQ(trainer.wait(), 1);
  EXPECT_NE(trainer.err().find("Install the vendor's OpenHaptics"), std::string::npos) << trainer.err();
}

TEST(ReplayLive, RejectsAMotionOutsideTheWorkspaceBeforeItConnects) {
  const Folder folder;
  const std::string motion = folder.write("wide.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n1,0,0.3,0\n2,0,0,0\n");
  Process trainer = client("127.0.0.1:9", "trainer", {}, "replay:" + motion + ",scale=1");
  EXPECT_EQ(trainer.wait(), 2);
  EXPECT_NE(trainer.err().find("wide.csv:2: y of the device = -0.15 m"), std::string::npos) << trainer.err();
  EXPECT_NE(trainer.err().find("[-0.1, 0.1] m"), std::string::npos) << trainer.err();
}

TEST(DeviceSpecLive, ReportsAllErrorsTogether) {
  const Folder folder;
  const std::string file = folder.write("mine.textproto", "falcon {\n  peak_n: 99\n}\n");
  const std::string words = "falcon:prot=1,calibration=" + file + ",firmware=/no/such.bin";
  for (Words command : {Words{TANDEM_CLIENT, "join", "--server", "127.0.0.1:9", "--seat", "trainer", "--duration", "-1",
                              "--device", words},
                        Words{TANDEM_CLIENT, "doctor", "--seconds", "nan", "--device", words},
                        Words{TANDEM_CLIENT, "calibrate", "--mass", "-1", "--device", words}}) {
    Process process{command};
    EXPECT_EQ(process.wait(), 2) << command[1];
    for (const char* part : {"has no option 'prot'", "mine.textproto:2:", "/no/such.bin", "4 mistakes"})
      EXPECT_NE(process.err().find(part), std::string::npos) << command[1] << ": " << part << "\n" << process.err();
  }
}

TEST(Calibrate, RejectsAMassThatTheMotorsCannotHold) {
  Process process{Words{TANDEM_CLIENT, "calibrate", "--device", "falcon", "--mass", "0.5", "--orientation", "supine"}};
  EXPECT_EQ(process.wait(), 2);
  EXPECT_NE(process.err().find("--mass: 0.5 kg takes 4.9 N"), std::string::npos) << process.err();
  EXPECT_NE(process.err().find("Begin with 0.02 and 0.03"), std::string::npos) << process.err();
}

TEST(Calibrate, RejectsAnUnknownOrientation) {
  Process process{
      Words{TANDEM_CLIENT, "calibrate", "--device", "falcon", "--mass", "0.02", "--orientation", "sideways"}};
  EXPECT_EQ(process.wait(), 2);
  EXPECT_NE(process.err().find("--orientation: \"sideways\" is not an orientation: must be upright or supine"),
            std::string::npos)
      << process.err();
}

TEST(Doctor, InstallsItsRulesIntoAnotherRoot) {
  const Folder folder;
  Process process{Words{TANDEM_CLIENT, "doctor", "--install-udev", "--root", folder.file("root")}};
  EXPECT_EQ(process.wait(), 0) << process.err();
  const std::string rules = folder.read("root/etc/udev/rules.d/70-tandem.rules");
  for (const char* part : {"\"0403\", ATTR{idProduct}==\"cb48\"", "*:1234:0006.*", "*:046D:C626.*", "*:256F:*"})
    EXPECT_NE(rules.find(part), std::string::npos) << part << "\n" << rules;
  std::istringstream lines(rules);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.starts_with('#') || line.starts_with("SUBSYSTEM==")) << line;
  folder.write("file", "");
  Process cannot{Words{TANDEM_CLIENT, "doctor", "--install-udev", "--root", folder.file("file")}};
  EXPECT_EQ(cannot.wait(), 1);
  EXPECT_NE(cannot.err().find("cannot be written"), std::string::npos) << cannot.err();
  Process alone{Words{TANDEM_CLIENT, "doctor", "--root", folder.file("root")}};
  EXPECT_EQ(alone.wait(), 2);
}

// sudo searches only the folders of its secure_path, so the advice names the program with its folder.
TEST(Doctor, AdvisesUsersToInstallTheRulesByTheProgramsFullPath) {
  Words words{TANDEM_CLIENT, "doctor", "--install-udev"};
  if (geteuid() == 0) words.insert(words.begin(), {"/usr/bin/setpriv", "--reuid=65534", "--clear-groups"});
  Process process{words};
  const auto code = process.wait();
  if (geteuid() == 0 && (code == 126 || code == 127)) GTEST_SKIP() << "a user may not run it here: " << process.err();
  EXPECT_EQ(code, 1) << process.err();
  std::string text = process.err();
  std::erase_if(text, [](char c) { return c == '\n' || c == '\\' || c == ' '; });  // lines are wrapped
  EXPECT_NE(text.find("Runitasroot:sudo" + std::string(TANDEM_CLIENT) + "doctor--install-udev"), std::string::npos)
      << process.err();
}

TEST(Doctor, NamesTheLibrariesItUses) {
  Process process{Words{TANDEM_CLIENT, "doctor"}};
  EXPECT_TRUE(process.wait().has_value());
  for (const char* part : {"libusb 1.", "hidapi 0.", "evdev of Linux"})
    EXPECT_NE(process.out().find(part), std::string::npos) << process.out();
}

}  // namespace
}  // namespace tandem::test

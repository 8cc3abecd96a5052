// Devices without motors at a real session: a recorded motion as a device leads a follower.
#include <gtest/gtest.h>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

TEST(ReplayLive, LeadsASession) {
  const Folder folder;
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  for (int i = 0; i <= 60; ++i) csv += std::to_string(0.1 * i) + "," + (i / 10 % 2 == 0 ? "0" : "0.02") + ",0,0\n";
  const std::string motion = folder.write("m.csv", csv);
  Process host = hosting("one_axis", {"--duration", "3", "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")}, "replay:" + motion + ",scale=1,end=loop");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(folder.json("c.json")["ended_by"], "done");
  EXPECT_NE(trainer.err().find("m.csv"), std::string::npos) << trainer.err();
  EXPECT_GT(folder.json("s.json")["seats"][0]["speed_peak_m_s"].get<double>(), 0.01) << "it moved";
}

TEST(ReplayLive, NamesAFileThatIsNotThere) {
  Process trainer = client("127.0.0.1:9", "trainer", {"--patience", "0.2"}, "replay:/no/such/file.csv");
  EXPECT_EQ(trainer.wait(), 2);
  EXPECT_NE(trainer.err().find("/no/such/file.csv"), std::string::npos) << trainer.err();
}

TEST(OpenHapticsLive, SaysThatTheVendorsLibraryIsMissing) {
  Process trainer = client("127.0.0.1:9", "trainer", {"--patience", "0.2"}, "openhaptics:left,library=/no/such/libHD.so");
  EXPECT_EQ(trainer.wait(), 1);
  EXPECT_NE(trainer.err().find("Install the vendor's OpenHaptics"), std::string::npos) << trainer.err();
}

}  // namespace
}  // namespace tandem::test

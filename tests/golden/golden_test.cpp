// Compares whole sessions with stored text files. A difference is either an intended change of behaviour or a
// regression. TANDEM_UPDATE_GOLDEN=1 writes the files again.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

/// Returns authority, tips and forces as text, twice a second, in tenths of a millimetre and hundredths of a newton. At
/// this resolution the text shows changes of behaviour, but not the last bit of a compiler's arithmetic.
std::string told(const SceneSpec& scene, const netsim::SimpleNetwork& net) {
  std::string out = "t alpha x[mm] y z f_out[N] ... per master, slave x y z f_env\n";
  const auto r = test::run(scene, net, 1, [&](netsim::Simulation& w) {
    const auto& record = w.record();
    if (!record.running || record.tick % 500 != 0) return;
    char text[128];
    std::snprintf(text, sizeof text, "%4.1f", record.tick / scene.tick_hz);
    out += text;
    const auto number = [&](double value, int decimals) {
      std::snprintf(text, sizeof text, " %.*f", decimals, value + 0.0 == 0 ? 0.0 : value);
      const std::string shown = text;
      out += shown.find_first_of("123456789") == std::string::npos && shown[1] == '-' ? " " + shown.substr(2) : shown;
    };
    for (std::size_t i = 0; i < scene.masters(); ++i) {
      number(record.seats[i].alpha, 2);
      for (const double x : record.seats[i].x) number(1e3 * x, 1);
      for (const double f : record.seats[i].f_out) number(f, 2);
    }
    for (const double x : record.tools[0].x) number(1e3 * x, 1);
    for (const double f : record.tools[0].f_env) number(f, 2);
    out += "\n";
  });
  EXPECT_TRUE(r.report.passed);
  return out;
}

void expect_golden(const std::string& name, const std::string& now) {
  const std::string path = std::string(TANDEM_GOLDEN_DIR) + "/" + name + ".txt";
  if (std::getenv("TANDEM_UPDATE_GOLDEN") != nullptr) std::ofstream{path} << now;
  std::ifstream in{path};
  std::ostringstream before;
  before << in.rdbuf();
  std::istringstream a{before.str()}, b{now};
  std::string was, is;
  int line = 0;
  while (++line, static_cast<bool>(std::getline(a, was)) | static_cast<bool>(std::getline(b, is)))
    ASSERT_EQ(was, is) << path << ":" << line << "; if meant: TANDEM_UPDATE_GOLDEN=1";
}

// Written again on 2026-11-23, when the shipped scenes changed to law REPLICA. The previous texts are the files that
// end in `_set_position`, unchanged.
TEST(Golden, ReproducesFreeMotion) {
  expect_golden("free_motion", told(test::shipped("free_motion"), {}));
  expect_golden("free_motion_set_position", told(test::set_position("free_motion"), {}));
}

TEST(Golden, ReproducesContactOverABadNetwork) {
  expect_golden("contact_bad_network", told(test::shipped("contact"), test::delayed(20, 5, 5)));
  expect_golden("contact_bad_network_set_position", told(test::set_position("contact"), test::delayed(20, 5, 5)));
}

}  // namespace
}  // namespace tandem

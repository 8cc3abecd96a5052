#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/proto/text/bad_scene.h"

/// Extreme numbers in scene files: each is accepted with its value, or refused with key, value and allowed range.
/// tests/EXTREMES.md lists them.
namespace tandem {
namespace {

using namespace bad_scene;

struct Key {
  const char* path;    ///< as in an error
  const char* from;    ///< in the valid scene
  const char* before;  ///< replaces it, with the value behind it
  const char* after;
  double lo, hi;  ///< range
  bool lo_excluded;
  const char* range;  ///< in words
};
constexpr Key kKeys[] = {
    {"channel.k_n_m", "version: 1\n", "version: 1\nchannel { k_min_n_m: 1e-6 k_n_m: ", " }\n", 0, 1e5, true,
     "(0, 1e5] N/m"},
    {"channel.k_delay_n_s_m", "version: 1\n", "version: 1\nchannel { k_delay_n_s_m: ", " }\n", 0, 1e4, true,
     "(0, 10000] N s/m"},
    {"channel.b_delay", "version: 1\n", "version: 1\nchannel { b_delay: ", " }\n", 0, 10, false, "[0, 10]"},
    {"channel.b_rel_n_s_m", "version: 1\n", "version: 1\nchannel { b_rel_n_s_m: ", " }\n", 0, 100, true,
     "(0, 100] N s/m"},
    {"device_coupling.b_n_s_m", "k_c_n_m: 400", "k_c_n_m: 400 b_n_s_m: ", "", 0, 1e3, false, "[0, 1000] N s/m"},
    {"device_coupling.m_c_kg", "k_c_n_m: 400", "k_c_n_m: 400 m_c_kg: ", "", 1e-4, 10, false, "[1e-4, 10] kg"},
    {"tool[0].m_s_kg", "slave { model", "m_s_kg: ", " slave { model", 1e-4, 10, false, "[1e-4, 10] kg"},
    {"tool[0].b_s_n_s_m", "slave { model", "b_s_n_s_m: ", " slave { model", 0, 1e3, false, "[0, 1000] N s/m"},
    {"seat[1].hand.k_n_m", "model: RELAXED", "model: RELAXED k_n_m: ", "", 0, 1e5, false, "[0, 1e5] N/m"},
    {"seat[1].hand.m_kg", "model: RELAXED", "model: RELAXED m_kg: ", "", 0, 10, false, "[0, 10] kg"},
    {"tick_hz", "version: 1\n", "version: 1\nunsafe_gains: true tick_hz: ", "\n", 100, 10000, false, "[100, 10000] Hz"},
    {"gate.loop_age_max_ms", "version: 1\n", "version: 1\ngate { latch: false loop_age_max_ms: ", " }\n", 20, 2500,
     false, "[20, 2500] ms"},
    {"authority[0].alpha", "alpha: 1 }\ntimeline", "alpha: ", " }\ntimeline", 0, 1, false, "[0, 1]"},
};
const std::vector<std::string> kValues{"1e-324", "5e-324", "1e-12", "1e-9", "1e-6",  "1e-3",          "0.1", "1",
                                       "1e3",    "1e5",    "1e6",   "1e8",  "1e300", "1e400",         "0",   "-0",
                                       "-1e-9",  "-1e8",   "nan",   "inf",  "-inf",  "0.999999999999"};

TEST(ExtremesAtLoad, AreAcceptedOrRefusedWithKeyValueAndRange) {
  int accepted = 0, refused = 0;
  for (const Key& key : kKeys) {
    for (const std::string& value : kValues) {
      SCOPED_TRACE(std::string(key.path) + ": " + value);
      const InputErrors errors = errors_of(with(key.from, key.before + value + key.after));
      const double number = std::strtod(value.c_str(), nullptr);
      const bool readable = std::isfinite(number) && value != "1e-324";
      const bool inside = readable && number <= key.hi && (key.lo_excluded ? number > key.lo : number >= key.lo);
      if (errors.empty()) {
        EXPECT_TRUE(inside);
        ++accepted;
        continue;
      }
      ++refused;
      const std::string words = to_text(errors);
      const std::string_view path = key.path;  // a rule between keys may name the other one first
      EXPECT_NE(words.find(path.substr(path.rfind('.') + 1)), std::string::npos) << words;
      if (!readable) {
        EXPECT_NE(words.find("finite number"), std::string::npos) << words;
        EXPECT_NE(words.find(value), std::string::npos) << words;
      } else if (!inside) {
        EXPECT_NE(words.find(std::string("must be in ") + key.range), std::string::npos) << words;
      } else {
        // A rule between keys: the sum of authorities, or a stiffness below another one.
        EXPECT_NE(words.find("must"), std::string::npos) << words;
      }
    }
  }
  std::printf("[  extremes] %d values accepted, %d refused\n", accepted, refused);
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 100);
}

TEST(ExtremesAtLoad, RefuseASessionOfMoreTicksThanTheWireCounts) {
  EXPECT_TRUE(errors_of(with("duration_s: 18", "duration_s: 3e6")).empty()) << "3e9 ticks";
  expect_one(with("duration_s: 18", "tick_hz: 10000 unsafe_gains: true duration_s: @3e6"), "duration_s",
             "must be at most 429496 s at tick_hz = 10000");
  EXPECT_TRUE(errors_of(with("duration_s: 18", "tick_hz: 10000 unsafe_gains: true duration_s: 429496")).empty());
}

}  // namespace
}  // namespace tandem

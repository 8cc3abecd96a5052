#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace tandem::directory::test {

/// First seed of the schedules: TANDEM_DIRECTORY_FIRST, or 1.
inline std::uint64_t first_seed() {
  const char* text = std::getenv("TANDEM_DIRECTORY_FIRST");
  return text == nullptr ? 1 : std::strtoull(text, nullptr, 10);
}

/// Line with the command that runs the present test again from this seed on.
/// @param program  name of the test's program
inline std::string again(std::uint64_t seed, const std::string& program) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  return "\nAgain: TANDEM_DIRECTORY_FIRST=" + std::to_string(seed) + " build/release/bin/" + program +
         " --gtest_filter=" + test->test_suite_name() + "." + test->name();
}

}  // namespace tandem::directory::test

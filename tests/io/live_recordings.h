#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include "tests/io/programs.h"
#include "tests/io/recording_samples.h"

/// Real programs that record sessions, and their files.
namespace tandem::test {

inline constexpr std::chrono::seconds kLimit{60};  ///< against hanging

/// Waits until a condition holds. @return false: it did not within kLimit
inline bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kLimit; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

inline Process command(const std::string& program, Words words) {
  words.insert(words.begin(), program);
  return Process(std::move(words));
}
/// `tandem-client control`, beside a server with ephemeral keys.
inline Process control(const std::string& address, Words words) {
  words.insert(words.begin(), {"control", "--server", address});
  return command(TANDEM_CLIENT, std::move(words));
}
/// Status of the only session of a server.
inline Json status_of(const std::string& address) {
  Process asked = control(address, {"--json", "status"});
  EXPECT_EQ(asked.wait(), 0) << asked.err();
  return Json::parse(asked.out(), nullptr, false);
}

/// The recording in a file; empty, with a failed expectation, if it cannot be read.
inline Lesson read(const Folder& folder, const std::string& name) {
  auto lesson = server::test::lesson_of(folder.read(name));
  EXPECT_TRUE(lesson) << name << ": " << lesson.error();
  return lesson ? std::move(*lesson) : Lesson{};
}

}  // namespace tandem::test

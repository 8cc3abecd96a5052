#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/process.h"

namespace tandem::test {

struct Done {
  int code = -1;
  std::string text;  ///< stdout and stderr
};

/// Runs a shell command. The time-out is 20 times Process::kTimeout, because commands may compress packages or install
/// a system.
inline Done shell(const std::string& command) {
  constexpr int kPatienceTimes = 20;
  Process process{{"/bin/sh", "-c", command + " 2>&1"}};
  std::optional<int> code;
  for (int i = 0; i < kPatienceTimes && !code; ++i) code = process.wait();
  return {code.value_or(-1), process.out()};
}

inline bool there(const std::string& program) { return shell("command -v " + program).code == 0; }
inline std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace tandem::test

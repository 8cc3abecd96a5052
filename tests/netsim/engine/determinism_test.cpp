// Row "determinism" of the validation matrix: equal decisions from two runs, and with and without other flows. Further
// builds of the engine's files: without optimisation, with debug checks, and by another compiler.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/common/base/counts.h"
#include "tests/support/process.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

struct Done {
  int code = -1;
  std::string out, err;
};

Done shell(const std::string& command) {
  Process process{{"/bin/sh", "-c", command}};
  std::optional<int> code;
  for (int i = 0; i < 20 && !code; ++i) code = process.wait();  // times Process::kTimeout: cold caches, busy machine
  return {code.value_or(-1), process.out(), process.err()};
}

/// Returns the fingerprints of this build.
std::string own_hashes(const std::string& options = {}) {
  const Done done = shell(std::string(TANDEM_ENGINE_HASH) + " " + options);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("\nall "), std::string::npos) << done.out;
  EXPECT_EQ(done.out.find("unusable"), std::string::npos) << done.out;
  return done.out;
}

/// Builds the engine's files and the program with `compiler` in a separate folder, reusing the cache. Two jobs at a
/// time.
std::string built_hashes(const std::string& name, const std::string& compiler, const std::string& flags) {
  const fs::path folder = fs::path{TANDEM_BINARY_DIR} / "determinism" / name;
  fs::create_directories(folder);
  const std::string root = TANDEM_SOURCE_DIR;
  const std::string compile =
      std::string(TANDEM_LAUNCHER) + " " + compiler + " -std=c++2b -ffp-contract=off " + flags + " -I " + root;
  const Done built = shell("cd '" + folder.string() + "' && rm -f *.o && printf '%s\\n' " + TANDEM_ENGINE_FILES + " " +
                           root + "/tests/netsim/engine/engine_hash.cpp | xargs -P 2 -I FILE sh -c '" + compile +
                           " -c FILE -o $(basename FILE).o' && " + compiler + " *.o -o engine_hash && ./engine_hash");
  EXPECT_EQ(built.code, 0) << built.err << built.out;
  return built.out;
}

TEST(Determinism, TwoRunsDecideTheSame) { EXPECT_EQ(own_hashes(), own_hashes()); }

TEST(Determinism, IgnoresOtherFlowsAndTheirTraffic) {
  const std::string alone = own_hashes();
  EXPECT_EQ(own_hashes("--extra-flow"), alone);
  EXPECT_EQ(own_hashes("--extra-flow --other-bytes"), alone);
}

TEST(Determinism, HoldsWithoutOptimisationAndWithChecks) {
  if (reduced_counts())
    GTEST_SKIP() << "belongs to ./test --full (TANDEM_COUNTS=full); another compiler is tried always";
  EXPECT_EQ(built_hashes("debug", TANDEM_COMPILER, "-O0 -DTANDEM_DEBUG=1 -D_GLIBCXX_ASSERTIONS"), own_hashes());
}

/// Returns whether the compiler supports the required C++23 on this machine; clang before 16 has no std::expected here.
bool understands(const std::string& compiler) {
  return shell("command -v " + compiler +
               " && printf '#include <expected>\nstd::expected<int, int> f() { return 1; }\n' | " + compiler +
               " -std=c++2b -fsyntax-only -x c++ -")
             .code == 0;
}

TEST(Determinism, HoldsForAnotherCompiler) {
  for (const std::string compiler : {"clang++-22", "clang++-19", "clang++-16", "clang++"}) {
    if (!understands(compiler)) continue;
    const Done version = shell(compiler + " --version");
    std::printf("[          ] %s\n", version.out.substr(0, version.out.find('\n')).c_str());
    EXPECT_EQ(built_hashes("clang", compiler, "-O2 -DNDEBUG"), own_hashes());
    return;
  }
  GTEST_SKIP() << "no clang++ that knows C++23 is installed (Debian 12: clang-19)";
}

}  // namespace
}  // namespace tandem::test

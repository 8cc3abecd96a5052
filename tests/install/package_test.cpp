// Tests `cmake --install` as another project uses it: installs this build, moves the result to another folder, builds
// tests/install/sample with it and runs the sample's tests. Needs no network and no input.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/process.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

constexpr int kPatienceTimes = 12;  // [Process::kPatience] time-out of a command: a build on a busy machine is slow

struct Done {
  int code = -1;
  std::string text;  ///< stdout and stderr
};

Done shell(const std::string& command) {
  Process process{{"/bin/sh", "-c", command + " 2>&1"}};
  std::optional<int> code;
  for (int i = 0; i < kPatienceTimes && !code; ++i) code = process.wait();
  return {code.value_or(-1), process.out()};
}

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

const fs::path kPlace = fs::path{TANDEM_BINARY_DIR} / "package";

/// Installs into a folder, moves the folder and returns its new path.
fs::path installed_and_moved() {
  const fs::path first = kPlace / "first", moved = kPlace / "moved";
  fs::remove_all(kPlace);
  const Done install =
      shell(quoted(TANDEM_CMAKE) + " --install " + quoted(TANDEM_BINARY_DIR) + " --prefix " + quoted(first));
  EXPECT_EQ(install.code, 0) << install.text;
  fs::rename(first, moved);
  return moved;
}

void check_texts(const fs::path& prefix) {
  std::size_t scripts = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
    if (entry.path().extension() != ".cmake") continue;
    ++scripts;
    const std::string text = content_of(entry.path());
    for (const std::string leak : {TANDEM_SOURCE_DIR, TANDEM_BINARY_DIR, "-Werror", "-Wall", "tandem_options"})
      EXPECT_EQ(text.find(leak), std::string::npos) << entry.path() << " leaks " << leak;
  }
  EXPECT_GE(scripts, 5U);
}

/// Checks that the installed headers find all their includes and compile without warnings (-Wall -Wextra -Wpedantic).
void check_headers(const fs::path& include) {
  std::ofstream all(kPlace / "all_headers.cpp");
  std::size_t headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(include)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = fs::relative(entry.path(), include).string();
    EXPECT_TRUE(name.ends_with(".h")) << name;
    for (const std::string folder : {"/app/", "/io/", "/demo/", ".pb.h"})
      EXPECT_EQ(name.find(folder), std::string::npos) << name;
    all << "#include \"" << name << "\"\n";
    ++headers;
  }
  all.close();
  EXPECT_GT(headers, 20U);
  const Done done =
      shell(std::string(TANDEM_COMPILER) + " -std=c++23 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -I " +
            quoted(include) + " -isystem /usr/include/eigen3 " + quoted(kPlace / "all_headers.cpp"));
  EXPECT_EQ(done.code, 0) << done.text;
}

TEST(Package, WorksForAnotherProjectAfterItWasMoved) {
  if (std::string_view{TANDEM_SANITIZE} != "") GTEST_SKIP() << "a build with sanitizers is not for installing";
  const fs::path prefix = installed_and_moved();
  ASSERT_FALSE(HasFailure());
  check_texts(prefix);
  check_headers(prefix / "include" / "tandem");
  for (const char* program : {"tandem-server", "tandem-client", "tandem-netsim", "tandem-demo"}) {
    const Done version = shell(quoted(prefix / "bin" / program) + " --version");
    EXPECT_EQ(version.code, 0) << program << version.text;
    EXPECT_NE(version.text.find(TANDEM_VERSION), std::string::npos) << program << version.text;
  }

  const fs::path build = kPlace / "sample";
  const std::string generator = quoted(TANDEM_GENERATOR);
  const Done configured =
      shell(quoted(TANDEM_CMAKE) + " -G " + generator + " -S " +
            quoted(fs::path{TANDEM_SOURCE_DIR} / "tests/install/sample") + " -B " + quoted(build) +
            " -DCMAKE_CXX_COMPILER=" + TANDEM_COMPILER + " -DCMAKE_CXX_COMPILER_LAUNCHER=" + quoted(TANDEM_LAUNCHER) +
            " -DCMAKE_PREFIX_PATH=" + quoted(prefix));
  ASSERT_EQ(configured.code, 0) << configured.text;
  const Done built = shell(quoted(TANDEM_CMAKE) + " --build " + quoted(build));
  ASSERT_EQ(built.code, 0) << built.text;
  const Done tested = shell(quoted(TANDEM_CTEST) + " --output-on-failure --test-dir " + quoted(build));
  EXPECT_EQ(tested.code, 0) << tested.text;
  EXPECT_NE(tested.text.find("100% tests passed, 0 tests failed out of 5"), std::string::npos) << tested.text;

  // A failing test of the sample prints its network and seed. The printed command reproduces the failure.
  const Done failed = shell("cd " + quoted(build) + " && TOY_FAILS=1 ./toy_test --gtest_filter=Toy.Fails*");
  EXPECT_EQ(failed.code, 1) << failed.text;
  const std::string mark = "again: ";
  const std::size_t at = failed.text.find("[  REPLAY  ] network ideal version 1, seed 3; " + mark);
  ASSERT_NE(at, std::string::npos) << failed.text;
  const std::size_t command = failed.text.find(mark, at) + mark.size();
  const std::string again = failed.text.substr(command, failed.text.find('\n', command) - command);
  EXPECT_EQ(again, "TANDEM_SEED=3 ./toy_test --gtest_filter=Toy.FailsWhenAskedTo");
  EXPECT_EQ(shell("cd " + quoted(build) + " && TOY_FAILS=1 " + again).code, 1);

  // find_package rejects a request for another version.
  std::ofstream{kPlace / "CMakeLists.txt"} << "cmake_minimum_required(VERSION 3.25)\nproject(Late LANGUAGES CXX)\n"
                                              "find_package(Tandem 99.0 REQUIRED)\n";
  const Done late = shell(quoted(TANDEM_CMAKE) + " -G " + generator + " -S " + quoted(kPlace) + " -B " +
                          quoted(kPlace / "late") + " -DCMAKE_PREFIX_PATH=" + quoted(prefix));
  EXPECT_NE(late.code, 0) << late.text;
  EXPECT_NE(late.text.find("99.0"), std::string::npos) << late.text;
}

}  // namespace
}  // namespace tandem::test

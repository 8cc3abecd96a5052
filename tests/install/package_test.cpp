// Tests `cmake --install` as another project uses it: installs this build, moves the result to another folder, builds
// tests/install/sample with it and runs the sample's tests. Needs no network and no input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/install/installed_package.h"

namespace tandem::test {
namespace {

const fs::path kPlace = package_folder("sample");

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

/// Checks that the libraries contain machine code only: objects for optimisation at link time fit one version of g++.
void check_libraries(const fs::path& folder) {
  std::size_t libraries = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".a") continue;
    ++libraries;
    const Done sections = shell("readelf --section-headers --wide " + quoted(entry.path()));
    EXPECT_NE(sections.text.find(".text"), std::string::npos) << entry.path() << sections.text;
    EXPECT_EQ(sections.text.find(".gnu.lto"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(libraries, 5U);
}

/// Checks that the public headers are the only ones outside tandem/detail. Checks that each installed header finds all
/// its includes and compiles without warnings (-Wall -Wextra -Wpedantic), with the folder `include` alone.
void check_headers(const fs::path& include) {
  std::ofstream all(kPlace / "all_headers.cpp");
  std::vector<std::string> shown;
  std::size_t headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(include)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = fs::relative(entry.path(), include).string();
    EXPECT_TRUE(name.ends_with(".h")) << name;
    for (const std::string folder : {"/demo/", "/proxy/", ".pb.h", "/server/app/", "/common/io/", "/common/auth/"})
      EXPECT_EQ(name.find(folder), std::string::npos) << name;
    if (!name.starts_with("tandem/detail/")) shown.push_back(name);
    all << "#include \"" << name << "\"\n";
    ++headers;
  }
  all.close();
  std::ranges::sort(shown);
  EXPECT_EQ(shown, (std::vector<std::string>{"tandem/client.h", "tandem/control.h", "tandem/hal.h", "tandem/netsim.h",
                                             "tandem/testing.h"}));
  EXPECT_GT(headers, 20U);
  EXPECT_LE(headers, 85U) << "the public headers show more of the sources than before";
  const Done done =
      shell(std::string(TANDEM_COMPILER) + " -std=c++23 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -I " +
            quoted(include) + " -isystem /usr/include/eigen3 " + quoted(kPlace / "all_headers.cpp"));
  EXPECT_EQ(done.code, 0) << done.text;
}

/// Writes a project that calls find_package with `arguments`, requires the targets in `targets` and prints all imported
/// targets of Tandem. @return its output
Done find_package(const std::string& arguments, const fs::path& prefix) {
  const fs::path project = kPlace / "find";
  fs::remove_all(project);
  fs::create_directories(project);
  std::ofstream{project / "CMakeLists.txt"} << "cmake_minimum_required(VERSION 3.25)\nproject(Find LANGUAGES CXX)\n"
                                               "find_package(Tandem "
                                            << arguments
                                            << ")\nget_property(all DIRECTORY PROPERTY IMPORTED_TARGETS)\n"
                                               "list(FILTER all INCLUDE REGEX [Tt]andem)\nlist(SORT all)\n"
                                               "message(STATUS \"targets: ${all}.\")\n";
  return shell(configure_command(project, project / "build", prefix));
}

TEST(Package, WorksForAnotherProjectAfterItWasMoved) {
  if (std::string_view{TANDEM_SANITIZE} != "") GTEST_SKIP() << "a build with sanitizers is not for installing";
  const fs::path prefix = installed_and_moved(kPlace);
  ASSERT_FALSE(HasFailure());
  check_texts(prefix);
  check_headers(prefix / "include");
  check_libraries(prefix / "lib");
  for (const char* program : {"tandem-server", "tandem-client", "tandem-netsim", "tandem-console", "tandem-demo"}) {
    const Done version = shell(quoted(prefix / "bin" / program) + " --version");
    EXPECT_EQ(version.code, 0) << program << version.text;
    EXPECT_NE(version.text.find(TANDEM_VERSION), std::string::npos) << program << version.text;
  }

  const fs::path build = kPlace / "build";
  ASSERT_NO_FATAL_FAILURE(build_project(fs::path{TANDEM_SOURCE_DIR} / "tests/install/sample", build, prefix));
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

  // The package exports the public targets and no other. A component brings those that it links.
  for (const auto& [components, targets] :
       {std::pair{"REQUIRED", "Tandem::client;Tandem::control;Tandem::hal;Tandem::netsim;Tandem::testing"},
        std::pair{"REQUIRED COMPONENTS control", "Tandem::control"},
        std::pair{"REQUIRED COMPONENTS hal", "Tandem::control;Tandem::hal"},
        std::pair{"REQUIRED COMPONENTS client", "Tandem::client;Tandem::control;Tandem::hal"}}) {
    const Done found = find_package(components, prefix);
    EXPECT_EQ(found.code, 0) << found.text;
    EXPECT_NE(found.text.find("targets: " + std::string(targets) + "."), std::string::npos) << found.text;
  }
  const Done unknown = find_package("REQUIRED COMPONENTS server", prefix);
  EXPECT_NE(unknown.code, 0) << unknown.text;
  EXPECT_NE(unknown.text.find("no component server"), std::string::npos) << unknown.text;
  // find_package rejects a request for another version.
  const Done late = find_package("99.0 REQUIRED", prefix);
  EXPECT_NE(late.code, 0) << late.text;
  EXPECT_NE(late.text.find("99.0"), std::string::npos) << late.text;
}

}  // namespace
}  // namespace tandem::test

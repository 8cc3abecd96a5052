#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/install/shell.h"

/// An installation of this build, for tests that use it as another project does. The CMakeLists.txt of this folder
/// defines the macros.
namespace tandem::test {

namespace fs = std::filesystem;

/// Folder of the test programs' files, removed by `installed_and_moved`.
inline fs::path package_folder(const std::string& name) { return fs::path{TANDEM_BINARY_DIR} / "package" / name; }

inline std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Installs this build into `folder`/first, renames that to `folder`/moved and returns the new path. Removes all other
/// content of `folder`.
inline fs::path installed_and_moved(const fs::path& folder) {
  const fs::path first = folder / "first", moved = folder / "moved";
  fs::remove_all(folder);
  const Done install =
      shell(quoted(TANDEM_CMAKE) + " --install " + quoted(TANDEM_BINARY_DIR) + " --prefix " + quoted(first));
  EXPECT_EQ(install.code, 0) << install.text;
  fs::rename(first, moved);
  return moved;
}

/// Returns the command that configures the project in `source` with the package in `prefix`.
inline std::string configure_command(const fs::path& source, const fs::path& build, const fs::path& prefix) {
  return quoted(TANDEM_CMAKE) + " -G " + quoted(TANDEM_GENERATOR) + " -S " + quoted(source) + " -B " + quoted(build) +
         " -DCMAKE_CXX_COMPILER=" + TANDEM_COMPILER + " -DCMAKE_CXX_COMPILER_LAUNCHER=" + quoted(TANDEM_LAUNCHER) +
         " -DCMAKE_PREFIX_PATH=" + quoted(prefix);
}

/// Configures and builds the project in `source` with the package in `prefix`.
inline void build_project(const fs::path& source, const fs::path& build, const fs::path& prefix) {
  const Done configured = shell(configure_command(source, build, prefix));
  ASSERT_EQ(configured.code, 0) << configured.text;
  const Done built = shell(quoted(TANDEM_CMAKE) + " --build " + quoted(build));
  ASSERT_EQ(built.code, 0) << built.text;
}

}  // namespace tandem::test

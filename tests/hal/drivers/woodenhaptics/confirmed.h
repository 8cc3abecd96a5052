#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "client/diagnostics/motor_registry.h"
#include "common/transport/digest.h"

namespace tandem::test {

/// Creates a state directory in which the motors of one board are confirmed, as `doctor --confirm-motors` writes it.
/// @param folder  created for its owner only, if missing
/// @param device  name used by the backend: "serial:0001"
/// @param file    the device file that the test uses
/// @return `folder`
inline std::string confirmed_motors(const std::string& folder, const std::string& device, const std::string& file) {
  namespace fs = std::filesystem;
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::owner_all);
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  transport::Digest digest;
  digest.add(text.str());
  client::MotorRegistry book;
  book.put({device, digest.hex(), true, 1});
  const fs::path name = fs::path(folder) / "confirmed_motors";
  std::ofstream(name, std::ios::binary) << book.text();
  fs::permissions(name, fs::perms::owner_read | fs::perms::owner_write);
  return folder;
}

}  // namespace tandem::test

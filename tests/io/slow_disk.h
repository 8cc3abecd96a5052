#pragma once

#include <cstdlib>
#include <string>

#include "tests/io/programs.h"

namespace tandem::test {

/// Command line that starts `program` with the disk of slow_disk.cpp.
/// @param control  file with the word that says how the disk is
inline Words on_slow_disk(const std::string& control, const Words& program) {
  const char* const options = std::getenv("ASAN_OPTIONS");
  // The address sanitizer wants to be the first library; its checks work behind this one too.
  Words command{"/usr/bin/env", "LD_PRELOAD=" TANDEM_SLOW_DISK_LIBRARY, "TANDEM_SLOW_DISK=" + control,
                "ASAN_OPTIONS=" + (options == nullptr ? "" : std::string(options) + ":") + "verify_asan_link_order=0"};
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

}  // namespace tandem::test

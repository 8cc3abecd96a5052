#pragma once

#include <array>
#include <string>
#include <string_view>

namespace tandem::test {

/// A file that a state directory may contain, and its form after a restart. A file that is missing here fails the tests
/// in `tests/common/auth/faults`. A contributor who adds a file to a state directory therefore adds its check too
/// (state_check.cpp).
struct StateFile {
  std::string_view name;  ///< `*` at its end: any suffix
  enum class Is {
    kSecret,   ///< created once, read whole, never partial
    kBook,     ///< replaced as a whole
    kLines,    ///< appended to, line by line
    kLock,     ///< empty, for flock
    kMessage,  ///< replaced as a whole, read once, removed
  } is;
};

inline constexpr std::array kStateFiles{
    // of a server
    StateFile{"server_key.pem", StateFile::Is::kSecret},
    StateFile{"server_cert.pem", StateFile::Is::kSecret},
    StateFile{"ticket_key", StateFile::Is::kSecret},
    StateFile{"workstations.textproto", StateFile::Is::kBook},
    StateFile{"codes.textproto", StateFile::Is::kBook},
    StateFile{"serving.textproto", StateFile::Is::kBook},
    StateFile{"lab.checkpoint", StateFile::Is::kBook},
    StateFile{"used_tickets", StateFile::Is::kLines},
    StateFile{"audit.log", StateFile::Is::kLines},
    StateFile{"audit.log.*", StateFile::Is::kLines},
    StateFile{"end_in_s", StateFile::Is::kMessage},
    StateFile{"lock", StateFile::Is::kLock},
    StateFile{"serving.lock", StateFile::Is::kLock},
    // of a workstation
    StateFile{"workstation_key.pem", StateFile::Is::kSecret},
    StateFile{"workstation_cert.pem", StateFile::Is::kSecret},
    StateFile{"servers.textproto", StateFile::Is::kBook},
};

/// @param name  of a file, without its folder  @return nullptr if no check knows the file
[[nodiscard]] constexpr const StateFile* state_file(std::string_view name) noexcept {
  for (const StateFile& file : kStateFiles) {
    const bool any = file.name.ends_with('*');
    if (any ? name.starts_with(file.name.substr(0, file.name.size() - 1)) : name == file.name) return &file;
  }
  return nullptr;
}

/// Parses the name `.NAME.new` of the temporary file that replaces `NAME`. @return NAME; empty for other names
[[nodiscard]] constexpr std::string_view written_beside(std::string_view name) noexcept {
  return name.starts_with('.') && name.ends_with(".new") ? name.substr(1, name.size() - 5) : std::string_view{};
}

}  // namespace tandem::test

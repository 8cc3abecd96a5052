#pragma once

#include <array>
#include <string>
#include <string_view>

namespace tandem::test {

/// Every file that a state folder may hold, and what a restart expects of it. A file that is not listed here fails the tests below
/// `tests/books`: whoever adds a file to a state folder adds its check with it (state_check.cpp).
struct StateFile {
  std::string_view name;  ///< `*` at its end: any number
  enum class Is {
    kSecret,   ///< made once, read whole, and never half
    kBook,     ///< replaced whole
    kLines,    ///< appended to, line by line
    kLock,     ///< empty, for flock
    kMessage,  ///< replaced whole, read once, removed
  } is;
};

inline constexpr std::array kStateFiles{
    // of a server
    StateFile{"server_key.pem", StateFile::Is::kSecret}, StateFile{"server_cert.pem", StateFile::Is::kSecret}, StateFile{"ticket_key", StateFile::Is::kSecret},
    StateFile{"workstations.textproto", StateFile::Is::kBook}, StateFile{"codes.textproto", StateFile::Is::kBook}, StateFile{"serving.textproto", StateFile::Is::kBook},
    StateFile{"lab.checkpoint", StateFile::Is::kBook}, StateFile{"used_tickets", StateFile::Is::kLines}, StateFile{"audit.log", StateFile::Is::kLines},
    StateFile{"audit.log.*", StateFile::Is::kLines}, StateFile{"end_in_s", StateFile::Is::kMessage}, StateFile{"lock", StateFile::Is::kLock},
    StateFile{"serving.lock", StateFile::Is::kLock},
    // of a workstation
    StateFile{"workstation_key.pem", StateFile::Is::kSecret}, StateFile{"workstation_cert.pem", StateFile::Is::kSecret}, StateFile{"servers.textproto", StateFile::Is::kBook},
};

/// @param name  of a file, without its folder  @return null: nobody checks it
[[nodiscard]] constexpr const StateFile* state_file(std::string_view name) noexcept {
  for (const StateFile& file : kStateFiles) {
    const bool any = file.name.ends_with('*');
    if (any ? name.starts_with(file.name.substr(0, file.name.size() - 1)) : name == file.name) return &file;
  }
  return nullptr;
}

/// The file that is written beside `NAME` before it replaces it: `.NAME.new`. @return NAME, empty if it is none
[[nodiscard]] constexpr std::string_view written_beside(std::string_view name) noexcept {
  return name.starts_with('.') && name.ends_with(".new") ? name.substr(1, name.size() - 5) : std::string_view{};
}

}  // namespace tandem::test

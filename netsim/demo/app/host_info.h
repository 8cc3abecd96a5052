#pragma once

#include <filesystem>
#include <string>

namespace tandem::netsim::demo {

/// Returns a description such as "2 cores (AMD EPYC 7B13), Linux 6.1.0-18-amd64, x86_64".
[[nodiscard]] std::string host_text();

/// Returns a date such as "2026-11-21 10:30 UTC".
[[nodiscard]] std::string date_text();

/// Returns the folder that contains this program.
[[nodiscard]] std::filesystem::path own_folder();

/// Returns the file:// link of a path, with the characters escaped that a link may not contain.
[[nodiscard]] std::string file_link(const std::filesystem::path& path);

}  // namespace tandem::netsim::demo

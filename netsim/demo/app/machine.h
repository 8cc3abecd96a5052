#pragma once

#include <filesystem>
#include <string>

namespace tandem::netsim::demo {

/// "2 cores (AMD EPYC 7B13), Linux 6.1.0-18-amd64, x86_64".
[[nodiscard]] std::string machine_text();

/// "2026-11-21 10:30 UTC".
[[nodiscard]] std::string date_text();

/// Folder this program stands in.
[[nodiscard]] std::filesystem::path own_folder();

/// file:// link of a path, with what a link may not contain escaped.
[[nodiscard]] std::string file_link(const std::filesystem::path& path);

}  // namespace tandem::netsim::demo

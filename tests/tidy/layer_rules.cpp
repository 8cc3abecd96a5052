#include "tests/tidy/layer_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>

namespace tandem::tidy {
namespace {

/// Maps a header prefix to its library. An unlisted header with a '/' or ".h" belongs to the operating system.
struct Library {
  std::string_view prefix;
  std::string_view name;
};
constexpr std::array<Library, 26> kLibraries{{{"Eigen/", "Eigen"},
                                              {"unsupported/Eigen/", "Eigen"},
                                              {"asio/", "asio"},
                                              {"asio.hpp", "asio"},
                                              {"spdlog/", "spdlog"},
                                              {"fmt/", "spdlog"},
                                              {"google/protobuf/", "protobuf"},
                                              {"openssl/", "openssl"},
                                              {"CLI/", "CLI11"},
                                              {"nlohmann/", "json"},
                                              {"gtest/", "gtest"},
                                              {"gmock/", "gtest"},
                                              {"benchmark/", "benchmark"},
                                              {"libusb-1.0/", "libusb"},
                                              {"libusb.h", "libusb"},
                                              {"hidapi/", "hidapi"},
                                              {"sodium.h", "sodium"},
                                              {"intel-ipsec-mb.h", "ipsec-mb"},
                                              {"zstd.h", "zstd"},
                                              {"zlib.h", "zlib"},
                                              {"sqlite3.h", "sqlite"},
                                              {"libqhull_r/", "qhull"},
                                              {"prometheus/", "prometheus"},
                                              {"grpcpp/", "grpc"},
                                              {"etcd.grpc.pb.h", "grpc"},
                                              {"boost/", "boost"}}};
constexpr std::string_view kSystem = "system";

constexpr std::array<std::string_view, 8> kTopFolders{"client/", "common/", "hal/",    "netsim/",
                                                      "proto/",  "server/", "tandem/", "tests/"};

bool is_pump(std::string_view path) {
  return has_folder(path, "app") || has_folder(path, "io") || is_within(path, "hal/backends") ||
         is_within(path, "tandem");
}

bool is_free(std::string_view path, std::span<const std::string_view> folders) {
  return std::ranges::any_of(folders, [&](std::string_view f) {
    return f.find('/') == std::string_view::npos ? has_folder(path, f) : is_within(path, f);
  });
}

const Layer* layer_of(std::string_view path) {
  const Layer* best = nullptr;
  for (const Layer& layer : layers()) {
    if (path.starts_with(layer.folder) && (best == nullptr || layer.folder.size() > best->folder.size())) best = &layer;
  }
  return best;
}

/// Returns the library of a header; empty for headers of the C++ library.
std::string_view library_of(std::string_view include) {
  for (const Library& library : kLibraries) {
    if (include.starts_with(library.prefix)) return library.name;
  }
  return include.find('/') != std::string_view::npos || include.ends_with(".h") ? kSystem : std::string_view{};
}

bool is_ours(std::string_view include) {
  return std::ranges::any_of(kTopFolders, [&](std::string_view top) { return include.starts_with(top); });
}

constexpr std::string_view kGeneratedReason = "generated code and headers that show it stay in proto (and tests/proto)";

bool may_see_protobuf(std::string_view path) { return is_within(path, "proto") || is_within(path, "tests/proto"); }

/// Returns the first folder: "server" for server/session/session.h, server/app/main.cpp, ...
std::string_view top_folder(std::string_view path) { return path.substr(0, path.find('/')); }

std::optional<std::string> error_in_own_include(const SourceFile& file, const Layer& layer, const Include& include) {
  const std::string& path = include.path;
  const bool test = is_within(file.path, "tests");
  if (test && is_within(path, "tandem")) return std::nullopt;  // as other projects do, with <>
  if (!include.quoted) return "our own headers are included with quotes";
  if (path.ends_with(".pb.h") && !may_see_protobuf(file.path)) return std::string(kGeneratedReason);
  if (test) return std::nullopt;
  if (is_within(path, "tests")) return "programs do not know their tests";
  if (is_pump(path) && !is_pump(file.path)) return "a core does not know what is in an app or io folder";
  if (is_within(path, "tandem") && !is_within(file.path, "tandem")) return "only other projects include the public API";
  if (has_folder(path, "app") && !is_within(file.path, "server/console/app") && top_folder(path) != "common" &&
      top_folder(path) != top_folder(file.path) && !is_within(file.path, "tandem")) {
    return "an app folder serves its own program";
  }
  if (is_within(path, "hal/backends") && top_folder(file.path) != "hal" && top_folder(file.path) != "client") {
    return "only the client opens hardware; hal/io/open_sim_device.h opens simulated devices";
  }
  if (has_folder(file.path, "app")) return std::nullopt;
  const bool may = std::ranges::any_of(layer.may_include, [&](std::string_view f) { return is_within(path, f); });
  return may ? std::nullopt : std::optional<std::string>(layer.reason);
}

std::optional<std::string> error_in_library_include(const SourceFile& file, const Layer& layer,
                                                    std::string_view library) {
  if (library.empty() || is_within(file.path, "tests") || has_folder(file.path, "app")) return std::nullopt;
  if (std::ranges::find(layer.libraries, library) != layer.libraries.end()) return std::nullopt;
  constexpr std::array<std::string_view, 4> kInIo{"asio", "libusb", "hidapi", kSystem};
  if (has_folder(file.path, "io") && std::ranges::find(kInIo, library) != kInIo.end()) return std::nullopt;
  return (library == kSystem ? "a header of the operating system, for app and io folders only; " : "") +
         std::string(layer.reason);
}

void check_includes(const SourceFile& file, std::vector<Finding>& findings) {
  const Layer* layer = layer_of(file.path);
  for (const Include& include : includes_of(file)) {
    std::optional<std::string> trouble;
    if (layer == nullptr) {
      trouble = "this folder is in no row of the table (tests/tidy/layer_table.cpp)";
    } else if (is_ours(include.path)) {
      trouble = error_in_own_include(file, *layer, include);
    } else if (include.quoted && include.path.ends_with(".inc")) {
      continue;  // data generated into the build folder
    } else if (include.quoted) {
      trouble = "includes name the path from the root, \"common/base/time.h\"; others' headers take <>";
    } else {
      trouble = error_in_library_include(file, *layer, library_of(include.path));
    }
    if (trouble) findings.push_back({file.path, include.line, "includes " + include.path + ": " + *trouble});
  }
}

void check_ban(const SourceFile& file, const Ban& ban, std::vector<Finding>& findings) {
  const auto here = [&](std::string_view folder) { return is_within(file.path, folder); };
  if (!ban.folders.empty() && std::ranges::none_of(ban.folders, here)) return;
  if (is_free(file.path, ban.not_folders)) return;
  if (std::ranges::find(ban.allowed, file.path) != ban.allowed.end()) return;
  const auto report = [&](std::size_t line, std::string_view word) {
    findings.push_back({file.path, line, std::string(word) + ": " + std::string(ban.reason)});
  };
  if (ban.in != Ban::In::kText && !is_cpp(file.path)) return;
  for (const std::string_view word : ban.words) {
    if (ban.in == Ban::In::kInclude) {
      for (const Include& include : includes_of(file)) {
        if (include.path == word) report(include.line, word);
      }
    } else {
      for (const std::size_t line : lines_with(ban.in == Ban::In::kCode ? file.code : file.text, word)) {
        report(line, word);
      }
    }
  }
}

/// Finds tests that print "[ NOT RUN" and return: they would count as passed.
void check_not_run(const SourceFile& file, std::vector<Finding>& findings) {
  std::istringstream lines(file.text);
  bool said = false;
  std::size_t number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (said && begin != std::string::npos && line.compare(begin, 7, "return;") == 0)
      findings.push_back({file.path, number,
                          "a test that returns after printing [ NOT RUN ] counts as passed; GTEST_SKIP() << reason"});
    said = line.find("\"[ NOT RUN") != std::string::npos;
  }
}

}  // namespace

std::vector<Finding> check_layers(const SourceFile& file) {
  std::vector<Finding> findings;
  if (is_cpp(file.path) && is_within(file.path, "tests")) check_not_run(file, findings);
  if (is_cpp(file.path)) {
    check_includes(file, findings);
    const auto lines = static_cast<std::size_t>(std::ranges::count(file.text, '\n'));
    if (lines > kLinesMax) {
      findings.push_back({file.path, 0,
                          std::to_string(lines) + " lines, more than " + std::to_string(kLinesMax) +
                              ": a mechanism wants its own pair of files"});
    }
  }
  for (const Ban& ban : bans()) check_ban(file, ban, findings);
  return findings;
}

std::vector<Finding> check_generated(std::span<const SourceFile> files) {
  std::set<std::string, std::less<>> shows;  // headers of proto that include generated code, directly or indirectly
  bool grew = true;
  while (grew) {
    const std::size_t before = shows.size();
    for (const SourceFile& file : files) {
      if (!is_within(file.path, "proto") || !file.path.ends_with(".h")) continue;
      for (const Include& include : includes_of(file)) {
        const bool generated = include.path.ends_with(".pb.h") || library_of(include.path) == "protobuf";
        if (generated || shows.contains(include.path)) shows.insert(file.path);
      }
    }
    grew = shows.size() > before;
  }
  std::vector<Finding> findings;
  for (const SourceFile& file : files) {
    if (!is_cpp(file.path) || may_see_protobuf(file.path)) continue;
    for (const Include& include : includes_of(file)) {
      if (shows.contains(include.path)) {
        findings.push_back(
            {file.path, include.line, "includes " + include.path + ": " + std::string(kGeneratedReason)});
      }
    }
  }
  return findings;
}

std::vector<Finding> check_top_level(const std::filesystem::path& root) {
  std::set<std::string> known{"CMakeLists.txt",
                              "CMakePresets.json",
                              "README.md",
                              "ARCHITECTURE.md",
                              "CHANGELOG.md",
                              "LICENSE",
                              "SECURITY.md",
                              "demo",
                              "test",
                              "server",
                              "client",
                              "common",
                              "proto",
                              "hal",
                              "netsim",
                              "tandem",
                              "tests",
                              ".ci",
                              ".clang-format",
                              ".editorconfig",
                              ".pre-commit-config.yaml",
                              "CONTRIBUTING.md",
                              ".clang-tidy",
                              ".gitignore",
                              ".git",
                              "CMakeUserPresets.json"};
  std::ifstream ignored(root / ".gitignore");
  for (std::string line; std::getline(ignored, line);) {
    while (!line.empty() && line.front() == '/') line.erase(0, 1);
    while (!line.empty() && line.back() == '/') line.pop_back();
    known.insert(line);
  }
  std::vector<Finding> findings;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!known.contains(name) && !name.ends_with(".swp")) {
      findings.push_back({name, 0, "the top level is prescribed; this belongs into one of its folders"});
    }
  }
  return findings;
}

}  // namespace tandem::tidy

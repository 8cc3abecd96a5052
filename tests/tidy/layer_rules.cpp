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

/// Which library a header of others belongs to. What is not listed and has a '/' or ".h" is the operating system's.
struct Library {
  std::string_view prefix;
  std::string_view name;
};
constexpr std::array<Library, 22> kLibraries{{{"Eigen/", "Eigen"},
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
                                              {"sqlite3.h", "sqlite"},
                                              {"prometheus/", "prometheus"},
                                              {"boost/", "boost"}}};
constexpr std::string_view kSystem = "system";

constexpr std::array<std::string_view, 7> kTopFolders{"client/", "common/", "hal/",  "netsim/",
                                                      "proto/",  "server/", "tests/"};

/// Mirrors "Rooms and who may know whom". The room with the longest `folder` that the path begins with decides.
const std::array<Room, 20> kRooms{{
    {"common/base", {"common/base"}, {}, "common/base is plain C++: no Eigen, asio, spdlog, protobuf, clock"},
    {"common/control",
     {"common/base", "common/control"},
     {"Eigen"},
     "common/control sees fixed-size numbers only: base and Eigen, no bytes, peers, clocks"},
    {"common/link",
     {"common/base", "common/link", "proto"},
     {"openssl", "sodium", "ipsec-mb"},
     "common/link sees time and bytes: base, proto, OpenSSL, libsodium and libipsec-mb, no sockets, threads, clocks"},
    {"common/trust",
     {"common/base", "common/trust", "proto/trust_spec.h", "proto/access_role.h"},
     {"openssl", "sodium"},
     "common/trust decides over values it is given: base, the plain rows of its books, OpenSSL and libsodium"},
    {"common/trust/io",
     {"common/base", "common/io", "common/trust", "proto/control_codec.h", "proto/control_messages.h", "proto/trust_text.h", "proto/trust_spec.h"},
     {"openssl", "asio"},
     "common/trust/io keeps keys and books in files and speaks frames over TLS: trust, proto's frames and books, OpenSSL and asio"},
    {"common/setup",
     {"common/base", "common/control", "common/setup", "proto/control_messages.h", "proto/scene_spec.h", "proto/seat_setup.h"},
     {"Eigen"},
     "common/setup turns the plain structs of a scene into parameters of common/control, nothing else"},
    {"proto",
     {"common/base", "proto"},
     {"protobuf"},
     "proto turns bytes and text into owned structs: base and protobuf"},
    {"hal",
     {"common/base", "hal", "proto/scene_spec.h", "proto/device_spec.h", "proto/woodenhaptics_spec.h",
      "proto/spacemouse_spec.h"},
     {"Eigen"},
     "hal is base, Eigen and the plain structs of a scene and of a device's file; it knows no network and no session"},
    {"hal/app",
     {"common/base", "common/link/digest.h", "hal", "proto"},
     {},
     "hal/app makes drivers of what a person names: buses, files, presets; no network and no session"},
    {"netsim",
     {"common/base", "proto/input_error.h", "netsim"},
     {},
     "impairments and the virtual network are base only; what runs a whole scene is netsim/world..., programs "
     "netsim/app"},
    {"netsim/profile", {"common/base", "proto", "netsim"}, {}, "profiles are text: base and proto's reader of text"},
    {"netsim/scenario",
     {"common", "proto", "hal", "server", "client", "netsim"},
     {},
     "scenarios hold text against a scene and judge reports: no JSON, no files; those belong to netsim/app"},
    {"netsim/world",
     {"common", "proto", "hal", "server", "client", "netsim"},
     {"Eigen", "openssl", "json"},
     "the World runs the cores in virtual time: no asio, spdlog or system headers"},
    {"netsim/feel",
     {"common", "proto", "hal", "server", "client", "netsim"},
     {"Eigen", "json"},
     "what hands feel is measured in the World: no files, clocks or threads; those belong to netsim/app"},
    {"netsim/testing",
     {"common", "proto", "hal", "server", "client", "netsim"},
     {"gtest"},
     "what other projects test with: the World, the network and GoogleTest; no clock, no file"},
    {"server",
     {"common", "proto", "hal/device.h", "hal/port_map.h", "server"},
     {"Eigen"},
     "the server's core knows control, link and the hal interface; wiring belongs to server/app"},
    {"server/report",
     {"common", "proto", "server"},
     {"json"},
     "reports are made after the fact from plain records: text and JSON, no session, no device"},
    {"client",
     {"common", "proto", "hal/device.h", "hal/port_map.h", "client"},
     {"Eigen"},
     "the client's core knows control, link and the hal interface; wiring belongs to client/app"},
    {"common", {"common"}, {"asio", "spdlog", "CLI11", "json"}, "common knows nobody above it"},
    {"tests", {}, {}, "tests know everybody; nothing is checked"},
}};

const std::vector<std::string_view> kPumps{"app", "io", "tests"};

const std::array<Ban, 8> kBans{{
    {Ban::In::kCode,
     {"steady_clock", "system_clock", "high_resolution_clock", "utc_clock", "clock_gettime", "gettimeofday",
      "timespec_get", "timerfd_create", "sleep_for", "sleep_until", "usleep", "nanosleep"},
     {},
     kPumps,
     {},
     "clocks and sleeping belong to folders called app or io; cores are told the time"},
    {Ban::In::kInclude,
     {"thread", "mutex", "shared_mutex", "condition_variable", "future", "semaphore", "latch", "barrier", "stop_token",
      "ctime", "iostream"},
     {},
     kPumps,
     {},
     "threads, locks, clocks and streams to a terminal belong to folders called app or io"},
    {Ban::In::kCode,
     {"reinterpret_cast"},
     {},
     kPumps,
     {"common/link/aes_gcm.cpp", "common/base/raw_bytes.h"},  // the cipher's expanded key in our bytes; unsigned char*, where we speak std::byte
     "buffers are decoded by a parser that checks lengths, not by a cast"},
    {Ban::In::kInclude,
     {"random"},
     {},
     {},
     {},
     "std distributions differ between libraries: same seed, same trace needs common/base/rng.h"},
    {Ban::In::kCode,
     {"std::rand", "srand", "drand48", "random_device", "mt19937", "mt19937_64"},
     {},
     {},
     {},
     "randomness is a seeded argument: common/base/rng.h"},
    {Ban::In::kCode,
     {"sleep_for", "sleep_until", "usleep", "nanosleep"},
     {"tests"},
     {"tests/io", "tests/vm"},
     {},
     "a test moves virtual time; only tests/io waits for real things, and tests/vm for those of its own machine"},
    {Ban::In::kText,
     {"TO"
      "DO",
      "FIX"
      "ME",
      "XX"
      "X"},
     {},
     {},
     {},
     "work left is an issue, not a comment"},
    {Ban::In::kCode,
     {"DISABLED_*", "GTEST_SKIP();"},
     {"tests"},
     {},
     {},
     "a test that cannot run on this machine says why: GTEST_SKIP() << reason; a part of one prints '[ NOT RUN ] what: why'"},
}};

/// The files that may be longer than kLinesMax.
constexpr std::array<std::string_view, 0> kLongerFiles{};

bool is_pump(std::string_view path) { return has_folder(path, "app") || has_folder(path, "io"); }

bool is_free(std::string_view path, std::span<const std::string_view> folders) {
  return std::ranges::any_of(folders, [&](std::string_view f) {
    return f.find('/') == std::string_view::npos ? has_folder(path, f) : is_within(path, f);
  });
}

const Room* room_of(std::string_view path) {
  const Room* best = nullptr;
  for (const Room& room : kRooms) {
    if (path.starts_with(room.folder) && (best == nullptr || room.folder.size() > best->folder.size())) best = &room;
  }
  return best;
}

/// Empty for headers of the C++ library.
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

/// "server" for server/session.h, server/app/main.cpp, ...
std::string_view top_folder(std::string_view path) { return path.substr(0, path.find('/')); }

std::optional<std::string> trouble_with_ours(const SourceFile& file, const Room& room, const Include& include) {
  const std::string& path = include.path;
  const bool test = is_within(file.path, "tests");
  if (!include.quoted) return "our own headers are included with quotes";
  if (path.ends_with(".pb.h") && !may_see_protobuf(file.path)) return std::string(kGeneratedReason);
  if (test) return std::nullopt;
  if (is_within(path, "tests")) return "programs do not know their tests";
  if (is_pump(path) && !is_pump(file.path)) return "a core does not know what is in an app or io folder";
  if (has_folder(path, "app") && top_folder(path) != "common" && top_folder(path) != top_folder(file.path)) {
    return "an app folder serves its own program";
  }
  if (has_folder(file.path, "app")) return std::nullopt;
  const bool may = std::ranges::any_of(room.may_include, [&](std::string_view f) { return is_within(path, f); });
  return may ? std::nullopt : std::optional<std::string>(room.reason);
}

std::optional<std::string> trouble_with_library(const SourceFile& file, const Room& room, std::string_view library) {
  if (library.empty() || is_within(file.path, "tests") || has_folder(file.path, "app")) return std::nullopt;
  if (std::ranges::find(room.libraries, library) != room.libraries.end()) return std::nullopt;
  constexpr std::array<std::string_view, 4> kInIo{"asio", "libusb", "hidapi", kSystem};
  if (has_folder(file.path, "io") && std::ranges::find(kInIo, library) != kInIo.end()) return std::nullopt;
  return (library == kSystem ? "a header of the operating system, for app and io folders only; " : "") +
         std::string(room.reason);
}

void check_includes(const SourceFile& file, std::vector<Finding>& findings) {
  const Room* room = room_of(file.path);
  for (const Include& include : includes_of(file)) {
    std::optional<std::string> trouble;
    if (room == nullptr) {
      trouble = "this folder is in no room of the table (tests/tidy/layer_rules.cpp)";
    } else if (is_ours(include.path)) {
      trouble = trouble_with_ours(file, *room, include);
    } else if (include.quoted && include.path.ends_with(".inc")) {
      continue;  // data generated into the build folder
    } else if (include.quoted) {
      trouble = "includes name the path from the root, \"common/base/time.h\"; others' headers take <>";
    } else {
      trouble = trouble_with_library(file, *room, library_of(include.path));
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

/// A test that prints "[ NOT RUN" and returns would count as passed.
void check_not_run(const SourceFile& file, std::vector<Finding>& findings) {
  std::istringstream lines(file.text);
  bool said = false;
  std::size_t number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (said && begin != std::string::npos && line.compare(begin, 7, "return;") == 0)
      findings.push_back({file.path, number, "a test that returns after printing [ NOT RUN ] counts as passed; GTEST_SKIP() << reason"});
    said = line.find("\"[ NOT RUN") != std::string::npos;
  }
}

}  // namespace

std::span<const Room> rooms() { return kRooms; }
std::span<const Ban> bans() { return kBans; }
std::span<const std::string_view> longer_files() { return kLongerFiles; }

std::vector<Finding> check_layers(const SourceFile& file) {
  std::vector<Finding> findings;
  if (is_cpp(file.path) && is_within(file.path, "tests")) check_not_run(file, findings);
  if (is_cpp(file.path)) {
    check_includes(file, findings);
    const auto lines = static_cast<std::size_t>(std::ranges::count(file.text, '\n'));
    if (lines > kLinesMax && std::ranges::find(kLongerFiles, file.path) == kLongerFiles.end()) {
      findings.push_back({file.path, 0,
                          std::to_string(lines) + " lines, more than " + std::to_string(kLinesMax) +
                              ": a mechanism wants its own pair of files"});
    }
  }
  for (const Ban& ban : kBans) check_ban(file, ban, findings);
  return findings;
}

std::vector<Finding> check_generated(std::span<const SourceFile> files) {
  std::set<std::string, std::less<>> shows;  // headers of proto through which generated code is seen
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
                              "tests",
                              ".ci",
                              ".clang-format",
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

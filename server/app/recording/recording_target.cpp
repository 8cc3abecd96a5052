#include "server/app/recording/recording_target.h"

#include <unistd.h>

#include <ctime>
#include <filesystem>

#include "common/base/format.h"
#include "common/io/output_file.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".mcap";
constexpr unsigned kNumberMax = 9999;

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool in_use(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error) || fs::exists(path + ".part", error);
}

}  // namespace

std::string recording_target_problem(const std::string& target) {
  if (is_folder(target))
    return ::access(target.c_str(), W_OK | X_OK) == 0 ? "" : "is not writable for this user; name another folder";
  if (!target.ends_with(kSuffix) || target.size() == std::string(kSuffix).size() || target.ends_with("/.mcap"))
    return "must be a folder that exists, or a file NAME.mcap";
  const std::string problem = io::OutputFile::problem(target);
  return problem.empty() ? "" : problem.substr(std::min(problem.size(), target.size() + 1));
}

std::string recording_path(const std::string& target, const std::string& session, const std::string& id,
                           std::int64_t wall_s) {
  std::string stem;
  if (is_folder(target)) {
    const auto now = static_cast<std::time_t>(wall_s);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char when[32];
    std::strftime(when, sizeof when, "%Y%m%dT%H%M%SZ", &utc);
    stem = (fs::path(target) / (session + "-" + when + "-" + id)).string();
  } else {
    stem = target.substr(0, target.size() - std::string(kSuffix).size());
  }
  std::string path = stem + kSuffix;
  for (unsigned k = 2; k <= kNumberMax && in_use(path); ++k) path = stem + format("-%u", k) + kSuffix;
  return path;
}

std::string recording_folder(const std::string& target) {
  if (is_folder(target)) return target;
  const std::string parent = fs::path(target).parent_path().string();
  return parent.empty() ? "." : parent;
}

}  // namespace tandem::server

#include "server/recording/io/recording_repair.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <expected>
#include <filesystem>
#include <new>
#include <span>
#include <string_view>
#include <utility>

#include "common/base/format.h"
#include "common/io/fd.h"
#include "common/io/output_file.h"
#include "common/mcap/mcap_repair.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = ".part", kMcap = ".mcap";
constexpr std::size_t kPiece = std::size_t{4} << 20U;               // [bytes] per call
constexpr std::uint64_t kProgressBytes = std::uint64_t{64} << 20U;  // between two texts of progress
constexpr std::size_t kLeftoversMax = 1000;
constexpr unsigned kCopiesMax = 9999;

using Progress = std::function<void(const std::string&)>;

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// Path of the repaired file.
std::string target_of(const std::string& path) {
  if (!path.ends_with(kPart)) return path;
  std::string whole = path.substr(0, path.size() - kPart.size());
  if (!exists(whole)) return whole;
  const std::string stem = whole.ends_with(kMcap) ? whole.substr(0, whole.size() - kMcap.size()) : whole;
  for (unsigned k = 2; k <= kCopiesMax; ++k)
    if (std::string name = stem + format("-%u", k) + std::string(kMcap); !exists(name)) return name;
  return whole;
}

class Meter {
 public:
  Meter(const Progress& on_progress, const char* what, std::uint64_t size)
      : on_progress_(on_progress), what_(what), size_(size) {}
  void at(std::uint64_t done) {
    if (!on_progress_ || done < next_) return;
    next_ = done + kProgressBytes;
    if (done > 0)
      on_progress_(format("%s: %.0f of %.0f MiB", what_, static_cast<double>(done) / (1 << 20),
                          static_cast<double>(size_) / (1 << 20)));
  }

 private:
  const Progress& on_progress_;
  const char* what_;
  std::uint64_t size_, next_ = kProgressBytes;
};

std::expected<std::string, std::string> read_all(int file, std::uint64_t size, const Progress& on_progress) {
  std::string bytes(size, '\0');
  Meter meter(on_progress, "reading", size);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::pread(file, bytes.data() + at, std::min(kPiece, bytes.size() - at), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::unexpected(std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) bytes.resize(at);  // it became shorter
    at += static_cast<std::size_t>(n);
    meter.at(at);
  }
  return bytes;
}

/// Writes a new file and brings it onto the disk. @return the error
std::string write_new(const std::string& path, std::string_view bytes, const Progress& on_progress) {
  const io::Fd file{::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0640)};
  if (!file.open()) return path + " cannot be written: " + io::write_error_text(errno);
  Meter meter(on_progress, "writing", bytes.size());
  int error = 0;
  for (std::size_t at = 0; at < bytes.size() && error == 0;) {
    const ssize_t n =
        ::pwrite(file.get(), bytes.data() + at, std::min(kPiece, bytes.size() - at), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) error = n < 0 ? errno : ENOSPC;
    at += n > 0 ? static_cast<std::size_t>(n) : 0;
    meter.at(at);
  }
  if (error == 0 && ::fsync(file.get()) != 0) error = errno;
  if (error == 0) return {};
  ::unlink(path.c_str());
  return path + " cannot be written: " + io::write_error_text(error);
}

std::string kept_text(const mcap::RepairResult& repaired) {
  std::string text = format("%llu chunks with %llu messages", static_cast<unsigned long long>(repaired.chunks),
                            static_cast<unsigned long long>(repaired.messages));
  if (repaired.damaged > 0)
    text += format("; damaged and left out: %llu of the chunks", static_cast<unsigned long long>(repaired.damaged));
  if (repaired.lost_bytes > 0)
    text += format("; the last %llu bytes were not whole and are left out",
                   static_cast<unsigned long long>(repaired.lost_bytes));
  return text;
}

}  // namespace

RecordingRepair repair_recording(const std::string& path, const Progress& on_progress) try {
  using Kind = RecordingRepair::Kind;
  const auto failed = [&path](const std::string& why) {
    return RecordingRepair{Kind::kFailed, path, path + ": " + why};
  };
  // For writing too: on NFSv4 only such a file can be locked.
  const io::Fd file{::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW)};
  struct stat status{};
  if (!file.open() || ::fstat(file.get(), &status) != 0) {
    const bool refused = errno == EACCES || errno == EPERM || errno == EROFS;
    return failed(std::string("cannot be opened for writing: ") + std::strerror(errno) +
                  (refused ? "; repair it as a user who may write it, or repair a copy" : ""));
  }
  if (!S_ISREG(status.st_mode)) return failed("is no file");
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return {Kind::kInUse, path, path + ": a program writes this recording now; end it first"};
    return failed(std::string("cannot be locked, so a program may be writing it now: ") + std::strerror(errno) +
                  "; when its program has ended, copy it to a local disk and repair the copy");
  }
  auto bytes = read_all(file.get(), static_cast<std::uint64_t>(status.st_size), on_progress);
  if (!bytes) return failed(bytes.error());
  if (bytes->empty()) return failed("is empty: its program ended before the disk took a byte; delete it");
  auto repaired = mcap::repair(std::as_bytes(std::span(*bytes)));
  if (!repaired) return {Kind::kFailed, path, repaired.error().text(path)};
  const std::string target = target_of(path);
  if (repaired->was_complete) {
    if (target != path && std::rename(path.c_str(), target.c_str()) != 0)
      return failed("is complete, but cannot be renamed to " + target + ": " + io::write_error_text(errno));
    return {Kind::kComplete, target, target + ": is complete"};
  }
  const std::string made = target + ".repair";
  ::unlink(made.c_str());  // of a repair that was interrupted
  if (const std::string problem = write_new(made, repaired->file, on_progress); !problem.empty())
    return failed(problem);
  if (std::rename(made.c_str(), target.c_str()) != 0) {
    const std::string why = io::write_error_text(errno);
    ::unlink(made.c_str());
    return failed("the repaired file cannot be renamed to " + target + ": " + why);
  }
  if (target != path && ::unlink(path.c_str()) != 0)
    return {Kind::kRepaired, target,
            target + ": repaired, " + kept_text(*repaired) + "; " + path + " stays: " + std::strerror(errno)};
  return {Kind::kRepaired, target, target + ": repaired, " + kept_text(*repaired)};
} catch (const std::bad_alloc&) {
  // A server repairs large files beside its sessions, which must go on.
  return {RecordingRepair::Kind::kFailed, path,
          path + ": not enough memory; run `tandem-server repair " + path + "` when the server is stopped"};
}

std::vector<std::string> recording_leftovers(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end && found.size() < kLeftoversMax;
       at.increment(error)) {
    const std::string path = at->path().string();
    if (path.ends_with(std::string(kMcap) + std::string(kPart))) found.push_back(path);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace tandem::server

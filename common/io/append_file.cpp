#include "common/io/append_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

#include "common/io/clock.h"
#include "common/io/output_file.h"

namespace tandem::io {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kRetry = 100ms;
constexpr std::size_t kWriteMax = std::size_t{1} << 20U;  // [bytes] per call, so that `state` follows a slow disk

/// Brings the names of files in the folder of `path` onto the disk.
void sync_folder(const std::string& path) {
  const auto slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const Fd file{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (file.open()) ::fsync(file.get());
}

}  // namespace

std::expected<std::unique_ptr<AppendFile>, std::string> AppendFile::create(const std::string& path,
                                                                           const AppendFileOptions& options) {
  if (::access(path.c_str(), F_OK) == 0) return std::unexpected(path + " exists already; choose another name");
  const std::string part = path + ".part";
  Fd file{::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0640)};
  if (!file.open())
    return std::unexpected(errno == EEXIST ? part + " exists already: `tandem-server repair " + part + "` closes it"
                                           : path + " cannot be written: " + write_error_text(errno));
  ::flock(file.get(), LOCK_EX | LOCK_NB);  // a new file: the lock is free. A file system without locks has none.
  return std::unique_ptr<AppendFile>(new AppendFile(path, options, std::move(file)));
}

AppendFile::AppendFile(std::string path, const AppendFileOptions& options, Fd file)
    : path_(std::move(path)), options_(options), file_(std::move(file)), thread_([this] { run(); }) {}

AppendFile::~AppendFile() {
  {
    const std::lock_guard lock(lock_);
    stop_ = true;
    wake_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  // Nothing can be kept of a file without a byte; its name would only look like a recording.
  if (!state_.closed && state_.written == 0) ::unlink(part().c_str());
}

void AppendFile::append(std::string bytes) {
  if (bytes.empty()) return;
  const std::lock_guard lock(lock_);
  state_.backlog += bytes.size();
  waiting_.push_back(std::move(bytes));
  wake_.notify_all();
}

bool AppendFile::accepts() const {
  const std::lock_guard lock(lock_);
  return state_.error == 0 && state_.backlog <= options_.backlog_max;
}

AppendFile::State AppendFile::state() const {
  const std::lock_guard lock(lock_);
  return state_;
}

void AppendFile::begin_close() {
  const std::lock_guard lock(lock_);
  closing_ = true;
  wake_.notify_all();
}

std::string AppendFile::close(std::chrono::milliseconds limit) {
  begin_close();
  std::unique_lock lock(lock_);
  if (done_.wait_for(lock, limit, [this] { return state_.closed; })) return state_.close_error;
  const std::string why = state_.error != 0 ? write_error_text(state_.error) : std::string("the disk is too slow");
  if (state_.written == 0) return path_ + " was not written, not even in part: " + why;
  return part() + " is not complete: " + why + "; `tandem-server repair " + part() + "` closes it";
}

std::string AppendFile::name_file(std::uint64_t size) const {
  // Reserved space beyond the end goes back to the disk. The reserve never shows in the size of the file.
  [[maybe_unused]] const int cut = ::ftruncate(file_.get(), static_cast<off_t>(size));
  if (::access(path_.c_str(), F_OK) == 0) return path_ + " appeared meanwhile; the complete file is " + part();
  if (std::rename(part().c_str(), path_.c_str()) == 0) {
    sync_folder(path_);
    return {};
  }
  return part() + " is complete but cannot be renamed to " + path_ + ": " + write_error_text(errno);
}

void AppendFile::run() {
  sigset_t all;
  ::sigfillset(&all);  // SIGXFSZ too: a limit of the file's size is an error of the write, not the end of the process
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  std::unique_lock lock(lock_);
  lock.unlock();
  sync_folder(path_);
  lock.lock();
  Time synced = monotonic_now();
  while (!stop_) {
    state_.error = write_waiting(lock);
    if (state_.error != 0) ++state_.failures;
    const Time now = monotonic_now();
    if (dirty_ && (closing_ || now - synced >= options_.sync)) {
      sync(lock);
      synced = now;
    }
    state_.cpu = read_clock(CLOCK_THREAD_CPUTIME_ID);
    if (closing_ && waiting_.empty() && !dirty_) {
      state_.close_error = name_file(state_.written);
      state_.closed = true;
      done_.notify_all();
      return;
    }
    if (state_.error != 0) {
      wake_.wait_for(lock, kRetry, [this] { return stop_; });
    } else if (dirty_) {
      wake_.wait_for(lock, options_.sync, [this] { return stop_ || closing_ || !waiting_.empty(); });
    } else {
      wake_.wait(lock, [this] { return stop_ || closing_ || !waiting_.empty(); });
    }
  }
}

int AppendFile::write_waiting(std::unique_lock<std::mutex>& lock) {
  if (!closing_)
    if (const int error = reserve_space(); error != 0) return error;
  while (!waiting_.empty() && !stop_) {
    std::string bytes = std::move(waiting_.front());  // no other thread takes from the front
    std::size_t sent = 0;
    int error = 0;
    while (sent < bytes.size() && error == 0) {
      const std::uint64_t at = state_.written;
      lock.unlock();
      const ssize_t size =
          ::pwrite(file_.get(), bytes.data() + sent, std::min(bytes.size() - sent, kWriteMax), static_cast<off_t>(at));
      error = size > 0 ? 0 : size == 0 ? ENOSPC : errno == EINTR ? 0 : errno;
      lock.lock();
      if (size <= 0) continue;
      sent += static_cast<std::size_t>(size);
      state_.written += static_cast<std::uint64_t>(size);
      state_.backlog -= static_cast<std::uint64_t>(size);
      dirty_ = true;
    }
    if (error != 0) {
      waiting_.front() = bytes.substr(sent);
      return error;
    }
    waiting_.pop_front();
    if (!closing_)
      if (const int full = reserve_space(); full != 0) return full;
  }
  return 0;
}

/// Keeps space for the end of the file, so that it can be closed on a full disk. A file system that cannot reserve is
/// not asked again.
int AppendFile::reserve_space() {
  if (options_.reserve == 0 || reserved_ >= state_.written + options_.reserve / 2) return 0;
  const std::uint64_t end = state_.written + options_.reserve;
  if (::fallocate(file_.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(state_.written),
                  static_cast<off_t>(options_.reserve)) == 0) {
    reserved_ = end;
    return 0;
  }
  if (errno == ENOSPC || errno == EDQUOT) return errno;
  options_.reserve = 0;
  return 0;
}

void AppendFile::sync(std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  const bool failed = ::fdatasync(file_.get()) != 0 && errno != EINVAL;  // EINVAL: not a file that can be synced
  lock.lock();
  dirty_ = false;
  if (failed) ++state_.unsynced;
}

}  // namespace tandem::io

#include "server/export/io/pending_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/io/fd.h"
#include "common/io/output_file.h"

namespace tandem::server {

namespace {

namespace fs = std::filesystem;

/// @return errno, 0 if the file or folder is on disk
int put_on_disk(const fs::path& path) {
  const io::Fd file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.get() < 0) return errno;
  // EINVAL: a file system that has nothing to sync.
  return ::fsync(file.get()) == 0 || errno == EINVAL ? 0 : errno;
}

int put_all_on_disk(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    for (fs::recursive_directory_iterator it(path, error), end; !error && it != end; it.increment(error))
      if (const int failed = put_on_disk(it->path()); failed != 0) return failed;
    if (error) return error.value();
  }
  return put_on_disk(path);
}

fs::path parent_of(const std::string& name) {
  const fs::path parent = fs::path(name).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

std::string without_slash(std::string name) {
  while (name.size() > 1 && name.back() == '/') name.pop_back();
  return name;
}

}  // namespace

PendingPath::PendingPath(std::string target)
    : target_(without_slash(std::move(target))), path_(target_ + ".part-" + std::to_string(::getpid())) {}

PendingPath::~PendingPath() {
  if (committed_) return;
  std::error_code ignored;  // a file that cannot be removed keeps the name that shows that it is incomplete
  fs::remove_all(path_, ignored);
}

std::string PendingPath::problem(const std::string& target, bool folder, bool replace) {
  if (target.empty()) return "a name is needed";
  std::error_code error;
  const fs::path path = without_slash(target);
  if (folder) {
    if (fs::exists(path, error)) {
      if (!fs::is_directory(path, error)) return target + " exists and is no folder; name a new folder";
      if (!fs::is_empty(path, error)) return target + " has files in it; name a new or an empty folder";
    }
  } else if (fs::is_directory(path, error)) {
    return target + " is a folder; name a file";
  } else if (!replace && fs::exists(path, error)) {
    return target + " exists already; choose another name, or replace it with --overwrite";
  }
  const fs::path parent = parent_of(path.string());
  if (!fs::is_directory(parent, error)) return target + " cannot be written: there is no folder " + parent.string();
  if (::access(parent.c_str(), W_OK) != 0)
    return target + " cannot be written: " + parent.string() + ": " + io::write_error_text(errno);
  return {};
}

std::string PendingPath::commit() {
  int failed = put_all_on_disk(path_);
  if (failed == 0 && std::rename(path_.c_str(), target_.c_str()) != 0) failed = errno;
  if (failed != 0) return target_ + " could not be written: " + io::write_error_text(failed);
  committed_ = true;
  failed = put_on_disk(parent_of(target_));
  return failed == 0
             ? std::string{}
             : target_ + " is complete, but its name may be lost in a power cut: " + io::write_error_text(failed);
}

}  // namespace tandem::server

#include "common/io/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace tandem::io {

std::string write_error_text(int error) {
  std::string said = std::strerror(error);
  switch (error) {
    case ENOSPC:
      return "the disk is full (" + said + "); free some space there, then repeat";
    case EDQUOT:
      return "this user's share of the disk is full (" + said + "); free some space there, then repeat";
    case EACCES:
    case EPERM:
      return "no permission (" + said + "); name a place where this user may write";
    case EROFS:
      return "the disk is mounted read-only (" + said + "); name another place";
    case EFBIG:
      return "the file would be larger than allowed here (" + said + ")";
    case EIO:
      return "the disk reports an error (" + said + ")";
    default:
      return said;
  }
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && !on_stdout()) std::fclose(file_);
}

std::string OutputFile::problem(const std::string& name) {
  std::error_code error;
  if (std::filesystem::is_directory(name, error)) return name + " cannot be written: it is a folder";
  const bool exists = std::filesystem::exists(name, error);
  const std::filesystem::path parent = std::filesystem::path(name).parent_path();
  const std::string target = exists ? name : parent.empty() ? "." : parent.string();
  if (access(target.c_str(), W_OK) == 0 && (exists || std::filesystem::is_directory(target, error))) return {};
  return name + " cannot be written: " + (exists ? "" : target + ": ") + write_error_text(errno != 0 ? errno : ENOTDIR);
}

std::string OutputFile::open(const std::string& name, bool dash_is_stdout) {
  name_ = name;
  if (name.empty()) return {};
  if (name == "-" && dash_is_stdout) {
    file_ = stdout;
    return {};
  }
  file_ = std::fopen(name.c_str(), "wbe");
  return file_ != nullptr ? std::string{} : name + " cannot be written: " + write_error_text(errno);
}

void OutputFile::write(std::string_view text) noexcept {
  if (file_ == nullptr || failed_ != 0) return;
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) failed_ = errno != 0 ? errno : EIO;
}

std::string OutputFile::close() {
  if (file_ == nullptr) return {};
  std::FILE* const file = std::exchange(file_, nullptr);
  errno = 0;
  const bool flushed = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
  if (!flushed && failed_ == 0) failed_ = errno != 0 ? errno : EIO;
  std::error_code error;
  if (failed_ != 0 && file != stdout && std::filesystem::is_regular_file(name_, error) &&
      std::filesystem::file_size(name_, error) == 0)
    std::filesystem::remove(name_, error);
  if (failed_ == EPIPE && file == stdout) return {};  // the reader closed its end and needs no more
  return failed_ == 0 ? std::string{}
                      : (file == stdout ? "standard output" : name_) +
                            " could not be written to the end: " + write_error_text(failed_);
}

}  // namespace tandem::io

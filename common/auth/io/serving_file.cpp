#include "common/auth/io/serving_file.h"

#include <charconv>
#include <string_view>
#include <utility>

#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"

namespace tandem::auth {

ServingFile::~ServingFile() {
  if (folder_ && serving_.held()) (void)folder_->remove(kFile);
}

std::string ServingFile::begin() {
  auto lock = DirectoryLock::attempt(*folder_, kLock);
  if (!lock) return lock.error();
  if (!*lock)
    return folder_->path() + ": another server runs from this folder: " + DirectoryLock::holder_of(*folder_, kLock) +
           "; stop it first, or give this one a folder of its own (`run --state`, `state` in a configuration)";
  serving_ = std::move(**lock);
  for (const char* meant_for_previous : {kEndFile, kServiceFile})
    if (folder_->has(meant_for_previous))
      if (std::string problem = folder_->remove(meant_for_previous); !problem.empty()) return problem;
  return {};
}

std::string ServingFile::write(const ServingSpec& serving) const {
  if (!folder_) return {};
  return folder_->replace(kFile, std::string_view(print_serving(serving)), StateDirectory::Sync::kNo);
}

std::expected<std::optional<ServingSpec>, std::string> ServingFile::read() const {
  if (!folder_ || !folder_->has(kFile)) return std::nullopt;
  const auto lists = DirectoryLock::wait(*folder_, lists_lock_);
  if (!lists) return std::unexpected(lists.error());
  // Left by a server that was killed: no process holds its lock.
  const auto lock = DirectoryLock::attempt(*folder_, kLock);
  if (!lock) return std::unexpected(lock.error());
  if (*lock) return std::nullopt;
  const auto bytes = folder_->read(kFile);
  if (!bytes) return std::unexpected(bytes.error());
  auto serving = parse_serving(*bytes ? text_of((*bytes)->bytes()) : std::string_view{}, folder_->path_of(kFile));
  if (!serving) return std::unexpected(to_text(serving.error()) + "repair or delete that file");
  return std::move(*serving);
}

std::string ServingFile::request_shutdown(std::uint32_t grace_s) const {
  if (!folder_) return "this server has no folder";
  const auto lists = DirectoryLock::wait(*folder_, lists_lock_);
  if (!lists) return lists.error();
  return folder_->replace(kEndFile, std::string_view(std::to_string(grace_s) + "\n"));
}

std::optional<std::uint32_t> ServingFile::requested_shutdown() const {
  if (!folder_ || !folder_->has(kEndFile)) return std::nullopt;
  const auto bytes = folder_->read(kEndFile);
  if (!bytes || !*bytes) return std::nullopt;  // a file with wrong owner or mode is not a request
  const std::string text{text_of((*bytes)->bytes())};
  if (!folder_->remove(kEndFile).empty()) return std::nullopt;
  std::uint32_t grace = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), grace);
  if (error != std::errc{} ||
      std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)) != "\n" || grace > 3600)
    return std::nullopt;
  return grace;
}

}  // namespace tandem::auth

#include "client/app/motor_registry_file.h"

#include <filesystem>
#include <span>
#include <system_error>

#include "common/auth/io/directory_lock.h"
#include "common/auth/io/state_directory.h"
#include "common/base/command_hints.h"

namespace tandem::client {
namespace {

using auth::StateDirectory;

constexpr const char* kLock = "confirmed_motors.lock";

std::expected<MotorRegistry, std::string> read_book(const StateDirectory& folder) {
  const auto bytes = folder.read(MotorRegistryFile::kFile);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return MotorRegistry{};
  const std::span<const std::byte> all = (*bytes)->bytes();
  auto book = MotorRegistry::parse({reinterpret_cast<const char*>(all.data()), all.size()});
  if (!book)
    return std::unexpected(folder.path_of(MotorRegistryFile::kFile) + ": " + book.error() +
                           ". No entry is used: remove the file and confirm the motors of your devices again");
  return book;
}

std::expected<StateDirectory, std::string> open_folder(const std::string& option, StateDirectory::Missing missing) {
  const auto path = auth::client_state_path(option);
  if (!path) return std::unexpected(path.error());
  return StateDirectory::open(*path, missing);
}

}  // namespace

std::expected<std::optional<MotorRecord>, std::string> MotorRegistryFile::find(const hal::SignFile& signs) const {
  const auto path = auth::client_state_path(option_);
  if (!path) return std::unexpected(path.error());
  std::error_code none;
  if (!std::filesystem::exists(*path, none)) return std::nullopt;
  const auto folder = StateDirectory::open(*path, StateDirectory::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  const auto book = read_book(*folder);
  if (!book) return std::unexpected(book.error());
  const MotorRecord* const record = book->find(signs.device, signs.sha256);
  return record == nullptr ? std::nullopt : std::optional(*record);
}

std::string MotorRegistryFile::storage_error() const {
  const auto folder = open_folder(option_, StateDirectory::Missing::kIsMade);
  if (!folder) return folder.error();
  if (const auto book = read_book(*folder); !book) return book.error();
  return folder->write_problem();
}

std::string MotorRegistryFile::store(const hal::SignFile& signs, bool confirmed) const {
  const auto folder = open_folder(option_, StateDirectory::Missing::kIsMade);
  if (!folder) return folder.error();
  const auto alone = auth::DirectoryLock::wait(*folder, kLock);
  if (!alone) return alone.error();
  auto book = read_book(*folder);
  if (!book) return book.error();
  book->put({signs.device, signs.sha256, confirmed, auth::wall_seconds()});
  return folder->replace(kFile, book->text());
}

std::string MotorRegistryFile::command(std::string_view device) const {
  return "tandem-client doctor --device " + shell_quote(device) + " --confirm-motors" + state_option(option_);
}

}  // namespace tandem::client

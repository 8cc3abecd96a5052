#include "client/app/motor_state.h"

#include <filesystem>
#include <span>
#include <system_error>

#include "common/base/printed_command.h"
#include "common/trust/io/state_folder.h"

namespace tandem::client {
namespace {

using trust::StateFolder;

constexpr const char* kLock = "confirmed_motors.lock";

std::expected<MotorBook, std::string> read_book(const StateFolder& folder) {
  const auto bytes = folder.read(MotorState::kFile);
  if (!bytes) return std::unexpected(bytes.error());
  if (!*bytes) return MotorBook{};
  const std::span<const std::byte> all = (*bytes)->bytes();
  auto book = MotorBook::parse({reinterpret_cast<const char*>(all.data()), all.size()});
  if (!book)
    return std::unexpected(folder.path_of(MotorState::kFile) + ": " + book.error() +
                           ". Nothing in it counts: remove the file and confirm the motors of your devices again");
  return book;
}

std::expected<StateFolder, std::string> open_folder(const std::string& option, StateFolder::Missing missing) {
  const auto path = trust::client_state_path(option);
  if (!path) return std::unexpected(path.error());
  return StateFolder::open(*path, missing);
}

}  // namespace

std::expected<std::optional<MotorRecord>, std::string> MotorState::find(const hal::SignFile& signs) const {
  const auto path = trust::client_state_path(option_);
  if (!path) return std::unexpected(path.error());
  std::error_code none;
  if (!std::filesystem::exists(*path, none)) return std::nullopt;
  const auto folder = StateFolder::open(*path, StateFolder::Missing::kIsAnError);
  if (!folder) return std::unexpected(folder.error());
  const auto book = read_book(*folder);
  if (!book) return std::unexpected(book.error());
  const MotorRecord* const record = book->find(signs.device, signs.sha256);
  return record == nullptr ? std::nullopt : std::optional(*record);
}

std::string MotorState::unfit_to_keep() const {
  const auto folder = open_folder(option_, StateFolder::Missing::kIsMade);
  if (!folder) return folder.error();
  if (const auto book = read_book(*folder); !book) return book.error();
  return folder->unfit_to_write();
}

std::string MotorState::keep(const hal::SignFile& signs, bool confirmed) const {
  const auto folder = open_folder(option_, StateFolder::Missing::kIsMade);
  if (!folder) return folder.error();
  const auto alone = folder->lock(kLock);
  if (!alone) return alone.error();
  auto book = read_book(*folder);
  if (!book) return book.error();
  book->put({signs.device, signs.sha256, confirmed, trust::wall_seconds()});
  return folder->replace(kFile, book->text());
}

std::string MotorState::command(std::string_view device) const {
  return "tandem-client doctor --device " + shell_word(device) + " --confirm-motors" + state_option_of(option_);
}

}  // namespace tandem::client

#include "server/app/checkpoint_book.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/trust/io/state_folder.h"

namespace tandem::server {
namespace {

/// Between two rounds of writing: when many come at once the newest of them is enough.
constexpr auto kRest = std::chrono::milliseconds(20);
/// A session in which nothing happens is written so often all the same: its file must not look too old.
constexpr std::int64_t kRefreshS = 60;
constexpr const char* kEnding = ".checkpoint";
constexpr const char* kAside = ".unfit";

}  // namespace

CheckpointBook::CheckpointBook(trust::StateFolder folder, std::string prefix, std::function<void(const std::string&)> trouble)
    : folder_(std::move(folder)), prefix_(std::move(prefix)), trouble_(std::move(trouble)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

CheckpointBook::~CheckpointBook() { stop(); }

std::expected<std::unique_ptr<CheckpointBook>, std::string> CheckpointBook::open(const std::string& path, std::string prefix,
                                                                                std::function<void(const std::string&)> trouble) {
  auto folder = trust::StateFolder::open(path, trust::StateFolder::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  return std::unique_ptr<CheckpointBook>(new CheckpointBook(std::move(*folder), std::move(prefix), std::move(trouble)));
}

/// Names come from files' names and addresses: what a file's name should not have becomes a dash.
std::string CheckpointBook::file_of(const std::string& name) const {
  std::string file = prefix_ + name;
  for (char& c : file)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_') c = '-';
  return file + kEnding;
}

CheckpointBook::Found CheckpointBook::find(const std::string& name, const SceneSpec& scene, std::int64_t now, bool wanted) const {
  Found found;
  const std::string file = file_of(name);
  if (!folder_.has(file)) return found;
  const auto bytes = folder_.read(file);
  if (bytes && !*bytes) return found;
  if (!bytes) {
    found.unfit = bytes.error();
  } else if (auto kept = decode_kept(std::as_const(**bytes).bytes()); !kept) {
    found.unfit = kept.error();
  } else {
    found.unfit = wanted ? unfit(*kept, name, scene, now) : "--fresh says so";
    if (found.unfit.empty()) found.kept = std::move(*kept);
  }
  if (found.kept) return found;
  std::error_code error;
  std::filesystem::rename(folder_.path_of(file), folder_.path_of(file + kAside), error);
  found.unfit += error ? "; " + folder_.path_of(file) + " cannot be moved aside: " + error.message() : "; it was moved aside to " + folder_.path_of(file + kAside);
  return found;
}

void CheckpointBook::start() {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

std::shared_ptr<CheckpointMail> CheckpointBook::begin(KeptSession kept) {
  const std::lock_guard lock{lock_};
  return pages_.emplace_back(std::make_shared<Page>(std::move(kept), wake_))->mail;
}

void CheckpointBook::send_away(const std::string& name, std::vector<std::array<std::byte, 32>> keys) {
  {
    const std::lock_guard lock{lock_};
    for (const auto& page : pages_)
      if (page->kept.name == name && !page->over) page->sent_away = keys;
  }
  wake();
}

void CheckpointBook::end(const std::string& name) {
  {
    const std::lock_guard lock{lock_};
    for (const auto& page : pages_)
      if (page->kept.name == name) page->over = true;
  }
  wake();
}

void CheckpointBook::wake() const noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

void CheckpointBook::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  wake();
  thread_.join();
}

void CheckpointBook::drop_all() noexcept {
  const std::unique_lock lock{lock_, std::try_to_lock};
  if (!lock) return;  // then the thread is at it
  for (const auto& page : pages_) static_cast<void>(folder_.remove(file_of(page->kept.name)));
}

void CheckpointBook::work() {
  while (true) {
    pollfd wake{wake_.get(), POLLIN, 0};
    poll(&wake, 1, -1);
    std::uint64_t count = 0;
    [[maybe_unused]] const auto read = ::read(wake_.get(), &count, sizeof count);
    const bool last = stopping_;  // asked before the round, so that what was laid down before `stop` is written
    std::vector<std::shared_ptr<Page>> pages;
    {
      const std::lock_guard lock{lock_};
      pages.assign(pages_.begin(), pages_.end());
    }
    // In their order: the next session of a name begins its page behind the one that is over.
    for (const auto& page : pages) see_to(*page);
    const std::lock_guard lock{lock_};
    pages_.remove_if([&](const auto& page) { return page->gone; });
    if (last) return;
    std::this_thread::sleep_for(kRest);
  }
}

void CheckpointBook::see_to(Page& page) {
  if (page.over) {
    page.gone = true;
    static_cast<void>(folder_.remove(file_of(page.kept.name)));
    return;
  }
  bool others = false;
  {
    const std::lock_guard lock{lock_};
    if (auto newer = std::exchange(page.sent_away, std::nullopt)) {
      page.kept.sent_away = std::move(*newer);
      others = true;
    }
  }
  const bool before = !page.written.empty();
  if (others) page.written.clear();  // the same checkpoint is worth writing again
  if (Checkpoint newest; page.mail->pick_up(newest)) {
    write(page, newest);
  } else if (others && before) {
    write(page, Checkpoint{page.kept.checkpoint});
  }
}

void CheckpointBook::write(Page& page, const Checkpoint& checkpoint) {
  std::vector<std::byte> bytes(kCheckpointMax);
  bytes.resize(encode_checkpoint(checkpoint, bytes));
  const std::int64_t now = trust::wall_seconds();
  if (bytes == page.written && now - page.kept.written_s < kRefreshS && now >= page.kept.written_s) return;
  page.kept.checkpoint = checkpoint;
  page.kept.written_s = now;
  const std::string problem = folder_.replace(file_of(page.kept.name), std::span<const std::byte>(encode_kept(page.kept)));
  if (problem.empty()) page.written = std::move(bytes);
  const bool before = std::exchange(page.troubled, !problem.empty());
  if (!problem.empty() && !before) trouble_("session " + page.kept.name + ": " + problem + "; after a crash it would start from the beginning");
}

}  // namespace tandem::server

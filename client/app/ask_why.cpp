#include "client/app/ask_why.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "client/app/control_words.h"
#include "common/base/printable.h"

namespace tandem::client {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(2000);

std::string who_stopped(trust::ControlClient* connection, const control::Id& session) {
  if (connection == nullptr) return {};
  const auto answer = connection->ask(control::StatusRequest{session}, kPatience);
  const auto* status = answer ? std::get_if<control::Status>(&*answer) : nullptr;
  if (status == nullptr || !is_stopped(*status)) return {};  // over meanwhile
  return stop_text(*status);
}

}  // namespace

AskWhy::AskWhy(std::shared_ptr<trust::ControlClient> connection, const control::Id& session)
    : connection_(std::move(connection)), done_event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  thread_ = std::thread([this, session] {
    answer_ = who_stopped(connection_.get(), session);
    done_.store(true, std::memory_order_release);
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(done_event_.get(), &one, sizeof one);
  });
}

AskWhy::~AskWhy() { thread_.join(); }

std::string ask_why_gone(trust::ControlClient* connection, const control::Id& session) {
  if (connection == nullptr) return {};
  const auto answer = connection->ask(control::StatusRequest{session}, kPatience);
  const auto* refused = answer ? std::get_if<control::Refused>(&*answer) : nullptr;
  return refused == nullptr ? std::string() : printable(refused->text);
}

}  // namespace tandem::client

#include "server/console/app/status_source.h"

#include <chrono>
#include <optional>
#include <string>
#include <variant>

#include "client/app/console_commands.h"
#include "common/auth/io/control_client.h"

namespace tandem::console {
namespace {

constexpr std::chrono::milliseconds kPeriod{200}, kRetry{1000}, kReplyTimeout{2000};

}  // namespace

StatusSource::StatusSource(client::JoinOptions options, client::Console console, rpc::Status status)
    : options_(std::move(options)),
      console_(std::move(console)),
      picture_{std::move(status), console_.welcome.role, 1, true},
      thread_([this] { work(); }) {}

StatusSource::~StatusSource() {
  {
    const std::lock_guard hold{lock_};
    over_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

LivePicture StatusSource::newest() const {
  const std::lock_guard hold{lock_};
  return picture_;
}

bool StatusSource::order(rpc::Body body, Reply reply) {
  {
    const std::lock_guard hold{lock_};
    if (orders_.size() >= kOrdersMax) return false;
    orders_.emplace_back(std::move(body), std::move(reply));
  }
  wake_.notify_all();
  return true;
}

void StatusSource::set(bool connected, rpc::Status* status) {
  const std::lock_guard hold{lock_};
  if (status == nullptr && picture_.connected == connected) return;
  picture_.connected = connected;
  picture_.role = console_.welcome.role;
  if (status != nullptr) picture_.status = std::move(*status);
  number_.store(++picture_.number, std::memory_order_release);
}

bool StatusSource::step() {
  if (!console_.connection) {
    auto joined = client::join_console(options_);
    if (!joined) return false;
    console_ = std::move(*joined);
  }
  auto answer = console_.connection->ask(rpc::StatusRequest{console_.welcome.session_id}, kReplyTimeout);
  if (!answer) {
    console_.connection.reset();
    return false;
  }
  if (auto* status = std::get_if<rpc::Status>(&*answer)) set(true, status);
  return true;
}

void StatusSource::execute(const rpc::Body& body, const Reply& reply) {
  if (!console_.connection)
    return reply(false, "the connection to the server is lost; repeat the order when it is back");
  const auto answer = console_.connection->ask(body, kReplyTimeout);
  if (!answer) {
    console_.connection.reset();
    set(false, nullptr);
    return reply(false, answer.error().text + "; check the state of the session, then repeat the order");
  }
  if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer))
    return reply(false, refused->text + client::refusal_hint(body, console_.welcome.role));
  if (const auto* authority = std::get_if<rpc::AuthorityReply>(&*answer); authority != nullptr && !authority->applied)
    return reply(false, "another change of authority came first; check it, then repeat the order");
  reply(true, "");
}

void StatusSource::work() {
  std::unique_lock hold{lock_};
  while (!over_) {
    while (!orders_.empty() && !over_) {
      auto [body, reply] = std::move(orders_.front());
      orders_.pop_front();
      hold.unlock();
      execute(body, reply);
      hold.lock();
    }
    if (over_) return;
    hold.unlock();
    const bool good = step();
    if (!good) set(false, nullptr);
    hold.lock();
    wake_.wait_for(hold, good ? kPeriod : kRetry, [this] { return over_ || !orders_.empty(); });
  }
}

}  // namespace tandem::console

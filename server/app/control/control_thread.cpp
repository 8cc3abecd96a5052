#include "server/app/control/control_thread.h"

#include <asio/post.hpp>

#include "common/io/thread_without_signals.h"

namespace tandem::server {

void ControlThread::start() {
  work_.emplace(context_.get_executor());
  thread_ = io::thread_without_signals([this] { context_.run(); });
}

void ControlThread::stop(std::function<void()> last) {
  if (!thread_.joinable()) return;
  asio::post(context_, std::move(last));
  work_.reset();
  thread_.join();
}

ControlThread::~ControlThread() {
  if (!thread_.joinable()) return;
  context_.stop();
  thread_.join();
}

}  // namespace tandem::server

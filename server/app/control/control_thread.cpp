#include "server/app/control/control_thread.h"

#include <asio/post.hpp>
#include <csignal>

namespace tandem::server {

void ControlThread::start() {
  work_.emplace(context_.get_executor());
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { context_.run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
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

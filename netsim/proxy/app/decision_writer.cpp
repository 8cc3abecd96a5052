#include "netsim/proxy/app/decision_writer.h"

#include <poll.h>

namespace tandem::netsim {
namespace {

constexpr std::size_t kTextMax = 1 << 16;
constexpr int kPauseMs = 50;

}  // namespace

std::string DecisionWriter::open(const std::string& name) {
  if (name.empty()) return {};
  if (std::string problem = file_.open(name, false); !problem.empty()) return problem;
  text_.reserve(kTextMax + 256);
  text_ += decision_csv_header();
  thread_ = std::thread([this] {
    while (!ending_.load(std::memory_order_acquire)) {
      drain();
      ::poll(nullptr, 0, kPauseMs);
    }
    drain();
  });
  return {};
}

void DecisionWriter::stop() {
  if (!thread_.joinable()) return;
  ending_.store(true, std::memory_order_release);
  thread_.join();
  direct_ = true;
}

std::string DecisionWriter::close() {
  stop();
  flush();
  return file_.close();
}

void DecisionWriter::write(const Decision& decision) noexcept {
  append_csv(decision, text_);
  ++written_;
  if (text_.size() >= kTextMax) flush();
}

void DecisionWriter::drain() noexcept {
  while (const Decision* decision = queue_.front()) {
    write(*decision);
    queue_.pop();
  }
  flush();
}

void DecisionWriter::flush() noexcept {
  file_.write(text_);
  text_.clear();
}

}  // namespace tandem::netsim

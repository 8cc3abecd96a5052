#include "server/app/process/recorder.h"

#include <chrono>
#include <utility>

namespace tandem::server {

namespace {
constexpr std::size_t kRowsMax = 60'000;  // bytes that are collected before a write
}

Recorder::Recorder(const SceneSpec& scene, TickQueue& records, io::OutputFile& trace)
    : records_(&records), trace_(&trace), builder_(scene), csv_(scene), rows_(csv_.header()), thread_([this] {
        run();
      }) {}

void Recorder::finish() {
  finish_.store(true, std::memory_order_release);
  if (!thread_.joinable()) return;
  thread_.join();
  hash_ = digest_.hex();
}

void Recorder::run() {
  while (!finish_.load(std::memory_order_acquire)) {
    drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  drain();
  flush();
}

void Recorder::copy_to(std::shared_ptr<TickFeed> recording) {
  const std::lock_guard lock(lock_);
  recording_ = std::move(recording);
}

void Recorder::drain() {
  const std::lock_guard lock(lock_);
  for (const TickRecord* record = records_->front(); record != nullptr; record = records_->front()) {
    builder_.add(*record);
    csv_.append(*record, rows_);
    // Records from before the session knew of the recording stand for several ticks each.
    if (recording_ && record->every_tick) recording_->push(*record);
    records_->pop();
    if (rows_.size() > kRowsMax) flush();
  }
}

void Recorder::flush() {
  digest_.add(rows_);
  trace_->write(rows_);
  rows_.clear();
}

}  // namespace tandem::server

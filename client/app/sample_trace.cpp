#include "client/app/sample_trace.h"

#include <charconv>
#include <chrono>

namespace tandem::client {
namespace {

void put(std::string& out, double value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr);
  out += ',';
}

void put(std::string& out, const std::array<double, 3>& v) {
  for (const double x : v) put(out, x);
}

}  // namespace

SampleTrace::SampleTrace(io::OutputFile& file, std::size_t joints, bool prismatic) : file_(&file), joints_(joints) {
  rows_ = "t_s[s],";
  for (std::size_t j = 0; j < joints; ++j) rows_ += "q" + std::to_string(j) + (prismatic ? "[m]," : "[rad],");
  for (const char* name : {"x", "f_cmd", "f_gate", "f_out"})
    for (const char* axis : {"_x", "_y", "_z"})
      rows_ += (name[0] == 'x' ? std::string(1, axis[1]) + "[m]" : name + std::string(axis) + "[N]") + ",";
  rows_ += "gate[1],alpha[1],silence[s]\n";
  thread_ = std::thread([this] { work(); });
}

void SampleTrace::finish() {
  finish_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
}

void SampleTrace::work() {
  while (!finish_.load(std::memory_order_acquire)) {
    drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  drain();
}

void SampleTrace::drain() {
  while (const Sample* s = queue_.front()) {
    put(rows_, s->t_s);
    for (std::size_t j = 0; j < joints_; ++j) put(rows_, s->q[j]);
    put(rows_, s->x);
    put(rows_, s->f_cmd);
    put(rows_, s->f_gate);
    put(rows_, s->f_out);
    rows_ += static_cast<char>('0' + static_cast<int>(s->gate));
    rows_ += ',';
    put(rows_, s->alpha);
    put(rows_, s->silence_s);
    rows_.back() = '\n';
    queue_.pop();
  }
  file_->write(rows_);
  rows_.clear();
}

}  // namespace tandem::client

#include "common/io/log.h"

#include <spdlog/async.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <memory>

#include "common/io/clock.h"
#include "common/io/print.h"
#include "common/io/screen_block.h"
#include "common/io/text_layout.h"

namespace tandem::io {
namespace {

constexpr std::size_t kLinesMax = 8192;  // capacity of the write queue
constexpr char kMembers = '\x1f';        // first character of a payload that is already JSON

std::atomic<bool> as_json{false};
std::shared_ptr<spdlog::logger>& logger_before() {
  static std::shared_ptr<spdlog::logger> before;
  return before;
}

spdlog::level::level_enum level_of(Level level) {
  switch (level) {
    case Level::kInfo:
      return spdlog::level::info;
    case Level::kWarn:
      return spdlog::level::warn;
    case Level::kError:
      break;
  }
  return spdlog::level::err;
}

/// Appends a JSON string. Texts come from this program, or are UTF-8 that the codec has validated.
void append_quoted(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (u < 0x20 || u == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", u);
      out += escaped;
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_member(std::string& out, const char* key, std::string_view value) {
  if (value.empty()) return;
  out += ",\"";
  out += key;
  out += "\":";
  append_quoted(out, value);
}

class JsonLines final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
    const auto since_epoch = message.time.time_since_epoch();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
    const std::time_t whole = us / 1'000'000;
    std::tm utc{};
    gmtime_r(&whole, &utc);
    // The monotonic time of the event follows from both clocks now and the age of the event.
    const double ago =
        1e-6 *
        static_cast<double>(
            std::chrono::duration_cast<std::chrono::microseconds>(read_clock(CLOCK_REALTIME) - since_epoch).count());
    const double mono = seconds(monotonic_now()) - ago;
    char head[128];
    std::snprintf(head, sizeof head, "{\"ts\":\"%04d-%02d-%02dT%02d:%02d:%02d.%06ldZ\",\"mono\":%.6f,\"level\":\"%s\",",
                  utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                  static_cast<long>(us % 1'000'000), mono, name_of(message.level));
    std::string line = head;
    const std::string_view payload{message.payload.data(), message.payload.size()};
    if (!payload.empty() && payload.front() == kMembers) {
      line += payload.substr(1);
    } else {
      line += "\"event\":\"message\"";
      append_member(line, "text", payload);
    }
    line += "}\n";
    out.append(line.data(), line.data() + line.size());
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<JsonLines>(); }

 private:
  static const char* name_of(spdlog::level::level_enum level) {
    return level >= spdlog::level::err ? "error" : level == spdlog::level::warn ? "warn" : "info";
  }
};

/// Log lines for terminals. Long lines are wrapped between words at the terminal's present width, and a displayed
/// status block is cleared first.
class LinesForPeople final : public spdlog::formatter {
 public:
  LinesForPeople() : breaks_(text_width(stderr).has_value()) {}
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
    if (!breaks_) return pattern_.format(message, out);
    spdlog::memory_buf_t line;
    pattern_.format(message, line);
    const std::string_view clearing = ScreenBlock::take_clear_sequence();
    message.color_range_start += clearing.size();
    message.color_range_end += clearing.size();
    std::string text{clearing};
    std::string_view rest{line.data(), line.size()};
    const std::size_t width = text_width(stderr).value_or(79);
    while (!rest.empty()) {
      const std::string_view one = rest.substr(0, rest.find('\n'));
      for (const std::string& part : wrap_words(one, width, kIndent)) text += part + "\n";
      rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    }
    out.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<LinesForPeople>(); }

 private:
  static constexpr std::size_t kIndent = 4;
  bool breaks_;
  spdlog::pattern_formatter pattern_{"%n: %^%l%$: %v"};
};

}  // namespace

void log_to_stderr(const char* program) {
  auto logger = std::make_shared<spdlog::logger>(program, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_formatter(std::make_unique<LinesForPeople>());
  spdlog::set_default_logger(std::move(logger));
}

void log(Level level, const std::string& text) { spdlog::log(level_of(level), text); }

void log_as_json(Level least) {
  // The writing thread must inherit the signal mask, so call this after make_signalfd().
  spdlog::init_thread_pool(kLinesMax, 1);
  auto logger =
      std::make_shared<spdlog::async_logger>("json", std::make_shared<spdlog::sinks::stderr_sink_mt>(),
                                             spdlog::thread_pool(), spdlog::async_overflow_policy::overrun_oldest);
  logger->set_formatter(std::make_unique<JsonLines>());
  logger->set_level(level_of(least));
  logger_before() = spdlog::default_logger();
  spdlog::set_default_logger(std::move(logger));
  as_json = true;
}

bool logs_json() noexcept { return as_json; }

std::uint64_t log_dropped() {
  const auto pool = spdlog::thread_pool();
  return pool ? pool->overrun_counter() : 0;
}

void stop_log() {
  if (!as_json) return;
  if (const std::uint64_t dropped = log_dropped(); dropped > 0)
    log_event(Level::kWarn, {.event = "log_dropped", .text = std::to_string(dropped) + " lines were dropped"});
  as_json = false;
  spdlog::shutdown();
  spdlog::set_default_logger(std::move(logger_before()));
}

void log_event(Level level, const LogEvent& h) {
  if (!as_json) return;
  std::string line{kMembers};
  line += "\"event\":";
  append_quoted(line, h.event);
  append_member(line, "session", h.session);
  append_member(line, "seat", h.seat);
  if (h.cid) line += ",\"cid\":" + std::to_string(*h.cid);
  if (h.tick) line += ",\"tick\":" + std::to_string(*h.tick);
  append_member(line, "text", h.text);
  spdlog::log(level_of(level), "{}", line);
}

}  // namespace tandem::io

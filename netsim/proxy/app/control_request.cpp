#include "netsim/proxy/app/control_request.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "common/base/format.h"
#include "common/base/unit_suffix.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kCommandMax = 4096;
constexpr Duration kOutageMax = std::chrono::hours(1);

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while (true) {
    at = line.find_first_not_of(" \t\r\n", at);
    if (at == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(" \t\r\n", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

template <class T>
std::optional<T> number(std::string_view text) noexcept {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string quoted(std::string_view word) { return "\"" + std::string(word) + "\""; }

/// Parser of the words of one command; stops at the first error.
class ControlRequestParser {
 public:
  explicit ControlRequestParser(std::vector<std::string_view> words) : words_(std::move(words)) {}

  std::expected<ControlRequest, std::string> read() {
    if (words_.empty()) return std::unexpected(std::string("the command is empty; `help` lists the commands"));
    if (const std::string wrong = first(); !wrong.empty()) return std::unexpected(wrong);
    while (at_ < words_.size()) {
      if (const std::string wrong = next(); !wrong.empty()) return std::unexpected(wrong);
    }
    return std::move(request_);
  }

 private:
  using Kind = ControlRequest::Kind;

  std::string first() {
    constexpr std::array<std::pair<std::string_view, Kind>, 5> kAlone{{{"status", Kind::kStatus},
                                                                       {"reset", Kind::kReset},
                                                                       {"rebind", Kind::kRebind},
                                                                       {"help", Kind::kHelp},
                                                                       {"stop", Kind::kStop}}};
    for (const auto& [word, what] : kAlone) {
      if (words_[0] != word) continue;
      request_.kind = what;
      at_ = 1;
      if (what == Kind::kRebind && at_ < words_.size()) {
        if (const auto length = parse_length(words_[at_])) {
          if (*length > kOutageMax) return "rebind " + quoted(words_[at_]) + ": must be in [0, 1 h]";
          request_.dead_after = *length;
          ++at_;
        }
      }
    }
    return {};
  }

  std::string next() {
    const std::string_view word = words_[at_++];
    if (word == "client") return client();
    if (word == "up" || word == "down") {
      if (request_.kind != Kind::kChange && request_.kind != Kind::kReset) return unknown(word);
      request_.direction = word == "up" ? Direction::kUp : Direction::kDown;
      return {};
    }
    if (request_.kind == Kind::kStatus && (word == "--json" || word == "json")) {
      request_.json = true;
      return {};
    }
    if (request_.kind != Kind::kChange) return unknown(word);
    if (word == "profile" || word == "network") {
      if (at_ == words_.size())
        return std::string(word) + " needs a name or a file; `tandem-netsim profiles` lists them";
      request_.network = std::string(words_[at_++]);
      return {};
    }
    if (word == "outage") return outage();
    struct Key {
      std::string_view name;
      std::optional<double>& value;
      double max;
      const char* unit;
    };
    const std::array<Key, 5> keys{{{"delay", request_.numbers.delay_ms, 60'000, "ms"},
                                   {"jitter", request_.numbers.jitter_ms, 60'000, "ms"},
                                   {"loss", request_.numbers.loss_percent, 100, "%"},
                                   {"duplicate", request_.numbers.duplicate_percent, 100, "%"},
                                   {"reorder", request_.numbers.reorder_percent, 100, "%"}}};
    for (const Key& key : keys) {
      if (word != key.name) continue;
      const std::string must = format(" must be a number in [0, %.0f] %s", key.max, key.unit);
      if (at_ == words_.size()) return std::string(word) + must;
      const auto value = number<double>(strip_unit(words_[at_], key.unit));
      if (!value || !std::isfinite(*value) || *value < 0 || *value > key.max) {
        return std::string(word) + " " + quoted(words_[at_]) + ":" + must;
      }
      key.value = value;
      ++at_;
      return {};
    }
    return unknown(word);
  }

  std::string client() {
    bool any = false;
    while (at_ < words_.size()) {
      const auto n = number<std::uint64_t>(words_[at_]);
      if (!n) break;
      if (*n == 0) return "client \"0\": clients are numbered from 1, in order of arrival";
      request_.clients.push_back(*n);
      any = true;
      ++at_;
    }
    return any ? std::string{} : "client needs a number from 1, in order of arrival; `status` shows them";
  }

  std::string outage() {
    constexpr const char* kMust = ": must be a length above 0 and at most 1 h, such as 400ms, 0.4s or 2min";
    if (at_ == words_.size()) return std::string("outage") + kMust;
    const auto length = parse_length(words_[at_]);
    if (!length || *length <= Duration::zero() || *length > kOutageMax) return "outage " + quoted(words_[at_]) + kMust;
    request_.outage = *length;
    ++at_;
    using Mode = OutageSpec::Mode;
    constexpr std::array<std::pair<std::string_view, Mode>, 3> kModes{
        {{"drop", Mode::kDrop}, {"hold", Mode::kHold}, {"last", Mode::kHoldLast}}};
    for (const auto& [word, mode] : kModes) {
      if (at_ == words_.size() || words_[at_] != word) continue;
      request_.outage_mode = mode;
      ++at_;
      break;
    }
    return {};
  }

  std::string unknown(std::string_view word) const {
    if (at_ > 1)
      return quoted(word) + " is not understood after " + quoted(words_[at_ - 2]) + "; `help` lists the commands";
    return quoted(word) + " is not a command; `help` lists them";
  }

  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
  ControlRequest request_;
};

}  // namespace

std::expected<ControlRequest, std::string> parse_control_request(std::string_view line) {
  if (line.size() > kCommandMax) return std::unexpected(std::string("a command has at most 4096 characters"));
  return ControlRequestParser(words_of(line)).read();
}

std::optional<Duration> parse_length(std::string_view text) noexcept {
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
      {{"ms", 1e6}, {"us", 1e3}, {"min", 60e9}, {"s", 1e9}, {"h", 3600e9}}};
  for (const auto& [unit, ns] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto value = number<double>(text.substr(0, text.size() - unit.size()));
    if (!value || !std::isfinite(*value) || *value < 0 || *value * ns > 1e18) return std::nullopt;
    return Duration{std::llround(*value * ns)};
  }
  return std::nullopt;
}

const char* control_help() noexcept {
  return "  profile NAME|FILE    another network; `tandem-netsim profiles` lists them\n"
         "  delay MS             one-way delay\n"
         "  jitter MS            random additional delay up to MS\n"
         "  loss PERCENT         lost datagrams; numbers in one line change at one moment\n"
         "  duplicate PERCENT    datagrams that come twice\n"
         "  reorder PERCENT      datagrams that come out of order\n"
         "  outage LENGTH        the link is down from now on; datagrams are lost\n"
         "  outage LENGTH hold   the same; datagrams arrive afterwards\n"
         "  outage LENGTH last   the same; only the newest arrives afterwards\n"
         "  reset                the network at the start\n"
         "  rebind [LENGTH]      a new address towards the server; the old one receives\n"
         "                       for LENGTH more\n"
         "  ... client N [N...]  any of these for some clients, in order of arrival\n"
         "  ... up, ... down     any of these for one direction\n"
         "  status [--json]      clients, rates, losses\n"
         "  stop                 ends the proxy\n"
         "Lengths: 400ms, 0.4s, 2min. Example: delay 20 loss 2 client 2 up\n";
}

}  // namespace tandem::netsim

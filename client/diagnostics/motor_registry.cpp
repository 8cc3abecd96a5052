#include "client/diagnostics/motor_registry.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace tandem::client {
namespace {

constexpr std::size_t kDeviceMax = 120, kDigest = 64, kFields = 6;

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= kDeviceMax &&
         std::ranges::all_of(text, [](char c) { return c > ' ' && c < '\x7f'; });
}

bool is_digest(std::string_view text) {
  return text.size() == kDigest && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Returns the words of a line, at most kFields + 1.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (words.size() <= kFields) {
    const auto space = line.find(' ');
    words.push_back(line.substr(0, space));
    if (space == std::string_view::npos) break;
    line.remove_prefix(space + 1);
  }
  return words;
}

std::expected<MotorRecord, std::string> record_of(std::string_view line) {
  const auto words = words_of(line);
  if (words.size() != kFields || words[0] != "motors")
    return std::unexpected("is not `motors 1 DEVICE SHA256 confirmed|refused SECONDS`");
  if (words[1] != "1")
    return std::unexpected("is of version '" + std::string(words[1].substr(0, 20)) + "'; this program reads version 1");
  if (!is_word(words[2])) return std::unexpected("names no device");
  if (!is_digest(words[3])) return std::unexpected("has no SHA-256 of 64 hexadecimal digits");
  if (words[4] != "confirmed" && words[4] != "refused")
    return std::unexpected("has the verdict '" + std::string(words[4].substr(0, 20)) +
                           "', not `confirmed` or `refused`");
  MotorRecord record{std::string(words[2]), std::string(words[3]), words[4] == "confirmed", 0};
  const auto [end, error] = std::from_chars(words[5].data(), words[5].data() + words[5].size(), record.at);
  if (error != std::errc{} || end != words[5].data() + words[5].size() || record.at < 0)
    return std::unexpected("has no time in seconds");
  return record;
}

}  // namespace

std::expected<MotorRegistry, std::string> MotorRegistry::parse(std::string_view text) {
  MotorRegistry book;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const auto wrong = [&](const std::string& why) {
      return std::unexpected("line " + std::to_string(number) + " " + why);
    };
    if (end == std::string_view::npos) return wrong("has no end: the file is torn");
    auto record = record_of(text.substr(0, end));
    if (!record) return wrong(record.error());
    if (book.find(record->device, record->file_sha256) != nullptr)
      return wrong("repeats the device and file of an earlier line");
    if (book.records_.size() == kRecordsMax)
      return wrong("is one too many: at most " + std::to_string(kRecordsMax) + " are kept");
    book.records_.push_back(std::move(*record));
    text.remove_prefix(end + 1);
  }
  return book;
}

std::string MotorRegistry::text() const {
  std::string out;
  for (const MotorRecord& r : records_)
    out += "motors 1 " + r.device + " " + r.file_sha256 + (r.confirmed ? " confirmed " : " refused ") +
           std::to_string(r.at) + "\n";
  return out;
}

const MotorRecord* MotorRegistry::find(std::string_view device, std::string_view file_sha256) const noexcept {
  const auto found = std::ranges::find_if(
      records_, [&](const MotorRecord& r) { return r.device == device && r.file_sha256 == file_sha256; });
  return found == records_.end() ? nullptr : &*found;
}

void MotorRegistry::put(MotorRecord record) {
  std::erase_if(records_,
                [&](const MotorRecord& r) { return r.device == record.device && r.file_sha256 == record.file_sha256; });
  if (records_.size() == kRecordsMax) records_.erase(records_.begin());
  records_.push_back(std::move(record));
}

}  // namespace tandem::client

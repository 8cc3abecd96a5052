#include "server/service/spent_codes.h"

#include <algorithm>

#include "common/base/hex.h"
#include "server/service/registry_entries.h"

namespace tandem::server {

namespace {

std::string key_of(const std::string& name, const CodeRow& code) { return name + "/" + to_hex(code.hash); }

}  // namespace

void SpentCodes::note(const std::string& name, std::string_view before, std::string_view after) {
  const auto was = code_of(before), is = code_of(after);
  if (!was || (is && is->hash == was->hash)) return;
  codes_.insert_or_assign(key_of(name, *was), was->not_after);
  if (codes_.size() <= kMax) return;
  codes_.erase(std::ranges::min_element(codes_, {}, [](const auto& code) { return code.second; }));
}

std::string SpentCodes::without(const std::string& name, const std::string& text) const {
  if (codes_.empty()) return text;
  const auto code = code_of(text);
  return code && codes_.contains(key_of(name, *code)) ? without_code(text) : text;
}

void SpentCodes::forget_expired(std::int64_t now_s) {
  std::erase_if(codes_, [now_s](const auto& code) { return code.second < now_s; });
}

}  // namespace tandem::server

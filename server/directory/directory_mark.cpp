#include "server/directory/directory_mark.h"

#include <algorithm>
#include <utility>

namespace tandem::directory {

bool DirectoryMark::valid(std::string_view text) noexcept {
  constexpr std::size_t kTextMax = 64;
  return text.size() <= kTextMax && std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

std::string DirectoryMark::draw() {
  std::string drawn = drawn_ + (draws_ == 0 ? "" : "-" + std::to_string(draws_));
  ++draws_;
  return drawn;
}

void DirectoryMark::lose() {
  if (!known_.text.empty()) {
    ++losses_;
    lost_ = known_.text;
  }
  known_ = {};
}

void DirectoryMark::doubt() noexcept {
  answered_ = false;
  operation_ = 0;  // an answer of before does not count
  asked_.reset();
}

std::optional<Request> DirectoryMark::poll_request(Time now, OperationId operation, Duration retry_after) {
  if (answered_ || (asked_ && now - *asked_ < (operation_ != 0 ? retry_after : kAskAgain))) return std::nullopt;
  operation_ = operation;
  asked_ = now;
  expected_ = known_;
  return Transaction{{}, {Read{key_}}, {}};
}

DirectoryMark::Found DirectoryMark::on_reply(const Reply& reply) {
  if (operation_ == 0 || reply.operation != operation_) return Found::kNothing;
  operation_ = 0;
  if (reply.outcome != Outcome::kDone || reply.found.empty()) return Found::kSame;  // it is asked again
  answered_ = true;
  if (expected_.text.empty()) return Found::kSame;
  const auto& mark = reply.found[0];
  return !mark.empty() && same(expected_, {mark[0].value, mark[0].created}) ? Found::kSame : Found::kOther;
}

}  // namespace tandem::directory

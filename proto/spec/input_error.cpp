#include "proto/spec/input_error.h"

#include <algorithm>
#include <cstddef>

namespace tandem {
namespace {

/// Whether `key` is `around` or a descendant of it: `a.b[1].c` is within `a.b[1]`.
bool within(const std::string& key, const std::string& around) {
  return !around.empty() && key.starts_with(around) &&
         (key.size() == around.size() || key[around.size()] == '.' || key[around.size()] == '[');
}

bool explains(const InputError& earlier, const InputError& later) {
  return earlier.file == later.file && within(earlier.key, later.key);
}

}  // namespace

void add_unexplained(InputErrors& earlier, InputErrors later) {
  const std::size_t known = earlier.size();
  for (InputError& error : later) {
    const auto end = earlier.begin() + static_cast<std::ptrdiff_t>(known);
    if (std::none_of(earlier.begin(), end, [&](const InputError& e) { return explains(e, error); }))
      earlier.push_back(std::move(error));
  }
}

std::string to_text(const InputError& error) {
  std::string text = error.file;
  if (error.line > 0) text += ":" + std::to_string(error.line) + ":" + std::to_string(error.column);
  if (!text.empty()) text += ": ";
  if (!error.key.empty()) {
    text += error.key;
    if (!error.value.empty()) text += " = " + error.value;
    text += ": ";
  }
  return text + error.message;
}

std::string to_text(const InputErrors& errors) {
  std::string text;
  for (const auto& error : errors) text += to_text(error) + "\n";
  return text;
}

}  // namespace tandem

#include "proto/input_error.h"

namespace tandem {

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

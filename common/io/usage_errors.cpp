#include "common/io/usage_errors.h"

#include <algorithm>
#include <cstdio>

#include "common/io/exit_code.h"
#include "common/io/option_check.h"
#include "common/io/output_file.h"
#include "common/io/print.h"

namespace tandem::io {

void UsageErrors::add(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end > 0) lines_.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

void UsageErrors::add(std::string_view option, std::string_view problem) {
  if (!problem.empty()) add(std::string(option) + ": " + std::string(problem));
}

void UsageErrors::add(const std::vector<std::string>& errors) {
  for (const std::string& error : errors) add(error);
}

double UsageErrors::number(std::string_view option, std::string text, double lo, double hi, const std::string& unit) {
  const std::string problem = number_in(lo, hi, unit)(text);
  add(option, problem);
  return problem.empty() ? std::stod(text) : 0;
}

double UsageErrors::optional_number(std::string_view option, const std::string& text, double lo, double hi,
                                    const std::string& unit) {
  return text.empty() ? 0 : number(option, text, lo, hi, unit);
}

void UsageErrors::output_file(std::string_view option, const std::string& file) {
  if (!file.empty() && file != "-") add(option, OutputFile::problem(file));
}

std::size_t UsageErrors::count() const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(lines_, [](const std::string& line) { return !line.ends_with(':'); }));
}

int UsageErrors::print(std::string_view prefix) const {
  for (const std::string& line : lines_) io::print(stderr, std::string(prefix) + line + "\n");
  return kExitUsage;
}

std::string UsageErrors::count_text() const {
  return std::to_string(count()) + (count() == 1 ? " mistake" : " mistakes");
}

int UsageErrors::report(std::string_view command, std::string_view outcome) const {
  print("");
  io::print(stderr, std::string(command) + ": " + count_text() + ", " + std::string(outcome) + "\n");
  return kExitUsage;
}

int UsageErrors::report_each(std::string_view command) const {
  print(std::string(command) + ": ");
  io::print(stderr, count_text() + "; nothing was started\n");
  return kExitUsage;
}

int report_usage_error(std::string_view command, std::string_view text) {
  UsageErrors errors;
  errors.add(text);
  return errors.report_each(command);
}

}  // namespace tandem::io

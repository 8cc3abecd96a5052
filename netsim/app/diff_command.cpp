#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "common/io/whole_file.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/replay/lesson_diff.h"
#include "proto/recording/lesson_reader.h"

namespace tandem::netsim {
namespace {

constexpr std::uintmax_t kComparedMax = std::uintmax_t{1} << 32;  // [bytes]

struct DiffArguments {
  std::string a, b, json;
  std::vector<std::string> limits;
};

std::expected<Lesson, std::string> lesson_of(const std::string& file) {
  const auto bytes = io::read_whole_file(file, kComparedMax);
  if (!bytes) return std::unexpected(bytes.error());
  auto lesson = read_lesson(bytes_of(*bytes));
  if (!lesson) return std::unexpected(file + ": " + lesson.error());
  return lesson;
}

std::string diff_text(const LessonDiff& diff) {
  std::string text = format("%llu ticks compared", static_cast<unsigned long long>(diff.rows));
  if (diff.channels.empty()) return text + ": equal, bit for bit\n";
  text += diff.within() ? ": within the limits\n" : ": different\n";
  std::size_t width = 7;
  for (const ChannelDifference& c : diff.channels) width = std::max(width, c.channel.size());
  text += format("%-*s  %-14s %12s %12s %10s %10s  %s\n", static_cast<int>(width), "channel", "field", "difference",
                 "limit", "ticks", "at tick", "");
  for (const ChannelDifference& c : diff.channels)
    text += format("%-*s  %-14s %12.6g %12.6g %10llu %10u  %s\n", static_cast<int>(width), c.channel.c_str(),
                   c.field.c_str(), c.largest, c.limit, static_cast<unsigned long long>(c.rows),
                   static_cast<unsigned>(c.tick), c.beyond() ? "BEYOND" : "within");
  return text;
}

std::string diff_json(const LessonDiff& diff) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json json{{"within", diff.within()},
                              {"ticks", diff.rows},
                              {"only_a", diff.only_a},
                              {"only_b", diff.only_b},
                              {"channels", nlohmann::ordered_json::array()}};
  for (const ChannelDifference& c : diff.channels)
    json["channels"].push_back({{"channel", c.channel},
                                {"field", c.field},
                                {"difference", number(c.largest)},
                                {"limit", c.limit},
                                {"ticks", c.rows},
                                {"at_tick", c.tick},
                                {"a", number(c.a)},
                                {"b", number(c.b)},
                                {"beyond", c.beyond()}});
  return json.dump(2) + "\n";
}

int diff_command(const DiffArguments& arguments) {
  constexpr const char* kName = "tandem-netsim diff";
  io::UsageErrors mistakes;
  std::vector<DiffLimit> limits;
  for (const std::string& text : arguments.limits) {
    const auto limit = parse_diff_limit(text);
    if (limit)
      limits.push_back(*limit);
    else
      mistakes.add("--limit", limit.error());
  }
  if (!arguments.json.empty() && arguments.json != "-") mistakes.add("--json", io::OutputFile::problem(arguments.json));
  const auto a = lesson_of(arguments.a), b = lesson_of(arguments.b);
  if (!a) mistakes.add(a.error());
  if (!b) mistakes.add(b.error());
  if (!mistakes.empty()) return mistakes.report_each(kName);
  const auto diff = diff_lessons(*a, *b, limits);
  if (!diff) return io::report_usage_error(kName, diff.error());
  io::OutputFile json;
  if (const auto problem = json.open(arguments.json, true); !problem.empty())
    return io::report_usage_error(kName, "--json: " + problem);
  std::string text = diff_text(*diff);
  for (const auto& [file, lesson] : {std::pair{arguments.a, &*a}, std::pair{arguments.b, &*b}})
    if (!lesson->complete) text += "note: " + file + " has no undamaged end; its whole chunks were compared\n";
  io::print_formatted(json.on_stdout() ? stderr : stdout, "%s", text.c_str());
  json.write(diff_json(*diff));
  if (const auto problem = json.close(); !problem.empty()) {
    io::print_formatted(stderr, "%s: %s\n", kName, problem.c_str());
    return io::kExitTrouble;
  }
  return diff->within() ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_diff_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "diff", "Says whether two recordings differ beyond given limits, for golden lessons in CI.", diff_command);
  command.add_option("A.mcap", arguments.a, "a recording").value_name(" ").required();
  command.add_option("B.mcap", arguments.b, "another one with the same seats and tools").value_name(" ").required();
  command
      .add_option("--limit", arguments.limits,
                  "largest allowed difference on a channel, in its unit (m, m/s, N, rad, J): /tool/measured_cp=0.0005; "
                  "measured_cp=0.0005 for all seats and tools; /session/rows=N for ticks that only one has; may be "
                  "repeated, the last one decides; without it a channel must be equal, bit for bit")
      .value_name("CHANNEL=VALUE...")
      .one_value();
  command.add_option("--json", arguments.json, "writes the result; `-`: to standard output").value_name("FILE|-");
  command.footer(
      "Exit: 0 within the limits, 1 beyond, 2 wrong arguments, or files that cannot be compared.\n\n"
      "Examples\n"
      "  tandem-netsim diff golden.mcap lesson.mcap\n"
      "  tandem-netsim diff golden.mcap lesson.mcap --limit measured_cp=0.0005 --limit /session/rows=20");
}

}  // namespace tandem::netsim

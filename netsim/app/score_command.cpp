#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/format.h"
#include "common/base/suggestions.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/lesson_loader.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/score/score_output.h"
#include "netsim/score/score_page.h"

namespace tandem::netsim {
namespace {

struct ScoreArguments {
  std::vector<std::string> files, experts, learner, hands;
  std::string scene, seat, json, csv, html;
  score::ScoreOptions options;
  bool quiet = false, overwrite = false;
};

using Scored = std::vector<score::LessonScores>;
using Hands = std::vector<std::pair<std::string, std::string>>;

Hands hands_of(const ScoreArguments& a, io::UsageErrors& mistakes) {
  Hands out;
  for (const std::string& text : a.hands) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == text.size()) {
      mistakes.add("--hands " + text + ": must be two seats, such as left,right");
    } else {
      out.emplace_back(text.substr(0, comma), text.substr(comma + 1));
    }
  }
  return out;
}

/// Reads and scores files one after the other, so that one lesson is in memory at a time. A file of a folder without
/// scores is skipped with a note, unless the folder has no other.
/// @param last  receives the last lesson; null: not wanted
Scored score_files(const ScoreArguments& a, const std::vector<std::string>& paths, const char* option,
                   const Hands& hands, Lesson* last, std::vector<std::string>& notes, io::UsageErrors& mistakes) {
  const std::string prefix = *option == '\0' ? "" : std::string(option) + ": ";
  Scored out;
  const auto files = lesson_files(paths);
  if (!files) {
    mistakes.add(prefix + files.error());
    return out;
  }
  std::vector<std::string> skipped;
  for (const LessonFile& file : *files) {
    const auto refuse = [&](const std::string& why) {
      if (file.of_folder) {
        skipped.push_back(prefix + why);
      } else {
        mistakes.add(prefix + why);
      }
    };
    auto lesson = load_lesson(file, a.scene);
    if (!lesson) {
      refuse(lesson.error());
      continue;
    }
    auto scores = score::score_lesson(*lesson, a.options, hands);
    if (!scores) {
      refuse(file.name + ": " + scores.error());
      continue;
    }
    scores->file = file.name;
    if (!file.more.empty())
      scores->notes.push_back(format("The lesson has %zu files, of which this is the first.", file.more.size() + 1));
    if (!file.note.empty()) scores->notes.push_back("Scored without the other parts of the session: " + file.note);
    out.push_back(std::move(*scores));
    if (last != nullptr) *last = std::move(*lesson);
  }
  for (const std::string& why : skipped) {
    if (out.empty()) {
      mistakes.add(why);
    } else {
      notes.emplace_back("skipped: " + why);
    }
  }
  return out;
}

/// Returns the seat whose scores are compared: the named one, or the first trainee of the last lesson, or its first
/// seat.
std::string learner_seat(const ScoreArguments& a, const Scored& lessons, io::UsageErrors& mistakes) {
  if (lessons.empty()) return a.seat;
  const std::vector<score::SeatScore>& seats = lessons.back().seats;
  if (a.seat.empty()) {
    const auto trainee = std::ranges::find(seats, Role::kTrainee, &score::SeatScore::role);
    return trainee != seats.end() ? trainee->name : seats.empty() ? std::string() : seats.front().name;
  }
  if (lessons.back().seat(a.seat) == nullptr)
    mistakes.add("--seat: \"" + a.seat + "\" has no scores in " + lessons.back().file + "; " +
                 suggest_name(a.seat, seats));
  return a.seat;
}

int score_command(const ScoreArguments& a) {
  constexpr const char* kName = "tandem-netsim score";
  io::UsageErrors mistakes;
  const Hands hands = hands_of(a, mistakes);
  const std::array outputs{std::pair{"--json", &a.json}, std::pair{"--csv", &a.csv}, std::pair{"--html", &a.html}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    mistakes.output_file(outputs[i].first, *outputs[i].second);
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[i].second->empty() && *outputs[i].second == *outputs[j].second)
        mistakes.add(std::string(outputs[i].first) + ": is the same file as " + outputs[j].first);
  }
  if (std::error_code error; !a.overwrite && std::filesystem::is_regular_file(a.html, error))
    mistakes.add("--html: " + a.html + " exists already; choose another name, or replace it with --overwrite");
  std::vector<std::string> paths = a.files;
  paths.insert(paths.end(), a.learner.begin(), a.learner.end());
  for (const auto& [option, file] : outputs)
    for (const std::vector<std::string>* inputs : {&std::as_const(paths), &a.experts})
      for (const std::string& input : *inputs)
        if (std::error_code error; std::filesystem::equivalent(input, *file, error))
          mistakes.add(std::string(option) + ": " + *file + " is an input; name another file");
  if (paths.empty()) mistakes.add("FILE: at least one recording is needed, as FILE or with --learner");
  if (!mistakes.empty()) return mistakes.report_each(kName);

  score::ScoreResult result;
  Lesson last;
  result.lessons = score_files(a, paths, "", hands, a.html.empty() ? nullptr : &last, result.notes, mistakes);
  const Scored experts = score_files(a, a.experts, "--experts", hands, nullptr, result.notes, mistakes);
  if (!a.experts.empty() && experts.size() < score::kExpertsMin)
    mistakes.add(format("--experts: %zu recordings; thresholds need at least %zu", experts.size(), score::kExpertsMin));
  result.experts = experts.size();
  result.seat = learner_seat(a, result.lessons, mistakes);
  if (!mistakes.empty()) return mistakes.report_each(kName);
  result.thresholds = score::thresholds_of(experts, result.seat);
  result.curves = score::learning_curves(result.lessons, result.seat, result.thresholds, result.cusum);
  result.sheets = score::sheet_totals(result.lessons, result.notes);
  result.agreements = score::scale_agreements(result.lessons);
  if (experts.empty() && !a.learner.empty())
    result.notes.emplace_back("no --experts: there are no thresholds, so no learning curve");

  std::array<io::OutputFile, 3> files;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (const auto problem = files[i].open(*outputs[i].second, true); !problem.empty())
      return io::report_usage_error(kName, std::string(outputs[i].first) + ": " + problem);
  const bool on_stdout = a.json == "-" || a.csv == "-" || a.html == "-";
  if (!a.quiet) io::print(on_stdout ? stderr : stdout, scores_text(result, a.seat));
  if (files[0].is_open()) files[0].write(scores_json(result));
  if (files[1].is_open()) files[1].write(scores_csv(result));
  if (files[2].is_open()) files[2].write(score::score_page(last, result, TANDEM_VERSION));
  const int status = exit_status(kName, {files[0].close(), files[1].close(), files[2].close()}, true);
  if (status == io::kExitDone && !a.html.empty() && !a.quiet && !on_stdout)
    io::print(stdout, "report for the learner: " + a.html + "\n");
  return status;
}

}  // namespace

void add_score_command(const io::Command& root) {
  const auto [command, a] = root.add_command(
      "score", "Scores recorded sessions: motion, force, tracking, sharing, by holder of the tool and by phase.",
      score_command);
  command
      .add_option(
          "files", a.files,
          "recordings: MCAP files of --record, their exports as HDF5, rows of --trace (with --scene), or tables of "
          "recorded motion; a part of a long recording: all of them that lie beside it; "
          "a folder: all of its .mcap, .h5, .hdf5 and .csv files, and foreign or damaged ones are "
          "named and "
          "skipped")
      .value_name("FILE...");
  command.add_option("--scene", a.scene, "scene of a trace: a file, or the name of a shipped scene")
      .value_name("SCENE");
  command.add_option("--seat", a.seat, "the learner's seat; default: the first trainee").value_name("SEAT");
  command
      .add_option("--experts", a.experts,
                  "recordings of experts at the same seat, at least 3: median, deviation and pass mark of each score")
      .value_name("FILE|DIR...");
  command
      .add_option("--learner", a.learner,
                  "recordings of a learner's sessions, in time: learning curve and cumulative sum against the experts")
      .value_name("FILE...");
  command.add_option("--hands", a.hands, "two seats that are the hands of one person: LEFT,RIGHT; may be repeated")
      .value_name("SEAT,SEAT")
      .one_value();
  command.add_option("--authority", a.options.authority, "authority from which a seat holds the tool; default 0.5")
      .check(io::number_in(0.01, 1, ""))
      .value_name("A");
  command.add_option("--force-limit", a.options.force_limit, "limit of the time with excess force; default 2 N")
      .check(io::number_in(0.01, 1000, "N"))
      .value_name("N");
  command.add_option("--position-cutoff", a.options.position_cutoff_hz, "low-pass of positions; default 10 Hz")
      .check(io::number_in(0.1, 1000, "Hz"))
      .value_name("HZ");
  command.add_option("--force-cutoff", a.options.force_cutoff_hz, "low-pass of forces; default 20 Hz")
      .check(io::number_in(0.1, 1000, "Hz"))
      .value_name("HZ");
  command.add_option("--json", a.json, "writes all scores; `-`: to standard output").value_name("FILE|-");
  command.add_option("--csv", a.csv, "writes one line per score; `-`: to standard output").value_name("FILE|-");
  command
      .add_option("--html", a.html, "writes a report for the learner about the last recording; `-`: to standard output")
      .value_name("FILE|-");
  command.add_flag("--overwrite", a.overwrite, "replaces a report of the name --html");
  command.add_flag("--quiet", a.quiet, "prints no tables");
  command.footer(
      "Each score is split by the seat that held the tool and by the phases of the scene. A score is flagged (!) or "
      "withheld,\n"
      "with the reason, where samples are missing, the force gate tripped or force was cut. Definitions and sources:\n"
      "netsim/README.md, \"Scores\".\n\n"
      "Exit: 0 scored, 1 a file could not be written, 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim score lesson.mcap\n"
      "  tandem-netsim score lesson.mcap --seat trainee --html report.html\n"
      "  tandem-netsim score out.csv --scene contact\n"
      "  tandem-netsim score --experts experts --learner monday.mcap tuesday.mcap --json -");
}

}  // namespace tandem::netsim

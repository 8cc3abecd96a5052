#include "server/app/commands/run_scores.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/whole_file.h"
#include "netsim/score/score_output.h"
#include "server/archive/app/lesson_file.h"
#include "server/archive/io/part_files.h"

namespace tandem::server {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kReportBytesMax = std::uintmax_t{1} << 28;

/// Replaces the report by one with the scores. The old one stays until the new one is complete.
std::string put_scores(const std::string& report, const std::string& scores) {
  const auto text = io::read_whole_file(report, kReportBytesMax);
  if (!text) return text.error();
  Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) return report + ": is not the report of this run";
  json["scores"] = Json::parse(scores);
  const std::string made = report + ".new";
  io::OutputFile file;
  std::string problem = file.open(made, false);
  if (!problem.empty()) return problem;
  file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  problem = file.close();
  if (problem.empty() && std::rename(made.c_str(), report.c_str()) == 0) return {};
  if (problem.empty()) problem = report + " cannot be replaced";
  std::remove(made.c_str());
  return problem;
}

}  // namespace

std::string add_scores(const std::string& recording, const std::string& report, bool quiet) {
  const auto parts = find_parts({recording});
  if (!parts) return "--scores: " + parts.error();
  std::vector<std::string> files;
  for (const RecordedPart& part : *parts) files.push_back(part.file);
  const auto lesson = load_lesson(files);
  if (!lesson) return "--scores: " + (files.size() > 1 ? "" : recording + ": ") + lesson.error();
  const auto scores = netsim::score::score_lesson(*lesson);
  if (!scores) return "--scores: " + recording + ": " + scores.error();
  if (!quiet) io::print(stdout, netsim::score::main_scores_text(*scores));
  const std::string problem = report.empty() ? "" : put_scores(report, netsim::score::main_scores_json(*scores));
  return problem.empty() ? problem : "--scores: " + problem;
}

}  // namespace tandem::server

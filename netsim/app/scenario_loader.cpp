#include "netsim/app/scenario_loader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "common/base/suggestions.h"
#include "hal/io/motion_file.h"
#include "netsim/profiles/app/capacity_file.h"
#include "netsim/profiles/app/network_numbers.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/scenario/shipped_scenarios.h"
#include "proto/io/scene_file.h"
#include "proto/text/scenario_text.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/script_text.h"

namespace tandem::netsim {
namespace {

namespace fs = std::filesystem;

/// Returns an error of the scenario's own text; the caller adds its position.
InputErrors blame(std::string message) { return {{"", 0, 0, "", "", std::move(message)}}; }

/// Returns whether a name is a file: it has a slash or an extension. Other names are those of shipped items.
bool is_file(const std::string& word) { return word.find_first_of("/.") != std::string::npos; }

/// Resolves the names in a scenario.
class Folder {
 public:
  Folder(const std::string& scenario_file, bool shipped)
      : shipped_(shipped), folder_(fs::path(scenario_file).parent_path()) {}

  /// Returns the path to open, or the error.
  [[nodiscard]] std::expected<std::string, InputErrors> file(const std::string& word) const {
    if (shipped_) return std::unexpected(blame("a shipped scenario names shipped scenes and profiles only"));
    const fs::path path = fs::path(word).is_absolute() ? fs::path(word) : folder_ / word;
    std::error_code error;
    if (!fs::exists(path, error))
      return std::unexpected(
          blame("there is no file " + path.string() + " (names are relative to the scenario's folder)"));
    return path.string();
  }

  [[nodiscard]] std::expected<SceneSpec, InputErrors> scene(const std::string& word) const {
    if (is_file(word)) {
      const auto path = file(word);
      if (!path) return std::unexpected(path.error());
      return load_scene(fs::path(*path).is_absolute() || path->find('/') != std::string::npos ? *path : "./" + *path);
    }
    if (const EmbeddedFile* scene = find_shipped_scene(word)) return parse_scene(scene->text, word + ".textproto");
    std::vector<std::string> names;
    for (const EmbeddedFile& s : shipped_scenes()) names.emplace_back(s.name);
    return std::unexpected(
        blame("no scene has this name; " + suggest(word, names) + "; a file needs its ending, such as my.textproto"));
  }

  [[nodiscard]] std::expected<ScenarioLink, InputErrors> network(const ScenarioNetworkSpec& spec) const {
    ScenarioLink out;
    if (spec.profile) {
      auto found = profile(spec);
      if (!found) return found;
      out = std::move(*found);
    }
    const NetworkNumbers numbers{spec.delay_ms, spec.jitter_ms, spec.loss_percent, spec.duplicate_percent,
                                 spec.reorder_percent};
    numbers.apply(out.link);
    if (std::string problem = first_problem(out.link); !problem.empty())
      return std::unexpected(blame(std::move(problem)));
    const std::string words = numbers.text();
    out.description += (out.description.empty() || words.empty() ? "" : ", ") + words;
    if (out.description.empty()) out.description = "perfect";
    return out;
  }

  [[nodiscard]] std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, InputErrors> motion(
      const std::string& option) const {
    auto options = hal::sim::parse_motion_options(option);
    if (!options) return std::unexpected(blame(options.error()));
    const auto path = file(options->file);
    if (!path) return std::unexpected(path.error());
    options->file = *path;
    auto motion = hal::load_motion(*options);
    if (!motion) return std::unexpected(blame(motion.error()));
    return std::move(*motion);
  }

 private:
  /// Loads a profile with the options of the command line, so that the network equals that of --profile.
  [[nodiscard]] std::expected<ScenarioLink, InputErrors> profile(const ScenarioNetworkSpec& spec) const {
    const std::string& word = spec.profile->text;
    if (!is_file(word)) {
      auto shipped = shipped_profile(word);
      if (!shipped) return std::unexpected(blame(shipped.error().front().message));
      const auto capacity = complete_capacity(*shipped, "", "");
      if (!capacity) return std::unexpected(blame(capacity.error()));
      return ScenarioLink{shipped->link,
                          "profile " + shipped->name + " (version " + std::to_string(shipped->version) + ")"};
    }
    const auto path = file(word);
    if (!path) return std::unexpected(path.error());
    const auto choice = named_network(path->find('/') == std::string::npos ? "./" + *path : *path, "",
                                      spec.trace_interval_ms.value_or(0));
    if (!choice) return std::unexpected(blame(choice.error()));
    if (spec.trace_interval_ms && !choice->plays_interval)
      return std::unexpected(blame(
          "trace_interval_ms is for a recording without a column of times, and this one has its own; leave it out"));
    return ScenarioLink{choice->link, choice->description, choice->notes};
  }

  bool shipped_;
  fs::path folder_;
};

void append(InputErrors& all, const InputErrors& more) { all.insert(all.end(), more.begin(), more.end()); }

std::vector<std::string> files_of_folder(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".textproto") files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

/// Returns what a file is that is not a scenario; empty if it is no valid scene, profile or script.
std::string other_kind(const std::string& text, const std::string& file) {
  if (parse_scene(text, file)) return "a scene";
  if (parse_profile(text, file)) return "a profile";
  // Whether its clients are seats or numbers depends on its user.
  const ScriptReading script = read_script_text(text, file, {});
  const auto of_client = [](const InputError& error) { return error.key.find(".client[") != std::string::npos; };
  return script.spec && std::ranges::all_of(script.errors, of_client) ? "a script" : "";
}

/// Returns the kind of a file without `scene`, and its errors. It chooses the kind with the fewest errors, and a
/// scenario last.
std::pair<std::string, InputErrors> nearest_kind(const std::string& text, const std::string& file,
                                                 InputErrors as_scenario) {
  std::pair<std::string, InputErrors> best{"scenario", std::move(as_scenario)};
  const auto look = [&](const char* kind, InputErrors errors) {
    if (!errors.empty() && errors.size() < best.second.size()) best = {kind, std::move(errors)};
  };
  if (auto profile = parse_profile(text, file); !profile) look("profile", std::move(profile.error()));
  if (auto scene = parse_scene(text, file); !scene) look("scene", std::move(scene.error()));
  look("script", read_script_text(text, file, {}).errors);
  return best;
}

}  // namespace

std::expected<Scenario, InputErrors> load_scenario_text(const std::string& text, const std::string& file_name,
                                                        bool shipped) {
  ScenarioReading reading = read_scenario_text(text, file_name);
  if (!reading.spec) return std::unexpected(std::move(reading.errors));
  const Folder folder(file_name, shipped);
  return make_scenario(*reading.spec,
                       {.scene = [&](const std::string& word) { return folder.scene(word); },
                        .network = [&](const ScenarioNetworkSpec& network) { return folder.network(network); },
                        .motion = [&](const std::string& option) { return folder.motion(option); }},
                       std::move(reading.errors));
}

std::expected<std::vector<Scenario>, InputErrors> load_scenarios(const std::vector<std::string>& arguments,
                                                                 std::vector<std::string>* left_out) {
  std::vector<Scenario> scenarios;
  InputErrors errors;
  std::set<std::string> seen;
  const auto take = [&](std::expected<Scenario, InputErrors> scenario, const std::string& as) {
    if (!scenario) return append(errors, scenario.error());
    scenario->file = as;
    scenarios.push_back(std::move(*scenario));
  };
  const auto shipped = [&](const EmbeddedFile& s) {
    if (seen.insert(std::string(s.name)).second)
      take(load_scenario_text(std::string(s.text), std::string(s.name) + ".textproto", true), std::string(s.name));
  };
  const auto read = [&](const std::string& path) -> std::optional<std::string> {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    if (!seen.insert(whole.string()).second) return {};
    auto text = read_text_file(path);
    if (text) return std::move(*text);
    append(errors, text.error());
    return {};
  };
  const auto from_file = [&](const std::string& path) {
    if (const auto text = read(path)) take(load_scenario_text(*text, path, false), path);
  };
  const auto from_folder = [&](const std::string& folder) {
    const auto files = files_of_folder(folder);
    std::string others;
    bool any = false;
    for (const std::string& file : files) {
      const std::size_t before = scenarios.size() + errors.size();
      const auto text = read(file);
      if (text) {
        auto scenario = load_scenario_text(*text, file, false);
        const std::string kind = scenario ? "" : other_kind(*text, file);
        if (!kind.empty()) {
          others += (others.empty() ? "" : ", ") + fs::path(file).filename().string() + " (" + kind + ")";
          continue;
        }
        const bool without_scene =
            !scenario && std::ranges::find(scenario.error(), "scene", &InputError::key) != scenario.error().end();
        if (without_scene) {
          auto [as, mistakes] = nearest_kind(*text, file, std::move(scenario.error()));
          errors.push_back({file, 0, 0, "", "", "is no scene, profile or script without mistakes; as a " + as + ":"});
          scenario = std::unexpected(std::move(mistakes));
        }
        take(std::move(scenario), file);
      }
      any = any || !text || scenarios.size() + errors.size() > before;
    }
    if (!any)
      errors.push_back(
          {folder, 0, 0, "", "",
           files.empty() ? "this folder holds no *.textproto" : "this folder holds no scenario, only " + others});
    if (left_out != nullptr && !others.empty())
      left_out->push_back(folder + ": left out, as they are no scenarios: " + others);
  };
  for (const std::string& argument : arguments) {
    std::error_code error;
    const EmbeddedFile* const named = find_shipped_scenario(argument);
    if (argument == kAllShipped) {
      for (const EmbeddedFile& s : shipped_scenarios()) shipped(s);
    } else if (fs::is_directory(argument, error)) {
      from_folder(argument);
    } else if (named != nullptr && !fs::exists(argument, error)) {
      shipped(*named);
    } else if (fs::exists(argument, error)) {
      from_file(argument);
    } else if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory) {
      errors.push_back({argument, 0, 0, "", "", "cannot be read: " + error.message()});
    } else {
      std::vector<std::string> names{std::string(kAllShipped)};
      for (const EmbeddedFile& s : shipped_scenarios()) names.emplace_back(s.name);
      errors.push_back({argument, 0, 0, "", "",
                        "no such file or folder, and no shipped scenario of this name; " +
                            suggest(fs::path(argument).stem().string(), names)});
    }
  }
  if (!errors.empty()) return std::unexpected(std::move(errors));
  return scenarios;
}

}  // namespace tandem::netsim

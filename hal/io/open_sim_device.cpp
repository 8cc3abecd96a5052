#include "hal/io/open_sim_device.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/suggestions.h"
#include "hal/io/motion_file.h"
#include "hal/io/sim_servo.h"

namespace tandem::hal {
namespace {

using Text = std::string_view;

constexpr std::array<std::pair<Text, HandModel>, 7> kHands{{{"none", HandModel::kNone},
                                                            {"leader", HandModel::kLeader},
                                                            {"relaxed", HandModel::kRelaxed},
                                                            {"resting", HandModel::kResting},
                                                            {"letting_go", HandModel::kLettingGo},
                                                            {"tremor", HandModel::kTremor},
                                                            {"keyboard", HandModel::kKeyboard}}};
constexpr std::array<Text, 11> kOptions{"hand",  "keyboard", "motion", "model",  "columns", "rec",
                                        "scale", "axes",     "end",    "middle", "seat"};
constexpr Text kRecordingEnding = ".mcap";

/// Returns the error `WHAT 'word' is unknown; ...` with the nearest word and all valid ones.
template <class Words>
DeviceError unknown(Text what, Text word, const Words& words) {
  const std::vector<std::string> known(words.begin(), words.end());
  return {Errc::kNotFound, "device: " + std::string(what) + " '" + std::string(word.substr(0, 60)) + "' is unknown; " +
                               suggest(word, known)};
}

DeviceError bad(std::string message) { return {Errc::kUnsupported, "device: " + std::move(message)}; }

struct Choice {
  std::optional<HandModel> hand;
  std::optional<DeviceModel> model;
  std::optional<sim::MotionOptions> motion;
  std::string recorded_seat;  ///< of a recording; empty: the caller's own

  [[nodiscard]] bool plays_recording() const { return motion && motion->file.ends_with(kRecordingEnding); }
};

Result<> select_device(Choice& choice, Text name, std::optional<Text> value) {
  if (std::find(kOptions.begin(), kOptions.end(), name) == kOptions.end()) {
    return std::unexpected(unknown("option", name, kOptions));
  }
  if (name == "keyboard") {
    if (value) return std::unexpected(bad("keyboard takes no value"));
    choice.hand = HandModel::kKeyboard;
    return {};
  }
  if (!value || value->empty())
    return std::unexpected(bad("option " + std::string(name) + " needs a value: " + std::string(name) + "=..."));
  if (name == "hand") {
    for (const auto& [word, model] : kHands) {
      if (word == *value) {
        choice.hand = model;
        return {};
      }
    }
    std::array<Text, kHands.size()> words;
    std::transform(kHands.begin(), kHands.end(), words.begin(), [](const auto& h) { return h.first; });
    return std::unexpected(unknown("hand", *value, words));
  }
  if (name == "model") {
    if (*value == "touch")
      choice.model = DeviceModel::kTouch;
    else if (*value == "linear")
      choice.model = DeviceModel::kLinear;
    else
      return std::unexpected(unknown("model", *value, std::array<Text, 2>{"touch", "linear"}));
    return {};
  }
  if (name == "motion") {
    if (choice.motion) return std::unexpected(bad("motion is given twice"));
    choice.motion.emplace().file = *value;
    return {};
  }
  if (!choice.motion)
    return std::unexpected(bad(std::string(name) + " belongs to a recorded motion: motion=FILE.csv or " +
                               "motion=FILE.mcap must come before it"));
  if (choice.plays_recording() != (name == "seat"))
    return std::unexpected(bad(std::string(name) + "=" + std::string(value->substr(0, 60)) + ": " +
                               (name == "seat" ? "belongs to a recording (motion=FILE.mcap); " + choice.motion->file +
                                                     " is read as a table of motion"
                                               : "a recording (" + choice.motion->file + ") takes seat=NAME only")));
  if (name == "seat") {
    choice.recorded_seat = *value;
    return {};
  }
  if (auto ok = sim::set_motion_option(*choice.motion, name, *value); !ok) return std::unexpected(bad(ok.error()));
  return {};
}

Result<Choice> parse(Text spec) {
  const auto colon = spec.find(':');
  const Text backend = spec.substr(0, colon);
  if (backend != "sim") return std::unexpected(unknown("backend", backend, std::array<Text, 1>{"sim"}));
  Choice choice;
  if (colon == Text::npos) return choice;
  Text rest = spec.substr(colon + 1);
  std::vector<Text> seen;
  std::optional<DeviceError> mistakes;  // all errors are reported together
  const auto told = [&](DeviceError error) {
    if (mistakes) {
      mistakes->message += "\n" + error.message;
    } else {
      mistakes = std::move(error);
    }
  };
  while (true) {
    const auto comma = std::min(rest.find(','), rest.size());
    const Text part = rest.substr(0, comma);
    const auto equals = part.find('=');
    const Text name = part.substr(0, equals);
    if (part.empty()) {
      told(bad("an option is missing in '" + std::string(spec) + "'"));
    } else if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
      told(bad(std::string(name) + " is given twice"));
    } else if (auto ok =
                   select_device(choice, name, equals == Text::npos ? std::optional<Text>{} : part.substr(equals + 1));
               !ok) {
      told(std::move(ok.error()));
    }
    seen.push_back(name);
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  if (choice.motion && choice.hand) told(bad("motion and hand exclude each other"));
  if (mistakes) return std::unexpected(std::move(*mistakes));
  return choice;
}

Text name_of(HandModel model) {
  for (const auto& [word, m] : kHands) {
    if (m == model) return word;
  }
  return "recorded";
}

}  // namespace

Result<OpenedSim> open_sim_device(Text spec, const SimDeviceSpec& base, const HandSpec& hand,
                                  const EnvironmentSpec& environment, Time start,
                                  const RecordingMotionReader& recordings) {
  auto choice = parse(spec);
  if (!choice) return std::unexpected(std::move(choice.error()));
  sim::SimSetup setup{base, hand, environment, nullptr, start};
  if (choice->model) setup.device.model = *choice->model;
  if (choice->motion) choice->hand = HandModel::kRecorded;
  if (choice->hand && *choice->hand != hand.model && moved_by_person(*choice->hand)) {
    setup.hand = person_instead_of(hand, *choice->hand);
  } else if (choice->hand && *choice->hand != hand.model) {
    setup.hand.model = *choice->hand;
    setup.hand.k = setup.hand.b = setup.hand.m = 0.0;  // 0: values of the new model
  }
  OpenedSim opened;
  opened.note = "simulated " + std::string(setup.device.model == DeviceModel::kTouch ? "Touch" : "one-axis device") +
                ", hand " + std::string(name_of(setup.hand.model));
  if (choice->motion) {
    if (choice->plays_recording() && !recordings)
      return std::unexpected(bad("motion=" + choice->motion->file + ": this program reads no recordings; " +
                                 "tandem-server recordings export makes a table (CSV) of one"));
    auto motion = choice->plays_recording() ? recordings(choice->motion->file, choice->recorded_seat, setup.hand)
                                            : load_motion(*choice->motion);
    if (!motion) return std::unexpected(DeviceError{Errc::kNotFound, std::move(motion.error())});
    setup.motion = std::move(*motion);
    opened.note += " from " + choice->motion->file + ": " + setup.motion->describe();
  }
  auto device = sim::SimDevice::make(setup);
  if (!device) return std::unexpected(std::move(device.error()));
  opened.device = std::move(*device);
  opened.id = {"sim", std::string(spec)};
  return opened;
}

LiveSim make_live(OpenedSim opened, Duration period) {
  LiveSim live;
  live.sim = opened.device.get();
  live.note = std::move(opened.note);
  live.device = std::make_unique<SimServo>(std::move(opened.device), std::move(opened.id), period);
  return live;
}

}  // namespace tandem::hal

#include "netsim/profiles/app/network_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "common/base/format.h"
#include "common/base/milliseconds.h"
#include "common/base/unit_suffix.h"
#include "common/io/command_line.h"
#include "common/io/whole_file.h"
#include "netsim/profiles/app/capacity_file.h"
#include "netsim/profiles/app/network_numbers.h"
#include "netsim/profiles/network_csv.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/profiles/schedule_loader.h"

namespace tandem::netsim {
namespace {

constexpr std::uintmax_t kFileMax = 64U << 20;
/// Options that --network excludes; the others of the network follow.
constexpr std::array kExcluded{"--delay",   "--jitter", "--loss",    "--duplicate",
                               "--reorder", "--outage", "--profile", "--capacity"};
constexpr std::array kOthers{"--network", "--trace-interval", "--script", "--seed"};

/// Returns whether a name denotes a file: an existing file, or a name with a slash or a dot.
bool is_file(const std::string& name) {
  return std::filesystem::exists(name) || name.find('/') != std::string::npos || name.find('.') != std::string::npos;
}

/// @param file  file of the profile; empty: shipped profile
std::expected<NetworkChoice, std::string> from_profile(std::expected<Profile, InputErrors> profile,
                                                       const std::string& file, const std::string& capacity_file) {
  if (!profile) return std::unexpected(lines_of(profile.error()));
  const auto capacity = complete_capacity(*profile, file, capacity_file);
  if (!capacity) return std::unexpected(capacity.error());
  return NetworkChoice{.link = std::move(profile->link),
                       .name = profile->name,
                       .description = "profile " + (file.empty() ? profile->name : file) + " (version " +
                                      std::to_string(profile->version) + ")" +
                                      (capacity->empty() ? "" : ", " + *capacity),
                       .notes = {},
                       .plays_capacity = !capacity->empty()};
}

}  // namespace

void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
  for (const std::string& note : more)
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

std::string lines_of(const InputErrors& errors) {
  std::string text = to_text(errors);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

std::expected<std::string, std::string> read_network_file(const std::string& path) {
  return io::read_whole_file(path, kFileMax);
}

std::expected<OutageSpec, std::string> parse_outage(const std::string& text) {
  const auto wrong = [&text](const std::string& why) { return std::unexpected("--outage: \"" + text + "\": " + why); };
  std::array<double, 3> values{};
  std::size_t count = 0;
  std::istringstream cells(text);
  for (std::string cell; std::getline(cells, cell, ','); ++count) {
    double value = 0;
    const std::string_view bare = strip_unit(cell, "s");
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (count >= values.size() || error != std::errc{} || end != bare.data() + bare.size() || !std::isfinite(value)) {
      return wrong("must be START,LENGTH or START,LENGTH,PERIOD: numbers of seconds, such as 12,0.4 or 12s,0.4s");
    }
    values[count] = value;
  }
  if (count < 2)
    return wrong("must be START,LENGTH or START,LENGTH,PERIOD: numbers of seconds, such as 12,0.4 or 12s,0.4s");
  const auto [start, length, period] = values;
  if (start < 0 || start > 2'592'000) return wrong("START must be in [0, 2592000] s");
  if (!(length > 0 && length <= 3600)) return wrong("LENGTH must be in (0, 3600] s");
  if (count == 3 && !(period > length && period <= 2'592'000)) {
    return wrong("PERIOD must be longer than LENGTH and at most 2592000 s");
  }
  return OutageSpec{.start = from_seconds(start), .length = from_seconds(length), .period = from_seconds(period)};
}

std::expected<NetworkChoice, std::string> named_network(const std::string& name_or_file, const std::string& capacity,
                                                        double trace_interval_ms) {
  if (!is_file(name_or_file)) return from_profile(shipped_profile(name_or_file), "", capacity);
  const auto text = read_network_file(name_or_file);
  if (!text) return std::unexpected(text.error());
  const std::string name = std::filesystem::path(name_or_file).stem().string();
  if (looks_like_capacity(*text)) {
    auto recorded = parse_capacity_file(*text, name_or_file);
    if (!recorded) return std::unexpected(recorded.error());
    return NetworkChoice{
        .link = std::move(recorded->link), .name = name, .description = std::move(recorded->description), .notes = {}};
  }
  if (!name_or_file.ends_with(".csv")) return from_profile(parse_profile(*text, name_or_file), name_or_file, capacity);
  const auto recorded = parse_network_csv(*text, name_or_file, from_milliseconds(trace_interval_ms));
  if (!recorded) return std::unexpected(lines_of(recorded.error()));
  return NetworkChoice{
      .link = recorded->link,
      .name = name,
      .description = format("recording %s: %zu rows, %zu lost, %g s, then from the start again", name_or_file.c_str(),
                            recorded->rows, recorded->lost, seconds(recorded->length)),
      .notes = notes_of(*recorded, name_or_file),
      .plays_interval = !recorded->timed};
}

void NetworkOptions::add_to(const io::Command& command) {
  command_ = command;
  const std::string group = "Network (each direction)";
  const auto number = [&](const char* option, double& value, double hi, const std::string& unit, const char* help) {
    command.add_option(option, value, help)
        .check(io::number_in(0, hi, unit))
        .value_name(unit == "ms" ? "MS" : "PERCENT")
        .group(group);
  };
  number("--delay", delay_ms_, 60'000, "ms", "constant delay [ms], 0 to 60000; default 0");
  number("--jitter", jitter_ms_, 60'000, "ms",
         "adds a delay uniform in [0, MS] to every datagram [ms], 0 to 60000; order is kept");
  number("--loss", loss_percent_, 100, "%", "datagrams lost, each alone [%], 0 to 100");
  number("--duplicate", duplicate_percent_, 100, "%", "datagrams that come twice, the copy within 1 ms [%], 0 to 100");
  number("--reorder", reorder_percent_, 100, "%", "datagrams that arrive after three later ones [%], 0 to 100");
  command
      .add_option("--outage", outages_,
                  "the link is down from START for LENGTH, again every PERIOD [s]; datagrams sent meanwhile are lost; "
                  "may be given several times")
      .value_name("START,LENGTH[,PERIOD]")
      .one_value()
      .group(group);
  command
      .add_option("--profile", profile_,
                  "a named network (`tandem-netsim profiles` lists them) or a .textproto file; numbers given beside "
                  "it replace its own")
      .value_name("NAME|FILE")
      .group(group);
  command
      .add_option(
          "--capacity", capacity_,
          "the recorded capacity that the profile plays (4g-trace): mahimahi's file, one millisecond per line and "
          "opportunity to send 1500 bytes, or a table "
          "direction[up|down],t_ms[ms],opportunities[count]")
      .value_name("FILE")
      .group(group);
  command
      .add_option("--network", network_,
                  "a profile or a file, as --profile takes, or a recording: .csv with a column rtt_ms or delay_ms "
                  "(empty: lost) and t_s or t_send_s; "
                  "or a recorded capacity: mahimahi's file, or .csv with "
                  "direction[up|down],t_ms[ms],opportunities[count]; excludes the "
                  "numbers")
      .value_name("NAME|FILE")
      .group(group);
  command
      .add_option("--trace-interval", trace_interval_ms_,
                  "time between the rows of a recording without a time column [ms]")
      .check(io::number_in(0.001, 60'000, "ms"))
      .value_name("MS")
      .group(group);
  command
      .add_option("--script", script_,
                  "schedule of changes: outages, other networks, other addresses at given times; a .textproto "
                  "file of `event { at_s: 12 client: \"trainee\" outage_ms: 400 }`, schema proto/schema/script.proto")
      .value_name("FILE")
      .group(group);
  command.add_option("--seed", seed_, "the same seed gives the same network; default 1")
      .check(io::whole_number())
      .value_name("N")
      .group(group);
}

std::expected<NetworkChoice, std::string> NetworkOptions::resolve() const {
  auto choice = network();
  // A script may name the recording that needs --trace-interval; events() checks that case.
  if (choice && !given("--script"))
    if (std::string wrong = interval_problem(*choice); !wrong.empty()) return std::unexpected(std::move(wrong));
  return choice;
}

bool NetworkOptions::given(const char* option) const { return command_.given(option); }

std::string NetworkOptions::interval_problem(const NetworkChoice& choice) const {
  if (!given("--trace-interval") || choice.plays_interval) return {};
  // With --control, the user may name such a recording while the proxy runs.
  if (given("--control")) return {};
  return "--trace-interval: is for a recording without a column of times, and " + choice.description +
         " is none; leave it out";
}

std::expected<NetworkChoice, std::string> NetworkOptions::network() const {
  if (given("--network")) {
    std::string mistakes;
    for (const char* option : kExcluded) {
      if (given(option)) mistakes += std::string(mistakes.empty() ? "" : "\n") + "--network excludes " + option;
    }
    if (!mistakes.empty()) return std::unexpected(mistakes);
    return named(network_);
  }

  if (given("--capacity") && !given("--profile")) {
    return std::unexpected(
        "--capacity: belongs to --profile 4g-trace or another that plays it; --network FILE plays it "
        "alone");
  }
  NetworkChoice choice;
  choice.name = "custom";
  if (given("--profile")) {
    auto profile = named(profile_);
    if (!profile) return profile;
    if (given("--capacity") && !profile->plays_capacity) {
      return std::unexpected("--capacity: profile " + profile->name +
                             " plays no recorded capacity; 4g-trace does, or a " + "profile with rate { capacity {} }");
    }
    choice = std::move(*profile);
  }
  for (const std::string& text : outages_) {
    const auto outage = parse_outage(text);
    if (!outage) return std::unexpected(outage.error());
    for (const Direction direction : {Direction::kUp, Direction::kDown})
      choice.link[direction].outages.push_back(*outage);
  }
  const auto number = [&](const char* option, double value) {
    return given(option) ? std::optional(value) : std::nullopt;
  };
  const NetworkNumbers numbers{
      .delay_ms = given("--profile") ? number("--delay", delay_ms_) : delay_ms_,
      .jitter_ms = number("--jitter", jitter_ms_),
      .loss_percent = number("--loss", loss_percent_),
      .duplicate_percent = number("--duplicate", duplicate_percent_),
      .reorder_percent = number("--reorder", reorder_percent_),
  };
  numbers.apply(choice.link);
  if (std::string problem = first_problem(choice.link); !problem.empty()) return std::unexpected(std::move(problem));
  const std::string words = numbers.text();
  choice.description += (choice.description.empty() || words.empty() ? "" : ", ") + words;
  for (const std::string& outage : outages_) choice.description += ", outage " + outage + " s";
  return choice;
}

std::expected<ScriptChoice, std::string> NetworkOptions::events(std::span<const std::string> clients) const {
  ScriptChoice script;
  if (!given("--script")) return script;
  const auto text = read_network_file(script_);
  if (!text) return std::unexpected("--script: " + text.error());
  bool plays_interval = false;
  const auto find = [&](const std::string& name) -> std::expected<LinkSpec, InputErrors> {
    const bool file = name.find_first_of("/.") != std::string::npos;
    const bool beside = file && !std::filesystem::path(name).is_absolute();
    auto choice = named(beside ? (std::filesystem::path(script_).parent_path() / name).string() : name);
    if (choice) {
      plays_interval = plays_interval || choice->plays_interval;
      add_notes(script.notes, choice->notes);
      return std::move(choice->link);
    }
    return std::unexpected(InputErrors{{"", 0, 0, "", "", choice.error()}});
  };
  auto events = parse_script(*text, script_, clients, find);
  if (!events) return std::unexpected(lines_of(events.error()));
  if (!plays_interval)
    if (const auto base = network())
      if (std::string wrong = interval_problem(*base); !wrong.empty())
        return std::unexpected(wrong + ", and the script names none");
  script.events = std::move(*events);
  return script;
}

std::vector<std::string> NetworkOptions::all_given() const {
  std::vector<std::string> all;
  for (const std::span<const char* const> options : {std::span<const char* const>(kExcluded), {kOthers}})
    std::ranges::copy_if(options, std::back_inserter(all), [&](const char* option) { return given(option); });
  return all;
}

}  // namespace tandem::netsim

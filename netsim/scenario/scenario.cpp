#include "netsim/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/milliseconds.h"
#include "common/base/suggestions.h"
#include "hal/sim/recorded_motion.h"
#include "netsim/profiles/schedule_loader.h"
#include "netsim/system/session_notes.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

class ScenarioBuilder {
 public:
  ScenarioBuilder(const ScenarioSpec& spec, const ScenarioSources& sources, InputErrors known)
      : spec_(spec), sources_(sources), known_(std::move(known)) {}

  std::expected<Scenario, InputErrors> make() {
    out_.name = spec_.name;
    out_.file = spec_.file;
    out_.summary = spec_.summary;
    out_.scene = spec_.scene.text;
    out_.seed = spec_.seed;
    out_.seeds = spec_.seeds;
    std::expected<SceneSpec, InputErrors> scene = std::unexpected(InputErrors{});
    if (!spec_.scene.text.empty()) scene = sources_.scene(spec_.scene.text);
    if (scene) {
      out_.setup.scene = std::move(*scene);
    } else {
      add(spec_.scene.place, scene.error());
    }
    if (spec_.duration_s && !blamed("duration_s")) out_.setup.scene.duration = *spec_.duration_s;
    if (scene && !spec_.duration_s && out_.setup.scene.endless())
      add(spec_.scene.place, endless_scene_error(spec_.scene.text, "give the scenario a duration_s"));
    if (spec_.channel) choose_law(out_.setup.scene, *spec_.channel);
    if (spec_.mfs) out_.setup.scene.channel.mfs = *spec_.mfs;
    if (const auto problem = law_problem(out_.setup.scene))
      add(spec_.scene.place, problem->key + ": " + problem->words);
    for (const SeatSpec& s : out_.setup.scene.seats) {
      seats_.push_back(s.name);
      if (s.kind == SeatKind::kMaster) masters_.push_back(s.name);
    }
    for (const ToolSpec& t : out_.setup.scene.tools) tools_.push_back(t.name);
    for (const PhaseSpec& p : out_.setup.scene.phases) phases_.push_back(p.name);
    networks();
    events();
    if (scene) {  // without a scene every name would be unknown
      hands();
      faults();
      endpoints();
      for (const ScenarioLimitSpec& limit : spec_.limits) add_limit(limit);
    }
    add_unexplained(known_, std::move(errors_));
    if (!known_.empty()) return std::unexpected(sorted());
    return std::move(out_);
  }

 private:
  void add(const ScenarioLocation& at, std::string message) {
    errors_.push_back({spec_.file, at.line, at.column, at.key, at.value, std::move(message)});
  }
  void add(const ScenarioLocation& at, const InputErrors& others) {
    for (const InputError& e : others) {
      if (e.file.empty()) {
        add(at, e.message);
      } else {
        errors_.push_back(e);
      }
    }
  }
  InputErrors sorted() {
    std::ranges::stable_sort(
        known_, {}, [&](const InputError& e) { return std::pair(e.file != spec_.file, std::pair(e.line, e.column)); });
    return std::move(known_);
  }
  /// Returns whether an error of this key is already known.
  bool blamed(const std::string& key) const { return std::ranges::find(known_, key, &InputError::key) != known_.end(); }
  /// Returns the index of a name; nullopt and an error if it is unknown.
  std::optional<std::size_t> find(const std::vector<std::string>& known, const ScenarioName& name,
                                  const std::string& what) {
    const auto it = std::ranges::find(known, name.text);
    if (it != known.end()) return static_cast<std::size_t>(it - known.begin());
    add(name.place, "no " + what + " of scene " + spec_.scene.text + " is called so; " + suggest(name.text, known));
    return {};
  }

  /// Adds each note once; several networks may use one recording.
  void note(const std::vector<std::string>& notes) {
    for (const std::string& text : notes)
      if (std::ranges::find(out_.notes, text) == out_.notes.end()) out_.notes.push_back(text);
  }
  std::optional<ScenarioLink> link(ScenarioNetworkSpec spec) {
    if (blamed(spec.place.key + ".trace_interval_ms")) return {};  // its recording cannot be read without the interval
    if (!known_.empty())
      spec.delay_ms = spec.jitter_ms = spec.loss_percent = spec.duplicate_percent =
          spec.reorder_percent = {};  // the parser has checked it
    auto found = sources_.network(spec);
    if (found) {
      note(found->notes);
      return std::move(*found);
    }
    add(spec.profile ? spec.profile->place : spec.place, found.error());
    return {};
  }
  void networks() {
    if (auto network = link(spec_.network)) {
      out_.setup.network = std::move(network->link);
      out_.network = std::move(network->description);
    }
    for (const SeatNetworkSpec& own : spec_.seat_networks) {
      const auto network = link(own.network);
      for (const ScenarioName& seat : own.seats) {
        if (!seats_.empty() && !find(seats_, seat, "seat")) continue;
        if (!network) continue;
        if (!out_.setup.seat_networks.emplace(seat.text, network->link).second)
          add(seat.place, "has a network already: one seat, one network");
        out_.seat_networks.emplace_back(seat.text, network->description);
      }
    }
  }
  void events() {
    std::vector<ScriptEventSpec> in;
    for (const ScenarioEventSpec& event : spec_.events) {
      in.push_back(event.event);
      if (!seats_.empty())
        for (const ScenarioName& seat : event.seats) static_cast<void>(find(seats_, seat, "seat"));
    }
    // A profile of an event is looked up in the same way as a network's.
    auto events = network_events(in, [&](const std::string& name) -> std::expected<LinkSpec, InputErrors> {
      ScenarioNetworkSpec network;
      network.profile = ScenarioName{name, {}};
      auto found = sources_.network(network);
      if (!found) return std::unexpected(found.error());
      note(found->notes);
      return std::move(found->link);
    });
    if (events) {
      out_.setup.events = std::move(*events);
    } else {
      // Errors of the engine have no line. Where an error is already known, it may be their cause.
      for (const InputError& error : events.error())
        if (error.line > 0 || known_.empty()) errors_.push_back(error);
    }
  }
  void hands() {
    for (const ScenarioHandSpec& hand : spec_.hands) {
      if (!find(masters_, hand.seat, "MASTER seat")) continue;
      auto motion = sources_.motion(hand.motion.text);
      if (!motion) {
        add(hand.motion.place, motion.error());
        continue;
      }
      out_.hands.push_back(hand.seat.text + ": " + (*motion)->describe());
      if (!out_.setup.motions.emplace(hand.seat.text, std::move(*motion)).second)
        add(hand.seat.place, "has a motion already: one hand, one motion");
    }
  }
  /// Returns the named seats, or `none` if no seat is named.
  std::vector<std::string> named(const std::vector<ScenarioName>& names, const std::vector<std::string>& none) {
    if (names.empty()) return none;
    std::vector<std::string> out;
    for (const ScenarioName& name : names)
      if (find(seats_, name, "seat")) out.push_back(name.text);
    return out;
  }
  void faults() {
    for (const ScenarioFaultSpec& fault : spec_.faults) {
      const auto kind = std::ranges::find(kFaultNames, fault.kind, &FaultName::name);
      if (kind == kFaultNames.end()) {
        add(fault.place, "this program cannot do the fault " + fault.kind);
        continue;
      }
      for (const std::string& seat : named(fault.seats, {""}))
        out_.setup.faults.push_back(
            {kind->kind, seat, from_milliseconds(fault.at_s * 1e3), from_milliseconds(fault.for_ms)});
    }
  }
  void endpoints() {
    for (const ScenarioEndpointSpec& in : spec_.endpoints) {
      EndpointSpec endpoint{.offset = from_milliseconds(in.offset_ms), .drift_ppm = in.drift_ppm};
      for (const auto& step : in.steps)
        endpoint.steps.push_back({from_milliseconds(step.at_s * 1e3), from_milliseconds(step.by_ms)});
      endpoint.wake = {static_cast<WakeSpec::Kind>(in.wake), from_milliseconds(in.late_max_ms)};
      for (const SpecError& p : problems(endpoint)) add(in.place, p.key + ": " + p.message);
      for (const std::string& seat : named(in.seats, seats_))
        if (!out_.setup.endpoints.emplace(seat, endpoint).second)
          add(in.place, "seat " + seat + " has a clock already");
    }
  }

  void add_limit(const ScenarioLimitSpec& in) {
    // A limit on both directions becomes two limits, one per direction.
    for (const char* key : {"loss_percent", "longest_gap_ms", "age_p99_ms"}) {
      if (in.metric != key) continue;
      for (const char* direction : {"up_", "down_"}) {
        ScenarioLimitSpec one = in;
        one.metric = direction + in.metric;
        add_limit(one);
      }
      return;
    }
    Limit limit{.of = static_cast<Limit::Of>(in.of),
                .phase = {},
                .metric = in.metric,
                .subject = "session",
                .unit = in.unit,
                .min = in.min,
                .max = in.max};
    const auto traits = known_metric(limit.of, in.metric);
    if (!traits) return add(in.place, "this program cannot measure it");
    if (in.phase && !traits->by_phase)
      return add(in.phase->place, in.metric + " is counted over the whole run: give it in seat_limits without phase");
    if (in.phase) {
      limit.phase = find(phases_, *in.phase, "phase");
      if (!limit.phase) return;
      const PhaseSpec& phase = out_.setup.scene.phases[*limit.phase];
      if (phase.from >= out_.setup.scene.duration)
        return add(in.phase->place, "begins at " + short_number(phase.from) + " s, when the run of " +
                                        short_number(out_.setup.scene.duration) + " s is over");
    }
    const auto touches = [&](const PhaseSpec& p) { return p.contact; };
    const auto& phases = out_.setup.scene.phases;
    if (traits->needs_contact && !(limit.phase ? phases[*limit.phase].contact : std::ranges::any_of(phases, touches)))
      return add(in.place, std::string("force errors are measured in phases that the scene marks `contact: true`; ") +
                               (limit.phase ? "this one is not" : "it has none"));
    if (in.of == ScenarioLimitSpec::Of::kSession || in.of == ScenarioLimitSpec::Of::kFeel) {
      if (in.of == ScenarioLimitSpec::Of::kFeel) limit.subject = "feel";
      out_.limits.push_back(std::move(limit));
      return;
    }
    const bool seat = in.of == ScenarioLimitSpec::Of::kSeat;
    const auto& known = seat ? seats_ : tools_;
    const auto one = [&](std::size_t index) {
      limit.index = index;
      limit.subject = known[index] + (in.phase ? " in " + in.phase->text : "");
      out_.limits.push_back(limit);
    };
    for (const ScenarioName& name : in.names)
      if (const auto index = find(known, name, seat ? "seat" : "tool")) one(*index);
    if (in.names.empty())
      for (std::size_t i = 0; i < (seat ? masters_ : tools_).size(); ++i) one(i);  // masters are the first seats
  }

  const ScenarioSpec& spec_;
  const ScenarioSources& sources_;
  Scenario out_;
  InputErrors known_, errors_;
  std::vector<std::string> seats_, masters_, tools_, phases_;
};

}  // namespace

std::expected<Scenario, InputErrors> make_scenario(const ScenarioSpec& spec, const ScenarioSources& sources,
                                                   InputErrors known) {
  return ScenarioBuilder(spec, sources, std::move(known)).make();
}

std::string effective_scenario_text(const Scenario& s) {
  struct Row {
    std::string key, value, unit;
  };
  std::vector<Row> rows;
  const auto number = [&](std::string key, double value, std::string unit) {
    rows.push_back({std::move(key), short_number(value), std::move(unit)});
  };
  const auto list = [](std::string_view key, std::size_t i) {
    return std::string(key) + "[" + std::to_string(i) + "]";
  };
  rows.push_back({"scene", s.scene, ""});
  number("duration_s", s.setup.scene.duration, "s");
  rows.push_back(
      {"seeds", std::to_string(s.seed) + (s.seeds > 1 ? " to " + std::to_string(s.seed + s.seeds - 1) : ""), ""});
  rows.push_back({"network", s.network, ""});
  for (const auto& [seat, network] : s.seat_networks) rows.push_back({"network of " + seat, network, ""});
  for (std::size_t i = 0; i < s.setup.events.size(); ++i) {
    constexpr std::array kModes{"DROP", "HOLD", "HOLD_LAST"};
    const NetworkEvent& e = s.setup.events[i];
    std::string who;
    for (const std::string& seat : e.clients) who += (who.empty() ? "" : ", ") + seat;
    std::string what = e.rebind            ? "new address"
                       : e.outage          ? "outage"
                       : e.network.empty() ? "another network"
                                           : "network " + e.network;
    if (e.direction) what += std::string(" ") + std::string(netsim::name(*e.direction));
    rows.push_back({list("event", i), what + " of " + (who.empty() ? "every seat" : who), ""});
    number(list("event", i) + ".at_s", seconds(e.at), "s");
    if (e.outage) number(list("event", i) + ".outage_ms", seconds(e.outage->length) * 1e3, "ms");
    if (e.outage) rows.push_back({list("event", i) + ".mode", kModes[static_cast<std::size_t>(e.outage->mode)], ""});
    if (e.rebind) number(list("event", i) + ".dead_after_ms", seconds(e.rebind->dead_after) * 1e3, "ms");
  }
  for (std::size_t i = 0; i < s.hands.size(); ++i) rows.push_back({list("hand", i), s.hands[i], ""});
  for (std::size_t i = 0; i < s.setup.faults.size(); ++i) {
    const Fault& f = s.setup.faults[i];
    std::string who = f.seat.empty() ? "every seat" : f.seat;
    if (f.kind == Fault::Kind::kServerLate) who = "server";
    rows.push_back({list("fault", i), std::string(name(f.kind)) + " of " + who, ""});
    number(list("fault", i) + ".at_s", seconds(f.at), "s");
    number(list("fault", i) + ".for_ms", seconds(f.length) * 1e3, "ms");
  }
  for (const auto& [seat, e] : s.setup.endpoints) {
    constexpr std::array kWake{"EXACT", "UNIFORM", "MEASURED"};
    number("endpoint of " + seat + ".offset_ms", seconds(e.offset) * 1e3, "ms");
    number("endpoint of " + seat + ".drift_ppm", e.drift_ppm, "ppm");
    for (const auto& step : e.steps)
      rows.push_back({"endpoint of " + seat + ".step",
                      short_number(seconds(step.by) * 1e3) + " ms at " + short_number(seconds(step.at)), "s"});
    rows.push_back({"endpoint of " + seat + ".wake", kWake[static_cast<std::size_t>(e.wake.kind)], ""});
    if (e.wake.kind == WakeSpec::Kind::kUniform)
      number("endpoint of " + seat + ".late_max_ms", seconds(e.wake.late_max) * 1e3, "ms");
  }
  for (const Limit& limit : s.limits) {
    std::string range = range_text(limit);
    if (!limit.unit.empty()) range.resize(range.size() - limit.unit.size() - 1);
    rows.push_back({limit.subject + " " + limit.metric, std::move(range), limit.unit});
  }
  std::size_t key_width = 0, value_width = 0;
  for (const Row& row : rows) {
    key_width = std::max(key_width, row.key.size());
    if (!row.unit.empty()) value_width = std::max(value_width, row.value.size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += row.key + std::string(key_width + 2 - row.key.size(), ' ') + row.value;
    if (!row.unit.empty()) text += std::string(value_width + 2 - row.value.size(), ' ') + row.unit;
    text += "\n";
  }
  for (const std::string& note : s.notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace tandem::netsim

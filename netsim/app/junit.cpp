#include "common/base/format.h"
#include "netsim/app/test_report.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

/// Returns the number of bytes of the UTF-8 character that begins here; 0 if there is none [RFC 3629].
std::size_t character(std::string_view text) {
  const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = at(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xC2 && first < 0xE0   ? 2
                           : first >= 0xE0 && first < 0xF0 ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((at(i) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && at(1) < 0xA0) || (first == 0xF0 && at(1) < 0x90);
  const bool surrogate = first == 0xED && at(1) >= 0xA0;
  const bool beyond = first == 0xF4 && at(1) >= 0x90;
  const bool never = first == 0xEF && at(1) == 0xBF && at(2) >= 0xBE;  // U+FFFE and U+FFFF are no characters of XML
  return overlong || surrogate || beyond || never ? 0 : size;
}

/// Escapes text for content and attributes. Bytes that XML 1.0 cannot contain (control characters, invalid UTF-8)
/// become `?`.
std::string escaped(std::string_view text, bool attribute = true) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = character(text);
    const char c = text.front();
    if (size > 1) {
      out += text.substr(0, size);
    } else if (size == 0 || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r')) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\n' && attribute) {
      out += "&#10;";
    } else {
      out += c;
    }
    text.remove_prefix(size > 1 ? size : 1);
  }
  return out;
}

std::string attribute(std::string_view key, std::string_view value) {
  return " " + std::string(key) + "=\"" + escaped(value) + "\"";
}
std::string attribute(std::string_view key, std::size_t value) { return attribute(key, std::to_string(value)); }
std::string time_attribute(double cpu_s) { return attribute("time", format("%.3f", cpu_s)); }

struct Counts {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double cpu_s = 0;
  /// Adds a scenario. CI servers count `skipped` as passed; the first seed left out by an interruption is therefore an
  /// error.
  void add(const ScenarioResult& r, bool interrupted) {
    const std::size_t not_run = r.count(State::kNotRun), cut = interrupted && not_run > 0 ? 1 : 0;
    tests += r.seeds.size();
    failures += r.count(State::kFail);
    errors += r.count(State::kTrouble) + r.count(State::kCrash) + cut;
    skipped += not_run - cut;
    cpu_s += r.cpu_s();
  }
  [[nodiscard]] std::string text() const {
    return attribute("tests", tests) + attribute("failures", failures) + attribute("errors", errors) +
           attribute("skipped", skipped) + time_attribute(cpu_s);
  }
};

/// @param cut  this seed reports the interruption (Counts::add)
void put_case(const Scenario& scenario, const SeedOutcome& s, bool cut, std::string& out) {
  out += "    <testcase" + attribute("name", "seed " + std::to_string(s.seed)) +
         attribute("classname", "tandem." + scenario.name) + time_attribute(s.cpu_s);
  if (s.state == State::kPass) {
    out += "/>\n";
    return;
  }
  out += ">\n";
  if (cut) {
    out += "      <error" +
           attribute("message",
                     "interrupted: this seed and those skipped after it were not run, so their results are unknown") +
           attribute("type", "interrupted") + "/>\n";
  } else if (s.state == State::kNotRun) {
    out += "      <skipped" + attribute("message", "not run") + "/>\n";
  } else {
    if (!s.recording.empty())
      out += "      <properties>\n        <property" + attribute("name", "recording") +
             attribute("value", s.recording) + "/>\n      </properties>\n";
    const auto all = causes(scenario, s);
    std::string text;
    for (const std::string& cause : all) text += cause + "\n";
    text += "replay: " + replay_command(scenario, s.seed) + "\n";
    for (const std::string& line : recording_lines(s)) text += line + "\n";
    const char* const element = s.state == State::kFail ? "failure" : "error";
    out += std::string("      <") + element + attribute("message", all.empty() ? "failed" : all.front()) +
           attribute("type", name(s.state)) + ">" + escaped(text, false) + "</" + element + ">\n";
    if (!s.recording.empty())  // readers want the attachment alone on its line
      out += "      <system-out>\n[[ATTACHMENT|" + escaped(s.recording, false) + "]]\n</system-out>\n";
  }
  out += "    </testcase>\n";
}

}  // namespace

std::string junit_xml(const TestResult& result) {
  Counts all;
  for (const ScenarioResult& r : result.scenarios) all.add(r, result.interrupted);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                    attribute("name", "tandem-netsim test") + all.text() + ">\n";
  for (const ScenarioResult& r : result.scenarios) {
    Counts own;
    own.add(r, result.interrupted);
    out += "  <testsuite" + attribute("name", r.scenario.name) + own.text() + ">\n    <properties>\n";
    const auto property = [&](std::string_view key, std::string_view value) {
      out += "      <property" + attribute("name", key) + attribute("value", value) + "/>\n";
    };
    property("file", r.scenario.file);
    property("summary", r.scenario.summary);
    property("scene", r.scenario.scene);
    property("network", r.scenario.network);
    for (const auto& [seat, network] : r.scenario.seat_networks) property("network of " + seat, network);
    out += "    </properties>\n";
    bool told = !result.interrupted;
    for (const SeedOutcome& s : r.seeds) {
      const bool cut = !told && s.state == State::kNotRun;
      told = told || cut;
      put_case(r.scenario, s, cut, out);
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace tandem::netsim

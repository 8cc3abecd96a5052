#include "client/app/tutorial.h"

#include <algorithm>
#include <utility>

#include "common/base/format.h"

namespace tandem::client {
namespace {

constexpr double kAfterKey = 1.5;  // [s] time after a key until its effect is shown

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace

Tutorial::Tutorial(const SeatSetup& setup, bool by_keys, std::vector<std::string> partners)
    : setup_(&setup), partner_(partners.empty() ? "" : partners.front()) {
  std::string what = "you hold the seat " + setup.seat.name;
  what += partners.empty()
              ? ""
              : "; " + listed(partners) + (partners.size() == 1 ? " is" : " are") + " simulated on this computer";
  if (!by_keys)
    what +=
        ". Standard input is no terminal, so your hand is simulated too: start this command in a terminal to move it "
        "by keys";
  steps_.push_back({.at = 0, .text = what, .keys = {}, .happened = {}, .early = {}});
  if (by_keys) add_keys_of_hand();
  if (by_keys && setup.moves_authority() && !partner_.empty()) add_keys_of_authority();
  if (by_keys)
    steps_.push_back({.at = 16,
                      .text = "press s (small): only your own hand is released, no force reaches it; r takes that "
                              "back. Capital S stops all hands",
                      .keys = {"s", " ", "S"},
                      .happened = "only your hand is stopped; press r to resume",
                      .early = "s releases your hand, S stops all hands"});
  steps_.push_back({.at = kLength,
                    .text = by_keys ? "that was all: go on as you like; q ends everything" : "that was all",
                    .keys = {},
                    .happened = {},
                    .early = {}});
}

void Tutorial::add_keys_of_hand() {
  steps_.push_back({.at = 1,
                    .text = "press the arrow keys: your hand moves right and left, away and towards you; PgUp and PgDn "
                            "move it up and down",
                    .keys = {"up", "down", "left", "right", "pageup", "pagedown"},
                    .happened = "the hand with authority moves the tool, and all hands feel it",
                    .early = "the arrow keys move your hand"});
}

void Tutorial::add_keys_of_authority() {
  steps_.push_back({.at = 7,
                    .text = "press 0: " + partner_ + " gets the tool and pulls your hand along",
                    .keys = {"0"},
                    .happened = partner_ + " has the tool now",
                    .early = "0 gives the tool to the partner"});
  steps_.push_back({.at = 12,
                    .text = "press 1: you take the tool back; a and d give and take 5 %",
                    .keys = {"1"},
                    .happened = "you have the tool again",
                    .early = "1 takes the tool back"});
}

void Tutorial::on_key(const std::string& key) {
  const auto asks_for = [](const Step& step, const std::string& k) {
    return std::ranges::find(step.keys, k) != step.keys.end();
  };
  // Key 1 takes back what key 0 gave, so it counts only after key 0.
  if (key == "1" && std::ranges::none_of(steps_, [&](const Step& step) { return step.pressed && asks_for(step, "0"); }))
    return;
  for (Step& step : steps_) {
    if (step.pressed || !asks_for(step, key)) continue;
    step.pressed = true;
    if (key == "S")
      step.happened = std::string("capital S stopped all hands; ") +
                      (may_resume(true) ? "press r to resume" : "an instructor or operator resumes, not this seat");
  }
}

std::vector<std::string> Tutorial::messages(double now_s, const ClientStatus& status) {
  std::vector<std::string> lines;
  if (!began_ && status.session == wire::SessionState::kRunning && status.session_time >= 0) began_ = now_s;
  if (!began_) return lines;
  for (Step& step : steps_) {
    if (!step.pressed || step.reported || step.happened.empty()) continue;
    if (!step.pressed_at) step.pressed_at = now_s;
    if (now_s - *step.pressed_at < kAfterKey) continue;
    step.reported = true;
    lines.push_back("  " + step.happened +
                    format(" (your hand feels %.1f N, your authority is %.0f %%)", status.force_n, 100 * status.alpha));
  }
  // A requested key has its described effect only without a stop, so the text asks for a resume first.
  const bool all = status.session == wire::SessionState::kStopped || status.session == wire::SessionState::kPaused;
  const bool resumes = may_resume(status.session == wire::SessionState::kPaused);
  const std::string first = all && !resumes     ? "once an instructor or operator has resumed: "
                            : all               ? "press r first, all hands are stopped; then "
                            : status.local_stop ? "press r first, your hand is stopped; then "
                                                : "";
  for (; next_ < steps_.size() && now_s - *began_ >= steps_[next_].at; ++next_)
    lines.push_back(format("%zu/%zu  ", next_ + 1, steps_.size()) +
                    (steps_[next_].pressed ? steps_[next_].early + ": you have done that already"
                                           : (steps_[next_].keys.empty() ? "" : first) + steps_[next_].text));
  return lines;
}

}  // namespace tandem::client

#include "netsim/app/test_notes.h"

#include <algorithm>

namespace tandem::netsim {
namespace {

constexpr std::size_t kNoteSeedsShown = 5;

/// Notes of one kind. Sessions of different seeds begin at different times; the number after the last comma differs.
struct Kind {
  std::string head;  ///< text up to the last comma
  std::string note;  ///< note of the first seed that has it
  std::vector<std::uint64_t> seeds;
};

/// Returns the text before the last comma. Example: "the outage at 90 s came after the end of the run, 18.1 s"; the
/// rest depends on the seed.
std::string head_of(const std::string& note) { return note.substr(0, note.rfind(',')); }

std::string seeds_text(const Kind& kind, std::size_t all) {
  if (kind.seeds.size() == all)
    return all == 1                 ? ""
           : kind.note == kind.head ? " (every seed)"
                                    : " (seed " + std::to_string(kind.seeds.front()) + ", the others alike)";
  std::string text;
  for (std::size_t i = 0; i < kind.seeds.size() && i < kNoteSeedsShown; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(kind.seeds[i]);
  if (kind.seeds.size() > kNoteSeedsShown)
    text += " and " + std::to_string(kind.seeds.size() - kNoteSeedsShown) + " more";
  return (kind.seeds.size() == 1 ? " (seed " : " (seeds ") + text + ")";
}

}  // namespace

std::string notes_text(const ScenarioResult& result) {
  std::vector<Kind> kinds;
  std::size_t judged = 0;
  for (const SeedOutcome& seed : result.seeds) {
    judged += seed.state == SeedOutcome::State::kPass || seed.state == SeedOutcome::State::kFail ? 1 : 0;
    for (const std::string& note : seed.notes) {
      const std::string head = head_of(note);
      auto known = std::ranges::find(kinds, head, &Kind::head);
      if (known == kinds.end()) known = kinds.insert(kinds.end(), {head, note, {}});
      if (known->seeds.empty() || known->seeds.back() != seed.seed) known->seeds.push_back(seed.seed);
    }
  }
  std::string text;
  for (const Kind& kind : kinds) text += "  note: " + kind.note + seeds_text(kind, judged) + "\n";
  return text;
}

}  // namespace tandem::netsim

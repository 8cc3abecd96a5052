// Cells of grids: their order, their names, and pairs of law and coupling that are rejected.
#include "netsim/cells/cell.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "netsim/cells/shipped_cells.h"
#include "proto/text/cells_text.h"
#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {
namespace {

CellsSpec spec_of(const std::string& grids) {
  auto spec = parse_cells_text("version: 1 scene: \"contact\" seeds: 1\n" + grids, "x.textproto");
  if (!spec) throw std::runtime_error(to_text(spec.error()));
  return *spec;
}

InputErrors problems_of(const std::string& grids) { return cell_problems(spec_of(grids), test::shipped("contact")); }

TEST(Cells, AreNumberedThroughAllGridsWithTheDelayInnermost) {
  const auto cells =
      cells_of(spec_of("grid { name: \"a\" law: [PD, RAW] task: [FREE, WALL] delay_ms: [0, 20] loss_percent: [0, 5] }\n"
                       "grid { name: \"b\" law: REPLICA hands: 4 task: STEP alpha: HALF jitter_ms: 2 outage_ms: 50 }"));
  ASSERT_EQ(cells.size(), 17u);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i].number, i + 1);
  EXPECT_EQ(cells[1].delay_ms, 20);
  EXPECT_EQ(cells[2].loss_percent, 5) << "loss is next to innermost";
  EXPECT_EQ(cells[4].task, CellTask::kWall);
  EXPECT_EQ(cells[8].law, LawKind::kRaw) << "the law is outermost";
  EXPECT_EQ(cells[16].grid, 1u);
  EXPECT_EQ(condition_text(cells[16]), "step, alpha 1/2, 4 hands, jitter 2 ms, outages of 50 ms");
  EXPECT_EQ(law_text(cells[16]), "replica");
  EXPECT_TRUE(has_default_law(cells[16]));
  EXPECT_FALSE(has_default_law(cells[0]));
  EXPECT_EQ(repeat_command("my cells", 3), "tandem-netsim sweep --cells my cells --cell 3");
}

TEST(Cells, RejectPairsOfLawAndCouplingThatMakeNoSense) {
  EXPECT_TRUE(problems_of("grid { name: \"a\" law: [PD, SET_POSITION, RAW] coupling: [ESC, CLC] task: FREE }").empty());
  const InputErrors errors =
      problems_of("grid { name: \"a\" law: [PD, REPLICA, WAVE]\n coupling: [ESC, CLC] task: FREE }");
  ASSERT_EQ(errors.size(), 2u) << to_text(errors);
  EXPECT_EQ(errors[0].line, 3);
  EXPECT_EQ(errors[0].value, "CLC");
  EXPECT_EQ(errors[0].key, "grid[0].coupling[1]");
  EXPECT_NE(errors[0].message.find("replica + clc with 2 hands: channel.coupling couples hands by positions"),
            std::string::npos)
      << errors[0].message;
  EXPECT_NE(errors[1].message.find("wave + clc"), std::string::npos);
}

TEST(Cells, RejectCouplingsForTwoHandsWithAnotherNumber) {
  const InputErrors errors = problems_of(
      "grid { name: \"a\" law: PD coupling: [NUDEHI, PD_PEER, AVERAGE_POSITION, ESC] hands: [2, 3, 8] task: FREE }");
  ASSERT_EQ(errors.size(), 2u) << to_text(errors);
  for (const InputError& error : errors)
    EXPECT_NE(error.message.find("has equations for two hands"), std::string::npos) << error.message;
  EXPECT_NE(errors[1].message.find("pd + nudehi with 8 hands"), std::string::npos) << errors[1].message;
}

TEST(Cells, OfTheShippedComparisonAreTwoThousandDifferentOnes) {
  const EmbeddedFile* const shipped = find_shipped_cells("comparison");
  ASSERT_NE(shipped, nullptr);
  EXPECT_FALSE(shipped->summary.empty());
  const auto spec = parse_cells_text(shipped->text, "comparison.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  const auto cells = cells_of(*spec);
  EXPECT_EQ(cells.size(), 2000u);
  EXPECT_EQ(to_text(cell_problems(*spec, test::shipped("contact"))), "");
  std::set<std::string> names;
  std::set<LawKind> laws;
  std::set<HandCouplingKind> couplings;
  for (const Cell& cell : cells) {
    names.insert(law_text(cell) + ", " + condition_text(cell) + ", " + std::to_string(cell.delay_ms));
    laws.insert(cell.law);
    couplings.insert(cell.coupling);
  }
  EXPECT_EQ(names.size(), cells.size()) << "a cell is there twice";
  EXPECT_EQ(laws.size(), kLaws);
  EXPECT_EQ(couplings.size(), 8u);
}

// Published figures are of at least 20 seeds; `laws` is where they come from.
TEST(Cells, OfTheShippedLawsAreCellsOfTheComparisonWithTwentySeeds) {
  const auto shipped_spec = [](const char* name) {
    const EmbeddedFile* const shipped = find_shipped_cells(name);
    if (shipped == nullptr) throw std::runtime_error(name);
    auto spec = parse_cells_text(shipped->text, name);
    if (!spec) throw std::runtime_error(to_text(spec.error()));
    return *spec;
  };
  const auto laws = shipped_spec("laws"), comparison = shipped_spec("comparison");
  EXPECT_GE(laws.seeds, 20u);
  EXPECT_EQ(laws.scene.value, comparison.scene.value);
  const auto name_of = [](const Cell& cell) {
    return law_text(cell) + ", " + condition_text(cell) + ", " + std::to_string(cell.delay_ms);
  };
  std::set<std::string> compared;
  for (const Cell& cell : cells_of(comparison)) compared.insert(name_of(cell));
  const auto cells = cells_of(laws);
  EXPECT_EQ(cells.size(), 420u);
  for (const Cell& cell : cells) EXPECT_TRUE(compared.contains(name_of(cell))) << name_of(cell);
}

TEST(Cells, HaveAsManyMasterSeatsAsHands) {
  for (const std::uint32_t hands : {2u, 3u, 8u}) {
    Cell cell;
    cell.law = LawKind::kPd;
    cell.hands = hands;
    const SceneSpec scene = scene_of(cell, test::shipped("contact"));
    EXPECT_EQ(scene.masters(), hands);
    EXPECT_EQ(scene.channel.law, LawKind::kPd);
    EXPECT_FALSE(law_problem(scene));
  }
}

}  // namespace
}  // namespace tandem::netsim

// Files of cells: defaults of absent axes, and every mistake with its place.
#include "proto/text/cells_text.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace tandem {
namespace {

constexpr const char* kHead = "version: 1 scene: \"contact\" seeds: 3\n";

TEST(CellsText, FillsAbsentAxesWithOneValue) {
  const auto spec = parse_cells_text(std::string(kHead) + "grid { name: \"a\" law: [REPLICA, PD] task: FREE }",
                                     "some/folder/mine.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  EXPECT_EQ(spec->name, "mine");
  EXPECT_EQ(spec->scene.value, "contact");
  EXPECT_EQ(spec->seed, 1u);
  EXPECT_EQ(spec->seeds, 3u);
  ASSERT_EQ(spec->grids.size(), 1u);
  const CellGridSpec& grid = spec->grids[0];
  EXPECT_EQ(grid.cells(), 2u);
  EXPECT_EQ(grid.laws[1].value, LawKind::kPd);
  EXPECT_EQ(grid.couplings[0].value, HandCouplingKind::kEsc);
  EXPECT_EQ(grid.hands[0].value, 2u);
  EXPECT_EQ(grid.delays_ms[0].value, 0);
  EXPECT_EQ(grid.outages_ms[0].value, 0);
  EXPECT_EQ(grid.alphas[0].value, CellAlpha::kOne);
}

TEST(CellsText, CountsEveryCombination) {
  const auto spec =
      parse_cells_text(std::string(kHead) +
                           "grid { name: \"a\" law: PD coupling: [CLC, MCET] task: [FREE, WALL, STEP] alpha: [ONE, "
                           "HALF, ZERO, STEPPED]\n"
                           " delay_ms: [0, 20, 500] jitter_ms: [0, 5] loss_percent: [0, 50] outage_ms: [0, 100] }\n"
                           "grid { name: \"b\" law: REPLICA hands: [2, 8] task: GESTURE }",
                       "x.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  EXPECT_EQ(spec->grids[0].cells(), 2u * 3 * 4 * 3 * 2 * 2 * 2);
  EXPECT_EQ(spec->cells(), 576u + 2);
}

TEST(CellsText, NamesEveryMistakeWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"version: 1 scene: \"contact\" seeds: 3", "x.textproto: grid: is missing"},
      {"version: 1 seeds: 3 grid { name: \"a\" law: PD task: FREE }", "scene"},
      {"version: 1 scene: \"contact\" grid { name: \"a\" law: PD task: FREE }", "seeds"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE delay: 3 }", "x.textproto:2:37: grid[0].delay"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE\n delay_ms: [0, 501] }",
       "x.textproto:3:16: grid[0].delay_ms[1] = 501: "},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE loss_percent: 101 }", "[0, 100] %"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE hands: 9 }", "grid[0].hands[0] = 9: "},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE hands: 1 }", "[2, 8]"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE delay_ms: nan }", "grid[0].delay_ms"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: [FREE, FREE] }",
       "grid[0].task[1] = FREE: is there twice"},
      {std::string(kHead) + "grid { name: \"a\" law: PDD task: FREE }", "grid[0].law"},
      {std::string(kHead) + "grid { name: \"a\" task: FREE }", "needs law, such as law: [REPLICA, SET_POSITION]"},
      {std::string(kHead) + "grid { name: \"a\" law: PD }", "needs task, such as task: [FREE, WALL]"},
      {std::string(kHead) + "grid { law: PD task: FREE }", "grid[0].name"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: RECORDED }", "RECORDED needs the key recording"},
      {std::string(kHead) + "grid { name: \"a\" law: PD task: FREE } grid { name: \"a\" law: PD task: WALL }",
       "grid[1].name = \"a\": is the name of an earlier grid"}};
  for (const auto& [text, says] : cases) {
    const auto spec = parse_cells_text(text, "x.textproto");
    ASSERT_FALSE(spec) << text;
    EXPECT_NE(to_text(spec.error()).find(says), std::string::npos) << says << " not in\n" << to_text(spec.error());
  }
}

TEST(CellsText, RejectsTooManyCells) {
  std::string axis;
  for (int i = 0; i < 64; ++i) axis += (i > 0 ? ", " : "") + std::to_string(i);
  const auto spec = parse_cells_text(std::string(kHead) + "grid { name: \"a\" law: PD task: FREE delay_ms: [" + axis +
                                         "] jitter_ms: [" + axis + "] loss_percent: [0, 1, 2, 3, 4] }",
                                     "x.textproto");
  ASSERT_FALSE(spec);
  EXPECT_NE(to_text(spec.error()).find("the grids have 20480 cells together; at most 20000 are allowed"),
            std::string::npos)
      << to_text(spec.error());
}

}  // namespace
}  // namespace tandem

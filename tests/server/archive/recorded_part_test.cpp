// Order of the files of a long recording, and what is missing or does not belong.
#include "server/archive/recorded_part.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

RecordedPart part(const std::string& file, unsigned number, std::optional<bool> last = false) {
  return {.file = file,
          .session_id = "5",
          .epoch = "1",
          .recording = "lab",
          .number = number,
          .last = last,
          .previous_file = number == 1 ? "" : "lab-" + std::to_string(number - 1) + ".mcap"};
}

TEST(RecordedPart, OrderIsThatOfTheNumbersAndALastPartIsNeeded) {
  std::vector<RecordedPart> parts{part("c", 3, true), part("a", 1), part("b", 2)};
  EXPECT_EQ(order_parts(parts), "");
  EXPECT_EQ(parts[0].file + parts[1].file + parts[2].file, "abc");
  parts[2].last.reset();
  EXPECT_EQ(order_parts(parts), "") << "the last file of a killed server has no end";
  parts[2].last = false;
  EXPECT_EQ(order_parts(parts).find("part 4 of the recording is missing: c is part 3, and says that another one "
                                    "follows"),
            0u)
      << order_parts(parts);
}

TEST(RecordedPart, MissingOnesAreNamed) {
  std::vector<RecordedPart> middle{part("a", 1), part("c", 3, true)};
  EXPECT_EQ(order_parts(middle).find("part 2 of the recording is missing, lab-2.mcap: c is part 3"), 0u)
      << order_parts(middle);
  std::vector<RecordedPart> first{part("b", 2), part("c", 3, true)};
  EXPECT_EQ(order_parts(first).find("part 1 of the recording is missing, lab-1.mcap: b is part 2"), 0u)
      << order_parts(first);
  std::vector<RecordedPart> far{part("a", 1), part("d", 4, true)};
  EXPECT_EQ(order_parts(far).find("part 2 of the recording is missing: d is part 4"), 0u) << order_parts(far);
}

TEST(RecordedPart, ThatDoesNotBelongIsNamed) {
  std::vector<RecordedPart> twice{part("a", 1), part("b", 2, true), part("copy", 2, true)};
  EXPECT_NE(order_parts(twice).find("b and copy are both part 2"), std::string::npos) << order_parts(twice);
  for (std::string RecordedPart::* const key :
       {&RecordedPart::session_id, &RecordedPart::epoch, &RecordedPart::recording}) {
    std::vector<RecordedPart> foreign{part("a", 1), part("b", 2, true)};
    foreign[1].*key = "other";
    EXPECT_NE(order_parts(foreign).find("a and b are no parts of one recording"), std::string::npos)
        << order_parts(foreign);
  }
  std::vector<RecordedPart> beyond{part("a", 1, true), part("b", 2, true)};
  EXPECT_NE(order_parts(beyond).find("a is the last part of the recording, but b is part 2"), std::string::npos)
      << order_parts(beyond);
  std::vector<RecordedPart> single(2);
  EXPECT_NE(order_parts(single), "") << "recordings of one file each";
}

}  // namespace
}  // namespace tandem::server

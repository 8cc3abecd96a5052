// Fuzzes the readers of recordings: motions of hands and capacities of networks.
#include "common/base/csv.h"
#include "hal/sim/recorded_motion.h"
#include "netsim/profiles/capacity_csv.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem;
  const auto text = fuzz::text(data, size);
  if (const auto table = CsvTable::parse(text))
    for (std::size_t row = 0; row < table->rows(); ++row)
      for (std::size_t column = 0; column < table->columns().size(); ++column)
        static_cast<void>(table->optional_number(row, column));
  if (const auto link = netsim::parse_capacity(text, "fuzz.csv"))
    for (const auto direction : {netsim::Direction::kUp, netsim::Direction::kDown})
      FUZZ_EXPECT((*link)[direction].rate.trace != nullptr);
  static_cast<void>(hal::sim::parse_motion_options(text));
  if (const auto motion = hal::sim::RecordedMotion::parse(text, {}, "fuzz.csv")) {
    hal::sim::RecordedMotion::Cursor cursor;
    for (int i = -1; i <= 20; ++i) {
      const hal::sim::MotionPoint point = motion->at(motion->duration() * i / 16, cursor);
      FUZZ_EXPECT(point.x.allFinite() && point.v.allFinite());
    }
  }
  return 0;
}

// The codec of the messages that a recording has for every tick, beside protobuf's own code.
#include "proto/recording/tick_messages.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/protobuf_fields.h"
#include "proto/schema/recording.pb.h"
#include "tests/common/base/counts.h"

namespace tandem::rec {
namespace {

using test::seeds;

/// Numbers of all kinds: special ones, and any bits.
double any_double(RandomStream& random) {
  constexpr double kSpecial[] = {0.0,
                                 -0.0,
                                 1.0,
                                 -1e-300,
                                 5e-324,
                                 1e300,
                                 std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
  if (random.below(3) == 0) return kSpecial[random.below(std::size(kSpecial))];
  const double any = std::bit_cast<double>(random.bits());
  return random.below(2) == 0 ? any : static_cast<float>(random.uniform(-1, 1));
}

template <std::size_t kSize>
void fill(std::array<double, kSize>& out, RandomStream& random, std::size_t used = kSize) {
  for (std::size_t k = 0; k < used; ++k) out[k] = any_double(random);
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
template <std::size_t kSize>
bool same(const std::array<double, kSize>& a, const std::array<double, kSize>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return bits(x) == bits(y); });
}
/// The message has the number in single precision, and exactly if that loses bits.
template <class Message, class Singles>
bool same_number(double x, const Message& message, const Singles& singles, int k) {
  if (k >= singles.size()) return bits(x) == 0;
  const float single = singles.Get(k);
  const bool near = std::isnan(x) ? std::isnan(single) : std::abs(x) > 3.4e38 || single == static_cast<float>(x);
  return near && (message.exact_size() == 0 ? bits(single) == bits(x) : bits(message.exact(k)) == bits(x));
}
bool same(const Triple& a, const recording::Vector3& b) {
  return same_number(a[0], b, b.xyz(), 0) && same_number(a[1], b, b.xyz(), 1) && same_number(a[2], b, b.xyz(), 2);
}

SeatSample any_seat(RandomStream& random) {
  SeatSample s;
  for (Triple* v : {&s.measured_cp, &s.measured_cv, &s.measured_cf, &s.servo_cf}) fill(*v, random);
  fill(s.measured_jp, random, random.below(8));
  if (random.below(2) == 0) fill(s.ghost, random);
  s.sample_tick = static_cast<std::uint32_t>(random.bits());
  s.alpha = any_double(random);
  s.gate = static_cast<std::uint8_t>(random.below(7));
  s.engaged = random.below(2) == 0;
  s.leader = static_cast<std::uint32_t>(random.below(17));
  return s;
}

TEST(TickMessages, MatchTheLibraryForAnySeat) {
  const std::uint64_t count = seeds(300);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    const SeatSample in = any_seat(random);
    std::string bytes;
    encode(in, bytes);
    recording::Seat library;
    ASSERT_TRUE(library.ParseFromString(bytes));
    EXPECT_TRUE(same(in.measured_cp, library.measured_cp()));
    EXPECT_TRUE(same(in.measured_cv, library.measured_cv()));
    EXPECT_TRUE(same(in.measured_cf, library.measured_cf()));
    EXPECT_TRUE(same(in.servo_cf, library.servo_cf()));
    EXPECT_TRUE(same(in.ghost, library.ghost()));
    for (std::size_t k = 0; k < in.measured_jp.size(); ++k)
      EXPECT_TRUE(
          same_number(in.measured_jp[k], library.measured_jp(), library.measured_jp().q(), static_cast<int>(k)));
    EXPECT_EQ(in.sample_tick, library.sample_tick());
    EXPECT_EQ(bits(in.alpha), bits(library.alpha()));
    EXPECT_EQ(in.gate, library.gate());
    EXPECT_EQ(in.engaged, library.engaged());
    EXPECT_EQ(in.leader, library.leader());
    for (const std::string& encoded : {bytes, library.SerializeAsString()}) {
      SeatSample out;
      ASSERT_TRUE(decode(bytes_of(encoded), out));
      std::string again;
      encode(out, again);
      EXPECT_EQ(again, bytes);
      EXPECT_TRUE(same(in.measured_jp, out.measured_jp) && same(in.ghost, out.ghost));
    }
  }
}

TEST(TickMessages, MatchTheLibraryForAnyTool) {
  const std::uint64_t count = seeds(300);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    ToolSample in;
    for (Triple* v : {&in.measured_cp, &in.setpoint_cp, &in.measured_cf, &in.servo_cf}) fill(*v, random);
    fill(in.measured_jp, random, random.below(8));
    in.sample_tick = static_cast<std::uint32_t>(random.bits());
    in.penetration = any_double(random);
    in.braked = random.below(2) == 0;
    std::string bytes;
    encode(in, bytes);
    recording::Tool library;
    ASSERT_TRUE(library.ParseFromString(bytes));
    EXPECT_TRUE(same(in.measured_cp, library.measured_cp()));
    EXPECT_TRUE(same(in.setpoint_cp, library.setpoint_cp()));
    EXPECT_TRUE(same(in.measured_cf, library.measured_cf()));
    EXPECT_TRUE(same(in.servo_cf, library.servo_cf()));
    EXPECT_EQ(in.sample_tick, library.sample_tick());
    EXPECT_EQ(bits(to_single(in.penetration)), bits(library.penetration()));
    EXPECT_EQ(bits(in.penetration),
              bits(is_single(in.penetration) ? library.penetration() : library.penetration_exact()));
    EXPECT_EQ(in.braked, library.braked());
    ToolSample out;
    ASSERT_TRUE(decode(bytes_of(library.SerializeAsString()), out));
    std::string again;
    encode(out, again);
    EXPECT_EQ(again, bytes);
  }
}

TEST(TickMessages, ShortNumbersAreTheNearestOf16SignificantBits) {
  EXPECT_EQ(to_short(1.0), 1.0F);
  EXPECT_EQ(to_short(1 + 0x1p-15), 1 + 0x1p-15F);
  EXPECT_EQ(to_short(1 + 0x1p-16), 1.0F) << "half a step: to the even one";
  EXPECT_EQ(to_short(1 + 3 * 0x1p-16), 1 + 0x1p-14F) << "likewise";
  EXPECT_EQ(to_short(1 + 0x1p-16 + 0x1p-22), 1 + 0x1p-15F);
  EXPECT_EQ(to_short(-0.1), -to_short(0.1));
  EXPECT_TRUE(std::signbit(to_short(-0.0)));
  EXPECT_TRUE(std::isnan(to_short(std::nan(""))));
  EXPECT_EQ(to_short(1e300), std::numeric_limits<float>::infinity());
  RandomStream random{RandomKey{5}};
  for (int k = 0; k < 10'000; ++k) {
    const double value = random.uniform(-10, 10);
    EXPECT_LE(std::abs(to_short(value) - value), std::abs(value) * 0x1p-16);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(to_short(value)) & 0xff, 0u);
  }
}

TEST(TickMessages, OfARoundedToolHaveNoNumberInDoublePrecision) {
  const std::uint64_t count = seeds(300);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    ToolSample in;
    for (Triple* v : {&in.measured_cp, &in.setpoint_cp, &in.measured_cf, &in.servo_cf, &in.energy.e_p_axis_j})
      fill(*v, random);
    fill(in.measured_jp, random, random.below(8));
    in.penetration = any_double(random);
    in.energy.mfs_j = any_double(random);
    const auto& axes = in.energy.e_p_axis_j;
    const bool sum = random.below(2) == 0;
    in.energy.e_p_j = sum ? 0 + axes[0] + axes[1] + axes[2] : any_double(random);
    ToolSample rounded = in;
    round_tool(rounded);
    std::string bytes;
    encode(rounded, bytes);
    recording::Tool library;
    ASSERT_TRUE(library.ParseFromString(bytes));
    EXPECT_EQ(library.measured_cp().exact_size() + library.servo_cf().exact_size() +
                  library.measured_jp().exact_size() + library.energy().exact_size(),
              0);
    EXPECT_EQ(bits(library.penetration_exact()), bits(0.0));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(bits(rounded.servo_cf[k]), bits(static_cast<double>(to_short(in.servo_cf[k]))));
    ToolSample out;
    ASSERT_TRUE(decode(bytes_of(bytes), out));
    EXPECT_TRUE(same(out.measured_jp, rounded.measured_jp) && same(out.setpoint_cp, rounded.setpoint_cp));
    EXPECT_EQ(bits(out.energy.e_p_j), bits(rounded.energy.e_p_j)) << "also where a reader adds the axes";
    EXPECT_EQ(bits(out.penetration), bits(rounded.penetration));
    ToolSample again = rounded;
    round_tool(again);
    std::string twice;
    encode(again, twice);
    EXPECT_EQ(twice, bytes) << "rounding twice changes nothing";
  }
}

TEST(TickMessages, MatchTheLibraryForAnyEnergyAndAuthority) {
  const std::uint64_t count = seeds(100);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    SeatSample seat;
    SeatEnergySample& s = seat.energy;
    for (EnergyArray* e : {&s.e_in, &s.e_out})
      for (std::uint64_t& axis : *e) axis = random.below(3) == 0 ? 0 : random.bits();
    const bool single = random.below(2) == 0;
    for (double* x : {&s.dissipated_j, &s.refused_j, &s.margin_min_j, &s.delivered_j})
      *x = single ? static_cast<double>(random.below(1000)) / 8 : any_double(random);
    std::string bytes;
    encode(seat, bytes);
    recording::Seat library;
    ASSERT_TRUE(library.ParseFromString(bytes));
    const recording::SeatEnergy& e = library.energy();
    for (int k = 0; k < e.e_in_size(); ++k) EXPECT_EQ(e.e_in(k), s.e_in[static_cast<std::size_t>(k)]);
    EXPECT_EQ(bits(e.margin_min_j()), bits(to_single(s.margin_min_j)));
    const bool all_single =
        is_single(s.dissipated_j) && is_single(s.refused_j) && is_single(s.margin_min_j) && is_single(s.delivered_j);
    EXPECT_EQ(e.exact_size() == 0, all_single);
    EXPECT_TRUE(all_single || !single);
    SeatSample out;
    ASSERT_TRUE(decode(bytes_of(library.SerializeAsString()), out));
    std::string again;
    encode(out, again);
    EXPECT_EQ(again, bytes);
    EXPECT_EQ(bits(out.energy.refused_j), bits(s.refused_j));

    ToolSample tool;
    tool.energy.mfs_j = any_double(random);
    fill(tool.energy.e_p_axis_j, random);
    const auto& axes = tool.energy.e_p_axis_j;
    const bool sum = random.below(2) == 0;
    tool.energy.e_p_j = sum ? 0 + axes[0] + axes[1] + axes[2] : any_double(random);
    encode(tool, bytes);
    recording::Tool read_tool;
    ASSERT_TRUE(read_tool.ParseFromString(bytes));
    if (sum) {
      EXPECT_EQ(read_tool.energy().has_e_p_j(), std::isnan(tool.energy.e_p_j)) << "a reader adds the axes";
    }
    ToolSample tool_out;
    ASSERT_TRUE(decode(bytes_of(read_tool.SerializeAsString()), tool_out));
    EXPECT_EQ(bits(tool_out.energy.e_p_j), bits(tool.energy.e_p_j));
    encode(tool_out, again);
    EXPECT_EQ(again, bytes);

    AuthoritySample authority;
    authority.tools = random.below(kToolsMax + 1);
    authority.masters = random.below(kMastersMax + 1);
    for (std::size_t j = 0; j < authority.tools; ++j) fill(authority.alpha[j], random, authority.masters);
    encode(authority, bytes);
    recording::Authority rows;
    ASSERT_TRUE(rows.ParseFromString(bytes));
    ASSERT_EQ(static_cast<std::size_t>(rows.tools_size()), authority.tools);
    AuthoritySample read;
    ASSERT_TRUE(decode(bytes_of(rows.SerializeAsString()), read));
    ASSERT_EQ(read.tools, authority.tools);
    for (std::size_t j = 0; j < authority.tools; ++j) EXPECT_TRUE(same(read.alpha[j], authority.alpha[j]));
  }
}

TEST(TickMessages, RefuseOrSurviveEveryCutAndFlippedBit) {
  RandomStream random{RandomKey{1}};
  std::string bytes;
  encode(any_seat(random), bytes);
  SeatSample out;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    static_cast<void>(decode(bytes_of(std::string_view{bytes}.substr(0, size)), out));
  for (std::size_t i = 0; i < bytes.size() * 8; ++i) {
    std::string flipped = bytes;
    flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << i % 8));
    recording::Seat library;
    const bool accepted = decode(bytes_of(flipped), out);
    // Own code accepts all that the library accepts; fields of another type than the schema's are ignored by both.
    if (library.ParseFromString(flipped)) {
      EXPECT_TRUE(accepted) << i;
    }
  }
}

TEST(TickMessages, IgnoreUnknownFields) {
  std::string bytes;
  encode(SessionSample{true, 3, 4}, bytes);
  bytes += std::string("\xf8\x7f\x01", 3);    // field 2047, varint
  bytes += std::string("\xa2\x06\x02hi", 5);  // field 100, bytes
  SessionSample out;
  ASSERT_TRUE(decode(bytes_of(bytes), out));
  EXPECT_EQ(out, (SessionSample{true, 3, 4}));
}

TEST(EventMessages, SurviveTheirEncoding) {
  const auto event = decode_event(bytes_of(encode_event({1, 2, "join", "trainer", "by desk-1"})));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->what + event->seat + event->text, "jointrainerby desk-1");
  const auto mark = decode_mark(bytes_of(encode_mark({1.5, "trainer", "look"})));
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->t_s, 1.5);
  EXPECT_EQ(mark->by + mark->text, "trainerlook");
  const auto sheet =
      decode_sheet(bytes_of(encode_sheet({"OSATS", "trainee", "eva", {{"flow", 4}, {"time", -1}}, true})));
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->scores, (std::map<std::string, int>{{"flow", 4}, {"time", -1}}));
  EXPECT_TRUE(sheet->closed);
  LessonLink in;
  in.rtt_p50_ms = 20;
  in.gate_trips = 3;
  std::string seat;
  const auto link = decode_link(bytes_of(encode_link(in, "trainee")), seat);
  ASSERT_TRUE(link);
  EXPECT_EQ(seat, "trainee");
  EXPECT_EQ(link->rtt_p50_ms, 20);
  EXPECT_EQ(link->gate_trips, 3u);
  EXPECT_TRUE(std::isnan(link->age_p99_ms)) << "unknown stays unknown";
  const auto counts = decode_counts(bytes_of(encode_counts({9, {{"/a", {7, 1, 1}}}})));
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->ticks, 9u);
  EXPECT_EQ(counts->channels.at(0).count.recorded, 7u);
  std::string bytes;
  encode_inputs(5, bytes_of("datagram"), bytes);
  const auto inputs = decode_inputs(bytes_of(bytes));
  ASSERT_TRUE(inputs);
  EXPECT_EQ(inputs->tick, 5u);
  EXPECT_EQ(text_of(inputs->data), "datagram");
  recording::Inputs library;
  ASSERT_TRUE(library.ParseFromString(bytes));
  EXPECT_EQ(library.data(), "datagram");
}

TEST(EventMessages, RefuseDamagedBytesAndEndlessTexts) {
  EXPECT_FALSE(decode_event(bytes_of("\xff\xff")));
  EXPECT_FALSE(decode_mark(bytes_of(encode_mark({0, "", std::string(kTextMax + 1, 'x')}))));
  EXPECT_TRUE(decode_mark(bytes_of(encode_mark({0, "", std::string(kTextMax, 'x')}))));
}

}  // namespace
}  // namespace tandem::rec

// The consoles of a session as its owner writes them for the next one.
#include "server/service/service_consoles.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"

namespace tandem::server {
namespace {

ServiceConsoles::Ticket numbered(unsigned number) { return {std::byte{0xfe}, static_cast<std::byte>(number)}; }

ServiceConsoles sample(std::size_t tickets) {
  ServiceConsoles consoles;
  consoles.session[15] = std::byte{7};
  consoles.epoch = 4711;
  for (unsigned n = 0; n < tickets; ++n) consoles.tickets.push_back(numbered(n));
  return consoles;
}

TEST(ServiceConsoles, ComeBackFromTheirText) {
  for (const std::size_t tickets : {std::size_t{0}, std::size_t{1}, ServiceConsoles::kTicketsMax})
    EXPECT_EQ(parse_service_consoles(to_text(sample(tickets))), sample(tickets)) << tickets;
}

TEST(ServiceConsoles, AreBounded) {
  const auto many = parse_service_consoles(to_text(sample(ServiceConsoles::kTicketsMax + 1)));
  EXPECT_EQ(many, sample(ServiceConsoles::kTicketsMax)) << "the first ones are kept";
  EXPECT_LE(to_text(sample(ServiceConsoles::kTicketsMax)).size(), kServiceConsolesMax);
  EXPECT_LE(to_text(sample(8)).size(), 400u) << "the usual case";
  std::string longer = to_text(sample(ServiceConsoles::kTicketsMax));
  longer.insert(longer.size() - 2, ",\"" + std::string(32, '0') + "\"");
  EXPECT_FALSE(parse_service_consoles(longer)) << "one ticket too many";
  std::string padded = to_text(sample(1));
  padded.insert(1, kServiceConsolesMax - padded.size(), ' ');
  EXPECT_TRUE(parse_service_consoles(padded));
  padded.insert(1, 1, ' ');
  EXPECT_FALSE(parse_service_consoles(padded)) << "too long";
}

TEST(ServiceConsoles, OfANewerVersionAreReadWithoutItsKeys) {
  std::string newer = to_text(sample(2));
  newer.insert(1, R"("people":["ann"],)");
  EXPECT_EQ(parse_service_consoles(newer), sample(2));
}

TEST(ServiceConsoles, RejectEveryOtherText) {
  const std::string good = to_text(sample(2));
  for (std::size_t n = 0; n < good.size(); ++n) EXPECT_FALSE(parse_service_consoles(good.substr(0, n))) << n;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"4711", "-1"},
                                                                                 {"4711", "1.5"},
                                                                                 {"4711", "\"1\""},
                                                                                 {"4711", "18446744073709551616"},
                                                                                 {"\"epoch\"", "\"other\""},
                                                                                 {"\"tickets\"", "\"other\""},
                                                                                 {"\"fe00", "\"fg00"},
                                                                                 {"\"fe00", "\"fe0"},
                                                                                 {"\"fe00", "\"fe0000"},
                                                                                 {"\"session\":\"00", "\"session\":\""},
                                                                                 {"[", "[1,"},
                                                                                 {"[", "[null,"},
                                                                                 {"[", "[[],"}}) {
    ASSERT_NE(good.find(from), std::string::npos) << from;
    EXPECT_FALSE(parse_service_consoles(with(from, to))) << to;
  }
  RandomStream random{11};
  for (int n = 0; n < 2000; ++n) {
    std::string bad = good;
    for (int k = 0; k < 3; ++k) bad[random.below(bad.size())] = static_cast<char>(random.below(256));
    if (const auto read = parse_service_consoles(bad)) {
      EXPECT_LE(read->tickets.size(), 2u) << bad;
    }
  }
}

/// An older server between two newer ones keeps the key as it is, because it does not know it.
TEST(ServiceConsoles, CountForTheNextOwnerOnlyIfTheOwnerOfTheSnapshotWroteThem) {
  const ServiceConsoles consoles = sample(2);
  const std::string text = to_text(consoles);
  EXPECT_EQ(tickets_for_next_owner(text, consoles.session, 4711), consoles.tickets);
  EXPECT_EQ(tickets_for_next_owner(text, consoles.session, 0), consoles.tickets) << "no snapshot yet";
  EXPECT_EQ(tickets_for_next_owner(text, consoles.session, 4000), consoles.tickets) << "its first snapshot is missing";
  EXPECT_TRUE(tickets_for_next_owner(text, consoles.session, 4712).empty());
  EXPECT_TRUE(tickets_for_next_owner(text, rpc::Id{}, 4711).empty()) << "another session had the name";
  EXPECT_TRUE(tickets_for_next_owner("", consoles.session, 0).empty());
}

}  // namespace
}  // namespace tandem::server

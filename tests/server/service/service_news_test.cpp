#include "server/service/service_news.h"

#include "common/base/hex.h"
#include "proto/rpc/service_codec.h"
#include "server/service/servers_table.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

class ServiceNewsTest : public ServiceTest {
 protected:
  /// Lets time pass, and returns the events of the server's lines.
  std::vector<std::string> events(Server& server, Duration time) {
    std::vector<std::string> all;
    for (const Time end = now_ + time; now_ < end;) {
      pass(100ms);
      for (const auto& line : news_.update(now_, server.member.status(now_))) {
        all.push_back(line.event);
        told_ += line.text + "\n";
      }
    }
    return all;
  }
  using Events = std::vector<std::string>;
  ServiceNews news_{"a", "10.0.0.1:2379", directory::LeaseTimes{}};
  std::string told_;
};

TEST_F(ServiceNewsTest, ReportsEachChangeOnce) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  EXPECT_EQ(events(a, 5s), Events{"service_joined"});
  a.directory.cut = true;
  Events lost = events(a, 6s);  // both after 2 s, in the order of the last answers
  std::ranges::sort(lost);
  EXPECT_EQ(lost, (Events{"service_held", "service_no_answer"}));
  EXPECT_NE(told_.find("10.0.0.1:2379 does not answer: cut off"), std::string::npos) << told_;
  a.directory.cut = false;
  events(a, 5s);
  EXPECT_EQ(events(a, 5s), Events{});
}

TEST_F(ServiceNewsTest, ReportsADirectoryThatHasLostItsDataWithTheRemedy) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  EXPECT_EQ(events(a, 5s), Events{"service_joined"});
  a.directory.cut = true;
  events(a, 500ms);
  store_ = directory::ModelStore(1000);
  a.directory.cut = false;
  EXPECT_EQ(events(a, 12s), (Events{"service_directory_lost", "service_recovered"}));
  EXPECT_NE(told_.find("10.0.0.1:2379 has lost its data"), std::string::npos) << told_;
  EXPECT_NE(told_.find("--data-dir"), std::string::npos) << told_;
}

TEST_F(ServiceNewsTest, SaysWhyTheFirstStartTakesLongerAndOnce) {
  agreed_ = {};
  Server& a = start("a", {{"lab", session_spec(1)}});
  EXPECT_EQ(events(a, 10s), (Events{"service_joined", "service_first_start"}));
  EXPECT_NE(told_.find("begins sessions in 3 s"), std::string::npos) << told_;
}

TEST_F(ServiceNewsTest, ReportsADirectoryThatCannotBeReachedAtTheStart) {
  servers_.push_back(std::make_unique<Server>(store_, ServiceMemberOptions{.server = "a"}));
  Server& a = *servers_.back();
  a.directory.cut = true;
  EXPECT_EQ(events(a, 10s), Events{"service_unreachable"});
  EXPECT_NE(told_.find("etcdctl"), std::string::npos) << told_;
  EXPECT_NE(told_.find("demands TLS"), std::string::npos) << told_;
  a.directory.cut = false;
  EXPECT_EQ(events(a, 3s), (Events{"service_joined", "service_first_start"}));
}

TEST_F(ServiceNewsTest, NamesTheCertificatesIfTheDirectoryIsReachedByTls) {
  servers_.push_back(std::make_unique<Server>(store_, ServiceMemberOptions{.server = "a"}));
  servers_.back()->directory.cut = true;
  news_ = ServiceNews("a", "10.0.0.1:2379", directory::LeaseTimes{}, " --cacert ca.pem --cert own.pem --key own.key");
  EXPECT_EQ(events(*servers_.back(), 10s), Events{"service_unreachable"});
  EXPECT_NE(told_.find("etcd must accept directory { certificate }"), std::string::npos) << told_;
  EXPECT_EQ(told_.find("demands TLS"), std::string::npos) << told_;
  EXPECT_NE(told_.find("`etcdctl --endpoints 10.0.0.1:2379 --cacert ca.pem --cert own.pem --key own.key endpoint"),
            std::string::npos)
      << told_;
}

TEST_F(ServiceNewsTest, ReportsANameThatAnotherServerHas) {
  start("a");
  Server& second = start("a");
  EXPECT_EQ(events(second, 10s), Events{"service_name_taken"});
  EXPECT_NE(told_.find("tandem-server service vouch"), std::string::npos) << told_;
}

TEST_F(ServiceNewsTest, TableHasEveryServerAndSessionsWithoutOne) {
  rpc::ServiceStatement statement;
  statement.content =
      rpc::encode(rpc::VoucherContent{.name = "a", .server = {}, .not_before = 0, .not_after = 1'800'000'000});
  Server& a = start("a", {{"lab", session_spec(1)}});
  a.member.describe({.address = "10.0.0.7:7000",
                     .key = "k",
                     .version = "1.2",
                     .zone = "north",
                     .capacity = 4,
                     .used = 1.25,
                     .voucher = to_hex(rpc::encode(statement))});
  Server& b = start("b");
  b.member.describe({.address = "b:7000", .key = "k", .version = "1.10", .zone = "", .capacity = 4});
  pass(3s);
  Server& c = start("c");
  pass(1s);
  const auto table = [&] {
    directory::DirectoryView view{directory::DirectoryKeys{}};
    ServiceCatalogue catalogue{ServiceKeys("/tandem/v1/")};
    directory::ModelDirectory through(store_);
    through.begin(1, *view.poll_request(now_, 1, 1s));
    through.begin(2, *catalogue.poll_request(now_, 2, 1s));
    while (const auto reply = through.poll())
      if (!view.on_reply(*reply)) catalogue.on_reply(*reply);
    LeaseRests rests;
    for (const auto& [name, server] : view.servers()) {
      const auto rest = store_.execute(9, directory::Remaining{server.lease});
      if (name != "c")
        rests[server.lease] = rest.outcome == directory::Outcome::kDone ? std::optional(rest.ttl) : std::nullopt;
    }
    return servers_table(view, catalogue, rests);
  };
  const std::string text = table();
  EXPECT_NE(
      text.find(
          "a       10.0.0.7:7000  1.2 (older)  north  1.25 of 4.0 cores  1         0        2 s left  2027-01-15\n"),
      std::string::npos)
      << text;
  EXPECT_NE(
      text.find("\nb       b:7000         1.10         -      0.00 of 4.0 cores  0         1        2 s left  ?\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("0        ?         ?\n"), std::string::npos) << "the rest of the lease of c is not known\n"
                                                                    << text;
  EXPECT_EQ(text.find("no standby"), std::string::npos) << text;
  EXPECT_EQ(text.find("has no server"), std::string::npos) << text;
  b.runs = c.runs = false;
  pass(5s);
  EXPECT_TRUE(table().ends_with("\nno session has a standby, because no other server is registered\n")) << table();
  a.runs = false;
  a.open.clear();
  now_ += 10s;
  store_.advance(now_);
  EXPECT_EQ(table(),
            "no server is registered in this service\nsession lab has no server; it begins again when one starts\n");
}

}  // namespace
}  // namespace tandem::server::test

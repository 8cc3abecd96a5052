// Recordings at tandem-console: rights, ids, and damaged files. Real programs.
#include <gtest/gtest.h>
#include <zlib.h>

#include <chrono>
#include <filesystem>

#include "tests/io/long_session.h"
#include "tests/io/multi_client_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

constexpr const char* kForeign = "0123456789abcdef0123456789abcdef";

/// Makes a recording of two seconds in virtual time.
void record(const Folder& folder, const std::string& name) {
  Process run({TANDEM_NETSIM, "run", "one_axis", "--duration", "2", "--quiet", "--record", folder.file(name)});
  static_cast<void>(run.wait());  // 1: the verdict of the short session
  ASSERT_TRUE(std::filesystem::exists(folder.file(name))) << run.err();
}

std::string gunzip(const std::string& compressed) {
  std::string out(1 << 20, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) return {};
  std::string input = compressed;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << "the text has at most 1 MiB";
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

struct Reply {
  unsigned status = 0;
  Json body;
};
Reply get(const WebAddress& at, const std::string& target, const std::string& cookie) {
  const HttpReply reply = http_get(at, target, {{"Cookie", cookie}, {"Accept-Encoding", "gzip"}});
  const auto encoding = reply.fields.find("content-encoding");
  const std::string text = encoding == reply.fields.end() ? reply.body : gunzip(reply.body);
  const Json body = Json::parse(text, nullptr, false);
  EXPECT_FALSE(body.is_discarded()) << target << ": " << text.substr(0, 200);
  return {reply.status, body};
}
/// Asks until the gateway has prepared its answer.
Reply get_ready(const WebAddress& at, const std::string& target, const std::string& cookie) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{60};
  for (;;) {
    Reply reply = get(at, target, cookie);
    if (reply.status != 202 || std::chrono::steady_clock::now() > end) return reply;
  }
}

TEST(GatewayRecordings, AreForRolesThatScoreAndForNoneWithoutACookie) {
  const Folder folder;
  record(folder, "a.mcap");
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own, "--recordings", folder.file("")});
  const auto cookie_for = [&](const std::string& role) {
    Process made =
        server({"ticket", "--session", "a", "--role", role, "--workstation", "desk", "--state", fixture.state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    const std::string body = Json{{"ticket", first_line(made.out())}}.dump();
    return cookie_of(http_post(gateway.at, "/join", "application/json", body, gateway.at.origin()));
  };
  const std::string id =
      get(gateway.at, "/recordings", cookie_for("instructor")).body["recordings"][0]["id"].get<std::string>();
  const std::string place = "/recordings/" + id;
  const std::vector<std::string> targets{
      "/recordings",  place, place + "/pieces/0", place + "/scores", std::string("/recordings/") + kForeign,
      "/recordings/x"};
  for (const char* role : {"trainee", "observer", "recorder"}) {
    const std::string cookie = cookie_for(role);
    WebPage page(gateway.at, cookie);
    const Json may = page.next("hello")["may"];
    EXPECT_EQ(std::ranges::find(may, "recordings"), may.end()) << role;
    for (const std::string& target : targets) {
      const Reply reply = get(gateway.at, target, cookie);
      EXPECT_EQ(reply.status, 403U) << role << target << ": the reply does not depend on what exists";
      EXPECT_EQ(reply.body.size(), 1U);
    }
  }
  for (const std::string& target : targets) {
    EXPECT_EQ(get(gateway.at, target, "").status, 401U) << target;
    EXPECT_EQ(get(gateway.at, target, "tandem=" + std::string(64, '0')).status, 401U) << target;
  }
  for (const char* role : {"instructor", "evaluator", "operator"}) {
    const std::string cookie = cookie_for(role);
    WebPage page(gateway.at, cookie);
    const Json may = page.next("hello")["may"];
    EXPECT_NE(std::ranges::find(may, "recordings"), may.end()) << role;
    EXPECT_EQ(get(gateway.at, "/recordings", cookie).status, 200U) << role;
    EXPECT_EQ(get_ready(gateway.at, place, cookie).status, 200U) << role;
    EXPECT_EQ(get_ready(gateway.at, place + "/pieces/0", cookie).status, 200U) << role;
    EXPECT_EQ(get_ready(gateway.at, place + "/scores", cookie).status, 200U) << role;
  }
}

TEST(GatewayRecordings, GiveTheSameStatesAndScoresAsTheFile) {
  const Folder folder;
  record(folder, "a.mcap");
  Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--recordings", folder.file("")});
  gateway.open_url();
  const Json row = get(gateway.at, "/recordings", gateway.cookie).body["recordings"][0];
  EXPECT_EQ(row["file"], "a.mcap");
  EXPECT_EQ(row["complete"], true);
  const std::string place = "/recordings/" + row["id"].get<std::string>();
  const Reply outline = get_ready(gateway.at, place, gateway.cookie);
  ASSERT_EQ(outline.status, 200U) << outline.body;
  EXPECT_EQ(outline.body["missing_ticks"], 0);
  EXPECT_EQ(outline.body["pieces"], 1);
  const Reply piece = get(gateway.at, place + "/pieces/0", gateway.cookie);
  EXPECT_EQ(piece.body["states"].size(), 120U + 1U) << "2.001 s at 60 per second";
  EXPECT_EQ(get(gateway.at, place + "/pieces/1", gateway.cookie).status, 404U) << "behind the end";
  const Reply scores = get_ready(gateway.at, place + "/scores", gateway.cookie);
  Process command({TANDEM_NETSIM, "score", folder.file("a.mcap"), "--quiet", "--json", "-"});
  ASSERT_EQ(command.wait(), 0) << command.err();
  const Json lesson = Json::parse(command.out())["lessons"][0];
  EXPECT_EQ(scores.body["rate_hz"], lesson["rate_hz"]);
  const Json &shown = scores.body["seats"], &exact = lesson["seats"];
  ASSERT_EQ(shown.size(), exact.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown[i]["seat"], exact[i]["seat"]);
    ASSERT_EQ(shown[i]["parts"].size(), exact[i]["parts"].size());
    const Json &cells = shown[i]["parts"][0]["cells"], &metrics = exact[i]["parts"][0]["metrics"];
    for (std::size_t m = 0; m < cells.size(); ++m) {
      const std::string key = scores.body["metrics"][m]["key"];
      EXPECT_EQ(cells[m]["trust"], metrics[key]["trust"]) << key;
      if (key != "path_length" || cells[m]["text"].is_null()) continue;
      const double millimetres = 1e3 * metrics[key]["value"].get<double>();
      EXPECT_NEAR(std::stod(cells[m]["text"].get<std::string>()), millimetres, 0.006 * millimetres);
    }
  }
}

/// The outline of a recording without its name, and its pieces and scores.
Json played(const WebGateway& gateway, const Json& row) {
  const std::string place = "/recordings/" + row["id"].get<std::string>();
  Json out;
  out["outline"] = get_ready(gateway.at, place, gateway.cookie).body;
  for (const char* key : {"id", "file", "files", "scene"}) out["outline"].erase(key);
  for (unsigned k = 0; k < out["outline"].value("pieces", 0u); ++k) {
    Json piece = get(gateway.at, place + "/pieces/" + std::to_string(k), gateway.cookie).body;
    for (Json& state : piece["states"]) state.erase("session");
    out["pieces"].push_back(std::move(piece["states"]));
  }
  out["scores"] = get_ready(gateway.at, place + "/scores", gateway.cookie).body;
  return out;
}

TEST(GatewayRecordings, OfSeveralFilesPlayAsOneLesson) {
  const LongSession session("contact", 25, 7);
  ASSERT_GE(session.parts.size(), 3u);
  WebGateway gateway(Process({TANDEM_CONSOLE, "play", session.path(1), session.folder.file("one/one.mcap"), "--listen",
                              "127.0.0.1:0"}),
                     "\n", false);
  ASSERT_NE(gateway.at.port, 0) << gateway.process.err();
  gateway.open_url();
  const Json rows = get(gateway.at, "/recordings", gateway.cookie).body["recordings"];
  ASSERT_EQ(rows.size(), 2U) << rows;
  EXPECT_EQ(rows[0]["files"], session.parts.size());
  EXPECT_EQ(rows[1]["files"], 1);
  EXPECT_EQ(rows[0]["complete"], true);
  EXPECT_TRUE(rows[0]["parts_problem"].is_null()) << rows[0];
  EXPECT_EQ(rows[0]["missing_ticks"], 0);
  const Json parts = played(gateway, rows[0]), one = played(gateway, rows[1]);
  EXPECT_GE(one["pieces"].size(), 2U) << "a piece has parts of several files";
  EXPECT_EQ(parts["outline"], one["outline"]) << Json::diff(parts["outline"], one["outline"]).dump().substr(0, 2000);
  EXPECT_EQ(parts["pieces"], one["pieces"]) << Json::diff(parts["pieces"], one["pieces"]).dump().substr(0, 2000);
  EXPECT_EQ(parts["scores"], one["scores"]) << Json::diff(parts["scores"], one["scores"]).dump().substr(0, 2000);
}

TEST(GatewayRecordings, OfSeveralFilesSayWhichIsMissing) {
  const LongSession session("one_axis", 3, 0.8);
  std::filesystem::remove(session.path(1));
  Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--recordings", session.folder.file("")});
  gateway.open_url();
  const auto rows = [&] { return get(gateway.at, "/recordings", gateway.cookie).body["recordings"]; };
  const Json all = rows();
  ASSERT_EQ(all.size(), 2U) << all;
  const Json& row = all[0]["file"] == "lesson-1.mcap" ? all[0] : all[1];
  EXPECT_EQ(row["files"], session.parts.size() - 1);
  EXPECT_EQ(row["complete"], false);
  EXPECT_NE(row["parts_problem"].get<std::string>().find("part 2 of the recording is missing, lesson-2.mcap"),
            std::string::npos)
      << row;
  const Reply outline = get_ready(gateway.at, "/recordings/" + row["id"].get<std::string>(), gateway.cookie);
  ASSERT_EQ(outline.status, 200U) << outline.body;
  EXPECT_EQ(outline.body["complete"], false);
  EXPECT_EQ(outline.body["parts_problem"], row["parts_problem"]);
  EXPECT_EQ(outline.body["gap_count"], 1) << "the ticks of the missing file";
  EXPECT_GT(outline.body["missing_ticks"].get<int>(), 700);
}

TEST(GatewayRecordings, SurviveDamagedDeletedAndForeignFiles) {
  const Folder folder;
  record(folder, "good.mcap");
  record(folder, "gone.mcap");
  const std::string whole = folder.read("good.mcap");
  folder.write("cut.mcap", whole.substr(0, whole.size() / 2));
  folder.write("foreign.mcap", "no recording");
  std::string flipped = whole;
  for (std::size_t i = 1000; i < flipped.size(); i += 997) flipped[i] = static_cast<char>(flipped[i] ^ 0x55);
  folder.write("flipped.mcap", flipped);
  std::filesystem::create_symlink("/etc/hostname", folder.file("link.mcap"));
  Process host = hosting("one_axis");
  WebGateway gateway(address_of(host), {"--recordings", folder.file("")});
  gateway.open_url();
  const Json rows = get(gateway.at, "/recordings", gateway.cookie).body["recordings"];
  std::map<std::string, Json> by_file;
  for (const Json& row : rows) by_file[row["file"]] = row;
  EXPECT_FALSE(by_file.contains("link.mcap")) << "symbolic links are not followed";
  ASSERT_EQ(by_file.size(), 5U);
  EXPECT_TRUE(by_file["foreign.mcap"]["problem"].is_string());
  EXPECT_EQ(by_file["cut.mcap"]["complete"], false);
  const auto status = [&](const std::string& file) {
    return get_ready(gateway.at, "/recordings/" + by_file[file]["id"].get<std::string>(), gateway.cookie).status;
  };
  EXPECT_EQ(status("good.mcap"), 200U);
  EXPECT_EQ(status("cut.mcap"), 200U);
  EXPECT_EQ(status("foreign.mcap"), 422U);
  EXPECT_NE(status("flipped.mcap"), 0U);
  EXPECT_EQ(status("gone.mcap"), 200U);
  std::filesystem::remove(folder.file("gone.mcap"));
  const unsigned after = status("gone.mcap");
  EXPECT_TRUE(after == 404U || after == 422U) << after << ": a deleted recording is not shown from an open file";
  for (const char* target :
       {"/recordings/../good.mcap", "/recordings/good.mcap", "/recordings/%2e%2e/good.mcap", "/recordings//etc/passwd"})
    EXPECT_EQ(get(gateway.at, target, gateway.cookie).status, 404U) << target;
  EXPECT_EQ(http_get(gateway.at, "/healthz").status, 200U) << "the gateway stays";
}

TEST(GatewayRecordings, PlayWithoutAServer) {
  const Folder folder;
  record(folder, "a.mcap");
  WebGateway gateway(Process({TANDEM_CONSOLE, "play", folder.file("a.mcap"), "--listen", "127.0.0.1:0"}), "\n", false);
  ASSERT_NE(gateway.at.port, 0) << gateway.process.err();
  gateway.open_url();
  EXPECT_EQ(get(gateway.at, "/recordings", gateway.cookie).body["recordings"].size(), 1U);
  WebPage page(gateway.at, gateway.cookie);
  EXPECT_TRUE(page.read().is_null());
  EXPECT_EQ(page.close_code(), 4404U);
  EXPECT_EQ(http_post(gateway.at, "/join", "application/json", R"({"ticket":"ticket:x"})", gateway.at.origin()).status,
            400U);
  folder.write("none.mcap", "no recording");
  Process wrong({TANDEM_CONSOLE, "play", folder.file("none.mcap")});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_NE(wrong.err().find("none.mcap: does not begin with the 8 bytes of an MCAP file"), std::string::npos)
      << wrong.err();
}

TEST(GatewayRecordings, SayHowToAllowThem) {
  Process host = hosting("one_axis");
  WebGateway gateway(address_of(host));
  gateway.open_url();
  const Reply none = get(gateway.at, "/recordings", gateway.cookie);
  EXPECT_EQ(none.status, 404U);
  EXPECT_NE(none.body["problem"].get<std::string>().find("--recordings DIR"), std::string::npos);
  Process missing({TANDEM_CONSOLE, "--recordings", "/no/such/folder", "--server", address_of(host)});
  EXPECT_EQ(missing.wait(), 2);
  EXPECT_NE(missing.err().find("--recordings: /no/such/folder"), std::string::npos) << missing.err();
}

}  // namespace
}  // namespace tandem::test

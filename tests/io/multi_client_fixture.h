#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/io/programs.h"

namespace tandem::test {

inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Starts a server with a configuration. Returns after it has printed its address.
inline Process serving(const std::string& config, Words arguments = {}) {
  arguments.insert(arguments.begin(), {"serve", config});
  Process process = server(std::move(arguments));
  process.wait_for("Ctrl-C ends");
  return process;
}

/// A server with a state directory and one enrolled workstation.
struct MultiClientFixture {
  Folder folder;
  Process host;
  std::string address, state, own;

  explicit MultiClientFixture(const std::string& sessions)
      : host(started(sessions)), address(address_of(host)), state(folder.file("state")), own(enrolled("desk")) {}
  /// Enrols another workstation. @return the directory of its key
  [[nodiscard]] std::string enrolled(const std::string& name) const {
    Process given = server({"enroll", name, "--state", folder.file("state")});
    EXPECT_EQ(given.wait(), 0) << given.err();
    Process taken({TANDEM_CLIENT, "enroll", first_line(given.out()), "--state", folder.file("own-" + name)});
    EXPECT_EQ(taken.wait(), 0) << taken.err();
    return folder.file("own-" + name);
  }
  Process started(const std::string& sessions) const {
    Process made = server({"init", "--state", folder.file("state")});
    EXPECT_EQ(made.wait(), 0) << made.err();
    return serving(folder.write("s.textproto", "version: 1 listen: \"127.0.0.1:0\" state: \"state\" " + sessions));
  }
  Process join(const std::string& seat, Words more) const {
    more.insert(more.end(), {"--state", own});
    return client(address, seat, more);
  }
  std::string ticket(const std::string& session, const std::string& seat) const {
    Process made = server({"ticket", "--session", session, "--seat", seat, "--workstation", "desk", "--state", state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    return first_line(made.out());
  }
  std::string code() const {
    Process asked = server({"sessions", "--json", "--state", state});
    EXPECT_EQ(asked.wait(), 0) << asked.err();
    const Json lobby = Json::parse(asked.out(), nullptr, false);
    return lobby.is_discarded()                       ? ""
           : lobby["sessions"][0]["code"].is_string() ? lobby["sessions"][0]["code"].get<std::string>()
                                                      : "";
  }
};

}  // namespace tandem::test

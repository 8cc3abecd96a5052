#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace tandem::test {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// A directory for one test, deleted at its end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-io-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] Json json(const std::string& name) const { return Json::parse(read(name), nullptr, false); }

 private:
  std::filesystem::path path_;
};

inline Process server(Words arguments) {
  arguments.insert(arguments.begin(), TANDEM_SERVER);
  return Process(std::move(arguments));
}

/// Starts a server that runs `scene`. Returns after it has printed its address.
inline Process hosting(const std::string& scene, Words arguments = {}) {
  arguments.insert(arguments.begin(), {"run", scene});
  Process process = server(std::move(arguments));
  process.wait_for("Ctrl-C ends");
  return process;
}

inline std::string address_of(const Process& hosting) { return hosting.after("listening on "); }

inline Process client(const std::string& address, const std::string& seat, Words arguments = {},
                      const std::string& device = "sim") {
  Words command{TANDEM_CLIENT, "join", "--server", address, "--seat", seat, "--device", device};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(std::move(command));
}

}  // namespace tandem::test

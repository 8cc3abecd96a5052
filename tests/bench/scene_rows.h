#pragma once

#include <unistd.h>

#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

#include "proto/text/scene_text.h"
#include "tests/bench/instruction_count.h"

namespace tandem::bench {

/// Keys of a scene that this table varies.
struct Row {
  const char* name;
  const char* what;
  int axes, seats;
  const char* slave;
  bool recorded = false;
  std::optional<bool> watched = std::nullopt;  ///< a console sees the session; true: a recorder
  bool inputs = false;                         ///< everything that enters the session is recorded too
  int tools = 1;                               ///< the first hands lead one each; all hands take turns in following
};
inline constexpr const char* kWall = "environment { wall { axis: X at_m: 0 k_n_m: 20000 } }";
inline constexpr std::array<Row, 14> kRows{
    {{"one_axis", "1 axis, free, 1 seat", 1, 1, ""},
     {"three_axes", "3 axes, free, 1 seat", 3, 1, ""},
     {"two_seats", "3 axes, free, 2 seats", 3, 2, ""},
     {"contact", "3 axes, contact, 2 seats", 3, 2, kWall},
     {"watched", "3 axes, contact, 2 seats, seen by a console", 3, 2, kWall, false, false},
     {"watched_whole", "3 axes, contact, 2 seats, seen by a recorder", 3, 2, kWall, false, true},
     {"arm", "3 axes, contact, 2 seats, slave an arm", 3, 2, "model: TOUCH gravity: false friction_n: 0"},
     {"gravity", "3 axes, contact, 2 seats, slave an arm with gravity and friction", 3, 2,
      "model: TOUCH gravity: true gravity_compensation: true friction_n: 0.1"},
     {"eight_seats", "3 axes, contact, 8 seats, slave an arm with gravity and friction", 3, 8,
      "model: TOUCH gravity: true gravity_compensation: true friction_n: 0.1"},
     {"recorded", "1 axis, free, 1 seat, recorded", 1, 1, "", true},
     {"recorded_contact", "3 axes, contact, 2 seats, recorded", 3, 2, kWall, true},
     {"inputs", "3 axes, contact, 2 seats, recorded with all inputs", 3, 2, kWall, true, std::nullopt, true},
     {"recorded_eight", "3 axes, contact, 8 seats, 3 tools, slaves arms with gravity and friction, recorded", 3, 8,
      "model: TOUCH gravity: true gravity_compensation: true friction_n: 0.1", true, std::nullopt, false, 3},
     {"inputs_eight", "the same, recorded with all inputs", 3, 8,
      "model: TOUCH gravity: true gravity_compensation: true friction_n: 0.1", true, std::nullopt, true, 3}}};

inline SceneSpec scene_of(const Row& row) {
  std::string text = "version: 1 tick_hz: 1000 duration_s: 600 dof: " + std::to_string(row.axes) + "\n";
  for (int i = 0; i < row.seats; ++i)
    text += "seat { name: \"hand" + std::to_string(i) + "\" kind: MASTER role: " + (i == 0 ? "INSTRUCTOR" : "TRAINEE") +
            " required: true device { model: " + (row.axes == 1 ? "LINEAR" : "TOUCH") + " } }\n";
  const std::string wall = std::strstr(row.slave, "TOUCH") != nullptr ? kWall : "";
  for (int j = 0; j < row.tools; ++j) {
    const std::string tool = j == 0 ? "tool" : "tool" + std::to_string(j);
    text += "tool { name: \"" + tool + "\" slave { " + row.slave + " " + wall + " } }\nauthority { tool: \"" + tool +
            "\" seat: \"hand" + std::to_string(j) + "\" alpha: 1 }\n";
    for (int i = j; row.tools > 1 && i < row.seats; i += row.tools)
      text += "follow { seat: \"hand" + std::to_string(i) + "\" tool: \"" + tool + "\" weight: 1 }\n";
  }
  auto scene = parse_scene(text, row.name);
  if (!scene) throw std::runtime_error(to_text(scene.error()));
  return *scene;
}

inline const Row& row_of(const std::string& name) {
  for (const Row& row : kRows)
    if (name == row.name) return row;
  throw std::runtime_error("no row " + name);
}

/// Returns the instructions of the server per client-tick once all hands are engaged; nothing if callgrind did not run.
/// @param program  path of the program scene_cost
inline std::optional<Instructions> cost_of(const std::string& program, const Row& row) {
  constexpr int kFew = 300, kMany = 1300;
  const auto run = [&](int ticks) {
    return count_instructions(program + " --serve " + row.name + " " + std::to_string(ticks), "*serve_one_tick*",
                              "scene_cost." + std::to_string(getpid()) + ".callgrind");
  };
  const auto few = run(kFew), many = run(kMany);
  if (!few || !many) return std::nullopt;
  return (*many - *few) / (static_cast<double>(kSessions) * row.seats * (kMany - kFew));
}

}  // namespace tandem::bench

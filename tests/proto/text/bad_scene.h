#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "proto/text/scene_text.h"

namespace tandem::bad_scene {

/// A valid scene; each test makes one error in it. Each `\n` matters, because the tests assert positions.
inline std::string good() {
  return "version: 1\n"                                                                        // 1
         "duration_s: 18\n"                                                                    // 2
         "device_coupling { k_c_n_m: 400 }\n"                                                  // 3
         "seat { name: \"trainer\" kind: MASTER role: INSTRUCTOR hand { model: LEADER } }\n"   // 4
         "seat { name: \"trainee\" kind: MASTER role: TRAINEE hand { model: RELAXED } }\n"     // 5
         "tool { name: \"tool\" slave { model: TOUCH } }\n"                                    // 6
         "authority { tool: \"tool\" seat: \"trainer\" alpha: 1 }\n"                           // 7
         "timeline { at_s: 11.5 authority { tool: \"tool\" seat: \"trainee\" alpha: 1 } }\n";  // 8
}
inline std::string with(std::string from, std::string to) {
  std::string text = good();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Inserts a mark before the first `word` of `text`, for errors that are reported at another place.
inline std::string mark(std::string text, const std::string& word) {
  const auto at = text.find(word);
  EXPECT_NE(at, std::string::npos) << word;
  return text.insert(at, "@");
}

inline InputErrors errors_of(const std::string& text, const char* file = "scene.textproto") {
  const auto scene = parse_scene(text, file);
  return scene ? InputErrors{} : scene.error();
}

/// Expects exactly one error: at the first `@` of `text` (removed before parsing), for `key`, containing `words`.
inline void expect_one(std::string text, const std::string& key, const std::string& words) {
  int line = 0, column = 0;
  if (const auto at = text.find('@'); at != std::string::npos) {
    text.erase(at, 1);
    line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    column = static_cast<int>(at - (at == 0 ? 0 : text.rfind('\n', at - 1) + 1)) + 1;
  }
  const auto errors = errors_of(text);
  SCOPED_TRACE(to_text(errors));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].line, line);
  EXPECT_EQ(errors[0].column, column);
  EXPECT_EQ(errors[0].key, key);
  EXPECT_NE(to_text(errors[0]).find(words), std::string::npos) << words;
  EXPECT_EQ(errors[0].file, "scene.textproto");
}

}  // namespace tandem::bad_scene
